//! A motion as the page wants it: columns against time, and the path in space.
//!
//! Samples are taken one by one; memory is bounded whatever their number. Velocity, acceleration
//! and jerk are finite differences of the positions: what a drive makes of them.

mod bins;
mod bytes;
mod path;
mod sample;

use bins::Bins;
use bytes::Bytes;
use path::{Path, Vertex};
pub use sample::{AxisScale, LimitKind, MotionSample};

/// Marks the columns.
const COLUMNS: &[u8; 4] = b"GPC1";
/// Marks a path.
const PATH: &[u8; 4] = b"GPP1";

/// A motion as it grows.
#[derive(Debug)]
pub struct Motion {
    bins: Bins,
    path: Path,
    program: Path,
}

impl Motion {
    /// A motion with nothing in it, of a machine with these axes, with this period in seconds.
    #[must_use]
    pub fn new(axes: &[AxisScale], period_t: f64) -> Self {
        Self {
            bins: Bins::new(axes, period_t),
            path: Path::default(),
            program: Path::default(),
        }
    }

    /// Takes the next sample.
    pub fn push(&mut self, sample: &MotionSample) {
        self.path.push(&Vertex {
            at: first_three(&sample.position),
            sequence: self.bins.samples(),
            feed_v: sample.feed_v,
            code: sample.code(),
        });
        self.bins.push(sample);
    }

    /// Takes the next point of the programmed path: mm, its source line, and whether the way to it is
    /// a rapid.
    pub fn push_programmed(&mut self, at: [f64; 3], line: u32, is_rapid: bool) {
        self.program.push(&Vertex {
            at,
            sequence: line.into(),
            feed_v: 0.0,
            code: u8::from(is_rapid) << 7,
        });
    }

    /// Samples taken.
    #[must_use]
    pub const fn samples(&self) -> u64 {
        self.bins.samples()
    }

    /// The columns against time, as the page reads them.
    #[must_use]
    pub fn columns(&self) -> Vec<u8> {
        let mut bytes = Bytes::new(COLUMNS);
        self.bins.write(&mut bytes);
        bytes.finish()
    }

    /// The path of the motion, as the page reads it.
    #[must_use]
    pub fn path(&self) -> Vec<u8> {
        self.path.bytes(PATH)
    }

    /// The programmed path, as the page reads it.
    #[must_use]
    pub fn programmed_path(&self) -> Vec<u8> {
        self.program.bytes(PATH)
    }
}

const fn first_three(position: &[f64; 9]) -> [f64; 3] {
    let [x, y, z, ..] = *position;
    [x, y, z]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn word(bytes: &[u8], at: usize) -> u32 {
        u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap())
    }

    fn axis() -> AxisScale {
        AxisScale {
            index: 0,
            limits: [200.0, 2000.0, 40_000.0],
        }
    }

    #[test]
    fn a_long_motion_stays_small_and_keeps_its_spikes() {
        let mut motion = Motion::new(&[axis()], 0.004);
        let count = 1_000_000_u32;
        for tick in 0..count {
            let mut position = [0.0; 9];
            // At rest, but for one step of a tenth of a millimetre.
            position[0] = if tick < 700_001 { 0.0 } else { 0.1 };
            motion.push(&MotionSample {
                position,
                line: tick / 1000,
                ..MotionSample::default()
            });
        }
        let bytes = motion.columns();
        assert_eq!(&bytes[..4], COLUMNS);
        let (axes, bins, per) = (word(&bytes, 4), word(&bytes, 8), word(&bytes, 12));
        assert_eq!((axes, per), (1, 8), "a million samples in eights");
        assert_eq!(bins, count / 8);
        assert!(bytes.len() < 9_000_000, "{}", bytes.len());
        // The columns of an axis: positions, then velocity from and to in 16 bits.
        let bins = bins as usize;
        let to = 32 + bins * 4 + bins * 2;
        let most = (0..bins)
            .map(|bin| i16::from_le_bytes(bytes[to + 2 * bin..][..2].try_into().unwrap()))
            .max();
        // 25 mm/s, where 32767 is 250 mm/s.
        assert_eq!(most, Some(3277));
    }

    #[test]
    fn a_path_is_thinned_where_it_shows_least() {
        let mut motion = Motion::new(&[axis()], 0.004);
        for k in 0..400_000_u32 {
            // Along a square of 100 mm.
            let (side, s) = (k / 100_000, f64::from(k % 100_000) / 1000.0);
            let at = [[s, 0.0], [100.0, s], [100.0 - s, 100.0], [0.0, 100.0 - s]][side as usize];
            let mut position = [0.0; 9];
            position[..2].copy_from_slice(&at);
            motion.push(&MotionSample {
                position,
                ..MotionSample::default()
            });
        }
        let bytes = motion.path();
        assert_eq!(&bytes[..4], PATH);
        let count = word(&bytes, 4) as usize;
        assert!(count <= 65_536, "{count}");
        let number = |at: usize| f32::from_le_bytes(bytes[at..at + 4].try_into().unwrap());
        let points: Vec<[f32; 2]> = (0..count)
            .map(|i| [number(16 + 12 * i), number(20 + 12 * i)])
            .collect();
        for corner in [[0.0, 0.0], [100.0, 0.0], [100.0, 100.0], [0.0, 100.0]] {
            assert!(points.contains(&corner), "{corner:?}");
        }
    }
}
