//! Devices that are no drives: couplers, inputs, outputs.
//!
//! | file | has |
//! |---|---|
//! | `settings`, `at` | what the file says of them |
//! | `signal` | what outputs obey |
//! | `commands` | what is commanded, and when |
//! | `bits`, `wiring` | where in the process data everything is |
//! | `driven` | outputs, cycle by cycle |
//! | `spindle_settings`, `spindle_wiring`, `spindle_drive`, `orienting` | a spindle on a drive in velocity mode, and at an angle |
//! | `gear_settings`, `gearbox` | the gears of that spindle |
//! | `encoder_settings`, `encoder_wiring`, `encoder` | the spindle's encoder |
//! | `joint_encoder` | encoders of joints |
//! | `counter` | a counter without its wraps, of both |
//! | `worked` | all of it at work |

mod at;
mod bits;
mod commands;
mod counter;
mod driven;
mod encoder;
mod encoder_settings;
mod encoder_wiring;
mod gear_settings;
mod gearbox;
mod joint_encoder;
mod orienting;
mod settings;
mod signal;
mod spindle_drive;
mod spindle_settings;
mod spindle_wiring;
mod unwired;
mod wiring;
mod worked;

pub use at::At;
pub use encoder_settings::EncoderSettings;
pub use gear_settings::{Gear, GearSettings, MOST_GEARS, Swing};
pub use joint_encoder::{EncoderUse, JointEncoderSettings};
pub use orienting::OrientationSettings;
pub use settings::{
    ANALOG_INPUTS, AnalogInput, AnalogOutput, DIGITAL_INPUTS, DigitalInput, DigitalOutput,
    Parameter, TerminalSettings,
};
pub use signal::{Quantity, Signal};
pub use spindle_settings::{SpindleMode, SpindleSettings};

pub(crate) use driven::at_rest;
pub(crate) use spindle_drive::SpindleLoss;
pub(crate) use wiring::Wiring;
pub(crate) use worked::{Answered, Terminals};
