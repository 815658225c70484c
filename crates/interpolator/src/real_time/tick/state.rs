//! The state of the real-time thread, and what every part of a tick asks of it.

use crate::real_time::drives::Drives;
use crate::real_time::frame_summary::FrameSummary;
use crate::real_time::jog::Jog;
use crate::real_time::joint_mover::JointMover;
use crate::real_time::limited_joints::LimitedJoints;
use crate::real_time::output::{Output, Written};
use crate::real_time::probing::Probing;
use crate::real_time::program_time::ProgramTime;
use crate::real_time::queue_level::QueueLevel;
use crate::real_time::rate::Rate;
use crate::real_time::retrace::Retrace;
use crate::real_time::single_block_stop::SingleBlockStop;
use crate::real_time::spindle::{Pass, SimulatedSpindle, Tap};
use crate::real_time::stop_requests::StopRequests;
use crate::real_time::stops::Stops;
use crate::real_time::superposition::SuperposedAxis;
use crate::real_time::tick_statistics::TickStatistics;
use crate::real_time::track::Track;
use crate::real_time::wait::Wait;
use crate::shared::config::Config;
use crate::shared::config::stops::StopCause;
use crate::shared::fault::Fault;
use crate::shared::message::LogEvent;
use crate::shared::track_capacity::frames_kept;
use glidepath_link::{EndOfEpoch, FaultCause, Setpoint};
use glidepath_program::{FrameFlags, Limits};
use glidepath_realtime::EventWriter;

/// Share of a limit by which a setpoint may exceed it before the motion is stopped for that.
const EXCESS_FAULT: f64 = 0.05;

/// The real-time thread's state.
pub(crate) struct Interpolator<'a> {
    pub(super) track: Track,
    pub(super) retrace: Retrace,
    pub(super) rate: Rate,
    pub(super) requests: StopRequests,
    pub(super) queue_level: QueueLevel,
    pub(super) single_block_stop: SingleBlockStop,
    pub(super) wait: Wait,
    pub(super) probing: Probing,
    /// What program time follows instead of the clock, if it does.
    pub(super) pass: Pass,
    /// The hole that is tapped, if one is.
    pub(super) tap: Option<Tap>,
    /// Revolutions for which a tap goes on at most when the spindle is told to turn back.
    pub(super) tap_overtravel: f64,
    pub(super) simulated_spindle: SimulatedSpindle,
    /// Spindle and coolant that stop with the motion.
    pub(super) stops: Stops,
    pub(super) limits: Limits,
    pub(super) jog: Jog,
    pub(super) joint_mover: JointMover,
    pub(super) drives: Drives,
    pub(super) output: Output,
    /// What is added to the motion of an axis, if anything may be.
    pub(super) superposed: Option<SuperposedAxis>,
    /// That is on its way. Asked several times a tick, on machines without it, too.
    pub(super) offset_moves: bool,
    /// The open or last epoch, 0 before the first.
    pub(super) epoch: u64,
    /// No epoch up to this number begins any more.
    pub(super) barred: u64,
    pub(super) end_of_epoch: EndOfEpoch,
    /// It was left before the event of its block was done.
    pub(super) is_unanswered: bool,
    /// What is kept of the last frame passed.
    pub(super) passed: FrameSummary,
    /// The machine has moved in the present epoch.
    pub(super) has_moved: bool,
    pub(super) statistics: TickStatistics<'a>,
}

impl<'a> Interpolator<'a> {
    pub(crate) fn new(
        config: &Config,
        boot_id: u64,
        log_events: EventWriter<'a, LogEvent>,
    ) -> Self {
        let period_t = config.period_t();
        let limits = (&config.limits, LimitedJoints::of(config));
        Self {
            track: Track::new(period_t, limits, config.m_code_waits, frames_kept(period_t)),
            retrace: Retrace::new(period_t, limits),
            rate: Rate::new(ProgramTime::at(0), 0.0),
            requests: StopRequests::default(),
            queue_level: QueueLevel::new(config),
            single_block_stop: SingleBlockStop::none(),
            wait: Wait::default(),
            probing: Probing::default(),
            pass: Pass::default(),
            tap: None,
            tap_overtravel: config.tap_overtravel,
            simulated_spindle: SimulatedSpindle::default(),
            stops: Stops::new(config.stops),
            limits: config.hand_limits,
            jog: Jog::new(config),
            joint_mover: JointMover::new(config),
            drives: Drives::new(config),
            output: Output::new(config, boot_id),
            superposed: config
                .superposition
                .map(|settings| SuperposedAxis::new(settings, &config.soft_limits, period_t)),
            offset_moves: false,
            epoch: 0,
            barred: 0,
            end_of_epoch: EndOfEpoch::None,
            is_unanswered: false,
            passed: FrameSummary::NONE,
            has_moved: false,
            statistics: TickStatistics::new(config, log_events),
        }
    }

