//! Subroutines and loops: lines that are kept, and run again.
//!
//! A program is a stream, so a line is gone once it is read. What may run more than once is kept:
//! a subroutine from its `sub` to its `endsub`, and a structure (`if`, `while`, `do`, `repeat`) of
//! the main program from its first O word to its last. While such a part is read nothing of it is
//! executed; its O words are checked and linked to each other. Then a subroutine waits for its
//! calls, and a structure is executed at once.
//!
//! ```text
//!            stream ──────────► executed at once
//!              │ O.. sub / if / while / do / repeat
//!              ▼
//!        Recorder (links) ── Code ──► frame (code, next line) ──► executed line by line
//!                              ▲               │ call
//!                        subroutines ◄─────────┘
//!                              ▲ first call of one that is in a file of its own
//! ```
//!
//! Memory is bounded: all kept text together by [`MAX_KEPT_BYTES`], calls by [`MAX_CALLS`].

use std::collections::BTreeMap;
use std::sync::Arc;

use crate::diagnostic::{Code as FaultCode, Fault, Outcome, Span};
use crate::flow_word::{Head, Keyword, Label};

/// Most text of subroutines and loops kept at a time, bytes.
pub(crate) const MAX_KEPT_BYTES: usize = 32 * 1024 * 1024;
/// Deepest nesting of subroutine calls.
pub(crate) const MAX_CALLS: usize = 64;
/// Bytes a kept line costs besides its text.
const LINE_OVERHEAD: usize = size_of::<Line>();

/// A kept line.
#[derive(Debug)]
pub(crate) struct Line {
    pub(crate) number: u32,
    pub(crate) text: Box<[u8]>,
    pub(crate) head: Option<Head>,
    /// First line of the loop this line belongs to or leaves.
    pub(crate) start: usize,
    /// Last line of the structure this line belongs to or leaves.
    pub(crate) end: usize,
    /// The next branch, for `if` and `elseif`.
    pub(crate) next: usize,
}

impl Line {
    pub(crate) fn keyword(&self) -> Option<Keyword> {
        self.head.as_ref().and_then(|head| head.keyword)
    }
}

/// A part of the program that was kept.
#[derive(Debug, Default)]
pub(crate) struct Code {
    pub(crate) lines: Vec<Line>,
    /// The file of a subroutine they are in; `None`: the program itself.
    pub(crate) file: Option<Arc<str>>,
}

/// A structure that has begun and not ended.
#[derive(Debug)]
struct Open {
    keyword: Keyword,
    label: Label,
    first: usize,
    /// The last branch of an `if` so far.
    branch: usize,
    /// `break` and `continue` lines of a loop.
    leaves: Vec<usize>,
}

/// Keeps the lines of one part and links its O words.
#[derive(Debug)]
pub(crate) struct Recorder {
    /// Label of the subroutine; `None`: a structure of the main program.
    subroutine: Option<Label>,
    code: Code,
    open: Vec<Open>,
    bytes: usize,
    /// The line of the `sub` or of the first O word, for a message.
    pub(crate) first: (u32, Box<[u8]>, Span),
}

impl Recorder {
    pub(crate) fn new(subroutine: Option<Label>, number: u32, text: &[u8], span: Span) -> Self {
        Self {
            subroutine,
            code: Code::default(),
            open: Vec::new(),
            bytes: 0,
            first: (number, text.into(), span),
        }
    }

    /// The same for a part of another file than the program.
    pub(crate) fn in_file(mut self, file: Arc<str>) -> Self {
        self.code.file = Some(file);
        self
    }

    /// Keeps a line; true if it was the last one of the part.
    pub(crate) fn add(
        &mut self,
        number: u32,
        text: &[u8],
        head: Option<Head>,
        kept: usize,
    ) -> Outcome<bool> {
        self.bytes += text.len() + LINE_OVERHEAD;
        if kept + self.bytes > MAX_KEPT_BYTES {
            return Err(Fault::new(
                FaultCode::FlowTooLong,
                Span::new(0, text.len()),
                "the subroutines and loops are too long",
            )
            .because(format!(
                "at most {MAX_KEPT_BYTES} bytes of them are kept in memory"
            ))
            .help("write the moves out, outside of O words"));
        }
        let index = self.code.lines.len();
        let mut line = Line {
            number,
            text: text.into(),
            head: None,
            start: index,
            end: index,
            next: index,
        };
        let mut last = false;
        if let Some(head) = head {
            if let Some(keyword) = head.keyword {
                last = self.link(keyword, &head, &mut line, index)?;
            }
            line.head = Some(head);
        }
        self.code.lines.push(line);
        Ok(last)
    }

