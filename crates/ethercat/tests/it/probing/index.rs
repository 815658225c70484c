//! Joints that come home by the index pulse of their encoder, which their drive keeps.

use super::{INPUTS, TOUCH, setup};
use crate::machine::{COUNTS, Case, Hands, Outcome, START_NS, Setup, run_on};
use glidepath_emulator::{DriveSettings as Emulated, Maps, Probe, Segment, ZeroImpulse};
use glidepath_ethercat::{At, DigitalInput, Mapping, TouchProbe};
use glidepath_interpolator::{IndexPulse, JointHoming};
use glidepath_link::{Command, Feedback, MachineState, Setpoint, Status};

/// Counts of a turn of the motor, of 5 mm.
const TURN: i64 = 8_388_608;
/// Where the impulse is in it, counts: 1.2345 mm.
const AT: i64 = 2_071_147;

/// Where the edge of the home switch is, mm: it is closed below.
const EDGE: f64 = -8.2;

/// Index alone, upwards.
const ALONE: JointHoming = JointHoming {
    search_v: 0.0,
    latch_v: 2.0,
    final_v: 50.0,
    index: Some(IndexPulse::Drive),
    offset: 3.0,
    home: 0.5,
    absolute: None,
    sequence: 0,
    is_shared: false,
    is_volatile: false,
    ignores_limits: false,
    search_travel: 5.5,
    clearance: 2.0,
};

/// The switch first, and the index off it.
const BEHIND: JointHoming = JointHoming {
    search_v: -20.0,
    search_travel: 60.0,
    ..ALONE
};

/// Switches on, brings the first joint home so many times, and leaves.
#[derive(Debug, Default)]
struct HomeCase {
    times: usize,
    asked: u64,
    has_begun: bool,
    /// Feedback, setpoint and status at each home, or at a fault.
    ends: Vec<(Feedback, Setpoint, Status)>,
}

impl HomeCase {
    fn of(times: usize) -> Self {
        Self {
            times,
            ..Self::default()
        }
    }
}

impl Case for HomeCase {
    fn tick(&mut self, hands: &mut Hands<'_>, _: &mut Segment) {
        assert!(
            hands.tick < 20_000,
            "{:?} {:?}",
            hands.state(),
            hands.status
        );
        if hands.tick.saturating_sub(self.asked) < 60 {
            return;
        }
        let state = hands.state();
        // A fault is in the status a little later than in the setpoints.
        let is_told = |status: &Status| {
            state == Some(MachineState::Idle)
                || state == Some(MachineState::Faulted) && status.fault() != Ok(None)
        };
        let seen = (hands.feedback, hands.last, hands.status);
        if let (true, (Some(feedback), Some(last), Some(status))) = (self.has_begun, seen)
            && is_told(&status)
        {
            self.ends.push((feedback, last, status));
            self.has_begun = false;
        }
        let is_over = self.ends.len() == self.times;
        hands.wants.command = match state {
            Some(MachineState::Off) => Some(Command::Enable),
            _ if is_over => {
                hands.wants.end = true;
                None
            }
            Some(MachineState::NotHomed | MachineState::Idle) => {
                self.has_begun = true;
                Some(Command::Home(1))
            }
            _ => None,
        };
        if hands.wants.command.is_some() {
            self.asked = hands.tick;
        }
    }

    fn counts(&self) -> bool {
        self.has_begun
    }
}

/// A machine whose first joint comes home so; its home switch is the terminal's.
fn by_index(period_ns: u64, homing: JointHoming, touch: Option<TouchProbe>) -> Setup {
    let mut setup = setup(period_ns, touch);
    if touch.is_none() {
        setup.probe = None;
    }
    setup.drives[0].index = Some(1);
    setup.homing = Some(homing);
    zero(&mut setup, Some(AT));
    setup.terminals[0].inputs.push(DigitalInput {
        at: At::Object {
            index: 0x6000,
            sub: 1,
        },
        number: None,
        home: Some(0),
        limit_low: None,
        limit_high: None,
        is_inverted: false,
    });
    setup
}

