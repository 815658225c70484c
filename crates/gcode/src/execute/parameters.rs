//! Numbered and named parameters.
//!
//! | parameter | meaning |
//! |---|---|
//! | `#1` … `#30` | local to a subroutine call; its arguments at first |
//! | `#31` … `#5000` | global, zero at first |
//! | `#5021` … `#5029` | machine coordinates of the position, in the units in force |
//! | `#5061` … `#5070` | program coordinates of the last probing move's end; 1: contact was made |
//! | `#5161` …, `#5181` … | positions of G28 and G30, machine coordinates |
//! | `#5210`, `#5211` … | is G92 in force, and its offsets |
//! | `#5220` | active coordinate system, 1 for G54 |
//! | `#5221` …, `#5241` … | origins of G54, G55 …; the tenth of each is its rotation |
//! | `#5399` | input read by M66 last |
//! | `#5400` … `#5413` | tool in the spindle: number, offsets in force, diameter, –, –, orientation |
//! | `#5599` | 1, or what was assigned: with 0, `(DEBUG, …)` says nothing |
//! | `#5420` … `#5428` | program coordinates of the position, in the units in force |
//! | other numbers to `#5601` | read as zero |
//! | `#<name>` | local to a subroutine call |
//! | `#<_name>` | global |
//!
//! FANUC's variables are others ([`crate::execute::dialect::fanuc::variables`]): 33 locals, and nothing is in
//! one that nothing was assigned to.
//!
//! What describes the machine (from `#5001` on, and the names in [`READ_ONLY`]) cannot be assigned.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::execute::state_names::READ_ONLY;
use crate::setup::kept_variables::{KEPT_VARIABLES, KeptVariables};
use crate::syntax::expression::scope::{LOCALS, Parameter, no_parameter};
use crate::syntax::expression::vacant::VACANT;

/// Largest number that can be assigned.
pub(crate) const MAX_ASSIGNED: u32 = 5000;
/// Largest number that exists.
pub(crate) const MAX_NUMBERED: u32 = 5601;
/// Whether `(DEBUG, …)` says anything.
pub(crate) const DEBUG: u32 = 5599;
/// Variables local to a macro of FANUC.
pub(crate) const FANUC_LOCALS: usize = 33;
/// Most named parameters at a time.
const MAX_NAMES: usize = 10_000;

/// The named parameter that keeps which variable a name is of.
pub(crate) fn place_of_name(name: &str) -> String {
    format!("_setvn.{}", name.to_ascii_lowercase())
}

/// What a subroutine call has for itself.
#[derive(Debug, Clone)]
struct Locals {
    numbered: [f64; FANUC_LOCALS],
    named: BTreeMap<String, f64>,
}

impl Locals {
    const fn of(unassigned: f64) -> Self {
        Self {
            numbered: [unassigned; FANUC_LOCALS],
            named: BTreeMap::new(),
        }
    }
}

/// All parameters a program can assign.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(from = "Carried", into = "Carried")]
pub(crate) struct Parameters {
    /// `#31` and up, by number; empty until one is assigned.
    global: Vec<f64>,
    named: BTreeMap<String, f64>,
    /// One per call level; the first is that of the program itself.
    levels: Vec<Locals>,
    names: usize,
    /// `(DEBUG, …)` says nothing.
    silent: bool,
    /// How many of the first numbers are local to a call.
    locals: usize,
    /// What is in a parameter that nothing was assigned to.
    unassigned: f64,
    /// How many times one was assigned that outlasts a restart.
    changes: u64,
    /// What assignments have replaced since the log began; `None`: nobody may want it back.
    log: Option<Vec<Replaced>>,
}

/// What was in a parameter before an assignment, and how many changes there were.
#[derive(Debug, Clone)]
struct Replaced {
    parameter: Parameter,
    /// `None`: there was no such name.
    value: Option<f64>,
    changes: u64,
}

/// What of the parameters goes from one program to the next, as text.
#[derive(Serialize, Deserialize)]
struct Carried {
    is_fanuc: bool,
    silent: bool,
    global: Vec<f64>,
    named: BTreeMap<String, f64>,
}

