//! Tests of a superposition with drives that answer: both motions together keep to the limits whatever the torch says,
//! and holds, aborts and ends leave the axis where it is.

use super::bench::{Bench, config, numbers};
use crate::shared::config::superposition::{Superposition, SuperpositionControl};
use crate::shared::config::{Config, SoftLimits};
use crate::testing::{audit, blocks, planned, random_cases};
use bytemuck::Zeroable as _;
use glidepath_geometry::{Axis, AxisVector, Segment};
use glidepath_link::{Command, JogDemand, JogMode, MachineState, Setpoint, SuperpositionState};
use glidepath_plant::{InjectedFault, JointSettings};
use glidepath_program::{Effort, Event, ItemKind, Limits, PathMode, Rate};

const INPUT: usize = 4;
const SHARE: f64 = 0.25;
const RANGE: [f64; 2] = [-4.0, 6.0];
/// What the drives can do.
fn drives() -> Limits {
    crate::testing::mill()
}

fn torch() -> Superposition {
    let z = Axis::Z.index();
    let drives = drives();
    Superposition {
        axis: Axis::Z,
        velocity: SHARE * drives.velocity[z],
        acceleration: SHARE * drives.acceleration[z],
        jerk: SHARE * drives.jerk[z],
        range: RANGE,
        input: INPUT as u8,
        control: SuperpositionControl::Velocity,
        target: 120.0,
        // 8 V for each millimetre: 6 mm/s for each millimetre that the torch is too high or too low.
        gain: -6.0 / 8.0,
        dead_band: 0.0,
        switch: None,
        enable: None,
        freeze_below: 0.9,
        freeze_for_t: 0.1,
        returns: true,
    }
}

fn bench(torch: Superposition) -> Bench {
    bench_within(torch, 0.0, SoftLimits::none())
}

/// The axis of the torch stands at a place.
fn bench_within(torch: Superposition, stands: f64, soft_limits: SoftLimits) -> Bench {
    let joint = |start| JointSettings {
        start,
        count: start,
        ..JointSettings::default()
    };
    let mut limits = drives();
    let z = Axis::Z.index();
    limits.velocity[z] *= 1.0 - SHARE;
    limits.acceleration[z] *= 1.0 - SHARE;
    limits.jerk[z] *= 1.0 - SHARE;
    let settings = Config {
        limits,
        hand_limits: limits,
        superposition: Some(torch),
        soft_limits,
        ..config(false)
    };
    let mut bench = Bench::new(settings, &[joint(0.0), joint(0.0), joint(stands)]);
    bench.enable(MachineState::Idle);
    bench
}

/// The same, and the arc burns at its target.
fn burning(torch: Superposition) -> Bench {
    let mut bench = bench(torch);
    bench.inject(InjectedFault::Analog(INPUT, 120.0));
    bench.run(5);
    bench
}

/// Cuts from point to point at a feed, with events behind the lines of these numbers.
fn cut(bench: &mut Bench, points: &[[f64; 2]], feed_v: f64, events: &[(usize, Event)]) {
    let start = AxisVector::from(bench.last().position);
    let at = |[x, y]: [f64; 2]| {
        let mut place = start;
        (place[0], place[1]) = (x, y);
        place
    };
    let mut from = start;
    let mut kinds = Vec::new();
    for (number, point) in points.iter().enumerate() {
        kinds.push(ItemKind::Move {
            segment: Segment::line(from, at(*point)),
            rate: Rate::Feed(feed_v),
            mode: PathMode::Continuous {
                tolerance_mm: Some(0.05),
            },
        });
        from = at(*point);
        let behind = events.iter().filter(|(line, _)| *line == number);
        kinds.extend(behind.map(|(_, event)| ItemKind::Event(*event)));
    }
    let items = blocks(kinds);
    let mut limits = drives();
    limits.velocity[2] *= 1.0 - SHARE;
    let frames = planned(&items, limits, start, Effort::Fast);
    bench.load_frames(frames);
}

