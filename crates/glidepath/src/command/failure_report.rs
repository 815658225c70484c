//! A failure as it is told: on standard error, or as the one JSON object of a `--json` command.

use super::failure::Failure;
use super::program_diagnostics::print_diagnostics;
use crate::cli::CliCommand;
use crate::config::ConfigError;
use crate::exit::Exit;
use crate::machine_options::complete;
use crate::output;
use crate::report::diagnostic_object;
use crate::text_diagnostic::TextDiagnostic;
use glidepath_planner::RunError;
use miette::Diagnostic;
use serde_json::{Value, json};

/// Reports a failure in the form asked for and gives the exit code.
#[must_use]
pub(super) fn report(failure: &Failure, command: &CliCommand) -> Exit {
    if command.json() && command.goes_on() {
        output::object_line(&failure_object(failure));
    } else if command.json() {
        output::object(&failure_object(failure));
    } else if let Failure::Configuration(error) = failure {
        let reports = error.reports();
        output::diagnostics(reports.iter().map(|report| report as &dyn Diagnostic));
        output::note(&format!("error: {error}"));
    } else if let Failure::Rejected {
        program,
        diagnostics,
        more,
        ..
    } = failure
    {
        print_diagnostics(program, diagnostics, *more);
        output::note(&format!("error: {failure}"));
    } else {
        if let Failure::Points { rows, .. } = failure {
            output::diagnostics(rows.iter().map(|row| row as &dyn Diagnostic));
        }
        if let Failure::Curve(error) = failure {
            output::diagnostics([error.as_ref() as &dyn Diagnostic]);
        }
        output::note(&format!("error: {failure}"));
    }
    failure.exit()
}

fn failure_object(failure: &Failure) -> Value {
    let found: Vec<Value> = match failure {
        Failure::Configuration(error) => configuration_objects(error),
        Failure::Rejected {
            program,
            diagnostics,
            ..
        } => diagnostics
            .iter()
            .map(|diagnostic| diagnostic_object(program, diagnostic))
            .collect(),
        Failure::Curve(error) => vec![error.object()],
        Failure::Points { rows, .. } => rows.iter().map(TextDiagnostic::object).collect(),
        _ => Vec::new(),
    };
    let mut object = json!({
        "error": complete(&failure.to_string()),
        "exit_code": failure.exit() as u8,
        "findings": found,
    });
    if let Failure::CommandRefused { state, .. }
    | Failure::AtEndOfTravel { state, .. }
    | Failure::CutShort { state, .. } = failure
    {
        object["state"] = (*state).into();
    }
    if let Failure::Planner(RunError::Fault(fault))
    | Failure::Left {
        source: RunError::Fault(fault),
        ..
    } = failure
    {
        object["fault"] = fault.text.as_str().into();
    }
    if let (Failure::EndedEarly { evidence, .. }, Value::Object(object)) = (failure, &mut object)
        && let Value::Object(told) = evidence.object()
    {
        object.extend(told);
    }
    object
}

fn configuration_objects(error: &ConfigError) -> Vec<Value> {
    error
        .diagnostics()
        .iter()
        .map(|diagnostic| {
            let place = error.line_and_column(diagnostic);
            json!({
                "key": diagnostic.key,
                "message": diagnostic.message,
                "help": diagnostic.help,
                "line": place.map(|(line, _)| line),
                "column": place.map(|(_, column)| column),
            })
        })
        .collect()
}
