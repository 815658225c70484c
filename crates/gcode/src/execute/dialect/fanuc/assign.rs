//! Assignments to FANUC's variables: offsets, alarms and stops.

use std::io::BufRead;

use glidepath_geometry::Axis;
use glidepath_program::{Event, ItemKind};

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::execute::dialect::fanuc::tool_variables::{ToolPart, direction, is_of_tools};
use crate::execute::dialect::fanuc::variables::{EXTENDED, NO_VARIABLE, Variable};
use crate::execute::interpreter::Interpreter;
use crate::execute::program::Program;
use crate::summary::remark::{Remark, RemarkKind};
use crate::syntax::expression::scope::Parameter;
use crate::syntax::expression::vacant::is_vacant;

impl<R: BufRead> Program<R> {
    /// Refuses an assignment that is not possible, and raises alarms.
    pub(crate) fn check_fanuc_assignable(
        &self,
        number: u32,
        value: f64,
        span: SourceSpan,
    ) -> Outcome<()> {
        let why = match self.scope().variable(number) {
            Variable::Own | Variable::Stop | Variable::Switch | Variable::Clock => return Ok(()),
            Variable::Alarm if value > 0.0 => return Err(self.alarm(value, span)),
            Variable::Alarm => return Ok(()),
            Variable::Tool(..) | Variable::Offset(..) if is_vacant(value) => {
                "an offset is a number"
            }
            Variable::Tool(ToolPart::Direction, _) if direction(value).is_none() => {
                "the direction of a tip is a whole number from 0 to 9"
            }
            Variable::Tool(..) => return Ok(()),
            Variable::Offset(system, axis) => {
                let is_system = system <= 6 || system > EXTENDED;
                if is_system && self.interpreter.numbered_axis(axis).is_some() {
                    return Ok(());
                }
                "the machine has no axis of that number"
            }
            Variable::Nothing => "it is what a variable holds that nothing was assigned to",
            Variable::Mode(_) | Variable::Address(_) | Variable::Place(..) => {
                "it shows what is in force, and where the machine is"
            }
            Variable::Unknown if is_of_tools(number) => self.scope().why_no_offset(number),
            Variable::Unknown => NO_VARIABLE,
        };
        let message = format!("#{number} cannot be assigned");
        Err(
            BlockDiagnostic::new(DiagnosticCode::Parameter, span, message)
                .because(why)
                .help("use #100 to #199, or #500 to #999"),
        )
    }

    /// An alarm of the program, with its text.
    fn alarm(&self, number: f64, span: SourceSpan) -> Box<BlockDiagnostic> {
        let text = String::from_utf8_lossy(self.block.comment.trim_ascii()).into_owned();
        let message = match text.as_str() {
            "" => format!("the program raises alarm {number}"),
            text => format!("the program raises alarm {number}: {text}"),
        };
        BlockDiagnostic::new(DiagnosticCode::Alarm, span, message)
            .because("#3000 stops the machine: the program found something that must not be")
            .help("look at the condition in front of it")
    }

    /// Assigns; it has been found possible.
    pub(crate) fn assign_fanuc(&mut self, number: u32, value: f64, line: u32) {
        let mm = self.interpreter.state.modal.units.mm();
        match self.scope().variable(number) {
            Variable::Own => {
                let parameter = Parameter::Numbered(number);
                self.parameters.assign(&parameter, value);
            }
            Variable::Tool(part, tool) => self.interpreter.set_tool_part(part, tool, value, mm),
            Variable::Stop => self.stop_with_text(line),
            Variable::Offset(system, axis) => {
                if let Some(axis) = self.interpreter.numbered_axis(axis) {
                    let value = if axis.is_rotary() { value } else { value * mm };
                    let is_diameter = axis == Axis::X && self.interpreter.state.modal.diameter;
                    let value = if is_diameter { 0.5 * value } else { value };
                    self.interpreter.set_offset(system, axis.index(), value);
                }
            }
            _ => {}
        }
    }

    /// `#3006`: the machine stands until it is told to go on.
    fn stop_with_text(&mut self, line: u32) {
        let text = String::from_utf8_lossy(self.block.comment.trim_ascii()).into_owned();
        if self.keeps_remarks && !text.is_empty() {
            let kind = RemarkKind::Stop;
            self.remarks.push(Remark { line, kind, text });
        }
        let stop = ItemKind::Event(Event::ProgramStop(0));
        self.interpreter.push(&mut self.items, stop);
    }
}

impl Interpreter {
    fn set_offset(&mut self, system: u32, axis: usize, value: f64) {
        let index = usize::try_from(system).unwrap_or(usize::MAX);
        match index.checked_sub(1) {
            None => self.state.offsets.fanuc.external[axis] = value,
            Some(index) if system <= EXTENDED => {
                if let Some(system) = self.state.offsets.systems.get_mut(index) {
                    system.origin[axis] = value;
                }
            }
            Some(_) => {
                let extended = &mut self.state.offsets.fanuc.extended;
                let system = extended.entry(system - EXTENDED).or_default();
                system.origin[axis] = value;
            }
        }
        self.state.changes = self.state.changes.saturating_add(1);
    }
}
