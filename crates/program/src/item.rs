//! The items of a program, which a planner is fed in program order: segments, dwells and events.

use glidepath_geometry::Segment;
use serde::{Deserialize, Serialize};

/// The rate of a segment: how its speed is given.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Rate {
    /// As fast as the axes allow (G0).
    Rapid,
    /// Feedrate: the rate of path position, mm/s (°/s for a move of rotary axes alone), > 0.
    Feed(f64),
    /// As [`Rate::Rapid`], but never above a speed, > 0, that no override lifts: that of joints,
    /// where they are not axes.
    RapidUpTo(f64),
    /// As [`Rate::Feed`] with `feed_v`, but never above `most_v`, > 0, that no override lifts.
    FeedUpTo {
        /// Feedrate.
        feed_v: f64,
        /// The speed that is not exceeded.
        most_v: f64,
    },
    /// As [`Rate::FeedUpTo`], of a feed per revolution: `feed_v` is that at the speed that the spindle
    /// was told, and the motion goes on more slowly where it turns more slowly than that.
    PerRevolution {
        /// Feedrate at the speed that the spindle was told.
        feed_v: f64,
        /// The speed that is not exceeded; infinite where there is none.
        most_v: f64,
    },
    /// This rate of path position, mm/s, > 0, neither more nor less: the move follows the spindle
    /// ([`Event::Synchronise`]), and is planned for the highest speed that the spindle may have. No
    /// override changes it.
    Synchronised(f64),
}

impl Rate {
    /// True for a rapid, up to a speed or not.
    #[must_use]
    pub const fn is_rapid(self) -> bool {
        matches!(self, Self::Rapid | Self::RapidUpTo(_))
    }

    /// The programmed feedrate; `None` for a rapid.
    #[must_use]
    pub const fn feed_v(self) -> Option<f64> {
        match self {
            Self::Rapid | Self::RapidUpTo(_) => None,
            Self::Feed(feed_v)
            | Self::FeedUpTo { feed_v, .. }
            | Self::PerRevolution { feed_v, .. }
            | Self::Synchronised(feed_v) => Some(feed_v),
        }
    }

    /// The speed that no override lifts, infinite where there is none.
    #[must_use]
    pub const fn most_v(self) -> f64 {
        match self {
            Self::Rapid | Self::Feed(_) | Self::Synchronised(_) => f64::INFINITY,
            Self::RapidUpTo(most_v)
            | Self::FeedUpTo { most_v, .. }
            | Self::PerRevolution { most_v, .. } => most_v,
        }
    }

    /// True for a move that follows the spindle.
    #[must_use]
    pub const fn is_synchronised(self) -> bool {
        matches!(self, Self::Synchronised(_))
    }

    /// True for a move at a feed per revolution of a spindle whose speed is measured.
    #[must_use]
    pub const fn is_per_revolution(self) -> bool {
        matches!(self, Self::PerRevolution { .. })
    }

    /// The same rate, never above a speed. One that follows the spindle stays: slower, it would be
    /// another thread.
    #[must_use]
    pub const fn up_to(self, most_v: f64) -> Self {
        match self {
            Self::Rapid | Self::RapidUpTo(_) => Self::RapidUpTo(most_v),
            Self::Feed(feed_v) | Self::FeedUpTo { feed_v, .. } => Self::FeedUpTo { feed_v, most_v },
            Self::PerRevolution { feed_v, .. } => Self::PerRevolution { feed_v, most_v },
            Self::Synchronised(_) => self,
        }
    }
}

/// The path mode at the corner at the *end* of a segment (G61, G61.1, G64).
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum PathMode {
    /// Comes to rest at the corner (G61.1).
    ExactStop,
    /// Passes exactly through the corner; rests there unless the path goes straight on (G61).
    ExactPath,
    /// May leave the programmed path by a tolerance (G64).
    Continuous {
        /// Tolerance in mm for everything together: smoothing and chord error. `None` means the
        /// configured tolerance.
        tolerance_mm: Option<f64>,
    },
}

/// Steps of the phase of a thread in a revolution: fine enough to be exact to a nanometre, and few
/// enough for the number that an event has.
pub const PHASE_STEPS: u32 = 1 << 24;

/// Depths that a hole may have, µm: a metre, about.
pub const TAP_DEPTHS_UM: u32 = 1 << 20;

/// Revolutions for which a tap goes on at most from where the spindle is told to turn back, unless the
/// machine says otherwise: as many as `LinuxCNC`'s G33.1 allows.
pub const TAP_OVERTRAVEL: f64 = 10.0;

