//! Plain lines: a block number, G0 to G3, and words with numbers, as nearly all lines of a long
//! program are. They are read without looking at a byte twice; every other line, and every
//! diagnostic, is the business of [`crate::syntax::block::Block::parse_any`], with which this
//! agrees.
//!
//! Eight bytes are looked at together. A number of at most fifteen digits is a quotient of two
//! exact doubles, so one division rounds it correctly:
//!
//! ```text
//!   "12.3456 "    less '0' each    1 2 │ ─2 3 …    two digits, then the point: 12
//!   "3456 Y7."                     3 4 5 6 │ ─16   four digits: 3456
//!                                  (12 · 10⁴ + 3456) / 10⁴
//! ```

use core::num::NonZeroU64;

use crate::diagnostic::span::SourceSpan;
use crate::syntax::letters::Slot;
use crate::syntax::modes::Motion;
use crate::syntax::number::POWERS;

/// Most digits of a number that is read here.
const MOST_DIGITS: usize = 15;
/// Most digits of a block number, and in front of a decimal point.
const MOST_WHOLE: usize = 7;

/// Eight zeros, and what is left of a point without one.
const ZEROS: u64 = 0x3030_3030_3030_3030;
const POINT: u64 = (b'.' ^ b'0') as u64;

/// Takes what a plain line says, word by word, and `None` where it does not want it.
pub(crate) trait WordSink {
    /// A motion code and where it stands; a second one is not wanted.
    fn add_motion(&mut self, motion: Motion, span: SourceSpan) -> Option<()>;

    /// A word, by the slot of its letter, and where it stands; a second one of that letter is not
    /// wanted.
    fn add_value(&mut self, slot: Slot, value: f64, span: SourceSpan) -> Option<()>;
}

/// Reads a plain line, of which `text` has all and may have more: where it ends, at a CR, an LF, or
/// the end of the text. `None` if the line is not plain, or says what is not wanted.
#[inline]
pub(crate) fn read_plain(text: &[u8], into: &mut impl WordSink) -> Option<usize> {
    let mut end = 0;
    loop {
        // Blanks may stand inside numbers: what is no letter behind them is not plain.
        let mut at = end;
        let class = loop {
            match text
                .get(at)
                .map_or(ByteClass::End, |&byte| CLASSES[usize::from(byte)])
            {
                ByteClass::Blank => at += 1,
                class => break class,
            }
        };
        match class {
            // Next to a digit it would be an exponent.
            ByteClass::Exponent(_) if at == end && end > 0 => return None,
            ByteClass::Word(slot) | ByteClass::Exponent(slot) => {
                let value;
                (value, end) = number(text, at + 1)?;
                into.add_value(slot, value, SourceSpan::new(at, end))?;
            }
            ByteClass::End => return Some(at),
            ByteClass::Code => {
                let (digit, length) = match text.get(at + 1..)? {
                    [b'0', digit @ b'0'..=b'3', ..] => (digit, 2),
                    [digit @ b'0'..=b'3', ..] => (digit, 1),
                    _ => return None,
                };
                let motion = *MOTIONS.get(usize::from(digit - b'0'))?;
                end = at + 1 + length;
                into.add_motion(motion, SourceSpan::new(at, end))?;
            }
            ByteClass::Number if end == 0 => {
                let (_, digits) = digits(text, at + 1);
                if digits == 0 || digits > MOST_WHOLE {
                    return None;
                }
                end = at + 1 + digits;
            }
            ByteClass::Number | ByteClass::Blank | ByteClass::Odd => return None,
        }
    }
}

/// What a byte may begin.
#[derive(Debug, Clone, Copy)]
enum ByteClass {
    Blank,
    /// The end of the line.
    End,
    /// G.
    Code,
    /// N.
    Number,
    /// E.
    Exponent(Slot),
    /// Any other word with a value.
    Word(Slot),
    /// Nothing in a plain line.
    Odd,
}

const CLASSES: [ByteClass; 256] = {
    let mut classes = [ByteClass::Odd; 256];
    let mut byte = 0_u8;
    while byte < 128 {
        classes[byte as usize] = match byte.to_ascii_uppercase() {
            b' ' | b'\t' => ByteClass::Blank,
            b'\n' | b'\r' => ByteClass::End,
            b'G' => ByteClass::Code,
            b'N' => ByteClass::Number,
            b'E' => ByteClass::Exponent(Slot::of(b'E')),
            b'M' | b'O' => ByteClass::Odd,
            letter @ b'A'..=b'Z' => ByteClass::Word(Slot::of(letter)),
            _ => ByteClass::Odd,
        };
        byte += 1;
    }
    classes
};

