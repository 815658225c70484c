//! The fuzz target: any text in the place of a number is read or refused, and what it is worth is
//! finite.
#![no_main]

use glidepath_gcode::{MAX_NUMBER, Options, check};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let line = |byte: &u8| !matches!(byte, b'\n' | b'\r');
    let text: Vec<u8> = bytes.iter().copied().filter(line).collect();
    for head in [&b"G0 X"[..], b"#1=", b"G0 X["] {
        let mut program = b"#2=3\n#<a>=4\n".to_vec();
        program.extend_from_slice(head);
        program.extend_from_slice(&text);
        program.extend_from_slice(b"\nG0 Y#1\n");
        let report = check(program.as_slice(), Options::default());
        assert!(report.final_position.iter().all(|p| p.abs() <= MAX_NUMBER));
        for diagnostic in &report.diagnostics {
            assert!(diagnostic.line >= 1 && diagnostic.line <= 4);
            let shown = diagnostic.excerpt.text.chars().count();
            assert!(diagnostic.excerpt.caret <= shown.max(1), "{diagnostic:?}");
        }
    }
});
