//! The grbl 1.1 protocol as a state machine: what a sender says, and what it is told.
//!
//! ```text
//!  bytes of the sender ──► Session ──► bytes for the sender
//!                           ▲   │
//!     MachineView, Told ────────┘   └────► Act, Request
//!   (what is known of the      (what is to be done by the machine,
//!    machine and the job)       and lines for the planner's service)
//! ```
//!
//! * [`Session`] is one connection. It takes bytes, and what is known of the machine, and says what is to be
//!   done. It does no I/O, reads no clock (times are given to it), and knows neither processes nor programs.
//! * [`MachineView`] is what the interpolator tells, [`Told`] what the planner's service tells of lines.
//! * [`Act`] is what the machine is to do at once; whether it was is told back ([`Session::accepted`],
//!   [`Session::refused`]). [`Request`] are lines that are to be executed.
//!
//! What always holds:
//!
//! * Every line is answered exactly once, by `ok` or `error:N`, in order, or dropped by a reset.
//! * A real-time character has its effect at once, wherever it stands, and is not answered.
//! * Nothing moves after a reset, an unlocking or a new connection without a new line.
//! * Memory is bounded, whatever the sender does ([`Session::wants_bytes`]).
//!
//! ```
//! use core::time::Duration;
//! use glidepath_grbl::{Doing, MachineView, MachineSettings, Session};
//!
//! let mut session = Session::new(MachineSettings::default());
//! session.see(&MachineView { doing: Doing::Idle, ..MachineView::default() }, Duration::ZERO);
//! session.connected(Duration::ZERO);
//! session.hear(b"$\n?", Duration::ZERO);
//! let said = String::from_utf8(session.take_output()).unwrap();
//! assert!(said.contains("Grbl 1.1") && said.contains("<Idle|MPos:0.000,0.000,0.000"));
//! ```

mod act;
mod alarm;
mod error;
mod facts;
mod intake;
mod jog;
mod jogging;
mod line;
mod machine;
mod numbers;
mod overrides;
mod real_time;
mod report;
mod session;
mod settings;
mod state;
mod stream;
mod words;

pub use act::Act;
pub use alarm::Alarm;
pub use facts::Facts;
pub use machine::{Doing, MachineView, Spindle};
pub use session::Session;
pub use settings::MachineSettings;
pub use stream::{End, JobIntent, Refused, Request, Stage, Told};

/// Axes, in the order of [`LETTERS`]: mm, degrees where they are rotary.
pub const AXES: usize = 9;

/// The letters of the axes.
pub const LETTERS: [char; AXES] = ['X', 'Y', 'Z', 'A', 'B', 'C', 'U', 'V', 'W'];
