//! The arguments that newer controls have behind those of a cycle for holes: GMODE, DMODE and AMODE,
//! which say how the others are meant.
//!
//! | | ones | tens |
//! |---|---|---|
//! | GMODE | 0 | 0: the depth is that of the tip |
//! | DMODE | 0: the plane in force; 1, 2, 3: G17, G18, G19 | 0 |
//! | AMODE | 0: DP or DPR is the depth, whichever is written; 1: an increment; 2: a coordinate | DTB: 0, 1 seconds; 2 turns |
//!
//! CYCLE83 has other arguments in front of them (AXN, MDEP, VRT, DTD, DIS1, which
//! [the cycle](super::drilling) reads), and further digits of AMODE for its other depths and dwells.

use glidepath_geometry::Plane;

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;

/// The cycles that have them, and which of their arguments is the dwell at the bottom.
const HOLES: [(&str, Option<usize>); 8] = [
    ("CYCLE81", Some(DTB)),
    ("CYCLE82", Some(5)),
    ("CYCLE83", Some(8)),
    ("CYCLE85", Some(5)),
    ("CYCLE86", Some(5)),
    ("CYCLE87", None),
    ("CYCLE88", Some(5)),
    ("CYCLE89", Some(5)),
];
/// What AMODE of CYCLE83 may say of its other depths and dwells, without ones and tens: nothing, or what
/// its arguments mean by themselves.
const OTHERS_OF_83: [i32; 2] = [0, 10_011];
/// Places of arguments that all of them have.
const RFP: usize = 1;
const DP: usize = 3;
const DPR: usize = 4;
/// The dwell of most of them; CYCLE81 of older controls does not have it.
const DTB: usize = 5;
/// Arguments of CYCLE83 between the older ones and GMODE.
const OF_83: usize = 5;

/// A call that is looked at.
#[derive(Clone, Copy)]
pub(super) struct Newer {
    pub(super) name: &'static str,
    /// How many arguments come before the newer ones.
    pub(super) most: usize,
    pub(super) plane: Plane,
    pub(super) span: SourceSpan,
}

impl Newer {
    /// Puts the depth into the argument that it is meant as.
    ///
    /// # Errors
    /// An argument says something that is not made.
    pub(super) fn settle(self, arguments: &mut [Option<f64>]) -> Outcome<()> {
        let get = |index: usize| arguments.get(index).copied().flatten();
        let more = arguments.iter().skip(self.most).flatten();
        if more.copied().all(|value| value == 0.0) {
            return Ok(());
        }
        let hole = HOLES.into_iter().find(|(name, _)| *name == self.name);
        let Some((_, dwell)) = hole else {
            return Err(self.more());
        };
        let is_deep = self.name == "CYCLE83";
        let modes = self.most + if is_deep { OF_83 } else { 0 };
        if arguments.len() > modes + 3 {
            return Err(self.more());
        }
        if let Some(axis) = get(self.most).filter(|axis| is_deep && ![0.0, 3.0].contains(axis)) {
            let reason = "the hole is along the axis normal to the plane: AXN 0 or 3";
            return Err(self.refused(&format!("AXN is {axis}"), reason));
        }
        if let Some(geometry) = get(modes).filter(|geometry| *geometry != 0.0) {
            let reason = "other than 0 it takes the depth for that of the shank, or for a diameter";
            return Err(self.refused(&format!("GMODE is {geometry}"), reason));
        }
        let plane = get(modes + 1).filter(|plane| *plane != 0.0);
        if let Some(named) = plane
            && plane != number_of(self.plane)
            && !self.is_without_dwell(arguments)
        {
            return Err(self.refused(
                &format!("DMODE is {named}"),
                if self.name == "CYCLE81" {
                    "behind DTB and GMODE it names another plane than the one in force"
                } else {
                    "it names another plane than the one in force"
                },
            ));
        }
        let amode = get(modes + 2).unwrap_or(0.0);
        let known: &[i32] = if is_deep { &OTHERS_OF_83 } else { &[0] };
        let unknown = || {
            self.refused(
                &format!("AMODE is {amode}"),
                "it has digits that are not known",
            )
        };
        let amode = whole(amode).filter(|amode| known.contains(&(amode / 100)));
        let amode = amode.ok_or_else(unknown)?;
        let has_dwell = dwell.and_then(get).is_some_and(|dwell| dwell != 0.0);
        match amode / 10 % 10 {
            0 | 1 => {}
            2 if !has_dwell => {}
            _ => {
                let reason = "it counts the dwell in turns of the spindle, which are not counted";
                return Err(self.refused(&format!("AMODE is {amode}"), reason));
            }
        }
        match amode % 10 {
            0 => Ok(()),
            1 => self.increment(arguments),
            2 => {
                if let Some(increment) = arguments.get_mut(DPR) {
                    *increment = None;
                }
                Ok(())
            }
            _ => Err(unknown()),
        }
    }

