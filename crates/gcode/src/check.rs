//! The check of a whole program without motion: everything that is wrong with it.

use std::io::BufRead;

use glidepath_geometry::AxisVector;
use glidepath_program::{Item, ItemKind};

use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::{Diagnostic, MAX_DIAGNOSTICS};
use crate::execute::cycle_words::name;
use crate::execute::program::Program;
use crate::lacking::{Lacking, Unsaid, waits_by_whole_seconds};
use crate::setup::options::Options;
use crate::summary::part_box::{PartBox, PartBoxes};
use crate::summary::survey::Survey;
use crate::summary::totals::Totals;
use crate::syntax::dialect::Dialect;
use crate::syntax::modes::Motion;

/// The report of [`check`].
#[derive(Debug, Clone, PartialEq)]
pub struct Report {
    /// The diagnostics, in the order of the lines, at most [`MAX_DIAGNOSTICS`].
    pub diagnostics: Vec<Diagnostic>,
    /// Diagnostics beyond those listed.
    pub more: u32,
    /// The line at which the check was given up, because the loops of the program go on for longer
    /// than [`crate::LoopLimits::checked_lines`]. What the program does from there on is not
    /// judged, and counts and sums are of what was. `None`: everything is.
    pub given_up_at: Option<u32>,
    /// What the program should have said and does not.
    pub lacks: Lacking,
    /// Counts and sums over the blocks without diagnostics.
    pub totals: Totals,
    /// Where the feed moves go, in the coordinates of each coordinate system that they are in; none of a curve, which
    /// has none.
    pub part: Vec<PartBox>,
    /// What was seen along the path.
    pub survey: Survey,
    /// Machine position at the end, over the blocks without diagnostics.
    pub final_position: AxisVector,
}

impl Report {
    /// True if nothing wrong was found. All of the program may run if it was also
    /// [checked to its end](Report::is_complete).
    #[must_use]
    pub const fn is_accepted(&self) -> bool {
        self.diagnostics.is_empty()
    }

    /// True if everything the program does was judged.
    #[must_use]
    pub const fn is_complete(&self) -> bool {
        self.given_up_at.is_none()
    }

    /// Moves, among the diagnostics listed, that leave the travel of an axis.
    #[must_use]
    pub fn soft_limit_violations(&self) -> usize {
        let beyond = |diagnostic: &&Diagnostic| diagnostic.code == DiagnosticCode::SoftLimit;
        self.diagnostics.iter().filter(beyond).count()
    }
}

/// The result of [`diagnostics`].
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Diagnostics {
    /// As [`Report::diagnostics`].
    pub diagnostics: Vec<Diagnostic>,
    /// As [`Report::more`].
    pub more: u32,
    /// As [`Report::given_up_at`].
    pub given_up_at: Option<u32>,
    /// As [`Report::lacks`].
    pub lacks: Lacking,
    /// Lines read, as [`Totals::lines`].
    pub lines: u32,
    /// The time that feed moves, at their feedrate, and dwells take at least, s: those without diagnostics.
    pub least_time_s: f64,
}

/// Checks a program.
///
/// A block with a diagnostic is left out but for its modes, and reading goes on behind it. What is
/// a consequence of an earlier diagnostic is not told. A diagnostic in an O word, a subroutine or a loop ends the
/// check, as does one that leaves nothing to understand (the input cannot be read).
pub fn check<R: BufRead>(reader: R, options: Options) -> Report {
    let (mut survey, mut part) = (Survey::default(), PartBoxes::default());
    let mut program = Program::new(reader, options);
    let found = read(&mut program, |program, item| {
        survey.add(item);
        part.add(&program.interpreter, item);
    });
    survey.pole_turns = program.interpreter.pole_turns;
    Report {
        diagnostics: found.diagnostics,
        more: found.more,
        given_up_at: found.given_up_at,
        lacks: found.lacks,
        totals: *program.totals(),
        part: part.into_boxes(),
        survey,
        final_position: *program.position(),
    }
}

/// Lists the diagnostics of [`check`] without counts and sums, for a program that is only to be
/// accepted or refused.
pub fn diagnostics<R: BufRead>(reader: R, options: Options) -> Diagnostics {
    let mut least_time_s = 0.0;
    let mut program = Program::new(reader, options).only_judged();
    let found = read(&mut program, |_, item| match &item.kind {
        ItemKind::Move { segment, rate, .. } => {
            let time_s = |feed_v| segment.length() / feed_v;
            least_time_s += rate.feed_v().map_or(0.0, time_s);
        }
        ItemKind::Dwell(seconds) => least_time_s += seconds,
        ItemKind::Event(_) => {}
    });
    Diagnostics {
        least_time_s: least_time_s + program.interpreter.judged_time_s,
        ..found
    }
}

