//! The events on the bus, for the log.

use crate::bus_fault::BusFault;
use crate::diagnosis::Diagnosis;
use crate::probe_trouble::ProbeTrouble;
use crate::{al_status, fault_text, state};
use core::fmt;
use glidepath_link::{DriveState, FaultCause, FaultReport};

/// An event that an operator is told. A number is that of a joint, where nothing else is said.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Event {
    /// Cycles begin.
    InOperation,
    /// A drive has power and follows.
    Follows(usize),
    /// A drive has no power any more.
    Off(usize),
    /// A drive reports a fault.
    Fault(usize, u16),
    /// The fault of a drive is reset.
    Reset(usize),
    /// A drive is not in OP, with its AL status code.
    LeftOp(usize, u16),
    /// A drive does not answer.
    Gone(usize),
    /// A drive has sent an emergency.
    Emergency(usize, u16),
    /// The diagnosis history of a drive that has failed has a new message.
    History(usize, Diagnosis),
    /// The same of the device at this place of the line.
    TerminalHistory(usize, Diagnosis),
    /// The device at this place of the line, which is no drive, does not answer.
    TerminalGone(usize),
    /// It is not in OP, with its AL status code.
    TerminalLeftOp(usize, u16),
    /// It has sent an emergency.
    TerminalEmergency(usize, u16),
    /// The drive of the spindle reports a fault.
    SpindleFault(u16),
    /// The drive of the spindle does not get power, or lost it; this is how far it came.
    SpindleWithoutPower(DriveState),
    /// A gear of the spindle did not come in in time.
    GearNotIn(u32),
    /// The input of the gear in which the spindle turns fell, or that of another one came.
    GearLost(u32),
    /// The spindle is to turn, inputs tell no gear, and none was commanded.
    GearUnknown,
    /// Devices that are no drives do not take part in the process data, and say nothing.
    TerminalsShort,
    /// A drive looks for its home.
    Homing(usize),
    /// It has found it.
    Home(usize),
    /// Something is wrong that the drives do not see.
    Trouble(BusFault),
    /// A frame was lost, or too few drives took part.
    FrameLost,
    /// Too many frames were lost in a row.
    BusLost,
    /// Setpoints stayed away for so long, ns: joints stop by themselves, outputs come to rest.
    Silence(u64),
    /// A setpoint jumped: the joints stop by themselves.
    Jump(usize),
    /// The joints stop because a drive failed, and the motion goes on.
    NobodyStops,
    /// The interpolator was started anew.
    Restart,
    /// The counter of the spindle's encoder was off at its index, by so many counts.
    EncoderSlipped(i64),
    /// Without power, the load of a joint has gone so far from its drive by the encoder at the terminal, mm or degrees;
    /// and whether that is not to be believed, because the drive turned the other way meanwhile, or the encoder jumped.
    LoadSlipped(usize, f64, bool),
    /// Touch probes of drives have not told where the probe touched.
    Probe(ProbeTrouble),
}

impl Event {
    /// Words for what is no drive of a joint.
    fn tell_other(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TerminalHistory(position, diagnosis) => write!(
                f,
                "the device at position {position}: its diagnosis history has {diagnosis}"
            ),
            Self::TerminalGone(position) => write!(
                f,
                "the device at position {position} does not answer: its supply, or the cable before it"
            ),
            Self::TerminalLeftOp(position, code) => write!(
                f,
                "the device at position {position} is not in OP: {}",
                al_status::text(*code)
            ),
            Self::TerminalEmergency(position, code) => {
                write!(
                    f,
                    "the device at position {position}: emergency message {code:#06x}"
                )
            }
            Self::SpindleFault(code) => {
                write!(f, "the spindle: fault {}", fault_text::text(*code))
            }
            Self::SpindleWithoutPower(state) => write!(
                f,
                "the spindle has no power: its drive is \"{}\"",
                state::name(*state)
            ),
            Self::GearNotIn(gear) => write!(
                f,
                "gear {gear} of the spindle is not in: its input did not come in time, or that of another gear is on"
            ),
            Self::GearLost(gear) => write!(
                f,
                "gear {gear} of the spindle is not in any more: its input fell while the spindle turned, or that of \
                 another gear came"
            ),
            Self::GearUnknown => write!(
                f,
                "the gear of the spindle is not known: inputs tell none or several, and no program has named one"
            ),
            Self::TerminalsShort => write!(
                f,
                "a device that is no drive does not take part, and says that it is in OP: its inputs and \
                 outputs are not known"
            ),
            Self::LoadSlipped(joint, by, is_doubted) => {
                write!(
                    f,
                    "J{joint}: without power its encoder at the terminal has gone {by:.4} (mm or degrees) from what \
                     its drive counts, and apart in drives.toml allows less: "
                )?;
                f.write_str(if *is_doubted {
                    "the drive moved and the encoder did not, or it jumped, so one of both is wrong. The joint gets no \
                     power until glidepath ethercat was started anew, and is to be homed then"
                } else {
                    "the joint is where the encoder says, and a home that its drive has found does not hold any more"
                })
            }
            _ => Ok(()),
        }
    }
}

