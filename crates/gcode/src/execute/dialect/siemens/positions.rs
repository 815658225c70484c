//! HOLES1, HOLES2, CYCLE801 and CYCLE802: positions at which the cycle of MCALL is made.
//!
//! | | |
//! |---|---|
//! | `HOLES1(SPCA, SPCO, STA1, FDIS, DBH, NUM)` | a row from SPCA, SPCO at the angle STA1: FDIS to the first hole, DBH from hole to hole; it begins at the end that is nearer to the tool |
//! | `HOLES2(CPA, CPO, RAD, STA1, INDA, NUM)` | a circle about CPA, CPO; INDA 0: all round |
//! | `CYCLE801(SPCA, SPCO, STA, DIS1, DIS2, NUM1, NUM2)` | a grid: NUM1 holes DIS1 apart along the angle STA, NUM2 rows DIS2 apart |
//! | `CYCLE802(XA, YA, X0, Y0, … X8, Y8, VARI, UMODE, DMODE)` | up to 9 positions ([`single_positions`](super::single_positions)) |

use std::io::BufRead;

use glidepath_geometry::Axis;

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::execute::dialect::siemens::single_positions::single_places;
use crate::execute::dialect::siemens::steps::Step;
use crate::execute::program::Program;
use crate::execute::scope::coordinate;

/// Most holes of a pattern.
const MOST_HOLES: f64 = 10_000.0;

/// Distances that differ by no more are the same, in the units of the program.
const SAME_PLACE: f64 = 1e-6;

/// Names of patterns, and how many arguments each has.
const PATTERNS: [(&[u8], usize); 3] = [(b"HOLES1", 6), (b"HOLES2", 6), (b"CYCLE801", 7)];

impl<R: BufRead> Program<R> {
    /// A pattern in a line of its own.
    pub(super) fn siemens_positions(&mut self, text: &[u8], at: usize) -> Outcome<()> {
        let (name, arguments, span) = {
            let scope = self.scope();
            let mut input = self.evaluator(&scope, text, at);
            let name = input.name_ahead();
            input.at += name.len();
            let arguments = input.arguments()?;
            (name, arguments, SourceSpan::new(at, input.at))
        };
        let refuse = |message: &str, reason: &str, help: &str| {
            Err(
                BlockDiagnostic::new(DiagnosticCode::CannedCycle, span, message)
                    .because(reason)
                    .help(help),
            )
        };
        if self.siemens.modal_call.is_none() {
            return refuse(
                "a pattern of holes without a cycle",
                "MCALL says what is made at each position",
                "write MCALL and a cycle before it",
            );
        }
        let interpreter = &self.interpreter;
        if interpreter.counts_diameters() && interpreter.state.modal.plane.normal() != Axis::X {
            return refuse(
                "a pattern of holes where X counts diameters",
                "whether X is a diameter among its arguments, too, depends on the control",
                "write DIAMOF before it, and radii",
            );
        }
        if name == b"CYCLE802" {
            let plane = self.interpreter.state.modal.plane;
            return self.siemens_visit(single_places(&arguments, plane, span)?);
        }
        let count = PATTERNS.iter().find(|(known, _)| *known == name);
        let count = count.map_or(0, |(_, count)| *count);
        let values: Option<Vec<f64>> = (0..count)
            .map(|index| match arguments.get(index).copied().flatten() {
                // The angle and the distance to the first hole may be left out.
                None if matches!(index, 2..=4) => Some(0.0),
                value => value,
            })
            .collect();
        let extra = arguments.get(count..).unwrap_or_default().iter().flatten();
        let (Some(values), 0) = (values, extra.filter(|value| **value != 0.0).count()) else {
            return refuse(
                "another number of arguments than the pattern has",
                "what others mean depends on the version of the control",
                "write those that the manual lists",
            );
        };
        let holes: f64 = values.get(5..).unwrap_or_default().iter().product();
        let is_whole = values
            .get(5..)
            .unwrap_or_default()
            .iter()
            .all(|n| n.fract() == 0.0 && *n >= 1.0);
        if !is_whole || holes > MOST_HOLES {
            return refuse(
                "a number of holes that is not possible",
                "it is a whole number, and 10000 at most",
                "write another number",
            );
        }
        let mut places = places(&name, &values);
        if name == b"HOLES1" {
            let (first, second) = self.interpreter.state.modal.plane.axes();
            let here = [first, second].map(|axis| coordinate(&self.interpreter, axis.index()));
            begin_nearer(&mut places, here);
        }
        self.siemens_visit(places)
    }

    /// The positions come next.
    fn siemens_visit(&mut self, places: Vec<[f64; 2]>) -> Outcome<()> {
        let positions = places.into_iter().map(Step::Position);
        self.siemens.steps.extend(positions);
        self.siemens_make_typed()
    }
}

/// A row begins at its end that is nearer to the tool, and at its first hole where both are as near.
fn begin_nearer(row: &mut [[f64; 2]], here: [f64; 2]) {
    let far = |place: &[f64; 2]| (place[0] - here[0]).hypot(place[1] - here[1]);
    if let (Some(first), Some(last)) = (row.first(), row.last())
        && far(last) < far(first) - SAME_PLACE
    {
        row.reverse();
    }
}

/// The positions of a pattern, in the two axes of the plane.
fn places(name: &[u8], values: &[f64]) -> Vec<[f64; 2]> {
    let at = |index: usize| values.get(index).copied().unwrap_or(0.0);
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "whole numbers, checked"
    )]
    let number = |index: usize| at(index) as u32;
    let (sin, cos) = at(2).to_radians().sin_cos();
    match name {
        b"HOLES1" => (0..number(5))
            .map(|hole| {
                let way = at(3) + f64::from(hole) * at(4);
                [at(0) + way * cos, at(1) + way * sin]
            })
            .collect(),
        b"HOLES2" => {
            let step = if at(4) == 0.0 { 360.0 / at(5) } else { at(4) };
            (0..number(5))
                .map(|hole| {
                    let (sin, cos) = (at(3) + f64::from(hole) * step).to_radians().sin_cos();
                    [at(0) + at(2) * cos, at(1) + at(2) * sin]
                })
                .collect()
        }
        _ => (0..number(6))
            .flat_map(|row| (0..number(5)).map(move |column| (f64::from(row), f64::from(column))))
            .map(|(row, column)| {
                let (u, v) = (column * at(3), row * at(4));
                [at(0) + u * cos - v * sin, at(1) + u * sin + v * cos]
            })
            .collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn positions_by_hand() {
        let row = places(b"HOLES1", &[10.0, 0.0, 90.0, 5.0, 20.0, 2.0]);
        assert!((row[1][0] - 10.0).abs() < 1e-12 && (row[1][1] - 25.0).abs() < 1e-12);
        let circle = places(b"HOLES2", &[1.0, 2.0, 10.0, 0.0, 0.0, 4.0]);
        assert!((circle[1][0] - 1.0).abs() < 1e-12 && (circle[1][1] - 12.0).abs() < 1e-12);
        let grid = places(b"CYCLE801", &[0.0, 0.0, 0.0, 10.0, 20.0, 3.0, 2.0]);
        assert_eq!((grid.len(), grid[5]), (6, [20.0, 20.0]));
    }
}
