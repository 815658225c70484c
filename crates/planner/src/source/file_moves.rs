//! The moves of a curve file, whatever kind of curve makes them.

use glidepath_gcode::{Diagnostic, DiagnosticCode, Lacking, Options, Report, Survey, Totals};
use glidepath_geometry::{Axis, AxisVector, Segment};
use glidepath_program::{Item, ItemKind, PathMode, Rate};

use crate::run::refusal::Refusal;
use crate::source::fingerprint::fingerprint;
use crate::source::item_source::Supply;

/// An item, the end of the curve, or what is wrong with it.
pub(crate) type Next = Result<Option<Item>, Box<Diagnostic>>;

/// Most moves of a curve that are checked: some seconds' work.
const MOST_MOVES: u32 = 2_000_000;

/// The result of a check along a curve.
#[derive(Debug, Default)]
pub(crate) struct Surveyed {
    survey: Survey,
    diagnostics: Vec<Diagnostic>,
    /// There were more moves than are checked.
    gave_up: bool,
}

/// Moves that all come from the same place of a file.
#[derive(Debug)]
pub(crate) struct FileMoves {
    text: String,
    fingerprint: u64,
    place: core::ops::Range<usize>,
    line: u32,
    options: Options,
    position: AxisVector,
    totals: Totals,
}

impl FileMoves {
    /// Moves of the curve that stands at `place` in a text, for a machine at the start of the
    /// options.
    pub(crate) fn new(text: String, place: core::ops::Range<usize>, options: Options) -> Self {
        let before = text.get(..place.start).unwrap_or_default();
        Self {
            line: u32::try_from(before.matches('\n').count() + 1).unwrap_or(u32::MAX),
            position: options.start,
            totals: Totals::default(),
            fingerprint: fingerprint(&text),
            text,
            place,
            options,
        }
    }

    pub(crate) fn text(&self) -> &str {
        &self.text
    }

    /// The fingerprint of the text: see [`crate::ItemSource::fingerprint`].
    pub(crate) const fn fingerprint(&self) -> u64 {
        self.fingerprint
    }

    /// Where the last move ends, mm and degrees.
    pub(crate) const fn position(&self) -> &AxisVector {
        &self.position
    }

    pub(crate) fn lines_read(&self) -> u64 {
        self.totals.lines.into()
    }

    /// The next move; refused if it leads an axis out of its travel.
    pub(crate) fn go(&mut self, segment: Segment, rate: Rate, mode: PathMode) -> Next {
        let (low, high) = match &segment {
            // Where the machine stands is not the curve's fault.
            Segment::Line(_) => (segment.end(), segment.end()),
            _ => segment.bounding_box(),
        };
        for axis in Axis::ALL {
            let i = axis.index();
            let stands = self.position[i].to_bits();
            let stays = [low[i], high[i]]
                .iter()
                .all(|value| value.to_bits() == stands);
            let Some(travel) = self.options.machine.travel(axis).filter(|_| !stays) else {
                continue;
            };
            let range = travel.min..=travel.max;
            if let Some(value) = [low[i], high[i]].into_iter().find(|v| !range.contains(v)) {
                return Err(Box::new(Diagnostic::in_text(
                    &self.text,
                    self.place.clone(),
                    DiagnosticCode::SoftLimit,
                    format!("the curve goes to {axis}{value:.3}, outside the axis' travel"),
                    format!(
                        "keep the curve between {axis}{} and {axis}{}",
                        travel.min, travel.max
                    ),
                )));
            }
        }
        self.position = segment.end();
        let kind = ItemKind::Move {
            segment,
            rate,
            mode,
        };
        let item = Item {
            block: 0,
            line: self.line,
            kind,
        };
        self.totals.lines = self.line;
        self.totals.add(&item);
        Ok(Some(item))
    }

    /// What a check found.
    pub(crate) fn into_report(self, found: Surveyed) -> Report {
        Report {
            diagnostics: found.diagnostics,
            more: 0,
            lacks: Lacking::default(),
            given_up_at: found.gave_up.then_some(self.line),
            totals: self.totals,
            part: Vec::new(),
            survey: found.survey,
            final_position: self.position,
        }
    }
}

/// Goes through a curve without motion, up to its first diagnostic, or for as long as a check may
/// take.
pub(crate) fn survey(mut next: impl FnMut() -> Next) -> Surveyed {
    let mut found = Surveyed::default();
    for _ in 0..MOST_MOVES {
        match next() {
            Ok(Some(item)) => found.survey.add(&item),
            Ok(None) => return found,
            Err(diagnostic) => {
                found.diagnostics.push(*diagnostic);
                return found;
            }
        }
    }
    found.gave_up = true;
    found
}

/// What a planner is given.
pub(crate) fn supply(next: Next) -> Supply {
    match next {
        Ok(Some(item)) => Supply::Item(item),
        Ok(None) => Supply::End,
        Err(diagnostic) => Supply::Refused(Refusal::Program {
            diagnostics: vec![*diagnostic],
            unlisted: 0,
        }),
    }
}
