//! The check that the codes of a block take each of its words, and none twice.

use glidepath_program::PathMode;

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::syntax::block::{Block, CornerKind};
use crate::syntax::dialect::Dialect;
use crate::syntax::frame_codes::{FrameCode, TiltCode};
use crate::syntax::letters::{AXIS_WORDS, Letters};
use crate::syntax::modes::{
    CannedCycle, CutterRadius, LatheCycle, Motion, NonModal, SpindleMode, Spline, ToolLength,
    Turning,
};
use crate::syntax::named_word::{Named, no_use};
use crate::syntax::word_check::{missing, negative, unused};

/// The words each code of a block takes besides F, S and T.
fn taken(block: &Block, motion: Option<Motion>) -> [Letters; 13] {
    let codes = &block.codes;
    let none = Letters::of(b"");
    let non_modal = codes.non_modal.map(|non_modal| non_modal.code);
    let axes_non_modal = non_modal.is_some_and(NonModal::takes_axes);
    [
        taken_by_motion(block, motion),
        match codes.tool_length.map(|length| length.code) {
            Some(ToolLength::FromTable | ToolLength::Subtract) => Letters::of(b"H"),
            Some(ToolLength::Add) => Letters::of(b"H").and(AXIS_WORDS),
            Some(ToolLength::FromWords) => AXIS_WORDS,
            _ => none,
        },
        match codes.cutter_radius.map(|radius| radius.code) {
            Some(CutterRadius::FromTable(_)) if block.dialect != Dialect::Siemens => {
                radius_word(block)
            }
            Some(CutterRadius::FromWord(_)) => Letters::of(b"DL"),
            _ => none,
        },
        match non_modal {
            Some(NonModal::Dwell) if block.dialect == Dialect::Fanuc => Letters::of(b"PXU"),
            Some(NonModal::Dwell) => Letters::of(b"P"),
            Some(NonModal::GoToReference(_)) if block.dialect == Dialect::Marlin => {
                Letters::of(b"OR")
            }
            Some(NonModal::GoToReference(1)) if block.dialect == Dialect::Fanuc => {
                Letters::of(b"P")
            }
            Some(NonModal::SetData) if block.is_lathe => Letters::of(b"LPRQ"),
            Some(NonModal::SetData) if block.dialect == Dialect::Fanuc => Letters::of(b"LPR"),
            Some(NonModal::SetData) => match block.get(b'L') {
                Some(2.0 | 20.0) => Letters::of(b"LPR"),
                _ => Letters::of(b"LPRQIJ"),
            },
            _ => none,
        },
        match codes.path_mode.map(|mode| mode.code) {
            Some(PathMode::Continuous { .. }) if block.dialect != Dialect::Fanuc => {
                Letters::of(b"PQ")
            }
            _ => none,
        },
        match codes.spindle_mode.map(|mode| mode.code) {
            Some(SpindleMode::SurfaceSpeed) if block.dialect == Dialect::LinuxCnc => {
                Letters::of(b"D")
            }
            _ => none,
        },
        match codes.input_output.map(|code| code.code) {
            Some(62..=65) => Letters::of(b"P"),
            Some(66) => Letters::of(b"PELQ"),
            Some(_) => Letters::of(b"EQ"),
            None => none,
        },
        match codes.overrides.map(|code| code.code) {
            Some(50..=53) => Letters::of(b"P"),
            _ => none,
        },
        match (codes.tool_change.map(|code| code.code), codes.orient) {
            (Some(61), _) => Letters::of(b"Q"),
            (_, Some(_)) => Letters::of(b"RPQ"),
            _ => none,
        },
        match codes.user {
            Some(_) => Letters::of(b"PQ"),
            None => none,
        },
        taken_by_modes_of_dialects(block),
        taken_by_systems(block),
        if motion.is_some() || axes_non_modal {
            places(block, motion)
        } else {
            none
        },
    ]
}

/// The words of places that a block takes.
fn places(block: &Block, motion: Option<Motion>) -> Letters {
    match (block.dialect, motion) {
        (Dialect::Marlin, _) => AXIS_WORDS.and(Letters::of(b"E")),
        // These go along X and Z alone.
        (Dialect::Fanuc, Some(Motion::Turning(_) | Motion::Groove(_) | Motion::ThreadCycle)) => {
            Letters::of(b"XZUW")
        }
        (Dialect::Fanuc, _) if block.has_increments() => AXIS_WORDS.and(Letters::of(b"H")),
        _ => AXIS_WORDS,
    }
}

