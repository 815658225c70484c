//! The writer of NURBS curve files.

use core::fmt::Write as _;
use glidepath_geometry::{AXES, Nurbs};

/// The TOML of a curve: numbers that read back bit for bit, as many coordinates as any point needs,
/// at least two.
#[must_use]
pub fn to_toml(name: &str, feed_mm_min: Option<f64>, curve: &Nurbs) -> String {
    let points = curve.control_points();
    let used = (0..AXES)
        .rev()
        .find(|axis| points.iter().any(|point| point[*axis] != 0.0))
        .map_or(2, |axis| (axis + 1).max(2));
    // Writing to a String does not fail.
    let mut text = String::new();
    let _ = writeln!(text, "name = {}", toml::Value::String(name.to_owned()));
    if let Some(feed) = feed_mm_min {
        let _ = writeln!(text, "feed = {feed:?}  # mm/min");
    }
    let _ = writeln!(text, "degree = {}", curve.degree());
    text.push_str("control_points = [  # mm\n");
    for point in points {
        let coordinates: Vec<String> = point.iter().take(used).map(|x| format!("{x:?}")).collect();
        let _ = writeln!(text, "  [{}],", coordinates.join(", "));
    }
    text.push_str("]\n");
    list(&mut text, "weights", curve.weights());
    list(&mut text, "knots", curve.knots());
    text
}

fn list(text: &mut String, key: &str, numbers: &[f64]) {
    let _ = writeln!(text, "{key} = [");
    for row in numbers.chunks(8) {
        let row: Vec<String> = row.iter().map(|x| format!("{x:?}")).collect();
        let _ = writeln!(text, "  {},", row.join(", "));
    }
    text.push_str("]\n");
}
