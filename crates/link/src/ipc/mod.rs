//! The transport between processes: iceoryx2 over shared memory.
//!
//! Each instance has a directory of its own, in memory, that only its user can enter, and nothing
//! outside of it; the machine's or user's configuration of iceoryx2 is never read. Nothing here
//! waits longer than it takes to make or clean up a connection.
//!
//! What the services rely on, all of it checked by the tests:
//!
//! * a frame counts as delivered only if the transport says that one consumer got it;
//! * a full queue, of frames or requests, is reported and never overwritten; of setpoints and
//!   status, it loses its oldest;
//! * a peer that was killed is noticed by whoever waits for it, by everybody that joins, and by
//!   [`Transport::clean_up_dead_peers`].

mod active_program;
mod config;
mod directory;
mod drives_lock;
mod interpolator_lock;
mod mapping;
mod node;
mod operator;
mod panel;
mod presence;
mod request;
mod service;
mod settings;
mod stamped;
mod storage;
mod topic;
mod trouble;

pub use active_program::ActiveProgram;
pub use config::LinkConfig;
pub use drives_lock::DrivesLock;
pub use interpolator_lock::InterpolatorProcess;
pub use operator::Operator;
pub use presence::remove_leftovers;

use crate::service::{
    AUXILIARY, COMMANDS, Capacity, FEEDBACK, FEEDBACK_DEPTH, FRAMES, JOBS, JOG, JOG_DEPTH, LINES,
    PEERS, SEGMENTS, SENDERS, SETPOINTS, STATUS,
};
use crate::{
    Auxiliary, Client, CommandReply, CommandRequest, Feedback, FrameSink, JobReply, JobRequest,
    JogDemand, LinesReply, LinesRequest, LinkError, Publisher, Record, SegmentReply,
    SegmentRequest, Server, Setpoint, SetpointFrame, Status, Subscriber, Transport,
};
use interpolator_lock::InterpolatorLock;
use node::{Session, TopicSettings};
use panel::{Panel, StatusBoard};
use std::rc::Rc;

/// The part of one thread in an instance. It and its ports stay in that thread.
#[derive(Debug)]
pub struct Ipc {
    session: Rc<Session>,
    capacity: Capacity,
}

impl Ipc {
    /// Joins an instance, which comes into being with its first process. What dead processes of it
    /// left is cleaned up.
    ///
    /// # Errors
    ///
    /// [`LinkError::Name`], [`LinkError::Root`], or a failure of the transport.
    pub fn connect(config: &LinkConfig) -> Result<Self, LinkError> {
        Ok(Self {
            session: Rc::new(Session::open(config)?),
            capacity: config.capacity,
        })
    }

    /// Frames: one consumer, and no frame is ever overwritten.
    const fn frames(&self) -> TopicSettings {
        TopicSettings {
            overflow: false,
            depth: self.capacity.frames,
            history: 0,
            subscribers: 1,
            publishers: SENDERS,
        }
    }

    const fn setpoints(&self) -> TopicSettings {
        let Capacity {
            setpoints: depth,
            subscribers,
            ..
        } = self.capacity;
        TopicSettings {
            overflow: true,
            depth,
            history: 1,
            subscribers,
            publishers: SENDERS,
        }
    }

    /// The processes that receive setpoints, each as often as it does.
    ///
    /// # Errors
    ///
    /// A failure of the transport.
    pub fn setpoint_receivers(&self) -> Result<Vec<i32>, LinkError> {
        let service = self
            .session
            .topic::<Setpoint>(SETPOINTS, self.setpoints())?;
        Ok(topic::receivers(&service))
    }

    /// Takes the part of the one process that answers for all drives of the instance.
    ///
    /// # Errors
    ///
    /// [`LinkError::Taken`] with the process that has it, or the file cannot be had.
    pub fn answer_for_drives(&self) -> Result<DrivesLock, LinkError> {
        DrivesLock::take(self.session.config(), FEEDBACK)
    }

