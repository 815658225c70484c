//! The scope of an expression: the parameters that were assigned, and those that show the state.

use glidepath_geometry::{AXES, AxisVector};

use crate::execute::interpreter::Interpreter;
use crate::execute::parameters::{DEBUG, MAX_ASSIGNED, MAX_NUMBERED, Parameters, place_of_name};
use crate::execute::state::mode_codes::{motion_tenths, plane_tenths};
use crate::execute::state::spindle::SpindleDirection;
use crate::execute::state_names::READ_ONLY;
use crate::setup::fanuc::Arctangent;
use crate::syntax::dialect::Dialect;
use crate::syntax::dialect::siemens::system_index::Index;
use crate::syntax::expression::scope::Scope;
use crate::syntax::letters::AXIS_LETTERS;
use crate::syntax::modes::{Distance, FeedMode, Retract, Side, Units};

/// Parameters, and the state of the interpreter that can be read as parameters.
pub(crate) struct ProgramScope<'a> {
    pub(crate) parameters: &'a Parameters,
    pub(crate) interpreter: &'a Interpreter,
}

impl Scope for ProgramScope<'_> {
    fn numbered(&self, number: u32) -> Option<f64> {
        if self.dialect() == Dialect::Fanuc {
            return Some(self.fanuc_variable(number));
        }
        match number {
            0 => None,
            1..=MAX_ASSIGNED | DEBUG => Some(self.parameters.numbered(number)),
            _ => (number <= MAX_NUMBERED).then(|| machine(self.interpreter, number)),
        }
    }

    fn named(&self, name: &str) -> Option<f64> {
        let value = self.parameters.named(name);
        value.or_else(|| state(self.interpreter, self.parameters, name))
    }

    fn refuses(&self, number: u32) -> Option<&'static str> {
        match self.dialect() {
            Dialect::Fanuc => self.refused_variable(number),
            _ => None,
        }
    }

    fn dialect(&self) -> Dialect {
        self.interpreter.options.dialect
    }

    fn system_value(&self, name: &[u8], index: &[Index]) -> Option<f64> {
        self.interpreter.siemens_value(name, index)
    }

    fn named_number(&self, name: &str) -> Option<u32> {
        let number = self.parameters.named(&place_of_name(name))?;
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "it was a number of a variable"
        )]
        Some(number as u32)
    }

    fn tool_named(&self, name: &str) -> Option<u32> {
        self.interpreter.state.tools.as_ref()?.named(name)
    }

    fn declares_m(&self, number: u32) -> bool {
        self.interpreter.options.m_codes.is_own(number)
    }

    fn least_increment(&self) -> f64 {
        match self.interpreter.state.modal.units {
            Units::Millimetre => 0.001,
            Units::Inch => 0.0001,
        }
    }

    fn has_full_arctangent(&self) -> bool {
        self.dialect() == Dialect::Fanuc
            && self.interpreter.options.fanuc.arctangent == Arctangent::Full
    }
}

/// Program coordinate of an axis in the units in force.
pub(super) fn coordinate(interpreter: &Interpreter, axis: usize) -> f64 {
    let program = interpreter
        .state
        .offsets
        .to_program(interpreter.state.position);
    in_units(interpreter, program, axis)
}

/// One axis of a vector in the units in force.
pub(super) fn in_units(interpreter: &Interpreter, vector: AxisVector, axis: usize) -> f64 {
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
    let offsets = &interpreter.state.offsets;
    let index_from = |first: usize| number - first;
    match number {
        5021..=5029 => in_units(interpreter, interpreter.state.position, index_from(5021)),
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
            let tool = interpreter.state.tools.as_ref();
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
    if !READ_ONLY.contains(&name) {
        return None;
    }
    let state = &interpreter.state;
    let modal = &state.modal;
    let truth = |t: bool| f64::from(u8::from(t));
    let coordinates = name
        .strip_prefix("_abs_")
        .or_else(|| name.strip_prefix('_'));
    let axis = coordinates.and_then(|letter| {
        let letter = letter.to_ascii_uppercase();
        let found = AXIS_LETTERS
            .iter()
            .position(|axis| [*axis] == letter.as_bytes());
        found.map(|axis| (axis, name.starts_with("_abs_")))
    });
    if let Some((axis, is_machine)) = axis {
        return Some(if is_machine {
            in_units(interpreter, state.position, axis)
        } else {
            coordinate(interpreter, axis)
        });
    }
    Some(match name {
        // Of LinuxCNC, whose language is read.
        "_vmajor" => 2.9,
        "_line" => f64::from(interpreter.line),
        "_motion_mode" => f64::from(modal.motion.map_or(800, motion_tenths)),
        "_plane" => f64::from(plane_tenths(modal.plane)),
        "_ccomp" => match (state.on_contour, state.contour_side) {
            (false, _) => 400.0,
            (true, Side::Left) => 410.0,
            (true, Side::Right) => 420.0,
        },
        "_metric" => truth(modal.units == Units::Millimetre),
        "_imperial" => truth(modal.units == Units::Inch),
        "_absolute" => truth(modal.distance == Distance::Absolute),
        "_incremental" => truth(modal.distance == Distance::Incremental),
        "_inverse_time" => truth(modal.feed_mode == FeedMode::InverseTime),
        "_units_per_minute" => truth(modal.feed_mode == FeedMode::PerMinute),
        "_units_per_rev" => truth(modal.feed_mode == FeedMode::PerRevolution),
        "_coord_system" => {
            let active = u8::try_from(interpreter.state.offsets.active).unwrap_or_default();
            f64::from(match active {
                0..=5 => 540 + 10 * u16::from(active),
                _ => 585 + u16::from(active),
            })
        }
        "_tool_offset" => truth(interpreter.state.offsets.tool.iter().any(|v| *v != 0.0)),
        "_retract_r_plane" => truth(modal.retract == Retract::RPlane),
        "_retract_old_z" => truth(modal.retract == Retract::Initial),
        "_spindle_rpm_mode" => truth(state.spindle.surface.is_none()),
        "_spindle_css_mode" => truth(state.spindle.surface.is_some()),
        "_ijk_absolute_mode" => truth(modal.arc_distance == Distance::Absolute),
        "_lathe_diameter_mode" => truth(modal.diameter),
        "_lathe_radius_mode" => truth(!modal.diameter),
        "_spindle_on" => truth(state.spindle.turning.is_some()),
        "_spindle_cw" => truth(state.spindle.turning == Some(SpindleDirection::Clockwise)),
        "_mist" => truth(state.coolant.mist),
        "_flood" => truth(state.coolant.flood),
        "_speed_override" | "_feed_override" => truth(!state.overrides_off),
        "_feed_hold" => 1.0,
        "_feed" => modal
            .feed
            .map_or(0.0, |feed| feed.linear_v * 60.0 / modal.units.mm()),
        "_rpm" => state.spindle.speed,
        "_call_level" => f64::from(u32::try_from(parameters.call_level()).unwrap_or(u32::MAX)),
        "_current_tool" => f64::from(state.tool),
        "_selected_tool" => f64::from(state.selected_tool),
        // The minor version, adaptive feed, and what is not there: task, remapped codes.
        _ => 0.0,
    })
}
