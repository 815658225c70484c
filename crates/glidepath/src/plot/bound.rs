//! The colours of the limits that bind.

use glidepath_audit::diagnosis::Binding;

/// The kind of a limit; the axis does not show.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Bound {
    Feed,
    Velocity,
    Acceleration,
    Jerk,
    Tolerance,
    ChordError,
    None,
}

impl Bound {
    pub(super) const ALL: [Self; 7] = [
        Self::Feed,
        Self::Velocity,
        Self::Acceleration,
        Self::Jerk,
        Self::Tolerance,
        Self::ChordError,
        Self::None,
    ];

    pub(super) const fn of(binding: Binding) -> Self {
        match binding {
            Binding::Feed => Self::Feed,
            Binding::Velocity(_) | Binding::JointVelocity(_) => Self::Velocity,
            Binding::Acceleration(_) | Binding::JointAcceleration(_) => Self::Acceleration,
            Binding::Jerk(_) | Binding::JointJerk(_) => Self::Jerk,
            Binding::Tolerance => Self::Tolerance,
            Binding::ChordError => Self::ChordError,
            // A rest is a point of the track: nothing is drawn of it.
            Binding::Rest | Binding::None => Self::None,
        }
    }

    pub(super) const fn index(self) -> usize {
        self as usize
    }

    /// Distinct also for those who do not tell red from green; the feed, which is what one wants to
    /// be bound by, is the quiet one.
    pub(super) const fn colour(self) -> &'static str {
        match self {
            Self::Feed => "#1c7ed6",
            Self::Velocity => "#1b4f72",
            Self::Acceleration => "#e69f00",
            Self::Jerk => "#c2255c",
            Self::Tolerance => "#0b8a5f",
            Self::ChordError => "#7048e8",
            Self::None => "#8d99a6",
        }
    }

    pub(super) const fn label(self) -> &'static str {
        match self {
            Self::Feed => "feed",
            Self::Velocity => "velocity",
            Self::Acceleration => "acceleration",
            Self::Jerk => "jerk",
            Self::Tolerance => "tolerance",
            Self::ChordError => "chord error",
            Self::None => "none",
        }
    }
}
