//! The bridge is told to end: at rest, with the last of the motion still to be played, or in motion.

use crate::judge::rounding;
use crate::machine::{Case, Hands, Outcome, Setup, run};
use glidepath_emulator::Segment;
use glidepath_link::{Command, MachineState};

const PROGRAM: &str = "G21 G90 G64 P0.02 G1 X40 Y12 F9000\nX2 Y-3\nM2\n";
const END: [f64; 3] = [2.0, -3.0, 0.0];

/// When the bridge is told to end.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum When {
    /// So many ticks after the motion began.
    Moving(u64),
    /// As soon as a setpoint is at rest behind the motion.
    AtRest,
}

#[derive(Debug)]
struct Ending {
    when: When,
    asked: u64,
    began: Option<u64>,
}

impl Case for Ending {
    fn tick(&mut self, hands: &mut Hands<'_>, _: &mut Segment) {
        assert!(hands.tick < 10_000, "{:?} {:?}", hands.state(), self);
        match (hands.state(), self.began) {
            (Some(MachineState::Off), None) if hands.tick > self.asked + 25 => {
                self.asked = hands.tick;
                hands.wants.command = Some(Command::Enable);
            }
            (Some(MachineState::Idle), None) => {
                self.began = Some(hands.tick);
                hands.wants.program = Some(PROGRAM);
            }
            (_, Some(began)) => {
                let is_behind = hands.tick > began + 50
                    && hands
                        .last
                        .is_some_and(|last| last.velocity.iter().all(|v| v.abs() == 0.0));
                hands.wants.end = match self.when {
                    When::Moving(ticks) => hands.tick >= began + ticks,
                    When::AtRest => is_behind,
                };
            }
            _ => {}
        }
    }
}

fn ended(setup: &Setup, when: When) -> Outcome {
    let mut case = Ending {
        when,
        asked: 0,
        began: None,
    };
    let outcome = run(setup, &mut case);
    let last = outcome.records[0].last().unwrap();
    assert!(!last.follows, "without power at the end");
    outcome
}

/// Setpoints that are played as soon as they can be, and as late as on a desk.
fn setups() -> impl Iterator<Item = Setup> {
    [2_000_000, 4_000_000].into_iter().flat_map(|period_ns| {
        [0, 10_000_000].map(|more_ns| {
            let mut setup = Setup::absolute(period_ns);
            setup.bus.delay_ns += more_ns;
            setup
        })
    })
}

/// The largest velocity, acceleration and jerk of what a drive was told, of the limits. Not by the
/// auditor, for which what ends in motion stops there.
fn ratios(setup: &Setup, told: &[f64]) -> [f64; 3] {
    let period_t = setup.bus.period_ns as f64 * 1e-9;
    let mut differences = told.to_vec();
    [200.0, 2000.0, 40_000.0].map(|limit| {
        let pairs = differences.windows(2);
        differences = pairs.map(|pair| (pair[1] - pair[0]) / period_t).collect();
        differences
            .iter()
            .fold(0.0_f64, |most, x| most.max(x.abs()))
            / limit
    })
}

#[test]
fn in_motion_the_joints_come_to_rest_from_where_they_are() {
    for setup in setups() {
        for ticks in [20, 33, 50] {
            let outcome = ended(&setup, When::Moving(ticks));
            // Until the interpolator sees that nobody follows it, and takes the power.
            let led = outcome.setpoints.iter().rposition(|s| s.enable != 0);
            let until_ns = outcome.setpoints[led.unwrap() + 1].scheduled_ns;
            for (drive, records) in setup.drives.iter().zip(&outcome.records) {
                let led = records.iter().filter(|r| r.follows && r.at_ns < until_ns);
                let told: Vec<f64> = led.map(|record| drive.place(record.target)).collect();
                let case = (setup.bus.period_ns, setup.bus.delay_ns, ticks, drive.joint);
                for (ratio, nth) in ratios(&setup, &told).into_iter().zip(1..) {
                    // The stop begins inside a period of the setpoints.
                    let most = 1.05 + rounding(&setup, nth);
                    assert!(ratio <= most, "{case:?}, difference {nth}: {ratio}");
                }
            }
        }
    }
}

#[test]
fn at_rest_the_motion_is_played_to_its_end_before() {
    for setup in setups() {
        let outcome = ended(&setup, When::AtRest);
        for (drive, records) in setup.drives.iter().zip(&outcome.records) {
            let led = records.iter().rfind(|record| record.follows).unwrap();
            let off = drive.place(led.target) - END[drive.joint];
            let case = (setup.bus.period_ns, setup.bus.delay_ns, drive.joint);
            assert!(off.abs() <= 0.51 / drive.counts_per_unit, "{case:?}: {off}");
        }
    }
}
