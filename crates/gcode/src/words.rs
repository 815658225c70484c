//! What the words of a block must be: used by one of its codes, whole, not negative.

use glidepath_motion::PathMode;

use crate::block::{AXIS_WORDS, Block, Letters};
use crate::codes::{Motion, Once};
use crate::diagnostic::{Code, Fault, Outcome, Span};

/// Largest tool number.
pub(crate) const MAX_TOOL: u32 = 999_999;

/// Refuses words that nothing in the block uses, and words that two codes want.
pub(crate) fn check_words(block: &Block, motion: Option<Motion>) -> Outcome<()> {
    let arc = matches!(
        motion,
        Some(Motion::ArcClockwise | Motion::ArcCounterclockwise)
    );
    let once = block.codes.once.map(|once| once.code);
    let dwell = once == Some(Once::Dwell);
    let data = once == Some(Once::SetData);
    let blend = block
        .codes
        .path_mode
        .is_some_and(|mode| matches!(mode.code, PathMode::Continuous { .. }));

    let mut used = Letters::of(b"FST");
    for (uses, letters) in [
        (
            motion.is_some() || once.is_some_and(Once::takes_axes),
            AXIS_WORDS,
        ),
        (arc, Letters::of(b"IJKRP")),
        (data, Letters::of(b"LPR")),
        (dwell, Letters::of(b"P")),
        (blend, Letters::of(b"PQ")),
    ] {
        if uses {
            used = used.and(letters);
        }
    }
    if let Some((letter, span)) = block.unused(used) {
        return Err(unused(letter, span));
    }
    let wants_p = [arc, data, dwell, blend]
        .into_iter()
        .filter(|wants| *wants)
        .count();
    if wants_p > 1 && block.get(b'P').is_some() {
        let message = "it is not clear which code the P word belongs to";
        return Err(Fault::new(Code::AmbiguousWord, block.span(b'P'), message)
            .because("two codes of the block take a P word")
            .help("write two blocks"));
    }
    Ok(())
}

#[cold]
pub(crate) fn unused(letter: char, span: Span) -> Box<Fault> {
    Fault::new(
        Code::UnusedWord,
        span,
        format!("nothing in the block uses {letter}"),
    )
    .because("a word without effect is a mistake in the program")
    .help("remove it, or add the code it belongs to")
}

#[cold]
pub(crate) fn missing(span: Span, code: &str, word: &str, meaning: &str) -> Box<Fault> {
    Fault::new(Code::MissingWord, span, format!("{code} without {word}"))
        .because(format!("{code} needs {word}: {meaning}"))
        .help(format!("add the {word} word"))
}

pub(crate) fn require_axes(block: &Block, span: Span, code: &str) -> Outcome<()> {
    if block.has_any(AXIS_WORDS) {
        return Ok(());
    }
    Err(missing(
        span,
        code,
        "an axis",
        "the axes whose offsets it sets",
    ))
}

#[cold]
pub(crate) fn negative(block: &Block, letter: u8, what: &str) -> Box<Fault> {
    Fault::new(
        Code::InvalidValue,
        block.span(letter),
        format!("{what} is negative"),
    )
    .help("write zero or more")
}

/// Value of a word that must be a whole number from 0 to `max`.
pub(crate) fn whole(block: &Block, letter: u8, max: u32) -> Outcome<Option<u32>> {
    let Some(value) = block.get(letter) else {
        return Ok(None);
    };
    let nearest = value.round();
    let name = char::from(letter);
    if (value - nearest).abs() > 1e-4 {
        let message = format!("{name}{value} is not a whole number");
        return Err(Fault::new(Code::NotAnInteger, block.span(letter), message)
            .because(format!("{name} counts or numbers something here")));
    }
    if !(0.0..=f64::from(max)).contains(&nearest) {
        let message = format!("{name}{value} is out of range");
        return Err(Fault::new(Code::InvalidValue, block.span(letter), message)
            .help(format!("write a number from 0 to {max}")));
    }
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "range checked"
    )]
    Ok(Some(nearest as u32))
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