/// Nothing that is published asks more of the drives than they can do, nothing jumps, and the offset stays in its range.
fn assert_inside(bench: &Bench, what: &str) {
    let powered = |s: &&Setpoint| s.enable != 0 && s.state() != Ok(MachineState::Off);
    let joints: Vec<AxisVector> = bench
        .setpoints
        .iter()
        .filter(powered)
        .map(|s| AxisVector::from(s.joint_position))
        .collect();
    let ratios = audit(&joints, &drives(), 0.004);
    let most = ratios.into_iter().fold(0.0, f64::max);
    assert!(most <= 1.0 + 1e-6, "{what}: {most} of what drives can do");
    let worst = bench.worst_ratio();
    assert!(worst <= 1.0 + 1e-6, "{what}: {worst} of what programs have");
    for s in &bench.setpoints {
        let offset = s.superposed[2];
        assert!(
            (RANGE[0] - 1e-9..=RANGE[1] + 1e-9).contains(&offset),
            "{what}"
        );
        let sum = s.position[2] + offset;
        assert!((s.joint_position[2] - sum).abs() < 1e-9, "{what}");
        assert!(s.superposed[0] == 0.0 && s.superposed[1] == 0.0);
    }
}

#[test]
fn whatever_the_torch_says_both_motions_together_keep_to_the_limits() {
    let seeds = u64::from(random_cases(1000) / 25);
    let mut followed = 0;
    for seed in 0..seeds {
        let mut random = numbers(seed);
        let mut bench = burning(torch());
        let mut commanded = 0;
        for _ in 0..3 {
            bench.load(seed, 500);
            for frame in &mut bench.feed {
                frame.programmed_v = frame.path_v.max(1.0);
            }
            let mut value = 120.0;
            for _ in 0..700 {
                match (random.unit() * 60.0).floor() {
                    0.0 => value = 60.0 + 120.0 * random.unit(),
                    1.0 => {
                        let commands = [
                            Command::Hold,
                            Command::Resume,
                            Command::FeedOverride(0.3),
                            Command::FeedOverride(1.0),
                            Command::Reverse,
                            Command::Forward,
                            Command::Abort,
                        ];
                        let any = (random.unit() * commands.len() as f64) as usize;
                        commanded += usize::from(bench.command(commands[any]).is_ok());
                    }
                    _ => value += 4.0 * (random.unit() - 0.5),
                }
                bench.inject(InjectedFault::Analog(INPUT, value));
                bench.tick();
            }
            let _free = bench.command(Command::Abort);
            assert!(bench.run_to(MachineState::Idle, 500), "{seed}");
            bench.feed.clear();
        }
        // An abort may end each of the programs before that.
        let moved = bench.setpoints.iter().map(|s| s.superposed[2].abs());
        followed += u64::from(commanded > 3 && moved.fold(0.0, f64::max) > 0.5);
        assert_eq!(bench.fault(), None, "{seed}");
        assert_inside(&bench, &format!("seed {seed}"));
        bench.assert_no_joint_jumps();
    }
    assert!(followed > seeds * 3 / 4, "{followed} of {seeds}");
}

/// A plate that rises by 20 mm in a metre: the torch keeps its height over it, and does not dive where the corners make
/// the motion slow and the voltage high.
#[test]
fn a_torch_follows_a_tilted_plate_and_does_not_dive_at_corners() {
    let mut bench = burning(torch());
    let square = [[200.0, 0.0], [200.0, 150.0], [0.0, 150.0], [0.0, 0.0]];
    cut(&mut bench, &square, 60.0, &[]);
    let (mut heights, mut lowest) = (Vec::new(), 0.0_f64);
    for tick in 0..6000 {
        let last = bench.last();
        // The height of the tip over the plate, less that of the cut; slower cuts have a longer arc.
        let height = last.joint_position[2] - 0.02 * last.position[0];
        let slow = (1.0 - last.feed_v / 60.0).clamp(0.0, 1.0);
        let volts = 120.0 + 8.0 * height + 25.0 * slow;
        bench.inject(InjectedFault::Analog(INPUT, volts));
        bench.tick();
        if bench.state() == MachineState::Idle && tick > 100 {
            break;
        }
        if tick > 250 {
            lowest = lowest.min(height);
            heights.push(height);
        }
    }
    assert_eq!(bench.state(), MachineState::Idle);
    #[allow(clippy::cast_precision_loss, reason = "thousands")]
    let mean = heights.iter().map(|h| h.abs()).sum::<f64>() / heights.len() as f64;
    // Along X at 60 mm/s the plate rises by 1.2 mm/s: with 6 mm/s a millimetre that is .2 mm behind.
    assert!(mean < 0.2, "{mean}");
    assert!(lowest > -0.45, "it dives by {lowest}");
    assert_inside(&bench, "plate");
}

