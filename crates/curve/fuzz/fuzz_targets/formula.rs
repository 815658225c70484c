//! The fuzz target: any text is a formula or is refused; what a formula is worth lies in its own
//! enclosure.
#![no_main]

use glidepath_curve::Expression;
use glidepath_geometry::number::Interval;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let Ok(text) = core::str::from_utf8(bytes) else {
        return;
    };
    let Ok(formula) = Expression::parse(text, &["t", "x"]) else {
        return;
    };
    for at in [[0.0, 0.0], [1.0, -2.5], [-1e3, 1e-9]] {
        let value: f64 = formula.eval(&at);
        let enclosure = formula.eval(&at.map(|v| Interval::new(v, v)));
        assert!(!value.is_finite() || enclosure.contains(value));
    }
});
