//! Looking for a contact, as the real-time thread sees it.

/// How a search stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) enum Probing {
    /// There is none.
    #[default]
    No,
    /// The motion goes on until there is a contact.
    Looking,
    /// There was one: the motion comes to rest, and the rest of it is left out.
    Tripped,
}
