//! Writes `relief.ngc`: a small relief milled in rows of short chords, the kind of program CAM
//! systems make of smooth surfaces.
//!
//! ```text
//! cargo run -p glidepath --example make_relief > crates/glidepath/examples/relief.ngc
//! ```

use std::io::{BufWriter, Write, stdout};

const WIDTH_MM: f64 = 36.0;
const HEIGHT_MM: f64 = 24.0;
const ROW_MM: f64 = 0.8;
/// Spacing of the points along X; on slopes the chords are up to twice as long.
const CHORD_MM: f64 = 0.15;

/// Height of the surface, mm, between −2.2 and 0.
fn height_mm(x: f64, y: f64) -> f64 {
    let (u, v) = (x - WIDTH_MM / 2.0, y - HEIGHT_MM / 2.0);
    let radius = u.hypot(1.3 * v);
    let ripple = (radius * 0.9).cos() * (-radius * radius / 160.0).exp();
    let swell = 0.35 * (0.35 * u).sin() * (0.5 * v).cos();
    (0.75 * ripple + swell - 1.1).min(0.0)
}

#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "small counts"
)]
fn main() -> std::io::Result<()> {
    let mut out = BufWriter::new(stdout().lock());
    writeln!(
        out,
        "(Relief {WIDTH_MM} x {HEIGHT_MM} mm in rows of {CHORD_MM} mm chords)"
    )?;
    writeln!(out, "G17 G21 G54 G64 G90 G94\nS18000 M3\nG0 Z5")?;
    let rows = (HEIGHT_MM / ROW_MM).round() as u32;
    let points = (WIDTH_MM / CHORD_MM).round() as u32;
    for row in 0..=rows {
        let y = f64::from(row) * ROW_MM;
        for point in 0..=points {
            // Every other row runs back.
            let along = f64::from(if row % 2 == 0 { point } else { points - point });
            let x = along * CHORD_MM;
            let z = height_mm(x, y);
            match (row, point) {
                (0, 0) => writeln!(out, "G0 X{x:.3} Y{y:.3}\nG0 Z1\nF600 G1 Z{z:.3}\nF3000")?,
                (_, 0) => writeln!(out, "G1 X{x:.3} Y{y:.3} Z{z:.3}")?,
                _ => writeln!(out, "X{x:.3} Z{z:.3}")?,
            }
        }
    }
    writeln!(out, "G0 Z5\nM5\nM2")?;
    out.flush()
}
