//! The loader of subroutines from files of their own, when they are called first.

use std::io::BufRead;
use std::sync::Arc;

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::execute::flow::kept_lines::KeptLines;
use crate::execute::flow::recorder::Recorder;
use crate::execute::line_origin::{LineOrigin, SourceLine};
use crate::execute::program::{Program, is_percent};
use crate::setup::subroutine_file::{
    MAX_KEPT_BYTES, MAX_SUBROUTINE_BYTES, NoSubroutineFile, NotTaken, SubroutineFile,
};
use crate::syntax::cursor::Cursor;
use crate::syntax::line_source::LineSource;
use crate::syntax::o_word::{Keyword, Label, o_word};

/// Why a file gives no subroutine.
enum Broken {
    /// It does not define it.
    Absent,
    /// Something in it is wrong.
    Fault(Box<BlockDiagnostic>, SourceLine),
}

impl<R: BufRead> Program<R> {
    /// A subroutine that the program does not define; `span` is what calls it.
    pub(crate) fn load(&mut self, label: &Label, span: SourceSpan) -> Outcome<Arc<KeptLines>> {
        let stem = match label {
            Label::Name(name) => name.clone(),
            Label::Number(number) => number.to_string(),
            Label::Computed => String::new(),
        };
        if stem.is_empty() || stem.starts_with('.') || stem.contains(['/', '\\']) {
            return Err(no_file_name(label, span));
        }
        let Some(subroutines) = &self.interpreter.options.subroutines else {
            return Err(unknown(label, span)
                .because("a subroutine is defined before its first call")
                .help("define it before this line (sub … endsub)"));
        };
        let name = format!("{stem}.ngc");
        let file = subroutines
            .get(&name)
            .map_err(|why| not_taken(label, &name, span, why))?;
        match self.record(label, &file) {
            Ok(recorder) => {
                self.flow.take_up(recorder);
                self.flow
                    .subroutines
                    .get(label)
                    .map(Arc::clone)
                    .ok_or_else(|| absent(label, &file, span))
            }
            Err(Broken::Absent) => Err(absent(label, &file, span)),
            Err(Broken::Fault(fault, line)) => {
                self.origin = LineOrigin::Past(line);
                Err(fault)
            }
        }
    }

    /// The lines of a subroutine in a file, from its `sub` to its `endsub`.
    fn record(&self, label: &Label, file: &SubroutineFile) -> Result<Recorder, Broken> {
        let mut lines = LineSource::new(&*file.text);
        let mut recorder: Option<Recorder> = None;
        loop {
            let step = self.record_line(&mut lines, &mut recorder, label, file);
            let line = |number, text| SourceLine {
                file: Some(Arc::clone(&file.name)),
                ..SourceLine::new(number, text)
            };
            let goes_on =
                step.map_err(|fault| Broken::Fault(fault, line(lines.number(), lines.text())))?;
            match (goes_on, recorder.take()) {
                (Recorded::Complete, Some(recorder)) => return Ok(recorder),
                (Recorded::End, Some(recorder)) => {
                    let (number, text, _) = &recorder.first;
                    return Err(Broken::Fault(recorder.unfinished(), line(*number, text)));
                }
                (Recorded::End | Recorded::Complete, None) => return Err(Broken::Absent),
                (Recorded::Next, open) => recorder = open,
            }
        }
    }

    /// Takes the next line of a file.
    fn record_line(
        &self,
        lines: &mut LineSource<&[u8]>,
        recorder: &mut Option<Recorder>,
        label: &Label,
        file: &SubroutineFile,
    ) -> Outcome<Recorded> {
        if !lines.advance()? {
            return Ok(Recorded::End);
        }
        let (number, text) = (lines.number(), lines.text());
        let deleted =
            self.interpreter.options.block_delete && Cursor::new(text).next_visible() == Some(b'/');
        if deleted {
            return Ok(Recorded::Next);
        }
        if let Some(recorder) = recorder {
            if is_percent(text) {
                return Ok(Recorded::End);
            }
            let last = recorder.add(number, text, o_word(text)?, self.flow.kept)?;
            return Ok(if last {
                Recorded::Complete
            } else {
                Recorded::Next
            });
        }
        // What stands before the subroutine is not read, whatever it is.
        if let Ok(Some(o_word)) = o_word(text)
            && o_word.keyword == Some(Keyword::Sub)
            && o_word.label == *label
        {
            o_word.no_value(text)?;
            let begun = Recorder::new(Some(o_word.label), number, text, o_word.span);
            *recorder = Some(begun.in_file(Arc::clone(&file.name)));
        }
        Ok(Recorded::Next)
    }
}

