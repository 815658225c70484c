//! Configurations of other controls that are given as one of ours.

use super::diagnostic::ConfigDiagnostic;
use glidepath_migration::recognised;

/// What is told of such a text, in place of all that TOML would find in it.
pub(super) fn foreign(path: &str, text: &str) -> Option<ConfigDiagnostic> {
    let found = recognised(text)?;
    let (file, command) = (found.control.file(), found.control.command());
    Some(ConfigDiagnostic {
        key: String::new(),
        message: format!("this is {file}, and no configuration of Glidepath"),
        help: Some(format!(
            "convert it: `glidepath {command} {path} > machine.toml`; what is asked for there has to be written, \
             then --config takes machine.toml"
        )),
        span: Some(found.line),
    })
}