/// The motion codes, by number.
const MOTIONS: [Motion; 4] = [
    Motion::Rapid,
    Motion::Linear,
    Motion::ArcClockwise,
    Motion::ArcCounterclockwise,
];

/// A number, and where it ends.
// The compiler would make it a call, which costs a quarter of it.
#[inline(always)]
fn number(text: &[u8], start: usize) -> Option<(f64, usize)> {
    let sign = text.get(start)?;
    let negative = *sign == b'-';
    let start = start + usize::from(negative || *sign == b'+');
    let (digits, decimals, end) = short(text, start).or_else(|| long(text, start))?;
    let value = digits / POWERS.get(decimals)?;
    Some((if negative { -value } else { value }, end))
}

/// The digits of a number as one, how many of them are decimals, and where it ends; `None` if it
/// does not end within eight bytes.
#[inline(always)]
fn short(text: &[u8], start: usize) -> Option<(f64, usize, usize)> {
    let word = eight(text, start) ^ ZEROS;
    let odd = odd(word);
    // Places in bits: of the first byte that is no digit, and of the second.
    let place = |odd| NonZeroU64::new(odd).map(|odd| odd.trailing_zeros() & !7);
    let bytes = |bits: u32| (bits / 8) as usize;
    let first = place(odd)?;
    if word >> first & 0xff != POINT {
        return Some((value(word, first)?.into(), 0, start + bytes(first)));
    }
    let second = place(odd & (odd - 1))?;
    // What is behind the point moves up to it.
    let whole = (1 << first) - 1;
    let joined = (word & whole) | (word >> 8 & !whole);
    let decimals = bytes(second - first) - 1;
    let value = value(joined, second - 8)?;
    Some((value.into(), decimals, start + bytes(second)))
}

/// As [`short`], for a number of up to [`MOST_DIGITS`] digits: below 2⁵³, so that every step is
/// exact.
fn long(text: &[u8], start: usize) -> Option<(f64, usize, usize)> {
    let (whole, mut count) = digits(text, start);
    let (mut value, mut decimals) = (f64::from(whole), 0);
    let mut at = start + count;
    if count > MOST_WHOLE {
        return None;
    }
    if text.get(at) == Some(&b'.') {
        at += 1;
        loop {
            let (part, length) = digits(text, at);
            at += length;
            decimals += length;
            count += length;
            if count > MOST_DIGITS {
                return None;
            }
            value = value * POWERS.get(length)? + f64::from(part);
            if length < 8 {
                break;
            }
        }
    }
    (count > 0).then_some((value, decimals, at))
}

/// Value and count of the digits at a place, eight at most.
#[inline]
fn digits(text: &[u8], at: usize) -> (u32, usize) {
    let word = eight(text, at) ^ ZEROS;
    let bits = odd(word).trailing_zeros() & !7;
    (value(word, bits).unwrap_or(0), (bits / 8) as usize)
}

/// The high bit of each byte that is no digit; above the lowest of them, bytes behind one that is
/// not ASCII may be wrong. Digits are from 0 to 9 here.
#[inline]
const fn odd(word: u64) -> u64 {
    (word.wrapping_add(0x7676_7676_7676_7676) | word) & 0x8080_8080_8080_8080
}

/// Value of the digits in the lowest `bits`, the first one lowest; `None` if there are none.
#[inline]
const fn value(word: u64, bits: u32) -> Option<u32> {
    if bits == 0 {
        return None;
    }
    // Zeros in front of them; then pairs, fours, all.
    let ones = word << (64 - bits);
    let pairs = (ones * 10) + (ones >> 8);
    let fours = (pairs & 0xff_0000_00ff).wrapping_mul(100 + (1_000_000 << 32));
    let rest = ((pairs >> 16) & 0xff_0000_00ff).wrapping_mul(1 + (10_000 << 32));
    Some((fours.wrapping_add(rest) >> 32) as u32)
}

/// Eight bytes, the first one lowest; zeros behind the end.
#[inline]
fn eight(text: &[u8], at: usize) -> u64 {
    let rest = text.get(at..).unwrap_or_default();
    rest.first_chunk()
        .map_or_else(|| tail(rest), |bytes| u64::from_le_bytes(*bytes))
}

