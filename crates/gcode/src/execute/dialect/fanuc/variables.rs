//! FANUC's variables: which there are, what they read, and what an assignment does.
//!
//! | | |
//! |---|---|
//! | `#0` | nothing; so is in every variable that nothing was assigned to |
//! | `#1` … `#33` | local to a macro |
//! | `#100` … `#199`, `#500` … `#999` | common |
//! | `#2001` … `#2800` | tool offsets, where the configuration says how their memory is divided |
//! | `#3000=n(TEXT)`, `#3006=n(TEXT)` | an alarm, a stop |
//! | `#4001` … `#4022`, `#4107` `#4109` `#4111` `#4119` `#4120` `#4130` | modes; D F H S T, P of G54.1 |
//! | `#5001` `#5021` `#5041` `#5061` `#5081` … | place in the program, of the machine, with the length of the tool; the same of a contact; length of the tool |
//! | `#5201` …, `#5221` … `#5328`, `#7001` …, `#14001` … | external offset, G54 to G59, G54.1 P1 and on |
//!
//! Axes are counted in the order of the machine's: X, Y, Z, then A, B, C.

use glidepath_geometry::{Axis, AxisVector, Plane};
use glidepath_program::PathMode;

use crate::execute::interpreter::Interpreter;
use crate::execute::scope::{ProgramScope, coordinate, in_units};
use crate::execute::state::modal::Modal;
use crate::setup::fanuc::OffsetMemory;
use crate::syntax::expression::vacant::VACANT;
use crate::syntax::modes::{CannedCycle, Distance, FeedMode, Motion, Retract, Side, Units};

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

/// A part of a tool's offsets.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum ToolPart {
    Length,
    LengthWear,
    /// Length with its wear: memory A.
    LengthAll,
    Radius,
    RadiusWear,
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

/// What a variable is; `memory` is how that of tool offsets is divided.
fn variable(number: u32, memory: OffsetMemory) -> Variable {
    use ToolPart::{Length, LengthAll, LengthWear, Radius, RadiusWear};
    let place = |place, first: u32| {
        axis_of(number + 1 - first).map_or(Variable::Unknown, |axis| Variable::Place(place, axis))
    };
    let offset = |first: u32, system: u32| {
        let behind = number - first;
        axis_of(behind % PER_SYSTEM + 1).map_or(Variable::Unknown, |axis| {
            Variable::Offset(system + behind / PER_SYSTEM, axis)
        })
    };
    match (number, memory) {
        (0, _) => Variable::Nothing,
        (1..=33 | 100..=199 | 500..=999, _) => Variable::Own,
        (2001..=2200, OffsetMemory::A) => Variable::Tool(LengthAll, number - 2000),
        (2001..=2200, OffsetMemory::C) => Variable::Tool(LengthWear, number - 2000),
        (2201..=2400, OffsetMemory::C) => Variable::Tool(Length, number - 2200),
        (2001..=2200, OffsetMemory::Haas) => Variable::Tool(Length, number - 2000),
        (2201..=2400, OffsetMemory::Haas) => Variable::Tool(LengthWear, number - 2200),
        (2401..=2600, OffsetMemory::Haas) => Variable::Tool(Radius, number - 2400),
        (2601..=2800, OffsetMemory::Haas) => Variable::Tool(RadiusWear, number - 2600),
        (10_001..=10_999, OffsetMemory::C) => Variable::Tool(LengthWear, number - 10_000),
        (11_001..=11_999, OffsetMemory::C) => Variable::Tool(Length, number - 11_000),
        (12_001..=12_999, OffsetMemory::C) => Variable::Tool(RadiusWear, number - 12_000),
        (13_001..=13_999, OffsetMemory::C) => Variable::Tool(Radius, number - 13_000),
        (3000, _) => Variable::Alarm,
        (3006, _) => Variable::Stop,
        (3003 | 3004, _) => Variable::Switch,
        (3001 | 3002 | 3011 | 3012, _) => Variable::Clock,
        (4001..=4022, _) => Variable::Mode(number - 4000),
        (4107, _) => Variable::Address(b'D'),
        (4109, _) => Variable::Address(b'F'),
        (4111, _) => Variable::Address(b'H'),
        (4119, _) => Variable::Address(b'S'),
        (4120, _) => Variable::Address(b'T'),
        (4130, _) => Variable::Address(b'P'),
        (5001..=5020, _) => place(Place::Program, 5001),
        (5021..=5040, _) => place(Place::Machine, 5021),
        (5041..=5060, _) => place(Place::Present, 5041),
        (5061..=5080, _) => place(Place::Contact, 5061),
        (5081..=5100, _) => place(Place::ToolOffset, 5081),
        (5201..=5340, _) => offset(5201, 0),
        (7001..=7960, _) if (number - 7001) / PER_SYSTEM < SYSTEMS_7001 => {
            offset(7001, EXTENDED + 1)
        }
        (14_001..=20_000, _) if (number - 14_001) / PER_SYSTEM < SYSTEMS_14001 => {
            offset(14_001, EXTENDED + 1)
        }
        _ => Variable::Unknown,
    }
}

