//! Structures and jumps.

use std::io::BufRead;

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::execute::program::Program;
use crate::syntax::dialect::siemens::expression::Evaluator;
use crate::syntax::dialect::siemens::statement::{
    Direction, Statement, direction, is_header, is_target, jump_in, name_at, statement,
};
use crate::syntax::dialect::siemens::variables::Kind;
use crate::syntax::expression::scope::{Parameter, Scope};
use crate::syntax::word_check::missing;

pub(super) fn fault(span: SourceSpan, message: impl Into<String>) -> Box<BlockDiagnostic> {
    BlockDiagnostic::new(DiagnosticCode::FlowStructure, span, message)
        .because("structures nest, each with its own end, and each statement has a line of its own")
}

/// Refuses text behind a statement.
pub(super) fn check_end(input: &mut Evaluator<'_>) -> Outcome<()> {
    if input.is_at_end() {
        return Ok(());
    }
    let span = SourceSpan::new(input.at, input.text.len());
    Err(fault(span, "text behind the statement").help("give it a line of its own"))
}

impl<R: BufRead> Program<R> {
    /// Executes a statement; `at` is where what follows its keyword starts.
    pub(super) fn siemens_flow(
        &mut self,
        statement: Statement,
        index: usize,
        text: &[u8],
        at: usize,
    ) -> Outcome<()> {
        match statement {
            Statement::IfJump => {
                let jump = jump_in(text, at).unwrap_or(text.len());
                let (condition, rest) = text.split_at(jump);
                if self.siemens_condition(condition, at)? {
                    let name = name_at(rest, 0);
                    let way = direction(name).unwrap_or(Direction::Any);
                    self.siemens_go_to(way, index, text, jump + name.len())?;
                }
            }
            Statement::If | Statement::While if self.siemens_condition(text, at)? => {}
            Statement::If | Statement::While => {
                self.siemens_skip(statement, index, text, statement == Statement::If)?;
            }
            // Come to from the branch before, which is done.
            Statement::Else => self.siemens_skip(Statement::If, index, text, false)?,
            Statement::For => {
                let (kind, counter, value, last) = self.siemens_count(text, at)?;
                self.parameters.assign(&counter, kind.of(value));
                if value > last {
                    self.siemens_skip(statement, index, text, false)?;
                }
            }
            Statement::EndFor => self.siemens_count_on(index, text)?,
            Statement::EndWhile => {
                let start = self.siemens_start(Statement::While, index, text)?;
                self.tape.next = start;
            }
            Statement::EndLoop => {
                let start = self.siemens_start(Statement::Loop, index, text)?;
                self.tape.next = start + 1;
            }
            Statement::Until if self.siemens_condition(text, at)? => {}
            Statement::Until => {
                let start = self.siemens_start(Statement::Repeat, index, text)?;
                self.tape.next = start + 1;
            }
            Statement::RepeatPart => self.siemens_repeat_part(index, text, at, false)?,
            Statement::RepeatBlock => self.siemens_repeat_part(index, text, at, true)?,
            Statement::Goto(way) => self.siemens_go_to(way, index, text, at)?,
            Statement::Define => self.siemens_define(text, at)?,
            Statement::Case => self.siemens_case(index, text, at)?,
            _ => {}
        }
        Ok(())
    }

    fn siemens_condition(&self, text: &[u8], at: usize) -> Outcome<bool> {
        let scope = self.scope();
        let mut input = self.evaluator(&scope, text, at);
        let holds = input.value()? != 0.0;
        check_end(&mut input)?;
        Ok(holds)
    }

    /// Goes behind the end of a structure, or behind its ELSE if that counts.
    fn siemens_skip(
        &mut self,
        begins: Statement,
        index: usize,
        text: &[u8],
        to_else: bool,
    ) -> Outcome<()> {
        if let Some(behind) = self.tape.known_jump(index, 0) {
            self.tape.next = behind;
            return Ok(());
        }
        let mut depth = 0_u32;
        let mut found = None;
        let wanted = |line: &[u8]| {
            let (statement, _) = statement(line);
            if statement.end().is_some() {
                depth += 1;
            } else if depth == 0 && (statement.is_end() || to_else && statement == Statement::Else)
            {
                found = Some(statement);
            } else if statement.is_end() {
                depth -= 1;
            }
            found.is_some()
        };
        let end = self
            .tape
            .search(index + 1, &mut self.source, wanted, |_| false)?;
        match (end, found) {
            (Some(end), Some(Statement::Else)) => self.tape.jump(index, 0, end + 1),
            (Some(end), found) if found == begins.end() => self.tape.jump(index, 0, end + 1),
            _ => {
                let span = SourceSpan::new(0, text.len());
                return Err(fault(span, "a structure without its end")
                    .help("add ENDIF, ENDWHILE, ENDFOR, ENDLOOP or UNTIL"));
            }
        }
        Ok(())
    }

    /// The line where the structure begins that ends in this one.
    fn siemens_start(&mut self, begins: Statement, index: usize, text: &[u8]) -> Outcome<usize> {
        if let Some(start) = self.tape.known_jump(index, 0) {
            return Ok(start);
        }
        let mut depth = 0_u32;
        let mut found = None;
        let wanted = |line: &[u8]| {
            let (statement, _) = statement(line);
            if statement.is_end() {
                depth += 1;
            } else if statement.end().is_some() && depth == 0 {
                found = Some(statement);
            } else if statement.end().is_some() {
                depth -= 1;
            }
            found.is_some()
        };
        let start = self.tape.search_back(index, wanted, |_| false);
        match start {
            Some(start) if found == Some(begins) => {
                self.tape.jump(index, 0, start);
                Ok(start)
            }
            _ => {
                let span = SourceSpan::new(0, text.len());
                let message = "the end of a structure that did not begin";
                Err(fault(span, message).help("remove it, or check the structures in between"))
            }
        }
    }

