//! The lines of each dialect, and in which order they are executed.

mod fanuc;
mod fanuc_call;
mod linuxcnc;
mod marlin;
pub(crate) mod siemens;
pub(crate) mod tape;