impl From<Parameters> for Carried {
    fn from(parameters: Parameters) -> Self {
        Self {
            is_fanuc: parameters.locals == FANUC_LOCALS,
            silent: parameters.silent,
            global: parameters.global,
            named: parameters.named,
        }
    }
}

impl From<Carried> for Parameters {
    fn from(carried: Carried) -> Self {
        let mut parameters = if carried.is_fanuc {
            Self::of_fanuc()
        } else {
            Self::new()
        };
        parameters.silent = carried.silent;
        parameters.global = carried.global;
        parameters.names = carried.named.len();
        parameters.named.extend(carried.named);
        parameters
    }
}

impl Parameters {
    pub(crate) fn new() -> Self {
        Self {
            global: Vec::new(),
            // What a subroutine returned: none was called yet.
            named: ["_value", "_value_returned"]
                .map(|name| (name.to_owned(), 0.0))
                .into(),
            levels: vec![Locals::of(0.0)],
            names: 0,
            silent: false,
            locals: LOCALS,
            unassigned: 0.0,
            changes: 0,
            log: None,
        }
    }

    /// Assignments may have to be taken back from here on.
    pub(crate) fn begin_log(&mut self) {
        self.log = Some(Vec::new());
    }

    /// They stay, or are taken back.
    pub(crate) fn end_log(&mut self, is_done: bool) {
        let log = self.log.take().filter(|_| !is_done).unwrap_or_default();
        for replaced in log.into_iter().rev() {
            match (&replaced.parameter, replaced.value) {
                (Parameter::Named(name), None) => self.forget(name),
                (parameter, value) => self.assign(parameter, value.unwrap_or(self.unassigned)),
            }
            self.changes = replaced.changes;
        }
    }

    /// FANUC's variables.
    pub(crate) fn of_fanuc() -> Self {
        Self {
            levels: vec![Locals::of(VACANT)],
            locals: FANUC_LOCALS,
            unassigned: VACANT,
            ..Self::new()
        }
    }

    /// Puts in what outlasted a restart.
    pub(crate) fn begin_with(&mut self, kept: &KeptVariables) {
        for (number, value) in kept {
            self.assign(&Parameter::Numbered(*number), *value);
        }
        self.changes = 0;
    }

    /// How many times a parameter was assigned that outlasts a restart.
    pub(crate) const fn changes(&self) -> u64 {
        self.changes
    }

    /// Those parameters, by number, without those that are as if nothing was assigned to them.
    pub(crate) fn kept(&self) -> KeptVariables {
        let all = KEPT_VARIABLES.map(|number| (number, self.numbered(number)));
        let unassigned = self.unassigned.to_bits();
        all.filter(|(_, value)| value.to_bits() != unassigned && value.is_finite())
            .collect()
    }

    /// True if both are of the same language.
    pub(crate) const fn is_like(&self, other: &Self) -> bool {
        self.locals == other.locals
    }

    /// Subroutine calls in progress.
    pub(crate) fn call_level(&self) -> usize {
        self.levels.len().saturating_sub(1)
    }

    /// Ends all calls, and forgets what the program had for itself.
    pub(crate) fn leave_all(&mut self) {
        self.levels = vec![Locals::of(self.unassigned)];
    }

    /// Starts a call with these arguments.
    pub(crate) fn enter(&mut self, arguments: &[f64]) {
        let mut locals = Locals::of(self.unassigned);
        for (slot, value) in locals.numbered.iter_mut().zip(arguments) {
            *slot = *value;
        }
        self.levels.push(locals);
    }

    /// The numbered locals of the call in progress.
    pub(crate) fn locals(&self) -> [f64; FANUC_LOCALS] {
        let unassigned = [self.unassigned; FANUC_LOCALS];
        self.levels
            .last()
            .map_or(unassigned, |locals| locals.numbered)
    }

    /// Ends a call, with the value it returned.
    pub(crate) fn leave(&mut self, value: Option<f64>) {
        if self.levels.len() > 1
            && let Some(locals) = self.levels.pop()
        {
            self.names = self.names.saturating_sub(locals.named.len());
        }
        self.named.insert("_value".to_owned(), value.unwrap_or(0.0));
        self.named.insert(
            "_value_returned".to_owned(),
            f64::from(u8::from(value.is_some())),
        );
    }

