//! Straight moves, reference moves, and what every move has in common.

use glidepath_geometry::{AXES, Axis, AxisVector, Segment};
use glidepath_program::{Item, ItemKind, Rate};

use crate::block::{AXIS_WORDS, Block};
use crate::diagnostic::{Code, Fault, Outcome, Span};
use crate::dialect::Dialect;
use crate::interpreter::Interpreter;
use crate::modes::{Distance, FeedMode, Motion, Once};
use crate::offsets::overlay;
use crate::options::{Machine, Travel};

/// Displacements of an axis up to this, mm or degrees, are rounding of coordinates, and no motion.
///
/// Without this, a rotary move whose X differs by 1e-14 mm would count as a move of 1e-14 mm.
pub(crate) const MIN_MOVE: f64 = 1e-9;

/// Relative slack of the soft limits, for the rounding of unit conversions.
const LIMIT_SLACK: f64 = 1e-9;

/// The soft limits with their slack, infinite where there is none.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Reach {
    low: AxisVector,
    high: AxisVector,
}

impl Reach {
    pub(crate) fn of(machine: &Machine) -> Self {
        let mut reach = Self {
            low: AxisVector::repeat(f64::NEG_INFINITY),
            high: AxisVector::repeat(f64::INFINITY),
        };
        for axis in Axis::ALL {
            if let Some(Travel { min, max }) = machine.travel(axis) {
                reach.low[axis.index()] = min - LIMIT_SLACK * min.abs().max(1.0);
                reach.high[axis.index()] = max + LIMIT_SLACK * max.abs().max(1.0);
            }
        }
        reach
    }

    /// True if a coordinate is beyond a limit of its axis, which has that index.
    #[inline]
    pub(crate) fn is_left_at(&self, axis: usize, coordinate: f64) -> bool {
        (coordinate < self.low[axis]) | (coordinate > self.high[axis])
    }
}

/// At which speed a block moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Pace {
    Rapid,
    Feed,
}

/// Speed of a move whose segment is not known yet.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Speed {
    Rapid,
    /// mm/s or °/s.
    Feed(f64),
    /// G93: moves of this length per minute.
    Moves(f64),
}

impl Speed {
    pub(crate) fn rate(self, segment: &Segment) -> Rate {
        match self {
            Self::Rapid => Rate::Rapid,
            Self::Feed(feed_v) => Rate::Feed(feed_v),
            Self::Moves(per_minute) => Rate::Feed(segment.length() * per_minute / 60.0),
        }
    }
}

impl Interpreter {
    /// Makes the motion of a block.
    pub(crate) fn motion(
        &mut self,
        block: &Block,
        motion: Motion,
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        match motion {
            Motion::Rapid | Motion::Linear => {
                let target = self.target(block)?;
                // Printers move at the feedrate in G0 too.
                let printer = block.dialect == Dialect::Marlin && self.state.modal.feed.is_some();
                let pace = if motion == Motion::Rapid && !printer {
                    Pace::Rapid
                } else {
                    Pace::Feed
                };
                self.straight(block, target, pace, out)?;
            }
            Motion::ArcClockwise | Motion::ArcCounterclockwise => self.arc(block, motion, out)?,
            Motion::Cycle(cycle) => self.cycle(block, cycle, out)?,
            Motion::Contour(contour) => self.begin_contour(block, contour, out)?,
            Motion::Probe(_) => self.probe(block, out)?,
            Motion::Spline(spline) => self.spline(block, spline, out)?,
        }
        self.follow_surface(out);
        Ok(())
    }

