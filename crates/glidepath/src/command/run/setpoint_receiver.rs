//! The receiver of what the mock servo was given, on its way through this process: counted, audited,
//! recorded.

use super::pipe::{Farewell, GivenAll, Pipe, ReadAhead};
use crate::command::failure::Failure;
use crate::config::MachineConfig;
use crate::play_time::{PlayTime, PlayedTime};
use crate::recording::Recording;
use crate::sample::TickSample;
use glidepath_audit as audit;
use glidepath_audit::diagnosis::{Diagnosis, Summary};
use glidepath_audit::{Audit, Passed};
use glidepath_geometry::AxisVector;
use glidepath_link::servo::{Servo, ServoCounts, ServoSettings};
use glidepath_link::{MachineState, Setpoint};
use glidepath_planner::{FileSource, ItemSource, Supply};
use glidepath_program::{Frame, FrameFlags, ItemKind};
use std::io::{BufReader, Read};
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicU32, AtomicU64, Ordering};
use std::thread::JoinHandle;

/// How far the auditor is told the program ahead of the motion, mm of path.
const AHEAD_MM: f64 = 100.0;

/// How far the reception has come, for the thread that waits.
#[derive(Debug, Default)]
pub(super) struct Seen {
    received: AtomicU64,
    line: AtomicU32,
}

impl Seen {
    /// Setpoints received.
    pub(super) fn received(&self) -> u64 {
        self.received.load(Ordering::Relaxed)
    }

    /// Line being executed.
    pub(super) fn line(&self) -> u64 {
        self.line.load(Ordering::Relaxed).into()
    }
}

/// The whole of what was received.
#[derive(Debug)]
pub(super) struct Received {
    pub(super) counts: ServoCounts,
    pub(super) farewell: Farewell,
    pub(super) audit: audit::AuditReport,
    pub(super) played: PlayedTime,
    /// What bound the motion that was played, and how smooth it was.
    pub(super) summary: Summary,
    pub(super) recording: Recording,
}

/// The thread that receives.
#[derive(Debug)]
pub(super) struct SetpointReceiver {
    pub(super) seen: Arc<Seen>,
    /// The servo has ended its output: it has stopped by itself, or died.
    pub(super) given_all: GivenAll,
    thread: JoinHandle<Result<Received, Failure>>,
}

impl SetpointReceiver {
    /// Receives from a servo's output until that ends.
    pub(super) fn start(
        from: impl Read + Send + 'static,
        program: &Path,
        config: &MachineConfig,
        recording: Recording,
    ) -> Self {
        let seen = Arc::new(Seen::default());
        let shared = Arc::clone(&seen);
        let (program, config) = (program.to_owned(), config.clone());
        let from = ReadAhead::of(from);
        let given_all = from.given_all();
        let thread =
            std::thread::spawn(move || receive(from, (&program, &config), recording, &shared));
        Self {
            seen,
            given_all,
            thread,
        }
    }

    /// True if nothing is received any more: all there was, or what is received cannot be kept.
    pub(super) fn is_over(&self) -> bool {
        self.thread.is_finished()
    }

    /// Waits for the end of the servo's output.
    pub(super) fn finish(self) -> Result<Received, Failure> {
        let panicked = |_| Failure::Thread("the thread that receives setpoints");
        self.thread.join().map_err(panicked)?
    }
}

fn receive(
    from: ReadAhead,
    (program, config): (&Path, &MachineConfig),
    mut recording: Recording,
    seen: &Seen,
) -> Result<Received, Failure> {
    let period_t = config.period_t();
    let (pipe, farewell) = Pipe::new(BufReader::new(from));
    // Only its counts are wanted: the servo process has played these setpoints in its own time.
    let mut servo = Servo::new(Box::new(pipe), ServoSettings::default());
    let mut play_time = PlayTime::new(period_t);
    // The program begins where the machine stands, which is known when the first setpoint comes that
    // belongs to it: drives may have been switched on, and have gone home, before.
    let mut stands = config.home();
    let mut judge = None;
    while let Some(setpoint) = servo.receive(0)? {
        play_time.take(&setpoint);
        let mut sample = TickSample::received(&setpoint, period_t);
        if setpoint.epoch == 0 {
            stands = setpoint.position.into();
        } else {
            let judge = match &mut judge {
                Some(judge) => judge,
                none => none.insert(Judge::new(program, config, stands)?),
            };
            sample = judge.take(&setpoint, sample, &mut recording);
        }
        recording.push(&sample)?;
        seen.line.store(setpoint.line, Ordering::Relaxed);
        seen.received.fetch_add(1, Ordering::Relaxed);
    }
    let counts = *servo.counts();
    let judge = match judge {
        Some(judge) => judge,
        None => Judge::new(program, config, stands)?,
    };
    let (audit, summary) = judge.finish(&mut recording);
    Ok(Received {
        counts,
        farewell: farewell.get().cloned().unwrap_or_default(),
        audit,
        summary,
        played: play_time.played(),
        recording,
    })
}

