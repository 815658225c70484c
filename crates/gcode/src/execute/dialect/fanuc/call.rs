//! FANUC's subprograms: G65, G66, M97, M98 and M99.
//!
//! Where a program is looked for is in [`super::numbered_program`] and [`super::named_program`].
//! Arguments of G65 are the parameters of their letters (A is #1, X is #24); M98 shares those of its
//! caller.

use std::io::BufRead;
use std::sync::Arc;

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::execute::dialect::fanuc::arguments::CallWords;
use crate::execute::dialect::macro_call::Arguments;
use crate::execute::dialect::tape::{SubprogramCall, TapeLine, TapePlace};
use crate::execute::flow::activation::MAX_CALLS;
use crate::execute::line_origin::{LineOrigin, SourceLine};
use crate::execute::program::{Program, is_percent};
use crate::setup::subroutine_file::SubroutineFile;
use crate::syntax::cursor::Cursor;
use crate::syntax::dialect::fanuc::{Call, CallCode, Statement, is_numbered, statement};
use crate::syntax::expression::value::value;
use crate::syntax::line_source::LineSource;
use crate::syntax::word_check::missing;

impl<R: BufRead> Program<R> {
    /// The codes that call, and M99.
    pub(super) fn fanuc_call(&mut self, text: &[u8], call: Call) -> Outcome<bool> {
        let span = SourceSpan::new(call.start, call.end);
        match call.code {
            CallCode::Return => return self.fanuc_return(text, call),
            CallCode::EndModalMacro => return self.end_modal_macro(text, call),
            CallCode::MacroOfEachBlock => {
                let message = "G66.1 (a macro behind every block) is not supported";
                return Err(
                    BlockDiagnostic::new(DiagnosticCode::NotSupported, span, message)
                        .because("its blocks are arguments, and not words")
                        .help("write G65 in their place"),
                );
            }
            CallCode::Macro | CallCode::ModalMacro | CallCode::Subprogram | CallCode::Local => {}
        }
        let is_macro = matches!(call.code, CallCode::Macro | CallCode::ModalMacro);
        let words = self.call_words(text, call.end, is_macro)?;
        let is_local = call.code == CallCode::Local;
        let names_program = words.program.is_some() || words.name.is_some();
        let block = match words.block {
            Some(_) if is_local || names_program => return Err(begins_inside(span)),
            None if is_local && words.name.is_none() => words.program,
            block => block,
        };
        if let Some(block) = block {
            let first = self.fanuc_block_numbered(block, span)?;
            return self
                .enter_subprogram(first, words.turns, None)
                .map(|()| true);
        }
        let program = match (words.program, &words.name) {
            (Some(_), Some(_)) => {
                let message = "a number and a name of the program in one call";
                return Err(
                    BlockDiagnostic::new(DiagnosticCode::AmbiguousWord, span, message)
                        .because("they may be of two programs")
                        .help("write P, or the name in < >"),
                );
            }
            (Some(program), None) => program,
            (None, Some(name)) if !is_local => {
                let first = self.fanuc_program_named(name, span)?;
                return self.enter_called(first, words.turns, &words, call.code, span);
            }
            (None, _) => return Err(missing(span, "the call", "P", "the program's number")),
        };
        let (first, turns) = self.fanuc_program_and_turns(program, &words, span)?;
        self.enter_called(first, turns, &words, call.code, span)
    }

    /// Goes to the program of a call, or keeps it for the moves that follow.
    fn enter_called(
        &mut self,
        first: TapePlace,
        turns: u32,
        words: &CallWords,
        code: CallCode,
        span: SourceSpan,
    ) -> Outcome<bool> {
        if code == CallCode::ModalMacro {
            return self
                .begin_modal_macro(first, turns, words.arguments, span)
                .map(|()| true);
        }
        let arguments = words.is_macro.then_some(&words.arguments);
        self.enter_subprogram(first, turns, arguments)
            .map(|()| true)
    }

    /// Goes to a subprogram, with arguments of its own or with the parameters of its caller.
    pub(super) fn enter_subprogram(
        &mut self,
        first: TapePlace,
        turns: u32,
        arguments: Option<&Arguments>,
    ) -> Outcome<()> {
        if self.tape.calls.len() >= MAX_CALLS {
            let message = format!("more than {MAX_CALLS} calls in each other");
            let span = SourceSpan::default();
            return Err(
                BlockDiagnostic::new(DiagnosticCode::CallDepth, span, message)
                    .because("the depth of calls is bounded")
                    .help("check what should end the recursion"),
            );
        }
        if turns == 0 {
            return Ok(());
        }
        self.tape.calls.push(SubprogramCall {
            first,
            back: self.tape.place(),
            called_from: self.line_of_program(),
            again: turns - 1,
            caller: self.interpreter.state.fanuc.program,
            own_parameters: arguments.is_some(),
            keeps_locals: false,
        });
        self.tape.go_to(first);
        let head = first
            .line
            .checked_sub(1)
            .and_then(|line| self.tape.get(line));
        if let Some(Statement::Label(program)) = head.map(|(_, text)| statement(text).0) {
            self.interpreter.state.fanuc.program = program;
        }
        if let Some(arguments) = arguments {
            self.parameters.enter(arguments);
        }
        Ok(())
    }

