//! The frame queue: bounded, ordered, one consumer.

use super::shared::Shared;
use crate::{Delivery, FrameSink, LinkError, SetpointFrame, Subscriber};
use std::collections::VecDeque;

#[derive(Debug)]
pub(super) struct FrameQueue {
    service: &'static str,
    capacity: usize,
    frames: VecDeque<SetpointFrame>,
    has_sender: bool,
    has_consumer: bool,
}

impl FrameQueue {
    pub(super) fn new(service: &'static str, capacity: usize) -> Self {
        let frames = VecDeque::with_capacity(capacity);
        Self {
            service,
            capacity,
            frames,
            has_sender: false,
            has_consumer: false,
        }
    }
}

pub(super) struct Sink(Shared<FrameQueue>);

impl Sink {
    pub(super) fn new(queue: &Shared<FrameQueue>) -> Result<Self, LinkError> {
        let mut inner = queue.lock();
        if inner.has_sender {
            return Err(LinkError::Taken {
                service: inner.service,
                role: "planner",
                holder: None,
            });
        }
        inner.has_sender = true;
        Ok(Self(queue.clone()))
    }
}

impl Drop for Sink {
    fn drop(&mut self) {
        self.0.lock().has_sender = false;
    }
}

impl FrameSink for Sink {
    fn offer(&mut self, frame: &SetpointFrame) -> Result<Delivery, LinkError> {
        let mut queue = self.0.lock();
        Ok(if !queue.has_consumer {
            Delivery::NoConsumer
        } else if queue.frames.len() == queue.capacity {
            Delivery::Full
        } else {
            queue.frames.push_back(*frame);
            Delivery::Delivered
        })
    }
}

pub(super) struct Source(Shared<FrameQueue>);

impl Source {
    pub(super) fn new(queue: &Shared<FrameQueue>) -> Result<Self, LinkError> {
        let mut inner = queue.lock();
        if inner.has_consumer {
            return Err(LinkError::Taken {
                service: inner.service,
                role: "consumer",
                holder: None,
            });
        }
        inner.has_consumer = true;
        Ok(Self(queue.clone()))
    }
}

impl Drop for Source {
    /// What was queued here dies with the consumer, as between processes.
    fn drop(&mut self) {
        let mut queue = self.0.lock();
        queue.has_consumer = false;
        queue.frames.clear();
    }
}

impl Subscriber<SetpointFrame> for Source {
    fn take(&mut self) -> Result<Option<SetpointFrame>, LinkError> {
        Ok(self.0.lock().frames.pop_front())
    }
}
