//! The fuzz target: any text is a curve file or is refused with a place; a curve that is accepted
//! can be followed.
#![no_main]

use glidepath_curve::{ChordRule, CurveFile, FileDiagnostic, NurbsFile};
use libfuzzer_sys::fuzz_target;

/// Chords followed along a curve, and their rule.
const CHORDS: usize = 10;
const RULE: ChordRule = ChordRule {
    longest_mm: 0.5,
    error_mm: 0.01,
};

fn is_in(text: &str, diagnostic: &FileDiagnostic) {
    assert!(!diagnostic.message.is_empty());
    assert!(diagnostic.at.start <= diagnostic.at.end && diagnostic.at.end <= text.len());
}

fuzz_target!(|bytes: &[u8]| {
    let Ok(text) = core::str::from_utf8(bytes) else {
        return;
    };
    if NurbsFile::is_meant(text) {
        match NurbsFile::parse(text) {
            Ok(file) => {
                let (start, end) = file.curve.domain();
                for u in [start, 0.5 * (start + end), end] {
                    assert!(file.curve.jet(u).position.iter().all(|p| p.is_finite()));
                }
            }
            Err(diagnostic) => is_in(text, &diagnostic),
        }
        return;
    }
    match CurveFile::parse(text) {
        Ok(file) => {
            let Ok(mut chords) = file.chords(RULE) else {
                return;
            };
            for _ in 0..CHORDS {
                let Ok(Some(chord)) = chords.next_chord() else {
                    return;
                };
                assert!(chord.point.iter().all(|p| p.is_finite()));
                assert!(chord.chord_mm > 0.0 && chord.chord_mm <= 1.001 * RULE.longest_mm);
                assert!(chord.error_mm <= RULE.error_mm);
            }
        }
        Err(diagnostics) => {
            assert!(!diagnostics.is_empty());
            diagnostics.iter().for_each(|diagnostic| is_in(text, diagnostic));
        }
    }
});
