//! The interpolator process: frames to setpoints, one per period.
//!
//! It stands between the planner, which sends the state of the machine on the grid of program time
//! ([`SetpointFrame`](glidepath_link::SetpointFrame)), and the drives, which get a
//! [`Setpoint`](glidepath_link::Setpoint) at every tick of the clock. It does not plan. What it
//! decides is how fast program time passes: 0 to 1 periods a tick, for feed hold, resume and
//! overrides below the planned one, and to come to rest before the frames run out.
//!
//! ```text
//! planner ─ frames ─► ports thread ─ validation ─► ring ─► real-time thread
//! servo  ◄ setpoints ─┘   ▲ commands                       │ tick: one setpoint a period
//! anybody ◄ status ───────┴───────────── ring ◄────────────┘
//! ```
//!
//! Entry points:
//!
//! * [`run`] starts both threads with a [`Config`] and a transport, and returns when it is told to
//!   stop and the motion has come to rest;
//! * [`stepped`] is the real-time thread's work without a thread, a clock or ports, for
//!   measurements and simulation: it is driven tick by tick.
//!
//! Inside there are four rooms, and an arrow is what a room may know (a test holds them to it, see the map of the code):
//!
//! ```text
//!            ┌─► ports ─────┐       everything that talks to other processes
//!  process ──┤              ├─► shared
//!            └─► real_time ─┘       one setpoint a period
//! ```
//!
//! `process` starts both threads, and ends them. The threads do not know each other: what one wants of the other passes
//! rings of fixed size (`shared::message`). `shared` also has what both know: the configuration, and what has to be the
//! same for both.
//!
//! What the real-time thread owns lies together, axes in `pairs`, and is not moved: after a period
//! of sleep the caches are cold, and a tick takes as long as the lines of memory and of code it
//! touches.
//!
//! Invariants:
//!
//! * the real-time thread makes no system call but the sleep and the reading of the clock, and no
//!   allocation;
//! * published positions keep every axis inside its limits by finite differences;
//! * at rate 1 the setpoints are the frames, bit for bit;
//! * whatever fails, the motion comes to rest on the path.
//!
//! A feed hold in the middle of a motion, and the rest of it after a resume:
//!
//! ```
//! use glidepath_interpolator::{Config, stepped};
//! use glidepath_link::{Command, MachineState, SetpointFrame};
//! use glidepath_program::{FrameFlags, Limits};
//!
//! // 10 mm along X within a second, as a planner samples it: a frame every 4 ms.
//! let frame = |sequence: u64| {
//!     let u = sequence as f64 / 250.0;
//!     let mut frame: SetpointFrame = bytemuck::Zeroable::zeroed();
//!     (frame.epoch, frame.sequence, frame.period_ns) = (1, sequence, 4_000_000);
//!     frame.planned_override = 1.0;
//!     frame.position[0] = 10.0 * u.powi(3) * (10.0 - 15.0 * u + 6.0 * u * u);
//!     frame.velocity[0] = 300.0 * u.powi(2) * (1.0 - u).powi(2);
//!     frame.acceleration[0] = 600.0 * u * (1.0 - u) * (1.0 - 2.0 * u);
//!     frame.flags = match sequence {
//!         0 => FrameFlags::FIRST.0,
//!         250 => FrameFlags::LAST.0,
//!         _ => 0,
//!     };
//!     frame
//! };
//!
//! let config = Config::new(Limits::uniform(100.0, 1_000.0, 10_000.0), 4_000_000);
//! let end = stepped(&config, |machine| {
//!     let (mut sent, mut setpoint) = (0, machine.tick());
//!     for tick in 0..800 {
//!         // A planner publishes 0.6 s of motion ahead.
//!         while sent <= 250 && sent < setpoint.sequence + 150 && machine.offer(&frame(sent)) {
//!             sent += 1;
//!         }
//!         match tick {
//!             100 => assert!(machine.command(Command::Hold)),
//!             300 => assert!(machine.command(Command::Resume)),
//!             _ => {}
//!         }
//!         setpoint = machine.tick();
//!         if tick == 299 {
//!             assert_eq!(setpoint.state(), Ok(MachineState::Held));
//!             assert!(setpoint.position[0] > 0.0 && setpoint.position[0] < 10.0);
//!         }
//!     }
//!     setpoint
//! });
//! assert_eq!(end.state(), Ok(MachineState::Idle));
//! assert_eq!(end.position[0], 10.0);
//! ```

#![cfg_attr(glidepath_rtsan, feature(sanitize))]

mod ports;
mod process;
mod real_time;
mod shared;
#[cfg(test)]
mod testing;

/// Unit tests prove that the real-time thread does not allocate.
#[cfg(test)]
#[global_allocator]
static ALLOCATOR: glidepath_realtime::CountingAllocator = glidepath_realtime::CountingAllocator;

pub use process::loops::{RunError, lead_ns};
pub use process::run::run;
pub use process::served::{Served, served};
pub use process::stepped::{Stepped, stepped};
pub use shared::config::feedback::{AdaptiveFeed, FeedbackSettings, JointFeedback, ProbeInput};
pub use shared::config::homing::{HomingError, IndexPulse, JointBounds, JointHoming};
pub use shared::config::stops::StopSettings;
pub use shared::config::superposition::{Superposition, SuperpositionControl};
pub use shared::config::{Config, Gantry, JogSettings, RealTime, SoftLimits};
pub use shared::m_code_waits::{AnswerSource, MAX_M_CODE_WAITS, MCodeWait, MCodeWaits};
