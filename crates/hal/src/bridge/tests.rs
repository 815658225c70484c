//! Tests of the bridge, with rows as a HAL would send them.

#![allow(
    clippy::float_cmp,
    reason = "what is passed on stays the same to the bit"
)]

use super::*;
use glidepath_link::Record as _;

const PERIOD: u64 = 1_000_000;
const PREFILL: u32 = 8;

/// HAL with a machine that goes at once where it is told to while it has power.
#[derive(Debug, Default)]
struct Fake {
    fifo: VecDeque<(u32, bool, f64)>,
    tick: u32,
    asked: bool,
    power: bool,
    is_broken: bool,
    place: f64,
    /// What it had played, by tick.
    played: Vec<(u32, f64)>,
}

impl Fake {
    fn take(&mut self, text: &str) {
        for line in text.lines() {
            let words: Vec<&str> = line.split(' ').collect();
            let number = |at: usize| words[at].parse::<f64>().unwrap();
            self.fifo
                .push_back((words[0].parse().unwrap(), words[1] == "1", number(2)));
        }
    }

    fn period(&mut self) -> Row {
        let was_asked = self.asked;
        let is_empty = self.fifo.is_empty();
        let mut told = self.place;
        if let Some((tick, asked, place)) = self.fifo.pop_front() {
            (self.tick, self.asked, told) = (tick, asked, place);
        }
        if self.asked && !was_asked {
            self.is_broken = false;
        }
        self.is_broken |= is_empty;
        self.power = self.asked && !self.is_broken;
        if self.power {
            self.place = told;
            self.played.push((self.tick, told));
        }
        let mut position = [0.0; 9];
        position[0] = self.place;
        Row {
            tick: self.tick,
            depth: i64::try_from(self.fifo.len()).unwrap(),
            has_power: self.power,
            has_fault: self.asked && self.is_broken,
            position,
            home_switch: 0,
        }
    }
}

fn on() -> Setpoint {
    Setpoint {
        enable: 1,
        reference: 4,
        number: 77,
        ..Setpoint::zeroed()
    }
}

fn at(place: f64, velocity: f64) -> Option<JointStates> {
    let mut joints = [JointState::default(); 9];
    (joints[0].position, joints[0].velocity) = (place, velocity);
    Some(joints)
}

/// To and fro within 10 mm.
fn moving(time_ns: u64) -> Option<JointStates> {
    #[allow(clippy::cast_precision_loss, reason = "seconds")]
    let time_t = time_ns as f64 * 1e-9;
    at(10.0 * time_t.sin(), 10.0 * time_t.cos())
}

fn bridge() -> Bridge {
    Bridge::new(Layout::new(1).unwrap(), PERIOD, PREFILL, 9)
}

/// Runs both for some periods, from one on.
fn run(
    bridge: &mut Bridge,
    hal: &mut Fake,
    periods: std::ops::Range<u64>,
    setpoint: Option<&Setpoint>,
    demand: impl Fn(u64) -> Option<JointStates>,
) -> Option<Feedback> {
    let mut last = None;
    for index in periods {
        let mut lines = String::new();
        bridge.write(index * PERIOD, setpoint, &demand, &mut lines);
        hal.take(&lines);
        last = bridge.take(hal.period()).or(last);
        if let Some(feedback) = &last {
            feedback.check().unwrap();
        }
    }
    last
}

#[test]
fn nothing_is_written_before_it_is_known_where_the_joints_stand() {
    let (mut bridge, mut lines) = (bridge(), String::new());
    bridge.write(5 * PERIOD, Some(&on()), moving, &mut lines);
    assert_eq!(lines, "");
}

#[test]
fn the_fifo_is_filled_with_the_place_of_the_joints_and_they_lead_without_power() {
    let (mut bridge, mut hal) = (bridge(), Fake::default());
    hal.place = 3.25;
    assert_eq!(bridge.take(hal.period()), None);
    let mut lines = String::new();
    bridge.write(1000 * PERIOD, None, moving, &mut lines);
    // So many to be held back, and that of this period is the last of them.
    assert_eq!(lines.lines().count(), PREFILL as usize);
    assert!(lines.lines().all(|line| line == "1000 0 3.25 0"), "{lines}");
    hal.take(&lines);
    // Somebody moves it by hand.
    hal.place = 4.0;
    let said = run(&mut bridge, &mut hal, 1001..1020, None, |_| None).unwrap();
    assert_eq!((said.position[0], said.enabled, said.fault), (4.0, 0, 0));
    assert_eq!(hal.fifo.back().unwrap().2, 4.0);
}

