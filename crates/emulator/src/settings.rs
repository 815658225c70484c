//! The settings of an emulated drive: what it is, and in what it is like real ones.

use crate::channels::Channels;
use crate::clock::ClockKind;
use crate::position_loop::{OffsetAccess, PositionLoop};
use crate::segment_fault::SegmentFault;
use crate::spindle::SpindleMotor;
use crate::touch_probe::TouchProbe;

/// A switch at which a drive finds its home.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct HomeSwitch {
    /// Where it is, as the encoder counts.
    pub at_counts: i64,
}

/// The datagrams by which a device takes process data, and how it says so.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum ImageAccess {
    /// LRW, LRD and LWR.
    #[default]
    Both,
    /// Not LRW: its features say so (0x0008, bit 9).
    NoLrwByFeatures,
    /// Not LRW: its EEPROM says so (general flags, bit 1).
    NoLrwByEeprom,
}

/// The watchdog of a device's outputs: bit 6 in the control of their sync manager.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum OutputWatchdog {
    /// Its EEPROM has the bit.
    #[default]
    Told,
    /// Its EEPROM does not have it, as an AKD's; the master can set it.
    Untold,
    /// The bit cannot be set.
    Never,
}

/// What a drive lets the master do with its maps of process data.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub enum Maps {
    /// The master maps what it likes, in one map.
    #[default]
    Free,
    /// A map has 8 bytes at most, and each way an even length, as at an AKD.
    Short,
    /// They are as they are: 0x1701 and 0x1B01 with these entries, index, subindex and bits of each.
    Fixed {
        /// Outputs of the master.
        outputs: Vec<u32>,
        /// Inputs of the master.
        inputs: Vec<u32>,
    },
}

/// What a drive makes of its synchronization type, 0x1C32:1 and 0x1C33:1.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum SyncType {
    /// It is what the master writes, and 0 before.
    #[default]
    Written,
    /// It cannot be written: by SYNC0 if that runs when the drive goes to SAFE-OP, else by frames.
    Follows,
    /// It cannot be written, and is this.
    Fixed(u8),
}

/// A drive as it is delivered.
#[derive(Debug, Clone, PartialEq)]
pub struct DriveSettings {
    /// Vendor, product, revision and serial number.
    pub identity: [u32; 4],
    /// Its name in the EEPROM.
    pub name: String,
    /// Its drives: objects of each are 0x800 behind those of the one before, maps 0x10.
    pub axes: usize,
    /// What each of them counts at the start; those that are not here, 0.
    pub start_counts: Vec<i32>,
    /// The lowest and the highest number of its counter (0x607B), which goes round between them; `None` for 32 bits
    /// that end.
    pub range: Option<(i32, i32)>,
    /// Time constant of its lag, s; 0 for none.
    pub lag_t: f64,
    /// Its loops and its motor, in the place of a lag.
    pub position_loop: Option<PositionLoop>,
    /// What it has of the objects of velocity and torque beside a target.
    pub offsets: OffsetAccess,
    /// How long it takes from "switched on" to "operation enabled", s: a brake opens.
    pub brake_t: f64,
    /// Deviation of its quartz, ppm.
    pub drift_ppm: f64,
    /// The switch by which it finds its home; `None` fails every homing but those at the present
    /// position.
    pub home: Option<HomeSwitch>,
    /// The window of following errors that it is delivered with, counts.
    pub following_counts: u32,
    /// Its maps.
    pub maps: Maps,
    /// Its objects of more than four bytes, by index and subindex.
    pub long_objects: Vec<((u16, u8), Vec<u8>)>,
    /// What it does wrong where those go in segments.
    pub segment_fault: SegmentFault,
    /// Objects that it does not have.
    pub lacks: Vec<u16>,
    /// Whether it keeps a diagnosis history (0x10F3) of what is injected into it.
    pub has_history: bool,
    /// Whether its EEPROM says where its process data is.
    pub tells_managers: bool,
    /// How it takes process data.
    pub image: ImageAccess,
    /// The watchdog of its outputs.
    pub watchdog: OutputWatchdog,
    /// Whether it takes a message with the number of the one before for the same one, and drops it.
    pub drops_repeats: bool,
    /// Its synchronization type.
    pub sync_type: SyncType,
    /// Its distributed clock.
    pub clock: ClockKind,
    /// Whether it has a mailbox and objects; a coupler or a simple terminal does not.
    pub has_mailbox: bool,
    /// Its inputs and outputs, if it is no drive.
    pub channels: Option<Channels>,
    /// What it turns, if that is a spindle, in a mode of velocity.
    pub spindle: Option<SpindleMotor>,
    /// Its touch probe, of each of its drives; `None` if it lacks the objects.
    pub touch_probe: Option<TouchProbe>,
    /// Its whole EEPROM; `None` for one that says what is said here.
    pub eeprom: Option<Vec<u8>>,
}

