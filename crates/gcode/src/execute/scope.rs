//! The parameters that an expression reads: those assigned, and those that show the state.

use glidepath_geometry::{AXES, AxisVector};

use crate::execute::interpreter::Interpreter;
use crate::execute::parameters::{MAX_ASSIGNED, MAX_NUMBERED, Parameters, READ_ONLY};
use crate::syntax::expression::scope::Scope;
use crate::syntax::modes::{Distance, Units};

/// Parameters, and the state of the interpreter that can be read as parameters.
pub(crate) struct ProgramScope<'a> {
    pub(crate) parameters: &'a Parameters,
    pub(crate) interpreter: &'a Interpreter,
}

impl Scope for ProgramScope<'_> {
    fn numbered(&self, number: u32) -> Option<f64> {
        match number {
            0 => None,
            1..=MAX_ASSIGNED => Some(self.parameters.numbered(number)),
            _ => (number <= MAX_NUMBERED).then(|| machine(self.interpreter, number)),
        }
    }

    fn named(&self, name: &str) -> Option<f64> {
        let value = self.parameters.named(name);
        value.or_else(|| state(self.interpreter, self.parameters, name))
    }
}

/// Program coordinate of an axis in the units in force.
fn coordinate(interpreter: &Interpreter, axis: usize) -> f64 {
    let program = interpreter.offsets.to_program(interpreter.state.position);
    in_units(interpreter, program, axis)
}

/// One axis of a vector in the units in force.
fn in_units(interpreter: &Interpreter, vector: AxisVector, axis: usize) -> f64 {
    let rotary = (3..6).contains(&axis);
    let scale = if rotary {
        1.0
    } else {
        interpreter.state.modal.units.mm()
    };
    vector.get(axis).copied().unwrap_or(0.0) / scale
}

/// Value of a numbered parameter that shows the state of the machine.
fn machine(interpreter: &Interpreter, number: u32) -> f64 {
    let number = usize::try_from(number).unwrap_or(0);
    let offsets = &interpreter.offsets;
    let index_from = |first: usize| number - first;
    match number {
        5061..=5069 => in_units(
            interpreter,
            interpreter.state.probe.contact,
            index_from(5061),
        ),
        5070 => f64::from(u8::from(interpreter.state.probe.made)),
        5161..=5169 => offsets.reference[0][index_from(5161)],
        5181..=5189 => offsets.reference[1][index_from(5181)],
        5210 => f64::from(u8::from(offsets.shift.iter().any(|v| *v != 0.0))),
        5211..=5219 => offsets.shift[index_from(5211)],
        5220 => f64::from(u8::try_from(offsets.active + 1).unwrap_or(1)),
        5221..=5390 => {
            let (system, axis) = (index_from(5221) / 20, index_from(5221) % 20);
            offsets
                .systems
                .get(system)
                .map_or(0.0, |system| match axis {
                    0..AXES => system.origin[axis],
                    AXES => system.rotation_deg,
                    _ => 0.0,
                })
        }
        5399 => interpreter.state.input,
        5400 => f64::from(interpreter.state.tool),
        5401..=5409 => in_units(interpreter, offsets.tool, index_from(5401)),
        5410 | 5413 => {
            let tool = interpreter.tools.as_ref();
            let tool = tool.and_then(|tools| tools.get(interpreter.state.tool));
            tool.map_or(0.0, |tool| match number {
                5410 => tool.diameter_mm / interpreter.state.modal.units.mm(),
                _ => f64::from(tool.orientation),
            })
        }
        5420..=5428 => coordinate(interpreter, index_from(5420)),
        _ => 0.0,
    }
}

/// Value of a name that shows the state.
fn state(interpreter: &Interpreter, parameters: &Parameters, name: &str) -> Option<f64> {
    let modal = &interpreter.state.modal;
    let truth = |t: bool| f64::from(u8::from(t));
    let position = READ_ONLY.iter().position(|known| *known == name)?;
    Some(match position {
        0..9 => coordinate(interpreter, position),
        9 => truth(modal.units == Units::Millimetre),
        10 => truth(modal.units == Units::Inch),
        11 => truth(modal.distance == Distance::Absolute),
        12 => truth(modal.distance == Distance::Incremental),
        13 => modal
            .feed
            .map_or(0.0, |feed| feed.linear_v * 60.0 / modal.units.mm()),
        14 => f64::from(u32::try_from(parameters.call_level()).unwrap_or(u32::MAX)),
        15 => f64::from(interpreter.state.tool),
        _ => f64::from(interpreter.state.selected_tool),
    })
}
