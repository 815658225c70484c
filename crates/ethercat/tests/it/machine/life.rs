//! One life of an interpolator, and what plans for it.

use super::setup::{PERIOD_NS, limits};
use glidepath_gcode::{Connections, Dialect, GearSpeeds, Gears, MCodes, Options, Threading};
use glidepath_geometry::AxisVector;
use glidepath_interpolator::Served;
use glidepath_link::{
    Auxiliary, Client, CommandReply, CommandRequest, Feedback, FrameSink, InProcess, LinkError,
    Publisher, Setpoint, SetpointFrame, Status, Subscriber, Transport,
};
use glidepath_planner::{Output, Pipeline, ProgramSource};
use glidepath_program::{Effort, Settings as PlanSettings, Smoothing};
use std::cell::RefCell;
use std::collections::VecDeque;
use std::rc::Rc;
use std::sync::Arc;

/// A program's frames for a machine that stands at `start`.
pub(crate) fn plan(text: &str, start: AxisVector, epoch: u64) -> Vec<SetpointFrame> {
    let mut m_codes = MCodes::default();
    m_codes.declare(19, 19);
    let speeds = [(0.0, 1000.0), (100.0, 6000.0)];
    let speeds = speeds.map(|(least, most)| GearSpeeds { least, most });
    let gears = Gears::new(speeds.to_vec(), false).unwrap();
    gears.declare(Dialect::LinuxCnc, &mut m_codes);
    let options = Options {
        start,
        connections: Connections::Real,
        probing_v: Some(20.0),
        threading: Some(Threading::new(limits(), 0.004)),
        orients: true,
        gears: Arc::new(gears),
        m_codes: Arc::new(m_codes),
        ..Options::default()
    };
    let settings = PlanSettings {
        limits: limits(),
        tolerance_mm: 0.02,
        direction: glidepath_program::DirectionTolerance::default(),
        smoothing: Smoothing::Auto,
        corners: glidepath_program::Corners::default(),
        period_t: 0.004,
        effort: Effort::Optimal,
    };
    let source = ProgramSource::new(text.as_bytes(), options);
    let mut pipeline = Pipeline::new(source, settings, start);
    let mut frames = Vec::new();
    loop {
        match pipeline.advance().unwrap() {
            Output::Frame(frame) => {
                frames.push(SetpointFrame::from_frame(&frame, epoch, PERIOD_NS));
            }
            Output::End => return frames,
            Output::Item(_) | Output::Pending => {}
        }
    }
}

/// What setpoints go through to the bridge.
pub(super) type Queue = Rc<RefCell<VecDeque<Setpoint>>>;

pub(super) struct Source(pub(super) Queue);

impl Subscriber<Setpoint> for Source {
    fn take(&mut self) -> Result<Option<Setpoint>, LinkError> {
        Ok(self.0.borrow_mut().pop_front())
    }
}

/// One life of an interpolator, and its ports.
pub(super) struct Life<'s> {
    pub(super) tick: Box<dyn FnMut(u64) -> Setpoint + 's>,
    pub(super) setpoints: Box<dyn Subscriber<Setpoint>>,
    pub(super) auxiliary: Box<dyn Subscriber<Auxiliary>>,
    pub(super) feedback: Box<dyn Publisher<Feedback>>,
    pub(super) frames: Box<dyn FrameSink>,
    pub(super) client: Box<dyn Client<CommandRequest, CommandReply>>,
    pub(super) statuses: Box<dyn Subscriber<Status>>,
}

impl<'s> Life<'s> {
    pub(super) fn new(link: &InProcess, served: &'s mut Served<'_>) -> Self {
        Self {
            tick: Box::new(|now_ns| served.tick(now_ns)),
            setpoints: link.setpoint_source().unwrap(),
            auxiliary: link.auxiliary_source().unwrap(),
            feedback: link.feedback_sink().unwrap(),
            frames: link.frame_sink().unwrap(),
            client: link.command_client().unwrap(),
            statuses: link.status_source().unwrap(),
        }
    }
}
