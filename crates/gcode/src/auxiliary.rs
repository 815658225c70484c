//! Words that act beside the motion: feed, speed, tool, M codes, dwell.

use glidepath_motion::{Event, Item, ItemKind};

use crate::block::Block;
use crate::codes::Coded;
use crate::diagnostic::{Code, Fault, Outcome};
use crate::dialect::Dialect;
use crate::interpreter::Interpreter;
use crate::modal::Feed;
use crate::modes::{FeedMode, Once};
use crate::spindle::Turning;
use crate::words::{missing, negative};

impl Interpreter {
    /// Feed mode and F.
    pub(crate) fn feed(&mut self, block: &Block) -> Outcome<()> {
        let modal = &mut self.state.modal;
        if let Some(Coded { code, .. }) = block.codes.feed_mode {
            if modal.feed_mode != code {
                // The F of one mode means nothing in the other.
                modal.feed = None;
            }
            modal.feed_mode = code;
        }
        let Some(feed) = block.get(b'F') else {
            return Ok(());
        };
        if feed <= 0.0 {
            let message = format!("the feedrate F{feed} is not above zero");
            return Err(Fault::new(Code::BadFeed, block.span(b'F'), message)
                .because("a move at that feedrate would never end")
                .help("write a positive feedrate; use M0 to stop"));
        }
        let per_second = match modal.feed_mode {
            FeedMode::PerMinute => 60.0,
            FeedMode::PerRevolution => 1.0,
            FeedMode::InverseTime => return Ok(()),
        };
        modal.feed = Some(Feed {
            linear_v: feed * modal.units.mm() / per_second,
            rotary_v: feed / per_second,
        });
        Ok(())
    }

    /// S, T, tool change, spindle, coolant, overrides, inputs and outputs, dwell.
    pub(crate) fn auxiliary(&mut self, block: &Block, out: &mut Vec<Item>) -> Outcome<()> {
        self.spindle_speed(block, out)?;
        self.select_tool(block, out)?;
        let codes = &block.codes;
        if let Some(Coded { code, .. }) = codes.spindle {
            self.state.spindle.turning = match code {
                3 => Some(Turning::Clockwise),
                4 => Some(Turning::Counterclockwise),
                _ => None,
            };
        }
        let in_order = [codes.spindle, codes.coolant, codes.overrides];
        for Coded { code, .. } in in_order.into_iter().flatten() {
            self.push(out, ItemKind::Event(Event::MCode(code)));
        }
        self.input_output(block, out)?;
        if let Some(Coded {
            code: Once::Dwell,
            span,
        }) = codes.once
        {
            let seconds =
                dwell_seconds(block).ok_or_else(|| missing(span, "G4", "P", "how long"))?;
            if seconds < 0.0 {
                return Err(negative(block, b'P', "the dwell"));
            }
            self.push(out, ItemKind::Dwell(seconds));
        }
        Ok(())
    }
}

/// Seconds of a G4: milliseconds in the P word of printers and FANUC, seconds in their S and X.
fn dwell_seconds(block: &Block) -> Option<f64> {
    let milliseconds = || block.get(b'P').map(|p| 1e-3 * p);
    match block.dialect {
        Dialect::LinuxCnc | Dialect::Siemens => block.get(b'P'),
        Dialect::Marlin => block.get(b'S').or_else(milliseconds),
        Dialect::Fanuc => block.get(b'X').or_else(milliseconds),
    }
}
