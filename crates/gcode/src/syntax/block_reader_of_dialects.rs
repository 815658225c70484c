//! The parts of the block reader that only the other dialects need: what their blocks have and
//! LinuxCNC's have not.

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::setup::fanuc::PointInput;
use crate::syntax::block::{Assignment, Block, CornerKind, CornerWord};
use crate::syntax::codes::Coded;
use crate::syntax::cursor::Cursor;
use crate::syntax::dialect::Dialect;
use crate::syntax::dialect::words::refused;
use crate::syntax::duplicate_word::duplicate;
use crate::syntax::expression::scope::Scope;
use crate::syntax::expression::vacant::is_vacant;
use crate::syntax::expression::value::{open_expression, parameter, word_value};
use crate::syntax::frame_codes::FrameCode;
use crate::syntax::least_increments::OF_ANGLES;
use crate::syntax::letters::{AXIS_WORDS, Letters, Slot};
use crate::syntax::modes::NonModal;
use crate::syntax::named_word::Named;
use crate::syntax::plain_line::WordSink;

/// Letters whose values are coordinates, ways or radii.
const LENGTHS: Letters = AXIS_WORDS.and(Letters::of(b"IJKRQ"));

impl Block {
    /// Fills the block from a line of a FANUC program; false if it is not plain, or may mean
    /// something else than its numbers: P counts otherwise without a point, and so may coordinates.
    pub(crate) fn parse_plain_fanuc(&mut self, text: &[u8]) -> bool {
        self.parse_plain(text) == Some(text.len())
            && self.get(b'P').is_none()
            && match self.point {
                PointInput::Calculator => true,
                PointInput::Increment => false,
                PointInput::Unsaid => !self.words.exceeds(LENGTHS, MOST_WITHOUT_POINT),
            }
    }

    /// True where `@` and `^` are words; the lines of SINUMERIK's cycles do not have them.
    pub(super) const fn has_linuxcnc_words(&self) -> bool {
        matches!(self.dialect, Dialect::LinuxCnc)
    }

    /// The number of a switch behind `/`: FANUC has nine of them, SINUMERIK ten.
    pub(super) fn skip_switch(&self, cursor: &mut Cursor<'_>) {
        let has_switch = match self.dialect {
            Dialect::Fanuc => matches!(cursor.peek(), Some(b'1'..=b'9')),
            Dialect::Siemens => matches!(cursor.peek(), Some(b'0'..=b'9')),
            Dialect::LinuxCnc | Dialect::Marlin => false,
        };
        if has_switch {
            cursor.advance();
        }
    }

    /// True for a letter alone behind G28 or G61 of a printer: which axis goes, or that it goes only where its
    /// place is not known (O).
    pub(super) fn names_an_axis(&self, mut cursor: Cursor<'_>, letter: u8) -> bool {
        let goes_home = matches!(
            self.codes.non_modal,
            Some(Coded {
                code: NonModal::GoToReference(_),
                ..
            })
        );
        let goes_back = self.codes.kept_place.is_some_and(|coded| !coded.code);
        let is_axis = AXIS_WORDS.has(letter) || letter == b'E';
        (goes_home && (is_axis || letter == b'O') || goes_back && is_axis)
            && !matches!(
                cursor.next_visible(),
                Some(b'0'..=b'9' | b'.' | b'+' | b'-')
            )
    }

    pub(super) fn flag(&mut self, letter: u8, span: SourceSpan) -> Outcome<()> {
        self.any = true;
        self.add_value(Slot::of(letter), 0.0, span)
            .ok_or_else(|| duplicate(char::from(letter), span))
    }

    /// The value of a word of FANUC, in the way that it counts numbers without a point.
    pub(super) fn fanuc_value(
        &mut self,
        cursor: &mut Cursor<'_>,
        start: usize,
        letter: u8,
        scope: &dyn Scope,
    ) -> Outcome<f64> {
        let is_length = LENGTHS.has(letter);
        let has_no_point = is_without_point(cursor);
        let value = word_value(cursor, start, is_length, scope)?;
        if has_no_point {
            self.pointless = self.pointless.and(Letters::one(letter));
        }
        // Q of threads and cycles counts in its own way, and so do the factors of G51.
        let is_factor = matches!(letter, b'I'..=b'K')
            && self
                .codes
                .frame
                .is_some_and(|frame| frame.code == FrameCode::Scale(true));
        if !is_length || letter == b'Q' || is_factor || !has_no_point {
            return Ok(value);
        }
        let span = SourceSpan::new(start, cursor.end_of_word());
        self.checked_length(letter, value, span)
    }

