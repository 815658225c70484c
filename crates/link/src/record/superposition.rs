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
