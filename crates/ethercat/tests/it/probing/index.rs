//! Joints that come home by the index pulse of their encoder, which their drive keeps.

use super::search::Search;
use super::{INPUTS, PART_Z, TOUCH, probe, setup};
use crate::machine::{COUNTS, Case, Hands, Outcome, START_NS, Setup, run_on};
use crate::wire::{MemoryWire, Quiet};
use glidepath_emulator::{
    DriveSettings as Emulated, InjectedFault, Maps, Probe, Segment, ZeroImpulse,
};
use glidepath_ethercat::{At, DigitalInput, Init, Mapping, Settings, TouchProbe};
use glidepath_interpolator::{IndexPulse, JointHoming};
use glidepath_link::{Command, Feedback, LatchKind, MachineState, Setpoint, Status};

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
    /// Its touch probe is off while it moves between these places, once.
    off: Option<(f64, f64)>,
    /// What it does once it is at home.
    then: Option<Search>,
    /// The last feedback.
    last: Option<Feedback>,
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
    fn tick(&mut self, hands: &mut Hands<'_>, segment: &mut Segment) {
        self.last = hands.feedback.or(self.last);
        if let (Some((low, high)), Some(feedback)) = (self.off, self.last) {
            let is_off = (low..=high).contains(&feedback.position[0]);
            segment.inject(0, InjectedFault::ProbeOff(is_off), hands.now_ns);
            if feedback.position[0] > high {
                self.off = None;
            }
        }
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
        if let (true, Some(search)) = (is_over, &mut self.then) {
            search.tick(hands, segment);
            return;
        }
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
    homed_in(setup, HomeCase::of(times))
}

fn homed_in(setup: &Setup, mut case: HomeCase) -> (HomeCase, Outcome) {
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
    segment.add_probe(probe());
    let outcome = run_on(setup, &mut case, segment, START_NS);
    assert_eq!(outcome.allocations, 0, "the bus thread allocates");
    assert_eq!(case.ends.len(), case.times);
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
    let case = HomeCase {
        then: Some(Search::new(&["G21 G90 F1200\nG38.2 Z-5\n"])),
        ..HomeCase::of(3)
    };
    let (case, _) = homed_in(&by_index(2_000_000, BEHIND, Some(TOUCH)), case);
    for end in &case.ends {
        let off = place(end, &BEHIND) - impulse(-1);
        assert!(off.abs() <= 1.5 / COUNTS, "{off}");
        let (feedback, last, _) = end;
        assert_eq!(
            (last.index, feedback.index_armed, feedback.index_kept),
            (0, 0, 0)
        );
    }
    // All drives have kept the contact, the one that came home by its touch probe among them.
    let latch = case.last.unwrap().latch[0];
    assert_eq!((latch.count, latch.kind), (1, LatchKind::Drive.code()));
    let contact = case.then.unwrap().found[0].contact;
    assert!((contact[2] - PART_Z).abs() <= 1.5 / COUNTS, "{contact:?}");
    assert!(
        (contact[0] - BEHIND.home).abs() <= 1.5 / COUNTS,
        "{contact:?}"
    );
}

#[test]
fn a_drive_that_is_asked_by_its_mailbox_keeps_it_as_well() {
    let changes: [fn(&mut Setup); 4] = [
        |setup| setup.emulated[0].touch_probe.as_mut().unwrap().is_mappable = false,
        |setup| {
            setup.drives[0].mapping = Mapping::Kept;
            setup.emulated[0].maps = Maps::Fixed {
                outputs: vec![0x6040_0010, 0x607a_0020, 0x60b8_0010],
                inputs: vec![0x6041_0010, 0x6064_0020],
            };
        },
        // What it answers is in the process data, and what it is told is not.
        |setup| {
            setup.drives[0].mapping = Mapping::Kept;
            setup.emulated[0].maps = Maps::Fixed {
                outputs: vec![0x6040_0010, 0x607a_0020],
                inputs: vec![
                    0x6041_0010,
                    0x6064_0020,
                    0x60b9_0010,
                    0x60ba_0020,
                    0x60bb_0020,
                ],
            };
        },
        |setup| setup.drives[0].index = Some(2),
    ];
    for (case, change) in changes.into_iter().enumerate() {
        // At the higher speed it is at the end of its way before its drive has told what it keeps.
        for latch_v in [2.0, 20.0] {
            let homing = JointHoming { latch_v, ..ALONE };
            let mut setup = by_index(4_000_000, homing, None);
            change(&mut setup);
            let (seen, _) = homed(&setup, 2);
            // The second time it sets out from its home, below the same impulse.
            for end in &seen.ends {
                let off = place(end, &homing) - impulse(0);
                assert!(off.abs() <= 1.5 / COUNTS, "{case} {latch_v}: {off}");
            }
        }
    }
}

#[test]
fn a_drive_that_loses_its_readiness_under_way_does_not_come_home_a_turn_off() {
    // The first impulse is in there, and the next one within the way.
    let homing = JointHoming {
        search_travel: 12.0,
        ..ALONE
    };
    let setup = by_index(4_000_000, homing, None);
    let case = HomeCase {
        off: Some((0.6, 1.5)),
        ..HomeCase::of(1)
    };
    let (case, _) = homed_in(&setup, case);
    let told = why(&case.ends[0]);
    assert!(
        told.contains("not ready any more for the index pulse while the joint moved"),
        "{told}"
    );
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

/// Why a bus does not come up.
fn refusal(setup: Setup) -> String {
    let settings = Settings {
        bus: setup.bus,
        drives: setup.drives,
        drive_inputs: setup.drive_inputs,
        terminals: setup.terminals,
        servo: crate::machine::servo(),
    };
    let mut wire = MemoryWire::new(Segment::new(&setup.emulated), Quiet, 0);
    let pre_op = Init::find(&mut wire).unwrap().into_pre_op().unwrap();
    pre_op.into_safe_op(&settings).unwrap_err().to_string()
}

#[test]
fn a_drive_without_a_touch_probe_is_refused_by_name() {
    let mut setup = by_index(4_000_000, ALONE, None);
    setup.emulated[0] = Emulated::default();
    let told = refusal(setup);
    assert!(
        told.contains("device 0") && told.contains("leave `index` out of its table"),
        "{told}"
    );
}

#[test]
fn a_drive_that_does_not_take_the_zero_impulse_is_refused_by_name() {
    let mut setup = by_index(4_000_000, ALONE, None);
    setup.emulated[0].touch_probe.as_mut().unwrap().refuses_zero = true;
    let told = refusal(setup);
    for part in [
        "device 0",
        "the drive of J0 does not keep the zero impulse",
        "0x60b8:0 was refused: abort code 0x06090030",
        "leave `index` out of its table",
    ] {
        assert!(told.contains(part), "{told}");
    }
}
