//! The wait of M66 for an input: which input, and what it is to do.

/// An input of the machine.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Input {
    /// A digital one, 0 to 63.
    Digital(u32),
    /// An analog one, 0 to 63.
    Analog(u32),
}

/// The condition of an input that is waited for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum WaitFor {
    /// Nothing: it is read at once (L0).
    Nothing,
    /// To become high (L1).
    Rise,
    /// To become low (L2).
    Fall,
    /// To be high (L3).
    High,
    /// To be low (L4).
    Low,
}

/// The wait of an M66.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct InputWait {
    /// The input.
    pub input: Input,
    /// What it is to do.
    pub until: WaitFor,
    /// How long at most, s; what was not until then gives −1.
    pub limit_s: f64,
}
