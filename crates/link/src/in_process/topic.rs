//! A topic: every subscriber has a queue of its own that loses its oldest record when full.

use super::shared::Shared;
use crate::{LinkError, Publisher, Subscriber};
use std::collections::VecDeque;

#[derive(Debug)]
pub(super) struct Topic<R> {
    service: &'static str,
    depth: usize,
    most_subscribers: usize,
    most_publishers: usize,
    publishers: usize,
    subscribers: Vec<Reader<R>>,
    next_id: u64,
}

#[derive(Debug)]
struct Reader<R> {
    id: u64,
    queue: VecDeque<R>,
    /// Whether it has been handed the history, or needs none.
    joined: bool,
}

impl<R> Topic<R> {
    pub(super) fn new(
        service: &'static str,
        depth: usize,
        most_subscribers: usize,
        most_publishers: usize,
    ) -> Self {
        let subscribers = Vec::with_capacity(most_subscribers);
        Self {
            service,
            depth,
            most_subscribers,
            most_publishers,
            publishers: 0,
            subscribers,
            next_id: 0,
        }
    }
}

impl<R: Copy> Topic<R> {
    fn give(&mut self, reader: usize, record: R) {
        let depth = self.depth;
        if let Some(reader) = self.subscribers.get_mut(reader) {
            if reader.queue.len() == depth {
                reader.queue.pop_front();
            }
            reader.queue.push_back(record);
        }
    }

    fn join(&mut self, last: Option<R>) {
        for index in 0..self.subscribers.len() {
            let joined = self
                .subscribers
                .get_mut(index)
                .is_none_or(|r| core::mem::replace(&mut r.joined, true));
            if let (false, Some(last)) = (joined, last) {
                self.give(index, last);
            }
        }
    }
}

pub(super) struct Sink<R> {
    topic: Shared<Topic<R>>,
    last: Option<R>,
}

impl<R> Sink<R> {
    pub(super) fn new(topic: &Shared<Topic<R>>) -> Result<Self, LinkError> {
        let mut inner = topic.lock();
        if inner.publishers == inner.most_publishers {
            return Err(LinkError::Taken {
                service: inner.service,
                role: "publisher",
                holder: None,
            });
        }
        inner.publishers += 1;
        Ok(Self {
            topic: topic.clone(),
            last: None,
        })
    }
}

impl<R> Drop for Sink<R> {
    fn drop(&mut self) {
        self.topic.lock().publishers -= 1;
    }
}

impl<R: Copy> Publisher<R> for Sink<R> {
    fn publish(&mut self, record: &R) -> Result<(), LinkError> {
        let mut topic = self.topic.lock();
        topic.join(self.last);
        for index in 0..topic.subscribers.len() {
            topic.give(index, *record);
        }
        self.last = Some(*record);
        Ok(())
    }

    fn refresh(&mut self) -> Result<(), LinkError> {
        self.topic.lock().join(self.last);
        Ok(())
    }
}

pub(super) struct Source<R> {
    topic: Shared<Topic<R>>,
    id: u64,
}

impl<R> Source<R> {
    pub(super) fn new(topic: &Shared<Topic<R>>) -> Result<Self, LinkError> {
        let mut inner = topic.lock();
        if inner.subscribers.len() == inner.most_subscribers {
            return Err(LinkError::Taken {
                service: inner.service,
                role: "subscriber",
                holder: None,
            });
        }
        let id = inner.next_id;
        inner.next_id += 1;
        let queue = VecDeque::with_capacity(inner.depth);
        inner.subscribers.push(Reader {
            id,
            queue,
            joined: false,
        });
        Ok(Self {
            topic: topic.clone(),
            id,
        })
    }
}

impl<R> Drop for Source<R> {
    fn drop(&mut self) {
        self.topic
            .lock()
            .subscribers
            .retain(|reader| reader.id != self.id);
    }
}

impl<R> Subscriber<R> for Source<R> {
    fn take(&mut self) -> Result<Option<R>, LinkError> {
        let mut topic = self.topic.lock();
        let reader = topic
            .subscribers
            .iter_mut()
            .find(|reader| reader.id == self.id);
        Ok(reader.and_then(|reader| reader.queue.pop_front()))
    }
}
