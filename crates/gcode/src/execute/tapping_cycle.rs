//! Holes of G84 and G74: with a tap in a holder that gives way, or rigidly, behind the spindle or
//! by it where it is an axis.
//!
//! Rigidly where the machine is configured so (`rigid_tapping`), and behind FANUC's M29, for the
//! series of holes that comes next. The way of a revolution is F / S, in G95 F. Behind M29, as an axis,
//! and on a Haas whose spindle stood, the spindle stands between the holes, as on those controls.

use glidepath_program::{Event, Item, ItemKind};

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::execute::interpreter::Interpreter;
use crate::execute::motion::planned_tap::TappedHole;
use crate::execute::motion::rigid_tap::needs_axis;
use crate::execute::motion::speed::Pace;
use crate::execute::state::spindle::SpindleDirection;
use crate::execute::state::sticky_words::StickyWords;
use crate::syntax::block::Block;
use crate::syntax::dialect::Dialect;
use crate::syntax::modes::{CannedCycle, FeedMode};

/// Which way a tap turns into a hole.
pub(super) const fn tap_turns(cycle: CannedCycle) -> Option<SpindleDirection> {
    match cycle {
        CannedCycle::TapRight => Some(SpindleDirection::Clockwise),
        CannedCycle::TapLeft => Some(SpindleDirection::Counterclockwise),
        _ => None,
    }
}

impl Interpreter {
    /// M29: the next tapping cycle is rigid. The spindle stands until it begins.
    pub(crate) fn arm_rigid_tapping(&mut self, block: &Block, out: &mut Vec<Item>) -> Outcome<()> {
        let Some(coded) = block.codes.rigid_tapping else {
            return Ok(());
        };
        if self.options.spindle_axis.is_none() {
            self.known_angle(coded.span)?;
        }
        self.state.spindle.is_rigid = true;
        if self.state.spindle.turning.is_some() {
            self.turn_spindle(None);
            self.push(out, ItemKind::Event(Event::MCode(5)));
        }
        Ok(())
    }

    /// Settles whether a cycle that taps does so rigidly; `last` is the hole before.
    pub(super) fn settle_rigidity(
        &mut self,
        block: &Block,
        last: Option<&StickyWords>,
        sticky: &mut StickyWords,
    ) -> Outcome<()> {
        if tap_turns(sticky.cycle).is_none() {
            return Ok(());
        }
        let is_armed = core::mem::take(&mut self.state.spindle.is_rigid);
        let options = &self.options;
        let is_configured = options.threading.is_some_and(|it| it.rigid_tapping)
            || options.spindle_axis.is_some_and(|it| it.rigid_tapping);
        // G84 of a Haas turns the spindle on by itself, where it stands.
        let is_haas = block.dialect == Dialect::Fanuc && options.fanuc.is_haas() && is_configured;
        let stands = self.state.spindle.turning.is_none();
        sticky.starts_spindle =
            is_armed || is_haas && stands || last.is_some_and(|last| last.starts_spindle);
        sticky.is_rigid = sticky.starts_spindle || is_configured;
        let has_pecks = sticky.peck > 0.0;
        if !sticky.is_rigid && has_pecks {
            let message = "tapping in several depths (Q) with a tap in a holder is not supported";
            return Err(BlockDiagnostic::new(
                DiagnosticCode::NotSupported,
                block.span(b'Q'),
                message,
            )
            .because("a tap that gives way does not find back into its thread")
            .help("leave Q out, or tap rigidly by a spindle that is an axis"));
        }
        if !sticky.is_rigid || self.options.spindle_axis.is_some() {
            Ok(())
        } else if has_pecks {
            Err(needs_axis(block, b'Q'))
        } else if sticky.dwell_s > 0.0 {
            Err(needs_axis(block, b'P'))
        } else {
            Ok(())
        }
    }

    /// Whether a cycle taps by a spindle that is an axis.
    pub(super) const fn taps_by_axis(&self, sticky: &StickyWords) -> bool {
        sticky.is_rigid && self.options.spindle_axis.is_some()
    }

    /// From the R plane to the bottom and out again, with a tap in a holder that gives way.
    pub(super) fn tap_with_holder(
        &mut self,
        block: &Block,
        turning: SpindleDirection,
        [bottom, clear]: [f64; 2],
        dwell_s: f64,
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        let code = |number: u32| ItemKind::Event(Event::MCode(number));
        let normal = self.state.modal.plane.normal();
        self.push(out, code(49));
        self.along(block, normal, bottom, Pace::Feed, out)?;
        self.push(out, code(turning.reversed().code()));
        self.push(out, ItemKind::Dwell(dwell_s));
        self.along(block, normal, clear, Pace::Feed, out)?;
        self.push(out, code(turning.code()));
        self.push(out, code(48));
        Ok(())
    }

    /// From the R plane to the bottom and out again with the spindle, then to the clear level.
    pub(super) fn tap_rigidly(
        &mut self,
        block: &Block,
        turning: SpindleDirection,
        [bottom, clear]: [f64; 2],
        [dwell_s, peck_mm]: [f64; 2],
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        let normal = self.state.modal.plane.normal();
        let pitch_mm = self.tap_pitch(block)?;
        if let Some(axis) = self.options.spindle_axis {
            let hole = TappedHole {
                bottom: self.level(normal, bottom),
                pitch_mm,
                turning,
                dwell_s,
                speed_out_r: 1.0,
                peck_mm: Some(peck_mm).filter(|peck_mm| *peck_mm > 0.0),
                back_mm: None,
            };
            self.tap_by_axis(block, &axis, &hole, out)?;
            return self.along(block, normal, clear, Pace::Rapid, out);
        }
        let starts = self.state.spindle.turning.is_none();
        if starts {
            self.turn_spindle(Some(turning));
            self.push(out, ItemKind::Event(Event::MCode(turning.code())));
        }
        let target = self.level(normal, bottom);
        self.tap_to(block, target, pitch_mm, out)?;
        if starts {
            self.turn_spindle(None);
            self.push(out, ItemKind::Event(Event::MCode(5)));
        }
        self.along(block, normal, clear, Pace::Rapid, out)
    }

    /// The way of a revolution of a tapping cycle, mm.
    fn tap_pitch(&self, block: &Block) -> Outcome<f64> {
        let span = block.motion_span();
        let modal = &self.state.modal;
        let speed = self.state.spindle.speed;
        let Some(feed) = modal.feed else {
            let message = "rigid tapping without a feedrate";
            return Err(
                BlockDiagnostic::new(DiagnosticCode::MissingFeed, span, message)
                    .because("F over S is the way of a revolution of the tap, in G95 F alone")
                    .help("write an F word"),
            );
        };
        if modal.feed_mode == FeedMode::PerRevolution {
            return Ok(feed.linear_v);
        }
        if speed <= 0.0 {
            let message = "rigid tapping with a spindle without a speed";
            return Err(BlockDiagnostic::new(DiagnosticCode::Spindle, span, message)
                .because("F over S is the way of a revolution of the tap")
                .help("write an S word"));
        }
        Ok(feed.linear_v * 60.0 / speed)
    }
}
