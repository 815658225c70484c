//! Corners that are broken: `,C` and `,R` of FANUC, CHR, CHF, RND and RNDM of SINUMERIK.
//!
//! The move to the corner is held until the next one is known; both are straight moves at feed or arcs,
//! in the plane, and end where the chamfer or the arc between them begins and ends
//! ([`super::corner_geometry`]).

use glidepath_geometry::{Arc, AxisVector, Plane, Segment};
use glidepath_program::Item;

use crate::diagnostic::block_diagnostic::Outcome;
use crate::diagnostic::span::SourceSpan;
use crate::execute::compensation::element::Element;
use crate::execute::interpreter::Interpreter;
use crate::execute::motion::corner_geometry::{CornerRules, broken};
use crate::execute::motion::corner_refused::{
    below_zero, cannot_break, changed_between, no_second_move, not_in_plane, timed,
};
use crate::execute::motion::settled::MIN_MOVE;
use crate::execute::motion::speed::Pace;
use crate::execute::motion::tangent_arc::direction_behind;
use crate::execute::state::open_corner::OpenCorner;
use crate::syntax::block::{Block, CornerKind, CornerWord};
use crate::syntax::codes::Codes;
use crate::syntax::dialect::Dialect;
use crate::syntax::letters::Letters;
use crate::syntax::modes::{FeedMode, Motion, NonModal, Stop};

/// Most items of blocks between the two moves of a corner.
const MOST_BEHIND: usize = 8;

/// Most blocks without a move between the two moves of a corner: on a SINUMERIK, and dwells on a FANUC.
const MOST_BETWEEN: u8 = 3;
const MOST_DWELLS: u8 = 1;

/// A move in the plane that begins where the tool is, or at a corner.
#[derive(Debug, Clone, Copy)]
pub(crate) struct CornerMove {
    /// Where the program goes to, machine coordinates.
    pub(crate) target: AxisVector,
    /// Centre and sweep of an arc, in the two axes of the plane.
    pub(crate) arc: Option<([f64; 2], f64)>,
}

impl Interpreter {
    /// Before a block: without a move of its own a corner cannot be broken.
    pub(crate) fn settle_corner(
        &mut self,
        block: &Block,
        motion: Option<Motion>,
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        if let Some(CornerWord { value, span, .. }) = block.corner
            && value < 0.0
        {
            return Err(below_zero(value, span));
        }
        if let Some(word) = block.corner
            && word.kind == CornerKind::RoundAll
        {
            // G70 and the like in the block come into force behind this, and are for its own words, too.
            let units = block.codes.units.map(|coded| coded.code);
            self.state.rounds_mm = word.value * units.unwrap_or(self.state.modal.units).mm();
        }
        self.take_corner_feeds(block)?;
        let changes_path = self.changes_path(block);
        let Some(corner) = &mut self.state.open.corner else {
            return Ok(());
        };
        let is_move = matches!(
            motion,
            Some(Motion::Linear | Motion::ArcClockwise | Motion::ArcCounterclockwise)
        );
        if is_move && block.codes.non_modal.is_none() && !changes_path {
            return Ok(());
        }
        let is_fanuc = block.dialect == Dialect::Fanuc;
        let most = if is_fanuc { MOST_DWELLS } else { MOST_BETWEEN };
        let may_wait = corner.behind.len() < MOST_BEHIND && corner.between < most;
        let stays = leaves_path(block, motion) || is_fanuc && is_dwell(block);
        if may_wait && !changes_path && stays {
            corner.between += 1;
            return Ok(());
        }
        if corner.may_stay {
            return self.leave_corner(block, out);
        }
        Err(if is_move && changes_path {
            changed_between(block.first_span())
        } else {
            no_second_move(block.first_span())
        })
    }

    /// True for a block that puts another plane, another tool, or another way to follow the path, in force: the
    /// two moves of a corner have to have the same.
    fn changes_path(&self, block: &Block) -> bool {
        let codes = &block.codes;
        let changes_tool = codes.tool_change.is_some()
            || block.dialect != Dialect::LinuxCnc && block.has_any(Letters::of(b"TDH"));
        let changes_speed = codes.spindle_mode.is_some() || block.get(b'S').is_some();
        let plane = self.state.modal.plane;
        let changes_plane = codes.plane.is_some_and(|coded| coded.code != plane);
        let counts_turns = self.state.modal.feed_mode == FeedMode::PerRevolution;
        changes_tool
            || changes_plane
            || codes.cutter_radius.is_some()
            || codes.tool_length.is_some()
            || codes.tip.is_some()
            || codes.tilt.is_some()
            || codes.dynamic.is_some()
            || changes_speed && (counts_turns || self.state.spindle.follows_tool())
    }

