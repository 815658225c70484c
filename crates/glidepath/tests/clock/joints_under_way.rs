//! Tests of joints in motion: they keep their limits whatever the operator does: holds and
//! overrides change the motion without knowing of joints, by the limits of the axes alone.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test that fails may panic"
)]

use glidepath::config::{self, MachineConfig};
use glidepath_geometry::AxisVector;
use glidepath_interpolator::{Config, Stepped, stepped};
use glidepath_kinematics::{JointVector, Kinematics as _};
use glidepath_link::{Command, MachineState, Setpoint, SetpointFrame};
use glidepath_planner::{Output, Pipeline, ProgramSource};

const HEXAPOD: &str = include_str!(concat!(
    env!("CARGO_MANIFEST_DIR"),
    "/../../config/hexapod.toml"
));
const PROGRAM: &str = include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/examples/hexapod.ngc"));
/// More than the slowest case takes.
const TICKS: u64 = 40_000;

/// The shipped hexapod with joints weaker than its axes.
fn machine() -> MachineConfig {
    let text = HEXAPOD
        .replace("max_velocity = 120.0", "max_velocity = 20.0")
        .replace("max_acceleration = 1500.0", "max_acceleration = 500.0")
        .replace("max_jerk = 40000.0", "max_jerk = 9000.0");
    config::parse("hexapod.toml", &text).unwrap()
}

fn frames(machine: &MachineConfig) -> Vec<SetpointFrame> {
    let home = machine.home();
    let source = ProgramSource::new(PROGRAM.as_bytes(), machine.program_options(home));
    let mut pipeline =
        Pipeline::new(source, machine.settings(), home).with_joints(machine.limited_mechanism());
    let mut frames = Vec::new();
    loop {
        match pipeline.advance().unwrap() {
            Output::Frame(frame) => frames.push(SetpointFrame {
                block: pipeline.block(),
                ..SetpointFrame::from_frame(&frame, 1, machine.period_ns())
            }),
            Output::End => return frames,
            Output::Item(_) | Output::Pending => {}
        }
    }
}

/// Largest share of velocity, acceleration and jerk that any joint used, by differences.
#[derive(Debug, Default)]
struct Shares {
    last: Vec<JointVector>,
    most: [f64; 3],
}

impl Shares {
    fn add(&mut self, machine: &MachineConfig, position: &AxisVector) {
        self.last
            .insert(0, machine.mechanism.inverse(position).unwrap());
        self.last.truncate(4);
        let [a, b, c, d] = self.last[..] else { return };
        let period_t = machine.period_t();
        let differences = [
            (a - b) / period_t,
            (a - b * 2.0 + c) / period_t.powi(2),
            (a - b * 3.0 + c * 3.0 - d) / period_t.powi(3),
        ];
        let joints = machine.joint_limits.0.iter().take(machine.joints());
        for (joint, limit) in joints.enumerate() {
            let limits = [limit.velocity, limit.acceleration, limit.jerk];
            for ((most, difference), limit) in self.most.iter_mut().zip(&differences).zip(limits) {
                *most = most.max(difference[joint].abs() / limit);
            }
        }
    }
}

/// Plays a program while the operator gives a command, or none, after the setpoint of each tick;
/// the shares used.
fn play(
    machine: &MachineConfig,
    frames: &[SetpointFrame],
    mut operator: impl FnMut(u64, &Setpoint) -> Option<Command>,
) -> Shares {
    let periods = machine.interpolator.horizon_t / machine.period_t();
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a few hundred"
    )]
    let horizon = periods.floor() as u64;
    let config = Config {
        start_position: machine.home(),
        horizon_frames: horizon,
        mechanism: machine.mechanism,
        joint_limits: machine.joint_limits,
        hand_limits: machine.limits(),
        ..Config::new(machine.axis_limits(), machine.period_ns())
    };
    stepped(&config, |desk: &mut Stepped<'_>| {
        let (mut sent, mut shares) = (0, Shares::default());
        let mut executed = 0;
        for tick in 0..TICKS {
            while let Some(frame) = frames.get(sent)
                && frame.sequence < executed + horizon
                && desk.offer(frame)
            {
                sent += 1;
            }
            let setpoint = desk.tick();
            executed = setpoint.sequence;
            if let Some(command) = operator(tick, &setpoint) {
                desk.command(command);
            }
            shares.add(machine, &setpoint.position.into());
            if setpoint.epoch > 0 && setpoint.state() == Ok(MachineState::Idle) {
                return shares;
            }
        }
        panic!(
            "the program does not come to its end: {executed} of {}",
            frames.len()
        );
    })
}

#[test]
fn joints_keep_their_limits_in_holds_and_overrides() {
    let machine = machine();
    let frames = frames(&machine);
    assert!(machine.axis_share.acceleration < 1.0 && machine.axis_share.jerk < 1.0);
    let cases: [&[(u64, Command)]; 3] = [
        &[],
        &[
            (237, Command::Hold),
            (413, Command::Resume),
            (651, Command::Hold),
            (660, Command::Resume),
        ],
        &[
            (20, Command::FeedOverride(0.2)),
            (171, Command::FeedOverride(1.0)),
            (303, Command::RapidOverride(0.25)),
            (440, Command::RapidOverride(1.0)),
        ],
    ];
    for commands in cases {
        let round = commands.last().map_or(1, |(tick, _)| tick + 1);
        let shares = play(&machine, &frames, |tick, _| {
            let mut due = commands.iter().filter(|(at, _)| *at == tick % round);
            due.next().map(|(_, command)| *command)
        });
        println!("{:?}", shares.most);
        assert!(
            shares.most.iter().all(|share| *share <= 1.0 + 1e-6),
            "{commands:?}: {:?}",
            shares.most
        );
        assert!(shares.most[0] > 0.3, "it moved: {:?}", shares.most);
    }
}

/// Stops of a slow machine take long: here, more ticks than there are samples in the budget of one.
#[test]
fn single_block_rests_at_the_end_of_every_block() {
    let machine = machine();
    let frames = frames(&machine);
    let ends = frames
        .windows(2)
        .filter(|pair| pair[0].block > 0 && pair[0].block != pair[1].block);
    let ends: Vec<u64> = ends.map(|pair| pair[0].sequence).collect();
    assert!(ends.len() >= 5, "{ends:?}");
    let mut stands = Vec::new();
    let shares = play(&machine, &frames, |tick, setpoint| {
        if tick == 10 {
            return Some(Command::SingleBlock(true));
        }
        let stands_anew = setpoint.state() == Ok(MachineState::ProgramStop)
            && stands.last() != Some(&setpoint.sequence);
        stands_anew.then(|| {
            assert!(setpoint.fraction <= 0.0);
            stands.push(setpoint.sequence);
            Command::Step
        })
    });
    assert_eq!(stands, ends);
    assert!(
        shares.most.iter().all(|share| *share <= 1.0 + 1e-6),
        "{:?}",
        shares.most
    );
}
