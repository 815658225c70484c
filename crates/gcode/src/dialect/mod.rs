//! What the languages of other controls have in the place of RS274/NGC's words.

pub(crate) mod fanuc;
mod linuxcnc;
pub(crate) mod marlin;
pub(crate) mod siemens;
mod statement;
mod tape;
mod without_flow;

pub(crate) use tape::Tape;

/// The language a program is written in.
///
/// The words all of them share are read as LinuxCNC reads them. What differs:
///
/// | | LinuxCNC | Marlin | FANUC | SIEMENS |
/// |---|---|---|---|---|
/// | program number | `O1` | – | `O1`, `:1` | `%_N_…`, `;$PATH` |
/// | comments | `( )` `;` | `( )` `;` | `( )` | `;`, `MSG( )` |
/// | line check | – | `N… *…` verified | – | – |
/// | parameters | `#1`, `#<name>` | – | `#1` | `R1` |
/// | expressions | `X[#1+2]` | – | `X[#1+2]`, `X#1` | `X=R1+2` |
/// | flow | O words | – | `IF` `GOTO` `THEN`, `WHILE` `DO` `END`, `G65`, `M98`, `M99` | refused |
/// | dwell | `G4 P` s | `G4 P` ms, `S` s | `G4 P` ms, `X` s | `G4 F` s |
/// | G0 | rapid | at feed | rapid | rapid |
/// | extruder | – | E: the axis [`Options::extruder`](crate::Options); `M82`, `M83`, `G92 E` | – | – |
/// | tolerance | `G64 P` | – | – | `CYCLE832( )`, `G641 ADIS=`, `G642` … `G645` |
/// | exact stop | `G61`, `G61.1` | – | `G61` | `G60` |
/// | radius of an arc | `R` | `R` | `R` | `CR=`, `TURN=` |
/// | lathe cycles along a profile | `G70` … `G72.2`, in subroutine `Q` | – | refused | refused |
/// | repetitions of a cycle | `L` | – | `K`, `L` | – |
/// | look-ahead on, off | – | – | `G05.1 Q`, `G05 P`, `G08 P`: always on | `FFWON`, `SOFT`, `COMPCAD` …: always on |
/// | machine functions (heaters, fans) | – | refused, or events where simulated | – | – |
///
/// Programs of grbl are LinuxCNC's; its `$` commands are no part of a program. Everything else a
/// dialect has is refused with the word.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Dialect {
    /// RS274/NGC as LinuxCNC reads it; grbl too.
    #[default]
    LinuxCnc,
    /// Programs of printers.
    Marlin,
    /// FANUC and HAAS, with macro B.
    Fanuc,
    /// SINUMERIK.
    Siemens,
}

impl Dialect {
    /// Its name in configurations.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::LinuxCnc => "linuxcnc",
            Self::Marlin => "marlin",
            Self::Fanuc => "fanuc",
            Self::Siemens => "siemens",
        }
    }

    /// The dialect the beginning of a program is in: LinuxCNC, unless a line has what only one of
    /// the others has. The number is that of the line, from 1.
    #[must_use]
    pub fn detect(beginning: &[u8]) -> (Self, Option<u32>) {
        let mut number = 0_u32;
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
                (Self::Fanuc, statement::marks(&bare)),
            ];
            if let Some((dialect, _)) = marks.into_iter().find(|(_, marked)| *marked) {
                let ends = beginning.windows(2).filter(|pair| pair == b"\r\n").count();
                let number = if ends > 0 { number.div_ceil(2) } else { number };
                return (dialect, Some(number));
            }
        }
        (Self::LinuxCnc, None)
    }
}

impl core::fmt::Display for Dialect {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(self.name())
    }
}

/// True if the text begins with the word, and no letter follows it.
pub(crate) fn starts_with_word(text: &[u8], word: &[u8]) -> bool {
    text.get(..word.len())
        .is_some_and(|head| head.eq_ignore_ascii_case(word))
        && !text.get(word.len()).is_some_and(u8::is_ascii_alphabetic)
}

/// The text behind blanks, a `/` and a block number.
pub(crate) fn body(text: &[u8]) -> usize {
    let blank = |at: usize| {
        let rest = text.get(at..).unwrap_or_default();
        at + rest
            .iter()
            .take_while(|byte| matches!(byte, b' ' | b'\t'))
            .count()
    };
    let mut at = blank(0);
    if text.get(at) == Some(&b'/') {
        at = blank(at + 1);
    }
    let digits = |at: usize| {
        let rest = text.get(at..).unwrap_or_default();
        rest.iter().take_while(|byte| byte.is_ascii_digit()).count()
    };
    if matches!(text.get(at), Some(b'N' | b'n')) {
        let number = blank(at + 1);
        if digits(number) > 0 {
            return blank(number + digits(number));
        }
    }
    at
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
            (
                "(IF THIS GOTO THAT)\n; M104 R1=2\nG1 X1\n",
                Dialect::LinuxCnc,
                None,
            ),
        ] {
            assert_eq!(Dialect::detect(text.as_bytes()), (dialect, line), "{text}");
        }
    }

    #[test]
    fn the_body_is_behind_the_block_number() {
        for (text, at) in [
            ("G1", 0),
            (" / N10 G1", 7),
            ("N 1 2G1", 4),
            ("N#1", 0),
            ("", 0),
        ] {
            assert_eq!(body(text.as_bytes()), at, "{text}");
        }
    }
}
