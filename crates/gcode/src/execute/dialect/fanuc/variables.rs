//! FANUC's variables: which there are, what they read, and what an assignment does.
//!
//! | | |
//! |---|---|
//! | `#0` | nothing; so is in every variable that nothing was assigned to |
//! | `#1` … `#33` | local to a macro |
//! | `#100` … `#199`, `#500` … `#999` | common |
//! | `#2001` … `#2999` | tool offsets, where the configuration says how their memory is divided ([`super::tool_variables`]) |
//! | `#3000=n(TEXT)`, `#3006=n(TEXT)` | an alarm, a stop |
//! | `#4001` … `#4022`, `#4107` `#4109` `#4111` `#4113` to `#4115` `#4119` `#4120` `#4130`; the same by 200 higher | modes; D F H M N O S T, P of G54.1 |
//! | `#5001` `#5021` `#5041` `#5061` `#5081` … | place in the program, of the machine, with the length of the tool; the same of a contact; length of the tool |
//! | `#5201` …, `#5221` … `#5328`, `#7001` …, `#14001` … | external offset, G54 to G59, G54.1 P1 and on |
//!
//! Axes are counted in the order of the machine's: X, Y, Z, then A, B, C. X of a lathe is a diameter, as in
//! its words.

use glidepath_geometry::{Axis, AxisVector};

use crate::execute::dialect::fanuc::tool_variables::{
    OF_SETTING_40, ToolPart, is_of_setting_40, is_of_tools, tool_variable,
};
use crate::execute::interpreter::Interpreter;
use crate::execute::scope::{ProgramScope, in_units};
use crate::syntax::expression::vacant::VACANT;
use crate::syntax::modes::FeedMode;

/// Variables of a coordinate system.
const PER_SYSTEM: u32 = 20;
/// Systems of `#7001` and of `#14001`.
const SYSTEMS_7001: u32 = 48;
const SYSTEMS_14001: u32 = 300;

/// What a variable is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Variable {
    Nothing,
    /// Local or common.
    Own,
    /// A tool offset: its number.
    Tool(ToolPart, u32),
    /// `#3000` and `#3006`.
    Alarm,
    Stop,
    /// What changes nothing here: `#3003`, `#3004`, and the clocks, which cannot be read.
    Switch,
    Clock,
    /// Modes, by group.
    Mode(u32),
    /// Modal addresses, by letter.
    Address(u8),
    Place(Place, usize),
    /// The offset of a system on an axis; 0 is the external one, above 100 those of G54.1.
    Offset(u32, usize),
    Unknown,
}

/// Which place of an axis is meant.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Place {
    Program,
    Machine,
    Present,
    Contact,
    ToolOffset,
}

/// Systems of G54.1 behind those of G54 to G59.
pub(super) const EXTENDED: u32 = 100;

fn axis_of(number: u32) -> Option<usize> {
    let index = usize::try_from(number).ok()?;
    (1..=9).contains(&index).then_some(index - 1)
}

/// True for the variables that all programs have in common.
pub(super) const fn is_common(number: u32) -> bool {
    matches!(number, 100..=199 | 500..=999)
}

/// What a variable is that is none of a tool's.
fn variable(number: u32) -> Variable {
    let place = |place, first: u32| {
        axis_of(number + 1 - first).map_or(Variable::Unknown, |axis| Variable::Place(place, axis))
    };
    let offset = |first: u32, system: u32| {
        let behind = number - first;
        axis_of(behind % PER_SYSTEM + 1).map_or(Variable::Unknown, |axis| {
            Variable::Offset(system + behind / PER_SYSTEM, axis)
        })
    };
    match number {
        0 => Variable::Nothing,
        1..=33 | 100..=199 | 500..=999 => Variable::Own,
        3000 => Variable::Alarm,
        3006 => Variable::Stop,
        3003 | 3004 => Variable::Switch,
        3001 | 3002 | 3011 | 3012 => Variable::Clock,
        4001..=4022 => Variable::Mode(number - 4000),
        4107 => Variable::Address(b'D'),
        4109 => Variable::Address(b'F'),
        4111 => Variable::Address(b'H'),
        4113 => Variable::Address(b'M'),
        4114 => Variable::Address(b'N'),
        4115 => Variable::Address(b'O'),
        4119 => Variable::Address(b'S'),
        4120 => Variable::Address(b'T'),
        4130 => Variable::Address(b'P'),
        // Those of the block that is executed: macros are read when it is the one before.
        4201..=4330 => variable(number - 200),
        5001..=5020 => place(Place::Program, 5001),
        5021..=5040 => place(Place::Machine, 5021),
        5041..=5060 => place(Place::Present, 5041),
        5061..=5080 => place(Place::Contact, 5061),
        5081..=5100 => place(Place::ToolOffset, 5081),
        5201..=5340 => offset(5201, 0),
        7001..=7960 if (number - 7001) / PER_SYSTEM < SYSTEMS_7001 => offset(7001, EXTENDED + 1),
        14_001..=20_000 if (number - 14_001) / PER_SYSTEM < SYSTEMS_14001 => {
            offset(14_001, EXTENDED + 1)
        }
        _ => Variable::Unknown,
    }
}

pub(super) const NO_VARIABLE: &str = "it is not known here what it is: variables are #1 to #33, #100 to #199, #500 to #999, and \
                           those of the system that the manual lists";
const OF_THE_MEMORY: &str = "what it is depends on how the control divides the memory of tool offsets: say it by \
                             `offset_memory` of [program] in the configuration";

