//! Which engine plans with some settings.

use glidepath_program::{Effort, Settings, Smoothing};

/// A wing of this crate.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Wing {
    /// The path given, the time along it optimised.
    OnPath,
    /// Geometry and time together.
    InTube,
}

impl Wing {
    /// The wing that plans with these settings.
    pub(crate) fn of(settings: &Settings) -> Self {
        match (settings.effort, settings.smoothing) {
            (Effort::Optimal, Smoothing::Auto) if settings.limits.path.is_none() => Self::InTube,
            _ => Self::OnPath,
        }
    }
}
