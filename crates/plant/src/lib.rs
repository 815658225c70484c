//! A simulated servo stack with its machine: drives with lag and stiction, switches, a spindle, a
//! probe, and the feedback of all that.
//!
//! ```text
//! setpoints ─► (servo library) ─► demand ─► Plant: joints, spindle ─► Feedback
//!                                             ▲ injected faults: a drive fails, power goes, feedback stays away
//! ```
//!
//! It is the other side of the interpolator in tests, and what `glidepath servo` plays setpoints on.
//! It reads no clock and does no I/O: it is stepped, and steps of about a millisecond are right. Where more than one
//! setpoint arrives between two steps, [`Plant::hear`] takes each of them.
//!
//! ```
//! use glidepath_link::{Setpoint, servo::JointState};
//! use glidepath_plant::{JointSettings, Plant};
//!
//! let mut plant = Plant::new(7, &[JointSettings::default(); 3]);
//! let mut setpoint: Setpoint = bytemuck::Zeroable::zeroed();
//! setpoint.enable = 0b111;
//! let mut demand = [JointState::default(); 9];
//! demand[0].position = 5.0;
//! for ms in 0..1000 {
//!     plant.step(ms * 1_000_000, Some(&setpoint), Some(&demand));
//! }
//! let feedback = plant.feedback().expect("no fault is injected");
//! assert_eq!(feedback.enabled, 0b111);
//! assert!((feedback.position[0] - 5.0).abs() < 1e-6);
//! ```

mod joint;
mod machine;
mod spindle;

pub use joint::{HomeSettings, JointSettings, SwitchSettings};
pub use machine::{INDEX_INPUT, InjectedFault, Plant};
pub use spindle::SpindleSettings;
