//! Tests of the ring of frames, and the motion through them.

use super::*;
use crate::testing::{frame_of, mill};

/// A polynomial of degree five is its own quintic through two frames.
#[test]
fn a_quintic_is_reproduced() {
    let t = 0.004;
    let p = |x: f64| 3.0 + x * (20.0 + x * (-500.0 + x * (8e3 + x * (1e5 - x * 7e6))));
    let v = |x: f64| 20.0 + x * (-1e3 + x * (24e3 + x * (4e5 - x * 35e6)));
    let a = |x: f64| -1e3 + x * (48e3 + x * (12e5 - x * 140e6));
    let mut track = Track::new(0.004, (&mill(), None), MCodeWaits::NONE, TRACK_CAPACITY);
    for (k, x) in [(0, 0.0), (1, t)] {
        track.push(&frame_of(k, [p(x)], [v(x)], [a(x)]));
    }
    for u in [0.0, 0.125, 0.5, 0.9] {
        let time = ProgramTime {
            sequence: 0,
            fraction: u,
        };
        let got = track.kinematic(time).unwrap();
        assert!((got.position[0] - p(u * t)).abs() < 1e-12);
        assert!((got.velocity[0] / t - v(u * t)).abs() < 1e-9);
        assert!((got.acceleration[0] / (t * t) - a(u * t)).abs() < 1e-6);
        assert!((track.position(time).unwrap() - got.position).norm() < 1e-15);
    }
}

#[test]
fn the_ring_owns_consecutive_frames() {
    let mut track = Track::new(0.004, (&mill(), None), MCodeWaits::NONE, TRACK_CAPACITY);
    for k in 0..TRACK_CAPACITY as u64 {
        track.push(&frame_of(k, [0.1], [1.0], [0.0]));
    }
    assert!(track.is_full() && track.holding_frame().is_none() && !track.ends_at_rest());
    track.release_before(10);
    assert!(track.frame(9).is_none() && track.frame(10).is_some());
    track.push(&frame_of(TRACK_CAPACITY as u64, [0.1], [0.0], [0.0]));
    assert_eq!(track.holding_frame(), Some(512));
    assert_eq!(track.end(), 513);
    let beyond = ProgramTime {
        sequence: 600,
        fraction: 0.5,
    };
    assert_eq!(beyond.held_at(track.holding_frame()), ProgramTime::at(512));
    assert!(track.position(beyond).is_none());
    track.clear();
    assert!(track.position(ProgramTime::at(512)).is_none());
}