    /// The process of the planner's service, if one serves jobs.
    #[must_use]
    pub fn planner_process(&self) -> Option<i32> {
        let service = self.session.exchange::<JobRequest, JobReply>(JOBS).ok()?;
        request::server_of(&service)
    }

    const fn status(&self) -> TopicSettings {
        let subscribers = self.capacity.subscribers;
        TopicSettings {
            overflow: true,
            depth: 1,
            history: 1,
            subscribers,
            publishers: SENDERS,
        }
    }

    /// From many to the interpolator: the latest of each counts.
    const fn reports(&self, depth: usize) -> TopicSettings {
        let subscribers = self.capacity.subscribers;
        TopicSettings {
            overflow: true,
            depth,
            history: 1,
            subscribers,
            publishers: PEERS,
        }
    }

    fn publisher<R: Record>(
        &self,
        name: &'static str,
        settings: TopicSettings,
    ) -> Result<Box<dyn Publisher<R>>, LinkError> {
        let service = self.session.topic(name, settings)?;
        let make = || topic::Sink::new(name, &service, &self.session);
        Ok(Box::new(self.session.claim(make)?))
    }

    fn subscriber<R: Record>(
        &self,
        name: &'static str,
        settings: TopicSettings,
    ) -> Result<Box<dyn Subscriber<R>>, LinkError> {
        let service = self.session.topic(name, settings)?;
        let make = || topic::Source::new(name, &service, &self.session);
        Ok(Box::new(self.session.claim(make)?))
    }

    fn client<Q: Record, A: Record>(
        &self,
        name: &'static str,
    ) -> Result<Box<dyn Client<Q, A>>, LinkError> {
        let service = self.session.exchange(name)?;
        let make = || request::Asking::new(name, &service, &self.session);
        Ok(Box::new(self.session.claim(make)?))
    }

    fn server<Q: Record, A: Record>(
        &self,
        name: &'static str,
    ) -> Result<Box<dyn Server<Q, A>>, LinkError> {
        let service = self.session.exchange(name)?;
        let make = || request::Answering::new(name, &service, &self.session);
        let port = self.session.claim(make);
        let port = port.map_err(|error| error.held_by(request::server_of(&service)))?;
        Ok(Box::new(port))
    }
}

impl Transport for Ipc {
    fn frame_sink(&self) -> Result<Box<dyn FrameSink>, LinkError> {
        let service = self.session.topic(FRAMES, self.frames())?;
        let make = || topic::Frames::new(FRAMES, &service, &self.session);
        Ok(Box::new(self.session.claim(make)?))
    }

    fn frame_source(&self) -> Result<Box<dyn Subscriber<SetpointFrame>>, LinkError> {
        let source = self.subscriber(FRAMES, self.frames());
        source.map_err(|error| error.held_by(self.interpolator_process()))
    }

    fn setpoint_sink(&self) -> Result<Box<dyn Publisher<Setpoint>>, LinkError> {
        self.publisher(SETPOINTS, self.setpoints())
    }

    fn setpoint_source(&self) -> Result<Box<dyn Subscriber<Setpoint>>, LinkError> {
        self.subscriber(SETPOINTS, self.setpoints())
    }

    fn status_sink(&self) -> Result<Box<dyn Publisher<Status>>, LinkError> {
        let service = self.session.topic(STATUS, self.status())?;
        let make = || topic::Sink::new(STATUS, &service, &self.session);
        let port = self.session.claim(make)?;
        let board = StatusBoard::make(self.session.config())?;
        Ok(Box::new(StatusSink { board, port }))
    }

    fn status_source(&self) -> Result<Box<dyn Subscriber<Status>>, LinkError> {
        self.subscriber(STATUS, self.status())
    }

    fn auxiliary_sink(&self) -> Result<Box<dyn Publisher<Auxiliary>>, LinkError> {
        self.publisher(AUXILIARY, self.status())
    }

    fn auxiliary_source(&self) -> Result<Box<dyn Subscriber<Auxiliary>>, LinkError> {
        self.subscriber(AUXILIARY, self.status())
    }

