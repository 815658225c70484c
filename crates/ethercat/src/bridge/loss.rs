//! What a bridge has lost, as feedback has it.

use glidepath_link::{Feedback, Loss};

/// What was lost.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum BridgeLoss {
    /// Setpoints, for so long, ns.
    Setpoints(u64),
    /// A device, at this place of the line if one says that it is missing.
    Device(Option<usize>),
    /// The bus.
    Bus,
    /// The drive of the spindle, which has this fault, or 0 where it has no power.
    Spindle(u16),
    /// The gear of the spindle, 0 where nobody said which one is to be in.
    Gear(u32),
}

impl BridgeLoss {
    /// Whether outputs are at rest by it. Those of programs have nothing to do with the spindle.
    pub(super) const fn stops_outputs(self) -> bool {
        !matches!(self, Self::Spindle(_) | Self::Gear(_))
    }

    #[allow(clippy::cast_precision_loss, reason = "some milliseconds, and a place")]
    pub(super) fn tell(self, feedback: &mut Feedback) {
        let (loss, value) = match self {
            Self::Setpoints(silent_ns) => (Loss::Setpoints, silent_ns as f64 * 1e-9),
            Self::Device(position) => (Loss::Device, position.map_or(-1.0, |at| at as f64)),
            Self::Bus => (Loss::Bus, 0.0),
            Self::Spindle(code) => (Loss::Spindle, f64::from(code)),
            Self::Gear(gear) => (Loss::Gear, f64::from(gear)),
        };
        (feedback.loss, feedback.loss_value) = (loss.code(), value);
    }
}
