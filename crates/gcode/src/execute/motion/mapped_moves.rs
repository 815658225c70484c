//! The mapping of a program's moves to those of the axes, on a machine with five axes.

use glidepath_geometry::{Arc, AxisVector, NurbsPath, Segment};
use glidepath_kinematics::FiveAxis;
use glidepath_program::{Event, Item, ItemKind, Rate};

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::execute::interpreter::Interpreter;
use crate::execute::motion::arc_in_space::SpaceArc;
use crate::execute::motion::chords::MappedMove;
use crate::execute::motion::great_circle::{GreatCircle, NoCircle};
use crate::execute::motion::tip_map::TipMap;
use crate::execute::state::tip::Tip;
use crate::syntax::block::Block;

impl Interpreter {
    /// The map in force; `None` where places of the program are the axes.
    #[inline]
    pub(crate) fn tip_map(&self) -> Option<TipMap> {
        self.options
            .five_axis
            .and_then(|machine| self.tip_map_of(machine))
    }

    fn tip_map_of(&self, machine: FiveAxis) -> Option<TipMap> {
        match self.state.contour_plane {
            Some(plane) => Some(TipMap::of_plane(machine, self.state.tip, plane.map)),
            None => TipMap::new(Some(machine), self.state.tip),
        }
    }

    /// Where the axes stand.
    pub(crate) const fn axes_place(&self) -> &AxisVector {
        if self.state.is_mapped {
            &self.state.axes_end
        } else {
            &self.state.position
        }
    }

    /// Another meaning of the coordinates: the machine stays where it is.
    pub(crate) fn set_tip(&mut self, tip: Tip) {
        // The programmed place and the tool's: they differ by a rounding, and beside a contour.
        let (programmed, axes) = if self.state.is_mapped {
            (self.state.axes_end, self.state.axes_end)
        } else {
            (self.state.position, self.state.path_end)
        };
        self.state.tip = tip;
        let map = self.tip_map();
        let place = |axes: &AxisVector| map.map_or(*axes, |map| map.place(axes));
        (self.state.position, self.state.path_end) = (place(&programmed), place(&axes));
        (self.state.axes_end, self.state.is_mapped) = (axes, map.is_some());
    }

    /// Follows a place that was set, and not moved to.
    pub(crate) fn axes_follow_place(&mut self) {
        let map = self.tip_map();
        self.state.is_mapped = map.is_some();
        self.state.axes_end = map.map_or(self.state.path_end, |map| map.axes(&self.state.path_end));
    }

    /// The length of the tool in force, mm: along Z, or along the tool where its tip is followed.
    pub(crate) fn length_in_force_mm(&self) -> f64 {
        match self.state.tip {
            Tip::Follows { longer_mm } if self.options.five_axis.is_some() => longer_mm,
            _ => self.state.offsets.tool[2],
        }
    }

    /// From here on the tip is followed, or not: the length of the tool in force counts along the
    /// tool, or along Z.
    pub(crate) fn let_tip_follow(&mut self, follows: bool) {
        if self.options.five_axis.is_none() {
            return;
        }
        let length_mm = self.length_in_force_mm();
        self.state.offsets.tool[2] = if follows { 0.0 } else { length_mm };
        self.set_tip(if follows {
            Tip::Follows {
                longer_mm: length_mm,
            }
        } else {
            Tip::Stands
        });
    }

    /// Makes the moves of a block, from the item of that index on, those of the axes.
    pub(crate) fn map_moves(&mut self, block: &Block, out: &mut Vec<Item>) -> Outcome<()> {
        let from = self.mapped_items.min(out.len());
        let circles = self.turns_on_circles();
        let map = self.tip_map();
        let Some(map) =
            map.or_else(|| circles.map(|machine| TipMap::of_axes(machine, self.state.tip)))
        else {
            self.mapped_items = out.len();
            return Ok(());
        };
        let items = out.split_off(from);
        for item in items {
            match item.kind {
                ItemKind::Move {
                    segment,
                    rate,
                    mode,
                } => {
                    let circle = circle_of(circles, &segment, block)?;
                    if !self.state.is_mapped {
                        if circle.is_none() {
                            out.push(item);
                            continue;
                        }
                        self.state.axes_end = segment.start();
                    }
                    let way = MappedMove {
                        map: &map,
                        segment: &segment,
                        circle,
                    };
                    let pieces = map_move(&way, rate, self.state.axes_end, self.piece_error_mm());
                    let pieces = pieces.map_err(|mut fault| {
                        fault.span = block.motion_span();
                        fault
                    })?;
                    for (segment, rate) in pieces {
                        let (low, high) = segment.bounding_box();
                        self.check_travel(block, &low, &high, &self.state.axes_end, "a point")?;
                        self.state.axes_end = segment.end();
                        let kind = ItemKind::Move {
                            segment,
                            rate,
                            mode,
                        };
                        out.push(Item { kind, ..item });
                    }
                }
                ItemKind::Event(Event::Tap { .. } | Event::Synchronise { .. })
                    if !map.is_plain_at(&self.state.path_end) =>
                {
                    return Err(behind_spindle(block));
                }
                _ => out.push(item),
            }
        }
        self.mapped_items = out.len();
        Ok(())
    }

    /// The machine whose moves turn the tool on great circles.
    pub(super) fn turns_on_circles(&self) -> Option<FiveAxis> {
        let state = &self.state;
        let is_so = state.turns_on_circles && state.tip.follows() && state.tilted.is_none();
        self.options.five_axis.filter(|_| is_so)
    }

