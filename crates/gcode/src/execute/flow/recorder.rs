//! The recorder, which keeps the lines of one part of a program and links its O words.

use std::sync::Arc;

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::execute::flow::kept_lines::{KeptLine, KeptLines};
use crate::setup::subroutine_file::MAX_KEPT_BYTES;
use crate::syntax::o_word::{Keyword, Label, OWord};

/// Bytes a kept line costs besides its text.
const LINE_OVERHEAD: usize = size_of::<KeptLine>();

/// A structure that has begun and not ended.
#[derive(Debug)]
struct OpenStructure {
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
    part: KeptLines,
    open: Vec<OpenStructure>,
    bytes: usize,
    /// The line of the `sub` or of the first O word, for a message.
    pub(crate) first: (u32, Box<[u8]>, SourceSpan),
}

impl Recorder {
    pub(crate) fn new(
        subroutine: Option<Label>,
        number: u32,
        text: &[u8],
        span: SourceSpan,
    ) -> Self {
        Self {
            subroutine,
            part: KeptLines::default(),
            open: Vec::new(),
            bytes: 0,
            first: (number, text.into(), span),
        }
    }

    /// The same for a part of another file than the program.
    pub(crate) fn in_file(mut self, file: Arc<str>) -> Self {
        self.part.file = Some(file);
        self
    }

    /// Keeps a line; true if it was the last one of the part.
    pub(crate) fn add(
        &mut self,
        number: u32,
        text: &[u8],
        o_word: Option<OWord>,
        kept: usize,
    ) -> Outcome<bool> {
        self.bytes += text.len() + LINE_OVERHEAD;
        if kept + self.bytes > MAX_KEPT_BYTES {
            return Err(BlockDiagnostic::new(
                DiagnosticCode::FlowTooLong,
                SourceSpan::new(0, text.len()),
                "the subroutines and loops are too long",
            )
            .because(format!(
                "at most {MAX_KEPT_BYTES} bytes of them are kept in memory"
            ))
            .help("write the moves out, outside of O words"));
        }
        let index = self.part.lines.len();
        let mut line = KeptLine {
            number,
            text: text.into(),
            o_word: None,
            start: index,
            end: index,
            next: index,
        };
        let mut last = false;
        if let Some(o_word) = o_word {
            if let Some(keyword) = o_word.keyword {
                last = self.link(keyword, &o_word, &mut line, index)?;
            }
            line.o_word = Some(o_word);
        }
        self.part.lines.push(line);
        Ok(last)
    }

    /// Links an O word to those it belongs to; true if it ends the part.
    fn link(
        &mut self,
        keyword: Keyword,
        o_word: &OWord,
        line: &mut KeptLine,
        index: usize,
    ) -> Outcome<bool> {
        match keyword {
            Keyword::Sub => Err(misplaced(
                o_word,
                "a subroutine inside another part of the program",
            )
            .help("define it before, outside of subroutines and loops")),
            Keyword::EndSub => {
                let ends = self.open.is_empty() && self.subroutine.as_ref() == Some(&o_word.label);
                if ends {
                    Ok(true)
                } else {
                    Err(self.unmatched(o_word, "endsub", "sub"))
                }
            }
            Keyword::Call | Keyword::Return => Ok(false),
            Keyword::While if self.top_is(Keyword::Do, &o_word.label) => self.close(line, index),
            Keyword::If | Keyword::While | Keyword::Do | Keyword::Repeat => {
                let label = o_word.label.clone();
                let leaves = Vec::new();
                self.open.push(OpenStructure {
                    keyword,
                    label,
                    first: index,
                    branch: index,
                    leaves,
                });
                Ok(false)
            }
            Keyword::ElseIf | Keyword::Else => {
                if !self.top_is(Keyword::If, &o_word.label) {
                    return Err(self.unmatched(o_word, "else", "if"));
                }
                self.link_branch(o_word, index)?;
                Ok(false)
            }
            Keyword::EndIf if self.top_is(Keyword::If, &o_word.label) => {
                self.link_branch(o_word, index)?;
                self.close(line, index)
            }
            Keyword::EndWhile if self.top_is(Keyword::While, &o_word.label) => {
                self.close(line, index)
            }
            Keyword::EndRepeat if self.top_is(Keyword::Repeat, &o_word.label) => {
                self.close(line, index)
            }
            Keyword::EndIf => Err(self.unmatched(o_word, "endif", "if")),
            Keyword::EndWhile => Err(self.unmatched(o_word, "endwhile", "while")),
            Keyword::EndRepeat => Err(self.unmatched(o_word, "endrepeat", "repeat")),
            Keyword::Break | Keyword::Continue => {
                let found = self
                    .open
                    .iter_mut()
                    .rev()
                    .find(|open| open.label == o_word.label && open.keyword != Keyword::If);
                match found {
                    Some(open) => {
                        line.start = open.first;
                        open.leaves.push(index);
                        Ok(false)
                    }
                    None => Err(misplaced(o_word, "a break or continue outside of its loop")
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

    fn link_branch(&mut self, o_word: &OWord, index: usize) -> Outcome<()> {
        let Some(open) = self.open.last_mut() else {
            return Ok(());
        };
        if let Some(branch) = self.part.lines.get_mut(open.branch) {
            if branch.keyword() == Some(Keyword::Else) && o_word.keyword != Some(Keyword::EndIf) {
                return Err(misplaced(o_word, "another branch behind `else`")
                    .help("put `else` last, before `endif`"));
            }
            branch.next = index;
        }
        open.branch = index;
        open.leaves.push(index);
        Ok(())
    }

    /// Ends the innermost structure with the line at `index`.
    fn close(&mut self, line: &mut KeptLine, index: usize) -> Outcome<bool> {
        if let Some(open) = self.open.pop() {
            line.start = open.first;
            for member in open.leaves.into_iter().chain([open.first]) {
                if let Some(member) = self.part.lines.get_mut(member) {
                    member.end = index;
                }
            }
        }
        Ok(self.open.is_empty() && self.subroutine.is_none())
    }

    fn unmatched(&self, o_word: &OWord, found: &str, wanted: &str) -> Box<BlockDiagnostic> {
        let fault = misplaced(o_word, &format!("`{found}` without its `{wanted}`"));
        match self.open.last() {
            Some(open) => fault.help(format!(
                "first end {}, which began in line {}",
                open.label,
                self.part
                    .lines
                    .get(open.first)
                    .map_or(self.first.0, |line| line.number)
            )),
            None => fault.help(format!("add `{wanted}` with the same label, or remove it")),
        }
    }

    /// What is wrong when the program ends before the part does.
    pub(crate) fn unfinished(&self) -> Box<BlockDiagnostic> {
        let what = if self.subroutine.is_some() {
            "subroutine"
        } else {
            "structure"
        };
        let message = format!("the {what} is not ended");
        BlockDiagnostic::new(DiagnosticCode::FlowStructure, self.first.2, message)
            .because("the program ends before it does")
            .help("add its last O word (endsub, endif, endwhile, endrepeat or while)")
    }

    /// The part, its label if it is a subroutine, and what it costs.
    pub(crate) fn finish(self) -> (Option<Label>, Arc<KeptLines>, usize) {
        (self.subroutine, Arc::new(self.part), self.bytes)
    }
}

pub(crate) fn misplaced(o_word: &OWord, message: &str) -> Box<BlockDiagnostic> {
    BlockDiagnostic::new(DiagnosticCode::FlowStructure, o_word.span, message)
        .because("the O words of a program nest, each kind with its own beginning and end")
}
