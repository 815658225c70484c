//! Lines of a FANUC program: macro statements and jumps.
//!
//! A jump looks for its block number from the next line to the end of the program, then from its
//! beginning. Where subprograms are is in [`super::call`].

use std::io::BufRead;

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::execute::dialect::fanuc::call::not_returned;
use crate::execute::program::{Program, is_percent};
use crate::execute::scope::ProgramScope;
use crate::syntax::codes::Coded;
use crate::syntax::cursor::Cursor;
use crate::syntax::dialect::fanuc::{Statement, block_number, is_label, is_numbered, statement};
use crate::syntax::dialect::line_body::{body, starts_with_word};
use crate::syntax::expression::vacant::{is_vacant, or_zero};
use crate::syntax::expression::value::value;
use crate::syntax::modes::Motion;

/// The text with blanks in the place of its first bytes, which keeps the columns of the rest.
fn without_head(text: &[u8], length: usize) -> Vec<u8> {
    let mut rest = vec![b' '; length];
    rest.extend_from_slice(text.get(length..).unwrap_or_default());
    rest
}

/// True for what stands behind a program number where it is more than a comment.
fn has_words(behind: Option<&[u8]>) -> bool {
    let text = behind.unwrap_or_default().trim_ascii();
    !matches!(text, [] | [b'(' | b';', ..])
}

/// A program number with words behind it, inside of a program that has not ended.
#[cold]
fn numbered_block(text: &[u8], at: usize) -> Box<BlockDiagnostic> {
    let start = body(text);
    let message = "a program number in the middle of a program";
    BlockDiagnostic::new(
        DiagnosticCode::FlowStructure,
        SourceSpan::new(start, at.max(start)),
        message,
    )
    .because("another program begins here (: is O), and the one before has not ended by M30 or M99")
    .help("write N and the number of the block, or M30 before it")
}

/// Most lines in front of the first percent sign.
const MOST_LEADER: usize = 200;

/// True for a line that begins as a block or a statement does, or with a comment.
fn is_block(text: &[u8]) -> bool {
    match text.trim_ascii() {
        [b'(' | b'/' | b'#' | b':' | b'<', ..] => true,
        [letter, rest @ ..] if letter.is_ascii_alphabetic() => {
            let next = rest.iter().find(|byte| !byte.is_ascii_whitespace());
            let is_word =
                next.is_some_and(|byte| byte.is_ascii_digit() || b"+-.#[<".contains(byte));
            is_word || !matches!(statement(text).0, Statement::Block)
        }
        _ => false,
    }
}

/// The text up to the first `/` that is in no brackets.
fn without_deleted(text: &[u8]) -> &[u8] {
    let mut depth = 0_u32;
    let deleted = text.iter().position(|byte| {
        match byte {
            b'(' | b'[' => depth += 1,
            b')' | b']' => depth = depth.saturating_sub(1),
            _ => {}
        }
        *byte == b'/' && depth == 0
    });
    // What is divided without brackets is no switch.
    let is_assignment = text.contains(&b'=');
    match deleted {
        Some(at)
            if !is_assignment || text.get(..at).unwrap_or_default().trim_ascii().is_empty() =>
        {
            text.get(..at).unwrap_or_default()
        }
        _ => text,
    }
}

pub(super) fn fault(span: SourceSpan, message: impl Into<String>) -> Box<BlockDiagnostic> {
    BlockDiagnostic::new(DiagnosticCode::FlowStructure, span, message)
        .because("IF, WHILE, GOTO and the calls have a line of their own each, in a fixed form")
}

#[cold]
fn no_number(text: &[u8], span: SourceSpan) -> Box<BlockDiagnostic> {
    if is_macro_a(text) {
        let message = "G65 H of custom macro A is not read";
        return BlockDiagnostic::new(DiagnosticCode::FlowStructure, span, message)
            .because("its P is the variable of the result, and here the number of a program")
            .help("write `G65 H2 P#100 Q#101 R#102` as #100=#101+#102");
    }
    let name = text.get(span.start..span.start + span.length);
    let name = String::from_utf8_lossy(name.unwrap_or_default().trim_ascii()).into_owned();
    let message = format!("{name} has no value");
    BlockDiagnostic::new(DiagnosticCode::FlowStructure, span, message)
        .because("programs, blocks, loops and turns are numbered")
        .help("assign the variable before it")
}

/// True for a block of G65 with H.
fn is_macro_a(text: &[u8]) -> bool {
    let code = text.split(|byte| *byte == b'(').next().unwrap_or_default();
    let calls = code
        .windows(3)
        .any(|word| word.eq_ignore_ascii_case(b"G65"));
    calls && code.iter().any(|byte| byte.eq_ignore_ascii_case(&b'H'))
}

