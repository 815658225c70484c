//! The codes in records: names and numbers.

use super::own::{Stopped, TooMuch};
use crate::failure::Code;
use glidepath_link::{
    CommandKind, CommandRefusal, ContactKind, DriveState, EndOfEpoch, EventKind, FaultCause,
    FreezeReason, Grants, JobStage, JogMode, LatchKind, Loss, MachineState, ModeCode, MotionMode,
    PlaneCode, Power, RequestKind, SegmentRefusal, SetpointMarks, SpindleFlags, SuperpositionState,
};
use glidepath_program::FrameFlags;

/// Names that belong together, with their numbers.
#[derive(Debug)]
pub(super) struct Codes {
    /// What all names begin with, after `GP_`.
    pub(super) prefix: &'static str,
    pub(super) about: &'static str,
    /// Whether they are bits, of which several may be set.
    pub(super) are_bits: bool,
    pub(super) values: Vec<(String, i64)>,
}

/// `NotReady` as `NOT_READY`, `Frame(NotFinite)` as `FRAME_NOT_FINITE`.
fn in_c(name: &str) -> String {
    let mut text = String::new();
    for letter in name.chars().filter(|letter| *letter != ')') {
        match letter {
            '(' => {}
            _ if letter.is_ascii_uppercase() && !text.is_empty() => text.extend(['_', letter]),
            _ => text.push(letter.to_ascii_uppercase()),
        }
    }
    text
}

macro_rules! all {
    ($prefix:literal, $about:literal, $type:ty) => {
        Codes {
            prefix: $prefix,
            about: $about,
            are_bits: false,
            values: <$type>::ALL
                .iter()
                .map(|value| (in_c(&format!("{value:?}")), value.code().into()))
                .collect(),
        }
    };
}

fn bits(prefix: &'static str, about: &'static str, values: &[(&str, u32)]) -> Codes {
    Codes {
        prefix,
        about,
        are_bits: true,
        values: values
            .iter()
            .map(|(name, bit)| ((*name).to_owned(), i64::from(*bit)))
            .collect(),
    }
}

fn faults() -> Codes {
    let known = (1..0x200).filter_map(|code| Some((FaultCause::from_code(code)?, code)));
    let named = known.map(|(cause, code)| (in_c(&format!("{cause:?}")), i64::from(code)));
    Codes {
        prefix: "FAULT",
        about: "Why the interpolator stopped by itself.",
        are_bits: false,
        values: core::iter::once(("NONE".to_owned(), 0))
            .chain(named)
            .collect(),
    }
}

/// An enumeration of the library's own.
macro_rules! own {
    ($prefix:literal, $about:literal, $type:ident: $($value:ident),+) => {
        Codes {
            prefix: $prefix,
            about: $about,
            are_bits: false,
            values: vec![$((in_c(stringify!($value)), i64::from($type::$value as i32))),+],
        }
    };
}

/// What moves the machine.
fn of_demands() -> Vec<Codes> {
    vec![
        all!("JOG_MODE", "How a jog moves the machine.", JogMode),
        all!("SEGMENT", "What a piece of a stream is.", RequestKind),
        all!(
            "PATH",
            "How the path is followed at corners: G61.1, G61, G64, G64 P.",
            ModeCode
        ),
        all!(
            "PLANE",
            "Planes of arcs: G17, G18, G19, G17.1, G18.1, G19.1.",
            PlaneCode
        ),
        all!(
            "SEGMENT_REFUSAL",
            "Why a piece of a stream was refused.",
            SegmentRefusal
        ),
    ]
}

/// What is in feedback alone.
fn of_feedback() -> Vec<Codes> {
    vec![
        all!("LOSS", "What a servo stack has lost.", Loss),
        all!("LATCH", "How a latched position was found.", LatchKind),
    ]
}

fn of_servos() -> Vec<Codes> {
    vec![
        bits(
            "SPINDLE",
            "What the spindle does.",
            &[
                ("AT_SPEED", SpindleFlags::AT_SPEED.0),
                ("STOPPED", SpindleFlags::STOPPED.0),
                ("ORIENTED", SpindleFlags::ORIENTED.0),
                ("FAULT", SpindleFlags::FAULT.0),
                ("ANGLE", SpindleFlags::ANGLE.0),
                ("INDEX", SpindleFlags::INDEX.0),
                ("SPEED", SpindleFlags::SPEED.0),
                ("LOAD", SpindleFlags::LOAD.0),
                ("IN_GEAR", SpindleFlags::IN_GEAR.0),
            ],
        ),
        own!("STOPPED", "Why a servo stopped the joints by itself.", Stopped:
            Not, Silence, Asked, Jump),
        own!("JUMP", "What of a jump is too much.", TooMuch: None, Velocity, Acceleration),
    ]
}

/// All that the library knows.
pub(super) fn codes() -> Vec<Codes> {
    let mut codes = vec![
        own!("E", "What functions return that fail; gp_last_error has the text.", Code:
            Argument, Abi, Thread, NoServer, Version, Taken, Record, Transport, Panic, Refused),
        all!("STATE", "What the interpolator is doing.", MachineState),
        all!("COMMAND", "What can be commanded.", CommandKind),
        all!("REFUSAL", "Why a command was refused.", CommandRefusal),
        all!("END", "How an epoch ended.", EndOfEpoch),
        faults(),
        all!(
            "POWER",
            "Whether the drives have power, as far as the interpolator knows.",
            Power
        ),
        all!("MODE", "What moves the axes.", MotionMode),
        all!(
            "SUPERPOSITION",
            "What the superposition of an axis does.",
            SuperpositionState
        ),
        all!(
            "FREEZE_REASON",
            "Why the superposition of an axis is frozen.",
            FreezeReason
        ),
        all!("CONTACT", "What a probe has found.", ContactKind),
        all!("JOB", "How the job of a planner stands.", JobStage),
        all!(
            "EVENT",
            "What an event is: kind of a gp_event, and the lowest byte of event_kind of a gp_segment.",
            EventKind
        ),
        all!(
            "DRIVE",
            "What a drive does, by the states of CiA 402.",
            DriveState
        ),
        bits(
            "FLAG",
            "Properties of a frame.",
            &[
                ("FIRST", FrameFlags::FIRST.0),
                ("LAST", FrameFlags::LAST.0),
                ("RAPID", FrameFlags::RAPID.0),
                ("EXACT_STOP", FrameFlags::EXACT_STOP.0),
                ("DWELL", FrameFlags::DWELL.0),
                ("PROGRAM_STOP", FrameFlags::PROGRAM_STOP.0),
                ("SYNC", FrameFlags::SYNC.0),
                ("PER_REV", FrameFlags::PER_REV.0),
            ],
        ),
        bits(
            "MARK",
            "Properties of a setpoint.",
            &[
                ("LATE", SetpointMarks::LATE.0),
                ("AFTER_MISSED", SetpointMarks::AFTER_MISSED.0),
            ],
        ),
        bits(
            "GRANT",
            "Which real-time grants the interpolator holds.",
            &[
                ("FIFO", Grants::FIFO.0),
                ("PINNED", Grants::PINNED.0),
                ("MEMORY_LOCKED", Grants::MEMORY_LOCKED.0),
                ("PREFAULTED", Grants::PREFAULTED.0),
                ("DMA_LATENCY", Grants::DMA_LATENCY.0),
                ("BEST_EFFORT", Grants::BEST_EFFORT.0),
            ],
        ),
    ];
    codes.extend(of_servos());
    codes.extend(of_feedback());
    codes.extend(of_demands());
    codes
}
