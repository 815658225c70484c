//! Lathe cycles along a profile: G70, G71, G71.1, G71.2, G72, G72.1, G72.2.
//!
//! | | |
//! |---|---|
//! | G70 Q X Z D E P | finishes: P passes along the profile, the last one E away from it, the first one (P − 1)/P of the way from E to D |
//! | G71 Q X Z D I R | turns: passes along Z, each I deeper than the one before, up to D from the profile; retreats by R |
//! | G72 Q X Z D I R | faces: the same with passes along X |
//! | G71.1 G72.1, G71.2 G72.2 | without the pockets of the profile, the pockets alone |
//!
//! The profile stands in subroutine Q ([`profile`]). X and Z say where the cycle starts, where they are
//! left out it starts where the tool is: outside the stock, on the side it is to be cut from. D, E and R are zero
//! if they are left out (R: 0.5), I and P are 1.
//!
//! ```text
//!   O100 sub … endsub    G71 Q100            O100 call, its blocks drawn
//!   ───────────────────► rapid to X Z ─────► Profile ─────► pieces ─► offset ─► passes ─► moves
//!                                            (Z and X)      (a and b: frame)
//! ```
//!
//! The subroutine is called as by `O100 call`, with loops and parameters, but its blocks move nothing:
//! [`Profile`] collects what they describe. When it ends the passes are made, all in program coordinates,
//! and given out as if the block of the cycle had moved so.
//!
//! Passes are those of LinuxCNC 2.9. Other than there:
//!
//! * the contour at a distance nowhere comes nearer than that to any part of the profile ([`offset`]);
//! * a start on the side of the workpiece is refused, and a start above the profile is left sideways before
//!   the tool goes down;
//! * between finishing passes the tool rises where the straight way back leads through the part;
//! * codes in the profile that would give its words another meaning are refused, not skipped.

mod corner;
mod frame;
mod offset;
mod passes;
mod profile;
mod run;
#[cfg(test)]
mod tests;

use glidepath_geometry::{Axis, Plane};
use glidepath_program::Item;

use crate::block::Block;
use crate::diagnostic::{Code, Fault, Outcome, Span};
use crate::interpreter::{Interpreter, State};
use crate::modes::{Contour, FeedMode};
use crate::moves::{MIN_MOVE, Pace, motion_span};
use crate::place::SourceLine;
use crate::words::{missing, negative, whole};
use frame::Point;
use profile::Profile;

/// Most finishing passes of a cycle.
const MAX_FINISHING: u32 = 1000;
/// Largest label of a subroutine.
const MAX_LABEL: u32 = 9_999_999;

/// A cycle whose profile is being read.
#[derive(Debug)]
pub(crate) struct OpenContour {
    /// The block of the cycle: its line, the line of the program it is executed by, and what was read.
    source: SourceLine,
    line: u32,
    block: Block,
    /// Calls in progress around it.
    level: usize,
    words: Words,
    profile: Profile,
    /// From before the profile.
    state: State,
}

/// The words of a cycle, mm.
#[derive(Debug, Clone, Copy)]
struct Words {
    contour: Contour,
    /// Distance from the profile, of the first finishing pass or of all roughing.
    distance_mm: f64,
    /// Distance of the last finishing pass.
    end_mm: f64,
    finishing: u32,
    increment_mm: f64,
    retract_mm: f64,
}

impl Interpreter {
    /// Brings the tool to where the cycle starts.
    pub(crate) fn begin_contour(
        &mut self,
        block: &Block,
        contour: Contour,
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        self.check_contour(block)?;
        self.contour_words(block, contour)?;
        let target = self.target(block)?;
        self.without_compensation(block, target, out)?;
        // No axis word behind the cycle can be meant for it.
        self.state.modal.motion = None;
        Ok(())
    }