    /// The block of that number in the text that is executed: M97 P, M98 Q.
    fn fanuc_block_numbered(&mut self, number: u32, span: SourceSpan) -> Outcome<TapePlace> {
        let text = self.tape.place().text;
        let wanted = |line: &[u8]| is_numbered(line, number);
        let line = self.tape.search(0, &mut self.source, wanted, |_| false)?;
        line.map(|line| TapePlace { text, line }).ok_or_else(|| {
            let message = format!("there is no block N{number} in the program");
            BlockDiagnostic::new(DiagnosticCode::UnknownSubroutine, span, message)
                .because("M97 P and M98 Q call blocks of the same program, from that number to M99")
                .help("add the block number, or write M98 P for another program")
        })
    }

    /// The end of the text: of the program, or of a subprogram, which should have had M99 before.
    pub(crate) fn fanuc_end(&mut self) -> Outcome<bool> {
        let file = self.tape.file().map(Arc::clone);
        if file.is_none() && self.tape.calls.is_empty() {
            return self.end_of_input();
        }
        let last = self.tape.next.saturating_sub(1);
        let (number, text) = self.tape.get(last).cloned().unwrap_or_default();
        let fault = not_returned(&text);
        self.origin = LineOrigin::Past(SourceLine { file, number, text });
        self.end();
        Err(fault)
    }

    /// Refuses words behind a statement.
    fn nothing_behind(&self, text: &[u8], at: usize) -> Outcome<()> {
        let mut cursor = Cursor::new(text);
        cursor.seek(at);
        if matches!(cursor.next_visible(), None | Some(b'(' | b';' | b'%')) {
            return Ok(());
        }
        let span = SourceSpan::new(cursor.at(), text.len());
        Err(
            BlockDiagnostic::new(DiagnosticCode::NotSupported, span, "words behind M99")
                .because("it ends a subprogram, and takes no word but P")
                .help("write them into a block of their own"),
        )
    }

    /// M99: back to the caller, to behind the call or to the block that P names.
    fn fanuc_return(&mut self, text: &[u8], code: Call) -> Outcome<bool> {
        let mut cursor = Cursor::new(text);
        cursor.seek(code.end);
        let mut target = None;
        if matches!(cursor.next_visible(), Some(b'P' | b'p')) {
            let start = cursor.at();
            cursor.advance();
            target = Some((self.fanuc_number(text, start + 1, false)?, start));
            value(&mut cursor, start, &self.scope())?;
        }
        self.nothing_behind(text, cursor.at())?;
        let Some(call) = self.tape.calls.last_mut() else {
            let span = SourceSpan::new(code.start, code.end);
            let message = "M99 in the program itself, which would begin it again";
            return Err(
                BlockDiagnostic::new(DiagnosticCode::NotSupported, span, message)
                    .because("a program that repeats itself never ends")
                    .help("write M30; start the program again for the next part"),
            );
        };
        if call.again > 0 && target.is_none() {
            call.again -= 1;
            let first = call.first;
            self.tape.go_to(first);
            return Ok(true);
        }
        let call = *call;
        self.tape.calls.pop();
        self.tape.go_to(call.back);
        self.interpreter.state.fanuc.program = call.caller;
        if call.own_parameters {
            if call.keeps_locals {
                self.keep_locals_of_modal_macro();
            }
            self.parameters.leave(None);
        }
        if let Some((target, at)) = target {
            self.fanuc_go_to(call.back.line.saturating_sub(1), target, at)?;
        }
        Ok(true)
    }
}

/// A subprogram that runs into its end or into the next one; `text` is the line there.
pub(super) fn not_returned(text: &[u8]) -> Box<BlockDiagnostic> {
    let span = SourceSpan::new(0, text.len());
    let message = "the subprogram is not ended";
    BlockDiagnostic::new(DiagnosticCode::FlowStructure, span, message)
        .because("a subprogram that was called leads back by M99")
        .help("write M99 at its end")
}

impl<R: BufRead> Program<R> {
    /// Where the text of a file begins on the tape, onto which it is taken if it is not there yet.
    pub(crate) fn start_of_file(&mut self, file: &SubroutineFile) -> Outcome<TapePlace> {
        let text = match self.tape.text_of(&file.name) {
            Some(text) => text,
            None => {
                let lines = lines_of(file).map_err(|(fault, line)| {
                    self.origin = LineOrigin::Past(line);
                    fault
                })?;
                self.tape.take_up(Arc::clone(&file.name), lines)
            }
        };
        Ok(TapePlace { text, line: 0 })
    }
}

/// The lines of a file, from percent sign to percent sign.
fn lines_of(file: &SubroutineFile) -> Result<Vec<TapeLine>, (Box<BlockDiagnostic>, SourceLine)> {
    let mut source = LineSource::new(&*file.text);
    let mut lines = Vec::new();
    loop {
        let more = source.advance().map_err(|fault| {
            let line = SourceLine {
                file: Some(Arc::clone(&file.name)),
                ..SourceLine::new(source.number(), source.text())
            };
            (fault, line)
        })?;
        if !more || is_percent(source.text()) && !lines.is_empty() {
            return Ok(lines);
        }
        if !is_percent(source.text()) {
            lines.push((source.number(), source.text().into()));
        }
    }
}

#[cold]
fn begins_inside(span: SourceSpan) -> Box<BlockDiagnostic> {
    let message = "Q, a block, beside the program of a call";
    BlockDiagnostic::new(DiagnosticCode::NotSupported, span, message)
        .because("subprograms begin at their first block here; Q by itself calls blocks of the same program")
        .help("write M98 P, or M98 Q by itself")
}
