//! The detection of a program's dialect, by what only one of them has.

use crate::setup::machine::Machine;
use crate::syntax::dialect::lathe_marks::{LatheMark, lathe_mark};
use crate::syntax::dialect::mill_marks::{MillMark, MillModes};
use crate::syntax::dialect::question::{DialectQuestion, Doubt};
use crate::syntax::dialect::{Dialect, fanuc_marks, marlin, siemens};

/// The detected dialect of a program.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Detection {
    /// The dialect: LinuxCNC, unless a line has what only one of the others has.
    pub dialect: Dialect,
    /// The line that tells, from 1; `None`: nothing does, or it is LinuxCNC's.
    pub line: Option<u32>,
    /// What has to be asked before the program is read: nothing tells, and another control would
    /// make other moves of it.
    pub question: Option<DialectQuestion>,
}

impl Detection {
    const fn of(dialect: Dialect, line: Option<u32>) -> Self {
        Self {
            dialect,
            line,
            question: None,
        }
    }

    /// The dialect of a program for a machine that is executed as it comes, so that nothing of it can be
    /// looked at before: LinuxCNC, which a lathe's program has to be asked for.
    #[must_use]
    pub fn of_stream(machine: &Machine) -> Self {
        let question = machine.is_lathe().then(|| DialectQuestion {
            doubt: Doubt::Stream,
            line: 1,
            text: Box::default(),
        });
        Self {
            question,
            ..Self::of(Dialect::LinuxCnc, None)
        }
    }
}

