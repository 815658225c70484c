//! The dialects: what the languages of other controls have in the place of RS274/NGC's words.

pub(crate) mod bare_words;
mod codes;
pub(crate) mod detect;
pub(crate) mod fanuc;
mod fanuc_marks;
mod fanuc_words;
pub(crate) mod klipper;
mod lathe_marks;
pub(crate) mod line_body;
pub(crate) mod marlin;
mod mill_marks;
pub(crate) mod other;
pub(crate) mod question;
pub(crate) mod siemens;
pub(crate) mod words;

use serde::{Deserialize, Serialize};

/// The language a program is written in.
///
/// The words all of them share are read as LinuxCNC reads them. What differs:
///
/// | | LinuxCNC | Marlin | FANUC | SIEMENS |
/// |---|---|---|---|---|
/// | program number | `O1` | – | `O1`, `:1` | `%_N_…`, `;$PATH` |
/// | comments | `( )` `;` | `( )` `;` | `( )` | `;`, `MSG( )` |
/// | line check | – | `N… *…` verified | – | – |
/// | parameters | `#1`, `#<name>` | – | `#1` | `R1`, `R[1]`, `DEF REAL`, `INT`, `BOOL` |
/// | expressions | `X[#1+2]` | – | `X[#1+2]`, `X#1` | `X=R1+2` |
/// | subprograms in files | `o<name> call` | – | `M98 P`, `G65 P` | – |
/// | flow | O words | – | `IF` `GOTO` `THEN`, `WHILE` `DO` `END`, `G65`, `M98`, `M99` | `IF` … `ENDIF`, `WHILE`, `FOR`, `LOOP`, `REPEAT`, `GOTO…` |
/// | frames | `G10 L2 R`, `G52`, `G92` | the same | the same | `TRANS`, `ROT`, `MIRROR`, `SCALE`, `A…` |
/// | cycles by name | – | – | – | `CYCLE81` … `83`, `85`, `86`, `POCKET1` … `4`, `MCALL` |
/// | dwell | `G4 P` s | `G4 P` ms, `S` s | `G4 P` ms, `X` s | `G4 F` s |
/// | G0 | rapid | at feed | rapid | rapid |
/// | extruder | – | E: the axis [`Options::extruder`](crate::Options); `M82`, `M83`, `G92 E` | – | – |
/// | tolerance | `G64 P` | – | – | `CYCLE832( )`, `G641 ADIS=`, `G642` … `G645` |
/// | exact stop | `G61`, `G61.1` | – | `G61` | `G60` |
/// | radius of an arc | `R` | `R` | `R` | `CR=`, `TURN=` |
/// | lathe cycles along a profile | `G70` … `G72.2`, in subroutine `Q` | – | refused | refused |
/// | repetitions of a cycle | `L` | – | `K`, `L` | – |
/// | look-ahead on, off | – | – | `G05.1 Q`, `G05 P`, `G08 P`: always on | `FFWON`, `SOFT`, `COMPCAD` …: always on |
/// | machine functions (heaters, fans) | – | events where there is an extruder or a simulation | – | – |
///
/// Programs of grbl are LinuxCNC's; its `$` commands are no part of a program. Everything else a
/// dialect has is refused with the word.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
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
}

impl core::fmt::Display for Dialect {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(self.name())
    }
}