pub(super) const NO_VARIABLE: &str = "it is not known here what it is: variables are #1 to #33, #100 to #199, #500 to #999, and \
                           those of the system that the manual lists";
pub(super) const OF_THE_MEMORY: &str = "what it is depends on how the control divides the memory of tool offsets: say it by \
                             `offset_memory` of [program] in the configuration";

impl ProgramScope<'_> {
    pub(super) fn variable(&self, number: u32) -> Variable {
        variable(number, self.interpreter.options.fanuc.offset_memory)
    }

    /// Why a variable cannot be read, if it cannot.
    pub(crate) fn refused_variable(&self, number: u32) -> Option<&'static str> {
        match self.variable(number) {
            Variable::Clock => Some("what a program does must not depend on when it runs"),
            Variable::Unknown if matches!(number, 2001..=2800 | 10_001..=13_999) => {
                Some(OF_THE_MEMORY)
            }
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

    /// What a variable reads.
    pub(crate) fn fanuc_variable(&self, number: u32) -> f64 {
        let interpreter = self.interpreter;
        let mm = interpreter.state.modal.units.mm();
        match self.variable(number) {
            Variable::Own => self.parameters.numbered(number),
            Variable::Tool(part, tool) => interpreter.tool_part(part, tool) / mm,
            Variable::Switch => 0.0,
            Variable::Mode(group) => interpreter.mode(group).unwrap_or(VACANT),
            Variable::Address(letter) => interpreter.modal_address(letter),
            Variable::Place(place, axis) => interpreter.place(place, axis),
            Variable::Offset(system, axis) => {
                let axis = interpreter.numbered_axis(axis).map_or(0, Axis::index);
                in_units(interpreter, interpreter.offset_of(system), axis)
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
        let tool = in_units(self, self.offsets.tool, axis);
        match place {
            Place::Program => coordinate(self, axis),
            Place::Machine => in_units(self, self.state.position, axis),
            Place::Present => coordinate(self, axis) + tool,
            Place::Contact => in_units(self, self.state.probe.contact, axis) + tool,
            Place::ToolOffset => tool,
        }
    }

    /// The offset of a system, machine coordinates.
    fn offset_of(&self, system: u32) -> AxisVector {
        let fanuc = &self.offsets.fanuc;
        let index = usize::try_from(system).unwrap_or(usize::MAX);
        match index.checked_sub(1) {
            None => fanuc.external,
            Some(index) if system <= EXTENDED => self
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

    fn tool_part(&self, part: ToolPart, number: u32) -> f64 {
        let tool = self.tools.as_ref().and_then(|tools| tools.get(number));
        let tool = tool.copied().unwrap_or_default();
        let wear = self.offsets.fanuc.wear(number);
        match part {
            ToolPart::Length => tool.offset[2],
            ToolPart::LengthWear => wear.length_mm,
            ToolPart::LengthAll => tool.offset[2] + wear.length_mm,
            ToolPart::Radius => 0.5 * tool.diameter_mm,
            ToolPart::RadiusWear => wear.radius_mm,
        }
    }

    /// The value of a modal address.
    fn modal_address(&self, letter: u8) -> f64 {
        let (state, modal) = (&self.state, &self.state.modal);
        match letter {
            b'D' => f64::from(state.fanuc.radius_offset),
            b'F' => modal.feed.map_or(0.0, |feed| {
                let per = match modal.feed_mode {
                    FeedMode::PerRevolution => 1.0,
                    _ => 60.0,
                };
                round(feed.linear_v * per / modal.units.mm())
            }),
            b'H' => f64::from(state.fanuc.length_offset.unwrap_or(0)),
            b'S' => state.spindle.speed,
            b'T' => f64::from(state.selected_tool),
            _ => f64::from(self.offsets.fanuc.active.unwrap_or(0)),
        }
    }

    /// The number of the code in force in a modal group.
    fn mode(&self, group: u32) -> Option<f64> {
        let modal = &self.state.modal;
        let frames = &self.offsets.fanuc.frames;
        let one_of = |first: bool, yes: f64, no: f64| if first { yes } else { no };
        Some(match group {
            1 => motion_code(match modal.motion {
                Some(Motion::Cycle(_)) | None => self.state.fanuc.before_cycles,
                Some(motion) => motion,
            }),
            2 => match modal.plane {
                Plane::Zx | Plane::Wu => 18.0,
                Plane::Yz | Plane::Vw => 19.0,
                Plane::Xy | Plane::Uv => 17.0,
            },
            3 => one_of(modal.distance == Distance::Absolute, 90.0, 91.0),
            4 => 23.0,
            5 => match modal.feed_mode {
                FeedMode::InverseTime => 93.0,
                FeedMode::PerMinute => 94.0,
                FeedMode::PerRevolution => 95.0,
            },
            6 => one_of(modal.units == Units::Inch, 20.0, 21.0),
            7 if !self.state.on_contour => 40.0,
            7 => match self.state.contour_side {
                Side::Left => 41.0,
                Side::Right => 42.0,
            },
            8 => match self.state.fanuc.length_sign {
                None => 49.0,
                Some(sign) => one_of(sign < 0.0, 44.0, 43.0),
            },
            9 => cycle_code(modal),
            10 => one_of(modal.retract == Retract::Initial, 98.0, 99.0),
            11 => one_of(frames.scale.is_some(), 51.0, 50.0),
            12 => one_of(self.state.fanuc.calls_macro, 66.0, 67.0),
            13 => one_of(self.state.spindle.surface.is_some(), 96.0, 97.0),
            14 => match self.offsets.fanuc.active {
                Some(_) => 54.1,
                None => f64::from(u8::try_from(self.offsets.active).unwrap_or(0)) + 54.0,
            },
            15 => match modal.path_mode {
                PathMode::Continuous { .. } => 64.0,
                _ => 61.0,
            },
            16 => one_of(frames.turn.is_some(), 68.0, 69.0),
            17 => one_of(self.state.fanuc.polar.is_some(), 16.0, 15.0),
            22 => one_of(frames.mirror.iter().any(Option::is_some), 51.1, 50.1),
            _ => return None,
        })
    }
}

/// A feed as it was written, without what conversion left.
fn round(value: f64) -> f64 {
    (value * 1e9).round() * 1e-9
}

const fn motion_code(motion: Motion) -> f64 {
    match motion {
        Motion::Linear => 1.0,
        Motion::ArcClockwise => 2.0,
        Motion::ArcCounterclockwise => 3.0,
        Motion::Thread => 33.0,
        _ => 0.0,
    }
}

const fn cycle_code(modal: &Modal) -> f64 {
    match modal.motion {
        Some(Motion::Cycle(cycle)) => match cycle {
            CannedCycle::ChipBreak => 73.0,
            CannedCycle::TapLeft => 74.0,
            CannedCycle::FineBore => 76.0,
            CannedCycle::Drill => 81.0,
            CannedCycle::DrillDwell => 82.0,
            CannedCycle::Peck => 83.0,
            CannedCycle::TapRight => 84.0,
            CannedCycle::Bore => 85.0,
            CannedCycle::BoreStop => 86.0,
            CannedCycle::BoreDwell => 89.0,
        },
        _ => 80.0,
    }
}
