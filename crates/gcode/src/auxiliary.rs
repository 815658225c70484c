//! Words that act beside the motion: feed, speed, tool, M codes, dwell.

use glidepath_motion::{Event, Item, ItemKind};

use crate::block::Block;
use crate::codes::{Coded, FeedMode, Once};
use crate::diagnostic::{Code, Fault, Outcome};
use crate::interpreter::Interpreter;
use crate::modal::Feed;
use crate::words::{MAX_TOOL, missing, negative, whole};

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
        if modal.feed_mode == FeedMode::PerMinute {
            modal.feed = Some(Feed {
                linear_v: feed * modal.units.mm() / 60.0,
                rotary_v: feed / 60.0,
            });
        }
        Ok(())
    }

    /// S, T, tool change, spindle, coolant, overrides and dwell.
    pub(crate) fn auxiliary(&self, block: &Block, out: &mut Vec<Item>) -> Outcome<()> {
        if let Some(speed) = block.get(b'S') {
            if speed < 0.0 {
                return Err(negative(block, b'S', "the spindle speed"));
            }
            self.push(out, ItemKind::Event(Event::SpindleSpeed(speed)));
        }
        if let Some(tool) = whole(block, b'T', MAX_TOOL)? {
            self.push(out, ItemKind::Event(Event::SelectTool(tool)));
        }
        let codes = &block.codes;
        let in_order = [
            codes.tool_change,
            codes.spindle,
            codes.coolant,
            codes.overrides,
        ];
        for Coded { code, .. } in in_order.into_iter().flatten() {
            self.push(out, ItemKind::Event(Event::MCode(code)));
        }
        if let Some(Coded {
            code: Once::Dwell,
            span,
        }) = codes.once
        {
            let seconds = block
                .get(b'P')
                .ok_or_else(|| missing(span, "G4", "P", "seconds"))?;
            if seconds < 0.0 {
                return Err(negative(block, b'P', "the dwell"));
            }
            self.push(out, ItemKind::Dwell(seconds));
        }
        Ok(())
    }
}
