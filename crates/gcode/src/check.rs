//! Reads a whole program without motion and lists everything that is wrong with it.

use std::io::BufRead;

use glidepath_geometry::AxisVector;
use glidepath_program::Item;

use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::{Diagnostic, MAX_DIAGNOSTICS};
use crate::execute::program::Program;
use crate::setup::options::Options;
use crate::summary::survey::Survey;
use crate::summary::totals::Totals;

/// What [`check`] found.
#[derive(Debug, Clone, PartialEq)]
pub struct Report {
    /// The diagnostics, in the order of the lines, at most [`MAX_DIAGNOSTICS`].
    pub diagnostics: Vec<Diagnostic>,
    /// Diagnostics beyond those listed.
    pub more: u32,
    /// False if the program was not read to its end, because its loops go on for longer than
    /// [`crate::LoopLimits`] allow; the part that was read is judged.
    pub complete: bool,
    /// Counts and sums over the blocks without diagnostics.
    pub totals: Totals,
    /// What was seen along the path.
    pub survey: Survey,
    /// Machine position at the end, over the blocks without diagnostics.
    pub final_position: AxisVector,
}

impl Report {
    /// True if the program may run.
    #[must_use]
    pub const fn is_accepted(&self) -> bool {
        self.diagnostics.is_empty()
    }

    /// Moves, among the diagnostics listed, that leave the travel of an axis.
    #[must_use]
    pub fn soft_limit_violations(&self) -> usize {
        let beyond = |diagnostic: &&Diagnostic| diagnostic.code == DiagnosticCode::SoftLimit;
        self.diagnostics.iter().filter(beyond).count()
    }
}

/// What [`diagnostics`] found.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Diagnostics {
    /// As [`Report::diagnostics`].
    pub diagnostics: Vec<Diagnostic>,
    /// As [`Report::more`].
    pub more: u32,
    /// Lines read, as [`Totals::lines`].
    pub lines: u32,
}

/// Checks a program.
///
/// A block with a diagnostic is left out, and reading goes on behind it, so a later diagnostic may
/// be a consequence of an earlier one. A diagnostic in an O word, a subroutine or a loop ends the
/// check, as does one that leaves nothing to understand (the input cannot be read).
pub fn check<R: BufRead>(reader: R, options: Options) -> Report {
    let mut survey = Survey::default();
    let mut program = Program::new(reader, options);
    let (found, complete) = read(&mut program, |item| survey.add(item));
    Report {
        diagnostics: found.diagnostics,
        more: found.more,
        complete,
        totals: *program.totals(),
        survey,
        final_position: *program.position(),
    }
}

/// Lists the diagnostics of [`check`] without counts and sums, for a program that is only to be
/// accepted or refused.
pub fn diagnostics<R: BufRead>(reader: R, options: Options) -> Diagnostics {
    read(&mut Program::new(reader, options).only_judged(), |_| {}).0
}

/// Reads a program to its end; false beside the diagnostics if its loops go on for too long.
fn read<R: BufRead>(program: &mut Program<R>, mut see: impl FnMut(&Item)) -> (Diagnostics, bool) {
    let most = program.interpreter.options.loops.checked_lines;
    let mut found = Diagnostics::default();
    while program.kept_lines() < most {
        match program.next_line() {
            Some(Ok(())) => program.items().iter().for_each(&mut see),
            Some(Err(diagnostic)) if found.diagnostics.len() < MAX_DIAGNOSTICS => {
                found.diagnostics.push(diagnostic);
            }
            Some(Err(_)) => found.more = found.more.saturating_add(1),
            None => break,
        }
    }
    found.lines = program.totals().lines;
    (found, program.kept_lines() < most)
}
