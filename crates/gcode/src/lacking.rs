//! What a program should say and does not: no mistake for certain, but whoever runs it should make sure of it.

use std::io::BufRead;

use glidepath_geometry::AxisVector;

use crate::execute::program::Program;
use crate::setup::siemens::LatheX;
use crate::syntax::dialect::Dialect;
use crate::syntax::modes::{CannedCycle, Motion, NonModal};

/// What a program lacks. It is executed all the same.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Lacking {
    /// The text ends before the program does, which M2, M30 or a percent line would end: its last
    /// part may be missing.
    pub end: bool,
    /// A FANUC program moves before it says its units, and nothing else says them: it is read in millimetres, and is
    /// 25.4 times too small if inches were meant.
    pub units: bool,
    /// A program of a SINUMERIK's lathe moves before it says what X is, and nothing else says it: it is read as a radius,
    /// and the part is twice as thick if diameters were meant.
    pub diameter: bool,
    /// A cycle of a FANUC goes across to its hole below its R plane: it begins there, and the control stays at that
    /// level.
    pub crossing: bool,
    /// Klipper does not wait at a `G4 S`: it has P alone, in milliseconds.
    pub dwell: bool,
    /// A program between percent lines, read as LinuxCNC's, has a dwell of more than 10 by a P without a decimal point:
    /// these are seconds, and milliseconds on a FANUC.
    pub seconds: bool,
}

/// A dwell by a P without a point that is longer than this may be meant in milliseconds, s.
const LONG_DWELL_S: f64 = 10.0;

/// Whether the block that was executed waits for long by a P without a decimal point, in a program that begins with a
/// percent line, as FANUC's do, and is read as LinuxCNC's.
pub(crate) fn waits_by_whole_seconds<R: BufRead>(program: &Program<R>) -> bool {
    // First what most programs have not: every block is asked.
    program.percent && is_long_dwell(program)
}

#[inline(never)]
fn is_long_dwell<R: BufRead>(program: &Program<R>) -> bool {
    let block = program.block();
    let is_linuxcnc = block.dialect == Dialect::LinuxCnc;
    let Some(time_s) = block
        .get(b'P')
        .filter(|time_s| is_linuxcnc && *time_s > LONG_DWELL_S)
    else {
        return false;
    };
    let codes = &block.codes;
    let is_dwell = codes
        .non_modal
        .is_some_and(|coded| coded.code == NonModal::Dwell);
    let is_cycle = codes.motion.is_some_and(|coded| {
        matches!(
            coded.code,
            Some(Motion::Cycle(
                CannedCycle::DrillDwell | CannedCycle::BoreStop | CannedCycle::BoreDwell
            ))
        )
    });
    if !is_dwell && !is_cycle {
        return false;
    }
    let (text, span) = (program.here().text, block.span(b'P'));
    let word = text.get(span.start..span.start + span.length);
    let digits = word.and_then(|word| core::str::from_utf8(word.get(1..)?).ok());
    // The words of a line with a point in them, or computed, are what was meant.
    let digits = digits.map(str::trim).filter(|digits| !digits.contains('.'));
    digits.and_then(|digits| digits.parse().ok()) == Some(time_s)
}

/// What a program has not said yet and nothing else says, and where it begins: a move from there needs it.
pub(crate) struct Unsaid {
    units: bool,
    /// Whether X is a diameter.
    diameter: bool,
    begins_at: AxisVector,
}

impl Unsaid {
    /// Only FANUC's programs are asked for their units: other controls begin in millimetres.
    pub(crate) fn at_start<R: BufRead>(program: &Program<R>) -> Self {
        let options = &program.interpreter.options;
        Self {
            units: options.dialect == Dialect::Fanuc
                && options.fanuc.units_at_start.is_none()
                && options.in_force.is_none(),
            diameter: options.is_siemens_lathe() && options.siemens.lathe_x == LatheX::Unsaid,
            begins_at: *Program::position(program),
        }
    }

    pub(crate) const fn is_any(&self) -> bool {
        self.units || self.diameter
    }

    /// Looks at the block that was executed. What is lacking once the machine has moved is told once.
    #[cold]
    pub(crate) fn look<R: BufRead>(&mut self, program: &Program<R>, lacks: &mut Lacking) {
        let codes = &program.block().codes;
        self.units &= codes.units.is_none();
        self.diameter &= codes.diameter.is_none() && codes.diameter_by_distance.is_none();
        if *Program::position(program) != self.begins_at {
            lacks.units |= self.units;
            lacks.diameter |= self.diameter;
            (self.units, self.diameter) = (false, false);
        }
    }
}
