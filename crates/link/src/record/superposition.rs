//! The state of a superposition: the motion of an axis in addition to that of the program.

use super::code::coded;

coded! {
    /// The state of a superposition.
    pub enum SuperpositionState {
        /// The machine has none.
        None = 0,
        /// It is off, and its axis is where the program asks for.
        Off = 1,
        /// It follows its input.
        Follows = 2,
        /// It stands at its offset: the motion is held, slow, rapid, or of a kind that nothing is added to.
        Frozen = 3,
        /// It is off, and its axis returns to the program.
        Returns = 4,
        /// It stands at its offset, because nobody sends its input.
        Silent = 5,
    }
}

coded! {
    /// The reason why a superposition is frozen.
    pub enum FreezeReason {
        /// It is not frozen.
        None = 0,
        /// The motion does not go forward along its path: it rests, is held, comes to rest, or goes back.
        NotOnward = 1,
        /// The motion looks for a contact of the probe.
        Probing = 2,
        /// The motion follows the spindle: a thread, or a rigid tap.
        FollowsSpindle = 3,
        /// The motion is a rapid.
        Rapid = 4,
        /// The motion is, or was just now, slower than its feed.
        Slow = 5,
        /// The input that enables it is off.
        NotEnabled = 6,
        /// It is switched off, and keeps its offset until the program ends.
        SwitchedOff = 7,
    }
}