impl fmt::Display for Event {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::InOperation => write!(f, "all drives are in OP"),
            Self::Follows(joint) => write!(f, "J{joint} has power and follows"),
            Self::Off(joint) => write!(f, "J{joint} is without power"),
            Self::Fault(joint, code) => {
                write!(f, "J{joint}: fault {}", fault_text::text(*code))
            }
            Self::Reset(joint) => write!(f, "J{joint}: its fault is reset"),
            Self::LeftOp(joint, code) => {
                write!(f, "J{joint} is not in OP: {}", al_status::text(*code))
            }
            Self::Gone(joint) => {
                write!(
                    f,
                    "J{joint} does not answer: its supply, or the cable before it"
                )
            }
            Self::Emergency(joint, code) => {
                write!(f, "J{joint}: emergency message {}", fault_text::text(*code))
            }
            Self::History(joint, diagnosis) => {
                write!(f, "J{joint}: the drive's diagnosis history has {diagnosis}")
            }
            Self::TerminalHistory(..)
            | Self::TerminalGone(_)
            | Self::TerminalLeftOp(..)
            | Self::TerminalEmergency(..)
            | Self::SpindleFault(_)
            | Self::SpindleWithoutPower(_)
            | Self::GearNotIn(_)
            | Self::GearLost(_)
            | Self::GearUnknown
            | Self::TerminalsShort
            | Self::LoadSlipped(..) => self.tell_other(f),
            Self::Homing(joint) => write!(f, "J{joint} looks for its home"),
            Self::Home(joint) => write!(f, "J{joint} has found its home"),
            Self::Trouble(trouble) => write!(f, "{trouble}"),
            Self::FrameLost => write!(f, "a frame was lost"),
            Self::BusLost => write!(
                f,
                "the bus is lost: no answer of all drives for several cycles; every drive stops by \
                 itself, and the bus is brought up again"
            ),
            Self::Silence(silent_ns) => write!(
                f,
                "{}: joints stop by themselves, outputs come to rest; `glidepath reset` and `enable` take the \
                 position over anew",
                silence(*silent_ns)
            ),
            Self::Jump(joint) => write!(f, "J{joint}: a setpoint jumped, the joints stop"),
            Self::NobodyStops => {
                write!(
                    f,
                    "a drive failed and the motion went on: the joints stop by themselves"
                )
            }
            Self::Restart => write!(f, "the interpolator was started anew"),
            Self::EncoderSlipped(off) => write!(
                f,
                "the spindle's encoder is off by {off} counts at its index: a cable or its shield, or \
                 counts_per_rev in drives.toml; its angle is not used until the next index"
            ),
            Self::Probe(trouble) => write!(f, "{trouble}"),
        }
    }
}

/// That setpoints stayed away, as the interpolator says it.
#[allow(clippy::cast_precision_loss, reason = "some milliseconds")]
fn silence(silent_ns: u64) -> FaultReport {
    FaultReport {
        cause: FaultCause::SetpointsLost,
        axis: None,
        joint: None,
        drive_fault: 0,
        value: silent_ns as f64 * 1e-9,
        limit: 0.0,
        line: 0,
    }
}
