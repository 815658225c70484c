//! Why a machine rests, where its state alone does not tell what goes on from there.

use crate::record::{MachineState, Status};

/// What keeps a machine at rest besides what its state tells: in a program besides a hold or a stop, or instead
/// of it; without power besides the want of that.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum AtRest {
    /// The axes were jogged away from the path.
    Away,
    /// The motion goes back along the path, or has come to where the way back ends.
    Backwards,
    /// Both overrides are 0.
    NoOverride,
    /// The feed override is 0.
    NoFeed,
    /// The rapid override is 0.
    NoRapid,
    /// An input, or the spindle at a feed per revolution, lets nothing through.
    Adaptive,
    /// The drives have no power, and nobody says where they are.
    Silent,
}

impl AtRest {
    /// Every one of them.
    pub const ALL: &'static [Self] = &[
        Self::Away,
        Self::Backwards,
        Self::NoOverride,
        Self::NoFeed,
        Self::NoRapid,
        Self::Adaptive,
        Self::Silent,
    ];

    /// The states in which it may be.
    #[must_use]
    pub const fn states(self) -> &'static [MachineState] {
        match self {
            Self::Away | Self::Backwards => &[MachineState::Held, MachineState::ProgramStop],
            Self::NoOverride | Self::NoFeed | Self::NoRapid | Self::Adaptive => {
                &[MachineState::Held]
            }
            Self::Silent => &[MachineState::Off],
        }
    }

    /// What the machine does, and what goes on from there. Whether it is held besides is not known.
    #[must_use]
    pub const fn text(self) -> &'static str {
        match self {
            Self::Away => {
                "at rest away from the path; `glidepath return` brings the axes back, then \
                 `glidepath resume` goes on, if anything is left of the program"
            }
            Self::Backwards => {
                "at rest on the way back along the path; `glidepath forward` turns round, and \
                 `glidepath resume` goes back on, after a hold or a stop of the program"
            }
            Self::NoOverride => {
                "at rest on the path at overrides of 0 %; `glidepath override 100 --rapid 100` goes \
                 on, after a hold with `glidepath resume`"
            }
            Self::NoFeed => {
                "at rest on the path at a feed override of 0 %; `glidepath override 100` goes on, after \
                 a hold with `glidepath resume`"
            }
            Self::NoRapid => {
                "at rest on the path at a rapid override of 0 %; `glidepath override --rapid 100` goes \
                 on, after a hold with `glidepath resume`"
            }
            Self::Adaptive => {
                "at rest on the path, because the adaptive feed, or the spindle in G95, lets nothing \
                 through; it goes on by itself when they do, after a hold with `glidepath resume`"
            }
            Self::Silent => {
                "the drives have no power, and do not say where they are; start `glidepath \
                 ethercat --drives drives.toml` or `glidepath servo`, then `glidepath enable` gives it"
            }
        }
    }

    /// What there is of it in a state.
    pub(super) fn of(state: MachineState, status: &Status) -> Option<Self> {
        let is_zero = |ratio: f64| ratio.abs() <= 0.0;
        let (no_feed, no_rapid) = (
            is_zero(status.feed_override),
            is_zero(status.rapid_override),
        );
        let found = if state == MachineState::Off {
            return status.drives_are_silent().then_some(Self::Silent);
        } else if status.away.iter().any(|away| *away != 0.0) {
            Self::Away
        } else if status.feed_override.is_sign_negative() {
            Self::Backwards
        } else if no_feed && no_rapid {
            Self::NoOverride
        } else if no_feed {
            Self::NoFeed
        } else if no_rapid {
            Self::NoRapid
        } else if is_zero(status.adaptive_feed) {
            Self::Adaptive
        } else {
            return None;
        };
        found.states().contains(&state).then_some(found)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_told_at_rest_is_what_goes_on_from_there() {
        let mut status: Status = bytemuck::Zeroable::zeroed();
        status.state = MachineState::Held.code();
        (status.feed_override, status.rapid_override) = (1.0, 1.0);
        status.adaptive_feed = 1.0;
        let told = |status: &Status| status.state_text().map_err(|error| error.to_string());
        assert_eq!(told(&status), Ok(MachineState::Held.text()));
        let table: [(f64, f64, f64, AtRest); 6] = [
            (0.0, 1.0, 1.0, AtRest::NoFeed),
            (1.0, 0.0, 1.0, AtRest::NoRapid),
            (0.0, 0.0, 1.0, AtRest::NoOverride),
            (-0.0, 1.0, 1.0, AtRest::Backwards),
            (-0.5, 0.0, 1.0, AtRest::Backwards),
            (1.0, 1.0, 0.0, AtRest::Adaptive),
        ];
        for (feed, rapid, adaptive, found) in table {
            (status.feed_override, status.rapid_override) = (feed, rapid);
            status.adaptive_feed = adaptive;
            status.away[2] = 0.0;
            status.state = MachineState::Held.code();
            assert_eq!(told(&status), Ok(found.text()));
            // A program that runs is not at rest by that, and a resume is refused away from the path.
            status.state = MachineState::Running.code();
            assert_eq!(told(&status), Ok(MachineState::Running.text()));
            status.away[2] = 5.0;
            for state in [MachineState::Held, MachineState::ProgramStop] {
                status.state = state.code();
                assert_eq!(told(&status), Ok(AtRest::Away.text()));
            }
        }
        status.state = MachineState::Off.code();
        assert_eq!(told(&status), Ok(MachineState::Off.text()));
        for silent_ns in [600_000_000, u64::MAX] {
            status.feedback_age_ns = silent_ns;
            assert_eq!(told(&status), Ok(AtRest::Silent.text()));
        }
        status.state = 99;
        assert!(status.state_text().is_err());
    }

    #[test]
    fn texts_are_of_their_own() {
        for (i, one) in AtRest::ALL.iter().enumerate() {
            let others = AtRest::ALL[..i].iter().map(|other| other.text());
            let mut others = others.chain(MachineState::ALL.iter().map(|state| state.text()));
            assert!(others.all(|other| other != one.text()));
        }
    }
}