#[test]
fn at_an_abort_both_come_to_rest_and_the_offset_is_part_of_the_position() {
    let mut bench = burning(torch());
    cut(&mut bench, &[[300.0, 0.0]], 50.0, &[]);
    bench.inject(InjectedFault::Analog(INPUT, 112.0));
    bench.run(300);
    assert_eq!(
        bench.status().superposition(),
        Ok(SuperpositionState::Follows)
    );
    let moving = bench.last();
    assert!(moving.superposed[2] > 1.0 && moving.position[2] == 0.0);
    bench.command(Command::Hold).unwrap();
    assert!(bench.run_to(MachineState::Held, 200));
    let held = bench.last();
    bench.run(100);
    assert_eq!(bench.last().joint_position, held.joint_position);
    assert_eq!(
        bench.status().superposition(),
        Ok(SuperpositionState::Frozen)
    );
    bench.command(Command::Resume).unwrap();
    bench.run(100);
    bench.command(Command::Abort).unwrap();
    assert!(bench.run_to(MachineState::Idle, 200));
    let ended = bench.last();
    bench.tick();
    let after = bench.last();
    assert_eq!(after.joint_position, ended.joint_position);
    assert!((after.position[2] - ended.position[2] - ended.superposed[2]).abs() < 1e-12);
    assert_eq!(
        (after.superposed[2], after.reference),
        (0.0, ended.reference + 1)
    );
    // The next program begins there.
    cut(&mut bench, &[[0.0, 0.0]], 50.0, &[]);
    assert!(bench.run_to(MachineState::Running, 50));
    assert!(bench.run_to(MachineState::Idle, 5000));
    assert_eq!(bench.fault(), None);
    assert_inside(&bench, "abort");
}

#[test]
fn programs_switch_it_by_an_output_and_it_returns_while_they_move() {
    let torch = Superposition {
        switch: Some(3),
        ..torch()
    };
    let mut bench = burning(torch);
    let output = |on| Event::DigitalOutput { number: 3, on };
    let points = [[40.0, 0.0], [140.0, 0.0], [240.0, 0.0]];
    cut(
        &mut bench,
        &points,
        50.0,
        &[(0, output(true)), (1, output(false))],
    );
    bench.inject(InjectedFault::Analog(INPUT, 114.0));
    assert!(bench.run_to(MachineState::Running, 50));
    assert!(bench.run_to(MachineState::Idle, 5000));
    let offset_at = |x: f64| {
        let passed = bench.setpoints.iter().find(|s| s.position[0] >= x);
        passed.unwrap().superposed[2]
    };
    assert_eq!(offset_at(39.9), 0.0);
    assert!(offset_at(130.0) > 2.0, "{}", offset_at(130.0));
    assert_eq!(offset_at(230.0), 0.0);
    assert_eq!(bench.last().reference, 2, "nothing was left to be taken");
    assert_inside(&bench, "switched");
}