/// An event, which happens in order with the motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Event {
    /// Spindle speed (S), rev/min. Does not stop the motion.
    SpindleSpeed(f64),
    /// The angle at which the spindle is to stand from the next M19 on. Does not stop the motion.
    SpindleAngle {
        /// The angle, degrees from 0 to 360, rising as M3 turns.
        deg: f64,
        /// The way there.
        way: OrientWay,
    },
    /// The gear that the spindle is to have, 1 to 5. Its M code (M41 to M45) comes next.
    SpindleGear(u32),
    /// Tool selection (T). Does not stop the motion.
    SelectTool(u32),
    /// An M code other than the program stops. The machine is at rest when it happens.
    MCode(u32),
    /// An M code that needs no rest (M7 to M9, M48, M49) of a machine that does not wait for it.
    /// Does not stop the motion.
    PassingCode(u32),
    /// M0 or M60: the machine rests until the operator resumes.
    ProgramStop(u32),
    /// M1: like [`Event::ProgramStop`] if the operator asked for optional stops.
    OptionalStop,
    /// What follows, up to the end of the epoch, looks for a contact (G38.2 to G38.5), and comes to
    /// rest where it is made. The machine is at rest when it begins.
    Probe {
        /// It looks for the end of a contact instead.
        release: bool,
    },
    /// The moves that follow, up to the next rest, follow the spindle: a pass of a thread (G33). The
    /// machine is at rest when it begins, and waits for the spindle to be at speed and at its angle.
    Synchronise {
        /// How far the path goes with each revolution, mm, > 0.
        pitch_mm: f64,
        /// The angle at which the pass would begin if it were at its speed at once, in
        /// [`PHASE_STEPS`] of a revolution behind the index.
        phase: u32,
    },
    /// A word of the M code that comes next, which the machine's builder gave a meaning. The machine
    /// is at rest.
    CodeWord {
        /// The word.
        word: CodeWord,
        /// Its number.
        value: f64,
    },
    /// The motion does not go on before an M code that was told before is answered, if it is one that
    /// the machine waits for later than where it stands. The machine is at rest.
    Await(u32),
    /// An axis goes into a hole behind the spindle, and comes out of it when the spindle turns back
    /// (G33.1). The machine is at rest when it begins, and afterwards where it was.
    Tap {
        /// Index of the axis.
        axis: u32,
        /// How far it goes with each revolution, mm; below 0 if it goes to lower positions.
        pitch_mm: f64,
        /// Where the spindle is told to turn back, µm into the hole, below [`TAP_DEPTHS_UM`].
        depth_um: u32,
    },
    /// A digital output. Does not stop the motion.
    DigitalOutput {
        /// Its number, below 2²⁴.
        number: u32,
        /// On or off.
        on: bool,
    },
    /// An analog output. Does not stop the motion.
    AnalogOutput {
        /// Its number, below 2²⁴.
        number: u32,
        /// Its value, in the output's unit.
        value: f64,
    },
}

impl Event {
    /// True if the machine rests while it happens.
    #[must_use]
    pub const fn is_at_rest(&self) -> bool {
        match self {
            Self::SpindleSpeed(_)
            | Self::SpindleAngle { .. }
            | Self::SelectTool(_)
            | Self::PassingCode(_)
            | Self::DigitalOutput { .. }
            | Self::AnalogOutput { .. } => false,
            Self::MCode(_)
            | Self::SpindleGear(_)
            | Self::ProgramStop(_)
            | Self::OptionalStop
            | Self::Probe { .. }
            | Self::Synchronise { .. }
            | Self::CodeWord { .. }
            | Self::Await(_)
            | Self::Tap { .. } => true,
        }
    }
}

/// The way of a spindle to an angle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum OrientWay {
    /// The shorter one.
    Shortest,
    /// As M3 turns.
    Clockwise,
    /// As M4 turns.
    Counterclockwise,
}

/// A word of an M code.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CodeWord {
    /// P.
    P,
    /// Q.
    Q,
}

/// A line of a program at one of the times it is executed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct ProgramLine {
    /// Number of the line in the source, from 1; 0 before the first.
    pub number: u32,
    /// As [`Item::block`].
    pub block: u32,
}

impl ProgramLine {
    /// Before the first line.
    pub const NONE: Self = Self {
        number: 0,
        block: 0,
    };

    /// Something to do there.
    #[must_use]
    pub const fn item(self, kind: ItemKind) -> Item {
        Item {
            line: self.number,
            block: self.block,
            kind,
        }
    }
}

/// An item of a program: one thing to do, and where the program says so.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Item {
    /// Source line, from 1.
    pub line: u32,
    /// Which of the items of its program it is, from 1; 0 where nobody counts them. A line in a
    /// loop is executed many times, so the line alone does not say where a program is.
    pub block: u32,
    /// What to do.
    pub kind: ItemKind,
}

impl Item {
    /// The line it comes from, at the time that it was executed.
    #[must_use]
    pub const fn program_line(&self) -> ProgramLine {
        ProgramLine {
            number: self.line,
            block: self.block,
        }
    }
}

/// The kinds of [`Item`].
#[allow(clippy::large_enum_variant, reason = "nearly every item is a move")]
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ItemKind {
    /// Move along a segment. It starts where the segment before it ended.
    Move {
        /// The curve.
        segment: Segment,
        /// Its speed.
        rate: Rate,
        /// How the path leaves it.
        mode: PathMode,
    },
    /// Rest for a time in seconds, ≥ 0 (G4).
    Dwell(f64),
    /// An event.
    Event(Event),
}

impl PathMode {
    /// The tolerance in force, mm: that of the mode, or the configured one where it gives none.
    #[inline]
    #[must_use]
    pub fn tolerance_mm(self, configured_mm: f64) -> f64 {
        match self {
            Self::Continuous {
                tolerance_mm: Some(tolerance_mm),
            } => tolerance_mm,
            _ => configured_mm,
        }
    }
}
