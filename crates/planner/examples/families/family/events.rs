//! Programs with events along their moves that do not stop the motion: a laser's rows with a power at every step,
//! outputs switched on contours.

use crate::random::Random;
use crate::text::Text;
use std::fmt::Write as _;

/// Rows, or a contour of short and long moves, with an event behind many of them.
pub(super) fn engraved(random: &mut Random) -> String {
    let feed_mm_min = random.log_between(600.0, 12_000.0);
    let mut text = Text::new([0.0; 3], feed_mm_min);
    let lines = if random.chance(0.5) {
        rows(random)
    } else {
        contour(random)
    };
    text.raw(lines.trim_end());
    text.finish()
}

/// There and back, with a power at every step.
fn rows(random: &mut Random) -> String {
    let (rows, steps) = (random.whole(2, 4), random.whole(20, 120));
    let step_mm = random.log_between(0.05, 2.0);
    let pitch_mm = random.log_between(0.05, 1.0);
    let mut lines = String::from("M3 S0\n");
    let mut x = 0.0;
    for row in 0..rows {
        let _ = writeln!(lines, "G0 Y{:.4}", f64::from(row) * pitch_mm);
        for _ in 0..steps {
            x += if row % 2 == 0 { step_mm } else { -step_mm };
            let _ = writeln!(lines, "G1 X{x:.4} S{}", random.whole(0, 1000));
        }
    }
    lines + "M5\n"
}

/// Moves any way, arcs among them, with outputs, coolant and powers between.
fn contour(random: &mut Random) -> String {
    let longest_mm = random.log_between(0.3, 20.0);
    let (mut x, mut y) = (0.0, 0.0);
    let mut lines = String::from("M3 S0\n");
    for k in 0..random.whole(15, 60) {
        let (dx, dy) = (
            random.between(-longest_mm, longest_mm),
            random.between(-longest_mm, longest_mm),
        );
        (x, y) = (x + dx, y + dy);
        let _ = match random.whole(0, 3) {
            0 => writeln!(
                lines,
                "G2 X{x:.4} Y{y:.4} I{:.5} J{:.5}",
                0.5 * dx,
                0.5 * dy
            ),
            _ => writeln!(lines, "G1 X{x:.4} Y{y:.4}"),
        };
        let _ = match random.whole(0, 5) {
            0 => writeln!(lines, "M62 P{}", k % 4),
            1 => writeln!(lines, "M63 P{}", k % 4),
            2 => writeln!(lines, "M67 E0 Q{}", random.whole(0, 100)),
            3 => writeln!(lines, "S{}", random.whole(0, 1000)),
            4 => writeln!(lines, "M8"),
            _ => Ok(()),
        };
    }
    lines + "M5\n"
}