/// While a program cuts a wheel moves the offset; in a hold it jogs, and what it turned meanwhile is not made up for.
#[test]
fn a_wheel_moves_the_offset_while_the_program_cuts() {
    let torch = Superposition {
        control: SuperpositionControl::Wheel,
        ..torch()
    };
    let mut bench = bench(torch);
    cut(&mut bench, &[[300.0, 0.0]], 40.0, &[]);
    assert!(bench.run_to(MachineState::Running, 50));
    bench.run(100);
    let turn = |bench: &mut Bench, number: u64, counts: f64| {
        let mut demand = JogDemand::zeroed();
        (demand.client, demand.number, demand.mask) = (9, number, 1 << 2);
        (demand.sent_ns, demand.asked_ns) = (bench.now_ns(), bench.now_ns());
        (demand.mode, demand.scale) = (JogMode::Wheel.code(), 0.01);
        demand.value[2] = counts;
        bench.jog(&demand);
        bench.tick();
    };
    turn(&mut bench, 1, 1000.0);
    bench.run(50);
    assert_eq!(
        bench.last().superposed[2],
        0.0,
        "what it had counted before is not meant"
    );
    turn(&mut bench, 2, 1030.0);
    bench.run(200);
    assert_eq!(bench.last().superposed[2], 0.3);
    turn(&mut bench, 3, 0.0);
    bench.run(400);
    assert_eq!(bench.last().superposed[2], RANGE[0]);
    assert_eq!(bench.last().position[2], 0.0);
    bench.command(Command::Hold).unwrap();
    assert!(bench.run_to(MachineState::Held, 200));
    turn(&mut bench, 4, 100.0);
    bench.run(300);
    let jogged = bench.last();
    assert_eq!((jogged.superposed[2], jogged.away[2]), (RANGE[0], 1.0));
    bench.command(Command::Return).unwrap();
    assert!(bench.run_to(MachineState::Held, 500));
    bench.command(Command::Resume).unwrap();
    bench.run(100);
    assert_eq!(bench.last().superposed[2], RANGE[0]);
    assert!(bench.run_to(MachineState::Idle, 5000));
    assert_eq!(bench.fault(), None);
    assert_inside(&bench, "wheel");
}

#[test]
fn it_stands_where_nobody_sends_its_input() {
    let mut bench = bench(torch());
    cut(&mut bench, &[[200.0, 0.0]], 50.0, &[]);
    bench.run(200);
    assert_eq!(
        bench.status().superposition(),
        Ok(SuperpositionState::Silent)
    );
    assert_eq!(bench.last().superposed[2], 0.0);
}

/// A program that ended with an offset leaves the axis outside of what programs have of its travel. The next one may
/// leave it there and bring it inwards, and no offset takes it out of the travel of the machine.
#[test]
fn an_axis_that_an_offset_left_outside_may_stay_or_come_inwards_and_stays_in_the_travel_of_the_machine()
 {
    let top = 50.0;
    let mut soft_limits = SoftLimits::none();
    soft_limits.highest[2] = top;
    let mut bench = bench_within(torch(), top - 1.0, soft_limits);
    bench.inject(InjectedFault::Analog(INPUT, 120.0));
    bench.run(5);
    let abort = |bench: &mut Bench, volts: f64| {
        bench.inject(InjectedFault::Analog(INPUT, volts));
        assert!(bench.run_to(MachineState::Running, 50));
        bench.run(900);
        bench.command(Command::Abort).unwrap();
        assert!(bench.run_to(MachineState::Idle, 200));
        bench.run(2);
    };
    cut(&mut bench, &[[300.0, 0.0]], 50.0, &[]);
    abort(&mut bench, 112.0);
    let outside = bench.last().position[2];
    assert!((outside - (top - 1.0 + RANGE[1])).abs() < 1e-9, "{outside}");
    // It stays, and the torch still asks for more than there is left.
    cut(&mut bench, &[[0.0, 0.0]], 50.0, &[]);
    abort(&mut bench, 112.0);
    assert_eq!(bench.fault(), None);
    let stays = bench.last().position[2];
    assert!((stays - (top + RANGE[1])).abs() < 1e-9, "{stays}");
    // Downwards there is all of the range, and it comes inwards.
    cut(&mut bench, &[[300.0, 0.0]], 50.0, &[]);
    abort(&mut bench, 128.0);
    let inwards = bench.last().position[2];
    assert!((inwards - (stays + RANGE[0])).abs() < 1e-9, "{inwards}");
    let highest = bench.setpoints.iter().map(|s| s.joint_position[2]);
    assert!(highest.fold(0.0, f64::max) <= top + RANGE[1] + 1e-9);
    assert_inside(&bench, "outside");
}