    fn feedback_sink(&self) -> Result<Box<dyn Publisher<Feedback>>, LinkError> {
        self.publisher(FEEDBACK, self.reports(FEEDBACK_DEPTH))
    }

    fn feedback_source(&self) -> Result<Box<dyn Subscriber<Feedback>>, LinkError> {
        self.subscriber(FEEDBACK, self.reports(FEEDBACK_DEPTH))
    }

    fn jog_sink(&self) -> Result<Box<dyn Publisher<JogDemand>>, LinkError> {
        self.publisher(JOG, self.reports(JOG_DEPTH))
    }

    fn jog_source(&self) -> Result<Box<dyn Subscriber<JogDemand>>, LinkError> {
        self.subscriber(JOG, self.reports(JOG_DEPTH))
    }

    fn command_client(&self) -> Result<Box<dyn Client<CommandRequest, CommandReply>>, LinkError> {
        self.client(COMMANDS)
    }

    fn command_server(&self) -> Result<Box<dyn Server<CommandRequest, CommandReply>>, LinkError> {
        let service = self.session.exchange(COMMANDS)?;
        let make = || request::Answering::new(COMMANDS, &service, &self.session);
        let port = self.session.claim(make)?;
        // Last: it is released if anything after it opens the file once more.
        let config = self.session.config();
        let panel = Panel::make(config)?;
        let lock = InterpolatorLock::take(config, COMMANDS)?;
        let (path, file) = lock.file();
        self.session.is_found_by(path, file)?;
        Ok(Box::new(CommandServer {
            panel,
            port,
            _lock: lock,
        }))
    }

    fn segment_client(&self) -> Result<Box<dyn Client<SegmentRequest, SegmentReply>>, LinkError> {
        self.client(SEGMENTS)
    }

    fn segment_server(&self) -> Result<Box<dyn Server<SegmentRequest, SegmentReply>>, LinkError> {
        self.server(SEGMENTS)
    }

    fn job_client(&self) -> Result<Box<dyn Client<JobRequest, JobReply>>, LinkError> {
        self.client(JOBS)
    }

    fn job_server(&self) -> Result<Box<dyn Server<JobRequest, JobReply>>, LinkError> {
        self.server(JOBS)
    }

    fn lines_client(&self) -> Result<Box<dyn Client<LinesRequest, LinesReply>>, LinkError> {
        self.client(LINES)
    }

    fn lines_server(&self) -> Result<Box<dyn Server<LinesRequest, LinesReply>>, LinkError> {
        self.server(LINES)
    }

    fn clean_up_dead_peers(&self) -> Result<usize, LinkError> {
        Ok(self.session.clean_up())
    }

    fn stands(&self) -> Result<(), LinkError> {
        self.session.stands()
    }

    fn interpolator_process(&self) -> Option<i32> {
        let found = InterpolatorProcess::find(self.session.config());
        Some(found.ok()??.id())
    }
}

/// The status for everybody, and on the panel.
struct StatusSink {
    board: StatusBoard,
    port: topic::Sink<Status>,
}

impl Publisher<Status> for StatusSink {
    fn publish(&mut self, status: &Status) -> Result<(), LinkError> {
        self.board.show(status).and(self.port.publish(status))
    }

    fn refresh(&mut self) -> Result<(), LinkError> {
        self.port.refresh()
    }
}

/// Commands from the panel, and from those that joined.
struct CommandServer {
    panel: Panel,
    port: request::Answering<CommandRequest, CommandReply>,
    _lock: InterpolatorLock,
}

impl Server<CommandRequest, CommandReply> for CommandServer {
    fn serve(
        &mut self,
        answer: &mut dyn FnMut(&CommandRequest) -> CommandReply,
    ) -> Result<bool, LinkError> {
        // The panel first: whatever is wrong with the port, it serves.
        let served = self.panel.serve(answer)?;
        Ok(served || self.port.serve(answer)?)
    }
}