/// True where P of a block with G54 is the number of a work offset.
pub(crate) fn takes_number(block: &Block) -> bool {
    let motion = block.codes.motion.and_then(|coded| coded.code);
    let takes_none = match block.codes.motion {
        None => true,
        Some(_) => matches!(
            motion,
            Some(
                Motion::Rapid | Motion::Linear | Motion::ArcClockwise | Motion::ArcCounterclockwise
            )
        ),
    };
    block.get(b'P').is_some() && block.codes.non_modal.is_none() && takes_none
}

/// True where P of a block is the number of a work offset: with G54.1, and with G54 where it is one of those.
pub(super) fn has_number_of_system(block: &Block) -> bool {
    let codes = &block.codes;
    match (codes.extended_system, codes.system) {
        (Some(coded), _) => coded.code.is_none(),
        (None, Some(system)) => {
            system.code == 0 && block.dialect == Dialect::Fanuc && takes_number(block)
        }
        (None, None) => false,
    }
}

/// P, where it is the number of a work offset.
fn taken_by_systems(block: &Block) -> Letters {
    Letters::of(if has_number_of_system(block) {
        b"P"
    } else {
        b""
    })
}

/// The words of FANUC's frames, of codes that are read over, and of printers' places.
fn taken_by_modes_of_dialects(block: &Block) -> Letters {
    let codes = &block.codes;
    match (codes.read_over, codes.frame.map(|frame| frame.code)) {
        _ if codes.kept_place.is_some() => AXIS_WORDS.and(Letters::of(b"E")),
        _ if codes.tilt.is_some() => taken_by_tilt(block),
        (Some(_), _) => Letters::of(b"PQRE"),
        (_, Some(FrameCode::Scale(true))) => AXIS_WORDS.and(Letters::of(b"PIJK")),
        (_, Some(FrameCode::Turn(true))) => AXIS_WORDS.and(Letters::of(b"R")),
        (_, Some(FrameCode::Mirror(_) | FrameCode::Switch(_))) => AXIS_WORDS,
        _ => Letters::of(b""),
    }
}

/// The words of G68.2 in its forms, and of G53.1.
fn taken_by_tilt(block: &Block) -> Letters {
    let is_plane = block
        .codes
        .tilt
        .is_some_and(|coded| coded.code == TiltCode::Plane);
    if !is_plane {
        return Letters::of(b"P");
    }
    match (block.get(b'P'), block.get(b'Q')) {
        (Some(2.0), Some(0.0)) => Letters::of(b"PQXYZR"),
        (Some(2.0), _) => Letters::of(b"PQXYZ"),
        (Some(3.0), Some(2.0)) => Letters::of(b"PQIJK"),
        (Some(3.0), _) => Letters::of(b"PQXYZIJK"),
        _ => AXIS_WORDS.and(Letters::of(b"PIJK")),
    }
}

/// The words that the motion of a block takes, besides those of axes.
fn taken_by_motion(block: &Block, motion: Option<Motion>) -> Letters {
    match motion {
        Some(Motion::ArcClockwise | Motion::ArcCounterclockwise) => match block.dialect {
            Dialect::Fanuc => Letters::of(b"IJKR"),
            _ => Letters::of(b"IJKRP"),
        },
        Some(Motion::Cycle(_)) if block.dialect == Dialect::Fanuc => {
            // Beside G54.1 P is its number.
            let is_number = has_number_of_system(block);
            Letters::of(if is_number { b"RLQKIJ" } else { b"RLPQKIJ" })
        }
        Some(Motion::Turning(Turning::Face)) => Letters::of(b"RK"),
        Some(Motion::Turning(Turning::Thread)) => Letters::of(b"RIQ"),
        Some(Motion::Turning(_)) => Letters::of(b"RI"),
        Some(Motion::TapIn | Motion::TapOut) => Letters::of(b"IJK"),
        Some(Motion::CirclePocket(_)) => Letters::of(b"IKQLD"),
        Some(Motion::HolePattern(_)) => Letters::of(b"IJKL"),
        Some(Motion::Groove(_)) => Letters::of(b"RPQIK"),
        Some(Motion::Thread) if block.dialect == Dialect::Siemens => Letters::of(b"IJKQ"),
        Some(Motion::Thread) => Letters::of(b"KQ"),
        Some(Motion::RigidTap) => Letters::of(b"KIPQR"),
        Some(Motion::ThreadCycle) if block.dialect == Dialect::Fanuc => Letters::of(b"PQRIKDA"),
        Some(Motion::ThreadCycle) => Letters::of(b"PIJKRQHEL"),
        Some(Motion::Lathe(LatheCycle::Finish)) => Letters::of(b"QDEP"),
        Some(Motion::Lathe(_)) => Letters::of(b"QDIR"),
        Some(Motion::Spline(spline)) => match spline {
            Spline::Cubic => Letters::of(b"IJPQ"),
            Spline::Quadratic => Letters::of(b"IJ"),
            Spline::Weighted => Letters::of(b"PL"),
            Spline::EndWeighted => Letters::of(b""),
            Spline::Knotted => Letters::of(b"KRPQ"),
        },
        Some(Motion::Cycle(cycle)) => match cycle {
            CannedCycle::Drill | CannedCycle::Bore => Letters::of(b"RL"),
            CannedCycle::ChipBreak | CannedCycle::Peck => Letters::of(b"RLQ"),
            _ => Letters::of(b"RLP"),
        },
        _ => Letters::of(b""),
    }
}

