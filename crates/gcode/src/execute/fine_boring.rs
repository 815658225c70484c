//! G76 of FANUC's and Haas' mills: a hole that is bored, out of which the tool comes without a mark. G87 of
//! FANUC's: the far side of a bore.
//!
//! ```text
//!   bottom: dwell P ── M19: the spindle stops at its angle ── aside, the tip off the wall ──
//!   out at rapid ── back above the hole ── the spindle turns again
//! ```
//!
//! G87:
//!
//! ```text
//!   above the hole: M19 ── aside ── at rapid down to R, below the bore ── back ── the spindle turns ──
//!   at feed up to Z: dwell P ── M19 ── aside ── out at rapid ── back ── the spindle turns again
//! ```
//!
//! The way aside is I and J, or Q in the direction that a parameter of the control gives.

use glidepath_geometry::Plane;
use glidepath_program::{Event, Item, ItemKind};

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::execute::auxiliary::orientation::Orientation;
use crate::execute::cycle_words::name;
use crate::execute::interpreter::Interpreter;
use crate::execute::motion::speed::Pace;
use crate::execute::state::sticky_words::StickyWords;
use crate::setup::fanuc::PointInput;
use crate::syntax::block::Block;
use crate::syntax::modes::CannedCycle;
use crate::syntax::word_check::{missing, unused};

impl Interpreter {
    /// The way aside, along X and Y, mm.
    pub(super) fn bore_shift(
        &self,
        block: &Block,
        cycle: CannedCycle,
        last: Option<StickyWords>,
    ) -> Outcome<[f64; 2]> {
        let (span, name) = (block.motion_span(), name(cycle, block.is_lathe));
        if self.state.modal.plane != Plane::Xy {
            let message = format!("{name} outside G17");
            return Err(
                BlockDiagnostic::new(DiagnosticCode::CannedCycle, span, message)
                    .because("the tool goes aside along X and Y")
                    .help("write G17 before it"),
            );
        }
        if self.state.offsets.is_turned() {
            let message = format!("{name} in coordinates that are turned, mirrored or scaled");
            return Err(BlockDiagnostic::new(DiagnosticCode::CannedCycle, span, message)
                .because("the spindle stops at an angle of the machine: turned with the coordinates, the way aside would lead the tip into the wall")
                .help("end what is in force before it (G69, G50, G50.1), or write G86"));
        }
        self.require_connection(span, "spindle that stops in a known position")?;
        let mm = self.state.modal.units.mm();
        let way = [b'I', b'J'].map(|letter| block.get(letter));
        let shift = match (way, block.get(b'Q'), last) {
            ([None, None], Some(_), _) => self.shift_of_q(block)?,
            ([None, None], None, Some(last)) => last.shift_mm,
            ([None, None], None, None) => {
                let meaning = "the way aside at the bottom";
                return Err(missing(span, name, "Q, or I and J", meaning));
            }
            (_, Some(_), _) => return Err(unused('Q', block.span(b'Q'))),
            (way, None, _) => way.map(|along| along.unwrap_or(0.0) * mm),
        };
        if shift[0].hypot(shift[1]) > 0.0 {
            return Ok(shift);
        }
        let message = format!("{name} goes nowhere aside");
        Err(
            BlockDiagnostic::new(DiagnosticCode::CannedCycle, span, message)
                .because("the tip would scratch the wall on the way out")
                .help("write Q above zero, or G86"),
        )
    }

    /// Q, whose direction is a parameter of the control.
    fn shift_of_q(&self, block: &Block) -> Outcome<[f64; 2]> {
        let span = block.span(b'Q');
        let refuse = |message: &str, reason: &str, help: &str| {
            Err(
                BlockDiagnostic::new(DiagnosticCode::AmbiguousWord, span, message)
                    .because(reason)
                    .help(help),
            )
        };
        let Some(direction) = self.options.fanuc.bore_shift.direction() else {
            return refuse(
                "Q of a boring cycle without its direction",
                "which way takes the tip off the wall is a parameter of the control (5101#4, #5; Haas: setting 27)",
                "set `bore_shift` of [program] to that way, or write I and J",
            );
        };
        if block.has_no_point(b'Q') && block.point == PointInput::Unsaid {
            return refuse(
                "Q of a boring cycle without a decimal point",
                "it is millimetres on one control, and least increments on another",
                "write the point, or set `point` of [program]",
            );
        }
        // Its sign does not count.
        let way = block.get(b'Q').unwrap_or(0.0).abs();
        let way_mm = way * self.state.modal.units.mm() * self.peck_unit(block)?;
        Ok(direction.map(|along| along * way_mm))
    }

    /// Refuses what other controls have by the name of G87: there R is above Z.
    pub(super) fn check_back_bore(&self, block: &Block, [r, top]: [f64; 2]) -> Outcome<()> {
        let refuse = |message: &str, reason: &str, help: &str| {
            Err(
                BlockDiagnostic::new(DiagnosticCode::CannedCycle, block.motion_span(), message)
                    .because(reason)
                    .help(help),
            )
        };
        if self.options.fanuc.is_haas() {
            return refuse(
                "G87 of a Haas is not supported",
                "there it bores downwards, and the tool is drawn out by hand",
                "write G86 or G89",
            );
        }
        if r < top {
            return Ok(());
        }
        refuse(
            "G87 with R above Z",
            "it bores upwards, from R, which is below the bore, to Z",
            "check R and Z; with G91 Z counts from R",
        )
    }

    /// G87: with the tip beside the wall down to R, up to the top at feed, and out as it came in.
    pub(super) fn bore_back(
        &mut self,
        block: &Block,
        words: &StickyWords,
        [r, top, clear]: [f64; 3],
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        self.tell_orientation(Orientation::OWN, out);
        self.pass_bore(block, words, r, out)?;
        let mut place = self.state.offsets.to_program(self.state.position);
        place[2] = top;
        self.straight(block, self.state.offsets.to_machine(place), Pace::Feed, out)?;
        self.leave_bore(block, words, clear, out)
    }

    /// Aside, at rapid to a level, and back; then the spindle turns again.
    fn pass_bore(
        &mut self,
        block: &Block,
        words: &StickyWords,
        level: f64,
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        let mut place = self.state.offsets.to_program(self.state.position);
        for (axis, way) in words.shift_mm.into_iter().enumerate() {
            place[axis] += way;
        }
        self.straight(
            block,
            self.state.offsets.to_machine(place),
            Pace::Rapid,
            out,
        )?;
        place[2] = level;
        self.straight(
            block,
            self.state.offsets.to_machine(place),
            Pace::Rapid,
            out,
        )?;
        for (axis, way) in words.shift_mm.into_iter().enumerate() {
            place[axis] -= way;
        }
        self.straight(
            block,
            self.state.offsets.to_machine(place),
            Pace::Rapid,
            out,
        )?;
        if let Some(turning) = self.state.spindle.turning {
            self.push(out, ItemKind::Event(Event::MCode(turning.code())));
        }
        Ok(())
    }

    /// From the bottom of a hole to above it.
    pub(super) fn leave_bore(
        &mut self,
        block: &Block,
        words: &StickyWords,
        clear: f64,
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        if words.dwell_s > 0.0 {
            self.push(out, ItemKind::Dwell(words.dwell_s));
        }
        self.tell_orientation(Orientation::OWN, out);
        self.pass_bore(block, words, clear, out)
    }
}
