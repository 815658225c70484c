//! Tests of a hold beside an end of travel, and of what begins where it was.

use super::*;
use crate::testing::frame_of;
use glidepath_program::Travel;

const PERIOD_T: f64 = 0.004;
/// Periods of the way to the end of travel: it is reached in the middle of one.
const PERIODS: f64 = 30.5;

/// Position, velocity and acceleration on a way from rest to rest with all of the jerk, four phases.
fn on_the_way(t: f64, jerk: f64) -> [f64; 3] {
    let phase_t = PERIODS * PERIOD_T / 4.0;
    let mut state = [0.0; 3];
    for (k, sign) in [1.0, -1.0, -1.0, 1.0].into_iter().enumerate() {
        let begins_t = phase_t * k as f64;
        let u = (t - begins_t).clamp(0.0, phase_t);
        let [x, v, a] = state;
        let j = sign * jerk;
        state = [
            x + u * (v + u * (a / 2.0 + u * j / 6.0)),
            v + u * (a + u * j / 2.0),
            a + u * j,
        ];
    }
    // What rounding leaves of the rest.
    if t >= 4.0 * phase_t {
        (state[1], state[2]) = (0.0, 0.0);
    }
    state
}

/// To the end of travel and back, and where that end is, mm.
fn there_and_back(jerk: f64) -> (Vec<SetpointFrame>, f64) {
    let end = on_the_way(1.0, jerk)[0];
    let count = 80_u32;
    let frames = (0..count).map(|k| {
        let t = f64::from(k) * PERIOD_T;
        let [x, v, a] = if k <= count / 2 {
            on_the_way(t, jerk)
        } else {
            let [x, v, a] = on_the_way(f64::from(count - 1 - k) * PERIOD_T, jerk);
            [x, -v, a]
        };
        let mut frame = frame_of(u64::from(k), [x], [v], [a]);
        frame.flags = match k {
            0 => FrameFlags::FIRST.0,
            _ if k + 1 == count => FrameFlags::LAST.0,
            _ => 0,
        };
        frame
    });
    (frames.collect(), end)
}

#[test]
fn what_is_aborted_beside_an_end_of_travel_rests_inside() {
    let jerk = 0.9 * mill().jerk[0];
    let (frames, end) = there_and_back(jerk);
    let swing = jerk * PERIOD_T.powi(3) / 768.0;
    let mut swung = 0;
    for tick in 10..60 {
        for share in [0.3, 0.55, 0.85, 1.0] {
            let mut config = Config::new(mill(), 4_000_000);
            config.soft_limits.highest[0] = end;
            let mut rig = Rig::new(config);
            rig.feed.extend(&frames);
            rig.command(Command::FeedOverride(share));
            rig.run(tick);
            rig.command(Command::Hold);
            rig.run_until(300, |s| {
                matches!(s.state(), Ok(MachineState::Held | MachineState::Idle))
            });
            let held = rig.setpoints.last().unwrap().position[0];
            assert!(held <= end + swing, "{tick} {share}: {held}");
            swung += u32::from(held > end + Travel::ROUNDING);
            rig.command(Command::Abort);
            rig.run(5);
            assert_eq!(rig.state(), MachineState::Idle);
            let idle = rig.setpoints.iter().rev();
            let idle = idle.take_while(|s| s.state() == Ok(MachineState::Idle));
            let places: Vec<_> = idle.map(|s| s.position[0]).collect();
            assert!(places.windows(2).all(|pair| pair[0] == pair[1]));
            let rests = places[0];
            assert!(rests <= end, "{tick} {share}: {}", rests - end);
            assert!((rests - held).abs() <= swing);
            assert!(rig.worst_ratio() <= INSIDE);
        }
    }
    assert!(swung > 0, "no hold rested where the motion swings over");
}
