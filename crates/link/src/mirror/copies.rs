//! The domain of iceoryx2 that the mirror publishes in, and its ports.

use super::error::MirrorError;
use super::obstacle::obstacle;
use core::fmt::Debug;
use core::time::Duration;
use iceoryx2::port::publisher::{Publisher, PublisherCreateError};
use iceoryx2::port::update_connections::UpdateConnections as _;
use iceoryx2::port::{BackpressureAction, DegradationAction};
use iceoryx2::prelude::{
    BackpressureStrategy, Config, LogLevel, Node, NodeBuilder, NodeName, Path as DomainPath,
    SemanticString as _, ServiceName, SignalHandlingMode, ZeroCopySend, ipc, set_log_level,
};
use iceoryx2::service::builder::publish_subscribe::{
    PublishSubscribeCreateError as Create, PublishSubscribeOpenError as Open,
    PublishSubscribeOpenOrCreateError as OpenOrCreate,
};
use iceoryx2::service::port_factory::publish_subscribe::PortFactory;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Name of the mirror among the processes of its domain.
const NODE: &str = "glidepath-mirror";
/// Readers of a service.
const READERS: usize = 16;
/// Processes that may have a service open: readers, dead ones that are not yet cleaned up, and those
/// that only look at it.
const NODES: usize = 40;
/// Records that a reader may hold at a time.
const HELD: usize = 8;
/// How long to try again while another process makes or removes the same thing.
const SETTLE: Duration = Duration::from_secs(2);
const RETRY: Duration = Duration::from_millis(10);

/// How many records a reader may be behind before it loses the oldest.
#[derive(Debug, Clone, Copy)]
pub(super) struct Depth(usize);

impl Depth {
    /// Four seconds at 4 ms, one at 1 ms.
    pub(super) const SETPOINTS: Self = Self(1024);
    /// The latest counts.
    pub(super) const STATUS: Self = Self(16);
}

/// A domain of iceoryx2's own kind.
#[derive(Debug)]
pub(super) struct Domain {
    node: Node<ipc::Service>,
    root: Option<PathBuf>,
}

impl Domain {
    pub(super) fn join(root: Option<&Path>) -> Result<Self, MirrorError> {
        set_log_level(LogLevel::Error);
        // That of the stock programs, whatever this host says of it: they are to find the services.
        let mut config = Config::global_config().clone();
        if let Some(root) = root {
            config.global.set_root_path(&domain_path(root)?);
        }
        let name = NodeName::new(NODE).map_err(|error| failed(root, error))?;
        let node = NodeBuilder::new()
            .name(&name)
            .config(&config)
            .signal_handling_mode(SignalHandlingMode::Disabled)
            .create::<ipc::Service>()
            .map_err(|error| failed(root, error))?;
        node.blocking_cleanup_dead_nodes(SETTLE);
        Ok(Self {
            node,
            root: root.map(Path::to_owned),
        })
    }

    /// Frees what dead processes of the domain hold.
    pub(super) fn clean_up(&self) {
        self.node.try_cleanup_dead_nodes();
    }

    /// Makes a service, or takes it over from a mirror that was killed, and the port to publish there.
    pub(super) fn copies<R: ZeroCopySend + Debug + Copy + 'static>(
        &self,
        service: &str,
        depth: Depth,
    ) -> Result<Copies<R>, MirrorError> {
        let name = ServiceName::new(service)
            .map_err(|error| self.refused(service, "naming it", error.to_string()))?;
        let opened = settle(is_in_flux, || self.service::<R>(&name, depth));
        let factory = opened.map_err(|error| match error {
            OpenOrCreate::PublishSubscribeOpenError(
                Open::IncompatibleTypes
                | Open::IncompatibleMessagingPattern
                | Open::IncompatibleOverflowBehavior
                | Open::DoesNotSupportRequestedMinBufferSize
                | Open::DoesNotSupportRequestedMinHistorySize
                | Open::DoesNotSupportRequestedMinSubscriberBorrowedSamples
                | Open::DoesNotSupportRequestedAmountOfSubscribers
                | Open::DoesNotSupportRequestedAmountOfNodes
                | Open::VersionMismatch,
            ) => MirrorError::Other {
                service: service.to_owned(),
                detail: error.into(),
            },
            error => self.refused(service, "opening it", error.to_string()),
        })?;
        // Another process may be cleaning up a mirror that was killed.
        let is_taken = |error: &PublisherCreateError| {
            matches!(error, PublisherCreateError::ExceedsMaxSupportedPublishers)
        };
        let port = settle(is_taken, || {
            self.clean_up();
            publisher(&factory)
        });
        Ok(Copies {
            service: service.to_owned(),
            port: port.map_err(|error| match error {
                PublisherCreateError::ExceedsMaxSupportedPublishers => MirrorError::Taken {
                    service: service.to_owned(),
                },
                error => self.refused(service, "making its publisher", error.to_string()),
            })?,
        })
    }

    fn service<R: ZeroCopySend + Debug + 'static>(
        &self,
        name: &ServiceName,
        depth: Depth,
    ) -> Result<PortFactory<ipc::Service, R, ()>, OpenOrCreate> {
        self.node
            .service_builder(name)
            .publish_subscribe::<R>()
            .enable_safe_overflow(true)
            .subscriber_max_buffer_size(depth.0)
            .subscriber_max_borrowed_samples(HELD)
            .history_size(1)
            .max_subscribers(READERS)
            .max_publishers(1)
            .max_nodes(NODES)
            .open_or_create()
    }

    fn refused(&self, service: &str, action: &'static str, detail: String) -> MirrorError {
        MirrorError::Service {
            service: service.to_owned(),
            action,
            detail: detail.into(),
            obstacle: obstacle(self.root.as_deref()),
        }
    }
}

