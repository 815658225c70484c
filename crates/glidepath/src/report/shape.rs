//! The shape figures of a motion in reports.

use super::quantity::grouped;
use core::fmt::Write as _;
use glidepath_audit::shape::{Met, ShapeReport};
use glidepath_geometry::Axis;
use serde::Serialize;
use std::collections::BTreeMap;

/// Overshoot that is left out of the text, mm or degrees.
const UNSEEN_MM: f64 = 5e-5;

/// The shape of a motion beside that of its program. All of it may be inside the tolerance.
#[derive(Debug, Clone, Serialize)]
pub struct ShapeFigures {
    /// By axis letter.
    pub axes: BTreeMap<String, AxisShape>,
    /// How far Z goes below the programmed depth and comes back, at most; none without a Z.
    pub below_depth: Option<ShapeDistance>,
    /// How far the motion is on the outer side of a corner between straight feed moves, at most.
    pub outside_corners: ShapeDistance,
    /// How far the motion is beside a straight feed move of 5 mm and more, in its middle half, at
    /// most.
    pub beside_straight: ShapeDistance,
    /// Straight feed moves that long.
    pub straight_moves: u64,
    /// Places at which the motion is beside a straight feed move in its middle half by more than 1 µm, or on the
    /// outer side of the program where it is to be on the inner one: an axis beyond its stop, or the motion outside of
    /// a corner.
    pub finding_count: u64,
    /// The first of them.
    pub findings: Vec<String>,
}

/// The shape of an axis.
#[derive(Debug, Clone, Serialize)]
pub struct AxisShape {
    /// The unit of its position: "mm" or "°".
    #[serde(skip)]
    pub unit: &'static str,
    /// How far it goes below what the program asks for there and comes back, at most.
    pub overshoot_below: ShapeDistance,
    /// How far above likewise.
    pub overshoot_above: ShapeDistance,
    /// How often it turns round by more than 2 µm.
    pub reversals: u64,
    /// How often the program asks it to.
    pub programmed_reversals: u64,
}

/// A distance and the source line of the motion where it is met, 0 where there is none.
#[derive(Debug, Clone, Copy, Serialize)]
pub struct ShapeDistance {
    /// mm, or degrees of a rotary axis.
    pub mm: f64,
    /// Source line.
    pub line: u32,
}

impl From<Met> for ShapeDistance {
    fn from(met: Met) -> Self {
        Self {
            mm: met.distance_mm,
            line: met.line,
        }
    }
}

impl ShapeFigures {
    /// The figures of the axes that a machine has.
    #[must_use]
    pub fn new(shape: &ShapeReport, axes: &[Axis]) -> Self {
        let of = |axis: &Axis| {
            let index = axis.index();
            let of_axis = AxisShape {
                unit: if axis.is_rotary() { "°" } else { "mm" },
                overshoot_below: shape.below[index].into(),
                overshoot_above: shape.above[index].into(),
                reversals: shape.reversals[index],
                programmed_reversals: shape.programmed_reversals[index],
            };
            (axis.to_string(), of_axis)
        };
        let z = axes.contains(&Axis::Z).then_some(Axis::Z);
        Self {
            axes: axes.iter().map(of).collect(),
            below_depth: z.map(|z| shape.below[z.index()].into()),
            outside_corners: shape.outside.into(),
            beside_straight: shape.beside.into(),
            straight_moves: shape.straight_moves,
            finding_count: shape.finding_count,
            findings: shape
                .findings
                .iter()
                .flatten()
                .map(ToString::to_string)
                .collect(),
        }
    }

    /// The figures for people.
    #[must_use]
    pub fn text(&self) -> String {
        let lines = self.lines();
        let mut text = String::new();
        for (index, (what, words)) in lines.into_iter().enumerate() {
            let title = if index == 0 { "shape" } else { "" };
            // Writing to a String does not fail.
            let _ = writeln!(text, "  {title:<13} {what:<13} {words}");
        }
        text
    }

    /// What there is to say, each with what it is about.
    #[must_use]
    pub fn lines(&self) -> Vec<(&'static str, String)> {
        let at = |met: &ShapeDistance| format!("{:.4} mm (line {})", met.mm, met.line);
        let mut overshoot = Vec::new();
        let mut reversals = Vec::new();
        for (name, axis) in &self.axes {
            let sides = [
                (&axis.overshoot_below, "below"),
                (&axis.overshoot_above, "above"),
            ];
            for (met, side) in sides.into_iter().filter(|(met, _)| met.mm >= UNSEEN_MM) {
                overshoot.push(format!(
                    "{name} {:.4} {} {side} (line {})",
                    met.mm, axis.unit, met.line
                ));
            }
            if axis.reversals > 0 || axis.programmed_reversals > 0 {
                reversals.push(format!(
                    "{name} {} for {} programmed",
                    grouped(axis.reversals),
                    grouped(axis.programmed_reversals)
                ));
            }
        }
        let or_none = |words: Vec<String>| {
            if words.is_empty() {
                "none".to_owned()
            } else {
                words.join(", ")
            }
        };
        let mut lines = vec![("overshoot", or_none(overshoot))];
        if self.outside_corners.mm >= UNSEEN_MM {
            lines.push((
                "off corners",
                format!("{} outside", at(&self.outside_corners)),
            ));
        }
        if self.straight_moves > 0 {
            lines.push((
                "off straights",
                if self.beside_straight.mm >= UNSEEN_MM {
                    format!("{} in the middle half", at(&self.beside_straight))
                } else {
                    "nothing in the middle half".to_owned()
                },
            ));
        }
        lines.push(("reversals", or_none(reversals)));
        if let Some(first) = self.findings.first() {
            let count = grouped(self.finding_count);
            lines.push((
                "not as drawn",
                format!("{count} findings, the first: {first}"),
            ));
        }
        lines
    }
}
