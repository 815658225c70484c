//! The feed of a block: feed mode and F, and the feed of corners.

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::execute::interpreter::Interpreter;
use crate::execute::state::modal::Feed;
use crate::setup::fanuc::PointInput;
use crate::syntax::block::Block;
use crate::syntax::dialect::Dialect;
use crate::syntax::modes::{FeedMode, Motion, SpindleMode, Turning, Units};
use crate::syntax::named_word::Named;

impl Interpreter {
    /// The unit of length that F counts in, mm.
    pub(crate) const fn feed_unit_mm(&self) -> f64 {
        if self.state.feeds_in_mm {
            1.0
        } else {
            self.state.modal.units.mm()
        }
    }

    /// Feed mode and F.
    pub(crate) fn feed(&mut self, block: &Block, motion: Option<Motion>) -> Outcome<()> {
        let modal = &mut self.state.modal;
        let written = block.codes.feed_mode.map(|coded| coded.code);
        if let Some(code) = written.or_else(|| feed_mode_of_speed(block)) {
            if modal.feed_mode != code {
                // The F of one mode means nothing in the other.
                modal.feed = None;
                self.state.fanuc.lead_mm = None;
            }
            modal.feed_mode = code;
            self.state.fanuc.is_feed_unsaid = false;
        }
        // On a FANUC the F of a thread is its pitch.
        let is_pitch = block.dialect == Dialect::Fanuc
            && matches!(
                motion,
                Some(Motion::Thread | Motion::ThreadCycle | Motion::Turning(Turning::Thread))
            );
        self.check_counted_feed(block, is_pitch)?;
        if let Some(lead) = block.get(b'F').filter(|_| is_pitch) {
            self.keep_lead(block, lead);
        }
        // On a printer the F of G61 is that of its move alone.
        let is_own = is_pitch || block.codes.kept_place.is_some();
        let Some(feed) = block.get(b'F').filter(|_| !is_own) else {
            return Ok(());
        };
        if self.state.fanuc.is_feed_unsaid && block.is_lathe {
            return Err(unsaid(block));
        }
        if feed == 0.0 && self.forgets_feed(block, motion) {
            self.state.modal.feed = None;
            return Ok(());
        }
        if feed <= 0.0 {
            let message = format!("the feedrate F{feed} is not above zero");
            return Err(
                BlockDiagnostic::new(DiagnosticCode::BadFeed, block.span(b'F'), message)
                    .because("a move at that feedrate would never end")
                    .help("write a positive feedrate; use M0 to stop"),
            );
        }
        if let Some(feed) = self.feed_of(block, feed) {
            self.state.modal.feed = Some(feed);
        }
        Ok(())
    }

    /// Whether F0 says that there is no feed, as on LinuxCNC and grbl, where the next move at a feed is refused that has
    /// none. It is refused itself where its block moves, or F is a time.
    fn forgets_feed(&self, block: &Block, motion: Option<Motion>) -> bool {
        block.dialect == Dialect::LinuxCnc
            && motion.is_none()
            && self.state.modal.feed_mode != FeedMode::InverseTime
    }

    /// Refuses F without a point where it counts least increments of a feed; millimetres per minute it counts one
    /// by one.
    fn check_counted_feed(&self, block: &Block, is_pitch: bool) -> Outcome<()> {
        let units = block.codes.units.map(|coded| coded.code);
        let is_plain = units.unwrap_or(self.state.modal.units) == Units::Millimetre
            && self.state.modal.feed_mode == FeedMode::PerMinute
            && !is_pitch;
        let is_counted = block.point == PointInput::Increment && block.has_no_point(b'F');
        match block.get(b'F') {
            Some(feed) if is_counted && !is_plain => Err(without_point(block, feed)),
            _ => Ok(()),
        }
    }