fn zero(setup: &mut Setup, at_counts: Option<i64>) {
    let probe = setup.emulated[0].touch_probe.as_mut().unwrap();
    probe.zero = at_counts.map(|at_counts| ZeroImpulse {
        turn_counts: TURN,
        at_counts,
        wide_counts: TURN / 100,
    });
}

fn homed(setup: &Setup, times: usize) -> (HomeCase, Outcome) {
    let mut segment = Segment::new_at(&setup.emulated, START_NS - 3_000_000_000);
    segment.keep_records();
    segment.add_probe(Probe {
        drive: (0, 0),
        at_counts: EDGE * COUNTS,
        is_closed_above: false,
        inputs: vec![(INPUTS, 0)],
        filter_ns: 3_000_000,
        drive_inputs: Vec::new(),
    });
    let mut case = HomeCase::of(times);
    let outcome = run_on(setup, &mut case, segment, START_NS);
    assert_eq!(outcome.allocations, 0, "the bus thread allocates");
    assert_eq!(case.ends.len(), times);
    (case, outcome)
}

/// Where the drive counts at the place that the offset names, mm.
fn place((_, last, status): &(Feedback, Setpoint, Status), homing: &JointHoming) -> f64 {
    assert_eq!(status.fault(), Ok(None), "{}", status.last_error.as_str());
    assert_eq!(status.homed & 1, 1);
    homing.offset - last.position[0] + last.joint_position[0]
}

fn why((_, _, status): &(Feedback, Setpoint, Status)) -> String {
    assert_eq!(status.homed & 1, 0);
    status.last_error.as_str().to_owned()
}

/// In mm: the rising side of the impulse of a turn, upwards.
fn impulse(turn: i64) -> f64 {
    #[allow(clippy::cast_precision_loss, reason = "below 2⁵³")]
    let counts = (turn * TURN + AT) as f64;
    counts / COUNTS
}

#[test]
fn home_is_the_same_at_every_speed_to_the_count() {
    for (homing, turn) in [(ALONE, 0), (BEHIND, -1)] {
        for period_ns in [1_000_000, 4_000_000] {
            let mut places = Vec::new();
            for latch_v in [1.0, 7.3, 20.0] {
                for phase_ns in [300_000, 2_100_000] {
                    let homing = JointHoming { latch_v, ..homing };
                    let mut setup = by_index(period_ns, homing, None);
                    setup.phase_ns = phase_ns;
                    let (case, _) = homed(&setup, 1);
                    places.push(place(&case.ends[0], &homing));
                }
            }
            let off = places.iter().map(|place| (place - impulse(turn)).abs());
            let off = off.fold(0.0, f64::max);
            eprintln!("bus {} ms: {:.5} um", period_ns / 1_000_000, 1e3 * off);
            assert!(off <= 1.5 / COUNTS, "{places:?}, {}", impulse(turn));
        }
    }
}

#[test]
fn an_impulse_just_before_the_edge_of_the_switch_is_not_taken() {
    // One in front of the edge, which the joint passes before it looks for it: the next one is taken. And one behind.
    for (beside, turns) in [(-0.05, 1), (0.3, 0)] {
        let homing = JointHoming {
            latch_v: 2.0,
            ..BEHIND
        };
        let mut setup = by_index(4_000_000, homing, None);
        #[allow(clippy::cast_possible_truncation, reason = "counts")]
        let at = ((EDGE + beside) * COUNTS).round() as i64;
        zero(&mut setup, Some(at));
        let (case, _) = homed(&setup, 1);
        let place = place(&case.ends[0], &homing);
        #[allow(clippy::cast_precision_loss, reason = "below 2⁵³")]
        let first = (at + turns * TURN) as f64 / COUNTS;
        assert!(
            (place - first).abs() <= 1.5 / COUNTS,
            "{beside}: {place}, {first}"
        );
        assert!(place > EDGE, "{place}");
    }
}