    /// `counter = first TO last`: the counter, the first value and the last.
    fn siemens_count(&self, text: &[u8], at: usize) -> Outcome<(Kind, Parameter, f64, f64)> {
        let scope = self.scope();
        let mut input = self.evaluator(&scope, text, at);
        input.next_visible();
        let span = SourceSpan::new(at, text.len().max(at + 1));
        let form = || {
            fault(span, "FOR counts in another form")
                .help("write FOR R1=first TO last, or a variable of DEF in the place of R1")
        };
        let Some((kind, counter)) = input.assignable()? else {
            return Err(form());
        };
        if !input.eat(b'=') {
            return Err(form());
        }
        let first = input.value()?;
        if !input.eat_name(b"TO") {
            return Err(form());
        }
        let last = input.value()?;
        check_end(&mut input)?;
        Ok((kind, counter, first, last))
    }

    /// ENDFOR: the counter goes on by one, up to the value that the last one has now.
    fn siemens_count_on(&mut self, index: usize, text: &[u8]) -> Outcome<()> {
        let start = self.siemens_start(Statement::For, index, text)?;
        let Some((number, first)) = self.tape.get(start).cloned() else {
            return Ok(());
        };
        // What is wrong with it is wrong there.
        self.set_tape_origin(number, &first);
        let (kind, counter, _, last) = self.siemens_count(&first, statement(&first).1)?;
        let scope = self.scope();
        let value = match &counter {
            Parameter::Numbered(number) => scope.numbered(*number),
            Parameter::Named(name) => scope.named(name),
        };
        let value = value.unwrap_or(0.0) + 1.0;
        self.parameters.assign(&counter, kind.of(value));
        self.tape.next = if value <= last { start + 1 } else { index + 1 };
        Ok(())
    }

    /// The line of a label or block number of REPEAT: towards the beginning first, then towards the end;
    /// `number` tells the targets of a line apart.
    pub(super) fn siemens_target(
        &mut self,
        index: usize,
        target: &[u8],
        number: u32,
        at: usize,
    ) -> Outcome<usize> {
        if let Some(line) = self.tape.known_jump(index, number) {
            return Ok(line);
        }
        let found = match self.siemens_find(Direction::Back, index, target)? {
            None => self.siemens_find(Direction::Forward, index, target)?,
            found => found,
        };
        let line = found.ok_or_else(|| no_target(target, at))?;
        self.tape.remember_jump(index, number, line);
        Ok(line)
    }

    fn siemens_find(
        &mut self,
        way: Direction,
        index: usize,
        target: &[u8],
    ) -> Outcome<Option<usize>> {
        let wanted = |line: &[u8]| is_target(line, target);
        if way != Direction::Back {
            let ahead = self
                .tape
                .search(index + 1, &mut self.source, wanted, is_header)?;
            if ahead.is_some() || way == Direction::Forward {
                return Ok(ahead);
            }
        }
        Ok(self.tape.search_back(index + 1, wanted, is_header))
    }

    fn siemens_go_to(
        &mut self,
        way: Direction,
        index: usize,
        text: &[u8],
        at: usize,
    ) -> Outcome<()> {
        let scope = self.scope();
        let mut input = self.evaluator(&scope, text, at);
        input.next_visible();
        let start = input.at;
        if input.is_text_next() {
            let target = input.text_value()?;
            let span = SourceSpan::new(start, input.at);
            check_end(&mut input)?;
            return self.siemens_go_to_text(way, index, &target, span);
        }
        let target = input.name_ahead();
        input.at += target.len();
        let is_name = target
            .first()
            .is_some_and(|byte| byte.is_ascii_alphabetic() || *byte == b'_');
        if !is_name {
            let span = SourceSpan::new(at.saturating_sub(1), at);
            return Err(missing(
                span,
                "the jump",
                "a target",
                "a label or a block number",
            ));
        }
        check_end(&mut input)?;
        self.siemens_jump(way, index, &target, (1, start))
    }

    /// Jumps to the label that a text names, which may be another one each time.
    fn siemens_go_to_text(
        &mut self,
        way: Direction,
        index: usize,
        target: &[u8],
        span: SourceSpan,
    ) -> Outcome<()> {
        match self.siemens_find(way, index, target)? {
            Some(line) => self.tape.next = line,
            None if way == Direction::IfAny => {}
            None => {
                let mut fault = no_target(target, span.start);
                fault.span = span;
                return Err(fault);
            }
        }
        Ok(())
    }

    /// Jumps; `number` tells the jumps of a line apart, and `at` is where its target stands.
    pub(super) fn siemens_jump(
        &mut self,
        way: Direction,
        index: usize,
        target: &[u8],
        (number, at): (u32, usize),
    ) -> Outcome<()> {
        if let Some(line) = self.tape.known_jump(index, number) {
            self.tape.next = line;
            return Ok(());
        }
        match self.siemens_find(way, index, target)? {
            Some(line) => self.tape.jump(index, number, line),
            None if way == Direction::IfAny => self.tape.jump(index, number, index + 1),
            None => return Err(no_target(target, at)),
        }
        Ok(())
    }
}

fn no_target(target: &[u8], at: usize) -> Box<BlockDiagnostic> {
    let shown = String::from_utf8_lossy(target).into_owned();
    let span = SourceSpan::new(at, at + target.len());
    BlockDiagnostic::new(
        DiagnosticCode::FlowStructure,
        span,
        format!("there is no {shown} to jump to"),
    )
    .because(
        "GOTOF looks towards the end of the program, GOTOB towards its beginning, GOTO both ways",
    )
    .help("add the label with a colon behind it, or correct the jump")
}
