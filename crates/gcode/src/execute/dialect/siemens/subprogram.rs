//! Subprograms: `L771 P3`, `NAME(5, 2)`, PROC, RET, ENDPROC, M17.
//!
//! A subprogram is looked for in the program, behind a line `%_N_NAME_SPF`, then in a file of its
//! own: `NAME.SPF`, `name.spf`, `_N_NAME_SPF` ([`file_names`] has the order). What a path names
//! ([`named_call`](super::named_call)) is of the kind that the path says. It has variables of its
//! own, and those that PROC names have the values of the call, or are its variables (VAR). It ends at M17, RET, ENDPROC, M2, M30 or with
//! its text. What it leaves in force stays so, but for the modes and the frame where PROC says SAVE.

use std::io::BufRead;

use glidepath_geometry::AXES;

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::execute::dialect::siemens::flow::check_end;
use crate::execute::dialect::siemens::steps::{CallState, ModalCall};
use crate::execute::dialect::tape::{SubprogramCall, TapePlace};
use crate::execute::flow::activation::MAX_CALLS;
use crate::execute::flow::load::unusable;
use crate::execute::program::Program;
use crate::execute::state::modal::Modal;
use crate::execute::state::shared::Shared;
use crate::setup::subroutine_file::{NoSubroutineFile, NotTaken};
use crate::syntax::dialect::siemens::arguments::Argument;
use crate::syntax::dialect::siemens::callee::Callee;
use crate::syntax::dialect::siemens::expression::Evaluator;
use crate::syntax::dialect::siemens::statement::{Statement, is_header_of, statement};
use crate::syntax::dialect::siemens::variables::Variables;

/// Most turns of one call.
const MAX_TURNS: f64 = 9999.0;

/// The files that a subprogram may be in, in the order in which they are looked for.
fn file_names(callee: &Callee) -> Vec<String> {
    let forms = |bytes: &[u8]| {
        let written = String::from_utf8_lossy(bytes).into_owned();
        [
            written.clone(),
            written.to_ascii_uppercase(),
            written.to_ascii_lowercase(),
        ]
    };
    let stems = forms(&callee.name);
    let ending = callee.ending.as_deref();
    let endings = ending.map_or_else(
        || ["SPF", "spf", "MPF", "mpf"].map(str::to_owned).to_vec(),
        |it| forms(it).to_vec(),
    );
    let mut names: Vec<String> = Vec::new();
    for ending in &endings {
        for stem in &stems {
            let name = format!("{stem}.{ending}");
            if !names.contains(&name) {
                names.push(name);
            }
        }
    }
    let kind = ending.map_or_else(|| "SPF".to_owned(), |it| forms(it)[1].clone());
    names.push(format!("_N_{}_{kind}", stems[1]));
    names
}

/// The arguments of a call; none without parentheses, or with nothing in them.
pub(super) fn arguments_ahead(input: &mut Evaluator<'_>) -> Outcome<Vec<Option<Argument>>> {
    if input.next_visible() != Some(b'(') {
        return Ok(Vec::new());
    }
    let arguments = input.call_arguments()?;
    Ok(Some(arguments)
        .filter(|all| !matches!(all.as_slice(), [None]))
        .unwrap_or_default())
}

/// Whether a line is in front of the program that is called: of the name, and of the kind if one is said.
fn is_wanted(line: &[u8], callee: &Callee) -> bool {
    let is_kind = |ending: &[u8]| {
        let line = line.trim_ascii();
        line.len()
            .checked_sub(ending.len())
            .and_then(|at| line.get(at..))
            .is_some_and(|end| end.eq_ignore_ascii_case(ending))
    };
    is_header_of(line, &callee.name) && callee.ending.as_deref().is_none_or(is_kind)
}

