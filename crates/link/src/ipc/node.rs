//! The node of a thread, and the services it opens.

use super::config::LinkConfig;
use super::presence::Presence;
use super::service::PrivateIpc;
use super::settings::settings;
use super::trouble::explained;
use crate::service::CLIENTS;
use crate::{BoxedError, LinkError, MAX_UNANSWERED, Record};
use core::cell::Cell;
use core::time::Duration;
use iceoryx2::prelude::{
    LogLevel, Node, NodeBuilder, ServiceName, SignalHandlingMode, set_log_level,
};
use iceoryx2::service::builder::publish_subscribe::PublishSubscribeOpenOrCreateError as TopicError;
use iceoryx2::service::builder::request_response::RequestResponseOpenOrCreateError as ExchangeError;
use iceoryx2::service::port_factory::{publish_subscribe, request_response};
use std::fs::File;
use std::path::Path;
use std::time::Instant;

pub(super) type TopicService<R> = publish_subscribe::PortFactory<PrivateIpc, R, ()>;
pub(super) type ExchangeService<Q, A> = request_response::PortFactory<PrivateIpc, Q, (), A, ()>;

/// How long to try again when a service is being made or removed by another process.
const SETTLE: Duration = Duration::from_secs(2);
/// Least time between two searches for dead peers by a port that waits.
const SEARCH_EVERY: Duration = Duration::from_millis(200);
/// Processes that may have a service open.
const NODES: usize = 64;

/// What all ports of a thread share. Dropped after the last of them.
#[derive(Debug)]
pub(super) struct Session {
    node: Node<PrivateIpc>,
    searched: Cell<Option<Instant>>,
    /// After the node, so that its files are gone when the last one out looks.
    presence: Presence,
}

impl Session {
    pub(super) fn open(config: &LinkConfig) -> Result<Self, LinkError> {
        let presence = Presence::announce(config)?;
        set_log_level(LogLevel::Error);
        let settings = settings(config)?;
        let create = || {
            NodeBuilder::new()
                .config(&settings)
                .signal_handling_mode(SignalHandlingMode::Disabled)
                .create::<PrivateIpc>()
        };
        let node = explained(&config.directory(), || {
            settle(create, |_| true).map_err(|error| LinkError::Transport {
                service: "instance",
                action: "joining it",
                detail: error.into(),
            })
        })?;
        Ok(Self {
            node,
            searched: Cell::new(None),
            presence,
        })
    }

    /// Frees what dead peers hold; returns how many there were.
    pub(super) fn clean_up(&self) -> usize {
        usize::try_from(self.node.try_cleanup_dead_nodes().cleanups).unwrap_or(usize::MAX)
    }

    /// Frees what dead peers hold, but not too often: for a port that waits for a peer that may
    /// have died.
    pub(super) fn clean_up_now_and_then(&self) {
        if self
            .searched
            .get()
            .is_none_or(|at| at.elapsed() >= SEARCH_EVERY)
        {
            self.clean_up();
            self.searched.set(Some(Instant::now()));
        }
    }

    /// Makes a port; if all places are taken, once more after the dead have given up theirs.
    /// Another process may be cleaning up just then, which made that of joining pass over them.
    pub(super) fn claim<T>(&self, make: impl Fn() -> Result<T, LinkError>) -> Result<T, LinkError> {
        explained(&self.config().directory(), || match make() {
            Err(LinkError::Taken { .. }) => {
                self.node.blocking_cleanup_dead_nodes(SETTLE);
                make()
            }
            made => made,
        })
    }

    /// The instance.
    pub(super) const fn config(&self) -> &LinkConfig {
        self.presence.config()
    }

    /// From now on others find this process by a file, too.
    pub(super) fn is_found_by(&self, path: &Path, file: &File) -> Result<(), LinkError> {
        let noted = self.presence.is_found_by(path.to_owned(), file);
        noted.map_err(|error| LinkError::no_file(path, 0, error))
    }

    /// Looks whether others still find this process.
    pub(super) fn stands(&self) -> Result<(), LinkError> {
        self.presence.stands()
    }

    /// Claims a part in a service that one process at a time may play.
    pub(super) fn claim_part(
        &self,
        service: &'static str,
        role: &'static str,
    ) -> Result<File, LinkError> {
        let claimed = self.presence.claim(role)?;
        claimed.ok_or(LinkError::Taken {
            service,
            role,
            holder: None,
        })
    }

