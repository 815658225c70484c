//! The fuzz target: any text is a parameter file of LinuxCNC or is refused with its line; what is
//! read can be written and read again.
#![no_main]

use glidepath_persistence::var::{Units, export, import};
use libfuzzer_sys::fuzz_target;

const UNITS: Units = Units {
    linear_mm: 1.0,
    angular_deg: 1.0,
};

fuzz_target!(|bytes: &[u8]| {
    let Ok(text) = core::str::from_utf8(bytes) else {
        return;
    };
    match import(text, UNITS) {
        Ok(read) => {
            let again = import(&export(&read.offsets, UNITS), UNITS).expect("its own file");
            assert!(again.others.is_empty());
        }
        Err(error) => assert!(error.line as usize <= text.lines().count().max(1) + 1),
    }
});