/// The next eight bytes where fewer are left: the others are zero.
#[cold]
fn tail(rest: &[u8]) -> u64 {
    let mut bytes = [0; 8];
    for (to, from) in bytes.iter_mut().zip(rest) {
        *to = *from;
    }
    u64::from_le_bytes(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::syntax::block::Block;
    use crate::syntax::expression::scope::Scope;
    use proptest::prelude::*;

    /// No parameters.
    struct Nothing;

    impl Scope for Nothing {
        fn numbered(&self, _: u32) -> Option<f64> {
            None
        }

        fn named(&self, _: &str) -> Option<f64> {
            None
        }
    }

    /// All a block says, bit for bit.
    fn words(block: &Block) -> String {
        let values: Vec<_> = (b'A'..=b'Z')
            .filter_map(|letter| {
                let value = block.get(letter)?.to_bits();
                Some((char::from(letter), value, block.span(letter)))
            })
            .collect();
        format!(
            "{values:?} {:?} {:?} {:?} {:?} {}",
            block.codes, block.kind, block.polar, block.assignments, block.any
        )
    }

    /// Whether the line is plain; the general way must agree if it is.
    fn is_plain(text: &str) -> bool {
        let (mut plain, mut general) = (Block::default(), Block::default());
        // Both were filled before.
        plain
            .parse("G21 G3 X7 A2 #1=2 @1".as_bytes(), &Nothing)
            .unwrap();
        general.parse("M3 S1 Y9".as_bytes(), &Nothing).unwrap();
        let Some(length) = plain.parse_plain(text.as_bytes()) else {
            return false;
        };
        let parsed = general.parse_any(&text.as_bytes()[..length], &Nothing);
        assert!(parsed.is_ok(), "{text}: {parsed:?}");
        assert_eq!(words(&plain), words(&general), "{text}");
        true
    }

    #[test]
    fn what_most_lines_are_is_plain() {
        for text in [
            "",
            "  \t",
            "G1 X1",
            "g01x-1.5y.25z-.125f1000",
            "N0120 G0 X1. Y+2 Z0\r\nG1",
            "\tN5 X12.3456 Y123.4567 Z1234567.12345678",
            "G2 X0 Y0 I-1.0000001 J2",
            "X-0.0000 E5\n",
        ] {
            assert!(is_plain(text), "{text}");
        }
    }

    #[test]
    fn what_is_not_plain_is_left_alone() {
        for text in [
            "G4",
            "G1.5",
            "G1 G0",
            "X1 X2",
            "X1 0",
            "X 1",
            "X",
            "X.",
            "X1.2.3",
            "X1-",
            "X1 -2",
            "X1,5",
            "X1e5",
            "X1E5",
            "N1E5",
            "X--1",
            "G",
            "G-1",
            "G1 N5",
            "N1 N2",
            "N1.5",
            "N 1",
            "N",
            "M3",
            "O1",
            "(c)",
            "X1;",
            "%",
            "/X1",
            "#1=2",
            "X#1",
            "X[1]",
            "@1",
            "X12345678",
            "X0.1234567890123456",
            "X\u{e9}",
            "X1\0",
            "\u{feff}X1",
        ] {
            assert!(!is_plain(text), "{text}");
        }
    }

    proptest! {
        #[test]
        fn a_line_of_any_bytes_is_plain_or_left_alone(
            text in "[GXYZNEFMO0-9 .+\\-\\t\\r\\n(eg]{0,24}"
        ) {
            is_plain(&text);
        }

        #[test]
        fn words_are_read_as_the_general_way_reads_them(
            text in "(N[0-9]{1,7} ?)?(G0?[0-3] ?)?X[+-]?[0-9]{1,7}(\\.[0-9]{0,8})?([ \\t]{0,2}[YZABCUVWIJKRFSPQ][+-]?[0-9]{0,3}\\.[0-9]{1,12})?"
        ) {
            prop_assert!(is_plain(&text), "{}", text);
        }

        #[test]
        fn numbers_are_rounded_correctly(
            text in "-?[0-9]{1,7}(\\.[0-9]{0,8})?", behind in "[ Y\\n]{0,9}"
        ) {
            let expected: f64 = text.parse().expect("a number by construction");
            let line = text.clone() + &behind;
            let (value, end) = number(line.as_bytes(), 0).expect("a plain number");
            prop_assert_eq!(value.to_bits(), expected.to_bits());
            prop_assert_eq!(end, text.len());
        }
    }
}