impl<R: BufRead> Program<R> {
    /// A line that may call a subprogram; false if it calls none.
    pub(super) fn siemens_call_line(&mut self, text: &[u8], callee: &Callee) -> Outcome<bool> {
        let Some(first) = self.siemens_subprogram(callee)? else {
            return Ok(false);
        };
        let scope = self.scope();
        let mut input = self.evaluator(&scope, text, callee.end);
        let arguments = arguments_ahead(&mut input)?;
        let mut turns = 1.0;
        let at = input.at;
        if input.next_visible() == Some(b'P') {
            input.at += 1;
            turns = if input.eat(b'=') {
                input.value()?
            } else {
                input.literal()?
            };
        }
        let span = SourceSpan::new(at, input.at.max(at + 1));
        check_end(&mut input)?;
        if !(0.0..=MAX_TURNS).contains(&turns) || turns.fract() != 0.0 {
            let message = format!("a subprogram that is called {turns} times");
            return Err(
                BlockDiagnostic::new(DiagnosticCode::InvalidValue, span, message)
                    .because(format!("P is a whole number from 0 to {MAX_TURNS}"))
                    .help("write another number"),
            );
        }
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "range checked"
        )]
        let turns = turns as u32;
        let span = SourceSpan::new(callee.start, callee.end);
        self.siemens_enter((first, turns), arguments, None, span)?;
        Ok(true)
    }

    /// Goes to a subprogram; `modal` is what MCALL has called it by.
    pub(super) fn siemens_enter(
        &mut self,
        (first, turns): (TapePlace, u32),
        arguments: Vec<Option<Argument>>,
        modal: Option<ModalCall>,
        span: SourceSpan,
    ) -> Outcome<()> {
        if self.tape.calls.len() >= MAX_CALLS {
            let message = format!("more than {MAX_CALLS} calls in each other");
            return Err(
                BlockDiagnostic::new(DiagnosticCode::CallDepth, span, message)
                    .because("the depth of calls is bounded")
                    .help("check what should end the recursion"),
            );
        }
        self.siemens_check_arguments(first, &arguments, span)?;
        let Some(again) = turns.checked_sub(1) else {
            return Ok(());
        };
        self.tape.calls.push(SubprogramCall {
            first,
            back: self.tape.place(),
            called_from: self.line_of_program(),
            again,
            caller: 0,
            own_parameters: false,
            keeps_locals: false,
        });
        let own = Shared::new(Variables::at_level(self.tape.calls.len()));
        self.siemens.calls.push(CallState {
            variables: std::mem::replace(&mut self.siemens.variables, own),
            arguments,
            saved: None,
            modal_call: modal,
            steps: Vec::new(),
        });
        self.tape.go_to(first);
        Ok(())
    }

    /// Refuses arguments of a subprogram that takes none.
    pub(super) fn siemens_check_arguments(
        &mut self,
        first: TapePlace,
        arguments: &[Option<Argument>],
        span: SourceSpan,
    ) -> Outcome<()> {
        if arguments.is_empty() || self.siemens_takes_arguments(first)? {
            return Ok(());
        }
        let message = "arguments of a subprogram that takes none";
        Err(
            BlockDiagnostic::new(DiagnosticCode::Expression, span, message)
                .because("its first line is no PROC with names for them")
                .help("write PROC NAME(REAL A, …) there, or leave the arguments out"),
        )
    }

    /// Whether the first statement of a subprogram is PROC.
    fn siemens_takes_arguments(&mut self, first: TapePlace) -> Outcome<bool> {
        let here = self.tape.place();
        self.tape.go_to(first);
        let speaks = |line: &[u8]| {
            let line = line.trim_ascii();
            !line.is_empty() && !line.starts_with(b";") && !line.starts_with(b"%")
        };
        let found = self
            .tape
            .search(first.line, &mut self.source, speaks, |_| false);
        let line = found.map(|line| line.and_then(|line| self.tape.get(line)));
        let is_procedure = line
            .map(|line| line.is_some_and(|(_, text)| statement(text).0 == Statement::Procedure));
        self.tape.go_to(here);
        is_procedure
    }

    /// The end of a subprogram: again, or back to its caller. False if none is in progress.
    pub(super) fn siemens_return(&mut self) -> bool {
        let Some(call) = self.tape.calls.last_mut() else {
            return false;
        };
        let (first, back, again) = (call.first, call.back, call.again);
        call.again = again.saturating_sub(1);
        let depth = self.tape.calls.len();
        self.tape.repetitions.retain(|part| part.depth < depth);
        if let Some(saved) = self
            .siemens
            .calls
            .last_mut()
            .and_then(|call| call.saved.take())
        {
            let (modal, frame) = *saved;
            let present = &mut self.interpreter.state.modal;
            let feed = present
                .feed
                .filter(|_| present.feed_mode == modal.feed_mode);
            *present = Modal {
                feed: feed.or(modal.feed),
                ..modal
            };
            let before = self.interpreter.place_names();
            self.interpreter.state.offsets.frame = frame;
            self.interpreter.rename_by_frame(&before, AXES);
        }
        if again > 0 {
            self.siemens.variables = Shared::new(Variables::at_level(depth));
            self.tape.go_to(first);
            return true;
        }
        self.tape.calls.pop();
        self.tape.go_to(back);
        if let Some(call) = self.siemens.calls.pop() {
            self.siemens.variables = call.variables;
            self.siemens.steps.extend(call.steps);
            if call.modal_call.is_some() {
                self.siemens.modal_call = call.modal_call;
            }
        }
        true
    }

    /// Where a subprogram begins: its first line. `None`: there is none of that name, and the line may
    /// be something else.
    pub(super) fn siemens_subprogram(&mut self, callee: &Callee) -> Outcome<Option<TapePlace>> {
        let ending = callee.ending.iter().flat_map(|it| [&b"."[..], it].concat());
        let name: Vec<u8> = callee.name.iter().copied().chain(ending).collect();
        let name = name.to_ascii_uppercase();
        if let Some(place) = self.tape.known_name(&name) {
            return Ok(Some(place));
        }
        let here = self.tape.place();
        self.tape.go_to(TapePlace { text: 0, line: 0 });
        let wanted = |line: &[u8]| is_wanted(line, callee);
        let header = self.tape.search(0, &mut self.source, wanted, |_| false);
        self.tape.go_to(here);
        let place = match header? {
            Some(header) => TapePlace {
                text: 0,
                line: header + 1,
            },
            None => match self.siemens_file(callee)? {
                Some(place) => place,
                None => return Ok(None),
            },
        };
        self.tape.remember_name(name, place);
        Ok(Some(place))
    }

    /// The subprogram in a file of its own.
    fn siemens_file(&mut self, callee: &Callee) -> Outcome<Option<TapePlace>> {
        let span = SourceSpan::new(callee.start, callee.end);
        let Some(subroutines) = &self.interpreter.options.subroutines else {
            return if callee.is_sure {
                Err(unknown(callee, span, &[]))
            } else {
                Ok(None)
            };
        };
        let file = match subroutines.first_of(file_names(callee)) {
            Ok(file) => file,
            Err(NotTaken::None(NoSubroutineFile::Missing { looked_in })) => {
                return if callee.is_sure {
                    Err(unknown(callee, span, &looked_in))
                } else {
                    Ok(None)
                };
            }
            Err(why) => {
                let shown = String::from_utf8_lossy(&callee.name).into_owned();
                return Err(unusable(&format!("subprogram {shown}"), span, why));
            }
        };
        self.start_of_file(&file).map(Some)
    }
}

#[cold]
fn unknown(callee: &Callee, span: SourceSpan, looked_in: &[String]) -> Box<BlockDiagnostic> {
    let shown = String::from_utf8_lossy(&callee.name).into_owned();
    let ending = callee.ending.as_deref().unwrap_or(b"SPF");
    let ending = String::from_utf8_lossy(ending).to_ascii_uppercase();
    let message = format!("there is no subprogram {shown}");
    let fault = BlockDiagnostic::new(DiagnosticCode::UnknownSubroutine, span, message);
    let fault = if looked_in.is_empty() {
        fault.because("the program has no line `%_N_…_SPF` of that name, and there is no folder to look for it in")
    } else {
        fault.because(format!(
            "the program has no line `%_N_…_{ending}` of that name, and there is no file {}.{ending} in {}",
            shown.to_ascii_uppercase(),
            looked_in.join(", ")
        ))
    };
    fault.help(
        "copy its file beside the program, or give the folder of the file: --subroutine-path, or \
         `subroutine_path` of [program]",
    )
}
