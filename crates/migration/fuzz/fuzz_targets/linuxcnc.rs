//! The fuzz target: any text is a configuration of LinuxCNC or is refused with its place; what is
//! made of it is TOML.
#![no_main]

use glidepath_migration::from_linuxcnc;
use libfuzzer_sys::fuzz_target;

mod support;

fuzz_target!(|bytes: &[u8]| support::convert(bytes, |text, include| from_linuxcnc(text, include)));
