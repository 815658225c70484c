//! Numbered and named parameters.
//!
//! | parameter | meaning |
//! |---|---|
//! | `#1` … `#30` | local to a subroutine call; its arguments at first |
//! | `#31` … `#5000` | global, zero at first |
//! | `#5061` … `#5070` | program coordinates of the last probing move's end; 1: contact was made |
//! | `#5161` …, `#5181` … | positions of G28 and G30, machine coordinates |
//! | `#5210`, `#5211` … | is G92 in force, and its offsets |
//! | `#5220` | active coordinate system, 1 for G54 |
//! | `#5221` …, `#5241` … | origins of G54, G55 …; the tenth of each is its rotation |
//! | `#5399` | input read by M66 last |
//! | `#5400` … `#5413` | tool in the spindle: number, offsets in force, diameter, –, –, orientation |
//! | `#5420` … `#5428` | program coordinates of the position, in the units in force |
//! | other numbers to `#5602` | read as zero |
//! | `#<name>` | local to a subroutine call |
//! | `#<_name>` | global |
//!
//! What describes the machine (from `#5001` on, and the names in [`state`]) cannot be assigned.

use std::collections::BTreeMap;

use glidepath_geometry::{AXES, AxisVector};

use crate::diagnostic::{Code, Fault, Outcome, Span};
use crate::expression::{Parameter, Scope, no_parameter};
use crate::interpreter::Interpreter;
use crate::modes::{Distance, Units};

/// Parameters local to a subroutine call.
pub(crate) const LOCALS: usize = 30;
/// Largest number that can be assigned.
const MAX_ASSIGNED: u32 = 5000;
/// Largest number that exists.
const MAX_NUMBERED: u32 = 5602;
/// Most named parameters at a time.
const MAX_NAMES: usize = 10_000;

/// What a subroutine call has for itself.
#[derive(Debug, Clone, Default)]
struct Locals {
    numbered: [f64; LOCALS],
    named: BTreeMap<String, f64>,
}

/// All parameters a program can assign.
#[derive(Debug, Clone)]
pub(crate) struct Parameters {
    /// `#31` and up, by number; empty until one is assigned.
    global: Vec<f64>,
    named: BTreeMap<String, f64>,
    /// One per call level; the first is that of the program itself.
    levels: Vec<Locals>,
    names: usize,
}

impl Parameters {
    pub(crate) fn new() -> Self {
        Self {
            global: Vec::new(),
            named: BTreeMap::new(),
            levels: vec![Locals::default()],
            names: 0,
        }
    }

    /// Subroutine calls in progress.
    pub(crate) fn call_level(&self) -> usize {
        self.levels.len().saturating_sub(1)
    }

    /// Starts a call with these arguments.
    pub(crate) fn enter(&mut self, arguments: &[f64]) {
        let mut locals = Locals::default();
        for (slot, value) in locals.numbered.iter_mut().zip(arguments) {
            *slot = *value;
        }
        self.levels.push(locals);
    }

    /// Ends a call, with the value it returned.
    pub(crate) fn leave(&mut self, value: Option<f64>) {
        if self.levels.len() > 1
            && let Some(locals) = self.levels.pop()
        {
            self.names = self.names.saturating_sub(locals.named.len());
        }
        self.named.insert("_value".to_owned(), value.unwrap_or(0.0));
        self.named.insert(
            "_value_returned".to_owned(),
            f64::from(u8::from(value.is_some())),
        );
    }

    /// Refuses an assignment that is not possible.
    pub(crate) fn check_assignable(&self, parameter: &Parameter, span: Span) -> Outcome<()> {
        match parameter {
            Parameter::Numbered(number) if *number > MAX_NUMBERED => {
                Err(no_parameter(span, f64::from(*number)))
            }
            Parameter::Numbered(number) if *number > MAX_ASSIGNED => Err(read_only(span)),
            Parameter::Named(name) if READ_ONLY.contains(&name.as_str()) => Err(read_only(span)),
            Parameter::Named(_) if self.names >= MAX_NAMES => {
                let message = format!("more than {MAX_NAMES} named parameters");
                Err(Fault::new(Code::Parameter, span, message)
                    .because("the memory of a program is bounded")
                    .help("use numbered parameters"))
            }
            _ => Ok(()),
        }
    }

    /// Assigns; the parameter has been found assignable.
    pub(crate) fn assign(&mut self, parameter: &Parameter, value: f64) {
        match parameter {
            Parameter::Numbered(number) => {
                let index = usize::try_from(*number).unwrap_or(usize::MAX);
                if (1..=LOCALS).contains(&index) {
                    if let Some(locals) = self.levels.last_mut() {
                        locals.numbered[index - 1] = value;
                    }
                } else if *number <= MAX_ASSIGNED {
                    if self.global.len() <= index {
                        self.global.resize(index + 1, 0.0);
                    }
                    self.global[index] = value;
                }
            }
            Parameter::Named(name) => {
                let names = if name.starts_with('_') {
                    &mut self.named
                } else if let Some(locals) = self.levels.last_mut() {
                    &mut locals.named
                } else {
                    return;
                };
                if names.insert(name.clone(), value).is_none() {
                    self.names += 1;
                }
            }
        }
    }

    fn numbered(&self, number: u32) -> f64 {
        let index = usize::try_from(number).unwrap_or(usize::MAX);
        if (1..=LOCALS).contains(&index) {
            return self
                .levels
                .last()
                .map_or(0.0, |locals| locals.numbered[index - 1]);
        }
        self.global.get(index).copied().unwrap_or(0.0)
    }

    fn named(&self, name: &str) -> Option<f64> {
        let names = if name.starts_with('_') {
            &self.named
        } else {
            &self.levels.last()?.named
        };
        names.get(name).copied()
    }
}

fn read_only(span: Span) -> Box<Fault> {
    Fault::new(Code::Parameter, span, "the parameter cannot be assigned")
        .because("it shows the state of the machine")
        .help("use G10, G28.1, G92 and the like, or another parameter")
}

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

/// Names that show the state and cannot be assigned.
const READ_ONLY: [&str; 17] = [
    "_x",
    "_y",
    "_z",
    "_a",
    "_b",
    "_c",
    "_u",
    "_v",
    "_w",
    "_metric",
    "_imperial",
    "_absolute",
    "_incremental",
    "_feed",
    "_call_level",
    "_current_tool",
    "_selected_tool",
];

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