    /// What a value counts as a feed in the mode and the units in force; `None`: it is a time (G93).
    pub(crate) fn feed_of(&self, block: &Block, feed: f64) -> Option<Feed> {
        let modal = &self.state.modal;
        let per_second = match modal.feed_mode {
            FeedMode::PerMinute => 60.0,
            FeedMode::PerRevolution => 1.0,
            FeedMode::InverseTime => return None,
        };
        // On other controls than LinuxCNC the unit in the block counts for its F, too.
        let written = block
            .codes
            .units
            .filter(|_| block.dialect != Dialect::LinuxCnc);
        let (units, in_mm) = match written {
            Some(coded) => (coded.code, block.codes.feeds_in_mm),
            None => (modal.units, self.state.feeds_in_mm),
        };
        let unit_mm = if in_mm { 1.0 } else { units.mm() };
        Some(Feed {
            linear_v: feed * unit_mm / per_second,
            rotary_v: feed / per_second,
        })
    }

    /// The feed of a word of SINUMERIK, which is above zero.
    fn named_feed(&self, block: &Block, word: Named) -> Outcome<Option<Feed>> {
        let Some(found) = block.named.find(word) else {
            return Ok(None);
        };
        match self.feed_of(block, found.value) {
            Some(feed) if found.value > 0.0 => Ok(Some(feed)),
            _ => {
                let message = format!("the feedrate {}={}", word.name(), found.value);
                Err(
                    BlockDiagnostic::new(DiagnosticCode::BadFeed, found.span, message)
                        .because("it is a feed per minute or per revolution, above zero")
                        .help("write a positive feedrate, with G94 or G95 in force"),
                )
            }
        }
    }

    /// Puts the feed of FB in force for the block's own move; gives the feed from before it, where the
    /// block has FB.
    pub(crate) fn take_block_feed(&mut self, block: &Block) -> Outcome<Option<Option<Feed>>> {
        let own = self.named_feed(block, Named::BlockFeed)?;
        let before = self.state.modal.feed;
        Ok(own.map(|own| {
            self.state.modal.feed = Some(own);
            before
        }))
    }

    /// FRCM: the feed of all corners from here on.
    pub(crate) fn take_corner_feeds(&mut self, block: &Block) -> Outcome<()> {
        if let Some(all) = block.named.get(Named::CornerFeeds) {
            self.state.corner_feed = match all {
                0.0 => None,
                _ => self.named_feed(block, Named::CornerFeeds)?,
            };
        }
        Ok(())
    }

    /// The feed of the corner at the end of the block; `None`: that of the path.
    pub(crate) fn corner_feed(&self, block: &Block) -> Outcome<Option<Feed>> {
        let own = self.named_feed(block, Named::CornerFeed)?;
        Ok(own.or(self.state.corner_feed))
    }
}

/// On a SINUMERIK G96 and G97 make F a way per revolution.
fn feed_mode_of_speed(block: &Block) -> Option<FeedMode> {
    let mode = block.codes.spindle_mode.map(|coded| coded.code);
    let is_per_revolution = matches!(
        mode,
        Some(SpindleMode::SurfaceSpeed | SpindleMode::Revolutions)
    );
    (is_per_revolution && block.dialect == Dialect::Siemens).then_some(FeedMode::PerRevolution)
}

#[cold]
fn without_point(block: &Block, feed: f64) -> Box<BlockDiagnostic> {
    let message = format!("F{feed} has no decimal point");
    BlockDiagnostic::new(DiagnosticCode::AmbiguousWord, block.span(b'F'), message)
        .because("with `point = \"increment\"` it counts least increments in inches, per revolution, in G93 and in threads, and how much one is a parameter of the control says")
        .help(format!("write the point: F{feed}. if that is the value"))
}

#[cold]
fn unsaid(block: &Block) -> Box<BlockDiagnostic> {
    let message = "F before G98 or G99";
    BlockDiagnostic::new(DiagnosticCode::AmbiguousWord, block.span(b'F'), message)
        .because("lathes begin with a feed per revolution or per minute, as a parameter of theirs says (3402#4)")
        .help("write G99 (per revolution) or G98 (per minute) in front of it")
}
