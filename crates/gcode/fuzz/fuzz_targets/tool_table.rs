//! The fuzz target: any tool table is read or refused line by line.
#![no_main]

use glidepath_gcode::{MAX_TOOLS, ToolTable};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    match ToolTable::parse(bytes) {
        Ok(table) => assert!(table.len() <= MAX_TOOLS),
        Err(diagnostics) => assert!(!diagnostics.is_empty()),
    }
});