impl ProgramScope<'_> {
    pub(super) fn variable(&self, number: u32) -> Variable {
        let options = &self.interpreter.options;
        let memory = options.fanuc.offset_memory;
        match tool_variable(number, memory, options.is_fanuc_lathe()) {
            Some((part, tool)) => Variable::Tool(part, tool),
            None => variable(number),
        }
    }

    /// Why a variable cannot be read, if it cannot.
    pub(crate) fn refused_variable(&self, number: u32) -> Option<&'static str> {
        match self.variable(number) {
            Variable::Clock => Some("what a program does must not depend on when it runs"),
            Variable::Unknown if is_of_tools(number) => Some(self.why_no_offset(number)),
            Variable::Unknown => Some(NO_VARIABLE),
            Variable::Mode(group) if self.interpreter.mode(group).is_none() => {
                Some("no mode of that group is known here")
            }
            Variable::Place(_, axis) | Variable::Offset(_, axis)
                if self.interpreter.numbered_axis(axis).is_none() =>
            {
                Some("the machine has no axis of that number")
            }
            _ => None,
        }
    }

    /// Why an offset of a tool is not known.
    pub(super) fn why_no_offset(&self, number: u32) -> &'static str {
        let options = &self.interpreter.options;
        let of_mill = !options.is_fanuc_lathe();
        if of_mill && options.fanuc.is_haas() && is_of_setting_40(number) {
            OF_SETTING_40
        } else {
            OF_THE_MEMORY
        }
    }

    /// What a variable reads.
    pub(crate) fn fanuc_variable(&self, number: u32) -> f64 {
        let interpreter = self.interpreter;
        let mm = interpreter.state.modal.units.mm();
        match self.variable(number) {
            Variable::Own => self.parameters.numbered(number),
            Variable::Tool(part, tool) => {
                let unit = if part == ToolPart::Direction { 1.0 } else { mm };
                interpreter.tool_part(part, tool) / unit
            }
            Variable::Switch => 0.0,
            Variable::Mode(group) => interpreter.mode(group).unwrap_or(VACANT),
            Variable::Address(letter) => interpreter.modal_address(letter),
            Variable::Place(place, axis) => interpreter.place(place, axis),
            Variable::Offset(system, axis) => {
                let axis = interpreter.numbered_axis(axis).map_or(0, Axis::index);
                interpreter.shown(interpreter.offset_of(system), axis)
            }
            Variable::Nothing
            | Variable::Alarm
            | Variable::Stop
            | Variable::Clock
            | Variable::Unknown => VACANT,
        }
    }
}

impl Interpreter {
    /// The axis of that index among those of the machine.
    pub(super) fn numbered_axis(&self, index: usize) -> Option<Axis> {
        let has = |axis: &Axis| self.options.machine.has(*axis);
        Axis::ALL.into_iter().filter(has).nth(index)
    }

    fn place(&self, place: Place, axis: usize) -> f64 {
        let axis = self.numbered_axis(axis).map_or(0, Axis::index);
        let program = || self.state.offsets.to_program(self.state.position);
        let is_of_tool = place == Place::ToolOffset;
        let place = match place {
            Place::Program => program(),
            Place::Machine => self.state.position,
            Place::Present => program() + self.state.offsets.tool,
            Place::Contact => self.state.probe.contact + self.state.offsets.tool,
            Place::ToolOffset => self.state.offsets.tool,
        };
        let value = self.shown(place, axis);
        match Axis::ALL.get(axis) {
            Some(of_turn) if !is_of_tool => self.within_a_turn(*of_turn, value),
            _ => value,
        }
    }

    /// A place on an axis as the program writes it: in its units, X of a lathe as a diameter.
    fn shown(&self, place: AxisVector, axis: usize) -> f64 {
        let share = if self.state.modal.diameter && axis == Axis::X.index() {
            2.0
        } else {
            1.0
        };
        share * in_units(self, place, axis)
    }

    /// The offset of a system, machine coordinates.
    fn offset_of(&self, system: u32) -> AxisVector {
        let fanuc = &self.state.offsets.fanuc;
        let index = usize::try_from(system).unwrap_or(usize::MAX);
        match index.checked_sub(1) {
            None => fanuc.external,
            Some(index) if system <= EXTENDED => self
                .state
                .offsets
                .systems
                .get(index)
                .map_or_else(AxisVector::zeros, |system| system.origin),
            Some(_) => fanuc
                .extended
                .get(&(system - EXTENDED))
                .map_or_else(AxisVector::zeros, |system| system.origin),
        }
    }

    /// The value of a modal address.
    fn modal_address(&self, letter: u8) -> f64 {
        let (state, modal) = (&self.state, &self.state.modal);
        match letter {
            b'D' => f64::from(state.fanuc.radius_offset),
            b'F' => {
                let feed = modal.feed.map(|feed| match modal.feed_mode {
                    FeedMode::PerRevolution => feed.linear_v,
                    _ => 60.0 * feed.linear_v,
                });
                let in_force = feed.or(state.fanuc.lead_mm).unwrap_or(0.0);
                round(in_force / modal.units.mm())
            }
            b'H' => f64::from(state.fanuc.length_offset.unwrap_or(0)),
            b'M' => f64::from(state.fanuc.m_code),
            b'N' => f64::from(state.fanuc.sequence),
            b'O' => f64::from(state.fanuc.program),
            b'S' => state.spindle.speed,
            // With its offset on a lathe, as it is written.
            b'T' if self.options.is_fanuc_lathe() => {
                f64::from(100 * state.selected_tool + state.fanuc.length_offset.unwrap_or_default())
            }
            b'T' => f64::from(state.selected_tool),
            _ => f64::from(self.state.offsets.fanuc.active.unwrap_or(0)),
        }
    }
}

/// A feed as it was written, without what conversion left.
fn round(value: f64) -> f64 {
    (value * 1e9).round() * 1e-9
}
