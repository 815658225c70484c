//! The ports of frames, setpoints and status over publish-subscribe.

use super::node::{Session, TopicService};
use super::service::PrivateIpc;
use crate::{Delivery, FrameSink, LinkError, Publisher, Record, SetpointFrame, Subscriber};
use iceoryx2::port::publisher::{Publisher as RawPublisher, PublisherCreateError};
use iceoryx2::port::subscriber::{Subscriber as RawSubscriber, SubscriberCreateError};
use iceoryx2::port::update_connections::UpdateConnections;
use iceoryx2::port::{BackpressureAction, DegradationAction, SendError};
use iceoryx2::prelude::{BackpressureStrategy, CallbackProgression, PortFactory as _};
use std::fs::File;
use std::rc::Rc;

fn make_publisher<R: Record>(
    service: &'static str,
    factory: &TopicService<R>,
) -> Result<RawPublisher<PrivateIpc, R, ()>, LinkError> {
    factory
        .publisher_builder()
        // Waiting is for the callers. A queue that does not overflow reports that it is full.
        .backpressure_strategy(BackpressureStrategy::DiscardData)
        .set_backpressure_handler(|_| BackpressureAction::DiscardDataAndFail)
        .set_degradation_handler(|_, _| DegradationAction::Ignore)
        .create()
        .map_err(|error| {
            let is_full = matches!(error, PublisherCreateError::ExceedsMaxSupportedPublishers);
            LinkError::no_port(service, "publisher", is_full, error)
        })
}

/// The planner's end of the frame queue.
pub(super) struct Frames {
    service: &'static str,
    port: RawPublisher<PrivateIpc, SetpointFrame, ()>,
    /// Held while this is the planner: the frames of two would mix. The service has room for two
    /// publishers, because a dead one keeps its place until it is cleaned up.
    _part: File,
    session: Rc<Session>,
}

impl Frames {
    pub(super) fn new(
        service: &'static str,
        factory: &TopicService<SetpointFrame>,
        session: &Rc<Session>,
    ) -> Result<Self, LinkError> {
        let part = session.claim_part(service, "planner")?;
        Ok(Self {
            service,
            port: make_publisher(service, factory)?,
            _part: part,
            session: Rc::clone(session),
        })
    }
}

impl FrameSink for Frames {
    fn offer(&mut self, frame: &SetpointFrame) -> Result<Delivery, LinkError> {
        match self.port.send_copy(*frame) {
            Ok(0) => Ok(Delivery::NoConsumer),
            Ok(_) => Ok(Delivery::Delivered),
            Err(SendError::UnableToDeliver) => {
                // A consumer that died with a full queue stays full until somebody notices.
                self.session.clean_up_now_and_then();
                Ok(Delivery::Full)
            }
            Err(error) => Err(LinkError::Transport {
                service: self.service,
                action: "sending a frame",
                detail: error.into(),
            }),
        }
    }
}

/// The sending end of a topic.
pub(super) struct Sink<R: Record> {
    service: &'static str,
    port: RawPublisher<PrivateIpc, R, ()>,
    _session: Rc<Session>,
}

impl<R: Record> Sink<R> {
    pub(super) fn new(
        service: &'static str,
        factory: &TopicService<R>,
        session: &Rc<Session>,
    ) -> Result<Self, LinkError> {
        Ok(Self {
            service,
            port: make_publisher(service, factory)?,
            _session: Rc::clone(session),
        })
    }
}

impl<R: Record> Publisher<R> for Sink<R> {
    fn publish(&mut self, record: &R) -> Result<(), LinkError> {
        self.port
            .send_copy(*record)
            .map(|_| ())
            .map_err(|error| LinkError::Transport {
                service: self.service,
                action: "publishing",
                detail: error.into(),
            })
    }

    fn refresh(&mut self) -> Result<(), LinkError> {
        self.port
            .update_connections()
            .map_err(|error| LinkError::Transport {
                service: self.service,
                action: "looking for new subscribers",
                detail: error.into(),
            })
    }
}

/// The processes that receive a topic.
pub(super) fn receivers<R: Record>(service: &TopicService<R>) -> Vec<i32> {
    let mut processes = Vec::new();
    service.dynamic_config().list_subscribers(|receiver| {
        // One that came or went just now may have no process.
        if let Ok(process) = receiver.node_id.pid::<PrivateIpc>() {
            processes.push(process.value());
        }
        CallbackProgression::Continue
    });
    processes
}

/// The receiving end of a topic or of the frames.
pub(super) struct Source<R: Record> {
    service: &'static str,
    port: RawSubscriber<PrivateIpc, R, ()>,
    _session: Rc<Session>,
}

impl<R: Record> Source<R> {
    pub(super) fn new(
        service: &'static str,
        factory: &TopicService<R>,
        session: &Rc<Session>,
    ) -> Result<Self, LinkError> {
        let builder = factory.subscriber_builder();
        let port = builder
            .set_degradation_handler(|_, _| DegradationAction::Ignore)
            .create()
            .map_err(|error| {
                let is_full =
                    matches!(error, SubscriberCreateError::ExceedsMaxSupportedSubscribers);
                LinkError::no_port(service, "subscriber", is_full, error)
            })?;
        Ok(Self {
            service,
            port,
            _session: Rc::clone(session),
        })
    }
}

impl<R: Record> Subscriber<R> for Source<R> {
    fn take(&mut self) -> Result<Option<R>, LinkError> {
        match self.port.receive() {
            Ok(sample) => Ok(sample.map(|sample| *sample.payload())),
            Err(error) => Err(LinkError::Transport {
                service: self.service,
                action: "receiving",
                detail: error.into(),
            }),
        }
    }
}
