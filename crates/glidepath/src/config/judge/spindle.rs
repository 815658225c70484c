//! `[spindle]`: whether its angle is known.

use super::values::Judge;
use crate::config::diagnostic::ConfigDiagnostic;
use crate::config::raw::RawSpindle;

impl Judge {
    /// Whether programs may follow the angle of the spindle. `is_axes`: the joints are the axes.
    pub(super) fn spindle(&mut self, raw: &RawSpindle, is_axes: bool) -> bool {
        let Some(encoder) = &raw.encoder else {
            return false;
        };
        let is_known = *encoder.get_ref();
        if is_known && !is_axes {
            self.diagnostics.push(ConfigDiagnostic {
                key: "spindle.encoder".to_owned(),
                message: "threads are cut only where every joint is an axis".to_owned(),
                help: Some("leave it out, or set machine.kinematics = \"trivial\"".to_owned()),
                span: Some(encoder.span()),
            });
        }
        is_known
    }
}