    /// Opens the service of a topic or of the frames.
    pub(super) fn topic<R: Record>(
        &self,
        service: &'static str,
        settings: TopicSettings,
    ) -> Result<TopicService<R>, LinkError> {
        // A directory that was removed would be made anew, for this process alone.
        self.stands()?;
        let name = service_name(service)?;
        let open = || {
            self.node
                .service_builder(&name)
                .publish_subscribe::<R>()
                .enable_safe_overflow(settings.overflow)
                .subscriber_max_buffer_size(settings.depth)
                .history_size(settings.history)
                .max_subscribers(settings.subscribers)
                .max_publishers(settings.publishers)
                .max_nodes(NODES)
                .open_or_create()
        };
        explained(&self.config().directory(), || {
            settle(open, is_topic_in_flux).map_err(|error| {
                mismatch(service, R::NAME, is_topic_mismatch(&error), error.into())
            })
        })
    }

    /// Opens a request-response service.
    pub(super) fn exchange<Q: Record, A: Record>(
        &self,
        service: &'static str,
    ) -> Result<ExchangeService<Q, A>, LinkError> {
        self.stands()?;
        let name = service_name(service)?;
        let open = || {
            self.node
                .service_builder(&name)
                .request_response::<Q, A>()
                .enable_safe_overflow_for_requests(false)
                .enable_safe_overflow_for_responses(false)
                .max_active_requests_per_client(MAX_UNANSWERED)
                .max_response_buffer_size(1)
                .max_servers(1)
                .max_clients(CLIENTS)
                .max_nodes(NODES)
                .open_or_create()
        };
        explained(&self.config().directory(), || {
            settle(open, is_exchange_in_flux).map_err(|error| {
                mismatch(service, Q::NAME, is_exchange_mismatch(&error), error.into())
            })
        })
    }
}

/// The properties of a service for frames, setpoints or status.
#[derive(Clone, Copy)]
pub(super) struct TopicSettings {
    /// Whether a full queue loses its oldest, or refuses the newest.
    pub(super) overflow: bool,
    /// Length of a subscriber's queue.
    pub(super) depth: usize,
    /// How many of the last records a late subscriber gets.
    pub(super) history: usize,
    /// Most subscribers.
    pub(super) subscribers: usize,
    /// Most publishers.
    pub(super) publishers: usize,
}

fn service_name(service: &'static str) -> Result<ServiceName, LinkError> {
    service
        .try_into()
        .map_err(
            |error: iceoryx2::service::service_name::ServiceNameError| LinkError::Transport {
                service,
                action: "naming it",
                detail: error.to_string().into(),
            },
        )
}

/// Tries again for a while if another process is just making or removing the same thing.
fn settle<T, E>(
    mut attempt: impl FnMut() -> Result<T, E>,
    in_flux: impl Fn(&E) -> bool,
) -> Result<T, E> {
    let started = Instant::now();
    loop {
        match attempt() {
            Err(error) if in_flux(&error) && started.elapsed() < SETTLE => {
                std::thread::sleep(Duration::from_millis(10));
            }
            result => return result,
        }
    }
}

fn mismatch(
    service: &'static str,
    record: &'static str,
    is_mismatch: bool,
    detail: BoxedError,
) -> LinkError {
    if is_mismatch {
        LinkError::VersionMismatch {
            service,
            record,
            detail,
        }
    } else {
        LinkError::Transport {
            service,
            action: "opening it",
            detail,
        }
    }
}

fn is_topic_in_flux(error: &TopicError) -> bool {
    use iceoryx2::service::builder::publish_subscribe::{
        PublishSubscribeCreateError as Create, PublishSubscribeOpenError as Open,
    };
    match error {
        TopicError::SystemInFlux => true,
        TopicError::PublishSubscribeOpenError(error) => matches!(
            error,
            Open::ServiceInCorruptedState
                | Open::HangsInCreation
                | Open::IsMarkedForDestruction
                | Open::DoesNotExist
        ),
        TopicError::PublishSubscribeCreateError(error) => matches!(
            error,
            Create::ServiceInCorruptedState
                | Create::HangsInCreation
                | Create::AlreadyExists
                | Create::IsBeingCreatedByAnotherInstance
        ),
    }
}