/// What follows a line of a file.
enum Recorded {
    Next,
    /// The subroutine is complete.
    Complete,
    /// The file ends.
    End,
}

fn unknown(label: &Label, span: SourceSpan) -> Box<BlockDiagnostic> {
    let message = format!("there is no subroutine {label}");
    BlockDiagnostic::new(DiagnosticCode::UnknownSubroutine, span, message)
}

fn no_file_name(label: &Label, span: SourceSpan) -> Box<BlockDiagnostic> {
    let message = format!("there is no subroutine {label}, and that cannot be a file's name");
    BlockDiagnostic::new(DiagnosticCode::UnknownSubroutine, span, message)
        .because(
            "a subroutine that the program does not define is looked for in a file of its name; with \
             / or \\, or . at its beginning, that would lead into other folders",
        )
        .help("name the subroutine and its file alone, and add the folder to the search path")
}

fn not_taken(label: &Label, name: &str, span: SourceSpan, why: NotTaken) -> Box<BlockDiagnostic> {
    match why {
        NotTaken::None(NoSubroutineFile::Missing { looked_in }) if looked_in.is_empty() => unknown(
            label, span,
        )
        .because(format!(
            "it is not defined before its first call, and there is no folder to look for \
                     {name} in"
        ))
        .help(
            "define it before this line, or give the folder of its file: --subroutine-path, \
                     or `subroutine_path` of [program]",
        ),
        NotTaken::None(NoSubroutineFile::Missing { looked_in }) => unknown(label, span)
            .because(format!(
                "it is not defined before its first call, and there is no {name} in {}",
                looked_in.join(", ")
            ))
            .help(
                "define it before this line, or add the folder of its file: --subroutine-path, or \
                 `subroutine_path` of [program]",
            ),
        why => unusable(&format!("subroutine {label}"), span, why),
    }
}

/// A file that is there and cannot be taken; `what` is looked for in it.
pub(crate) fn unusable(what: &str, span: SourceSpan, why: NotTaken) -> Box<BlockDiagnostic> {
    match why {
        NotTaken::None(NoSubroutineFile::Missing { .. }) => BlockDiagnostic::new(
            DiagnosticCode::UnknownSubroutine,
            span,
            format!("there is no {what}"),
        ),
        NotTaken::None(NoSubroutineFile::Unreadable { path, reason }) => {
            let message = format!("cannot read {path}: {reason}");
            BlockDiagnostic::new(DiagnosticCode::ReadFailed, span, message)
                .because(format!("the {what} is looked for there"))
        }
        NotTaken::TooLong(path) => {
            let message = format!("{path} is too long for a subroutine");
            BlockDiagnostic::new(DiagnosticCode::FlowTooLong, span, message)
                .because(format!(
                    "a file of a subroutine has at most {MAX_SUBROUTINE_BYTES} bytes, and all those of a \
                     program together {MAX_KEPT_BYTES}"
                ))
                .help("write its moves into the program, outside of O words")
        }
    }
}

fn absent(label: &Label, file: &SubroutineFile, span: SourceSpan) -> Box<BlockDiagnostic> {
    let message = format!("{} does not define {label}", file.name);
    BlockDiagnostic::new(DiagnosticCode::UnknownSubroutine, span, message)
        .because("the file of a subroutine has its `sub` and `endsub`, with the same name")
        .help(format!("write `{label} sub` … `{label} endsub` into it"))
}
