//! What a macro of FANUC is called with.

use crate::execute::dialect::tape::TapePlace;
use crate::execute::parameters::FANUC_LOCALS;

/// The locals that a macro begins with.
pub(crate) type Arguments = [f64; FANUC_LOCALS];

/// The macro of G66.
#[derive(Debug, Clone)]
pub(crate) struct ModalMacro {
    pub(crate) first: TapePlace,
    pub(crate) turns: u32,
    /// The locals of its next call: G66 sets them, and each call leaves them to the next.
    pub(crate) arguments: Arguments,
    /// How many calls were in progress where it began: it is not called from inside of itself.
    pub(crate) level: usize,
}
