//! Emulated EtherCAT drives and terminals: the devices on the wire of `glidepath ethercat` in tests and
//! on the desk.
//!
//! ```text
//!   frame ─► device 0 ─► device 1 ─► … ─► frame, with answers and working counters
//!              │ registers, EEPROM, mailbox, clock          (this crate does no I/O)
//!              ├ drive: CiA 402 at every SYNC0, motor with lag, or with loops and inertia; a spindle; touch probe
//!              └ terminal: pins that follow frames, and fall with the watchdog
//! ```
//!
//! A [`Segment`] is handed frames as they come from the wire, changes them as the devices would,
//! and is told the time with each: it reads no clock. Everything between two frames happens in
//! order when the next one comes, because nothing but frames can change its course.
//!
//! It shares no code with the master, whose judge it is: not even the addresses of registers. How
//! the registers behave follows ETG.1000 and the data sheets of Beckhoff's controllers; masters by other
//! people bring its drives into operation, too.
//!
//! Devices hang in a row, or in a tree of cables of any length, and answer as real ones were seen to:
//! garbage in the times of closed ports, terminals that note times and have no clock. Terminals have
//! digital inputs and outputs without a mailbox, or analog ones and encoders with, on a spindle or on the load of a joint;
//! any part of the line can be unplugged.
//!
//! What it does not have: redundancy, complete access to objects, hot connect.
//!
//! ```
//! use glidepath_emulator::{DriveSettings, Segment};
//!
//! let mut segment = Segment::new(&vec![DriveSettings::default(); 3]);
//! // BRD of the type register: every device answers, and counts itself.
//! let mut frame = vec![0; 60];
//! frame[12..14].copy_from_slice(&[0x88, 0xa4]);
//! frame[14..16].copy_from_slice(&(0x1000_u16 | 13).to_le_bytes());
//! frame[16] = 7;
//! frame[22] = 1;
//! segment.pass(&mut frame, 0);
//! assert_eq!(frame[26], 0x11);
//! assert_eq!(u16::from_le_bytes([frame[27], frame[28]]), 3);
//! ```

mod cable;
mod channels;
mod clock;
mod coe;
mod contact;
mod device;
mod dictionary;
mod drive;
mod drive_io;
mod eeprom;
mod encoder;
mod frame;
mod gearbox;
mod injected_fault;
mod load_encoder;
mod long_objects;
mod memory;
mod pins;
mod position_loop;
mod power;
mod process;
mod segment;
mod segment_fault;
mod settings;
mod spindle;
mod states;
mod touch_probe;
mod way;

pub use cable::Cable;
pub use channels::Channels;
pub use clock::ClockKind;
pub use contact::Probe;
pub use encoder::Encoder;
pub use gearbox::{GearPins, Gearbox};
pub use injected_fault::InjectedFault;
pub use load_encoder::LoadEncoder;
pub use pins::OutputRecord;
pub use position_loop::{OffsetAccess, PositionLoop};
pub use segment::{Segment, SyncRecord};
pub use segment_fault::SegmentFault;
pub use settings::{DriveSettings, HomeSwitch, ImageAccess, Maps, OutputWatchdog, SyncType};
pub use spindle::SpindleMotor;
pub use touch_probe::{TouchProbe, ZeroImpulse};
