//! The distance of events that do not stop the motion from their places in the program.
//!
//! An event stands in the program where a move ends. When it happens is told with the sample that
//! ends its period; the motion is then on the straight line between two samples. The distance holds
//! all that the motion is off the path, too, which the tolerance allows.

use glidepath_geometry::AxisVector;
use glidepath_program::{Event, Item, ItemKind, tolerance_norm};
use std::collections::VecDeque;

/// Events of the program that may not have happened where a later one has: those told again, or left
/// out, behind a line that a program was begun at.
const SEARCHED: usize = 64;

/// Most events that may be to come: of a motion without events they never do.
const MOST_EXPECTED: usize = 1 << 16;

/// An event where the program has it.
#[derive(Debug, Clone, Copy)]
struct Expected {
    event: Event,
    /// `None` before the first move: it happens where the machine stands.
    place: Option<AxisVector>,
    line: u32,
}

/// The events of a motion and of its program.
#[derive(Debug)]
pub(crate) struct EventPlaces {
    period_ns: f64,
    /// Where the program fed so far ends, once it moves.
    end: Option<AxisVector>,
    expected: VecDeque<Expected>,
    /// What happens before the next sample, and after which part of its period.
    happening: Vec<(Event, f64)>,
    last: Option<AxisVector>,
    /// Events that were found.
    pub(crate) count: u64,
    /// The largest distance, mm, and its line.
    pub(crate) most_off: (f64, u32),
    /// The sum of all, mm.
    sum_mm: f64,
}

impl EventPlaces {
    pub(crate) const fn new(period_t: f64) -> Self {
        Self {
            period_ns: period_t * 1e9,
            end: None,
            expected: VecDeque::new(),
            happening: Vec::new(),
            last: None,
            count: 0,
            most_off: (0.0, 0),
            sum_mm: 0.0,
        }
    }

    /// The mean distance, mm; 0 without events.
    #[allow(clippy::cast_precision_loss, reason = "a count, for a mean")]
    pub(crate) fn mean_mm(&self) -> f64 {
        self.sum_mm / self.count.max(1) as f64
    }

    /// The next item of the program.
    pub(crate) fn program(&mut self, item: &Item) {
        match &item.kind {
            ItemKind::Move { segment, .. } => self.end = Some(segment.end()),
            ItemKind::Event(event) if !event.is_at_rest() => {
                if self.expected.len() >= MOST_EXPECTED {
                    self.expected.pop_front();
                }
                self.expected.push_back(Expected {
                    event: *event,
                    place: self.end,
                    line: item.line,
                });
            }
            ItemKind::Event(_) | ItemKind::Dwell(_) => {}
        }
    }

    /// An event happens before the next sample, so many ns after the last.
    pub(crate) fn happens(&mut self, event: Event, offset_ns: u32) {
        if !event.is_at_rest() {
            let part = f64::from(offset_ns) / self.period_ns;
            self.happening.push((event, part.min(1.0)));
        }
    }

    /// The next sample, away from the path: what happens there has no place.
    pub(crate) fn sample_away(&mut self, position: &AxisVector) {
        self.last = Some(*position);
        self.happening.clear();
    }

    /// The next sample.
    pub(crate) fn sample(&mut self, position: &AxisVector) {
        let before = self.last.replace(*position).unwrap_or(*position);
        for (event, part) in core::mem::take(&mut self.happening) {
            let is_it = |expected: &Expected| expected.event == event;
            let Some(index) = self.expected.iter().take(SEARCHED).position(is_it) else {
                continue;
            };
            self.expected.drain(..index);
            let Some(expected) = self.expected.pop_front() else {
                continue;
            };
            let Some(place) = expected.place else {
                continue;
            };
            let at = before + (position - before) * part;
            let off_mm = tolerance_norm(&(at - place), 1.0);
            self.count += 1;
            self.sum_mm += off_mm;
            if off_mm > self.most_off.0 || self.count == 1 {
                self.most_off = (off_mm, expected.line);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glidepath_geometry::Segment;
    use glidepath_program::{PathMode, Rate};

    /// What is found of an event in the middle of 10 mm that happens so late, ns.
    fn found(offset_ns: u32) -> EventPlaces {
        let mut places = EventPlaces::new(0.004);
        let at = |x: f64| AxisVector::x() * x;
        let item = |kind| Item {
            line: 7,
            block: 0,
            kind,
        };
        let leg = |from: f64, to: f64| ItemKind::Move {
            segment: Segment::line(at(from), at(to)),
            rate: Rate::Feed(100.0),
            mode: PathMode::Continuous { tolerance_mm: None },
        };
        let event = Event::SpindleSpeed(500.0);
        for kind in [leg(0.0, 5.0), ItemKind::Event(event), leg(5.0, 10.0)] {
            places.program(&item(kind));
        }
        for k in 0..=25 {
            if k == 13 {
                places.happens(event, offset_ns);
            }
            places.sample(&at(0.4 * f64::from(k)));
        }
        places
    }

    #[test]
    fn an_event_before_the_first_move_is_not_taken_for_its_like_behind_one() {
        let mut places = EventPlaces::new(0.004);
        let event = Event::SpindleSpeed(300.0);
        let item = |kind| Item {
            line: 7,
            block: 0,
            kind,
        };
        let leg = Segment::line(AxisVector::zeros(), AxisVector::x() * 84.0);
        let leg = ItemKind::Move {
            segment: leg,
            rate: Rate::Feed(25.0),
            mode: PathMode::Continuous { tolerance_mm: None },
        };
        for kind in [ItemKind::Event(event), leg, ItemKind::Event(event)] {
            places.program(&item(kind));
        }
        for x in [0.0, 84.0] {
            places.happens(event, 4_000_000);
            places.sample(&(AxisVector::x() * x));
        }
        assert_eq!((places.count, places.most_off.0), (1, 0.0));
    }

    #[test]
    fn an_event_in_its_place_is_told_from_one_that_is_late() {
        // The sample at 4.8 mm, and half a period.
        let places = found(2_000_000);
        assert_eq!((places.count, places.most_off.1), (1, 7));
        assert!(places.most_off.0 < 1e-12, "{:?}", places.most_off);
        let late = found(4_000_000);
        assert!((late.most_off.0 - 0.2).abs() < 1e-12, "{:?}", late.most_off);
        assert!((late.mean_mm() - 0.2).abs() < 1e-12);
    }
}
