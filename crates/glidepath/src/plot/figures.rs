//! The figures below the strips: how smooth the motion is, and how true its shape.

use super::colour::{INK, QUIET};
use super::svg::{Anchor, Area, Svg};
use super::ticks::label;
use crate::report::{AxisFigures, DiagnosisReport, SmoothnessFigures, grouped};
use std::collections::BTreeMap;

/// Between two lines of text.
const LINE: f64 = 16.0;
/// Right ends of the columns of figures, from the left edge of a part.
const COLUMNS: [(f64, &str); 4] = [
    (120.0, "jerk rms"),
    (220.0, "jerk peak"),
    (370.0, "acceleration > 30 Hz rms"),
    (450.0, "reversals"),
];

/// Parts of a motion, by the names that they have in reports, with their titles.
const PARTS: [(&str, &str); 2] = [
    ("whole", "Smoothness of the whole motion"),
    ("at_feed", "Smoothness where the programmed feed binds"),
];

/// From the left edge to what is said of the shape.
const SHAPE_WORDS: f64 = 90.0;

/// Figures that are drawn.
#[derive(Debug, Default)]
pub(super) struct Figures {
    smoothness: BTreeMap<&'static str, SmoothnessFigures>,
    shape: Vec<(&'static str, String)>,
}

impl Figures {
    pub(super) fn new(diagnosis: &DiagnosisReport) -> Self {
        Self {
            smoothness: diagnosis.smoothness.clone(),
            shape: diagnosis.shape.lines(),
        }
    }

    /// The height of the smoothness.
    #[allow(clippy::cast_precision_loss, reason = "at most nine axes")]
    fn smoothness_height(&self) -> f64 {
        let parts = self.smoothness.values();
        let rows = parts.map(|figures| moving(figures).count()).max();
        rows.map_or(0.0, |rows| (rows as f64 + 3.0) * LINE + 18.0)
    }

    /// The height that figures take.
    #[allow(clippy::cast_precision_loss, reason = "a few lines")]
    pub(super) fn height(&self) -> f64 {
        let shape = match self.shape.len() {
            0 => 0.0,
            lines => (lines as f64 + 1.0) * LINE + 12.0,
        };
        self.smoothness_height() + shape
    }

    /// Draws smoothness side by side from the top of an area on, and the shape below.
    pub(super) fn draw(&self, svg: &mut Svg, area: &Area) {
        let mut x = area.x;
        for (part, title) in PARTS {
            if let Some(figures) = self.smoothness.get(part) {
                draw_part(svg, title, figures, (x, area.y + LINE));
            }
            x += 0.5 * area.width;
        }
        if self.shape.is_empty() {
            return;
        }
        let mut y = area.y + self.smoothness_height() + 12.0;
        let heading = format!("fill=\"{INK}\" font-weight=\"600\"");
        let quiet = format!("fill=\"{QUIET}\" font-size=\"10\"");
        let ink = format!("fill=\"{INK}\" font-size=\"10\"");
        svg.text(
            area.x,
            y,
            Anchor::Start,
            &heading,
            "Shape beside that of the program",
        );
        for (what, words) in &self.shape {
            y += LINE;
            svg.text(area.x, y, Anchor::Start, &quiet, what);
            svg.text(area.x + SHAPE_WORDS, y, Anchor::Start, &ink, words);
        }
    }
}

fn draw_part(svg: &mut Svg, title: &str, figures: &SmoothnessFigures, (x, top): (f64, f64)) {
    let heading = format!("fill=\"{INK}\" font-weight=\"600\"");
    let quiet = format!("fill=\"{QUIET}\" font-size=\"10\"");
    let ink = format!("fill=\"{INK}\" font-size=\"10\"");
    svg.text(x, top, Anchor::Start, &heading, title);
    let words = if figures.periods == 0 {
        "it binds nowhere".to_owned()
    } else {
        format!(
            "{} setpoints, off the programmed path by {} µm in the mean, {} µm rms",
            grouped(figures.periods),
            label(1e3 * figures.mean_deviation_mm),
            label(1e3 * figures.rms_deviation_mm)
        )
    };
    svg.text(x, top + LINE, Anchor::Start, &quiet, &words);
    if figures.periods == 0 {
        return;
    }
    let mut y = top + 2.0 * LINE;
    for (right, name) in COLUMNS {
        svg.text(x + right, y, Anchor::End, &quiet, name);
    }
    for (axis, figures) in moving(figures) {
        y += LINE;
        svg.text(x, y, Anchor::Start, &heading, axis);
        let unit = figures.unit;
        let cells = [
            format!("{} {unit}/s³", label(figures.rms_jerk)),
            format!("{} {unit}/s³", label(figures.peak_jerk)),
            format!("{} {unit}/s²", label(figures.acceleration_above_30_hz)),
            grouped(figures.reversals),
        ];
        for ((right, _), cell) in COLUMNS.iter().zip(cells) {
            svg.text(x + right, y, Anchor::End, &ink, &cell);
        }
    }
}

/// The axes that move.
fn moving(figures: &SmoothnessFigures) -> impl Iterator<Item = (&String, &AxisFigures)> {
    let moves = |(_, axis): &(&String, &AxisFigures)| axis.peak_jerk > 0.0;
    figures.axes.iter().filter(moves)
}
