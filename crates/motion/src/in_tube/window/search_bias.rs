//! The bias of a search: what decides which of many local best motions it finds.
//!
//! Convex problems in turn go downhill from where samples are first thought to be. There are many
//! valleys, on small things some per cent apart, and no one bias leads to the deepest: whoever has
//! the time looks again with another.

/// What a search is given beside the path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct SearchBias {
    /// Twice what an offset of the whole radius costs at one sample, in periods of mean progress
    /// ([`super::tube::Style::attraction`]). This and the next count far less than the time that can be gained by them, and enough to be the only thing that counts where
    /// none can. Heavy ones lead to a motion with less work, light ones a little further.
    pub(crate) pull: f64,
    /// Twice what jerk at its limit costs in one knot interval.
    pub(crate) jerk: f64,
    /// How many times as fast as expected the motion is first thought to be: samples that are on a
    /// piece too early for that are corrected at once, but take others with them.
    pub(crate) hurry: f64,
}

impl SearchBias {
    /// For whatever is planned once. All along a hundred samples an offset of the whole radius costs 1.5
    /// periods of mean progress, jerk at its limit .5. A pull of .1 cost 10 to 32 periods of 770 on a zigzag;
    /// with neither, the search takes as long a motion and more work.
    pub(crate) const USUAL: Self = Self {
        pull: 0.03,
        jerk: 0.01,
        hurry: 1.0,
    };
    /// For another look at the same stretch. The two together are .39 % above the best of many on random
    /// programs of less than .1 s, .15 % at .3 s.
    pub(crate) const LIGHT: Self = Self {
        pull: 0.001,
        jerk: 0.001,
        hurry: 1.0,
    };
    /// For a third one: on curves it often finds what the others do not. With it short programs are .03 %
    /// above the best of many.
    pub(crate) const HURRIED: Self = Self {
        hurry: 1.3,
        ..Self::LIGHT
    };
}
