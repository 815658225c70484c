//! The firmware of a printer, on which the meaning of some words depends.

/// The firmware of a printer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Firmware {
    /// Marlin: G90 and G91 say what E is, too.
    Marlin,
    /// Klipper: G91 makes E relative, and G90 leaves what M82 and M83 said.
    Klipper,
}