/// The publishing end of a service.
#[derive(Debug)]
pub(super) struct Copies<R: ZeroCopySend + Debug + 'static> {
    service: String,
    port: Publisher<ipc::Service, R, ()>,
}

impl<R: ZeroCopySend + Debug + Copy + 'static> Copies<R> {
    pub(super) fn publish(&self, record: R) -> Result<(), MirrorError> {
        let sent = self.port.send_copy(record);
        sent.map(|_readers| ())
            .map_err(|error| self.failed(error.to_string()))
    }

    /// Gives readers that came the last record.
    pub(super) fn refresh(&self) -> Result<(), MirrorError> {
        let refreshed = self.port.update_connections();
        refreshed.map_err(|error| self.failed(error.to_string()))
    }

    fn failed(&self, detail: String) -> MirrorError {
        MirrorError::Publish {
            service: self.service.clone(),
            detail: detail.into(),
        }
    }
}

fn publisher<R: ZeroCopySend + Debug + Copy + 'static>(
    factory: &PortFactory<ipc::Service, R, ()>,
) -> Result<Publisher<ipc::Service, R, ()>, PublisherCreateError> {
    factory
        .publisher_builder()
        .backpressure_strategy(BackpressureStrategy::DiscardData)
        .set_backpressure_handler(|_| BackpressureAction::DiscardData)
        .set_degradation_handler(|_, _| DegradationAction::Ignore)
        .create()
}

fn domain_path(root: &Path) -> Result<DomainPath, MirrorError> {
    let refused = |reason: &str| MirrorError::Root {
        path: root.to_owned(),
        reason: reason.to_owned(),
    };
    if !root.is_absolute() {
        return Err(refused("it has to begin with a slash"));
    }
    DomainPath::new(root.as_os_str().as_encoded_bytes())
        .map_err(|_| refused("it is too long, or has characters that iceoryx2 does not take"))
}

fn failed(
    root: Option<&Path>,
    detail: impl core::error::Error + Send + Sync + 'static,
) -> MirrorError {
    MirrorError::Domain {
        detail: detail.into(),
        obstacle: obstacle(root),
    }
}

/// Tries again for a while what fails for now.
fn settle<T, E>(
    for_now: impl Fn(&E) -> bool,
    mut attempt: impl FnMut() -> Result<T, E>,
) -> Result<T, E> {
    let started = Instant::now();
    loop {
        match attempt() {
            Err(error) if for_now(&error) && started.elapsed() < SETTLE => {
                std::thread::sleep(RETRY);
            }
            result => return result,
        }
    }
}

const fn is_in_flux(error: &OpenOrCreate) -> bool {
    matches!(
        error,
        OpenOrCreate::SystemInFlux
            | OpenOrCreate::PublishSubscribeOpenError(
                Open::ServiceInCorruptedState
                    | Open::HangsInCreation
                    | Open::IsMarkedForDestruction
                    | Open::DoesNotExist
                    | Open::ExceedsMaxNumberOfNodes
            )
            | OpenOrCreate::PublishSubscribeCreateError(
                Create::ServiceInCorruptedState
                    | Create::HangsInCreation
                    | Create::AlreadyExists
                    | Create::IsBeingCreatedByAnotherInstance
            )
    )
}
