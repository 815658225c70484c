//! The error of a transition: why a corner has none.

/// The reason why a corner has no transition of the family that was asked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum TransitionError {
    /// The path turns back on itself: a curve at constant speed would need infinite acceleration.
    #[error("the path reverses at this corner; stop there, or use a sextic blend")]
    Reversal,
    /// The two directions are not of unit length in the same axes, so there is no common speed.
    #[error(
        "the feed is measured in different axes before and after this corner; use a sextic blend"
    )]
    MixedFeedAxes,
}
