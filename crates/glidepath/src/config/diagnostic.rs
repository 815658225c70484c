//! The diagnostics of a configuration: what is wrong, and where.

use core::fmt;
use core::ops::Range;
use miette::{Diagnostic, LabeledSpan, NamedSource, SourceCode};
use thiserror::Error;

/// A diagnostic of a configuration file: one thing to mend.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ConfigDiagnostic {
    /// Dotted name of the key, for example `axis.X.max_velocity`; empty if the file is not TOML.
    pub key: String,
    /// What is wrong.
    pub message: String,
    /// How to mend it.
    pub help: Option<String>,
    /// Bytes of the file it is about.
    pub span: Option<Range<usize>>,
}

impl ConfigDiagnostic {
    /// Whether it is about a key that its table does not have, and that is none of its keys misspelt:
    /// what else is in the table can be judged all the same.
    pub(super) fn is_superfluous_key(&self) -> bool {
        let is_meant = |help: &String| help.starts_with("did you mean");
        self.message.starts_with("unknown key") && !self.help.as_ref().is_some_and(is_meant)
    }
}

/// The reason why a configuration was refused. Never empty of diagnostics.
#[derive(Debug, Error)]
pub enum ConfigError {
    /// The file could not be read.
    #[error("cannot read the configuration {path}: {source}")]
    Unreadable {
        /// The file.
        path: String,
        /// What the system said.
        source: std::io::Error,
    },
    /// The file was read and something in it has to be mended.
    #[error("the configuration {path} has {} to mend", counted(diagnostics.len()))]
    Refused {
        /// The file.
        path: String,
        /// Its text.
        text: String,
        /// Everything found, in the order of the file's tables.
        diagnostics: Vec<ConfigDiagnostic>,
    },
}

fn counted(diagnostics: usize) -> String {
    if diagnostics == 1 {
        "one thing".to_owned()
    } else {
        format!("{diagnostics} things")
    }
}

impl ConfigError {
    /// The diagnostics, none if the file was unreadable.
    #[must_use]
    pub fn diagnostics(&self) -> &[ConfigDiagnostic] {
        match self {
            Self::Unreadable { .. } => &[],
            Self::Refused { diagnostics, .. } => diagnostics,
        }
    }

    /// One printable report for each diagnostic.
    #[must_use]
    pub fn reports(&self) -> Vec<DiagnosticReport> {
        match self {
            Self::Unreadable { path, .. } => vec![DiagnosticReport {
                message: self.to_string(),
                help: Some(format!(
                    "give an existing file to --config, or leave --config out to use the built-in \
                     machine; tried {path}"
                )),
                span: None,
                source: None,
            }],
            Self::Refused {
                path,
                text,
                diagnostics,
            } => diagnostics
                .iter()
                .map(|diagnostic| DiagnosticReport {
                    message: diagnostic.message.clone(),
                    help: diagnostic.help.clone(),
                    span: diagnostic.span.clone(),
                    source: Some(NamedSource::new(path, text.clone()).with_language("toml")),
                })
                .collect(),
        }
    }

    /// Line and column of a diagnostic, both from 1; the column counts characters.
    #[must_use]
    pub fn line_and_column(&self, diagnostic: &ConfigDiagnostic) -> Option<(usize, usize)> {
        let Self::Refused { text, .. } = self else {
            return None;
        };
        let before = text.get(..diagnostic.span.as_ref()?.start)?;
        let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
        let line = 1 + before.matches('\n').count();
        Some((line, 1 + before.get(line_start..)?.chars().count()))
    }
}

/// A diagnostic as miette prints it.
#[derive(Debug)]
pub struct DiagnosticReport {
    message: String,
    help: Option<String>,
    span: Option<Range<usize>>,
    source: Option<NamedSource<String>>,
}

impl fmt::Display for DiagnosticReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for DiagnosticReport {}

impl Diagnostic for DiagnosticReport {
    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        self.help
            .as_ref()
            .map(|help| Box::new(help) as Box<dyn fmt::Display>)
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        self.source.as_ref().map(|source| source as &dyn SourceCode)
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        let span = self.span.clone()?;
        Some(Box::new(core::iter::once(LabeledSpan::underline(span))))
    }
}
