//! The record of spindle, coolant, tool and outputs, from the interpolator to whatever works them:
//! what they are to do now.

use super::check::{Fields, RecordError};
use super::code::coded;
use super::{CodeWords, EventId, MOST_GEARS, Record, event};
use glidepath_program::{Event, OrientWay};
use iceoryx2::prelude::ZeroCopySend;

/// Analog outputs, as many as there are numbers for them in programs.
pub const ANALOG_OUTPUTS: usize = 64;

coded! {
    /// The commanded state of the spindle.
    pub enum SpindleState {
        /// Stand (M5), or nothing was said since the interpolator began.
        Stopped = 0,
        /// Turn clockwise (M3).
        Clockwise = 1,
        /// Turn counterclockwise (M4).
        Counterclockwise = 2,
        /// Stand at a known angle (M19).
        Oriented = 3,
    }
}

coded! {
    /// The way of the spindle to the angle at which it is to stand (M19).
    pub enum OrientTurn {
        /// No angle was given: it is the spindle's own.
        Own = 0,
        /// The shorter one.
        Shortest = 1,
        /// Clockwise.
        Clockwise = 2,
        /// Counterclockwise.
        Counterclockwise = 3,
    }
}

impl From<OrientWay> for OrientTurn {
    fn from(way: OrientWay) -> Self {
        match way {
            OrientWay::Shortest => Self::Shortest,
            OrientWay::Clockwise => Self::Clockwise,
            OrientWay::Counterclockwise => Self::Counterclockwise,
        }
    }
}

/// The coolants that are to be on, one bit each.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Coolant(pub u32);

impl Coolant {
    /// Mist (M7).
    pub const MIST: Self = Self(1);
    /// Flood (M8).
    pub const FLOOD: Self = Self(1 << 1);

    const KNOWN: u32 = (1 << 2) - 1;

    /// True if all of `other` are on.
    #[must_use]
    pub const fn contains(self, other: Self) -> bool {
        self.0 & other.0 == other.0
    }
}

/// The commanded state of spindle, coolant, tools and outputs: all that the events of setpoints
/// have come to since the interpolator began.
///
/// Events are edges, and whoever comes late, or loses one, obeys this instead: it is latched, and a
/// subscriber gets the last one at once.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable, ZeroCopySend)]
#[type_name("glidepath.Auxiliary.v4")]
pub struct Auxiliary {
    /// Identifies one life of the interpolator.
    pub boot_id: u64,
    /// Counts the changes of this record in this life.
    pub generation: u64,
    /// Epoch of the last event, 0 before the first.
    pub epoch: u64,
    /// Sequence of its frame.
    pub sequence: u64,
    /// The event that is awaited; means something if `awaited_since_ns` does.
    pub awaited: EventId,
    /// Since when it is awaited, ns of `CLOCK_MONOTONIC`; 0 if nothing is.
    pub awaited_since_ns: u64,
    /// When waiting becomes a fault, ns of `CLOCK_MONOTONIC`; 0 if never.
    pub awaited_until_ns: u64,
    /// The number of the event that is awaited, as in a setpoint.
    pub awaited_value: f64,
    /// The code of the event that is awaited, as in a setpoint; 0 if nothing is.
    pub awaited_kind: u32,
    /// Source line of the last event.
    pub line: u32,
    /// The words of the event that is awaited: those of [`CodeWords`] that it has.
    pub awaited_words: CodeWords,
    /// Speed that the spindle is to have when it turns, rev/min, as the program gave it: times
    /// `spindle_override`.
    pub spindle_speed: f64,
    /// Code of a [`SpindleState`].
    pub spindle: u32,
    /// Bits of [`Coolant`].
    pub coolant: u32,
    /// The tool that M6 put into the spindle last, 0 for none or if nothing was said yet. Where the motion
    /// ended before that M6 was answered, it is the one before again.
    pub tool: u32,
    /// The tool that was selected last.
    pub prepared_tool: u32,
    /// Digital outputs, one bit each.
    pub digital_out: u64,
    /// Analog outputs, in whatever unit they have.
    pub analog_out: [f64; ANALOG_OUTPUTS],
    /// The angle at which the spindle is to stand where it is to stand at one, degrees from 0 to 360,
    /// rising as it turns clockwise; means something if `spindle_turn` says so.
    pub spindle_angle: f64,
    /// What the operator makes of its speed, a ratio; 1 while `spindle_override_locked` says so.
    pub spindle_override: f64,
    /// Code of an [`OrientTurn`]: whether a program gave that angle, and the way there.
    pub spindle_turn: u32,
    /// 1 while a program keeps the override of the spindle from the operator (M49), else 0.
    pub spindle_override_locked: u32,
    /// The gear that the spindle is to have, 1 to 5; 0 if nothing was said of it, and the one that is in stays.
    pub spindle_gear: u32,
    /// Must be zero.
    pub reserved: u32,
}

impl Auxiliary {
    /// The commanded state of the spindle.
    ///
    /// # Errors
    ///
    /// An unknown code.
    pub fn spindle(&self) -> Result<SpindleState, RecordError> {
        Fields(Self::NAME).code("spindle", self.spindle)
    }

