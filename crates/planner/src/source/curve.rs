//! Curve files as programs: chords with proven error, as straight moves.
//!
//! ```text
//!   tolerance ─┬─ 1/10: distance of a chord from the curve, proven for each chord
//!              └─ rest: of the motion from the chords, as for any program
//! ```
//!
//! The motion begins with a straight rapid from where the machine stands to the start of the curve,
//! where it rests.

use glidepath_curve::{ChordRule, Chords, CurveError, CurveFile, ShapeKey};
use glidepath_gcode::{Diagnostic, DiagnosticCode, Options, Report};
use glidepath_geometry::{Axis, AxisVector, Segment};
use glidepath_program::{PathMode, Rate, Settings};

use crate::source::file_moves::{FileMoves, Next, supply, survey};
use crate::source::item_source::{ItemSource, Supply};

/// Part of the tolerance that chords may take.
const CHORD_SHARE: f64 = 0.1;
/// Longest chord where neither file nor tolerance asks for a shorter one, mm.
const LONGEST_MM: f64 = 10.0;

/// Items of a curve file, made as they are wanted.
#[derive(Debug)]
pub struct CurveSource {
    /// From where the first formula stands in the text.
    moves: FileMoves,
    file: CurveFile,
    chords: Chords,
    rate: Rate,
    mode: PathMode,
    has_approached: bool,
}

impl CurveSource {
    /// The curve of a file's text, for a machine that stands at the start of the options.
    ///
    /// # Errors
    /// All diagnostics.
    pub fn new(
        text: String,
        options: Options,
        settings: &Settings,
    ) -> Result<Self, Vec<Diagnostic>> {
        let find = |at, code, message, help: &str| {
            Diagnostic::in_text(&text, at, code, message, help.to_owned())
        };
        let file = CurveFile::parse(&text).map_err(|diagnostics| {
            diagnostics
                .into_iter()
                .map(|f| {
                    Diagnostic::in_text(&text, f.at, DiagnosticCode::CurveFile, f.message, f.help)
                })
                .collect::<Vec<_>>()
        })?;
        let missing = [Axis::X, Axis::Y, Axis::Z].map(|axis| (!options.machine.has(axis), axis));
        if let Some((_, axis)) = missing.into_iter().find(|(is_missing, _)| *is_missing) {
            let message = format!("the machine has no axis {axis}, along which a curve runs");
            return Err(vec![find(
                0..0,
                DiagnosticCode::Curve,
                message,
                "choose another machine",
            )]);
        }
        let Some(feed_mm_min) = file.feed_mm_min.or(options.default_feed_mm_min) else {
            let message = "the curve has no feedrate".to_owned();
            let help = "add `feed = …` (mm/min)";
            return Err(vec![find(0..0, DiagnosticCode::MissingFeed, message, help)]);
        };
        let tolerance_mm = file.tolerance_mm.unwrap_or(settings.tolerance_mm);
        let error_mm = CHORD_SHARE * tolerance_mm;
        let rule = ChordRule {
            longest_mm: file.chord_mm.unwrap_or(LONGEST_MM),
            error_mm,
        };
        let chords = file
            .chords(rule)
            .map_err(|error| vec![cannot_follow(&text, &file, &error)])?;
        Ok(Self {
            moves: FileMoves::new(text, file.key(ShapeKey::Formula), options),
            file,
            chords,
            rate: Rate::Feed(feed_mm_min / 60.0),
            mode: PathMode::Continuous {
                tolerance_mm: Some(tolerance_mm - error_mm),
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
            let to = self.at((*self.chords.point()).into());
            let from = *self.moves.position();
            if to != from {
                let approach = Segment::line(from, to);
                return self.moves.go(approach, Rate::Rapid, PathMode::ExactStop);
            }
        }
        let chord = self
            .chords
            .next_chord()
            .map_err(|error| Box::new(cannot_follow(self.moves.text(), &self.file, &error)))?;
        let Some(chord) = chord else { return Ok(None) };
        let to = self.at(chord.point.into());
        let segment = Segment::line(*self.moves.position(), to);
        self.moves.go(segment, self.rate, self.mode)
    }

    /// A point of the curve with the other axes where they are.
    fn at(&self, point: [f64; 3]) -> AxisVector {
        let mut to = *self.moves.position();
        for (axis, coordinate) in point.into_iter().enumerate() {
            to[axis] = coordinate;
        }
        to
    }
}

fn cannot_follow(text: &str, file: &CurveFile, error: &CurveError) -> Diagnostic {
    let key = CurveFile::blame(error);
    let help = match key {
        ShapeKey::Formula => {
            "end the curve before that place, or write it so that it is smooth there"
        }
        ShapeKey::Start => "give a point on both surfaces, and a direction along the curve",
        ShapeKey::End => "give an end that the curve reaches",
    };
    Diagnostic::in_text(
        text,
        file.key(key),
        DiagnosticCode::Curve,
        error.to_string(),
        help.to_owned(),
    )
}

impl ItemSource for CurveSource {
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