    /// A rapid move that starts cutter radius compensation again at its end, if it is on.
    fn without_compensation(
        &mut self,
        block: &Block,
        target: glidepath_geometry::AxisVector,
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        let compensation = self.compensation.clone();
        self.end_compensation(out)?;
        if (target - self.state.path_end).amax() > MIN_MOVE {
            self.straight(block, target, Pace::Rapid, out)?;
        }
        self.state.position = target;
        self.state.leaving_contour = false;
        self.compensation = compensation.map(|on| on.again(self.state.path_end));
        Ok(())
    }

    /// Refuses a cycle that cannot be made here.
    fn check_contour(&self, block: &Block) -> Outcome<()> {
        let span = motion_span(block);
        let refuse = |span: Span, message: &str, reason: &str, help: &str| {
            Err(Fault::new(Code::CannedCycle, span, message)
                .because(reason)
                .help(help))
        };
        if self.state.modal.plane != Plane::Zx {
            return refuse(
                span,
                "a lathe cycle outside the ZX plane",
                "its profile is drawn in Z and X",
                "write G18 before it",
            );
        }
        if self.offsets.is_rotated() {
            return refuse(
                span,
                "a lathe cycle in a rotated coordinate system",
                "its plane would be no plane of the machine",
                "set the rotation to zero (G10 L2 R0)",
            );
        }
        if self.state.modal.feed_mode == FeedMode::InverseTime {
            return refuse(
                span,
                "a lathe cycle with inverse-time feed (G93)",
                "the time of the block would be shared by several moves",
                "write G94 or G95",
            );
        }
        let other = |axis: &Axis| !matches!(axis, Axis::X | Axis::Z);
        if let Some(axis) = block.axes().map(|(axis, _)| axis).find(other) {
            return refuse(
                block.axis_span(axis),
                &format!("{axis} in a lathe cycle"),
                "it moves X and Z alone",
                "move the other axes in a block of their own",
            );
        }
        match block.codes.stop {
            Some(stop) => refuse(
                stop.span,
                "a stop in the block of a lathe cycle",
                "the passes come after everything else of the block",
                "give it a block of its own",
            ),
            None => Ok(()),
        }
    }

    fn contour_words(&self, block: &Block, contour: Contour) -> Outcome<Words> {
        let scale = self.state.modal.units.mm();
        let get = |letter: u8, meaning: &str, default: f64| match block.get(letter) {
            Some(value) if value < 0.0 => Err(negative(block, letter, meaning)),
            value => Ok(value.unwrap_or(default) * scale),
        };
        let finishing = whole(block, b'P', MAX_FINISHING)?.unwrap_or(1);
        let increment_mm = get(b'I', "the depth of a pass", 1.0)?;
        let none = [(b'P', finishing == 0), (b'I', increment_mm <= 0.0)];
        if let Some((letter, _)) = none.into_iter().find(|(_, none)| *none) {
            let message = format!("{}0 cuts nothing", char::from(letter));
            return Err(Fault::new(Code::CannedCycle, block.span(letter), message)
                .because("P counts the finishing passes, and I is the depth of a roughing pass")
                .help("write a number above zero"));
        }
        Ok(Words {
            contour,
            distance_mm: get(b'D', "the distance from the profile", 0.0)?,
            end_mm: get(b'E', "the distance from the profile", 0.0)?,
            finishing,
            increment_mm,
            retract_mm: get(b'R', "the retreat", 0.5)?,
        })
    }

    /// Z and X of the tool, program coordinates.
    fn lathe_point(&self) -> Point {
        let program = self.offsets.to_program(self.state.position);
        [program[Axis::Z.index()], program[Axis::X.index()]]
    }
}

/// The subroutine of a cycle.
fn label(block: &Block) -> Outcome<u32> {
    whole(block, b'Q', MAX_LABEL)?.ok_or_else(|| {
        missing(
            motion_span(block),
            "a lathe cycle",
            "Q",
            "the number of the subroutine with the profile",
        )
    })
}
