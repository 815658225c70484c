//! The fuzz target: any text is a configuration of grbl or is refused with its place; what is made
//! of it is TOML.
#![no_main]

use glidepath_migration::from_grbl;
use libfuzzer_sys::fuzz_target;

mod support;

fuzz_target!(|bytes: &[u8]| support::convert(bytes, |text, _| from_grbl(text)));