    /// Before what is no block: a corner has its second move, or stays.
    pub(crate) fn settle_corner_before(
        &mut self,
        block: &Block,
        span: SourceSpan,
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        match &self.state.open.corner {
            Some(corner) if !corner.may_stay => Err(no_second_move(span)),
            _ => self.leave_corner(block, out),
        }
    }

    /// Makes the move to a corner that stays as it is.
    fn leave_corner(&mut self, block: &Block, out: &mut Vec<Item>) -> Outcome<()> {
        let Some(corner) = self.state.open.corner.take() else {
            return Ok(());
        };
        self.leave_sharp(block, &corner, out)?;
        // CT goes on in its direction.
        self.state.tangent = direction_behind(out).or(self.state.tangent);
        Ok(())
    }

    /// The end of the program: a corner has to have its second move.
    pub(crate) fn end_corner(&mut self, block: &Block, out: &mut Vec<Item>) -> Outcome<()> {
        self.settle_corner_before(block, SourceSpan::default(), out)
    }

    /// A move of G1, G2 or G3: breaks the corner it begins at, and holds the move if its end is one.
    pub(crate) fn move_between_corners(
        &mut self,
        block: &Block,
        mut next: CornerMove,
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        let is_timed = self.state.modal.feed_mode == FeedMode::InverseTime;
        match self.state.open.corner.take() {
            Some(corner) if is_timed && corner.may_stay => {
                self.leave_sharp(block, &corner, out)?;
            }
            Some(_) if is_timed => return Err(timed(block.motion_span())),
            Some(corner) => self.break_corner(block, &corner, &mut next, out)?,
            None => {}
        }
        let corner_feed = self.corner_feed(block)?;
        let CornerMove { target, arc } = next;
        let word = self.corner_word(block);
        if let Some((_, _, false)) = word.filter(|_| is_timed) {
            return Err(timed(block.motion_span()));
        }
        let Some((kind, size_mm, may_stay)) = word.filter(|_| !is_timed) else {
            return self.make_move(block, target, arc, out);
        };
        self.state.open.corner = Some(Box::new(OpenCorner {
            from: self.here_on_contour(),
            at: target,
            arc,
            kind,
            size_mm,
            modal: self.state.modal,
            corner_feed,
            line: self.line,
            may_stay,
            between: 0,
            behind: Vec::new(),
        }));
        self.state.position = target;
        Ok(())
    }

    /// Where the next move begins.
    fn here_on_contour(&self) -> AxisVector {
        if self.state.open.compensation.is_some() {
            self.state.position
        } else {
            self.state.path_end
        }
    }

    /// How the corner at the end of a block is to be broken.
    fn corner_word(&self, block: &Block) -> Option<(CornerKind, f64, bool)> {
        let mm = self.state.modal.units.mm();
        match block.corner {
            Some(CornerWord { kind, value, .. }) if kind != CornerKind::RoundAll => {
                Some((kind, value * mm, false)).filter(|_| value > 0.0)
            }
            _ => Some((CornerKind::Round, self.state.rounds_mm, true))
                .filter(|_| self.state.rounds_mm > 0.0),
        }
    }

    /// The held move up to a place on its way.
    fn make_held(
        &mut self,
        block: &Block,
        corner: &OpenCorner,
        place: AxisVector,
        arc: Option<([f64; 2], f64)>,
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        let (line, modal) = (self.line, self.state.modal);
        self.line = corner.line;
        self.state.modal = corner.modal;
        self.state.position = corner.from;
        let made = self.make_move(block, place, arc, out);
        self.state.modal = modal;
        self.line = line;
        made
    }

    /// What comes behind the held move.
    fn give_behind(&mut self, corner: &OpenCorner, out: &mut Vec<Item>) {
        for item in &corner.behind {
            self.give(*item, out);
        }
    }

    /// Both moves as they are.
    fn leave_sharp(
        &mut self,
        block: &Block,
        corner: &OpenCorner,
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        self.make_held(block, corner, corner.at, corner.arc, out)?;
        self.give_behind(corner, out);
        Ok(())
    }

    /// What the control of the program makes of a corner.
    fn corner_rules(&self, block: &Block) -> CornerRules {
        let is_haas = self.options.fanuc.is_haas();
        if block.dialect == Dialect::Fanuc && !is_haas {
            CornerRules::FANUC
        } else {
            CornerRules::OTHERS
        }
    }

