//! Process data of one drive: what it means.

use crate::feed_forward::Offsets;
use crate::layout::{Layout, ProbeAccess};
use crate::probe::{ProbeInputs, ProbeUse};
use crate::state;
use glidepath_link::DriveState;

/// The outputs of the master to a drive.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Outputs {
    /// Controlword, 0x6040.
    pub control: u16,
    /// Target position, 0x607A, counts.
    pub target: i64,
    /// Mode of operation, 0x6060.
    pub mode: i8,
    /// What the target takes, 0x60B1 and 0x60B2; zero where nothing moves.
    pub offsets: Offsets,
    /// What the unit of its touch probe does, 0x60B8.
    pub probe: ProbeUse,
    /// What it keeps is to be asked, where it is not in the process data.
    pub asks_probe: bool,
}

/// The inputs of the master from a drive.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Inputs {
    /// Statusword, 0x6041.
    pub status: u16,
    /// Actual position, 0x6064, counts: all that were counted, where the counter goes round.
    pub actual: i64,
    /// Mode that is in force, 0x6061.
    pub mode: i8,
    /// Error code, 0x603F.
    pub fault: u16,
    /// Digital inputs, 0x60FD; 0 if they are not mapped.
    pub digital: u32,
    /// Touch probe, 0x60B9 and what it keeps.
    pub probe: ProbeInputs,
}

/// "Generic error" by CiA 301.
const ANY_FAULT: u16 = 0x1000;
/// Cyclic synchronous position.
pub(crate) const CYCLIC_POSITION: i8 = 8;
/// Homing by the drive.
pub(crate) const HOMING: i8 = 6;

impl Default for Outputs {
    /// No power, at zero.
    fn default() -> Self {
        Self {
            control: 0,
            target: 0,
            mode: CYCLIC_POSITION,
            offsets: Offsets::NONE,
            probe: ProbeUse::Off,
            asks_probe: false,
        }
    }
}

impl Outputs {
    /// No power, and the target where the drive stands.
    #[must_use]
    pub const fn standing(inputs: &Inputs) -> Self {
        Self {
            control: 0,
            target: inputs.actual,
            mode: CYCLIC_POSITION,
            offsets: Offsets::NONE,
            probe: ProbeUse::Off,
            asks_probe: false,
        }
    }

    /// Writes it where a drive has it among the outputs of its device.
    pub(crate) fn put(self, layout: &Layout, bytes: &mut [u8]) {
        let mut write = |at: usize, value: &[u8]| {
            if let Some(place) = bytes.get_mut(at..at + value.len()) {
                place.copy_from_slice(value);
            }
        };
        write(layout.control, &self.control.to_le_bytes());
        write(layout.target, &shown(layout, self.target).to_le_bytes());
        if let Some(at) = layout.mode {
            write(at, &self.mode.to_le_bytes());
        }
        if let Some(at) = layout.velocity_offset {
            write(at, &self.offsets.velocity.to_le_bytes());
        }
        if let Some(at) = layout.torque_offset {
            write(at, &self.offsets.torque.to_le_bytes());
        }
        if let Some(access) = layout.probe
            && let Some(at) = access.function
        {
            let function = access.probe.function(access.before, self.probe);
            write(at, &function.to_le_bytes());
        }
    }
}

impl Inputs {
    /// From where a drive has it, `before` having been its counts. A mode that is not mapped is the one that the drive was set to, and a
    /// number of its fault that is not mapped is that of any.
    pub(crate) fn take(layout: &Layout, bytes: &[u8], before: i64) -> Option<Self> {
        let word = |at: usize| {
            bytes
                .get(at..)?
                .first_chunk()
                .copied()
                .map(u16::from_le_bytes)
        };
        let status = word(layout.status)?;
        let is_faulted = matches!(
            state::of(status),
            DriveState::Fault | DriveState::FaultReaction
        );
        let actual = i32::from_le_bytes(*bytes.get(layout.actual..)?.first_chunk()?);
        Some(Self {
            status,
            actual: counted(layout, actual, before),
            mode: match layout.shown_mode {
                Some(at) => i8::from_le_bytes([*bytes.get(at)?]),
                None => CYCLIC_POSITION,
            },
            fault: match layout.fault {
                Some(at) => word(at)?,
                None if is_faulted => ANY_FAULT,
                None => 0,
            },
            digital: match layout.digital {
                Some(at) => u32::from_le_bytes(*bytes.get(at..)?.first_chunk()?),
                None => 0,
            },
            probe: match layout.probe {
                Some(access) => {
                    probe(access, bytes)?.near(layout.round, counted(layout, actual, before))
                }
                None => ProbeInputs::default(),
            },
        })
    }
}

/// What the counter of a drive is to show.
#[allow(clippy::cast_possible_truncation, reason = "inside of it, or round it")]
fn shown(layout: &Layout, counts: i64) -> i32 {
    layout
        .round
        .map_or(counts as i32, |round| round.shown(counts))
}

/// What it has counted, by what it shows and by what it had counted before.
fn counted(layout: &Layout, shown: i32, before: i64) -> i64 {
    let round = layout.round.map(|round| round.counts(shown, before));
    round.unwrap_or_else(|| shown.into())
}

/// What a touch probe that is mapped says; nothing of one that is not.
fn probe(access: ProbeAccess, bytes: &[u8]) -> Option<ProbeInputs> {
    let Some(places) = access.places else {
        return Some(ProbeInputs::default());
    };
    let status = *bytes.get(places.status..)?.first_chunk()?;
    let kept = |at: usize| Some(i32::from_le_bytes(*bytes.get(at..)?.first_chunk()?).into());
    Some(ProbeInputs {
        status: access.probe.status(u16::from_le_bytes(status)),
        places: [kept(places.kept[0])?, kept(places.kept[1])?],
    })
}
