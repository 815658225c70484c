//! The conversion of configurations of LinuxCNC, grbl and Klipper to ours.
//!
//! ```text
//!   text ─ini, settings─▶ Inputs: every key once ─linuxcnc, grbl, klipper─▶ Draft ─▶ Conversion
//! ```
//!
//! Entry points are [`from_linuxcnc`], [`from_grbl`] and [`from_klipper`]; [`from_screw`] converts a measured screw,
//! and [`recognised`] tells whose configuration a text is.
//!
//! Every key of the input gets exactly one verdict: converted, changed in its meaning, or without
//! a counterpart. Nothing is guessed: what the input does not say is left out with its reason, and
//! the configuration is refused until somebody has written it.
//!
//! ```
//! let conversion = glidepath_migration::from_grbl("$110=6000\n$120=500\n")?;
//! assert!(conversion.configuration.contains("max_velocity = 100.0"));
//! assert!(conversion.asked.iter().any(|asked| asked.key == "axis.X.max_jerk"));
//! # Ok::<(), glidepath_migration::ReadError>(())
//! ```

mod conversion;
mod draft;
mod grbl;
mod ini;
mod inputs;
mod klipper;
mod linuxcnc;
mod recognised;
mod screw;

pub use conversion::{Asked, Conversion, KeyVerdict};
pub use grbl::from_grbl;
pub use ini::{Include, ReadError};
pub use klipper::from_klipper;
pub use linuxcnc::from_linuxcnc;
pub use recognised::{Control, Recognised, recognised};
pub use screw::{ScrewValues, from_screw};