    /// A length without a decimal point, unless nobody knows what it counts; increments are counted when the block
    /// has all its codes.
    fn checked_length(&self, letter: u8, value: f64, span: SourceSpan) -> Outcome<f64> {
        match self.point {
            PointInput::Unsaid if value.abs() > MOST_WITHOUT_POINT => {
                Err(without_point(char::from(letter), value, span))
            }
            _ => Ok(value),
        }
    }

    /// `[#DEPTH]=5`: FANUC's variable of a name.
    pub(super) fn named_assignment(
        &mut self,
        cursor: &mut Cursor<'_>,
        scope: &dyn Scope,
    ) -> Outcome<()> {
        let start = cursor.at();
        cursor.advance();
        if cursor.next_visible() != Some(b'#') {
            return Err(bad_bracket(start));
        }
        let parameter = parameter(cursor, scope)?;
        let span = SourceSpan::new(start, cursor.end_of_word());
        if cursor.next_visible() != Some(b']') {
            return Err(bad_bracket(start));
        }
        cursor.advance();
        if cursor.next_visible() != Some(b'=') {
            return Err(bad_bracket(start));
        }
        cursor.advance();
        let value = open_expression(cursor, scope)?;
        self.any = true;
        self.assignments.push(Assignment {
            parameter,
            value,
            span,
        });
        Ok(())
    }

    /// `,C`, `,R` and `,A`; what SINUMERIK's words with longer names were rewritten into.
    pub(super) fn corner_word(
        &mut self,
        cursor: &mut Cursor<'_>,
        scope: &dyn Scope,
    ) -> Outcome<()> {
        let start = cursor.at();
        cursor.advance();
        let letter = cursor.next_visible().map(|byte| byte.to_ascii_uppercase());
        let is_siemens = self.dialect == Dialect::Siemens;
        let named = letter
            .and_then(Named::of_letter)
            .filter(|word| is_siemens || *word == Named::LineAngle);
        if let Some(word) = named {
            cursor.advance();
            let is_counted =
                !is_siemens && self.point == PointInput::Increment && is_without_point(cursor);
            let mut value = word_value(cursor, start, false, scope)?;
            let span = SourceSpan::new(start, cursor.end_of_word());
            if is_vacant(value) {
                return Ok(());
            }
            if is_counted {
                value *= OF_ANGLES;
            }
            self.any = true;
            self.says_modes |= matches!(
                word,
                Named::SpeedLimit | Named::UpperSpeed | Named::LowerSpeed | Named::SpindleAngle
            );
            return self.named.add(word, value, span);
        }
        let kind = match letter {
            Some(b'C') => CornerKind::Chamfer,
            Some(b'R') => CornerKind::Round,
            Some(b'L') if is_siemens => CornerKind::ChamferLength,
            Some(b'M') if is_siemens => CornerKind::RoundAll,
            _ => {
                let span = SourceSpan::new(start, cursor.at() + 1);
                return Err(refused(
                    "a word behind a comma",
                    "none that is known here",
                    "write the end of the move",
                    span,
                ));
            }
        };
        cursor.advance();
        let has_no_point = self.dialect == Dialect::Fanuc && is_without_point(cursor);
        let value = word_value(cursor, start, true, scope)?;
        let span = SourceSpan::new(start, cursor.end_of_word());
        if is_vacant(value) {
            return Ok(());
        }
        if has_no_point {
            let letter = letter.unwrap_or(b',');
            self.checked_length(letter, value, span)?;
        }
        if self.corner.is_some() {
            return Err(duplicate(',', span));
        }
        self.any = true;
        self.corner = Some(CornerWord {
            kind,
            value,
            has_no_point,
            span,
        });
        Ok(())
    }
}

/// True where the number that comes next has no decimal point, and is no expression.
pub(crate) fn is_without_point(cursor: &Cursor<'_>) -> bool {
    let mut written = *cursor;
    let mut any = false;
    loop {
        match written.next_visible() {
            Some(b'0'..=b'9') => any = true,
            Some(b'+' | b'-') if !any => {}
            Some(b'.' | b'#' | b'[') => return false,
            _ => return any,
        }
        written.advance();
    }
}

