//! The EtherCAT master: setpoints to targets of drives and outputs of terminals, at the bus period, and
//! the positions of the joints and the inputs of terminals back.
//!
//! ```text
//!                      ┌ setpoints ► ring ┐
//!   interpolator ══════╡   (a thread)     ▼
//!   (shared memory)    │      ┌ cycle: demand ► targets ► frame ┐        drives
//!                      │      │  one thread, real time          ╞══ wire ═══════
//!                      │      └ states ◄ inputs ◄ answer ───────┘        SYNC0
//!                      └ feedback, log ◄ rings ┘
//!                          (a thread)
//! ```
//!
//! The process is a consumer of setpoints like any other. What it knows of the drives goes to the
//! interpolator as [`glidepath_link::Feedback`], and what the interpolator wants of them comes with
//! the setpoints, so power, homes and faults are the machine's, not this crate's:
//! [`run`] has the whole.
//!
//! **Why a master of our own.** There are good ones. `ethercrab` 0.7, the one in Rust, was tried: its
//! task for the wire ends with the first frame that comes later than its patience, a CoE emergency in
//! answer to a parameter panics, timeouts are timers of an ordinary thread, and what is left of it
//! when its wire is replaced is the start-up. What a row of CiA 402 drives takes is four kinds of
//! datagrams in a cycle and about ten before: that is less code than keeping a foreign one from doing
//! harm, it can be stepped without threads and clock ([`Wire`] has both), and nothing in the cycle
//! allocates. The price: other people's masters have seen hundreds of devices, and this one has seen
//! the drives of `glidepath-emulator`, which three other masters have accepted.
//!
//! What it does not do: rings of cable, drives without clocks, terminals that work with SYNC0, hot connect,
//! redundancy, safety over EtherCAT.
//!
//! Invariants:
//!
//! * a target is never further from the one before than the joint can go in the time between;
//! * the drives get power together, and only when an operator asked for it after whatever took it;
//! * outputs are at rest where nobody is to be obeyed, and the spindle never starts again by itself;
//! * the cycle makes no allocation; whatever fails in it ends in drives that stop by themselves.

mod abort_text;
mod al_status;
mod axis;
mod bridge;
mod bus;
mod bus_clock;
mod bus_fault;
mod coe;
mod counts;
mod cycle;
mod demand;
mod device;
mod device_state;
mod diagnosis;
mod eeprom;
mod entry;
mod error;
mod event;
mod exchange;
mod fault_text;
mod feed_forward;
mod frame;
mod image;
mod layout;
mod mail;
mod probe;
mod probe_trouble;
mod registers;
mod run;
mod segments;
mod settings;
mod state;
mod terminal;
mod transfer_trouble;
mod turns;
mod wire;

pub use abort_text::text as abort_text;
pub use al_status::text as al_status_text;
pub use bridge::Bridge;
pub use bus::{Init, Op, OutputWatchdog, PreOp, Reception, SafeOp};
pub use bus_clock::{Beat, BusClock, FrameTimes};
pub use bus_fault::BusFault;
pub use coe::{Object, object};
pub use counts::Counts;
pub use cycle::{Ends, drive_bus};
pub use demand::Demand;
pub use device::{ClockKind, Device, Identity, SyncManager, Window};
pub use device_state::DeviceState;
pub use diagnosis::Diagnosis;
pub use entry::{Entry, Mapping};
pub use error::{BusError, RefusedPart};
pub use event::Event;
pub use fault_text::text as fault_text;
pub use feed_forward::{FeedForward, Offsets, TorqueModel};
pub use frame::{Address, Answer, Command, Frame, Slot};
pub use image::{Inputs, Outputs};
pub use probe::{ProbeInputs, ProbeUse, TouchProbe};
pub use probe_trouble::ProbeTrouble;
pub use run::{Listeners, RunError, RunSettings, run};
pub use settings::{BusSettings, DEVICE_AXES, DriveSettings, HomingSettings, Settings};
pub use terminal::{
    ANALOG_INPUTS, AnalogInput, AnalogOutput, At, DIGITAL_INPUTS, DigitalInput, DigitalOutput,
    EncoderSettings, EncoderUse, Gear, GearSettings, JointEncoderSettings, MOST_GEARS,
    OrientationSettings, Parameter, Quantity, Signal, SpindleMode, SpindleSettings, Swing,
    TerminalSettings,
};
pub use transfer_trouble::TransferTrouble;
pub use wire::{MAX_FRAME, PacketWire, Wire, WireError};
