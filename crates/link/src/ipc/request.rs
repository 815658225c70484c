//! The ports of commands and segments over request-response.

use super::node::{ExchangeService, Session};
use super::service::PrivateIpc;
use crate::{Client, LinkError, MAX_UNANSWERED, Record, Server};
use iceoryx2::pending_response::PendingResponse;
use iceoryx2::port::client::{Client as RawClient, RequestSendError};
use iceoryx2::port::server::Server as RawServer;
use iceoryx2::port::{BackpressureAction, DegradationAction, SendError};
use iceoryx2::prelude::{BackpressureStrategy, CallbackProgression, PortFactory as _};
use iceoryx2::service::port_factory::{client::ClientCreateError, server::ServerCreateError};
use std::collections::VecDeque;
use std::rc::Rc;

type Pending<Q, A> = PendingResponse<PrivateIpc, Q, (), A, ()>;

/// The process that answers at a service; none where nobody does.
pub(super) fn server_of<Q: Record, A: Record>(service: &ExchangeService<Q, A>) -> Option<i32> {
    let mut found = None;
    service.dynamic_config().list_servers(|server| {
        found = server
            .node_id
            .pid::<PrivateIpc>()
            .ok()
            .map(|pid| pid.value());
        CallbackProgression::Continue
    });
    found
}

/// The asking end.
pub(super) struct Asking<Q: Record, A: Record> {
    service: &'static str,
    /// Requests without an answer, oldest first. Before the port, which must outlive them.
    pending: VecDeque<Pending<Q, A>>,
    port: RawClient<PrivateIpc, Q, (), A, ()>,
    session: Rc<Session>,
}

impl<Q: Record, A: Record> Asking<Q, A> {
    pub(super) fn new(
        service: &'static str,
        factory: &ExchangeService<Q, A>,
        session: &Rc<Session>,
    ) -> Result<Self, LinkError> {
        let port = factory
            .client_builder()
            .backpressure_strategy(BackpressureStrategy::DiscardData)
            .set_backpressure_handler(|_| BackpressureAction::DiscardDataAndFail)
            .set_request_degradation_handler(|_, _| DegradationAction::Ignore)
            .set_response_degradation_handler(|_, _| DegradationAction::Ignore)
            .create()
            .map_err(|error| {
                let is_full = matches!(error, ClientCreateError::ExceedsMaxSupportedClients);
                LinkError::no_port(service, "client", is_full, error)
            })?;
        let pending = VecDeque::with_capacity(MAX_UNANSWERED);
        Ok(Self {
            service,
            pending,
            port,
            session: Rc::clone(session),
        })
    }
}

impl<Q: Record, A: Record> Client<Q, A> for Asking<Q, A> {
    fn ask(&mut self, request: &Q) -> Result<(), LinkError> {
        let service = self.service;
        if self.pending.len() >= MAX_UNANSWERED {
            return Err(LinkError::TooManyRequests { service });
        }
        match self.port.send_copy(*request) {
            Ok(sent) if sent.number_of_server_connections() == 0 => {
                Err(LinkError::NoServer { service })
            }
            Ok(sent) => {
                self.pending.push_back(sent);
                Ok(())
            }
            Err(
                RequestSendError::ExceedsMaxActiveRequests
                | RequestSendError::SendError(SendError::UnableToDeliver),
            ) => {
                // Full with requests that nobody takes: the server may be dead.
                self.session.clean_up_now_and_then();
                Err(LinkError::TooManyRequests { service })
            }
            Err(error) => Err(LinkError::Transport {
                service,
                action: "sending a request",
                detail: error.into(),
            }),
        }
    }

    fn reply(&mut self) -> Result<Option<A>, LinkError> {
        let service = self.service;
        let Some(oldest) = self.pending.front() else {
            return Ok(None);
        };
        // Asked first: a server may answer and leave between the two.
        let was_connected = oldest.is_connected();
        match oldest.receive() {
            Ok(Some(reply)) => {
                let answer = *reply.payload();
                drop(reply);
                self.pending.pop_front();
                Ok(Some(answer))
            }
            Ok(None) if was_connected => {
                // A server that was killed stays connected until somebody notices.
                self.session.clean_up_now_and_then();
                Ok(None)
            }
            Ok(None) => {
                self.pending.clear();
                Err(LinkError::NoServer { service })
            }
            Err(error) => Err(LinkError::Transport {
                service,
                action: "receiving a reply",
                detail: error.into(),
            }),
        }
    }
}

/// The answering end.
pub(super) struct Answering<Q: Record, A: Record> {
    service: &'static str,
    port: RawServer<PrivateIpc, Q, (), A, ()>,
    _session: Rc<Session>,
}

impl<Q: Record, A: Record> Answering<Q, A> {
    pub(super) fn new(
        service: &'static str,
        factory: &ExchangeService<Q, A>,
        session: &Rc<Session>,
    ) -> Result<Self, LinkError> {
        let port = factory
            .server_builder()
            .backpressure_strategy(BackpressureStrategy::DiscardData)
            .set_request_degradation_handler(|_, _| DegradationAction::Ignore)
            .set_response_degradation_handler(|_, _| DegradationAction::Ignore)
            .create()
            .map_err(|error| {
                let is_full = matches!(error, ServerCreateError::ExceedsMaxSupportedServers);
                LinkError::no_port(service, "server", is_full, error)
            })?;
        Ok(Self {
            service,
            port,
            _session: Rc::clone(session),
        })
    }
}

impl<Q: Record, A: Record> Server<Q, A> for Answering<Q, A> {
    fn serve(&mut self, answer: &mut dyn FnMut(&Q) -> A) -> Result<bool, LinkError> {
        let received = self.port.receive().map_err(|error| LinkError::Transport {
            service: self.service,
            action: "receiving a request",
            detail: error.into(),
        })?;
        let Some(request) = received else {
            return Ok(false);
        };
        let reply = answer(request.payload());
        // Nobody is left to answer if this fails; that is the client's affair.
        let _ = request.send_copy(reply);
        Ok(true)
    }
}
