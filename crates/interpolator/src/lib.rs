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
//! Inside:
//!
//! * `tick` is one period of the real-time thread, done just before the deadline but for the time
//!   stamp. It owns a `track` (the frames ahead), a `rate` (of program time: the essay on hold,
//!   resume and override is there, and the diagram of its states), a `queue_level` (are there frames
//!   enough?), `stop_requests` (what stops the motion), a `single_block_stop` (the end of a block to
//!   rest at) and a `wait` (for the answer to an event);
//! * `spindle` is what a pass of a thread follows instead of the clock;
//! * `jog` moves the axes by hand, and away from a path that is held and back to it, with a `tracker`
//!   for what follows no program;
//! * `setpoint` writes what is published, and `joints` turns its axes into those of the mechanism;
//!   `limited_joints` are these along the frames ahead, as limits of the rate;
//! * `frame_validation` judges every frame before the real-time thread sees it, and `commands` every
//!   command;
//! * `ports` is one turn of the ports thread, `loops` are the two threads on their common grid.
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

mod acknowledgements;
mod auxiliary;
mod block_end;
mod block_starts;
mod code_words;
mod commands;
mod compensated;
mod config;
mod counters;
mod differences;
mod drives;
mod events_told;
mod fault;
mod feedback;
mod frame_summary;
mod frame_validation;
mod homing;
mod job;
mod jog;
mod joints;
mod limited_joints;
mod loops;
mod m_code_waits;
mod message;
mod output;
mod pairs;
mod ports;
mod probing;
mod program_time;
mod queue_level;
mod quintic;
mod ramp;
mod rate;
mod rest;
mod retrace;
mod run;
mod served;
mod setpoint;
mod single_block_stop;
mod spindle;
mod status;
mod stepped;
mod stop_requests;
mod stop_time;
mod stops;
mod superposition;
#[cfg(test)]
mod testing;
mod tick;
mod tick_statistics;
mod told_by_hand;
mod tool_change;
mod track;
mod tracker;
mod wait;

/// Unit tests prove that the real-time thread does not allocate.
#[cfg(test)]
#[global_allocator]
static ALLOCATOR: glidepath_realtime::CountingAllocator = glidepath_realtime::CountingAllocator;

pub use config::{Config, Gantry, JogSettings, RealTime, SoftLimits};
pub use feedback::{AdaptiveFeed, FeedbackSettings, JointFeedback, ProbeInput};
pub use homing::{HomingError, JointBounds, JointHoming};
pub use loops::{RunError, lead_ns};
pub use m_code_waits::{AnswerSource, MAX_M_CODE_WAITS, MCodeWait, MCodeWaits};
pub use run::run;
pub use served::{Served, served};
pub use stepped::{Stepped, stepped};
pub use stops::StopSettings;
pub use superposition::{Superposition, SuperpositionControl};
