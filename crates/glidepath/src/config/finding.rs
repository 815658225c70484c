//! What is wrong with a configuration, and where.

use core::fmt;
use core::ops::Range;
use miette::{Diagnostic, LabeledSpan, NamedSource, SourceCode};
use thiserror::Error;

/// One thing to mend in a configuration file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Finding {
    /// Dotted name of the key, for example `axis.X.max_velocity`; empty if the file is not TOML.
    pub key: String,
    /// What is wrong.
    pub message: String,
    /// How to mend it.
    pub help: Option<String>,
    /// Bytes of the file it is about.
    pub span: Option<Range<usize>>,
}

/// Why a configuration was refused. Never empty of findings.
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
    #[error("the configuration {path} has {} to mend", counted(findings.len()))]
    Refused {
        /// The file.
        path: String,
        /// Its text.
        text: String,
        /// Everything found, in the order of the file's tables.
        findings: Vec<Finding>,
    },
}

fn counted(findings: usize) -> String {
    if findings == 1 {
        "one thing".to_owned()
    } else {
        format!("{findings} things")
    }
}

impl ConfigError {
    /// The findings, none if the file was unreadable.
    #[must_use]
    pub fn findings(&self) -> &[Finding] {
        match self {
            Self::Unreadable { .. } => &[],
            Self::Refused { findings, .. } => findings,
        }
    }

    /// One printable report for each finding.
    #[must_use]
    pub fn reports(&self) -> Vec<FindingReport> {
        match self {
            Self::Unreadable { path, .. } => vec![FindingReport {
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
                findings,
            } => findings
                .iter()
                .map(|finding| FindingReport {
                    message: finding.message.clone(),
                    help: finding.help.clone(),
                    span: finding.span.clone(),
                    source: Some(NamedSource::new(path, text.clone()).with_language("toml")),
                })
                .collect(),
        }
    }

    /// Line and column, both from 1, of a finding's place; the column counts characters.
    #[must_use]
    pub fn place(&self, finding: &Finding) -> Option<(usize, usize)> {
        let Self::Refused { text, .. } = self else {
            return None;
        };
        let before = text.get(..finding.span.as_ref()?.start)?;
        let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
        let line = 1 + before.matches('\n').count();
        Some((line, 1 + before.get(line_start..)?.chars().count()))
    }
}

/// A finding as miette prints it.
#[derive(Debug)]
pub struct FindingReport {
    message: String,
    help: Option<String>,
    span: Option<Range<usize>>,
    source: Option<NamedSource<String>>,
}

impl fmt::Display for FindingReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for FindingReport {}

impl Diagnostic for FindingReport {
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
