//! The tape of every setpoint of an instance, whoever publishes it, and what the auditor says of
//! them.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Sender, channel};
use std::sync::{Arc, Mutex};
use std::thread::JoinHandle;
use std::time::Duration;

use glidepath_audit::{Audit, AuditSettings, Sample, ViolationKind};
use glidepath_geometry::AxisVector;
use glidepath_link::{Ipc, LinkConfig, MachineState, Setpoint, Transport};

use crate::{Instance, settings};

const POLL: Duration = Duration::from_millis(1);
/// No joint of the built-in machine goes further in a period of 4 ms, mm.
const FURTHEST_MM: f64 = 0.81;

/// Records every setpoint while it lives.
#[derive(Debug)]
pub struct Tape {
    setpoints: Arc<Mutex<Vec<Setpoint>>>,
    ending: Arc<AtomicBool>,
    recorder: Option<JoinHandle<()>>,
}

impl Tape {
    /// Begins to record: what comes from now on is heard, whatever becomes of the instance.
    #[must_use]
    pub fn start(instance: &Instance) -> Self {
        let setpoints = Arc::<Mutex<Vec<Setpoint>>>::default();
        let ending = Arc::new(AtomicBool::new(false));
        let (hears, heard) = channel();
        let recorder = {
            let link = instance.config().clone();
            let (setpoints, ending) = (Arc::clone(&setpoints), Arc::clone(&ending));
            std::thread::spawn(move || record(&link, &hears, (&setpoints, &ending)))
        };
        // Where it cannot hear, the end of the recording says why.
        let _begun = heard.recv();
        Self {
            setpoints,
            ending,
            recorder: Some(recorder),
        }
    }

    /// How many were recorded so far.
    #[must_use]
    pub fn length(&self) -> usize {
        self.setpoints.lock().unwrap().len()
    }

    /// Those recorded from a place on.
    #[must_use]
    pub fn since(&self, place: usize) -> Vec<Setpoint> {
        self.setpoints.lock().unwrap()[place..].to_vec()
    }

    /// Ends the recording; returns what is wrong with it.
    ///
    /// Every stretch with power, between two references, is audited as one motion, whatever made
    /// it: programs, jogs, ways home, stops. Between stretches nothing with power may jump, and in a
    /// state of rest nothing may move.
    #[must_use]
    pub fn judge(mut self) -> Vec<String> {
        self.ending.store(true, Ordering::Relaxed);
        self.recorder.take().map(JoinHandle::join).unwrap().unwrap();
        let all = std::mem::take(&mut *self.setpoints.lock().unwrap());
        let mut wrong = Vec::new();
        for life in all.chunk_by(|a, b| a.boot_id == b.boot_id) {
            for pair in life.windows(2) {
                wrong.extend(judge_pair(&pair[0], &pair[1]));
            }
            let goes_on = |a: &Setpoint, b: &Setpoint| {
                a.reference == b.reference && leads(a) == leads(b) && a.home == b.home
            };
            for stretch in life.chunk_by(goes_on).filter(|stretch| leads(&stretch[0])) {
                wrong.extend(audit(stretch));
            }
        }
        wrong
    }
}

/// Whether setpoints lead the joints, instead of repeating where they are.
fn leads(setpoint: &Setpoint) -> bool {
    setpoint.enable != 0 && setpoint.home == 0 && setpoint.state() != Ok(MachineState::Off)
}

fn judge_pair(before: &Setpoint, after: &Setpoint) -> Vec<String> {
    let mut wrong = Vec::new();
    let tick = after.tick;
    if after.number != before.number + 1 {
        wrong.push(format!("tick {tick}: {} is missing", before.number + 1));
        return wrong;
    }
    let has_power = leads(before) && leads(after);
    let joints = before.joint_position.iter().zip(&after.joint_position);
    for (joint, (from, to)) in joints.enumerate().filter(|_| has_power) {
        if (to - from).abs() > FURTHEST_MM {
            wrong.push(format!("tick {tick}: J{joint} jumps from {from} to {to}"));
        }
    }
    use MachineState::{Held, Idle, NotHomed, ProgramStop};
    let rests = matches!(after.state(), Ok(Held | Idle | NotHomed | ProgramStop));
    let is_there =
        before.joint_position.map(f64::to_bits) == after.joint_position.map(f64::to_bits);
    // A new reference gives the same places other numbers.
    if rests && leads(before) && before.state == after.state && !is_there {
        wrong.push(format!("tick {tick}: {:?} and moves", after.state()));
    }
    wrong
}

fn audit(stretch: &[Setpoint]) -> Vec<String> {
    let mut audit = Audit::new(&AuditSettings::from(&settings()));
    for setpoint in stretch {
        audit.sample(&Sample {
            tick: setpoint.number,
            line: setpoint.line,
            position: AxisVector::from(setpoint.position),
            reported: None,
            is_between_frames: false,
        });
    }
    let last = stretch.last().map_or(0, |setpoint| setpoint.number);
    let is_limit = |kind: &ViolationKind| {
        matches!(
            kind,
            ViolationKind::Velocity { .. }
                | ViolationKind::Acceleration { .. }
                | ViolationKind::Jerk { .. }
                | ViolationKind::NotFinite
        )
    };
    let report = audit.finish();
    // A stretch may end in motion, where the power went.
    let found = report.violations.iter();
    let found = found.filter(|found| is_limit(&found.kind) && found.tick <= last);
    found.map(|found| format!("{found}")).collect()
}

fn record(
    link: &LinkConfig,
    hears: &Sender<()>,
    (setpoints, ending): (&Mutex<Vec<Setpoint>>, &AtomicBool),
) {
    let transport = Ipc::connect(link).unwrap();
    let mut source = transport.setpoint_source().unwrap();
    hears.send(()).unwrap();
    loop {
        // Asked first, so that nothing published before the end is missed.
        let is_ending = ending.load(Ordering::Relaxed);
        while let Some(setpoint) = source.take().unwrap() {
            setpoints.lock().unwrap().push(setpoint);
        }
        if is_ending {
            return;
        }
        std::thread::sleep(POLL);
    }
}
