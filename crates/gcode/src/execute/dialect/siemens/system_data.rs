//! What the control keeps of coordinate systems and tools, and programs set.
//!
//! ```text
//! $P_UIFR[1]=CTRANS(X,10,Y,5):CROT(Z,30)   $P_UIFR[1,X,TR]=10   $P_UIFR[1,Z,RT]=30
//! $P_PFRAME=CTRANS(X,10)                   the frame of the program ([`program_frame`](super::program_frame))
//! $TC_DP3[2,1]=50                          the first length of edge D1 of tool 2
//! $TC_DP3[5]=50                            with flat D numbers that of the offset D5
//! ```
//!
//! A coordinate system that is in force changes with its next G54 or G505. Lengths of a tool are along
//! Z, Y and X on a mill, along X, Z and Y on a lathe; `$TC_DP6` is its radius. Lengths are in millimetres, with G700
//! in inches; G70 is not for them.

use std::io::BufRead;
use std::sync::Arc;

use glidepath_geometry::{Axis, AxisVector};

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::execute::dialect::siemens::flow::check_end;
use crate::execute::interpreter::Interpreter;
use crate::execute::program::Program;
use crate::execute::scope::ProgramScope;
use crate::execute::state::fanuc_offsets::system_key;
use crate::setup::tool_table::{MAX_EDGE, MAX_TOOL, Tool};
use crate::setup::work_offsets::CoordinateSystem;
use crate::syntax::dialect::siemens::expression::Evaluator;
use crate::syntax::dialect::siemens::system_index::{Index, letters};

/// Coordinate systems there are: G54 to G57, G505 to G599.
const MOST_SYSTEMS: f64 = 99.0;

impl<R: BufRead> Program<R> {
    /// A line that sets a coordinate system, or an edge of a tool.
    pub(super) fn siemens_system_data(&mut self, text: &[u8], at: usize) -> Outcome<()> {
        let scope = ProgramScope {
            parameters: &self.parameters,
            interpreter: &self.interpreter,
        };
        let mut input = self.evaluator(&scope, text, at);
        let name = input.name_ahead();
        input.at += name.len();
        let index = input.system_index()?;
        let span = SourceSpan::new(at, input.at);
        if !input.eat(b'=') {
            return Err(BlockDiagnostic::new(
                DiagnosticCode::Parameter,
                span,
                "a variable without a value",
            )
            .because("a line with the variable alone says nothing")
            .help("write `=` and its value"));
        }
        if name == b"$P_PFRAME" {
            return self.set_program_frame(text, (input.at, &index), span);
        }
        if name == b"$P_UIFR" {
            let (number, system) = self.system_of(&mut input, &index, span)?;
            self.set_coordinate_system(number, system);
            return Ok(());
        }
        let value = input.value()?;
        check_end(&mut input)?;
        self.set_edge(&name, &index, value, span)
    }

    /// The number of a coordinate system, counted from 0, and what it is to be.
    fn system_of(
        &self,
        input: &mut Evaluator<'_>,
        index: &[Index],
        span: SourceSpan,
    ) -> Outcome<(usize, CoordinateSystem)> {
        let number = match index.first() {
            Some(Index::Value(number)) => system_number(*number),
            _ => None,
        };
        let Some(number) = number else {
            return Err(unknown_part(&letters(b"$P_UIFR"), span));
        };
        let mm = self.interpreter.variable_unit_mm();
        let scaled = |axis: Axis, value: f64| {
            if axis.is_rotary() { value } else { value * mm }
        };
        let mut system = self.interpreter.kept_system(number);
        match index.get(1..).unwrap_or_default() {
            [] => {
                system = CoordinateSystem::default();
                loop {
                    let start = input.at;
                    let (function, values) = input.frame_function()?;
                    let span = SourceSpan::new(start, input.at);
                    for (axis, value) in values {
                        match function.as_slice() {
                            b"CTRANS" => system.origin[axis.index()] = scaled(axis, value),
                            b"CROT" if axis == Axis::Z => system.rotation_deg = value,
                            _ => return Err(unknown_part(&letters(&function), span)),
                        }
                    }
                    if !input.eat(b':') {
                        break;
                    }
                }
            }
            [Index::Axis(axis), Index::Word(part)] if part == b"TR" => {
                system.origin[axis.index()] = scaled(*axis, input.value()?);
            }
            [Index::Axis(Axis::Z), Index::Word(part)] if part == b"RT" => {
                system.rotation_deg = input.value()?;
            }
            _ => return Err(unknown_part(&letters(b"$P_UIFR"), span)),
        }
        check_end(input)?;
        Ok((number, system))
    }

    fn set_coordinate_system(&mut self, number: usize, system: CoordinateSystem) {
        let offsets = &mut self.interpreter.state.offsets;
        let is_active = match offsets.fanuc.active {
            None => offsets.active == number,
            Some(key) => key == system_key(number),
        };
        if is_active {
            offsets.fanuc.pending.insert(number, system);
        } else {
            offsets.keep_system(number, system);
        }
        self.interpreter.state.changes = self.interpreter.state.changes.saturating_add(1);
    }

