//! The checks of a block's words: used by one of its codes, whole, not negative.

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::syntax::block::Block;

#[cold]
pub(crate) fn unused(letter: char, span: SourceSpan) -> Box<BlockDiagnostic> {
    if letter == 'E' {
        return BlockDiagnostic::new(
            DiagnosticCode::UnknownWord,
            span,
            "nothing in the block uses E",
        )
        .because("E is a word of G70, M66, M67 and M68 here; printers have it for their extruder")
        .help("remove it; read programs of printers with the dialect `marlin`");
    }
    BlockDiagnostic::new(
        DiagnosticCode::UnusedWord,
        span,
        format!("nothing in the block uses {letter}"),
    )
    .because("a word without effect is a mistake in the program")
    .help("remove it, or add the code it belongs to")
}

#[cold]
pub(crate) fn missing(
    span: SourceSpan,
    code: &str,
    word: &str,
    meaning: &str,
) -> Box<BlockDiagnostic> {
    BlockDiagnostic::new(
        DiagnosticCode::MissingWord,
        span,
        format!("{code} without {word}"),
    )
    .because(format!("{code} needs {word}: {meaning}"))
    .help(format!("add the {} word", word.trim_start_matches("an ")))
}

#[cold]
pub(crate) fn negative(block: &Block, letter: u8, what: &str) -> Box<BlockDiagnostic> {
    BlockDiagnostic::new(
        DiagnosticCode::InvalidValue,
        block.span(letter),
        format!("{what} is negative"),
    )
    .help("write zero or more")
}

/// The first word of a code that is wrong is refused, with its rule.
pub(crate) fn none_wrong<'a>(
    block: &Block,
    code: &str,
    words: impl IntoIterator<Item = (u8, bool, &'a str)>,
) -> Outcome<()> {
    let mut words = words.into_iter();
    let Some((letter, _, rule)) = words.find(|(_, is_wrong, _)| *is_wrong) else {
        return Ok(());
    };
    let message = format!("{} of {code} is out of range", char::from(letter));
    Err(
        BlockDiagnostic::new(DiagnosticCode::InvalidValue, block.span(letter), message)
            .help(format!("write {rule}")),
    )
}

/// Value of a word that must be a whole number from 0 to `max`.
pub(crate) fn whole(block: &Block, letter: u8, max: u32) -> Outcome<Option<u32>> {
    let value = block.get(letter);
    value
        .map(|value| whole_value(block, letter, value, max))
        .transpose()
}

/// The same of a count, which a FANUC writes in no increments.
pub(crate) fn whole_count(block: &Block, letter: u8, max: u32) -> Outcome<Option<u32>> {
    let value = block.written(letter);
    value
        .map(|value| whole_value(block, letter, value, max))
        .transpose()
}

fn whole_value(block: &Block, letter: u8, value: f64, max: u32) -> Outcome<u32> {
    let nearest = value.round();
    let name = char::from(letter);
    if (value - nearest).abs() > 1e-4 {
        let message = format!("{name}{value} is not a whole number");
        return Err(BlockDiagnostic::new(
            DiagnosticCode::NotAnInteger,
            block.span(letter),
            message,
        )
        .because(format!("{name} counts or numbers something here")));
    }
    if !(0.0..=f64::from(max)).contains(&nearest) {
        let message = format!("{name}{value} is out of range");
        return Err(BlockDiagnostic::new(
            DiagnosticCode::InvalidValue,
            block.span(letter),
            message,
        )
        .help(format!("write a number from 0 to {max}")));
    }
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "range checked"
    )]
    Ok(nearest as u32)
}