#[test]
fn with_power_it_stays_until_there_is_a_demand_and_then_plays_every_one_of_them() {
    let (mut bridge, mut hal) = (bridge(), Fake::default());
    hal.place = 3.0;
    run(&mut bridge, &mut hal, 1000..1050, None, |_| None);
    let said = run(&mut bridge, &mut hal, 1050..1100, Some(&on()), |_| None).unwrap();
    assert_eq!((said.enabled, said.position[0]), (1, 3.0));
    assert_eq!((said.reference, said.setpoint_number), (4, 77));
    let said = run(&mut bridge, &mut hal, 1100..2100, Some(&on()), moving).unwrap();
    assert_eq!(
        (said.enabled, said.fault, bridge.counts().underruns),
        (1, 0, 0)
    );
    // Stamped with the time that its line was for: so it is where it was to be then.
    let expected = moving(said.sample_ns).unwrap()[0];
    assert_eq!(said.position[0], expected.position);
    assert!((said.velocity[0] - expected.velocity).abs() < 0.1);
    // A line is for a period as long ago as the FIFO is deep.
    assert_eq!(said.sample_ns, (2099 - u64::from(PREFILL) + 1) * PERIOD);
    let ticks: Vec<u32> = hal.played.iter().map(|(tick, _)| *tick).collect();
    assert!(ticks[100..].windows(2).all(|two| two[1] == two[0] + 1));
}

#[test]
fn a_late_bridge_writes_every_line_and_an_empty_fifo_is_a_fault_until_power_is_asked_anew() {
    let (mut bridge, mut hal) = (bridge(), Fake::default());
    run(&mut bridge, &mut hal, 1000..1050, None, |_| None);
    run(&mut bridge, &mut hal, 1050..1400, Some(&on()), moving);
    // Late by less than the FIFO holds: nothing happens.
    for _ in 0..PREFILL - 1 {
        bridge.take(hal.period());
    }
    let said = run(&mut bridge, &mut hal, 1407..1500, Some(&on()), moving).unwrap();
    assert_eq!((said.enabled, bridge.counts().underruns), (1, 0));
    // By more.
    let mut said = None;
    for _ in 0..PREFILL {
        said = bridge.take(hal.period());
    }
    let said = said.unwrap();
    assert_eq!((said.enabled, said.fault), (0, 1));
    assert_eq!((said.fault_code[0], bridge.counts().underruns), (2, 1));
    assert_eq!(said.drive_state[0], DriveState::Fault.code());
    let place = hal.place;
    let said = run(&mut bridge, &mut hal, 1508..1520, Some(&on()), moving).unwrap();
    assert_eq!((said.enabled, hal.place), (0, place));
    let said = run(&mut bridge, &mut hal, 1520..1600, None, |_| None).unwrap();
    assert_eq!((said.enabled, said.fault), (0, 0));
    let said = run(&mut bridge, &mut hal, 1600..1700, Some(&on()), |_| None).unwrap();
    assert_eq!((said.enabled, said.position[0]), (1, place));
}

#[test]
fn a_bridge_that_was_away_for_long_fills_the_fifo_again() {
    let (mut bridge, mut hal) = (bridge(), Fake::default());
    run(&mut bridge, &mut hal, 1000..1050, None, |_| None);
    run(&mut bridge, &mut hal, 1050..1400, Some(&on()), moving);
    let away = GIVEN_UP + 10;
    for _ in 0..away {
        bridge.take(hal.period());
    }
    let back = 1400 + away;
    run(&mut bridge, &mut hal, back..back + 2, None, |_| None);
    assert_eq!(hal.fifo.len(), PREFILL as usize - 1);
    // Power that is asked for now stays, though it comes late by what the FIFO holds.
    let place = hal.place;
    let mut said = run(
        &mut bridge,
        &mut hal,
        back + 2..back + 20,
        Some(&on()),
        |_| None,
    );
    for _ in 0..PREFILL - 2 {
        said = bridge.take(hal.period());
    }
    let said = said.unwrap();
    assert_eq!((said.enabled, said.fault, said.position[0]), (1, 0, place));
}

#[test]
fn the_fifo_is_brought_to_its_depth_at_rest_and_never_in_motion() {
    let (mut bridge, mut hal) = (bridge(), Fake::default());
    run(&mut bridge, &mut hal, 1000..1050, None, |_| None);
    // HAL stands still for twenty periods: the FIFO holds so many more from then on.
    for index in 1050..1070 {
        let mut lines = String::new();
        bridge.write(index * PERIOD, Some(&on()), |_| at(0.0, 0.0), &mut lines);
        hal.take(&lines);
    }
    run(&mut bridge, &mut hal, 1070..2000, Some(&on()), moving);
    assert_eq!(hal.fifo.len(), PREFILL as usize - 1 + 20);
    assert_eq!(bridge.counts().recentred, 0);
    let place = hal.played.last().unwrap().1;
    run(&mut bridge, &mut hal, 2000..2700, Some(&on()), |_| {
        at(place, 0.0)
    });
    assert!(hal.fifo.len().abs_diff(PREFILL as usize) <= 2);
    assert!(bridge.counts().recentred >= 18);
    // And the other way.
    for _ in 0..5 {
        bridge.take(hal.period());
    }
    run(&mut bridge, &mut hal, 2705..3400, Some(&on()), |_| {
        at(place, 0.0)
    });
    assert!(hal.fifo.len().abs_diff(PREFILL as usize) <= 2);
    assert_eq!(bridge.counts().underruns, 0);
}

#[test]
fn rows_without_a_tick_of_ours_say_nothing() {
    let (mut bridge, mut hal) = (bridge(), Fake::default());
    run(&mut bridge, &mut hal, 1000..1010, None, |_| None);
    let mut row = hal.period();
    row.tick = 5;
    assert_eq!(bridge.take(row), None);
    assert_eq!(bridge.unknown_rows(), 1);
}