/// Reads a program to its end, or for as long as its loops may go on.
fn read<R: BufRead>(
    program: &mut Program<R>,
    mut see: impl FnMut(&Program<R>, &Item),
) -> Diagnostics {
    let most = program.interpreter.options.loops.checked_lines;
    let mut found = Diagnostics::default();
    let mut without_tools = WithoutTools::default();
    let mut bred = Bred::default();
    let mut unsaid = Unsaid::at_start(program);
    loop {
        if program.kept_lines() >= most {
            found.given_up_at = Some(program.line_of_program());
            break;
        }
        match program.next_line() {
            Some(Ok(())) => {
                bred.is_series_in_doubt &= program.block().codes.motion.is_none();
                let program = &*program;
                if unsaid.is_any() {
                    unsaid.look(program, &mut found.lacks);
                }
                found.lacks.seconds |= waits_by_whole_seconds(program);
                program.items().iter().for_each(|item| see(program, item));
            }
            Some(Err(diagnostic)) => {
                let lacks_words = bred.lacks_words_of_series(&diagnostic, program);
                let is_bred = bred.is_bred(&diagnostic, Program::position(program)) || lacks_words;
                program.read_on(&diagnostic);
                let listed = found.diagnostics.len();
                if is_bred || without_tools.is_told(&diagnostic, listed) {
                } else if listed < MAX_DIAGNOSTICS {
                    found.diagnostics.push(diagnostic);
                } else {
                    found.more = found.more.saturating_add(1);
                }
            }
            None => break,
        }
    }
    without_tools.tell(&mut found.diagnostics);
    // Programs of printers just end.
    let may_just_end = program.interpreter.options.dialect == Dialect::Marlin;
    found.lacks.end = program.ran_out && !may_just_end;
    let doubts = program.interpreter.doubts;
    (found.lacks.crossing, found.lacks.dwell) = (doubts.crosses_below_r, doubts.did_not_wait);
    found.lines = program.totals().lines;
    found
}

/// Diagnostics that are consequences of one before: a block whose words were not understood may have
/// had a motion mode, a feedrate, and a place to go to.
#[derive(Debug, Default)]
struct Bred {
    /// A block was not understood.
    is_in_doubt: bool,
    /// Where the machine was taken to be in front of the last of them.
    place: Option<AxisVector>,
    /// A block was refused since the last one with a motion mode that was not: it may be the one with the words of a
    /// series of holes.
    is_series_in_doubt: bool,
}

impl Bred {
    /// True for a hole of a series that lacks a word which a block before it may have had.
    fn lacks_words_of_series<R: BufRead>(
        &mut self,
        diagnostic: &Diagnostic,
        program: &Program<R>,
    ) -> bool {
        let was_in_doubt = core::mem::replace(&mut self.is_series_in_doubt, true);
        let Some(Motion::Cycle(cycle)) = program.interpreter.state.modal.motion else {
            return false;
        };
        let begins_series = program.block().codes.motion.is_some();
        was_in_doubt
            && !begins_series
            && diagnostic.code == DiagnosticCode::MissingWord
            && diagnostic
                .message
                .starts_with(name(cycle, program.block().is_lathe))
    }

    /// True for a consequence of a diagnostic that was told; `place` is where the machine is taken
    /// to be.
    fn is_bred(&mut self, diagnostic: &Diagnostic, place: &AxisVector) -> bool {
        let is_bred = match diagnostic.code {
            DiagnosticCode::NoMotionMode | DiagnosticCode::MissingFeed => self.is_in_doubt,
            DiagnosticCode::ArcRadiusMismatch
            | DiagnosticCode::ArcRadiusTooSmall
            | DiagnosticCode::ArcZeroRadius
            | DiagnosticCode::ArcFullCircleWithRadius => self.place == Some(*place),
            _ => false,
        };
        if diagnostic.code.is_of_reading() {
            self.is_in_doubt = true;
            self.place = Some(*place);
        }
        is_bred
    }
}

/// Blocks that need the tool table of a program that has none: one thing to mend, not many.
#[derive(Debug, Default)]
struct WithoutTools {
    /// Where the first of them is among the diagnostics.
    first: Option<usize>,
    more: u32,
}

impl WithoutTools {
    /// True for a block that lacks the tool table as one before it did; `next` is the place of the
    /// next diagnostic.
    fn is_told(&mut self, diagnostic: &Diagnostic, next: usize) -> bool {
        if diagnostic.code != DiagnosticCode::NoToolTable {
            return false;
        }
        if self.first.is_some() {
            self.more = self.more.saturating_add(1);
            return true;
        }
        self.first = Some(next);
        false
    }

    /// Says at the first of them how many more there are.
    fn tell(self, diagnostics: &mut [Diagnostic]) {
        let first = self.first.and_then(|at| diagnostics.get_mut(at));
        if let (Some(first), more @ 1..) = (first, self.more) {
            let blocks = if more == 1 {
                "block needs"
            } else {
                "blocks need"
            };
            first.reason = format!("{}; {more} more {blocks} it", first.reason);
        }
    }
}
