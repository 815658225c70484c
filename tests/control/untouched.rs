//! Tests of motion that nobody touches: it is played as it was planned, however hard the plan is to
//! stop on: it has a stop in reserve at every tick, and is not slowed down for want of one.

use glidepath_tests::pocket;

use crate::supervisor::{Job, Supervisor, assert_limits, jobs};
use crate::times;

/// Near-optimal plans at the limits of several axes for longer than a stop takes.
const HARD: [&str; 3] = [
    "G21 G90 G94 G17 F1980
    O200 sub
    G0 X[#1+0.6688] Y#2
    G0 Z0.2
    #9=0.2
    O210 repeat [4]
    #9=[#9-0.4146]
    G2 X[#1+0.6688] Y#2 Z#9 I-0.6688 J0
    O210 endrepeat
    G2 X[#1+0.6688] Y#2 I-0.6688 J0
    G0 Z2
    O200 endsub
    O200 call [9.6074] [14.5722]
    O200 call [-7.7341] [1.2345]
    M2",
    "G21 G90 G94 G17 F5784
    G3 X-3.242555 Y0.000000 I-1.621278 J0.000000
    G3 X1.297022 Y0.000000 I2.269789 J0.000000
    G3 X-4.539577 Y0.000000 I-2.918300 J0.000000
    G3 X2.594044 Y0.000000 I3.566811 J0.000000
    G3 X-5.836599 Y0.000000 I-4.215322 J0.000000
    G3 X3.891066 Y0.000000 I4.863833 J0.000000
    M2",
    "G21 G90 G94 G17 F4628
    G3 X0.000000 Y0.000000 Z-0.270530 I-1.745403 J0.000000
    G3 X0.000000 Y0.000000 Z-0.541059 I-1.745403 J0.000000
    G3 X0.000000 Y0.000000 Z-0.811589 I-1.745403 J0.000000
    G3 X0.000000 Y0.000000 I-1.745403 J0.000000
    G1 X-1.745403 Y0.000000 Z-0.811589
    G1 X-1.745403 Y0.000000 Z1.000000
    M2",
];

#[test]
fn nobody_slows_down_what_is_hard_to_stop_on() {
    let hard = HARD.map(|text| Job::text(text.to_owned()));
    let pockets = (0..if times() > 1 { 10 } else { 0 }).map(|form| Job::text(pocket(60, form)));
    for (job, n) in hard.into_iter().chain(pockets).zip(0..) {
        job.supervised(|supervisor| assert_as_planned(supervisor, &format!("program {n}")));
    }
}

/// The planner pauses, sooner or later: the motion comes to rest within the limits on what is at hand, and
/// goes on.
#[test]
fn what_is_hard_to_stop_on_is_stopped() {
    for (text, program) in HARD.iter().zip(0..) {
        let job = Job::text((*text).to_owned());
        for ticks in (100..500).step_by(if times() > 1 { 1 } else { 57 }) {
            job.supervised(|supervisor| {
                supervisor.play(ticks);
                supervisor.comes_every = usize::MAX;
                supervisor.play(400);
                let last = supervisor.setpoints.last().unwrap();
                let stands = last.velocity.iter().all(|v| v.abs() < 1e-9);
                assert!(stands, "program {program}, {ticks} ticks: {last:?}");
                supervisor.comes_every = 1;
                supervisor.play(2_000);
                assert!(supervisor.is_over(), "program {program}, {ticks} ticks");
                assert_limits(&supervisor.audit(&job.settings, 1.0));
            });
        }
    }
}

#[test]
fn nobody_slows_down_a_benchmark() {
    for (name, effort) in jobs() {
        let job = Job::bench(name, effort);
        job.supervised(|supervisor| assert_as_planned(supervisor, &format!("{name} {effort:?}")));
    }
}

/// From the first motion on a frame is played in every tick, to the last.
fn assert_as_planned(supervisor: &mut Supervisor<'_, '_, '_>, name: &str) {
    supervisor.play(100_000);
    assert!(supervisor.is_over(), "{name}");
    let moves = supervisor.setpoints.iter().skip_while(|s| s.sequence == 0);
    for (setpoint, frame) in moves.zip(supervisor.planned.frames.iter().skip(1)) {
        let time = (setpoint.sequence, setpoint.fraction);
        assert_eq!(time, (frame.sequence, 0.0), "{name} line {}", setpoint.line);
    }
}