    /// Links an O word to those it belongs to; true if it ends the part.
    fn link(
        &mut self,
        keyword: Keyword,
        head: &Head,
        line: &mut Line,
        index: usize,
    ) -> Outcome<bool> {
        match keyword {
            Keyword::Sub => Err(
                misplaced(head, "a subroutine inside another part of the program")
                    .help("define it before, outside of subroutines and loops"),
            ),
            Keyword::EndSub => {
                let ends = self.open.is_empty() && self.subroutine.as_ref() == Some(&head.label);
                if ends {
                    Ok(true)
                } else {
                    Err(self.unmatched(head, "endsub", "sub"))
                }
            }
            Keyword::Call | Keyword::Return => Ok(false),
            Keyword::While if self.top_is(Keyword::Do, &head.label) => self.close(line, index),
            Keyword::If | Keyword::While | Keyword::Do | Keyword::Repeat => {
                let label = head.label.clone();
                let leaves = Vec::new();
                self.open.push(Open {
                    keyword,
                    label,
                    first: index,
                    branch: index,
                    leaves,
                });
                Ok(false)
            }
            Keyword::ElseIf | Keyword::Else => {
                if !self.top_is(Keyword::If, &head.label) {
                    return Err(self.unmatched(head, "else", "if"));
                }
                self.link_branch(head, index)?;
                Ok(false)
            }
            Keyword::EndIf if self.top_is(Keyword::If, &head.label) => {
                self.link_branch(head, index)?;
                self.close(line, index)
            }
            Keyword::EndWhile if self.top_is(Keyword::While, &head.label) => {
                self.close(line, index)
            }
            Keyword::EndRepeat if self.top_is(Keyword::Repeat, &head.label) => {
                self.close(line, index)
            }
            Keyword::EndIf => Err(self.unmatched(head, "endif", "if")),
            Keyword::EndWhile => Err(self.unmatched(head, "endwhile", "while")),
            Keyword::EndRepeat => Err(self.unmatched(head, "endrepeat", "repeat")),
            Keyword::Break | Keyword::Continue => {
                let found = self
                    .open
                    .iter_mut()
                    .rev()
                    .find(|open| open.label == head.label && open.keyword != Keyword::If);
                match found {
                    Some(open) => {
                        line.start = open.first;
                        open.leaves.push(index);
                        Ok(false)
                    }
                    None => Err(misplaced(head, "a break or continue outside of its loop")
                        .help("give it the label of the loop it is in")),
                }
            }
        }
    }

    fn top_is(&self, keyword: Keyword, label: &Label) -> bool {
        self.open
            .last()
            .is_some_and(|open| open.keyword == keyword && open.label == *label)
    }

    fn link_branch(&mut self, head: &Head, index: usize) -> Outcome<()> {
        let Some(open) = self.open.last_mut() else {
            return Ok(());
        };
        if let Some(branch) = self.code.lines.get_mut(open.branch) {
            if branch.keyword() == Some(Keyword::Else) && head.keyword != Some(Keyword::EndIf) {
                return Err(misplaced(head, "another branch behind `else`")
                    .help("put `else` last, before `endif`"));
            }
            branch.next = index;
        }
        open.branch = index;
        open.leaves.push(index);
        Ok(())
    }

    /// Ends the innermost structure with the line at `index`.
    fn close(&mut self, line: &mut Line, index: usize) -> Outcome<bool> {
        if let Some(open) = self.open.pop() {
            line.start = open.first;
            for member in open.leaves.into_iter().chain([open.first]) {
                if let Some(member) = self.code.lines.get_mut(member) {
                    member.end = index;
                }
            }
        }
        Ok(self.open.is_empty() && self.subroutine.is_none())
    }

