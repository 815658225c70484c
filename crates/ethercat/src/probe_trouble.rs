//! The troubles with touch probes, for the log: why the place of a contact is not that which drives have kept.

use core::fmt;

/// A trouble with the touch probes of drives. A number is that of a joint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ProbeTrouble {
    /// The probe changed before the touch probes of all drives were armed again.
    Unarmed,
    /// A drive has not kept where it was when the probe changed.
    Missed(usize),
    /// What it has kept, mm or degrees, is not between these places, where the joint was then.
    Elsewhere(usize, f64, (f64, f64)),
}

/// What follows from each.
const SAMPLED: &str =
    "the place of the contact is found from positions, to the way of a period of the bus";

impl fmt::Display for ProbeTrouble {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unarmed => write!(
                f,
                "the probe changed before the drives were ready to keep that (0x60B9): {SAMPLED}"
            ),
            Self::Missed(joint) => write!(
                f,
                "J{joint}: its drive has not kept where it was when the probe changed (0x60B9): is the probe wired \
                 to its input? {SAMPLED}"
            ),
            Self::Elsewhere(joint, place, (from, to)) => write!(
                f,
                "J{joint}: its drive says that the probe changed at {place:.4}, and the joint was between {from:.4} \
                 and {to:.4} then: {SAMPLED}"
            ),
        }
    }
}
