//! The faults that the bridge finds and no drive reports.

use crate::state;
use core::fmt;
use glidepath_link::DriveState;

/// A fault that no drive reports. The joint is counted from 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum BusFault {
    /// A drive did not get power in time; this is how far it came.
    NotEnabled(usize, DriveState),
    /// A drive obeys its own panel, or a tool of its manufacturer.
    NotRemote(usize),
    /// A drive lost its power and reports no fault.
    PowerLost(usize, DriveState),
    /// The first demand is too far from where the joint stands: by so much.
    Apart(usize, f64),
    /// A target would have been this many counts from the one before, and so many are possible.
    Step(usize, f64, f64),
    /// A target is outside what the drive counts.
    Range(usize),
    /// A drive did not find its home.
    NoHome(usize),
    /// The two encoders of a joint are too far apart: by so much, mm or degrees, and whether it stays so until the
    /// process ends.
    EncodersApart(usize, f64, bool),
}

impl BusFault {
    /// Whether all drives lose their power by it: what leads them cannot be trusted, or they come
    /// together or not at all.
    pub(crate) const fn is_common(self) -> bool {
        !matches!(self, Self::PowerLost(..) | Self::NoHome(..))
    }
}

impl fmt::Display for BusFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotEnabled(joint, state) => write!(
                f,
                "J{joint} does not get power: its drive stays \"{}\". Is the main supply on, and are \
                 the safety inputs closed?",
                state::name(*state)
            ),
            Self::NotRemote(joint) => write!(
                f,
                "J{joint} does not obey the bus: close its manufacturer's tool, or set it to EtherCAT"
            ),
            Self::PowerLost(joint, state) => {
                write!(
                    f,
                    "J{joint} lost its power: its drive is \"{}\"",
                    state::name(*state)
                )
            }
            Self::Apart(joint, by) => write!(
                f,
                "J{joint} stands {by:.4} (mm or degrees) from where it is told to begin: nothing was \
                 moved; enable_window in drives.toml allows less"
            ),
            Self::Step(joint, step, most) => write!(
                f,
                "J{joint} was to step by {step:.0} counts in a cycle, {most:.0} are possible: not sent"
            ),
            Self::Range(joint) => {
                write!(
                    f,
                    "J{joint} was to go beyond what its drive counts: not sent"
                )
            }
            Self::NoHome(joint) => write!(f, "J{joint}: its drive did not find its home"),
            Self::EncodersApart(joint, by, stays) => {
                write!(
                    f,
                    "J{joint}: its encoder at the terminal is {by:.4} (mm or degrees) from what its drive \
                     counts, and apart in drives.toml allows less: something slips, or one of both \
                     loses counts; all drives stop"
                )?;
                if *stays {
                    write!(
                        f,
                        ". It gets no power until glidepath ethercat was started anew, and the joint is \
                         to be homed then"
                    )?;
                }
                Ok(())
            }
        }
    }
}