fn is_topic_mismatch(error: &TopicError) -> bool {
    use iceoryx2::service::builder::publish_subscribe::PublishSubscribeOpenError as Open;
    matches!(
        error,
        TopicError::PublishSubscribeOpenError(
            Open::IncompatibleTypes
                | Open::IncompatibleMessagingPattern
                | Open::IncompatibleAttributes
                | Open::IncompatibleOverflowBehavior
                | Open::DoesNotSupportRequestedMinBufferSize
                | Open::DoesNotSupportRequestedMinHistorySize
                | Open::DoesNotSupportRequestedMinSubscriberBorrowedSamples
                | Open::DoesNotSupportRequestedAmountOfPublishers
                | Open::DoesNotSupportRequestedAmountOfSubscribers
                | Open::DoesNotSupportRequestedAmountOfNodes
                | Open::VersionMismatch
        )
    )
}

fn is_exchange_in_flux(error: &ExchangeError) -> bool {
    use iceoryx2::service::builder::request_response::{
        RequestResponseCreateError as Create, RequestResponseOpenError as Open,
    };
    match error {
        ExchangeError::SystemInFlux => true,
        ExchangeError::RequestResponseOpenError(error) => matches!(
            error,
            Open::ServiceInCorruptedState
                | Open::HangsInCreation
                | Open::IsMarkedForDestruction
                | Open::DoesNotExist
        ),
        ExchangeError::RequestResponseCreateError(error) => matches!(
            error,
            Create::ServiceInCorruptedState
                | Create::HangsInCreation
                | Create::AlreadyExists
                | Create::IsBeingCreatedByAnotherInstance
        ),
    }
}

fn is_exchange_mismatch(error: &ExchangeError) -> bool {
    use iceoryx2::service::builder::request_response::RequestResponseOpenError as Open;
    matches!(
        error,
        ExchangeError::RequestResponseOpenError(
            Open::IncompatibleRequestOrResponseType
                | Open::IncompatibleMessagingPattern
                | Open::IncompatibleAttributes
                | Open::IncompatibleOverflowBehaviorForRequests
                | Open::IncompatibleOverflowBehaviorForResponses
                | Open::IncompatibleBehaviorForFireAndForgetRequests
                | Open::DoesNotSupportRequestedAmountOfClientRequestLoans
                | Open::DoesNotSupportRequestedAmountOfActiveRequestsPerClient
                | Open::DoesNotSupportRequestedResponseBufferSize
                | Open::DoesNotSupportRequestedAmountOfServers
                | Open::DoesNotSupportRequestedAmountOfClients
                | Open::DoesNotSupportRequestedAmountOfNodes
                | Open::VersionMismatch
        )
    )
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test")]
    #![allow(
        unsafe_code,
        reason = "the derive expands to an unsafe impl, and checks the fields"
    )]

    use super::*;
    use crate::Setpoint;
    use iceoryx2::prelude::ZeroCopySend;

    /// A setpoint of a version to come.
    #[repr(C)]
    #[derive(Debug, Clone, Copy, ZeroCopySend)]
    #[type_name("glidepath.Setpoint.v7")]
    struct SetpointToCome([f64; size_of::<Setpoint>() / 8]);

    #[test]
    fn another_version_of_a_record_is_a_clear_error() {
        let root = tempfile::tempdir_in("/dev/shm").unwrap();
        let config = LinkConfig {
            root: root.path().join("link"),
            ..LinkConfig::new("versions")
        };
        let session = Session::open(&config).unwrap();
        let service = session
            .node
            .service_builder(&"glidepath/setpoints".try_into().unwrap())
            .publish_subscribe::<SetpointToCome>()
            .open_or_create()
            .unwrap();
        let wanted = TopicSettings {
            overflow: true,
            depth: 1,
            history: 1,
            subscribers: 1,
            publishers: 2,
        };
        let open = || session.topic::<Setpoint>("glidepath/setpoints", wanted);
        let error = open().err().unwrap();
        assert!(
            matches!(error, LinkError::VersionMismatch { .. }),
            "{error}"
        );
        let text = error.to_string();
        assert!(text.contains(Setpoint::NAME), "{text}");
        assert!(text.contains("IncompatibleTypes"), "{text}");
        drop(service);
        open().unwrap();
    }
}