impl<R: BufRead> Program<R> {
    /// Reads and executes the next line; false at the end.
    pub(crate) fn read_fanuc(&mut self) -> Outcome<bool> {
        if self.source.number() == 0 {
            self.skip_leader()?;
        }
        if self.finishing.is_some() {
            self.end_finishing()?;
            if !self.items.is_empty() {
                return Ok(true);
            }
        }
        if !self.tape.advance(&mut self.source)? {
            return self.fanuc_end();
        }
        let index = self.tape.next - 1;
        let Some((number, text)) = self.tape.get(index).cloned() else {
            return self.end_of_input();
        };
        self.set_tape_origin(number, &text);
        let number = self.line_of_program();
        if self.tape.is_again() {
            self.count_idle().inspect_err(|_| self.end())?;
        }
        let fanuc = &mut self.interpreter.state.fanuc;
        fanuc.sequence = self.sequence.take().unwrap_or(fanuc.sequence);
        self.sequence = block_number(&text);
        // Nearly all lines of a long program are plain.
        if self.block.parse_plain_fanuc(&text) {
            return self.fanuc_block(number, Ok(()));
        }
        let text = if self.interpreter.options.block_delete {
            match without_deleted(&text) {
                [] => return Ok(true),
                text => text.into(),
            }
        } else {
            text
        };
        let (statement, at) = statement(&text);
        let is_own = matches!(
            statement,
            Statement::Block | Statement::Label(_) | Statement::Name
        );
        self.begun |= !is_own;
        match statement {
            Statement::Block => return self.fanuc_text(number, &text),
            Statement::Label(_) | Statement::Name if !self.tape.calls.is_empty() => {
                self.end();
                return Err(not_returned(&text));
            }
            Statement::Label(_) | Statement::Name if self.begun => return self.end_at(&text, at),
            Statement::Label(_) | Statement::Name => {
                if let Statement::Label(program) = statement {
                    self.interpreter.state.fanuc.program = program;
                }
                return self.fanuc_text(number, &without_head(&text, at));
            }
            Statement::If => {
                if let Some(then) = self.fanuc_if(&text, at).inspect_err(|_| self.end())? {
                    return self.fanuc_text(number, &without_head(&text, then));
                }
            }
            // Other words of the block come first.
            Statement::Call(call) => {
                let beside = self.beside_call(&text, call).inspect_err(|_| self.end())?;
                if body(&beside) < beside.trim_ascii_end().len() {
                    self.execute_text(number, &beside)?;
                    let span = SourceSpan::new(call.start, call.end);
                    self.check_move_beside_call(span)
                        .inspect_err(|_| self.end())?;
                }
                return self.fanuc_call(&text, call).inspect_err(|_| self.end());
            }
            Statement::Print | Statement::Names | Statement::Device => {
                self.fanuc_device(statement, &text, at)?;
            }
            // What follows depends on it, so a diagnostic ends the program.
            _ => {
                return self
                    .fanuc_flow(statement, index, &text, at)
                    .inspect_err(|_| self.end());
            }
        }
        Ok(true)
    }

    /// Passes over the text in front of the first percent sign, which is no part of the program:
    /// lines of which none begins as a block does, and behind the sign there are more.
    fn skip_leader(&mut self) -> Outcome<()> {
        let mut index = 0;
        while index < MOST_LEADER && self.tape.reach(index, &mut self.source)? {
            let text = self.tape.get(index).map_or(&[][..], |(_, text)| text);
            if is_percent(text) {
                if index > 0 && self.tape.reach(index + 1, &mut self.source)? {
                    self.tape.next = index;
                }
                return Ok(());
            }
            if is_block(text) {
                return Ok(());
            }
            index += 1;
        }
        Ok(())
    }

    /// Executes a text as a block, and the macro that is called behind it.
    pub(super) fn fanuc_text(&mut self, number: u32, text: &[u8]) -> Outcome<bool> {
        self.interpreter.line = number;
        let scope = ProgramScope {
            parameters: &self.parameters,
            interpreter: &self.interpreter,
        };
        let parsed = self.block.parse(text, &scope);
        self.fanuc_block(number, parsed)
    }

    fn fanuc_block(&mut self, number: u32, mut parsed: Outcome<()>) -> Outcome<bool> {
        if parsed.is_ok() && self.block.is_lathe {
            let motion = self.block.codes.motion;
            let motion = motion.map_or(self.interpreter.state.modal.motion, |coded| coded.code);
            let machine = self.interpreter.options.machine;
            parsed = self.block.take_words_of_lathes(motion, machine);
        }
        if parsed.is_ok() && self.has_vectors() {
            let motion = self.block.codes.motion;
            let motion = motion.map_or(self.interpreter.state.modal.motion, |coded| coded.code);
            parsed = self.block.take_vector(motion);
        }
        if parsed.is_ok()
            && self.block.is_lathe
            && let Some(Coded {
                code: Some(Motion::Lathe(cycle)),
                ..
            }) = self.block.codes.motion
        {
            return self.whole_statement(|program| program.lathe_profile_cycle(cycle, number));
        }
        let goes_on = self.execute_parsed(number, parsed)?;
        if goes_on && self.modal_macro.is_some() && !self.ended {
            self.call_modal_macro()?;
        }
        Ok(goes_on)
    }