    fn set_edge(
        &mut self,
        name: &[u8],
        index: &[Index],
        value: f64,
        span: SourceSpan,
    ) -> Outcome<()> {
        let part = edge_part(name, self.interpreter.options.is_lathe());
        let edge = self.interpreter.edge_of(index);
        let (Some(part), Some(edge)) = (part, edge) else {
            return Err(unknown_part(&letters(name), span));
        };
        if part == EdgePart::Kind && value == 0.0 {
            let message = format!("{} = 0 is not supported", letters(name));
            return Err(
                BlockDiagnostic::new(DiagnosticCode::NotSupported, span, message)
                    .because("it takes the edge out of the control's memory, and here a tool keeps its edges")
                    .help("remove it, or write what the tool is (120: an end mill)"),
            );
        }
        let value_mm = value * self.interpreter.variable_unit_mm();
        self.interpreter.change_edge(edge, |tool| match part {
            EdgePart::Kind => {}
            EdgePart::Length(axis) => tool.offset[axis] = value_mm,
            EdgePart::Radius => tool.diameter_mm = 2.0 * value_mm,
        });
        self.interpreter.state.changes = self.interpreter.state.changes.saturating_add(1);
        Ok(())
    }
}

/// A part of the edge of a tool.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum EdgePart {
    /// What the tool is, which no motion depends on.
    Kind,
    Length(usize),
    Radius,
}

/// The part that a variable is, by its name.
pub(super) fn edge_part(name: &[u8], is_lathe: bool) -> Option<EdgePart> {
    let lengths = if is_lathe { [0, 2, 1] } else { [2, 1, 0] };
    Some(match name {
        b"$TC_DP1" => EdgePart::Kind,
        b"$TC_DP3" => EdgePart::Length(lengths[0]),
        b"$TC_DP4" => EdgePart::Length(lengths[1]),
        b"$TC_DP5" => EdgePart::Length(lengths[2]),
        b"$TC_DP6" => EdgePart::Radius,
        _ => return None,
    })
}

/// A number from 1 to `max`.
fn counted(value: f64, max: u32) -> Option<u32> {
    let is_one = value.fract() == 0.0 && (1.0..=f64::from(max)).contains(&value);
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "range checked"
    )]
    is_one.then_some(value as u32)
}

/// The number of a coordinate system, counted from 0: 1 is that of G54, 5 that of G505.
pub(super) fn system_number(number: f64) -> Option<usize> {
    let is_system = number.fract() == 0.0 && (1.0..=MOST_SYSTEMS).contains(&number);
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "range checked"
    )]
    is_system.then(|| number as usize - 1)
}

impl Interpreter {
    /// The unit of length of the control's variables, mm. G70 and G71 are for what a program says of the workpiece:
    /// tools, settable offsets and places stay in millimetres, as F does; with G700 and G710 they follow.
    pub(super) const fn variable_unit_mm(&self) -> f64 {
        self.feed_unit_mm()
    }

    /// One axis of a vector in the unit of the control's variables.
    pub(super) fn in_variable_units(&self, vector: AxisVector, axis: Axis) -> f64 {
        let unit = if axis.is_rotary() {
            1.0
        } else {
            self.variable_unit_mm()
        };
        vector[axis.index()] / unit
    }

    /// The tool and the edge that `[tool, edge]` names; with flat D numbers it is `[D]`, and the first edge of the line
    /// of that T.
    pub(super) fn edge_of(&self, index: &[Index]) -> Option<(u32, u32)> {
        match (index, self.options.siemens.flat_d_numbers) {
            ([Index::Value(tool), Index::Value(edge)], false) => {
                Some((counted(*tool, MAX_TOOL)?, counted(*edge, MAX_EDGE)?))
            }
            ([Index::Value(edge)], true) => Some((counted(*edge, MAX_EDGE)?, 1)),
            _ => None,
        }
    }

    /// Changes an edge in the tool table, which gets it if it has none of these numbers.
    fn change_edge(&mut self, (tool, edge): (u32, u32), change: impl Fn(&mut Tool)) {
        let tools = self.state.tools.get_or_insert_default();
        let tools = Arc::make_mut(tools);
        let mut changed = tools.edge(tool, edge).copied().unwrap_or_default();
        change(&mut changed);
        tools.set_edge(tool, edge, changed);
    }

    /// A coordinate system as the program has set it, or as the machine keeps it.
    pub(super) fn kept_system(&self, number: usize) -> CoordinateSystem {
        let offsets = &self.state.offsets;
        let pending = offsets.fanuc.pending.get(&number);
        let kept = offsets.systems.get(number);
        let others = offsets.fanuc.extended.get(&system_key(number));
        pending.or(kept).or(others).copied().unwrap_or_default()
    }
}

#[cold]
pub(super) fn unknown_part(name: &str, span: SourceSpan) -> Box<BlockDiagnostic> {
    let message = format!("this part of {name} cannot be set");
    BlockDiagnostic::new(DiagnosticCode::NotSupported, span, message)
        .because(
            "of a coordinate system shifts and the turn about Z are kept, of a tool the lengths and the radius of its edges: \
             $TC_DP3[tool,edge], with flat D numbers $TC_DP3[D]",
        )
        .help("remove it, or set it at the machine")
}