#[test]
fn home_repeats_and_the_probe_has_its_unit_back() {
    let (case, _) = homed(&by_index(2_000_000, BEHIND, Some(TOUCH)), 3);
    for end in &case.ends {
        let off = place(end, &BEHIND) - impulse(-1);
        assert!(off.abs() <= 1.5 / COUNTS, "{off}");
        let (feedback, last, _) = end;
        assert_eq!(
            (last.index, feedback.index_armed, feedback.index_kept),
            (0, 0, 0)
        );
    }
}

#[test]
fn a_drive_that_is_asked_by_its_mailbox_keeps_it_as_well() {
    let changes: [fn(&mut Setup); 3] = [
        |setup| setup.emulated[0].touch_probe.as_mut().unwrap().is_mappable = false,
        |setup| {
            setup.drives[0].mapping = Mapping::Kept;
            setup.emulated[0].maps = Maps::Fixed {
                outputs: vec![0x6040_0010, 0x607a_0020, 0x60b8_0010],
                inputs: vec![0x6041_0010, 0x6064_0020],
            };
        },
        |setup| setup.drives[0].index = Some(2),
    ];
    for (case, change) in changes.into_iter().enumerate() {
        let mut setup = by_index(4_000_000, ALONE, None);
        change(&mut setup);
        let (seen, _) = homed(&setup, 2);
        // The second time it sets out from its home, below the same impulse.
        for end in &seen.ends {
            let off = place(end, &ALONE) - impulse(0);
            let turns = (off / 5.0).round();
            assert!((off - 5.0 * turns).abs() <= 1.5 / COUNTS, "{case}: {off}");
        }
    }
}

#[test]
fn no_impulse_within_a_turn_is_told_as_that() {
    let mut setup = by_index(4_000_000, ALONE, None);
    zero(&mut setup, None);
    let (case, _) = homed(&setup, 1);
    let told = why(&case.ends[0]);
    assert!(told.contains("no index pulse within 5.5 mm"), "{told}");
}

#[test]
fn a_drive_that_nobody_has_told_to_keep_it_does_not_set_out() {
    let mut setup = by_index(4_000_000, ALONE, None);
    setup.drives[0].index = None;
    let (case, _) = homed(&setup, 1);
    let told = why(&case.ends[0]);
    assert!(
        told.contains("was not ready to keep the index pulse within 5 s"),
        "{told}"
    );
    assert!(case.ends[0].0.position[0].abs() < 1e-6, "it has moved");
}

#[test]
fn a_place_that_cannot_be_is_told_and_not_used() {
    let mut setup = by_index(4_000_000, ALONE, None);
    setup.emulated[0].touch_probe.as_mut().unwrap().off_counts = 1_000_000;
    let (case, _) = homed(&setup, 1);
    let told = why(&case.ends[0]);
    assert!(told.contains("which is not on the way"), "{told}");
}

#[test]
fn a_drive_without_a_touch_probe_is_refused_by_name() {
    use crate::wire::{MemoryWire, Quiet};
    use glidepath_ethercat::{Init, Settings};
    let mut setup = by_index(4_000_000, ALONE, None);
    setup.emulated[0] = Emulated::default();
    let settings = Settings {
        bus: setup.bus,
        drives: setup.drives,
        drive_inputs: setup.drive_inputs,
        terminals: setup.terminals,
        servo: crate::machine::servo(),
    };
    let mut wire = MemoryWire::new(Segment::new(&setup.emulated), Quiet, 0);
    let pre_op = Init::find(&mut wire).unwrap().into_pre_op().unwrap();
    let told = pre_op.into_safe_op(&settings).unwrap_err().to_string();
    assert!(
        told.contains("device 0") && told.contains("`index` out of its own"),
        "{told}"
    );
}
