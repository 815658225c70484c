//! The lines of each dialect, and in which order they are executed.

pub(crate) mod fanuc;
mod kept_places;
mod klipper;
mod linuxcnc;
pub(crate) mod macro_call;
mod marlin;
pub(crate) mod siemens;
pub(crate) mod tape;
