//! What a device can do wrong where its objects go in segments.

/// What a device does wrong with segments.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum SegmentFault {
    /// Nothing.
    #[default]
    None,
    /// From the second one on their toggle bit does not change.
    SameToggle,
    /// Instead of the nth one, from 0, it aborts with this code.
    Abort(u32, u32),
    /// It tells so many bytes more than it gives, or less.
    Length(i32),
    /// They are empty, and none is the last one.
    Empty,
    /// The nth one, from 0, is not answered, once.
    Silent(u32),
}