    /// Refuses probing where a contact would be at another place than the program's.
    pub(crate) fn check_probe_map(&self, block: &Block) -> Outcome<()> {
        let map = self.tip_map();
        if map.is_none_or(|map| map.is_plain_at(&self.state.path_end)) {
            return Ok(());
        }
        let message = "a probing move with the rotary axes away from zero";
        Err(
            BlockDiagnostic::new(DiagnosticCode::NotSupported, block.motion_span(), message)
                .because("the place of the contact is that of the tip on the work, and this program counts the machine's axes")
                .help("probe behind G43.4 or TRAORI, with a tool of the length that the kinematics know"),
        )
    }
}

#[cold]
fn behind_spindle(block: &Block) -> Box<BlockDiagnostic> {
    let message = "a thread or a tap with the rotary axes away from zero";
    BlockDiagnostic::new(DiagnosticCode::NotSupported, block.motion_span(), message)
        .because(
            "one axis follows the spindle, and along a tool that leans it is none of the machine's",
        )
        .help("tap with the rotary axes at zero, or by a spindle that is an axis")
}

/// The turn of a move where the tool turns on great circles.
fn circle_of(
    circles: Option<FiveAxis>,
    segment: &Segment,
    block: &Block,
) -> Outcome<Option<GreatCircle>> {
    let Some(machine) = circles else {
        return Ok(None);
    };
    GreatCircle::between(machine, &segment.start(), &segment.end()).map_err(|why| {
        let (message, reason) = match why {
            NoCircle::ByPole => (
                "a turn of the tool by the pole, with ORIVECT",
                "within 2 degrees of the axis of C that axis cannot follow the direction",
            ),
            NoCircle::Farther => (
                "a turn of C by more than the direction of the tool needs, with ORIVECT",
                "on a great circle the tool turns the short way",
            ),
            NoCircle::OutOfReach => (
                "a turn of the tool to where it cannot lean, with ORIVECT",
                "the tilt axis is skewed, and does not lean the tool so far",
            ),
        };
        BlockDiagnostic::new(DiagnosticCode::NotSupported, block.motion_span(), message)
            .because(reason)
            .help("write ORIAXES, with which the angles change evenly, or blocks in between")
    })
}

/// The pieces of a move, and how fast each is.
fn map_move(
    way: &MappedMove<'_>,
    rate: Rate,
    start: AxisVector,
    error_mm: f64,
) -> Outcome<Vec<(Segment, Rate)>> {
    let (map, segment) = (way.map, way.segment);
    let (from, to) = (segment.start(), segment.end());
    let turns = map.angles(&from).into_iter().zip(map.angles(&to));
    let is_turning = turns.into_iter().any(|(from, to)| (to - from).abs() > 0.0);
    let end = map.axes(&to);
    if !is_turning {
        match segment {
            _ if map.is_plain_at(&from) => return Ok(vec![(restarted(segment, start), rate)]),
            Segment::Line(_) => return Ok(vec![(Segment::line(start, end), rate)]),
            Segment::Arc(arc) => {
                if let Some(segments) = map_arc(map, arc, (start, end), error_mm)? {
                    return Ok(segments
                        .into_iter()
                        .map(|segment| (segment, rate))
                        .collect());
                }
            }
            Segment::Curve(_) => {}
        }
    }
    let length = segment.length();
    let chords = way.chords(length, (start, end))?;
    let mut pieces = Vec::with_capacity(chords.len());
    let (mut at, mut path) = (start, 0.0);
    for (place, s) in chords {
        let piece = Segment::line(at, place);
        pieces.push((piece, scaled(rate, piece.length() / (s - path))));
        (at, path) = (place, s);
    }
    Ok(pieces)
}

/// The same piece, which begins where the last one ended.
fn restarted(segment: &Segment, start: AxisVector) -> Segment {
    match segment {
        Segment::Line(line) => Segment::line(start, line.end),
        Segment::Arc(arc) => Segment::Arc(Arc { start, ..*arc }),
        curve @ Segment::Curve(_) => *curve,
    }
}

/// An arc with the rotary axes at rest: an arc in space.
fn map_arc(
    map: &TipMap,
    arc: &Arc,
    (start, end): (AxisVector, AxisVector),
    error_mm: f64,
) -> Outcome<Option<Vec<Segment>>> {
    let (first, second) = arc.plane.axes();
    if first.index() >= 3 || second.index() >= 3 {
        return Ok(None);
    }
    let flat = SpaceArc::in_plane(arc.plane, (arc.start, arc.end), arc.center, arc.sweep_rad);
    let curve = flat.curve(|place| map.axes(&place))?;
    let mut segments = NurbsPath::new(curve).segments(error_mm);
    if let Some(first) = segments.first_mut() {
        *first = with_ends(first, start, first.end());
    }
    if let Some(last) = segments.last_mut() {
        *last = with_ends(last, last.start(), end);
    }
    Ok(Some(segments))
}

/// A segment whose ends are put right by what rounding has made of them.
fn with_ends(segment: &Segment, start: AxisVector, end: AxisVector) -> Segment {
    match *segment {
        Segment::Line(_) => Segment::line(start, end),
        Segment::Arc(arc) => Segment::Arc(Arc { start, end, ..arc }),
        Segment::Curve(mut curve) => {
            curve.start = start;
            curve.end = end;
            Segment::Curve(curve)
        }
    }
}

/// A rate of a piece whose path is that many times as long as the move's was.
fn scaled(rate: Rate, by: f64) -> Rate {
    match rate {
        Rate::Feed(feed_v) => Rate::Feed(feed_v * by),
        Rate::PerRevolution { feed_v, most_v } => Rate::PerRevolution {
            feed_v: feed_v * by,
            most_v: most_v * by,
        },
        Rate::FeedUpTo { feed_v, most_v } => Rate::FeedUpTo {
            feed_v: feed_v * by,
            most_v: most_v * by,
        },
        rate => rate,
    }
}
