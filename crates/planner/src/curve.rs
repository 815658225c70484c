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
use glidepath_gcode::{Code, Diagnostic, Options, Report, Survey, Totals};
use glidepath_geometry::{Axis, AxisVector, Segment};
use glidepath_motion::{Item, ItemKind, PathMode, Rate, Settings};

use crate::fingerprint::fingerprint;
use crate::{ItemSource, Refusal, Supply};

/// Part of the tolerance that chords may take.
const CHORD_SHARE: f64 = 0.1;
/// Longest chord where neither file nor tolerance asks for a shorter one, mm.
const LONGEST_MM: f64 = 10.0;

/// Items of a curve file, made as they are wanted.
#[derive(Debug)]
pub struct CurveSource {
    text: String,
    file: CurveFile,
    chords: Chords,
    options: Options,
    rate: Rate,
    mode: PathMode,
    position: AxisVector,
    has_approached: bool,
    totals: Totals,
}

impl CurveSource {
    /// The curve of a file's text, for a machine that stands at the start of the options.
    ///
    /// # Errors
    /// All findings.
    pub fn new(
        text: String,
        options: Options,
        settings: &Settings,
    ) -> Result<Self, Vec<Diagnostic>> {
        let find = |at, code, message, help: &str| {
            Diagnostic::in_text(&text, at, code, message, help.to_owned())
        };
        let file = CurveFile::parse(&text).map_err(|findings| {
            findings
                .into_iter()
                .map(|f| Diagnostic::in_text(&text, f.at, Code::CurveFile, f.message, f.help))
                .collect::<Vec<_>>()
        })?;
        let missing = [Axis::X, Axis::Y, Axis::Z].map(|axis| (!options.machine.has(axis), axis));
        if let Some((_, axis)) = missing.into_iter().find(|(is_missing, _)| *is_missing) {
            let message = format!("the machine has no axis {axis}, along which a curve runs");
            return Err(vec![find(
                0..0,
                Code::Curve,
                message,
                "choose another machine",
            )]);
        }
        let Some(feed_mm_min) = file.feed_mm_min.or(options.default_feed_mm_min) else {
            let message = "the curve has no feedrate".to_owned();
            let help = "add `feed = …` (mm/min)";
            return Err(vec![find(0..0, Code::MissingFeed, message, help)]);
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
        let position = options.start;
        Ok(Self {
            text,
            file,
            chords,
            options,
            rate: Rate::Feed(feed_mm_min / 60.0),
            mode: PathMode::Continuous {
                tolerance_mm: Some(tolerance_mm - error_mm),
            },
            position,
            has_approached: false,
            totals: Totals::default(),
        })
    }

    /// Goes through the whole curve without motion.
    #[must_use]
    pub fn check(mut self) -> Report {
        let mut diagnostics = Vec::new();
        let mut survey = Survey::default();
        loop {
            match self.next() {
                Ok(Some(item)) => survey.add(&item),
                Ok(None) => break,
                Err(finding) => {
                    diagnostics.push(*finding);
                    break;
                }
            }
        }
        Report {
            diagnostics,
            more: 0,
            complete: true,
            totals: self.totals,
            survey,
            final_position: self.position,
        }
    }

    fn next(&mut self) -> Result<Option<Item>, Box<Diagnostic>> {
        if !self.has_approached {
            self.has_approached = true;
            let to = self.at((*self.chords.point()).into());
            if to != self.position {
                return self.go(to, Rate::Rapid, PathMode::ExactStop).map(Some);
            }
        }
        let chord = self
            .chords
            .next_chord()
            .map_err(|error| Box::new(cannot_follow(&self.text, &self.file, &error)))?;
        let Some(chord) = chord else { return Ok(None) };
        let to = self.at(chord.point.into());
        self.go(to, self.rate, self.mode).map(Some)
    }

    /// A point of the curve with the other axes where they are.
    fn at(&self, point: [f64; 3]) -> AxisVector {
        let mut to = self.position;
        for (axis, coordinate) in point.into_iter().enumerate() {
            to[axis] = coordinate;
        }
        to
    }

    fn go(&mut self, to: AxisVector, rate: Rate, mode: PathMode) -> Result<Item, Box<Diagnostic>> {
        for axis in [Axis::X, Axis::Y, Axis::Z] {
            let value = to[axis.index()];
            let travel = self.options.machine.travel(axis);
            if let Some(travel) = travel.filter(|t| !(t.min..=t.max).contains(&value)) {
                return Err(Box::new(Diagnostic::in_text(
                    &self.text,
                    self.file.place(ShapeKey::Formula),
                    Code::SoftLimit,
                    format!("the curve goes to {axis}{value:.3}, outside the axis' travel"),
                    format!(
                        "keep the curve between {axis}{} and {axis}{}",
                        travel.min, travel.max
                    ),
                )));
            }
        }
        let segment = Segment::line(self.position, to);
        self.position = to;
        let item = Item {
            line: self.line(),
            kind: ItemKind::Move {
                segment,
                rate,
                mode,
            },
        };
        self.totals.lines = self.line();
        self.totals.add(&item);
        Ok(item)
    }

    /// The line of the file that every move comes from: that of the first formula.
    fn line(&self) -> u32 {
        let at = self.file.place(ShapeKey::Formula).start;
        let before = self.text.get(..at).unwrap_or_default();
        u32::try_from(before.matches('\n').count() + 1).unwrap_or(u32::MAX)
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
        file.place(key),
        Code::Curve,
        error.to_string(),
        help.to_owned(),
    )
}

impl ItemSource for CurveSource {
    fn next_item(&mut self) -> Supply {
        match self.next() {
            Ok(Some(item)) => Supply::Item(item),
            Ok(None) => Supply::End,
            Err(finding) => Supply::Refused(Refusal::Program {
                findings: vec![*finding],
                unlisted: 0,
            }),
        }
    }

    fn lines_read(&self) -> u64 {
        self.totals.lines.into()
    }

    fn fingerprint(&self) -> u64 {
        fingerprint(&self.text)
    }
}
