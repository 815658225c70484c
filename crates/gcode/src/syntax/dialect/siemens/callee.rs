//! The subprogram that a line calls: `L771 P3`, `POCKET_A(5, 2)`, `DRILLING`.

use crate::syntax::dialect::siemens::statement::{label, name_at};
use crate::syntax::dialect::words::siemens_names;

/// A name that may be that of a subprogram, and where it stands.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Callee {
    /// As it is written.
    pub(crate) name: Vec<u8>,
    pub(crate) start: usize,
    /// It can be nothing else: `L771`, or a name with parentheses behind it.
    pub(crate) is_sure: bool,
}

impl Callee {
    /// Where the name ends.
    pub(crate) const fn end(&self) -> usize {
        self.start + self.name.len()
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
        start,
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
}
