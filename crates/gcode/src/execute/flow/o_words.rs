//! Execution of O words: where the program goes on.

use std::io::BufRead;
use std::sync::Arc;

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::execute::flow::activation::{Activation, MAX_CALLS};
use crate::execute::flow::kept_lines::{KeptLine, KeptLines};
use crate::execute::flow::recorder::{Recorder, misplaced};
use crate::execute::line_origin::LineOrigin;
use crate::execute::program::Program;
use crate::syntax::o_word::{Keyword, OWord};

impl<R: BufRead> Program<R> {
    /// Takes a line of the stream that has an O word, or belongs to a part being kept.
    pub(crate) fn read_flow(
        &mut self,
        number: u32,
        text: &[u8],
        o_word: Option<OWord>,
    ) -> Outcome<()> {
        if let Some(mut recorder) = self.flow.recorder.take() {
            if recorder.add(number, text, o_word, self.flow.kept)? {
                self.flow.take_up(recorder);
            } else {
                self.flow.recorder = Some(recorder);
            }
            return Ok(());
        }
        let Some(o_word) = o_word else {
            return Ok(());
        };
        match o_word.keyword {
            None => Ok(()),
            Some(Keyword::Call) => self.call(&o_word, text),
            Some(Keyword::Sub) => {
                o_word.no_value(text)?;
                if self.flow.subroutines.contains_key(&o_word.label) {
                    let message = format!("a second subroutine {}", o_word.label);
                    return Err(misplaced(&o_word, &message).help("give it a label of its own"));
                }
                let recorder = Recorder::new(Some(o_word.label), number, text, o_word.span);
                self.flow.recorder = Some(recorder);
                Ok(())
            }
            Some(Keyword::If | Keyword::While | Keyword::Do | Keyword::Repeat) => {
                let mut recorder = Recorder::new(None, number, text, o_word.span);
                recorder.add(number, text, Some(o_word), self.flow.kept)?;
                self.flow.recorder = Some(recorder);
                Ok(())
            }
            Some(Keyword::Return) => {
                Err(misplaced(&o_word, "`return` outside of a subroutine").help("remove it"))
            }
            Some(_) => Err(misplaced(&o_word, "an end without its beginning")
                .help("add the O word that begins it, with the same label, or remove this one")),
        }
    }

    /// Executes a kept line that has an O word.
    pub(crate) fn execute_flow(&mut self, part: &Arc<KeptLines>, index: usize) -> Outcome<()> {
        let Some((line, o_word)) = part
            .lines
            .get(index)
            .and_then(|l| Some((l, l.o_word.as_ref()?)))
        else {
            return Ok(());
        };
        let text = &line.text;
        match o_word.keyword {
            None => {}
            Some(Keyword::Call) => self.call(o_word, text)?,
            Some(Keyword::Return | Keyword::EndSub) => {
                let value = o_word.optional_value(text, &self.scope())?;
                self.interpreter.line = self.line_of_program();
                if !self.flow.end_call() {
                    return Err(
                        misplaced(o_word, "`return` outside of a subroutine").help("remove it")
                    );
                }
                self.parameters.leave(value);
                self.restore_on_return(o_word.span)?;
            }
            Some(Keyword::If) => {
                let holds = o_word.one_value(text, &self.scope())? != 0.0;
                if !holds {
                    self.branch(part, line.next)?;
                }
            }
            // Come to from the branch before, which is done.
            Some(Keyword::ElseIf | Keyword::Else) => self.go_to(line.end + 1),
            Some(Keyword::While) => {
                let goes_on = o_word.one_value(text, &self.scope())? != 0.0;
                let ends_do = line.start != index;
                match (ends_do, goes_on) {
                    (true, true) => self.go_to(line.start + 1),
                    (false, false) => self.go_to(line.end + 1),
                    _ => {}
                }
            }
            Some(Keyword::EndWhile) => self.go_to(line.start),
            Some(Keyword::Repeat) => self.repeat(o_word, line, index)?,
            Some(Keyword::EndRepeat) => self.end_repeat(line.start),
            Some(Keyword::Break | Keyword::Continue) => self.leave(part, line),
            Some(Keyword::Sub | Keyword::Do | Keyword::EndIf) => o_word.no_value(text)?,
        }
        Ok(())
    }

