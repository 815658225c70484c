//! The detection of a program's dialect, by what only one of them has.

use crate::syntax::dialect::{Dialect, fanuc, marlin, siemens};

impl Dialect {
    /// The dialect the beginning of a program is in: LinuxCNC, unless a line has what only one of
    /// the others has. The number is that of the line, from 1.
    #[must_use]
    pub fn detect(beginning: &[u8]) -> (Self, Option<u32>) {
        let (mut number, mut has_program_number) = (0_u32, false);
        for line in beginning.split(|byte| matches!(byte, b'\n' | b'\r')) {
            // Two line ends in a row count once too often with CR LF; the number is for a message.
            number = number.saturating_add(1);
            let bare: Vec<u8> = line
                .iter()
                .filter(|byte| !byte.is_ascii_whitespace())
                .map(u8::to_ascii_uppercase)
                .collect();
            let marks = [
                (Self::Siemens, siemens::marks(&bare)),
                (Self::Marlin, marlin::marks(&bare)),
                (Self::Fanuc, fanuc::marks(&bare)),
                (
                    Self::Fanuc,
                    has_program_number && fanuc::marks_behind_number(&bare),
                ),
            ];
            has_program_number |= fanuc::is_program_number(&bare);
            if let Some((dialect, _)) = marks.into_iter().find(|(_, marked)| *marked) {
                let ends = beginning.windows(2).filter(|pair| pair == b"\r\n").count();
                let number = if ends > 0 { number.div_ceil(2) } else { number };
                return (dialect, Some(number));
            }
        }
        (Self::LinuxCnc, None)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
            assert_eq!(Dialect::detect(text.as_bytes()), (dialect, line), "{text}");
        }
    }
}
