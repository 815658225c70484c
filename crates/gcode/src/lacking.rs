//! What a program should say and does not: no mistake for certain, but whoever runs it should make sure of it.

use std::io::BufRead;

use glidepath_geometry::AxisVector;

use crate::execute::program::Program;
use crate::setup::siemens::LatheX;
use crate::syntax::dialect::Dialect;

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
