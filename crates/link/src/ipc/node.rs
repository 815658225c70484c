//! The node of a thread, and the services it opens.

use super::config::LinkConfig;
use super::presence::Presence;
use super::settings::settings;
use crate::service::{CLIENTS, SENDERS};
use crate::{BoxedError, LinkError, MAX_UNANSWERED, Record};
use core::cell::Cell;
use core::time::Duration;
use iceoryx2::prelude::{
    LogLevel, Node, NodeBuilder, ServiceName, SignalHandlingMode, ipc, set_log_level,
};
use iceoryx2::service::builder::publish_subscribe::PublishSubscribeOpenOrCreateError as TopicError;
use iceoryx2::service::builder::request_response::RequestResponseOpenOrCreateError as ExchangeError;
use iceoryx2::service::port_factory::{publish_subscribe, request_response};
use std::fs::File;
use std::fs::Permissions;
use std::os::unix::fs::PermissionsExt as _;
use std::time::Instant;

pub(super) type TopicService<R> = publish_subscribe::PortFactory<ipc::Service, R, ()>;
pub(super) type ExchangeService<Q, A> = request_response::PortFactory<ipc::Service, Q, (), A, ()>;

/// How long to try again when a service is being made or removed by another process.
const SETTLE: Duration = Duration::from_secs(2);
/// Least time between two searches for dead peers by a port that waits.
const SEARCH_EVERY: Duration = Duration::from_millis(200);
/// Processes that may have a service open.
const NODES: usize = 64;

/// What all ports of a thread share. Dropped after the last of them.
#[derive(Debug)]
pub(super) struct Session {
    node: Node<ipc::Service>,
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
                .create::<ipc::Service>()
        };
        let node = settle(create, |_| true).map_err(|error| LinkError::Transport {
            service: "instance",
            action: "joining it",
            detail: error.into(),
        })?;
        keep_private(&config.prefix());
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
        match make() {
            Err(LinkError::Taken { .. }) => {
                self.node.blocking_cleanup_dead_nodes(SETTLE);
                make()
            }
            made => made,
        }
    }

    /// Claims a part in a service that one process at a time may play.
    pub(super) fn claim_part(
        &self,
        service: &'static str,
        role: &'static str,
    ) -> Result<File, LinkError> {
        let claimed = self.presence.claim(role)?;
        claimed.ok_or(LinkError::Taken { service, role })
    }

    /// Opens the service of a topic or of the frames.
    pub(super) fn topic<R: Record>(
        &self,
        service: &'static str,
        settings: TopicSettings,
    ) -> Result<TopicService<R>, LinkError> {
        let name = service_name(service)?;
        let open = || {
            self.node
                .service_builder(&name)
                .publish_subscribe::<R>()
                .enable_safe_overflow(settings.overflow)
                .subscriber_max_buffer_size(settings.depth)
                .history_size(settings.history)
                .max_subscribers(settings.subscribers)
                .max_publishers(SENDERS)
                .max_nodes(NODES)
                .open_or_create()
        };
        settle(open, is_topic_in_flux)
            .map_err(|error| mismatch(service, R::NAME, is_topic_mismatch(&error), error.into()))
    }

    /// Opens a request-response service.
    pub(super) fn exchange<Q: Record, A: Record>(
        &self,
        service: &'static str,
    ) -> Result<ExchangeService<Q, A>, LinkError> {
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
        settle(open, is_exchange_in_flux)
            .map_err(|error| mismatch(service, Q::NAME, is_exchange_mismatch(&error), error.into()))
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
}

/// iceoryx2 lets everybody write one of the files that it makes: the bookkeeping that the processes
/// of an instance share. Only their owner is to have a say in it.
fn keep_private(prefix: &str) {
    let files = std::fs::read_dir("/dev/shm")
        .into_iter()
        .flatten()
        .flatten();
    for file in files {
        let name = file.file_name();
        let name = name.to_string_lossy();
        if name.starts_with(prefix) && name.ends_with(".global_mgmt") {
            // Gone, or private already because somebody else of this instance did it.
            let _ = std::fs::set_permissions(file.path(), Permissions::from_mode(0o600));
        }
    }
}

fn service_name(service: &'static str) -> Result<ServiceName, LinkError> {
    service.try_into().map_err(|error| LinkError::Transport {
        service,
        action: "naming it",
        detail: format!("{error:?}").into(),
    })
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
