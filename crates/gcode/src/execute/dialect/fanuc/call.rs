//! FANUC's subprograms: G65, G66, M97, M98 and M99.
//!
//! A subprogram is looked for in the text of its caller, from its O number to M99 or M30, then in
//! the program itself, then in a file: program 20 in `O0020`, `O20` or `20`, as it is or with `.nc`
//! behind it, in capitals or not ([`file_names`] has the order). Of a file the lines from its
//! O number on are executed, or all of them if it has none. Arguments of G65 are the parameters of
//! their letters (A is #1, X is #24); M98 shares those of its caller.

use std::io::BufRead;
use std::sync::Arc;

use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::fault::{Fault, Outcome};
use crate::diagnostic::span::SourceSpan;
use crate::execute::dialect::fanuc::arguments::CallWords;
use crate::execute::dialect::macro_call::Arguments;
use crate::execute::dialect::tape::{SubprogramCall, TapeLine, TapePlace};
use crate::execute::flow::activation::MAX_CALLS;
use crate::execute::flow::load::unusable;
use crate::execute::line_origin::{LineOrigin, SourceLine};
use crate::execute::program::{Program, is_percent};
use crate::setup::subroutine_file::{NoSubroutineFile, NotTaken, SubroutineFile, Subroutines};
use crate::syntax::cursor::Cursor;
use crate::syntax::dialect::fanuc::{Call, CallCode, Statement, is_numbered, statement};
use crate::syntax::expression::value::value;
use crate::syntax::line_source::LineSource;
use crate::syntax::word_check::missing;

/// The files that program may be in, in the order in which they are looked for.
fn file_names(program: u32) -> impl Iterator<Item = String> {
    let stems = [
        format!("O{program:04}"),
        format!("O{program:05}"),
        format!("O{program}"),
        format!("o{program:04}"),
        format!("o{program}"),
        format!("{program:04}"),
        format!("{program}"),
    ];
    let mut names = Vec::new();
    for ending in ["", ".nc", ".NC"] {
        for stem in &stems {
            let name = format!("{stem}{ending}");
            if !names.contains(&name) {
                names.push(name);
            }
        }
    }
    names.into_iter()
}

/// The file of a program.
fn find(subroutines: &Subroutines, program: u32) -> Result<SubroutineFile, NotTaken> {
    let mut missing = NotTaken::None(NoSubroutineFile::Missing {
        looked_in: Vec::new(),
    });
    for name in file_names(program) {
        match subroutines.get(&name) {
            Err(none @ NotTaken::None(NoSubroutineFile::Missing { .. })) => missing = none,
            found => return found,
        }
    }
    Err(missing)
}