    /// True while an epoch is being executed.
    pub(super) fn is_open(&self) -> bool {
        !self.track.is_empty()
    }

    /// True while a program is executed, also between two of its epochs.
    pub(super) fn has_program(&self) -> bool {
        self.is_open() || self.probing.goes_on()
    }

    /// True where the plan itself is at rest.
    pub(super) fn plan_rests(&self) -> bool {
        self.track.rests_at(self.rate.now().time)
    }

    /// True if the machine stands, because program time does or because the plan rests.
    pub(super) fn is_standing(&self) -> bool {
        self.output.published().is_at_rest()
            && (self.rate.now().rate <= 0.0 || self.plan_rests())
            && !self.offset_moves
    }

    /// What is known of the frame at or before the present program time.
    pub(super) fn present(&self) -> FrameSummary {
        let frame = self.track.frame(self.rate.now().time.sequence);
        frame.map_or(self.passed, FrameSummary::of)
    }

    /// Whether the motion is a rapid, or rests in front of one that is not to begin.
    pub(super) fn is_rapid(&self) -> bool {
        self.present().has(FrameFlags::RAPID) || self.single_block_stop.is_before_rapid()
    }

    /// Latches a fault; the motion stops on the path.
    pub(super) fn fail(&mut self, cause: FaultCause) {
        self.requests
            .fail(Fault::new(cause, self.passed.line, self.passed.sequence));
    }

    /// So many ticks were missed within a second, where so many are allowed.
    #[allow(
        clippy::cast_precision_loss,
        reason = "ticks of a second are far fewer"
    )]
    pub(super) fn fail_by_missed(&mut self, missed: u64, allowed: u64) {
        let cause = FaultCause::MissedTicks;
        self.requests.fail(Fault {
            value: missed as f64,
            limit: allowed as f64,
            ..Fault::new(cause, self.passed.line, self.passed.sequence)
        });
    }

    /// Tells of a setpoint that exceeds a limit, and stops the motion for one that is far above.
    pub(super) fn judge(&mut self, written: Written, tick: u64) {
        if let Written::Excess(part) = written {
            self.statistics.exceed(tick, part);
            if part.is_nan() || part > EXCESS_FAULT {
                self.fail(FaultCause::Output);
            }
        }
    }

    pub(super) fn close(&mut self, end: EndOfEpoch) {
        self.is_unanswered = self.is_before_event();
        if self.requests.heading().is_back() {
            self.leave_way_back();
        }
        // Where the machine stands is not at a frame in general.
        if let Some(path) = self.track.path(self.rate.now().time) {
            self.passed.path_s = path.path_s;
        }
        match end {
            EndOfEpoch::Aborted => self.stops.ask(StopCause::Abort),
            EndOfEpoch::Faulted => self.stops.ask(StopCause::Fault),
            EndOfEpoch::None | EndOfEpoch::Open | EndOfEpoch::Completed | EndOfEpoch::Tripped => {}
        }
        self.track.clear();
        self.rate.rest_at(self.rate.now().time, 0.0);
        self.jog.forget_path();
        self.wait.end();
        self.probing.close(end);
        self.pass.end();
        self.tap = None;
        self.output.rest();
        self.take_superposed();
        self.end_of_epoch = end;
        self.queue_level.end_epoch();
        self.requests.forget_epoch(self.probing.goes_on());
    }

    /// Whether the event of the present block, for which the motion stands, is still to be answered or
    /// to be let pass.
    fn is_before_event(&self) -> bool {
        let block_at = |sequence| self.track.frame(sequence).map(|frame| frame.block);
        let here = block_at(self.rate.now().time.sequence);
        let waits_at = self.track.waits_at().and_then(block_at);
        here.is_some() && here == waits_at
    }

    /// Writes the setpoint of a machine that stays where it is.
    pub(super) fn write_standing(&mut self, setpoint: &mut Setpoint) {
        self.output
            .write_standing(self.epoch, &self.passed, setpoint);
    }
}
