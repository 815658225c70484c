//! The fuzz target: any line is read in every language, and diagnostics lie in it.
#![no_main]

use glidepath_gcode::{Connections, Dialect, MAX_NUMBER, Options, check};
use libfuzzer_sys::fuzz_target;

const DIALECTS: [Dialect; 4] = [
    Dialect::LinuxCnc,
    Dialect::Marlin,
    Dialect::Fanuc,
    Dialect::Siemens,
];

fuzz_target!(|bytes: &[u8]| {
    let end = |byte: &u8| matches!(byte, b'\n' | b'\r');
    let line = bytes.split(end).next().unwrap_or_default();
    let mut program = b"G21 G90 F1000\n".to_vec();
    program.extend_from_slice(line);
    program.extend_from_slice(b"\nG0 X1 Y2\n");
    for dialect in DIALECTS {
        let options = Options {
            dialect,
            connections: Connections::Simulated,
            ..Options::default()
        };
        let report = check(program.as_slice(), options);
        assert!(report.final_position.iter().all(|p| p.abs() <= MAX_NUMBER));
        for diagnostic in &report.diagnostics {
            assert!((1..=4).contains(&diagnostic.line), "{diagnostic:?}");
            let length = if diagnostic.line == 2 { line.len() } else { 13 };
            assert!(diagnostic.column as usize <= length + 1, "{diagnostic:?}");
            let shown = diagnostic.excerpt.text.chars().count();
            assert!(diagnostic.excerpt.caret <= shown.max(1), "{diagnostic:?}");
        }
    }
});