impl<R: BufRead> Program<R> {
    /// The codes that call, and M99.
    pub(super) fn fanuc_call(&mut self, text: &[u8], call: Call) -> Outcome<bool> {
        let span = SourceSpan::new(call.start, call.end);
        match call.code {
            CallCode::Return => return self.fanuc_return(text, call),
            CallCode::EndModalMacro => {
                self.end_modal_macro();
                return self.nothing_behind(text, call.end).map(|()| true);
            }
            CallCode::MacroOfEachBlock => {
                let message = "G66.1 (a macro behind every block) is not supported";
                return Err(Fault::new(DiagnosticCode::NotSupported, span, message)
                    .because("its blocks are arguments, and not words")
                    .help("write G65 in their place"));
            }
            CallCode::Macro | CallCode::ModalMacro | CallCode::Subprogram | CallCode::Local => {}
        }
        let is_macro = matches!(call.code, CallCode::Macro | CallCode::ModalMacro);
        let words = self.call_words(text, call.end, is_macro)?;
        let program = match (words.program, &words.name) {
            (Some(_), Some(_)) => {
                let message = "a number and a name of the program in one call";
                return Err(Fault::new(DiagnosticCode::AmbiguousWord, span, message)
                    .because("they may be of two programs")
                    .help("write P, or the name in < >"));
            }
            (Some(program), None) => program,
            (None, Some(name)) if call.code != CallCode::Local => {
                let first = self.fanuc_program_named(name, span)?;
                return self.enter_called(first, words.turns, &words, call.code, span);
            }
            (None, _) => return Err(missing(span, "the call", "P", "the program's number")),
        };
        if call.code == CallCode::Local {
            let first = self.fanuc_block_numbered(program, span)?;
            return self
                .enter_subprogram(first, words.turns, None)
                .map(|()| true);
        }
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
            return Err(Fault::new(DiagnosticCode::CallDepth, span, message)
                .because("the depth of calls is bounded")
                .help("check what should end the recursion"));
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

    /// The block of that number in the text that is executed: M97.
    fn fanuc_block_numbered(&mut self, number: u32, span: SourceSpan) -> Outcome<TapePlace> {
        let text = self.tape.place().text;
        let wanted = |line: &[u8]| is_numbered(line, number);
        let line = self.tape.search(0, &mut self.source, wanted, |_| false)?;
        line.map(|line| TapePlace { text, line }).ok_or_else(|| {
            let message = format!("there is no block N{number} in the program");
            Fault::new(DiagnosticCode::UnknownSubroutine, span, message)
                .because("M97 calls blocks of the same program, from that number to M99")
                .help("add the block number, or write M98 for another program")
        })
    }

    /// Where a program begins, and how often it runs: of a number with more than four digits the
    /// first ones count repetitions where there is no such program.
    fn fanuc_program_and_turns(
        &mut self,
        program: u32,
        words: &CallWords,
        span: SourceSpan,
    ) -> Outcome<(TapePlace, u32)> {
        let found = self.fanuc_program(program, span);
        let (turns, number) = (program / 10_000, program % 10_000);
        if found.is_ok() || turns == 0 || number == 0 || words.says_turns || words.is_macro {
            return found.map(|place| (place, words.turns));
        }
        match self.fanuc_program(number, span) {
            Ok(place) => Ok((place, turns)),
            Err(_) => found.map(|place| (place, words.turns)),
        }
    }

    /// Where that program begins: its first line.
    fn fanuc_program(&mut self, program: u32, span: SourceSpan) -> Outcome<TapePlace> {
        let here = self.tape.place();
        if let Some(place) = self.tape.known_program(program) {
            return Ok(place);
        }
        let mut texts = vec![here.text, 0];
        texts.dedup();
        let mut found = None;
        for text in texts {
            self.tape.go_to(TapePlace { text, line: 0 });
            let wanted = |line: &[u8]| statement(line).0 == Statement::Label(program);
            let label = self.tape.search(0, &mut self.source, wanted, |_| false);
            self.tape.go_to(here);
            if let Some(label) = label? {
                let line = label + 1;
                found = Some(TapePlace { text, line });
                break;
            }
        }
        let place = match found {
            Some(place) => place,
            None => self.fanuc_file(program, span)?,
        };
        self.tape.remember_program(program, place);
        Ok(place)
    }

    /// The program of that number in a file of its own.
    fn fanuc_file(&mut self, program: u32, span: SourceSpan) -> Outcome<TapePlace> {
        let Some(subroutines) = &self.interpreter.options.subroutines else {
            return Err(unknown(program, span, &[]));
        };
        let file = find(subroutines, program).map_err(|why| match why {
            NotTaken::None(NoSubroutineFile::Missing { looked_in }) => {
                unknown(program, span, &looked_in)
            }
            why => unusable(&format!("program O{program}"), span, why),
        })?;
        let text = match self.tape.text_of(&file.name) {
            Some(text) => text,
            None => {
                let lines = lines_of(&file).map_err(|(fault, line)| {
                    self.origin = LineOrigin::Past(line);
                    fault
                })?;
                self.tape.take_up(Arc::clone(&file.name), lines)
            }
        };
        let here = self.tape.place();
        self.tape.go_to(TapePlace { text, line: 0 });
        let mut others = false;
        let wanted = |line: &[u8]| match statement(line).0 {
            Statement::Label(number) => {
                others |= number != program;
                number == program
            }
            _ => false,
        };
        let label = self.tape.search(0, &mut self.source, wanted, |_| false);
        self.tape.go_to(here);
        match label? {
            Some(label) => Ok(TapePlace {
                text,
                line: label + 1,
            }),
            None if others => {
                let message = format!("{} has other programs than O{program}", file.name);
                Err(Fault::new(DiagnosticCode::UnknownSubroutine, span, message)
                    .because("the O numbers in a file say which programs it has")
                    .help(format!(
                        "write O{program} at its beginning, or remove the O numbers"
                    )))
            }
            None => Ok(TapePlace { text, line: 0 }),
        }
    }

    /// The end of the text: of the program, or of a file, which should have had M99 before.
    pub(super) fn fanuc_end(&mut self) -> Outcome<bool> {
        let Some(file) = self.tape.file() else {
            return self.end_of_input();
        };
        let file = Some(Arc::clone(file));
        let last = self.tape.next.saturating_sub(1);
        let (number, text) = self.tape.get(last).cloned().unwrap_or_default();
        let fault = not_returned(&text);
        self.origin = LineOrigin::Past(SourceLine { file, number, text });
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
        Err(Fault::new(
            DiagnosticCode::NotSupported,
            span,
            "words behind M99 or G67",
        )
        .because("they end a subprogram or a macro, and take no words but P")
        .help("write them into a block of their own"))
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
            return Err(Fault::new(DiagnosticCode::NotSupported, span, message)
                .because("a program that repeats itself never ends")
                .help("write M30; start the program again for the next part"));
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
            self.parameters.leave(None);
        }
        if let Some((target, at)) = target {
            self.fanuc_go_to(call.back.line.saturating_sub(1), target, at)?;
        }
        Ok(true)
    }
}

/// A subprogram that runs into its end or into the next one; `text` is the line there.
pub(super) fn not_returned(text: &[u8]) -> Box<Fault> {
    let span = SourceSpan::new(0, text.len());
    let message = "the subprogram is not ended";
    Fault::new(DiagnosticCode::FlowStructure, span, message)
        .because("a subprogram that was called leads back by M99")
        .help("write M99 at its end")
}

/// The lines of a file, from percent sign to percent sign.
pub(crate) fn lines_of(file: &SubroutineFile) -> Result<Vec<TapeLine>, (Box<Fault>, SourceLine)> {
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

fn unknown(program: u32, span: SourceSpan, looked_in: &[String]) -> Box<Fault> {
    let message = format!("there is no program O{program}");
    let fault = Fault::new(DiagnosticCode::UnknownSubroutine, span, message);
    let fault = if looked_in.is_empty() {
        fault.because(
            "it is not in the text of its caller, and there is no folder to look for it in",
        )
    } else {
        fault.because(format!(
            "it is not in the text of its caller, and there is no file O{program:04}, O{program} or \
             {program}, with or without .nc, in {}",
            looked_in.join(", ")
        ))
    };
    if program > 9999 {
        return fault.help(format!(
            "if its first digits are repetitions, write M98 P{} L{}; else add the program or its \
             folder",
            program % 10_000,
            program / 10_000
        ));
    }
    fault.help(
        "copy it behind the end of this program, or give the folder of its file: --subroutine-path, \
         or `subroutine_path` of [program]",
    )
}
