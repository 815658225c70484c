//! From where path position is counted.

use super::InTubeEngine;

impl InTubeEngine {
    /// After each frame: where the stretch that ended with it ends, if one did, in path position as
    /// the frame counts it. From there on it is counted anew, from 0.
    ///
    /// Frames tell path position as the sum of where their stretch begins and how far they are in
    /// it. Whoever knows where stretches begin in a whole program adds that up to the same bits.
    pub(crate) fn take_origin(&mut self) -> Option<f64> {
        let origin_s = core::mem::take(&mut self.path_s);
        (origin_s != 0.0).then(|| {
            self.grid.count_from_here();
            origin_s
        })
    }
}
