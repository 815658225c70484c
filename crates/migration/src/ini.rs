//! Files of sections and keys, as LinuxCNC and Klipper have them, with the files they include.

use crate::inputs::Inputs;
use thiserror::Error;

/// Most keys of all files.
const MOST_KEYS: usize = 20_000;
/// Most files included.
const MOST_FILES: usize = 64;

/// Gives the text of an included file by its name, or why it cannot.
pub type Include<'a> = &'a dyn Fn(&str) -> Result<String, String>;

/// The reason why a configuration of another control cannot be read.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{place}: {reason}")]
pub struct ReadError {
    /// The line, with its file if it is not the first one.
    pub place: String,
    /// What is wrong.
    pub reason: String,
}

/// Whose files they are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Style {
    LinuxCnc,
    Klipper,
}

/// How a key of a section is written.
pub(crate) fn written(section: &str, key: &str) -> String {
    format!("[{section}]{key}")
}

struct Reader<'a> {
    style: Style,
    include: Include<'a>,
    inputs: Inputs,
    section: String,
    files: usize,
}

/// Reads a file and those it includes.
///
/// # Errors
/// A line that is neither section, key nor comment; an included file that cannot be read; too much
/// of either.
pub(crate) fn read(text: &str, style: Style, include: Include<'_>) -> Result<Inputs, ReadError> {
    let mut reader = Reader {
        style,
        include,
        inputs: Inputs::named(written),
        section: String::new(),
        files: 0,
    };
    reader.file(text, None)?;
    Ok(reader.inputs)
}

impl Reader<'_> {
    fn file(&mut self, text: &str, name: Option<&str>) -> Result<(), ReadError> {
        // LinuxCNC's lines go on behind a backslash at their end.
        let mut goes_on = false;
        for (index, line) in text.lines().enumerate() {
            let place = match name {
                None => format!("line {}", index + 1),
                Some(name) => format!("{name}, line {}", index + 1),
            };
            let error = |reason: String| ReadError {
                place: place.clone(),
                reason,
            };
            if self.inputs.len() >= MOST_KEYS {
                return Err(error(format!("more than {MOST_KEYS} keys")));
            }
            // Klipper's saved values stand in comments of their own kind.
            let saved = line
                .strip_prefix("#*#")
                .filter(|_| self.style == Style::Klipper);
            let whole = saved.unwrap_or(line);
            let is_indented = whole.starts_with([' ', '\t']) && saved.is_none();
            let bare = self.without_comment(whole.trim());
            let linuxcnc = self.style == Style::LinuxCnc;
            if goes_on || (is_indented && !linuxcnc && !bare.is_empty() && !self.section.is_empty())
            {
                goes_on = linuxcnc && bare.ends_with('\\');
                self.inputs.extend_last(bare.trim_end_matches('\\'));
                continue;
            }
            if let Some(file) = self.included(whole.trim()) {
                self.include(&file, &error)?;
                continue;
            }
            if bare.is_empty() {
                continue;
            }
            if let Some(rest) = bare.strip_prefix('[') {
                let section = rest.split(']').next().unwrap_or_default().trim();
                self.section = section.to_owned();
                continue;
            }
            let separators: &[char] = if linuxcnc { &['='] } else { &[':', '='] };
            let Some((key, value)) = bare.split_once(separators) else {
                if saved.is_some() {
                    continue;
                }
                let what: String = bare.chars().take(40).collect();
                return Err(error(format!(
                    "`{what}` is neither a section nor a key with a value"
                )));
            };
            goes_on = linuxcnc && value.ends_with('\\');
            let value = value.trim_end_matches('\\');
            self.inputs.add(&self.section, key.trim(), value, place);
        }
        Ok(())
    }

    fn without_comment<'t>(&self, line: &'t str) -> &'t str {
        if line.starts_with(['#', ';']) {
            return "";
        }
        // Behind a value a comment has a blank in front.
        let at = match self.style {
            Style::LinuxCnc => None,
            Style::Klipper => [" #", "\t#", " ;", "\t;"]
                .iter()
                .filter_map(|c| line.find(c))
                .min(),
        };
        at.map_or(line, |at| line[..at].trim_end())
    }

    /// The file a line includes.
    fn included(&self, line: &str) -> Option<String> {
        let name = match self.style {
            Style::LinuxCnc => line.strip_prefix("#INCLUDE")?.trim(),
            Style::Klipper => line.strip_prefix("[include")?.split(']').next()?.trim(),
        };
        (!name.is_empty()).then(|| name.to_owned())
    }

    fn include(
        &mut self,
        file: &str,
        error: &dyn Fn(String) -> ReadError,
    ) -> Result<(), ReadError> {
        self.files += 1;
        if self.files > MOST_FILES {
            return Err(error(format!(
                "more than {MOST_FILES} files are included; does one include itself?"
            )));
        }
        let text =
            (self.include)(file).map_err(|why| error(format!("cannot read {file}: {why}")))?;
        self.file(&text, Some(file))
    }
}