impl DriveSettings {
    /// A terminal or a coupler, which has nothing of a drive: no mailbox, no objects, no process data.
    #[must_use]
    pub fn terminal(name: &str, clock: ClockKind) -> Self {
        Self {
            identity: [2, 0x03ec_3052, 1, 0],
            name: name.to_owned(),
            clock,
            has_mailbox: false,
            ..Self::default()
        }
    }

    /// Digital inputs, as an EL1004 has four: a window of a bit each, and no clock.
    #[must_use]
    pub fn inputs(count: u16) -> Self {
        Self {
            channels: Some(Channels {
                inputs: Channels::bits(0x6000, count),
                ..Channels::default()
            }),
            ..Self::terminal("INPUTS", ClockKind::ReceiveTimes)
        }
    }

    /// Digital outputs, as an EL2004 has four, or an EL2889 sixteen in two windows: they fall with the
    /// watchdog.
    #[must_use]
    pub fn outputs(count: u16) -> Self {
        Self {
            identity: [2, 0x07d4_3052, 1, 0],
            channels: Some(Channels {
                outputs: Channels::bits(0x7000, count),
                output_windows: usize::from(count.div_ceil(8)),
                ..Channels::default()
            }),
            ..Self::terminal("OUTPUTS", ClockKind::ReceiveTimes)
        }
    }

    /// Analog inputs with a mailbox, as an EL3004 has four: state and value of each in a map, or the value
    /// alone in the next one. All states and values are assigned.
    #[must_use]
    pub fn analog_inputs(count: u16) -> Self {
        let of = |nth: u16| {
            let index = u32::from(0x6000 + 0x10 * nth) << 16;
            let state = [0x0101, 0x0201, 0x0302, 0x0502, 0x0701, 0x0f01, 0x1001];
            let gap = 7;
            let mut both: Vec<u32> = state.iter().map(|entry| index | entry).collect();
            both.insert(5, gap);
            both.push(index | 0x1110);
            [both, vec![index | 0x1110]]
        };
        let maps = 0x1a00..0x1a00 + 2 * count;
        Self {
            identity: [2, 0x0bbc_3052, 1, 0],
            has_mailbox: true,
            channels: Some(Channels {
                inputs: (0..count).flat_map(of).collect(),
                assigned: Some(maps.step_by(2).collect()),
                ..Channels::default()
            }),
            ..Self::terminal("ANALOG INPUTS", ClockKind::ReceiveTimes)
        }
    }

    /// An encoder's counter with a mailbox, as an EL5151 has it: 16 or 32 bits.
    #[must_use]
    pub fn encoder(bits: u32) -> Self {
        let numbers = [0x6000_1100, 0x6000_1200].map(|number| number | bits);
        let inputs = [&[0x6000_0101, 0x6000_0201, 14], &numbers[..]].concat();
        Self {
            identity: [2, 0x141f_3052, 1, 0],
            has_mailbox: true,
            channels: Some(Channels {
                inputs: vec![inputs],
                outputs: vec![vec![0x7000_0101, 0x7000_0201, 14]],
                ..Channels::default()
            }),
            ..Self::terminal("ENCODER", ClockKind::ReceiveTimes)
        }
    }

    /// Analog outputs with a mailbox, as an EL4002 has two: a value each.
    #[must_use]
    pub fn analog_outputs(count: u16) -> Self {
        let of = |nth: u16| vec![u32::from(0x7000 + 0x10 * nth) << 16 | 0x0110];
        Self {
            identity: [2, 0x0fa2_3052, 1, 0],
            has_mailbox: true,
            channels: Some(Channels {
                outputs: (0..count).map(of).collect(),
                ..Channels::default()
            }),
            ..Self::terminal("ANALOG OUTPUTS", ClockKind::ReceiveTimes)
        }
    }
}

impl Default for DriveSettings {
    /// A drive that begins at zero, 2 ms behind, with an exact quartz.
    fn default() -> Self {
        Self {
            identity: [0x0000_0e1e, 0x0402, 1, 0],
            name: "GPDRIVE".to_owned(),
            axes: 1,
            start_counts: Vec::new(),
            range: None,
            lag_t: 0.002,
            position_loop: None,
            offsets: OffsetAccess::None,
            brake_t: 0.02,
            drift_ppm: 0.0,
            home: None,
            following_counts: u32::MAX,
            maps: Maps::Free,
            long_objects: Vec::new(),
            segment_fault: SegmentFault::None,
            lacks: Vec::new(),
            has_history: false,
            tells_managers: true,
            image: ImageAccess::Both,
            watchdog: OutputWatchdog::Told,
            drops_repeats: false,
            sync_type: SyncType::Written,
            clock: ClockKind::Bits64,
            has_mailbox: true,
            channels: None,
            spindle: None,
            touch_probe: None,
            eeprom: None,
        }
    }
}
