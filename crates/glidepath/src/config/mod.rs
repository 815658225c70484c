//! The machine's configuration: TOML text to [`MachineConfig`] in two stages, the first of which
//! knows only syntax and names, the second only values.
//!
//! ```text
//! text ──parse──▶ raw: the shapes of the file ──judge──▶ machine, program: plain values that are right
//! ```
//!
//! Nothing is guessed: a key that is not known or a value out of range refuses the file, with the
//! line, the column and the remedy.

mod compensation;
mod decimal_comma;
mod diagnostic;
mod foreign;
mod instance;
mod judge;
pub mod keys;
mod machine;
mod parse;
mod probe;
mod program;
mod raw;
mod settings;
mod spindle;
mod tolerance_ratio;
mod tool_axis;
mod tree;

pub use compensation::Compensation;
pub use diagnostic::{ConfigDiagnostic, ConfigError, DiagnosticReport};
pub use instance::{INSTANCE_RULE, is_instance_name};
pub(crate) use judge::{Judge, Range};
pub use judge::{MAX_FRAMES_AHEAD, effort, tolerance, tolerance_ratio};
pub use machine::MachineConfig;
pub use probe::ProbeConfig;
pub use program::ProgramConfig;
pub use settings::{
    AxisConfig, FeedbackConfig, HomingBy, InterpolatorConfig, JogConfig, MCodeRule, PathConfig,
};
pub use spindle::SpindleConfig;

use crate::text_file;
use serde::de::DeserializeOwned;
use std::path::Path;

/// Largest configuration file, bytes: the longest machine is described in a hundredth of it.
pub(crate) const MOST_BYTES: u64 = 1 << 20;

/// The machine that is used without `--config`.
pub const EMBEDDED: &str = include_str!("../../machines/mill.toml");

/// A second built-in machine, for benchmarks: the one of published results on corner smoothing.
pub const EMBEDDED_SEED: &str = include_str!("../../machines/seed.toml");

/// Reads a configuration file, or the embedded machine if `path` is `None`: that of `config/mill.toml`.
///
/// # Errors
/// The file cannot be read, or something in it has to be mended.
pub fn load(path: Option<&Path>) -> Result<MachineConfig, ConfigError> {
    let Some(path) = path else {
        return parse("built-in machine", EMBEDDED);
    };
    load_kept(path, path)
}

/// Reads a configuration file that can be read at another place than it has its name from, as what
/// came through a pipe.
///
/// # Errors
/// As [`load`].
pub(crate) fn load_kept(named: &Path, path: &Path) -> Result<MachineConfig, ConfigError> {
    let name = named.display().to_string();
    match text_file::read(path, MOST_BYTES) {
        Ok(text) => {
            let mut config = parse(&name, &text)?;
            // The tool table and folders are named from where the configuration is.
            let folder = named.parent().unwrap_or(Path::new(""));
            let table = config.program.tool_table.take();
            config.program.tool_table = table.map(|table| folder.join(table));
            let state = config.state_directory.take();
            config.state_directory = state.map(|state| folder.join(state));
            for path in &mut config.program.subroutine_path {
                *path = folder.join(&*path);
            }
            Ok(config)
        }
        Err(source) => Err(ConfigError::Unreadable { path: name, source }),
    }
}

/// Judges the text of a configuration; `path` is only used in reports.
///
/// # Errors
/// Everything in the text that has to be mended.
pub fn parse(path: &str, text: &str) -> Result<MachineConfig, ConfigError> {
    parse_as(path, text, parse::EXPLAINED, judge::judge).map_err(|error| {
        let Some(told) = foreign::foreign(path, text) else {
            return error;
        };
        ConfigError::Refused {
            path: path.to_owned(),
            text: text.to_owned(),
            diagnostics: vec![told],
        }
    })
}

/// Where in a text the value of a key stands, if it does.
pub(crate) fn place(text: &str, key: &str) -> Option<core::ops::Range<usize>> {
    tree::Tree::parse(text).ok()?.place(key)
}

/// Judges the text of another file in the way of a configuration: its shape by `T`, its values by
/// `judge`. `path` is only used in reports, `explained` is where its keys are explained.
///
/// # Errors
/// Everything in the text that has to be mended.
pub(crate) fn parse_as<T: DeserializeOwned, R>(
    path: &str,
    text: &str,
    explained: &str,
    judge: impl FnOnce(T, Vec<ConfigDiagnostic>) -> Result<R, Vec<ConfigDiagnostic>>,
) -> Result<R, ConfigError> {
    let (raw, found) = parse::parse(text, explained);
    let early = found.len();
    let judged = match raw {
        Some(raw) => judge(raw, found),
        None => Err(found),
    };
    judged.map_err(|diagnostics| ConfigError::Refused {
        path: path.to_owned(),
        text: text.to_owned(),
        diagnostics: real(text, diagnostics, early),
    })
}

/// The diagnostics without those of values that only stand for what was found wrong `early`.
fn real(text: &str, mut diagnostics: Vec<ConfigDiagnostic>, early: usize) -> Vec<ConfigDiagnostic> {
    let table = |key: &str| {
        key.rsplit_once('.')
            .map_or("", |(table, _)| table)
            .to_owned()
    };
    let mut late = diagnostics.split_off(early);
    let amiss = diagnostics.iter().filter(|d| !d.is_superfluous_key());
    let broken: Vec<String> = amiss.map(|d| table(&d.key)).collect();
    // Values of such a table cannot be judged together; each by itself can.
    late.retain(|d| {
        let is_broken = broken.contains(&d.key) || broken.contains(&table(&d.key));
        let by_itself = ["out of range", "is not known", "is missing"];
        !is_broken || by_itself.iter().any(|words| d.message.contains(words))
    });
    diagnostics.append(&mut late);
    diagnostics.retain(|d| {
        let replaced = |span| tree::Tree::is_replaced(text, span);
        !d.span.as_ref().is_some_and(replaced)
    });
    diagnostics
}