impl Dialect {
    /// The dialect that the beginning of a program for a machine is in.
    #[must_use]
    pub fn detect(beginning: &[u8], machine: &Machine) -> Detection {
        let is_lathe = machine.is_lathe();
        let (mut number, mut has_program_number) = (0_u32, false);
        let mut question: Option<DialectQuestion> = None;
        let (mut mill, mut is_linuxcnc) = (MillModes::default(), false);
        let ends = beginning.windows(2).filter(|pair| pair == b"\r\n").count();
        for line in beginning.split(|byte| matches!(byte, b'\n' | b'\r')) {
            // Two line ends in a row count once too often with CR LF; the number is for a message.
            number = number.saturating_add(1);
            let shown = if ends > 0 { number.div_ceil(2) } else { number };
            let bare: Vec<u8> = line
                .iter()
                .filter(|byte| !byte.is_ascii_whitespace())
                .map(u8::to_ascii_uppercase)
                .collect();
            let of_lathe = is_lathe.then(|| lathe_mark(&bare, machine)).flatten();
            let is_fanuc = fanuc_marks::marks(&bare)
                || has_program_number && fanuc_marks::marks_behind_number(&bare)
                || has_program_number
                    && !is_lathe
                    && fanuc_marks::marks_of_mill_behind_number(&bare)
                || of_lathe == Some(LatheMark::Fanuc)
                || has_program_number && matches!(of_lathe, Some(LatheMark::Doubt(_)));
            let marks = [
                (Self::Siemens, siemens::marks(&bare)),
                (Self::Marlin, marlin::marks(&bare)),
                (Self::Fanuc, is_fanuc),
            ];
            if let Some((dialect, _)) = marks.into_iter().find(|(_, marked)| *marked) {
                return Detection::of(dialect, Some(shown));
            }
            if of_lathe == Some(LatheMark::LinuxCnc) {
                return Detection::of(Self::LinuxCnc, None);
            }
            let of_mill = if is_lathe { None } else { mill.mark(&bare) };
            is_linuxcnc |= of_mill == Some(MillMark::LinuxCnc);
            let is_number = fanuc_marks::is_program_number(&bare);
            has_program_number |= is_number;
            let doubt = match (of_lathe, of_mill) {
                (Some(LatheMark::Doubt(doubt)), _) => Some(doubt),
                (_, Some(MillMark::Doubt(doubt))) => has_program_number.then_some(doubt),
                _ => (is_lathe && is_number).then_some(Doubt::Number),
            };
            if let Some(doubt) = doubt.filter(|_| question.is_none()) {
                question = Some(DialectQuestion {
                    doubt,
                    line: shown,
                    text: line.into(),
                });
            }
        }
        Detection {
            question: question.filter(|_| !is_linuxcnc),
            ..Detection::of(Self::LinuxCnc, None)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glidepath_geometry::Axis;

    #[test]
    fn dialects_are_told_by_what_only_they_have() {
        for (text, dialect, line) in [
            (
                "%\n(part)\nO100 sub\nG1 X1\nO100 endsub\n#1=2\nM2\n",
                Dialect::LinuxCnc,
                None,
            ),
            ("G21\nM82\nG92 E0\n", Dialect::Marlin, Some(2)),
            ("N1 G28*18\n", Dialect::Marlin, Some(1)),
            ("%\r\n:0097\r\nG0 X1\r\n", Dialect::Fanuc, Some(2)),
            ("O1\nN5 IF [#1 EQ 2] GOTO 10\n", Dialect::Fanuc, Some(2)),
            ("O1\nG43 H03 Z15.\n", Dialect::Fanuc, Some(2)),
            ("O1\nG1 G41 D1 X5. F100.\n", Dialect::Fanuc, Some(2)),
            ("G43 H03 Z15.\nG41 D1 X5.\n", Dialect::LinuxCnc, None),
            (
                "O100 while [#1 LT 3]\nO100 endwhile\n",
                Dialect::LinuxCnc,
                None,
            ),
            ("%_N_PART_MPF\nG1 X1\n", Dialect::Siemens, Some(1)),
            ("N10 R1=5\nN20 G1 X=R1\n", Dialect::Siemens, Some(1)),
            ("G17 G90\nG0 X=AC(10) Y5\n", Dialect::Siemens, Some(2)),
            (
                "G0 X10\n\nCYCLE81(10, 0, 2, -5)\n",
                Dialect::Siemens,
                Some(3),
            ),
            ("G0 X10\nG2 X20 Y5 CR=12.5\n", Dialect::Siemens, Some(2)),
            (
                "(IF THIS GOTO THAT)\n; M104 R1=2\nG1 X1\n",
                Dialect::LinuxCnc,
                None,
            ),
        ] {
            let found = Dialect::detect(text.as_bytes(), &Machine::unlimited());
            assert_eq!((found.dialect, found.line), (dialect, line), "{text}");
        }
    }

    /// The dialect of a lathe's program, and what is asked.
    fn on_lathe(text: &str) -> (Dialect, Option<(Doubt, u32)>) {
        let lathe = Machine::new(&[Axis::X, Axis::Z]);
        let found = Dialect::detect(text.as_bytes(), &lathe);
        let asked = found.question.map(|asked| (asked.doubt, asked.line));
        (found.dialect, asked)
    }

    #[test]
    fn programs_of_lathes_are_told_or_asked_for() {
        // What only FANUC's lathes have.
        for text in [
            "%\nO0001\nG99 G97 S500 M3\nG0 X60. Z50.\n",
            "O1\nG0 X52. Z2.\nG90 X48. Z-30. F200\n",
            "%\nO7\nG92 X20. Z-30. F1.5\n",
            "O7\nG94 X0 Z-1. F.1\n",
            "G28 U0\nG28 W0\nG0 X60. Z50.\n",
            "G0 X10.\nG1 U-2. W-1. F.1\n",
            "N1 G0 T0303\n",
        ] {
            assert_eq!(on_lathe(text), (Dialect::Fanuc, None), "{text}");
        }
        // What FANUC's and LinuxCNC's have, with other moves.
        for (text, asked) in [
            ("G21\nG0 X52 Z2\nG90 X48 Z-30 F200\n", (Doubt::Cycle, 3)),
            ("G92 X20 Z-30 F1.5\nX19.5\n", (Doubt::Cycle, 1)),
            ("G99\nG0 X10\n", (Doubt::FeedMode, 1)),
            ("%\nO0001\nG21\nG0 X10. Z5.\n", (Doubt::Number, 2)),
        ] {
            assert_eq!(on_lathe(text), (Dialect::LinuxCnc, Some(asked)), "{text}");
        }
        // What LinuxCNC's have alone, or with the same moves.
        for text in [
            "%\nO0001\nG8\nG0 X10. Z5.\n",
            "O1\nG7 G90 X48 Z-30 F200\n",
            "G90 G1 X48 Z-30 F200\n",
            "G90 G94 G18\nG0 X10\nG92 X0 Z0\n",
            "O100 sub\nG99\nO100 endsub\n",
            "G21\nT1 M6 G43\nG99\n",
            "T1010 M6\nG0 X1\n",
            "(USE W1 AND U2)\nG64 P0.01\nG98\n",
            "G83 G99 Z-5 R1 Q1 F50\n",
        ] {
            assert_eq!(on_lathe(text), (Dialect::LinuxCnc, None), "{text}");
        }
        // What comes through a pipe is not seen before it is executed.
        let lathe = Machine::new(&[Axis::X, Axis::Z]);
        assert!(Detection::of_stream(&lathe).question.is_some());
        assert_eq!(Detection::of_stream(&Machine::unlimited()).question, None);
        // Of a mill's programs these mean the same to both.
        let mill = Machine::new(&[Axis::X, Axis::Y, Axis::Z]);
        let found = Dialect::detect(b"%\nO1\nG99\nG90 X4 Z5 F200\n", &mill);
        assert_eq!((found.dialect, found.question), (Dialect::LinuxCnc, None));
    }

    /// What is asked of a mill's program.
    fn asked_of_mill(text: &str) -> Option<(Doubt, u32)> {
        let found = Dialect::detect(text.as_bytes(), &Machine::unlimited());
        found.question.map(|asked| (asked.doubt, asked.line))
    }

    #[test]
    fn programs_of_mills_with_a_number_are_asked_for_where_it_matters() {
        for (text, asked) in [
            (
                "%\nO0013\nG81 Z-5. R2. X0\nG91 X5. L3\nG80\nM30\n%\n",
                (Doubt::HolesInG91, 4),
            ),
            (
                "%\r\nO0013 (PART)\r\nG91 G10 L2 P1 X5.\r\n",
                (Doubt::OffsetInG91, 3),
            ),
            ("O13\nG91\nG92 X5.\n", (Doubt::OffsetInG91, 3)),
            ("%\nO13\nG4 P50\n", (Doubt::Dwell, 3)),
        ] {
            assert_eq!(asked_of_mill(text), Some(asked), "{text}");
        }
        for text in [
            // No number; what decides for LinuxCNC, before or behind; what both read alike.
            "%\nG91 G92 X5.\nG4 P50\n",
            "%\nO100 sub\nG4 P50\nO100 endsub\nM2\n%\n",
            "O13\nG4 P50\nG64 P0.01\n",
            "O13\n#<wait>=5\nG4 P50\n",
            "O13\nG4 P0.5\nG81 X0 Z-5 R2\nG80\nG91 G28 Z0\n",
        ] {
            assert_eq!(asked_of_mill(text), None, "{text}");
        }
        // What tells a FANUC needs no question.
        let told = "O13\nG91 G92 X5.\nG43 H1 Z5.\n";
        let found = Dialect::detect(told.as_bytes(), &Machine::unlimited());
        assert_eq!((found.dialect, found.question), (Dialect::Fanuc, None));
    }
}