    /// True where G43.5 is in force for the block.
    fn has_vectors(&self) -> bool {
        let codes = &self.block.codes;
        match codes.tool_length {
            Some(_) => codes.tip_by_vector,
            None => self.interpreter.state.fanuc.tip_by_vector,
        }
    }

    /// Executes a statement other than IF.
    fn fanuc_flow(
        &mut self,
        statement: Statement,
        index: usize,
        text: &[u8],
        at: usize,
    ) -> Outcome<bool> {
        match statement {
            Statement::Goto => {
                let target = self.fanuc_number(text, at, true)?;
                self.fanuc_go_to(index, target, at)?;
            }
            Statement::While => self.fanuc_while(index, text, at)?,
            Statement::End => self.fanuc_end_of_loop(index, text, at)?,
            _ => {}
        }
        Ok(true)
    }

    /// The next program of the file: the one before has ended without M30. Posts write `:30 T6 M6` for a block
    /// that may be searched for, which is none.
    fn end_at(&mut self, text: &[u8], at: usize) -> Outcome<bool> {
        if has_words(text.get(at..)) {
            self.end();
            return Err(numbered_block(text, at));
        }
        self.end_of_input()
    }

    /// A whole number at `at`, computed or not; nothing may follow if it is the `last`.
    pub(super) fn fanuc_number(&self, text: &[u8], at: usize, last: bool) -> Outcome<u32> {
        let mut cursor = Cursor::new(text);
        cursor.seek(at);
        let number = value(&mut cursor, at.saturating_sub(1), &self.scope())?;
        let behind = cursor.next_visible();
        if last && !matches!(behind, None | Some(b'(' | b';')) {
            let span = SourceSpan::new(cursor.at(), text.len());
            return Err(fault(span, "text behind the statement").help("remove it"));
        }
        let span = SourceSpan::new(at, cursor.end_of_word());
        if is_vacant(number) {
            return Err(no_number(text, span));
        }
        if number.fract() != 0.0 || !(0.0..=99_999_999.0).contains(&number) {
            let message = format!("{number} is no block, loop or program number");
            return Err(fault(span, message).help("write a whole number"));
        }
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "range checked"
        )]
        Ok(number as u32)
    }

    /// The condition in brackets at `at`, and where what follows it starts.
    pub(super) fn fanuc_condition(&self, text: &[u8], at: usize) -> Outcome<(bool, usize)> {
        let mut cursor = Cursor::new(text);
        cursor.seek(at);
        if cursor.next_visible() != Some(b'[') {
            return Err(fault(
                SourceSpan::new(at, cursor.at() + 1),
                "a condition is missing",
            )
            .help("write it in brackets: [#1 EQ 2]"));
        }
        let holds = or_zero(value(&mut cursor, at, &self.scope())?) != 0.0;
        while cursor.next_visible() == Some(b'(') {
            cursor.skip_comment()?;
        }
        Ok((holds, cursor.at()))
    }

    /// IF: jumps, or gives where the assignment behind THEN starts.
    fn fanuc_if(&mut self, text: &[u8], at: usize) -> Outcome<Option<usize>> {
        let (holds, then) = self.fanuc_condition(text, at)?;
        let rest = text.get(then..).unwrap_or_default();
        if starts_with_word(rest, b"GOTO") {
            let target = self.fanuc_number(text, then + 4, true)?;
            if holds {
                self.fanuc_go_to(self.tape.next - 1, target, then)?;
            }
            return Ok(None);
        }
        if starts_with_word(rest, b"THEN") {
            return Ok(holds.then_some(then + 4));
        }
        Err(fault(
            SourceSpan::new(then, text.len().max(then + 1)),
            "IF without GOTO or THEN",
        )
        .help("write `IF [condition] GOTO n` or `IF [condition] THEN #i = value`"))
    }

    pub(super) fn fanuc_go_to(&mut self, index: usize, number: u32, at: usize) -> Outcome<()> {
        if let Some(block) = self.tape.known_jump(index, number) {
            self.tape.next = block;
            return Ok(());
        }
        let wanted = |line: &[u8]| is_numbered(line, number);
        let ahead = self
            .tape
            .search(index + 1, &mut self.source, wanted, is_label)?;
        let found = ahead.or_else(|| self.tape.search_back(index + 1, wanted, is_label));
        let found = found.ok_or_else(|| {
            let message = format!("there is no block N{number} in the program");
            fault(SourceSpan::new(at, at + 4), message)
                .help("add the block number, or correct the jump")
        })?;
        self.tape.jump(index, number, found);
        Ok(())
    }
}
