//! Devices that are no drives: couplers, inputs, outputs.
//!
//! | file | has |
//! |---|---|
//! | `settings` | what the file says of them |
//! | `signal` | what outputs obey |
//! | `commands` | what is commanded, and when |
//! | `bits`, `wiring` | where in the process data everything is |
//! | `driven` | outputs, cycle by cycle |
//! | `spindle_settings`, `spindle_wiring`, `spindle_drive` | a spindle on a drive in velocity mode |
//! | `encoder_settings`, `encoder_wiring`, `encoder` | the spindle's encoder |
//! | `worked` | all of it at work |

mod bits;
mod commands;
mod driven;
mod encoder;
mod encoder_settings;
mod encoder_wiring;
mod settings;
mod signal;
mod spindle_drive;
mod spindle_settings;
mod spindle_wiring;
mod unwired;
mod wiring;
mod worked;

pub use encoder_settings::EncoderSettings;
pub use settings::{
    ANALOG_INPUTS, AnalogInput, AnalogOutput, At, DIGITAL_INPUTS, DigitalInput, DigitalOutput,
    Parameter, TerminalSettings,
};
pub use signal::{Quantity, Signal};
pub use spindle_settings::{SpindleMode, SpindleSettings};

pub(crate) use driven::at_rest;
pub(crate) use wiring::Wiring;
pub(crate) use worked::{Answered, Terminals};