/// The word that says whose radius G41 and G42 are to take: D. Older controls of FANUC have one list
/// of offsets, and H for both lengths and radii; beside G43 it is the length's.
pub(crate) fn radius_word(block: &Block) -> Letters {
    let takes_h = block.dialect == Dialect::Fanuc
        && block.get(b'D').is_none()
        && block.codes.tool_length.is_none();
    if takes_h {
        Letters::of(b"H")
    } else {
        Letters::of(b"D")
    }
}

/// Words of a block whose only code is a motion, or which has none: as [`taken`], for straight
/// moves and arcs.
const fn taken_by_move(motion: Option<Motion>, dialect: Dialect) -> Option<Letters> {
    const STRAIGHT: Letters = AXIS_WORDS.and(Letters::of(b"FST"));
    const ARC: Letters = STRAIGHT.and(Letters::of(b"IJKR"));
    const TURNS: Letters = ARC.and(Letters::of(b"P"));
    match motion {
        Some(Motion::Rapid | Motion::Linear) => Some(STRAIGHT),
        Some(Motion::ArcClockwise | Motion::ArcCounterclockwise) => Some(match dialect {
            Dialect::Fanuc => ARC,
            _ => TURNS,
        }),
        _ => None,
    }
}

/// True for a move, or a block without one.
fn may_choose_radius(block: &Block, motion: Option<Motion>) -> bool {
    let is_move = motion
        .is_none_or(|motion| matches!(motion, Motion::Rapid | Motion::Linear) || motion.is_arc());
    is_move && block.codes.spindle_mode.is_none()
}

/// Refuses words that nothing in the block uses, and words that two codes want.
pub(crate) fn check_words(block: &Block, motion: Option<Motion>) -> Outcome<()> {
    if !block.says_modes
        && let Some(taken) = taken_by_move(motion, block.dialect)
        && block.unused(taken).is_none()
    {
        return Ok(());
    }
    let taken = taken(block, motion);
    let always = match block.dialect {
        // The edge of the tool may be chosen in any block.
        Dialect::Siemens => Letters::of(b"FSTD"),
        // So may the length and the radius of the tool; in a cycle, and beside G96, D is a word of other
        // controls.
        Dialect::Fanuc if !block.is_lathe && may_choose_radius(block, motion) => {
            Letters::of(b"FSTHD")
        }
        Dialect::Fanuc if !block.is_lathe => Letters::of(b"FSTH"),
        _ => Letters::of(b"FST"),
    };
    let used = taken.iter().fold(always, |used, one| used.and(*one));
    if let Some((letter, span)) = block.unused(used) {
        return Err(unused(letter, span));
    }
    // The axes are settled already: by which code takes them.
    for letter in *b"PQLRDHE" {
        if block.get(letter).is_none() {
            continue;
        }
        let wants = taken.iter().filter(|one| one.has(letter)).count();
        if wants > 1 {
            let letter_name = char::from(letter);
            let message = format!("it is not clear which code the {letter_name} word belongs to");
            return Err(BlockDiagnostic::new(
                DiagnosticCode::AmbiguousWord,
                block.span(letter),
                message,
            )
            .because(format!("two codes of the block take {letter_name}"))
            .help("write two blocks"));
        }
    }
    Ok(())
}

