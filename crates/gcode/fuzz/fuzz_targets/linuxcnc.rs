//! The fuzz target: any program made of LinuxCNC's statements is judged in bounded time, and what
//! is given out is sound.
#![no_main]

#[path = "../../tests/it/dialect_program.rs"]
mod dialect_program;

use glidepath_gcode::Dialect;
use libfuzzer_sys::fuzz_target;

use crate::dialect_program::{judge, program};

fuzz_target!(|bytes: &[u8]| {
    judge(Dialect::LinuxCnc, &program(Dialect::LinuxCnc, bytes));
});
