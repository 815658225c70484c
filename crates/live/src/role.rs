//! The roles of those who have shown a token: what each may.

use crate::sha256::Sha256;

/// A role of a page. Each may all that the one before may.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Role {
    /// See the machine.
    Look,
    /// Bring it to rest: hold and abort.
    Hold,
    /// Do whatever an operator does.
    Operate,
}

impl Role {
    /// All of them, the least first.
    pub const ALL: [Self; 3] = [Self::Look, Self::Hold, Self::Operate];

    /// The one of this name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|role| role.name() == name)
    }

    /// Its name.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Look => "look",
            Self::Hold => "hold",
            Self::Operate => "operate",
        }
    }
}

/// The caller of a request: what the token allows, and which page it is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Caller {
    /// What it may.
    pub role: Role,
    /// The number that the page has given itself; 0 if it has none.
    pub page: u64,
    /// The hash of the token of a paired device; `None` for pages of this host.
    pub device: Option<Sha256>,
}
