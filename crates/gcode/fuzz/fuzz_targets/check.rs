//! Any bytes are judged without a panic, and what is given out is sound.
//!
//! ```text
//! cd crates/gcode && cargo +nightly fuzz run check
//! ```
#![no_main]

use glidepath_gcode::{Machine, Options, Program, Travel, check};
use glidepath_geometry::{Axis, AxisVector};
use glidepath_motion::{ItemKind, Rate};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let travel = Travel {
        min: -500.0,
        max: 500.0,
    };
    let options = Options {
        machine: Machine::unlimited().with_travel(Axis::X, travel),
        default_feed_mm_min: Some(1000.0),
        block_delete: false,
        start: AxisVector::zeros(),
    };
    let report = check(bytes, options.clone());
    let mut end = options.start;
    // A loop of the program may have no end.
    for item in Program::new(bytes, options).take(10_000) {
        match item {
            Ok(item) => match item.kind {
                ItemKind::Move { segment, rate, .. } => {
                    assert_eq!(segment.start(), end);
                    end = segment.end();
                    assert!(end.iter().all(|p| p.is_finite()));
                    assert!(end[0].abs() <= 500.001);
                    assert!(segment.length() > 0.0);
                    assert!(rate == Rate::Rapid || matches!(rate, Rate::Feed(v) if v > 0.0));
                }
                ItemKind::Dwell(seconds) => assert!(seconds >= 0.0),
                ItemKind::Event(_) => {}
            },
            Err(finding) => assert_eq!(report.diagnostics.first(), Some(&finding)),
        }
    }
});