    /// Machine coordinates the axis words of a block lead to.
    pub(crate) fn target(&self, block: &Block) -> Outcome<AxisVector> {
        let mut values = self.axis_values(block)?;
        let machine = block
            .codes
            .once
            .is_some_and(|o| o.code == Once::MachineCoordinates);
        if machine {
            return Ok(overlay(self.state.position, &values));
        }
        if self.state.modal.distance == Distance::Absolute {
            return Ok(self.absolute_target(&values));
        }
        if self.offsets.is_rotated() && (values[0].is_some() || values[1].is_some()) {
            let mut by = AxisVector::zeros();
            (by[0], by[1]) = (values[0].unwrap_or(0.0), values[1].unwrap_or(0.0));
            let turned = self.offsets.system().rotate(by, 1.0);
            (values[0], values[1]) = (Some(turned[0]), Some(turned[1]));
        }
        let mut target = self.state.position;
        for (axis, value) in values.into_iter().enumerate() {
            target[axis] += value.unwrap_or(0.0);
        }
        Ok(target)
    }

    /// Machine coordinates of program coordinates; an axis without a value stays where it is.
    pub(crate) fn absolute_target(&self, values: &[Option<f64>; AXES]) -> AxisVector {
        let mut target = self.state.position;
        let offsets = &self.offsets;
        for axis in 0..AXES {
            if let Some(value) = values[axis] {
                target[axis] = value + offsets.origin(axis);
            }
        }
        if offsets.is_rotated() && (values[0].is_some() || values[1].is_some()) {
            let program = overlay(offsets.to_program(self.state.position), values);
            let turned = offsets.to_machine(program);
            (target[0], target[1]) = (turned[0], turned[1]);
        }
        target
    }

    /// A straight move to a machine position.
    pub(crate) fn straight(
        &mut self,
        block: &Block,
        target: AxisVector,
        pace: Pace,
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        self.state.leaving_contour = false;
        if self.compensation.is_some() {
            return self.compensated_straight(block, target, pace, out);
        }
        let start = self.state.path_end;
        let end = settled(start, target, [None, None]);
        self.state.position = target;
        if end == start {
            self.count_zero_length(pace);
            return Ok(());
        }
        self.check_limits(block, &end, &end, "the end")?;
        let segment = Segment::line(start, end);
        let speed = self.speed(block, &segment, pace)?;
        self.push_move(segment, speed, out);
        Ok(())
    }

    pub(crate) const fn count_zero_length(&mut self, pace: Pace) {
        match pace {
            Pace::Rapid => self.zero_length.rapids += 1,
            Pace::Feed => self.zero_length.feeds += 1,
        }
    }

    pub(crate) fn push_move(&mut self, segment: Segment, speed: Speed, out: &mut Vec<Item>) {
        self.state.path_end = segment.end();
        let kind = ItemKind::Move {
            segment,
            rate: speed.rate(&segment),
            mode: self.state.modal.path_mode,
        };
        self.push(out, kind);
    }

    /// G28 and G30: by way of the programmed point to the reference position, at rapid speed. With
    /// axis words, only those axes move.
    pub(crate) fn go_to_reference(
        &mut self,
        block: &Block,
        index: usize,
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        let all = !block.has_any(AXIS_WORDS);
        if !all {
            let target = self.target(block)?;
            self.straight(block, target, Pace::Rapid, out)?;
        }
        let reference = self
            .offsets
            .reference
            .get(index)
            .copied()
            .unwrap_or_default();
        let mut target = self.state.position;
        let values = self.axis_values(block)?;
        for axis in Axis::ALL {
            let i = axis.index();
            let goes = self.options.machine.has(axis) && self.options.extruder != Some(axis);
            if values[i].is_some() || (all && goes) {
                target[i] = reference[i];
            }
        }
        self.straight(block, target, Pace::Rapid, out)
    }

