//! Requests and replies: many clients, one server.

use super::shared::Shared;
use crate::port::MAX_UNANSWERED;
use crate::service::CLIENTS;
use crate::{Client, LinkError, Server};
use std::collections::VecDeque;

#[derive(Debug)]
pub(super) struct Exchange<Q, A> {
    service: &'static str,
    /// Requests not yet taken, with the client and the life of it that asked.
    requests: VecDeque<(u64, Q)>,
    clients: Vec<Caller<A>>,
    next_id: u64,
    has_server: bool,
}

#[derive(Debug)]
struct Caller<A> {
    id: u64,
    unanswered: usize,
    /// The server went away with requests of this client.
    deserted: bool,
    replies: VecDeque<A>,
}

impl<Q, A> Exchange<Q, A> {
    pub(super) fn new(service: &'static str) -> Self {
        let (requests, clients) = (VecDeque::new(), Vec::with_capacity(CLIENTS));
        Self {
            service,
            requests,
            clients,
            next_id: 0,
            has_server: false,
        }
    }

    fn client(&mut self, id: u64) -> Option<&mut Caller<A>> {
        self.clients.iter_mut().find(|client| client.id == id)
    }
}

pub(super) struct Asking<Q, A> {
    exchange: Shared<Exchange<Q, A>>,
    id: u64,
}

impl<Q, A> Asking<Q, A> {
    pub(super) fn new(exchange: &Shared<Exchange<Q, A>>) -> Result<Self, LinkError> {
        let mut inner = exchange.lock();
        if inner.clients.len() == CLIENTS {
            return Err(LinkError::Taken {
                service: inner.service,
                role: "client",
                holder: None,
            });
        }
        let id = inner.next_id;
        inner.next_id += 1;
        let replies = VecDeque::with_capacity(MAX_UNANSWERED);
        inner.clients.push(Caller {
            id,
            unanswered: 0,
            deserted: false,
            replies,
        });
        Ok(Self {
            exchange: exchange.clone(),
            id,
        })
    }
}

impl<Q, A> Drop for Asking<Q, A> {
    fn drop(&mut self) {
        let mut exchange = self.exchange.lock();
        exchange.clients.retain(|client| client.id != self.id);
        exchange.requests.retain(|(client, _)| *client != self.id);
    }
}

impl<Q: Copy, A> Client<Q, A> for Asking<Q, A> {
    fn ask(&mut self, request: &Q) -> Result<(), LinkError> {
        let mut exchange = self.exchange.lock();
        let service = exchange.service;
        if !exchange.has_server {
            return Err(LinkError::NoServer { service });
        }
        match exchange.client(self.id) {
            Some(client) if client.unanswered < MAX_UNANSWERED => client.unanswered += 1,
            _ => return Err(LinkError::TooManyRequests { service }),
        }
        exchange.requests.push_back((self.id, *request));
        Ok(())
    }

    fn reply(&mut self) -> Result<Option<A>, LinkError> {
        let mut exchange = self.exchange.lock();
        let service = exchange.service;
        let Some(client) = exchange.client(self.id) else {
            return Ok(None);
        };
        if let Some(reply) = client.replies.pop_front() {
            client.unanswered -= 1;
            return Ok(Some(reply));
        }
        if core::mem::take(&mut client.deserted) {
            client.unanswered = 0;
            return Err(LinkError::NoServer { service });
        }
        Ok(None)
    }
}

pub(super) struct Answering<Q, A>(Shared<Exchange<Q, A>>);

impl<Q, A> Answering<Q, A> {
    pub(super) fn new(exchange: &Shared<Exchange<Q, A>>) -> Result<Self, LinkError> {
        let mut inner = exchange.lock();
        if inner.has_server {
            return Err(LinkError::Taken {
                service: inner.service,
                role: "server",
                holder: None,
            });
        }
        inner.has_server = true;
        Ok(Self(exchange.clone()))
    }
}

impl<Q, A> Drop for Answering<Q, A> {
    fn drop(&mut self) {
        let mut exchange = self.0.lock();
        exchange.has_server = false;
        exchange.requests.clear();
        for client in &mut exchange.clients {
            client.deserted = client.unanswered > client.replies.len();
        }
    }
}

impl<Q, A> Server<Q, A> for Answering<Q, A> {
    fn serve(&mut self, answer: &mut dyn FnMut(&Q) -> A) -> Result<bool, LinkError> {
        let Some((id, request)) = self.0.lock().requests.pop_front() else {
            return Ok(false);
        };
        // The lock is not held here: answering may use other ports of the same service.
        let reply = answer(&request);
        if let Some(client) = self.0.lock().client(id) {
            client.replies.push_back(reply);
        }
        Ok(true)
    }
}
