//! The tolerance ratio of a run: how many times the tolerance of the machine and of the program it may use.

use super::machine::MachineConfig;

impl MachineConfig {
    /// Has programs planned with so many times their tolerance: that of the configuration and what G64 P says. What a
    /// cycle or a thread asks for itself stays.
    pub(crate) fn use_tolerance_ratio(&mut self, ratio: f64) {
        let by = ratio / self.program.tolerance_ratio;
        self.path.tolerance_mm *= by;
        self.path.direction_deg = self.path.direction_deg.map(|deg| deg * by);
        self.program.tolerance_ratio = ratio;
    }
}
