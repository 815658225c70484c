//! Words that act beside the motion: feed, speed, tool, M codes, dwell.

use glidepath_program::{Event, Item, ItemKind};

use crate::block::Block;
use crate::codes::Coded;
use crate::diagnostic::{Code, Fault, Outcome, Span};
use crate::dialect::Dialect;
use crate::interpreter::Interpreter;
use crate::modal::Feed;
use crate::modes::{FeedMode, Once};
use crate::refused::refused_m;
use crate::spindle::Turning;
use crate::words::{missing, negative, whole};

/// What the coolant was told.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) struct Coolant {
    /// M7.
    pub(crate) mist: bool,
    /// M8.
    pub(crate) flood: bool,
}

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
        if let Some(Coded { code, .. }) = codes.coolant {
            let coolant = &mut self.state.coolant;
            match code {
                7 => coolant.mist = true,
                8 => coolant.flood = true,
                _ => *coolant = Coolant::default(),
            }
        }
        for Coded { code, .. } in [codes.spindle, codes.coolant].into_iter().flatten() {
            self.push(out, ItemKind::Event(Event::MCode(code)));
        }
        self.overrides(block, out)?;
        self.saved_state(block, out)?;
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

/// Of one override: M50 to M53.
#[cold]
fn override_refused(code: u32, block: &Block, span: Span) -> Box<Fault> {
    let (what, help) = match code {
        50 => ("the feed override", "remove it, or write M48 after an M49"),
        51 => (
            "the spindle override",
            "remove it, or write M48 after an M49",
        ),
        52 => (
            "adaptive feed",
            "remove it; the feedrate follows no input here",
        ),
        _ => (
            "the feed stop input",
            "remove it; the operator holds the motion",
        ),
    };
    let switch = if block.get(b'P') == Some(0.0) {
        "off"
    } else {
        "on"
    };
    let message = format!("M{code} that switches {what} {switch} is not supported");
    Fault::new(Code::NotSupported, span, message)
        .because(
            "nothing here switches it alone, and skipping it could change what the machine does",
        )
        .help(help)
}

impl Interpreter {
    /// M48 to M53. An override that is as the block wants it needs nothing.
    fn overrides(&mut self, block: &Block, out: &mut Vec<Item>) -> Outcome<()> {
        let Some(Coded { code, span }) = block.codes.overrides else {
            return Ok(());
        };
        if matches!(code, 48 | 49) {
            self.state.overrides_off = code == 49;
            self.push(out, ItemKind::Event(Event::MCode(code)));
            return Ok(());
        }
        if block.dialect != Dialect::LinuxCnc {
            return Err(refused_m(code, f64::from(code), span));
        }
        let on = whole(block, b'P', 1)? != Some(0);
        let is_so = match code {
            50 | 51 => on && !self.state.overrides_off,
            _ => !on,
        };
        if is_so {
            Ok(())
        } else {
            Err(override_refused(code, block, span))
        }
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
