//! What unit tests share.

#[path = "../tests/synthetic/mod.rs"]
mod synthetic;

use glidepath_geometry::AXES;
use glidepath_link::SetpointFrame;
pub(crate) use synthetic::*;

/// A frame with the given values on the first axes and zero on the others.
pub(crate) fn frame_of<const N: usize>(
    sequence: u64,
    position: [f64; N],
    velocity: [f64; N],
    acceleration: [f64; N],
) -> SetpointFrame {
    let all = |values: [f64; N]| {
        let mut all = [0.0; AXES];
        all[..N].copy_from_slice(&values);
        all
    };
    SetpointFrame {
        epoch: 1,
        sequence,
        period_ns: 4_000_000,
        planned_override: 1.0,
        position: all(position),
        velocity: all(velocity),
        acceleration: all(acceleration),
        ..<SetpointFrame as bytemuck::Zeroable>::zeroed()
    }
}