/// What a length without a decimal point is.
pub(crate) fn without_point_value(
    point: PointInput,
    letter: u8,
    value: f64,
    scope: &dyn Scope,
    span: SourceSpan,
) -> Outcome<f64> {
    match point {
        PointInput::Calculator => Ok(value),
        PointInput::Increment => Ok(value * scope.least_increment()),
        PointInput::Unsaid if value.abs() <= MOST_WITHOUT_POINT => Ok(value),
        PointInput::Unsaid => Err(without_point(char::from(letter), value, span)),
    }
}

/// Skips a comment whose `(` comes next, with the comments in it.
pub(super) fn skip_brackets(cursor: &mut Cursor<'_>) -> Outcome<()> {
    let start = cursor.at();
    let (mut depth, mut last) = (0_u32, None);
    for (offset, byte) in cursor.rest().iter().enumerate() {
        match byte {
            b'(' => depth += 1,
            b')' => {
                depth -= 1;
                last = Some(offset);
                if depth == 0 {
                    break;
                }
            }
            _ => {}
        }
    }
    // Where brackets are left open the last one that is closed ends the comment.
    match last {
        Some(last) => {
            cursor.seek(start + last + 1);
            Ok(())
        }
        None => cursor.skip_comment(),
    }
}

/// Whole numbers above this are millimetres on one control and micrometres on another.
const MOST_WITHOUT_POINT: f64 = 999.0;

#[cold]
fn bad_bracket(at: usize) -> Box<BlockDiagnostic> {
    let span = SourceSpan::new(at, at + 1);
    BlockDiagnostic::new(
        DiagnosticCode::BadCharacter,
        span,
        "`[` has no meaning here",
    )
    .because("in front of `=` it is around the name of a variable: [#DEPTH]=5")
    .help("write the letter of the word in front, or remove it")
}

#[cold]
pub(crate) fn without_point(letter: char, value: f64, span: SourceSpan) -> Box<BlockDiagnostic> {
    let message = format!("{letter}{value} has no decimal point");
    BlockDiagnostic::new(DiagnosticCode::AmbiguousWord, span, message)
        .because("it is millimetres on one control, and least increments (0.001 mm) on another")
        .help("write the point, or say which it is: `point` of [program] in the configuration")
}

/// Refuses another block behind the end of one (`;` of a FANUC), which would be left out; the cursor stands at
/// the end. Text that does not begin as a block is a comment.
pub(super) fn check_behind_end_of_block(mut cursor: Cursor<'_>) -> Outcome<()> {
    cursor.advance();
    let start = cursor.next_visible().map(|_| cursor.at());
    let bare: Vec<u8> = cursor
        .rest()
        .iter()
        .filter(|byte| !byte.is_ascii_whitespace())
        .copied()
        .collect();
    let is_block = match bare.as_slice() {
        [b'#', ..] => true,
        [letter, next, ..] => {
            letter.is_ascii_alphabetic() && (next.is_ascii_digit() || b"+-.#[".contains(next))
        }
        _ => false,
    };
    match start {
        Some(at) if is_block => {
            let span = SourceSpan::new(at, at + 1);
            Err(
                BlockDiagnostic::new(DiagnosticCode::UnusedWord, span, "a second block in a line")
                    .because("`;` ends the block, and what stands behind it would not be executed")
                    .help("write each block on a line of its own, and comments in parentheses"),
            )
        }
        _ => Ok(()),
    }
}

/// Refuses a second command in the line of a printer's program, which its firmware would not execute; the
/// cursor stands at a word.
pub(super) fn check_one_command(
    has_command: &mut bool,
    letter: u8,
    cursor: Cursor<'_>,
) -> Outcome<()> {
    match letter {
        b'G' | b'M' if *has_command => {
            let span = SourceSpan::new(cursor.at(), cursor.at() + 1);
            Err(BlockDiagnostic::new(
                DiagnosticCode::UnusedWord,
                span,
                "a second command in a line",
            )
            .because("the firmware of a printer executes the first command of a line alone")
            .help("give it a line of its own"))
        }
        b'G' | b'M' | b'T' => {
            *has_command = true;
            Ok(())
        }
        _ => Ok(()),
    }
}
