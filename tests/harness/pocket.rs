//! A program that is hard to plan, and hard to stop on.

use std::fmt::Write as _;

/// Rows of a pocket, with waves on them: corners of every kind, at the limits of the machine nearly all
/// the time. The waves are of another form for each `form`.
#[must_use]
pub fn pocket(rows: u32, form: u32) -> String {
    let mut text = "G21 G90 G64 P0.02 F2400\n".to_owned();
    for row in 0..rows {
        let y = 0.4 * f64::from(row);
        for step in 0..=40_u32 {
            let along = if row % 2 == 0 { step } else { 40 - step };
            let wave = 0.15 * f64::from((step * (7 + form) + row * 3) % (5 + form / 5));
            let _ = writeln!(text, "G1 X{along} Y{:.3}", y + wave);
        }
    }
    text + "M2\n"
}
