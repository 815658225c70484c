//! NURBS files as programs: the pieces of the curve, as moves.
//!
//! The motion begins with a straight rapid from where the machine stands to the start of the curve,
//! where it rests. A piece is away from the curve by a thousandth of the tolerance at most; that is
//! taken from the tolerance of the motion.

use std::collections::VecDeque;

use glidepath_curve::NurbsFile;
use glidepath_gcode::{Diagnostic, DiagnosticCode, Options, Report};
use glidepath_geometry::{AXES, Axis, AxisVector, Nurbs, NurbsPath, Segment};
use glidepath_program::{PathMode, Rate, Settings};

use crate::source::file_moves::{FileMoves, Next, supply, survey};
use crate::source::item_source::{ItemSource, Supply};

/// Part of the tolerance that pieces may be away from the curve.
const PIECE_SHARE: f64 = 1e-3;

/// Items of a NURBS file, made as they are wanted.
#[derive(Debug)]
pub struct NurbsSource {
    /// From where the control points stand in the text.
    moves: FileMoves,
    path: NurbsPath,
    /// Knot spans that have been cut, and their segments that have not been given out.
    cut: usize,
    segments: VecDeque<Segment>,
    error_mm: f64,
    rate: Rate,
    mode: PathMode,
    has_approached: bool,
}

impl NurbsSource {
    /// The NURBS of a curve file's text, for a machine that stands at the start of the options.
    ///
    /// # Errors
    /// What is to be mended.
    pub fn new(
        text: String,
        options: Options,
        settings: &Settings,
    ) -> Result<Self, Box<Diagnostic>> {
        let file = NurbsFile::parse(&text).map_err(|f| {
            Box::new(Diagnostic::in_text(
                &text,
                f.at,
                DiagnosticCode::CurveFile,
                f.message,
                f.help,
            ))
        })?;
        let fault = |code, message: String, help: &str| {
            let place = file.place.clone();
            Box::new(Diagnostic::in_text(
                &text,
                place,
                code,
                message,
                help.to_owned(),
            ))
        };
        let present = Axis::ALL.into_iter().take(file.axes);
        if let Some(axis) = present.into_iter().find(|axis| {
            let moves = file
                .curve
                .control_points()
                .iter()
                .any(|p| p[axis.index()] != 0.0);
            moves && !options.machine.has(*axis)
        }) {
            let message = format!("the machine has no axis {axis}, along which the curve runs");
            return Err(fault(
                DiagnosticCode::Curve,
                message,
                "choose another machine",
            ));
        }
        let Some(feed_mm_min) = file.feed_mm_min.or(options.default_feed_mm_min) else {
            let help = "add `feed`, in mm/min, or configure a default";
            return Err(fault(
                DiagnosticCode::MissingFeed,
                "the curve has no feedrate".to_owned(),
                help,
            ));
        };
        let curve = with_others(&file, &options.start).map_err(|error| {
            fault(
                DiagnosticCode::Curve,
                error.to_string(),
                "keep the curve near the machine",
            )
        })?;
        let tolerance_mm = file.tolerance_mm.unwrap_or(settings.tolerance_mm);
        let path = NurbsPath::new(curve);
        let error_mm = PIECE_SHARE * tolerance_mm;
        // Smooth pieces say themselves how far they are from the curve.
        let left_mm = if path.is_in_space() {
            tolerance_mm
        } else {
            tolerance_mm - error_mm
        };
        Ok(Self {
            moves: FileMoves::new(text, file.place, options),
            path,
            cut: 0,
            segments: VecDeque::new(),
            error_mm,
            rate: Rate::Feed(feed_mm_min / 60.0),
            mode: PathMode::Continuous {
                tolerance_mm: Some(left_mm),
            },
            has_approached: false,
        })
    }

    /// Goes through the whole curve without motion.
    #[must_use]
    pub fn check(mut self) -> Report {
        let found = survey(|| self.next());
        self.moves.into_report(found)
    }

    fn next(&mut self) -> Next {
        if !self.has_approached {
            self.has_approached = true;
            let start = self.path.jet(0.0).position;
            if start != *self.moves.position() {
                let approach = Segment::line(*self.moves.position(), start);
                return self.moves.go(approach, Rate::Rapid, PathMode::ExactStop);
            }
        }
        while self.segments.is_empty() && self.cut < self.path.curve().spans().len() {
            let mut segments = Vec::new();
            self.path.cut_span(
                self.cut,
                *self.moves.position(),
                self.error_mm,
                &mut segments,
            );
            self.segments.extend(segments);
            self.cut += 1;
        }
        let Some(segment) = self.segments.pop_front() else {
            return Ok(None);
        };
        self.moves.go(segment, self.rate, self.mode)
    }
}

/// The curve with the axes it says nothing about where the machine has them.
fn with_others(
    file: &NurbsFile,
    start: &AxisVector,
) -> Result<Nurbs, glidepath_geometry::NurbsError> {
    let curve = &file.curve;
    let mut points = curve.control_points().to_vec();
    for point in &mut points {
        for axis in file.axes..AXES {
            point[axis] = start[axis];
        }
    }
    Nurbs::new(curve.degree(), &points, curve.weights(), curve.knots())
}

impl ItemSource for NurbsSource {
    fn next_item(&mut self) -> Supply {
        supply(self.next())
    }

    fn lines_read(&self) -> u64 {
        self.moves.lines_read()
    }

    fn fingerprint(&self) -> u64 {
        self.moves.fingerprint()
    }
}