/// Refuses a word with a longer name than a letter that nothing in its block uses; `rounds_all` where all
/// corners are rounded.
pub(crate) fn check_named_words(
    block: &Block,
    motion: Option<Motion>,
    rounds_all: bool,
) -> Outcome<()> {
    let sets_pole = block
        .codes
        .non_modal
        .is_some_and(|code| matches!(code.code, NonModal::SetPole(_)));
    let is_arc = motion.is_some_and(Motion::is_arc);
    let is_straight = matches!(motion, Some(Motion::Rapid | Motion::Linear));
    let goes_at_feed = is_arc || motion == Some(Motion::Linear);
    let takes = |word: Named| match word {
        Named::SpeedLimit
        | Named::UpperSpeed
        | Named::LowerSpeed
        | Named::SpindleAngle
        | Named::CornerFeeds => true,
        Named::BlockFeed => goes_at_feed,
        Named::CornerFeed => block.corner.is_some() || rounds_all && goes_at_feed,
        Named::PolarRadius | Named::PolarAngle => is_arc || is_straight || sets_pole,
        Named::ArcAngle => is_arc,
        Named::LineAngle => motion == Some(Motion::Linear),
        Named::Via(_) => motion == Some(Motion::ArcThrough),
        Named::Vector(_) => is_straight,
    };
    match block.named.untaken(takes) {
        None if block.dialect == Dialect::Marlin => check_places_of_printer(block, motion),
        None => check_corner_word(block, motion),
        Some(word) => Err(no_use(word)),
    }
}

/// Refuses words of axes beside a printer's command that moves nothing: to its firmware they are words of the
/// command.
fn check_places_of_printer(block: &Block, motion: Option<Motion>) -> Outcome<()> {
    let codes = &block.codes;
    let has_command = codes.any() || block.get(b'T').is_some();
    if motion.is_none() || codes.motion.is_some() || !has_command || !block.has_axes() {
        return Ok(());
    }
    let message = "a place beside a command that moves nothing";
    Err(
        BlockDiagnostic::new(DiagnosticCode::UnusedWord, block.first_span(), message)
            .because(
                "the firmware of a printer takes it for a word of the command, and does not move",
            )
            .help("write G0 or G1 and the place into a line of its own"),
    )
}

/// Refuses a word that breaks a corner in a block that makes no move of G1, G2 or G3.
fn check_corner_word(block: &Block, motion: Option<Motion>) -> Outcome<()> {
    let is_move = matches!(
        motion,
        Some(Motion::Linear | Motion::ArcClockwise | Motion::ArcCounterclockwise)
    );
    match block.corner {
        Some(word)
            if word.kind != CornerKind::RoundAll
                && word.value != 0.0
                && !(is_move && block.has_axes()) =>
        {
            let message = "a corner that is broken in a block without a move of G1, G2 or G3";
            Err(
                BlockDiagnostic::new(DiagnosticCode::UnusedWord, word.span, message)
                    .because("the word counts between two moves of these, and here it would have no effect")
                    .help("remove it, or write it into the move that ends at the corner"),
            )
        }
        _ => Ok(()),
    }
}

pub(crate) fn require_axes(block: &Block, span: SourceSpan, code: &str) -> Outcome<()> {
    if block.has_axes() {
        return Ok(());
    }
    Err(missing(
        span,
        code,
        "an axis",
        "the axes whose offsets it sets",
    ))
}

/// The path mode of a block, with the tolerance of G64 in mm.
///
/// G64 P0 allows no deviation at all, which is what G61 means.
pub(crate) fn path_mode(block: &Block, code: PathMode, scale: f64) -> Outcome<PathMode> {
    if !matches!(code, PathMode::Continuous { .. }) {
        return Ok(code);
    }
    for letter in [b'P', b'Q'] {
        if block.get(letter).is_some_and(|value| value < 0.0) {
            return Err(negative(block, letter, "the tolerance"));
        }
    }
    Ok(match block.get(b'P').map(|tolerance| tolerance * scale) {
        None => PathMode::Continuous { tolerance_mm: None },
        Some(tolerance) if tolerance > 0.0 => PathMode::Continuous {
            tolerance_mm: Some(tolerance),
        },
        Some(_) => PathMode::ExactPath,
    })
}
