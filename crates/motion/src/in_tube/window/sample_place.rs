//! Places on the path.

use super::scaled_path::ScaledPath;
use super::solver::dot;

/// Where on the path a sample is taken to be.
#[derive(Debug, Clone, Copy)]
pub(crate) struct SamplePlace {
    pub(crate) piece: usize,
    /// Progress.
    pub(crate) s: f64,
    /// How far off the sample is.
    pub(crate) distance: f64,
}

impl SamplePlace {
    /// The place on piece `i` nearest to `y`, at progress `from_s` at least.
    pub(crate) fn on<const D: usize>(
        path: &ScaledPath<D>,
        i: usize,
        from_s: f64,
        y: &[f64; D],
    ) -> Self {
        let segment = &path.segments[i];
        let offset: [f64; D] = core::array::from_fn(|k| y[k] - segment.start[k]);
        let low = (from_s - segment.s).clamp(0.0, segment.length);
        let x = dot(&offset, &segment.tangent).clamp(low, segment.length);
        let across: [f64; D] = core::array::from_fn(|k| offset[k] - x * segment.tangent[k]);
        Self {
            piece: i,
            s: segment.s + x,
            distance: dot(&across, &across).sqrt(),
        }
    }
}