    /// Refuses an assignment that is not possible.
    pub(crate) fn check_assignable(&self, parameter: &Parameter, span: SourceSpan) -> Outcome<()> {
        match parameter {
            Parameter::Numbered(number) if *number == 0 || *number > MAX_NUMBERED => {
                Err(no_parameter(span, f64::from(*number)))
            }
            Parameter::Numbered(DEBUG) => Ok(()),
            Parameter::Numbered(number) if *number > MAX_ASSIGNED => Err(read_only(span)),
            Parameter::Named(name) if READ_ONLY.contains(&name.as_str()) => Err(read_only(span)),
            Parameter::Named(_) if self.names >= MAX_NAMES => {
                let message = format!("more than {MAX_NAMES} named parameters");
                Err(
                    BlockDiagnostic::new(DiagnosticCode::Parameter, span, message)
                        .because("the memory of a program is bounded")
                        .help("use numbered parameters"),
                )
            }
            _ => Ok(()),
        }
    }

    /// Assigns; the parameter has been found assignable.
    pub(crate) fn assign(&mut self, parameter: &Parameter, value: f64) {
        if self.log.is_some() {
            self.note(parameter);
        }
        match parameter {
            Parameter::Numbered(number) => {
                let index = usize::try_from(*number).unwrap_or(usize::MAX);
                if (1..=self.locals).contains(&index) {
                    if let Some(locals) = self.levels.last_mut() {
                        locals.numbered[index - 1] = value;
                    }
                } else if *number == DEBUG {
                    self.silent = value == 0.0;
                } else if *number <= MAX_ASSIGNED {
                    if self.global.len() <= index {
                        self.global.resize(index + 1, self.unassigned);
                    }
                    self.global[index] = value;
                    self.changes += u64::from(KEPT_VARIABLES.contains(number));
                }
            }
            Parameter::Named(name) => {
                let names = if name.starts_with('_') {
                    &mut self.named
                } else if let Some(locals) = self.levels.last_mut() {
                    &mut locals.named
                } else {
                    return;
                };
                if names.insert(name.clone(), value).is_none() {
                    self.names += 1;
                }
            }
        }
    }

    /// Notes what an assignment replaces.
    fn note(&mut self, parameter: &Parameter) {
        let replaced = Replaced {
            parameter: parameter.clone(),
            value: match parameter {
                Parameter::Numbered(number) => Some(self.numbered(*number)),
                Parameter::Named(name) => self.named(name),
            },
            changes: self.changes,
        };
        if let Some(log) = &mut self.log {
            log.push(replaced);
        }
    }

    /// There is no such name any more.
    fn forget(&mut self, name: &str) {
        let names = if name.starts_with('_') {
            Some(&mut self.named)
        } else {
            self.levels.last_mut().map(|locals| &mut locals.named)
        };
        if names.is_some_and(|names| names.remove(name).is_some()) {
            self.names = self.names.saturating_sub(1);
        }
    }

    pub(crate) fn numbered(&self, number: u32) -> f64 {
        if number == DEBUG {
            return f64::from(u8::from(!self.silent));
        }
        let index = usize::try_from(number).unwrap_or(usize::MAX);
        if (1..=self.locals).contains(&index) {
            return self
                .levels
                .last()
                .map_or(self.unassigned, |locals| locals.numbered[index - 1]);
        }
        self.global.get(index).copied().unwrap_or(self.unassigned)
    }

    pub(crate) fn named(&self, name: &str) -> Option<f64> {
        let names = if name.starts_with('_') {
            &self.named
        } else {
            &self.levels.last()?.named
        };
        names.get(name).copied()
    }
}

fn read_only(span: SourceSpan) -> Box<BlockDiagnostic> {
    BlockDiagnostic::new(
        DiagnosticCode::Parameter,
        span,
        "the parameter cannot be assigned",
    )
    .because("it shows the state of the machine")
    .help("use G10, G28.1, G92 and the like, or another parameter")
}