    fn go_to(&mut self, index: usize) {
        if let Some(activation) = self.flow.activations.last_mut() {
            activation.next = index;
        }
    }

    /// Goes to the first branch from `index` on whose condition holds.
    fn branch(&mut self, part: &Arc<KeptLines>, mut index: usize) -> Outcome<()> {
        while let Some(line) = part.lines.get(index) {
            self.origin = LineOrigin::Kept(Arc::clone(part), index);
            let o_word = line
                .o_word
                .as_ref()
                .filter(|o_word| o_word.keyword == Some(Keyword::ElseIf));
            match o_word {
                Some(o_word) if o_word.one_value(&line.text, &self.scope())? == 0.0 => {
                    index = line.next;
                }
                _ => break,
            }
        }
        self.go_to(index + 1);
        Ok(())
    }

    fn repeat(&mut self, o_word: &OWord, line: &KeptLine, index: usize) -> Outcome<()> {
        let turns = o_word
            .one_value(&line.text, &self.scope())?
            .round()
            .clamp(0.0, 1e9);
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "clamped to the range of u32"
        )]
        let turns = turns as u32;
        match (turns.checked_sub(1), self.flow.activations.last_mut()) {
            (Some(left), Some(activation)) => activation.repeats.push((index, left)),
            _ => self.go_to(line.end + 1),
        }
        Ok(())
    }

    fn end_repeat(&mut self, start: usize) {
        let Some(activation) = self.flow.activations.last_mut() else {
            return;
        };
        match activation.repeats.last_mut() {
            Some((first, left)) if *first == start && *left > 0 => {
                *left -= 1;
                activation.next = start + 1;
            }
            _ => activation.leave_loop(start),
        }
    }

    /// `break` and `continue`.
    fn leave(&mut self, part: &Arc<KeptLines>, line: &KeptLine) {
        let Some(activation) = self.flow.activations.last_mut() else {
            return;
        };
        if line.keyword() == Some(Keyword::Break) {
            activation.leave_loop(line.start);
            activation.next = line.end + 1;
            return;
        }
        activation.leave_inner_loops(line.start);
        let first = part.lines.get(line.start).and_then(KeptLine::keyword);
        activation.next = if first == Some(Keyword::While) {
            line.start
        } else {
            line.end
        };
    }

    fn call(&mut self, o_word: &OWord, text: &[u8]) -> Outcome<()> {
        let label = o_word.resolved_label(text, &self.scope())?;
        let arguments = o_word.arguments(text, &self.scope())?;
        let part = match self.flow.subroutines.get(&label) {
            Some(part) => Arc::clone(part),
            None => self.load(&label, o_word.span)?,
        };
        self.enter(&part, &arguments, o_word.span)
    }

    /// Restores the modal state a subroutine has saved by M73; `span` is what ends it.
    fn restore_on_return(&mut self, span: SourceSpan) -> Outcome<()> {
        let mut items = Vec::new();
        self.interpreter.restore_on_return(span, &mut items)?;
        if !items.is_empty() {
            self.give(items);
        }
        Ok(())
    }

    /// Begins a subroutine; `span` is what calls it.
    pub(crate) fn enter(
        &mut self,
        part: &Arc<KeptLines>,
        arguments: &[f64],
        span: SourceSpan,
    ) -> Outcome<()> {
        if self.parameters.call_level() >= MAX_CALLS {
            let message = format!("more than {MAX_CALLS} calls in each other");
            return Err(
                BlockDiagnostic::new(DiagnosticCode::CallDepth, span, message)
                    .because("the depth of subroutine calls is bounded")
                    .help("check what should end the recursion"),
            );
        }
        let called_from = self.line_of_program();
        self.flow
            .activations
            .push(Activation::call(Arc::clone(part), called_from));
        self.parameters.enter(arguments);
        self.interpreter.state.saved_states.enter();
        Ok(())
    }
}
