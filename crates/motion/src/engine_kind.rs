//! The choice of the engine that plans with given settings.

use glidepath_program::{Effort, Settings, Smoothing};

/// One of the two engines of this crate.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum EngineKind {
    /// The path given, the time along it optimised.
    OnPath,
    /// Geometry and time together.
    InTube,
}

impl EngineKind {
    /// The engine that plans with these settings.
    pub(crate) fn of(settings: &Settings) -> Self {
        match (settings.effort, settings.smoothing) {
            (Effort::Optimal, Smoothing::Auto) if settings.limits.path.is_none() => Self::InTube,
            _ => Self::OnPath,
        }
    }
}