    /// Speed of a move along a segment, or one like it.
    pub(crate) fn speed(&self, block: &Block, segment: &Segment, pace: Pace) -> Outcome<Speed> {
        if pace == Pace::Rapid {
            return Ok(Speed::Rapid);
        }
        let modal = &self.state.modal;
        if modal.feed_mode == FeedMode::InverseTime {
            let per_minute = block.get(b'F').ok_or_else(|| {
                Fault::new(
                    Code::MissingFeed,
                    motion_span(block),
                    "no F in an inverse-time block",
                )
                .because("with G93 every feed move has its own F: one over its minutes")
                .help("add the F word, or go back to G94")
            })?;
            return Ok(Speed::Moves(per_minute));
        }
        let feed = modal.feed.ok_or_else(|| {
            Fault::new(
                Code::MissingFeed,
                motion_span(block),
                "a feed move without a feedrate",
            )
            .because("no F word came before it since the program, or its feed mode, began")
            .help("write an F word")
        })?;
        let feed = match segment {
            Segment::Arc(_) => feed.linear_v,
            _ => feed.of_line(&segment.start(), &segment.end()),
        };
        if modal.feed_mode == FeedMode::PerMinute {
            return Ok(Speed::Feed(feed));
        }
        let speed = self.state.spindle.speed;
        if speed <= 0.0 {
            let message = "a feed per revolution (G95) of a spindle without a speed";
            return Err(Fault::new(Code::Spindle, motion_span(block), message)
                .because("the move would never end")
                .help("write an S word above zero, or go back to G94"));
        }
        Ok(Speed::Feed(feed * speed / 60.0))
    }

    /// Refuses a move whose box, from `low` to `high`, leaves the travel of an axis that moves.
    pub(crate) fn check_limits(
        &self,
        block: &Block,
        low: &AxisVector,
        high: &AxisVector,
        what: &str,
    ) -> Outcome<()> {
        for axis in Axis::ALL {
            let i = axis.index();
            let Some(travel) = self.options.machine.travel(axis) else {
                continue;
            };
            // A machine that stands outside may come back, and may move its other axes.
            let start = self.state.path_end[i];
            if high[i] > self.reach.high[i] && high[i] > start {
                return Err(beyond_limit(block, axis, high[i], travel.max, what));
            }
            if low[i] < self.reach.low[i] && low[i] < start {
                return Err(beyond_limit(block, axis, low[i], travel.min, what));
            }
        }
        Ok(())
    }
}

/// `target` with every axis that would not really move put back on `start`; the axes in `keep`
/// are left alone.
#[inline]
pub(crate) fn settled(
    start: AxisVector,
    mut target: AxisVector,
    keep: [Option<Axis>; 2],
) -> AxisVector {
    let programmed = target;
    for i in 0..AXES {
        let moves = (target[i] - start[i]).abs() > MIN_MOVE;
        target[i] = if moves { target[i] } else { start[i] };
    }
    for axis in keep.into_iter().flatten() {
        target[axis.index()] = programmed[axis.index()];
    }
    target
}

/// Where a finding about the motion of a block points.
pub(crate) fn motion_span(block: &Block) -> Span {
    let code = block.codes.motion.map(|motion| motion.span);
    let axes = block.axes().map(|(axis, _)| block.axis_span(axis));
    let polar = block.polar.into_iter().flatten().map(|word| word.span);
    code.into_iter()
        .chain(axes)
        .chain(polar)
        .min_by_key(|span| span.start)
        .unwrap_or_default()
}

#[cold]
fn beyond_limit(block: &Block, axis: Axis, reached: f64, limit: f64, what: &str) -> Box<Fault> {
    let span = Some(block.axis_span(axis)).filter(|span| span.length > 0);
    let unit = if axis.is_rotary() { "°" } else { " mm" };
    let side = if reached > limit { "above" } else { "below" };
    let message = format!(
        "{what} of the move is outside the travel of {axis}: {}{unit} is {side} {}{unit}",
        short(reached),
        short(limit)
    );
    Fault::new(
        Code::SoftLimit,
        span.unwrap_or_else(|| motion_span(block)),
        message,
    )
    .because("the soft limits are machine coordinates: work offsets are included")
    .help("check the work offset and the start position, or make the part smaller")
}

/// A coordinate for a message, to the nanometre.
fn short(value: f64) -> f64 {
    (value * 1e6).round() / 1e6
}