    /// The speed that the spindle is to have when it turns, with its override, rev/min.
    #[must_use]
    pub fn spindle_rpm(&self) -> f64 {
        self.spindle_speed * self.spindle_override
    }

    /// Whether a program keeps the override of the spindle from the operator (M49).
    #[must_use]
    pub const fn is_spindle_override_locked(&self) -> bool {
        self.spindle_override_locked != 0
    }

    /// The angle at which the spindle is to stand, degrees, and the way there; `None` where it is to
    /// stand at none, or at its own.
    #[must_use]
    pub fn orientation(&self) -> Option<(f64, OrientWay)> {
        if self.spindle != SpindleState::Oriented.code() {
            return None;
        }
        let turn = Fields(Self::NAME).code("spindle_turn", self.spindle_turn);
        let way = match turn.ok()? {
            OrientTurn::Own => return None,
            OrientTurn::Shortest => OrientWay::Shortest,
            OrientTurn::Clockwise => OrientWay::Clockwise,
            OrientTurn::Counterclockwise => OrientWay::Counterclockwise,
        };
        Some((self.spindle_angle, way))
    }

    /// The coolants that are to be on.
    #[must_use]
    pub const fn coolant(&self) -> Coolant {
        Coolant(self.coolant)
    }

    /// The event that is awaited, if one is.
    ///
    /// # Errors
    ///
    /// An unknown code, or a number that does not fit it.
    pub fn awaited_event(&self) -> Result<Option<Event>, RecordError> {
        event::decode(Self::NAME, self.awaited_kind, self.awaited_value)
    }

    /// Takes an event up. Returns whether it changed anything.
    pub fn take(&mut self, event: Event) -> bool {
        let before = *self;
        match event {
            Event::SpindleSpeed(speed) => self.spindle_speed = speed,
            Event::SpindleAngle { deg, way } => {
                self.spindle_angle = deg;
                self.spindle_turn = OrientTurn::from(way).code();
            }
            Event::SpindleGear(gear) => self.spindle_gear = gear,
            Event::SelectTool(tool) => self.prepared_tool = tool,
            Event::MCode(code) | Event::PassingCode(code) => self.take_m_code(code),
            Event::DigitalOutput { number, on } => {
                let bit = 1_u64.checked_shl(number).unwrap_or(0);
                self.digital_out &= !bit;
                self.digital_out |= if on { bit } else { 0 };
            }
            Event::AnalogOutput { number, value } => {
                let output = usize::try_from(number).ok();
                if let Some(output) = output.and_then(|n| self.analog_out.get_mut(n)) {
                    *output = value;
                }
            }
            Event::ProgramStop(_)
            | Event::OptionalStop
            | Event::Probe { .. }
            | Event::Synchronise { .. }
            | Event::CodeWord { .. }
            | Event::Await(_)
            | Event::Tap { .. } => {}
        }
        *self != before
    }

    const fn take_m_code(&mut self, code: u32) {
        match code {
            3 => self.spindle = SpindleState::Clockwise.code(),
            4 => self.spindle = SpindleState::Counterclockwise.code(),
            5 => self.spindle = SpindleState::Stopped.code(),
            19 => self.spindle = SpindleState::Oriented.code(),
            // Tools are changed with the spindle at rest; one that stands at an angle is held there.
            6 => {
                self.tool = self.prepared_tool;
                if self.spindle != SpindleState::Oriented.code() {
                    self.spindle = SpindleState::Stopped.code();
                }
            }
            7 => self.coolant |= Coolant::MIST.0,
            8 => self.coolant |= Coolant::FLOOD.0,
            9 => self.coolant = 0,
            _ => {}
        }
    }
}

impl Default for Auxiliary {
    /// As nothing was said yet.
    fn default() -> Self {
        Self {
            spindle_override: 1.0,
            ..bytemuck::Zeroable::zeroed()
        }
    }
}

impl Record for Auxiliary {
    const NAME: &'static str = "glidepath.Auxiliary.v4";

    fn check(&self) -> Result<(), RecordError> {
        let fields = Fields(Self::NAME);
        self.spindle()?;
        fields.flags("coolant", self.coolant, Coolant::KNOWN)?;
        fields.finite("spindle_speed", self.spindle_speed)?;
        fields.override_ratio("spindle_override", self.spindle_override)?;
        fields.range("spindle_angle", self.spindle_angle, 0.0, 360.0)?;
        fields.code::<OrientTurn>("spindle_turn", self.spindle_turn)?;
        fields.flags("spindle_override_locked", self.spindle_override_locked, 1)?;
        let most = f64::from(MOST_GEARS);
        fields.range("spindle_gear", self.spindle_gear.into(), 0.0, most)?;
        fields.zero("reserved", self.reserved)?;
        self.awaited_words.check(Self::NAME)?;
        fields.all_finite("analog_out", &self.analog_out)?;
        self.awaited_event().map(|_| ())
    }
}
