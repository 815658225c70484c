//! The lines of mills' programs that mean one thing to FANUC's and Haas' controls and another thing in
//! LinuxCNC's language, and what tells that a program is LinuxCNC's.
//!
//! | | FANUC, Haas | LinuxCNC |
//! |---|---|---|
//! | holes in G91 | levels of R and Z stay as they were made | each hole counts them anew |
//! | G10 L2, L20 and G92 in G91 | add their words | set them |
//! | P of G4 and of cycles, without a point | milliseconds | seconds |

use crate::syntax::dialect::bare_words::{
    bare_words, has_code, has_letter, value, without_comments,
};
use crate::syntax::dialect::lathe_marks::is_o_word;
use crate::syntax::dialect::question::Doubt;

/// What a line says of the dialect of a mill's program.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum MillMark {
    /// It is LinuxCNC's.
    LinuxCnc,
    /// It is of either, and means something else to each.
    Doubt(Doubt),
}

/// The modes in force on the way through a program, as far as its lines depend on them.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct MillModes {
    /// G91.
    incremental: bool,
    /// A cycle of holes.
    drills: bool,
}

impl MillModes {
    /// What the next line tells, without blanks and in upper case.
    pub(super) fn mark(&mut self, bare: &[u8]) -> Option<MillMark> {
        let text = without_comments(bare);
        if is_linuxcnc(&text) {
            return Some(MillMark::LinuxCnc);
        }
        let words = bare_words(&text);
        let has = |numbers: &[f64]| numbers.iter().any(|number| has_code(&words, b'G', *number));
        let letter = |of: &[u8]| of.iter().any(|letter| has_letter(&words, *letter));
        if has(&[90.0, 91.0]) {
            self.incremental = has(&[91.0]);
        }
        let cycle = has(&[73.0, 74.0, 81.0, 82.0, 83.0, 84.0, 85.0, 86.0, 88.0, 89.0]);
        if has(&[80.0, 0.0, 1.0, 2.0, 3.0, 33.0]) {
            self.drills = false;
        }
        self.drills |= cycle;
        // P0 is no time in either.
        let is_dwell = words.iter().any(|(of, number)| {
            *of == b'P' && !number.contains(&b'.') && value(number).is_some_and(|time| time > 0.0)
        });
        let waits = has(&[4.0, 74.0, 82.0, 84.0, 86.0, 88.0, 89.0]);
        let goes_elsewhere = has(&[4.0, 10.0, 28.0, 30.0, 52.0, 53.0, 92.0]);
        let doubt = if waits && is_dwell {
            Doubt::Dwell
        } else if !self.incremental {
            return None;
        } else if self.drills && !goes_elsewhere && letter(b"XYZRL") {
            Doubt::HolesInG91
        } else if letter(b"XYZABC") && (has(&[92.0]) || has(&[10.0]) && has_work_offset(&words)) {
            Doubt::OffsetInG91
        } else {
            return None;
        };
        Some(MillMark::Doubt(doubt))
    }
}

/// L2 or L20.
fn has_work_offset(words: &[(u8, &[u8])]) -> bool {
    [2.0, 20.0]
        .into_iter()
        .any(|number| has_code(words, b'L', number))
}

/// True for words that no control of FANUC's kind has: subroutines and parameters with names, the path with
/// a tolerance, probing moves, codes with a digit behind the point.
fn is_linuxcnc(text: &[u8]) -> bool {
    let words = bare_words(text);
    let has = |number: f64| has_code(&words, b'G', number);
    // G5.1 Q is FANUC's look-ahead.
    let spline = has(5.1) && has_letter(&words, b'I');
    text.windows(2).any(|pair| pair == b"#<")
        || is_o_word(text)
        || has(64.0) && has_letter(&words, b'P')
        || has(96.0) && has_letter(&words, b'D')
        || spline
        || [
            5.2, 5.3, 28.1, 30.1, 33.1, 38.2, 38.3, 38.4, 38.5, 43.2, 59.1, 59.2, 59.3, 90.1, 91.1,
            92.1, 92.2, 92.3,
        ]
        .into_iter()
        .any(has)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What the lines of a program tell, each with its number.
    fn told(text: &str) -> Vec<(usize, MillMark)> {
        let mut modes = MillModes::default();
        let lines = text.lines().enumerate();
        lines
            .filter_map(|(at, line)| Some((at + 1, modes.mark(line.replace(' ', "").as_bytes())?)))
            .collect()
    }

    #[test]
    fn lines_that_controls_read_otherwise_are_told() {
        let (holes, offset, dwell) = (
            MillMark::Doubt(Doubt::HolesInG91),
            MillMark::Doubt(Doubt::OffsetInG91),
            MillMark::Doubt(Doubt::Dwell),
        );
        for (text, mark) in [
            ("G90 G81 X0 Z-5. R2. F100\nG91 X5. L3\nG80", (2, holes)),
            ("G91\nG98 G83 X5. Z-5. R-3. Q1.", (2, holes)),
            ("G90\nG91 G10 L2 P1 X5.", (2, offset)),
            ("G91\nG10 L20 P1 Z1.", (2, offset)),
            ("G91 G92 X5.", (1, offset)),
            ("G82 X1. Z-5. R1. P50", (1, dwell)),
            ("N5 G04 P2", (1, dwell)),
            ("G86 X1. Z-5. R1. P5 F100.", (1, dwell)),
            ("G89 X1. Z-5. R1. P99", (1, dwell)),
            ("G4 P.5 (P5)\nG38.2 Z-5 F10", (2, MillMark::LinuxCnc)),
            ("O100 CALL [1]", (1, MillMark::LinuxCnc)),
            ("G64 P0.01", (1, MillMark::LinuxCnc)),
        ] {
            assert_eq!(told(text), [mark], "{text}");
        }
        for text in [
            "G90 G81 X0 Z-5. R2. F100\nX5.\nG80\nG91 G28 Z0",
            "G81 X0 Z-5. R2. F100\nG91 G28 Z0\nG0 X1.",
            "G91 X5.\nG90 G10 L2 P1 X5.\nG92 X0",
            "G4 P1.\nG4 P0\nG4 P0.5\nG82 X1. Z-5. R1. P.2",
            "G54 P1\nM98 P50\nG10 L2 P1 X0",
            "G5.1 Q1\nG64\nG5 P10000\n(G91 G92 X5)",
        ] {
            assert_eq!(told(text), [], "{text}");
        }
    }
}
