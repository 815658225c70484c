//! The subprogram that a line calls: `L771 P3`, `POCKET_A(5, 2)`, `DRILLING`, and what a path names.

use crate::diagnostic::span::SourceSpan;
use crate::syntax::dialect::siemens::statement::{label, name_at};
use crate::syntax::dialect::words::siemens_names;

/// A name that may be that of a subprogram, and where it stands.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Callee {
    /// As it is written.
    pub(crate) name: Vec<u8>,
    /// The kind of its file where a path says it: `SPF` of `HOLES.SPF` and of `_N_HOLES_SPF`.
    pub(crate) ending: Option<Vec<u8>>,
    pub(crate) start: usize,
    /// Where what names it ends.
    pub(crate) end: usize,
    /// It can be nothing else: `L771`, or a name with parentheses behind it.
    pub(crate) is_sure: bool,
}

impl Callee {
    /// What the last part of a path names; `None` if that is no name.
    pub(crate) fn of_path(path: &[u8], span: SourceSpan) -> Option<Self> {
        let is_separator = |byte: &u8| matches!(byte, b'/' | b'\\' | b':');
        let file = path.trim_ascii().rsplit(is_separator).next()?;
        let (name, ending) = name_and_ending(file);
        let is_name = !name.is_empty() && !name.starts_with(b".");
        is_name.then(|| Self {
            name: name.to_vec(),
            ending: ending.map(<[u8]>::to_vec),
            start: span.start,
            end: span.start + span.length,
            is_sure: true,
        })
    }
}

/// The name in that of a file, and its ending: `_N_HOLES_SPF`, `HOLES_SPF`, `HOLES.SPF`, `HOLES`.
fn name_and_ending(file: &[u8]) -> (&[u8], Option<&[u8]>) {
    let file = match file.split_at_checked(3) {
        Some((head, rest)) if head.eq_ignore_ascii_case(b"_N_") => rest,
        _ => file,
    };
    let tail = file.len().saturating_sub(4);
    if let Some((name, [b'_', ending @ ..])) = file.split_at_checked(tail)
        && [&b"SPF"[..], b"MPF"]
            .iter()
            .any(|kind| ending.eq_ignore_ascii_case(kind))
    {
        return (name, Some(ending));
    }
    match file.iter().rposition(|byte| *byte == b'.') {
        Some(point) => (&file[..point], file.get(point + 1..)),
        None => (file, None),
    }
}

/// What a line calls, if it begins with what may be the name of a subprogram.
pub(crate) fn callee(text: &[u8]) -> Option<Callee> {
    let start = label(text).1;
    let name = name_at(text, start);
    let rest = text.get(start + name.len()..).unwrap_or_default();
    let next = rest.iter().find(|byte| !matches!(byte, b' ' | b'\t'));
    let is_number = |byte: &u8| byte.is_ascii_digit();
    let is_sure = match name {
        [b'L' | b'l', digits @ ..] if !digits.is_empty() && digits.iter().all(is_number) => {
            next != Some(&b'=')
        }
        [first, second, ..]
            if [first, second]
                .iter()
                .all(|byte| byte.is_ascii_alphabetic() || **byte == b'_') =>
        {
            if siemens_names::meaning(&name.to_ascii_uppercase()).is_some() {
                return None;
            }
            match next {
                Some(b'(') => true,
                None | Some(b';' | b'P' | b'p') => false,
                _ => return None,
            }
        }
        _ => return None,
    };
    (is_sure || name.len() > 1 && next != Some(&b'=')).then(|| Callee {
        name: name.to_vec(),
        ending: None,
        start,
        end: start + name.len(),
        is_sure,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_that_may_be_subprograms() {
        for (text, name, is_sure) in [
            ("N10 L771 P3", "L771", true),
            ("l6", "l6", true),
            ("A: DRILL_IT(5, 2)", "DRILL_IT", true),
            ("POCKETS ; all of them", "POCKETS", false),
            ("_CLAMP P2", "_CLAMP", false),
        ] {
            let found = callee(text.as_bytes()).expect(text);
            assert_eq!(
                (found.name, found.is_sure),
                (name.into(), is_sure),
                "{text}"
            );
        }
        for text in [
            "G0 X1",
            "X10",
            "L=5",
            "DEPTH=5",
            "SUPA",
            "TRAORI(1)",
            "MSG(\"A\")",
            "G17 A",
            "T1",
        ] {
            assert_eq!(callee(text.as_bytes()), None, "{text}");
        }
    }

    #[test]
    fn a_path_names_its_last_part() {
        for (path, name, ending) in [
            ("ROUGH", "ROUGH", None),
            ("/_N_WKS_DIR/_N_PART_WPD/_N_ROUGH_SPF", "ROUGH", Some("SPF")),
            ("_N_ROUGH_1_MPF", "ROUGH_1", Some("MPF")),
            ("C:\\NC\\Rough.1.mpf", "Rough.1", Some("mpf")),
            ("LOCAL_DRIVE:ROUGH.SPF ", "ROUGH", Some("SPF")),
            ("_N_AB", "AB", None),
            ("PART_SPF", "PART", Some("SPF")),
            ("PART_XYZ", "PART_XYZ", None),
        ] {
            let found = Callee::of_path(path.as_bytes(), SourceSpan::new(8, 20)).expect(path);
            assert_eq!(
                (found.name, found.ending, found.start, found.end),
                (name.into(), ending.map(Into::into), 8, 20),
                "{path}"
            );
        }
        for path in ["", "/", "../..", ".SPF", "_N_"] {
            assert_eq!(
                Callee::of_path(path.as_bytes(), SourceSpan::default()),
                None,
                "{path}"
            );
        }
    }
}
