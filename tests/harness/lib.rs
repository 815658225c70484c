//! The harness of the end-to-end tests.
//!
//! * [`Instance`]: shared memory of its own for each test, as many at a time as there are cores, and
//!   the proof that nothing of it is left behind;
//! * [`Watchdog`]: ends a test that hangs, with its processes ([`of_this_test`]);
//! * [`Process`]: processes of the real binary, which [`glidepath`] finds and builds;
//! * [`Services`]: an interpolator and a servo as processes;
//! * [`Operated`]: the same with drives that answer, and what an operator types;
//! * [`Browser`]: Chromium, to look at pages, and [`encrypted`]: TLS, to ask for them;
//! * [`pocket`]: a program that is hard to plan and to stop on;
//! * [`ServoStack`]: drives as a thread of the test, which upsets them, and [`Tape`]: every
//!   setpoint, and what is wrong with them;
//! * [`Machine`]: interpolator, recorder and planner as threads of the test, joined by the
//!   transport that real processes use.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    clippy::print_stderr,
    clippy::missing_panics_doc,
    reason = "a harness fails its test by panicking"
)]

mod binary;
mod browser;
mod instance;
mod machine;
mod operated;
mod pocket;
mod process;
mod seats;
mod served;
mod services;
mod setpoint_file;
mod stack;
mod tape;
mod tls;
mod wall_clock;
mod watchdog;

pub use binary::{glidepath, onlooker};
pub use browser::Browser;
pub use instance::Instance;
pub use machine::{Machine, Recording, Watch, audit, plan, program, program_from, settings};
pub use operated::Operated;
pub use pocket::pocket;
pub use process::{Output, Process};
pub use served::served;
pub use services::{Services, planned};
pub use setpoint_file::SetpointFile;
pub use stack::ServoStack;
pub use tape::Tape;
pub use tls::encrypted;
pub use watchdog::{Watchdog, of_this_test};