    /// CYCLE81 of a post that leaves DTB out, so that AMODE 10 stands where the control reads DMODE: with zeros before
    /// it, it is the same hole either way.
    fn is_without_dwell(self, arguments: &[Option<f64>]) -> bool {
        let zeros = arguments.iter().skip(DTB).take(2).flatten();
        self.name == "CYCLE81"
            && zeros.copied().all(|value| value == 0.0)
            && matches!(arguments.get(DTB + 2..), Some([Some(10.0)]))
    }

    /// The depth is an increment: DPR, or DP where it cannot be a coordinate below the surface, or is the
    /// same as one.
    fn increment(self, arguments: &mut [Option<f64>]) -> Outcome<()> {
        let get = |index: usize| arguments.get(index).copied().flatten();
        let written = get(DPR).filter(|depth| *depth != 0.0);
        let (None, Some(depth)) = (written, get(DP)) else {
            return Ok(());
        };
        let surface = get(RFP).unwrap_or(0.0);
        let is_same = (surface - depth.abs() - depth).abs() < 1e-9;
        if depth < surface && !is_same {
            let message = format!("{}: AMODE takes DP {depth} for an increment", self.name);
            return Err(BlockDiagnostic::new(DiagnosticCode::CannedCycle, self.span, message)
                .because("as a coordinate it would be below the surface, too, and the bottom another one")
                .help("write the increment as DPR, or AMODE 12 for a coordinate"));
        }
        if let Some(increment) = arguments.get_mut(DPR) {
            *increment = Some(depth.abs());
        }
        Ok(())
    }

    #[cold]
    fn more(self) -> Box<BlockDiagnostic> {
        let message = format!("{} with more than {} arguments", self.name, self.most);
        BlockDiagnostic::new(DiagnosticCode::NotSupported, self.span, message)
            .because("what the others mean depends on the version of the control")
            .help("leave them out, or let the CAM system write plain blocks")
    }

    #[cold]
    fn refused(self, what: &str, reason: &str) -> Box<BlockDiagnostic> {
        let message = format!("{}: {what}", self.name);
        BlockDiagnostic::new(DiagnosticCode::NotSupported, self.span, message)
            .because(reason)
            .help("write another value, or let the CAM system write plain blocks")
    }
}

/// DMODE of a plane.
pub(super) const fn number_of(plane: Plane) -> Option<f64> {
    match plane {
        Plane::Xy => Some(1.0),
        Plane::Zx => Some(2.0),
        Plane::Yz => Some(3.0),
        Plane::Uv | Plane::Wu | Plane::Vw => None,
    }
}

/// A number of digits.
fn whole(value: f64) -> Option<i32> {
    let is_whole = (value - value.round()).abs() < 1e-9 && (0.0..1e8).contains(&value);
    #[expect(clippy::cast_possible_truncation, reason = "range checked")]
    is_whole.then_some(value.round() as i32)
}