    fn break_corner(
        &mut self,
        block: &Block,
        corner: &OpenCorner,
        next: &mut CornerMove,
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        let span = block.motion_span();
        let image = self.state.offsets.plane(self.state.modal.plane);
        let image = image.ok_or_else(|| not_in_plane(span))?;
        let (first, second) = image.plane.axes();
        let (i, j) = (first.index(), second.index());
        let leaves_plane = |from: &AxisVector, to: &AxisVector| {
            let mut other = to - from;
            (other[i], other[j]) = (0.0, 0.0);
            other.amax() > MIN_MOVE
        };
        let is_out =
            leaves_plane(&corner.from, &corner.at) || leaves_plane(&corner.at, &next.target);
        if is_out && corner.may_stay {
            return self.leave_sharp(block, corner, out);
        } else if is_out {
            return Err(not_in_plane(span));
        }
        let flat = |place: &AxisVector| [place[i], place[j]];
        let before = Element {
            start: flat(&corner.from),
            end: flat(&corner.at),
            arc: corner.arc,
        };
        let behind = Element {
            start: flat(&corner.at),
            end: flat(&next.target),
            arc: next.arc,
        };
        let size = (corner.kind, corner.size_mm * image.scale);
        let broken = match broken(before, behind, size, self.corner_rules(block)) {
            Ok(Some(broken)) => broken,
            Ok(None) => return self.leave_sharp(block, corner, out),
            Err(fault) if corner.may_stay && !fault.is_of_size() => {
                return self.leave_sharp(block, corner, out);
            }
            Err(fault) => return Err(cannot_break(block, span, fault)),
        };
        let place = |flat: [f64; 2]| {
            let mut place = corner.at;
            (place[i], place[j]) = (flat[0], flat[1]);
            place
        };
        self.make_held(
            block,
            corner,
            place(broken.before.end),
            broken.before.arc,
            out,
        )?;
        // A FANUC dwells behind the chamfer or arc.
        let is_fanuc = block.dialect == Dialect::Fanuc;
        if !is_fanuc {
            self.give_behind(corner, out);
        }
        next.arc = broken.behind.arc;
        let feed = self.state.modal.feed;
        self.state.modal.feed = corner.corner_feed.or(feed);
        let made = self.make_move(block, place(broken.between.end), broken.between.arc, out);
        self.state.modal.feed = feed;
        made?;
        if is_fanuc {
            self.give_behind(corner, out);
        }
        Ok(())
    }

    /// A line, or an arc, to a place; it begins where the tool is.
    pub(crate) fn make_move(
        &mut self,
        block: &Block,
        target: AxisVector,
        arc: Option<([f64; 2], f64)>,
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        let Some((center, sweep_rad)) = arc else {
            return self.straight(block, target, Pace::Feed, out);
        };
        let plane = self.state.offsets.plane(self.state.modal.plane);
        let plane = plane.map_or(Plane::Xy, |image| image.plane);
        let arc = Arc {
            start: self.here_on_contour(),
            end: target,
            plane,
            center,
            sweep_rad,
        };
        let segment = Segment::Arc(arc);
        let speed = self.speed(block, &segment, Pace::Feed)?;
        if self.state.open.compensation.is_some() {
            self.state.position = target;
            return self.contour_move(block, segment, speed, out);
        }
        let (low, high) = arc.bounding_box();
        self.check_limits(block, &low, &high, "a point")?;
        self.state.position = target;
        self.push_move(segment, speed, out);
        Ok(())
    }
}

/// True for a block of a SINUMERIK that neither moves nor changes anything of the path: the move behind it is
/// the second one of the corner.
fn leaves_path(block: &Block, motion: Option<Motion>) -> bool {
    let codes = &block.codes;
    let non_modal = codes.non_modal.map(|coded| coded.code);
    let sets_pole = matches!(non_modal, Some(NonModal::SetPole(_)));
    let stop = codes.stop.map(|coded| coded.code);
    let pauses = matches!(non_modal, Some(NonModal::Dwell))
        || matches!(stop, Some(Stop::Program(_) | Stop::Optional));
    let others = Codes {
        non_modal: codes.non_modal.filter(|_| !sets_pole && !pauses),
        stop: codes.stop.filter(|_| !pauses),
        motion: None,
        distance: None,
        path_mode: None,
        spindle: None,
        coolant: None,
        user: None,
        ..*codes
    };
    let has_words = !sets_pole && block.unused(Letters::of(b"FSP")).is_some();
    let is_silent = motion.is_none() && !others.any() && !has_words && block.corner.is_none();
    block.dialect == Dialect::Siemens && is_silent
}

/// True for a block that dwells and does nothing else.
fn is_dwell(block: &Block) -> bool {
    let codes = &block.codes;
    let dwells = matches!(
        codes.non_modal.map(|coded| coded.code),
        Some(NonModal::Dwell)
    );
    let others = Codes {
        non_modal: None,
        ..*codes
    };
    dwells && !others.any() && block.unused(Letters::of(b"PXU")).is_none() && block.corner.is_none()
}
