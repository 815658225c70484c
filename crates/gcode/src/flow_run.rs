//! Executes O words: where the program goes on.

use std::io::BufRead;
use std::sync::Arc;

use crate::diagnostic::{Code as FaultCode, Fault, Outcome, Span};
use crate::flow::{Code, Frame, Line, MAX_CALLS, Recorder, misplaced};
use crate::flow_word::{Head, Keyword};
use crate::parameters::ProgramScope;
use crate::place::Place;
use crate::program::Program;

impl<R: BufRead> Program<R> {
    pub(crate) const fn scope(&self) -> ProgramScope<'_> {
        ProgramScope {
            parameters: &self.parameters,
            interpreter: &self.interpreter,
        }
    }

    /// Takes a line of the stream that has an O word, or belongs to a part being kept.
    pub(crate) fn read_flow(
        &mut self,
        number: u32,
        text: &[u8],
        head: Option<Head>,
    ) -> Outcome<()> {
        if let Some(mut recorder) = self.flow.recorder.take() {
            if recorder.add(number, text, head, self.flow.kept)? {
                self.flow.take_up(recorder);
            } else {
                self.flow.recorder = Some(recorder);
            }
            return Ok(());
        }
        let Some(head) = head else {
            return Ok(());
        };
        match head.keyword {
            None => Ok(()),
            Some(Keyword::Call) => self.call(&head, text),
            Some(Keyword::Sub) => {
                head.no_value(text)?;
                if self.flow.subroutines.contains_key(&head.label) {
                    let message = format!("a second subroutine {}", head.label);
                    return Err(misplaced(&head, &message).help("give it a label of its own"));
                }
                let recorder = Recorder::new(Some(head.label), number, text, head.span);
                self.flow.recorder = Some(recorder);
                Ok(())
            }
            Some(Keyword::If | Keyword::While | Keyword::Do | Keyword::Repeat) => {
                let mut recorder = Recorder::new(None, number, text, head.span);
                recorder.add(number, text, Some(head), self.flow.kept)?;
                self.flow.recorder = Some(recorder);
                Ok(())
            }
            Some(Keyword::Return) => {
                Err(misplaced(&head, "`return` outside of a subroutine").help("remove it"))
            }
            Some(_) => Err(misplaced(&head, "an end without its beginning")
                .help("add the O word that begins it, with the same label, or remove this one")),
        }
    }

    /// Executes a kept line that has an O word.
    pub(crate) fn execute_flow(&mut self, code: &Arc<Code>, index: usize) -> Outcome<()> {
        let Some((line, head)) = code
            .lines
            .get(index)
            .and_then(|l| Some((l, l.head.as_ref()?)))
        else {
            return Ok(());
        };
        let text = &line.text;
        match head.keyword {
            None => {}
            Some(Keyword::Call) => self.call(head, text)?,
            Some(Keyword::Return | Keyword::EndSub) => {
                let value = head.optional_value(text, &self.scope())?;
                self.interpreter.line = self.line_of_program();
                if !self.flow.end_call() {
                    return Err(
                        misplaced(head, "`return` outside of a subroutine").help("remove it")
                    );
                }
                self.parameters.leave(value);
                self.restore_on_return(head.span)?;
            }
            Some(Keyword::If) => {
                let holds = head.one_value(text, &self.scope())? != 0.0;
                if !holds {
                    self.branch(code, line.next)?;
                }
            }
            // Come to from the branch before, which is done.
            Some(Keyword::ElseIf | Keyword::Else) => self.go_to(line.end + 1),
            Some(Keyword::While) => {
                let goes_on = head.one_value(text, &self.scope())? != 0.0;
                let ends_do = line.start != index;
                match (ends_do, goes_on) {
                    (true, true) => self.go_to(line.start + 1),
                    (false, false) => self.go_to(line.end + 1),
                    _ => {}
                }
            }
            Some(Keyword::EndWhile) => self.go_to(line.start),
            Some(Keyword::Repeat) => self.repeat(head, line, index)?,
            Some(Keyword::EndRepeat) => self.end_repeat(line.start),
            Some(Keyword::Break | Keyword::Continue) => self.leave(code, line),
            Some(Keyword::Sub | Keyword::Do | Keyword::EndIf) => head.no_value(text)?,
        }
        Ok(())
    }

    fn go_to(&mut self, index: usize) {
        if let Some(frame) = self.flow.frames.last_mut() {
            frame.next = index;
        }
    }

    /// Goes to the first branch from `index` on whose condition holds.
    fn branch(&mut self, code: &Arc<Code>, mut index: usize) -> Outcome<()> {
        while let Some(line) = code.lines.get(index) {
            self.place = Place::Kept(Arc::clone(code), index);
            let head = line
                .head
                .as_ref()
                .filter(|head| head.keyword == Some(Keyword::ElseIf));
            match head {
                Some(head) if head.one_value(&line.text, &self.scope())? == 0.0 => {
                    index = line.next;
                }
                _ => break,
            }
        }
        self.go_to(index + 1);
        Ok(())
    }

    fn repeat(&mut self, head: &Head, line: &Line, index: usize) -> Outcome<()> {
        let turns = head
            .one_value(&line.text, &self.scope())?
            .round()
            .clamp(0.0, 1e9);
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "clamped to the range of u32"
        )]
        let turns = turns as u32;
        match (turns.checked_sub(1), self.flow.frames.last_mut()) {
            (Some(left), Some(frame)) => frame.repeats.push((index, left)),
            _ => self.go_to(line.end + 1),
        }
        Ok(())
    }

    fn end_repeat(&mut self, start: usize) {
        let Some(frame) = self.flow.frames.last_mut() else {
            return;
        };
        match frame.repeats.last_mut() {
            Some((first, left)) if *first == start && *left > 0 => {
                *left -= 1;
                frame.next = start + 1;
            }
            _ => frame.leave_loop(start),
        }
    }

    /// `break` and `continue`.
    fn leave(&mut self, code: &Arc<Code>, line: &Line) {
        let Some(frame) = self.flow.frames.last_mut() else {
            return;
        };
        if line.keyword() == Some(Keyword::Break) {
            frame.leave_loop(line.start);
            frame.next = line.end + 1;
            return;
        }
        frame.leave_inner_loops(line.start);
        let first = code.lines.get(line.start).and_then(Line::keyword);
        frame.next = if first == Some(Keyword::While) {
            line.start
        } else {
            line.end
        };
    }

    fn call(&mut self, head: &Head, text: &[u8]) -> Outcome<()> {
        let label = head.resolved_label(text, &self.scope())?;
        let arguments = head.arguments(text, &self.scope())?;
        let code = match self.flow.subroutines.get(&label) {
            Some(code) => Arc::clone(code),
            None => self.load(&label, head.span)?,
        };
        self.enter(&code, &arguments, head.span)
    }

    /// Restores the modal state a subroutine has saved by M73; `span` is what ends it.
    fn restore_on_return(&mut self, span: Span) -> Outcome<()> {
        let mut items = Vec::new();
        self.interpreter.restore_on_return(span, &mut items)?;
        if !items.is_empty() {
            self.give(items);
        }
        Ok(())
    }

    /// Begins a subroutine; `span` is what calls it.
    pub(crate) fn enter(&mut self, code: &Arc<Code>, arguments: &[f64], span: Span) -> Outcome<()> {
        if self.parameters.call_level() >= MAX_CALLS {
            let message = format!("more than {MAX_CALLS} calls in each other");
            return Err(Fault::new(FaultCode::CallDepth, span, message)
                .because("the depth of subroutine calls is bounded")
                .help("check what should end the recursion"));
        }
        let called_from = self.line_of_program();
        self.flow
            .frames
            .push(Frame::call(Arc::clone(code), called_from));
        self.parameters.enter(arguments);
        self.interpreter.saved_states.enter();
        Ok(())
    }
}
