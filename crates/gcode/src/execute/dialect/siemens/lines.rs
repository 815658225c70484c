//! The lines that a cycle becomes, in RS274/NGC's words.

use std::fmt::Write;

use glidepath_geometry::Axis;

use crate::diagnostic::block_diagnostic::Outcome;
use crate::execute::dialect::siemens::arguments::Arguments;
use crate::execute::dialect::siemens::steps::Step;

/// Most lines of one cycle.
const MAX_LINES: usize = 200_000;

/// The lines of a cycle.
#[derive(Debug)]
pub(super) struct Lines {
    pub(super) steps: Vec<Step>,
    /// First and second axis of the plane, and the one normal to it.
    axes: [char; 3],
}

impl Lines {
    pub(super) fn new(axes: [Axis; 3]) -> Self {
        Self {
            // No corner of a cycle is rounded off; its coordinates are absolute, and radii.
            steps: vec![Step::Line("G90 G61 G91.1 G8 ,M0".to_owned())],
            axes: axes.map(Axis::letter),
        }
    }

    pub(super) fn line(&mut self, text: impl Into<String>) {
        self.steps.push(Step::Line(text.into()));
    }

    pub(super) fn feed(&mut self, feed: f64) {
        if feed > 0.0 {
            self.line(format!("F[{feed}]"));
        }
    }

    /// Seconds at rest.
    pub(super) fn dwell(&mut self, seconds: f64) {
        if seconds > 0.0 {
            self.line(format!("G4 P[{seconds}]"));
        }
    }

    /// A straight move of the axes that have a value.
    pub(super) fn go(&mut self, code: &str, to: [Option<f64>; 3]) {
        let mut text = code.to_owned();
        for (axis, value) in self.axes.iter().zip(to) {
            if let Some(value) = value {
                let _written = write!(text, " {axis}[{value}]");
            }
        }
        self.line(text);
    }

    /// A straight move along the axis normal to the plane.
    pub(super) fn along(&mut self, code: &str, level: f64) {
        self.go(code, [None, None, Some(level)]);
    }

    /// A straight move in the plane.
    pub(super) fn across(&mut self, code: &str, to: [f64; 2]) {
        self.go(code, [Some(to[0]), Some(to[1]), None]);
    }

    /// An arc in the plane; `level` is where the normal axis ends, `center` counts from the start.
    pub(super) fn arc(
        &mut self,
        code: &str,
        to: [f64; 2],
        level: Option<f64>,
        center: [f64; 2],
        turns: u32,
    ) {
        let mut text = code.to_owned();
        for (axis, value) in self.axes.iter().zip([Some(to[0]), Some(to[1]), level]) {
            if let Some(value) = value {
                let _written = write!(text, " {axis}[{value}]");
            }
        }
        for (axis, value) in self.axes.iter().zip(center) {
            let letter = match axis {
                'Y' => 'J',
                'Z' => 'K',
                _ => 'I',
            };
            let _written = write!(text, " {letter}[{value}]");
        }
        if turns > 1 {
            let _written = write!(text, " P{turns}");
        }
        self.line(text);
    }

    /// Refuses a cycle of too many lines before they are made.
    pub(super) fn check_count(count: f64, arguments: Arguments<'_>) -> Outcome<()> {
        if count <= f64::from(u32::try_from(MAX_LINES).unwrap_or(u32::MAX)) {
            return Ok(());
        }
        Err(arguments
            .refused(
                format!("the cycle would have {count:.0} lines"),
                "the length of a cycle is bounded",
            )
            .help("use larger steps"))
    }
}