    fn unmatched(&self, head: &Head, found: &str, wanted: &str) -> Box<Fault> {
        let fault = misplaced(head, &format!("`{found}` without its `{wanted}`"));
        match self.open.last() {
            Some(open) => fault.help(format!(
                "first end {}, which began in line {}",
                open.label,
                self.code
                    .lines
                    .get(open.first)
                    .map_or(self.first.0, |line| line.number)
            )),
            None => fault.help(format!("add `{wanted}` with the same label, or remove it")),
        }
    }

    /// What is wrong when the program ends before the part does.
    pub(crate) fn unfinished(&self) -> Box<Fault> {
        let what = if self.subroutine.is_some() {
            "subroutine"
        } else {
            "structure"
        };
        let message = format!("the {what} is not ended");
        Fault::new(FaultCode::FlowStructure, self.first.2, message)
            .because("the program ends before it does")
            .help("add its last O word (endsub, endif, endwhile, endrepeat or while)")
    }

    /// The part, its label if it is a subroutine, and what it costs.
    pub(crate) fn finish(self) -> (Option<Label>, Arc<Code>, usize) {
        (self.subroutine, Arc::new(self.code), self.bytes)
    }
}

pub(crate) fn misplaced(head: &Head, message: &str) -> Box<Fault> {
    Fault::new(FaultCode::FlowStructure, head.span, message)
        .because("the O words of a program nest, each kind with its own beginning and end")
}

/// A part being executed.
#[derive(Debug)]
pub(crate) struct Frame {
    pub(crate) code: Arc<Code>,
    /// The line to execute next.
    pub(crate) next: usize,
    /// True for a subroutine.
    pub(crate) is_call: bool,
    /// The line of the program that calls it.
    pub(crate) called_from: u32,
    /// `repeat` lines in progress, with the turns still to come.
    pub(crate) repeats: Vec<(usize, u32)>,
}

impl Frame {
    /// A structure of the program.
    pub(crate) const fn structure(code: Arc<Code>) -> Self {
        Self {
            code,
            next: 0,
            is_call: false,
            called_from: 0,
            repeats: Vec::new(),
        }
    }

    /// A subroutine, and the line of the program that calls it.
    pub(crate) fn call(code: Arc<Code>, called_from: u32) -> Self {
        Self {
            is_call: true,
            called_from,
            ..Self::structure(code)
        }
    }

    /// Forgets the counters of the loop that starts at `start`, and of those inside it.
    pub(crate) fn leave_loop(&mut self, start: usize) {
        self.repeats.retain(|(first, _)| *first < start);
    }

    /// Forgets the counters of the loops inside the one that starts at `start`.
    pub(crate) fn leave_inner_loops(&mut self, start: usize) {
        self.repeats.retain(|(first, _)| *first <= start);
    }
}

/// What is kept, and what of it is being executed.
#[derive(Debug, Default)]
pub(crate) struct Flow {
    pub(crate) subroutines: BTreeMap<Label, Arc<Code>>,
    pub(crate) frames: Vec<Frame>,
    pub(crate) recorder: Option<Recorder>,
    /// Bytes of all subroutines kept.
    pub(crate) kept: usize,
}

impl Flow {
    /// Takes up a part that was recorded to its end.
    pub(crate) fn take_up(&mut self, recorder: Recorder) {
        let (label, code, bytes) = recorder.finish();
        match label {
            Some(label) => {
                self.kept += bytes;
                self.subroutines.insert(label, code);
            }
            None => self.frames.push(Frame::structure(code)),
        }
    }

    /// The next kept line to execute, if any is in progress.
    #[inline]
    pub(crate) fn next_line(&mut self) -> Option<(Arc<Code>, usize)> {
        loop {
            let frame = self.frames.last_mut()?;
            if frame.next < frame.code.lines.len() {
                let index = frame.next;
                frame.next += 1;
                return Some((Arc::clone(&frame.code), index));
            }
            // A subroutine ends with its `endsub`, which has taken its frame away.
            self.frames.pop();
        }
    }

    /// Ends the innermost call; false if there is none.
    pub(crate) fn end_call(&mut self) -> bool {
        while let Some(frame) = self.frames.pop() {
            if frame.is_call {
                return true;
            }
        }
        false
    }
}
