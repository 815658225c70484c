//! The table of a compensation: its points, and what is wrong with one.

/// The steepest correction, mm by mm: more is no error of a screw but a wrong scale or a wrong unit.
pub(crate) const STEEPEST: f64 = 0.01;
/// The most points of a table.
pub const MOST_POINTS: usize = 256;

/// A measured point of a joint: what is added to where it is to be.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CompensationPoint {
    /// Where the joint is to be, mm or degrees.
    pub position: f64,
    /// What is added on the way up, mm or degrees.
    pub up: f64,
    /// What is added on the way down.
    pub down: f64,
}

/// What is wrong with the compensation of a joint.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum CompensationError {
    /// A single point is no table.
    #[error("a table has two points at least, and {MOST_POINTS} at most; this one has {0}")]
    Points(usize),
    /// The positions do not ascend.
    #[error("positions ascend; {1} comes behind {0}")]
    Order(f64, f64),
    /// More is added on the way down than on the way up.
    #[error(
        "at {0} more is added on the way down than on the way up: are the two columns exchanged?"
    )]
    Exchanged(f64),
    /// A correction is too steep.
    #[error(
        "the corrections change by {0:.4} mm in a mm at most, and {STEEPEST} are taken: \
         a wrong unit, or measured positions in place of corrections?"
    )]
    TooSteep(f64),
    /// Too little of a limit is left.
    #[error(
        "the corrections leave {left_percent:.0} % of the joint's {quantity} at its highest speed: they are rough, or their points too near each other"
    )]
    TooRough {
        /// The limit.
        quantity: &'static str,
        /// What is left of it, %.
        left_percent: f64,
    },
}

/// Whether places ascend.
///
/// # Errors
/// Two that do not.
pub(crate) fn ascends(mut places: impl Iterator<Item = f64>) -> Result<(), CompensationError> {
    let mut before = f64::NEG_INFINITY;
    places.try_for_each(|place| {
        let last = core::mem::replace(&mut before, place);
        if last < place {
            Ok(())
        } else {
            Err(CompensationError::Order(last, place))
        }
    })
}