/// The auditor, and the program it judges by.
#[derive(Debug)]
struct Judge {
    audit: Audit,
    diagnosis: Diagnosis,
    program: FileSource,
    /// Path of the program told so far, mm.
    told_s: f64,
    passed: Passed,
}

impl Judge {
    fn new(path: &Path, config: &MachineConfig, stands: AxisVector) -> Result<Self, Failure> {
        let options = config.program_options(stands);
        let program = FileSource::unchecked(path, options, &config.settings())?;
        let judged = config.judged_at(&stands);
        let mut audit = config.audit_at(&stands);
        if let Some(mut bounds) = config.joint_bounds() {
            // Drives may count from elsewhere.
            for bounds in &mut bounds {
                bounds.range = [f64::NEG_INFINITY, f64::INFINITY];
            }
            audit = audit.with_joints(bounds);
        }
        Ok(Self {
            audit,
            diagnosis: config.diagnosis(&judged),
            program,
            told_s: 0.0,
            passed: Passed::default(),
        })
    }

    /// Judges a setpoint of the program; gives its sample, with what is known of it.
    fn take(
        &mut self,
        setpoint: &Setpoint,
        sample: TickSample,
        recording: &mut Recording,
    ) -> TickSample {
        // Without power they repeat what the drives report, which nobody has asked for.
        if setpoint.enable == 0 {
            return sample;
        }
        while self.told_s < setpoint.path_s + AHEAD_MM && self.tell(recording) {}
        let judged = audit::Sample {
            // Not the tick of the clock: after a missed tick the next setpoint is the next of the
            // path.
            tick: setpoint.number,
            line: setpoint.line,
            position: AxisVector::from(setpoint.position),
            reported: None,
            is_between_frames: setpoint.is_between_frames(),
        };
        self.audit
            .joints(judged.tick, judged.line, &setpoint.joint_position);
        self.audit.raise_override(setpoint.effective_override);
        for told in setpoint.events() {
            if let Ok(event) = told.event() {
                self.audit.event(event, told.offset_ns);
            }
        }
        let is_idle = matches!(setpoint.state(), Ok(MachineState::Idle));
        let is_away = setpoint.away.iter().any(|away| *away != 0.0);
        let time = (setpoint.sequence, setpoint.fraction);
        let behind_mm = (!is_idle && !is_away).then(|| self.passed.off_mm(time, &judged.position));
        // On a way back it is where it was before. Anywhere else it would be found off the path.
        let is_again = behind_mm
            .flatten()
            .is_some_and(|off| off <= self.audit.tolerance_mm());
        // Into a tapped hole the way is that of the spindle, which no program says.
        if is_away || is_again {
            self.audit.sample_away(&judged);
        } else {
            self.audit.sample(&judged);
        }
        if is_again || !is_idle {
            self.diagnosis.joints(&setpoint.joint_position);
        }
        if is_again {
            self.diagnosis.pass(&as_frame(setpoint));
            return sample;
        }
        // Waiting before and after the program is no part of the motion.
        if is_idle {
            return sample;
        }
        let binding = self.diagnosis.frame(&as_frame(setpoint));
        sample.diagnosed(binding, &self.diagnosis)
    }

    /// Tells the auditor the next item; false at the end. A finding ends it too: the program was
    /// checked, so that only a file that was changed meanwhile has one, and the auditor then finds
    /// that the motion went elsewhere.
    fn tell(&mut self, recording: &mut Recording) -> bool {
        let Supply::Item(item) = self.program.next_item() else {
            return false;
        };
        if let ItemKind::Move { segment, .. } = &item.kind {
            self.told_s += segment.length();
        }
        self.audit.program(&item);
        self.diagnosis.program(&item);
        recording.program(&item);
        true
    }

    fn finish(mut self, recording: &mut Recording) -> (audit::AuditReport, Summary) {
        while self.tell(recording) {}
        (self.audit.finish(), self.diagnosis.finish())
    }
}

/// A setpoint as the frame that it would be if it had been planned so.
fn as_frame(setpoint: &Setpoint) -> Frame {
    Frame {
        sequence: setpoint.number,
        line: setpoint.line,
        block: setpoint.block,
        flags: FrameFlags(setpoint.flags),
        planned_override: setpoint.effective_override,
        path_v: setpoint.feed_v,
        path_s: setpoint.path_s,
        velocity: setpoint.velocity.into(),
        acceleration: setpoint.acceleration.into(),
        ..Frame::blank(setpoint.position.into())
    }
}
