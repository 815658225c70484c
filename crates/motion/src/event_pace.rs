//! The pace of events: moves are slowed down where events are denser than periods carry them.
//!
//! A frame, and a setpoint, has room for [`EVENTS_MOST`] events. So that there is room whatever part
//! of a period they fall into, events draw on a *credit* that time gives back: [`BURST`] of them may
//! happen at once, and [`RATE`] more in every period. Where the moves between them would be driven in
//! less time than that, at any override, they are driven more slowly. Moves that are too short to be
//! slowed down leave a *debt* to those after them; with more than [`DEBT`], the motion rests.
//!
//! In any time as long as a period there are then no more than `BURST + RATE + DEBT` events.

use crate::programmed_rate::axes_speed;
use glidepath_program::{
    EVENTS_MOST, Item, ItemKind, Limits, PathMode, ProgramLine, Rate, Settings,
};

/// Events that may happen at once.
const BURST: f64 = 8.0;
/// Events that may happen in a period in the long run.
const RATE: f64 = 6.0;
/// Events that are made up for later.
const DEBT: f64 = 2.0;
const _: () = assert!(BURST + RATE + DEBT <= EVENTS_MOST as f64);

/// The highest override of a feed.
const OVERRIDE_MOST: f64 = 2.0;
/// A move is not slowed down below this part of its fastest speed, which would be nearly a stop.
const SLOWEST_R: f64 = 0.05;

/// How many events there may be at once at the present place of the program.
#[derive(Debug, Clone, Copy)]
pub(crate) struct EventPace {
    period_t: f64,
    limits: Limits,
    /// Below zero: the debt.
    credit: f64,
}

/// An item that is driven at its pace.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Paced {
    /// A rest in front of it.
    pub(crate) rest: Option<Item>,
    pub(crate) item: Item,
}

impl EventPace {
    pub(crate) const fn new(settings: &Settings) -> Self {
        Self {
            period_t: settings.period_t,
            limits: settings.limits,
            credit: BURST,
        }
    }

    /// The next item, as it is to be driven.
    pub(crate) fn take(&mut self, item: &Item) -> Paced {
        let mut paced = Paced {
            rest: None,
            item: *item,
        };
        match &mut paced.item.kind {
            ItemKind::Move {
                segment,
                rate,
                mode,
            } => {
                if self.credit < BURST {
                    let length_s = segment.length();
                    let axes_v = axes_speed(segment, &self.limits);
                    *rate = self.drive(length_s, axes_v, *rate);
                }
                // A rest takes a period at least. And a part of a program begins behind it.
                if *mode == PathMode::ExactStop {
                    self.credit = BURST;
                }
            }
            ItemKind::Dwell(_) => self.credit = BURST,
            ItemKind::Event(event) if event.is_at_rest() => self.credit = BURST,
            ItemKind::Event(_) => {
                self.credit -= 1.0;
                if self.credit < -DEBT {
                    paced.rest = Some(rest_at(item.program_line()));
                    self.credit = BURST - 1.0;
                }
            }
        }
        paced
    }

    /// The rate of a move so long, at which the time for the events before it is there.
    fn drive(&mut self, length_s: f64, axes_v: f64, rate: Rate) -> Rate {
        let fastest_v = match rate.feed_v() {
            Some(feed_v) => (OVERRIDE_MOST * feed_v).min(rate.most_v()),
            None => axes_v.min(rate.most_v()),
        };
        let given = length_s / fastest_v / self.period_t * RATE;
        let credit = self.credit + given;
        let wanted_t = -self.credit / RATE * self.period_t;
        let is_too_short = length_s <= SLOWEST_R * fastest_v * wanted_t;
        if credit >= 0.0 || is_too_short || rate.is_synchronised() {
            self.credit = credit.min(BURST);
            return rate;
        }
        self.credit = 0.0;
        rate.up_to(length_s / wanted_t)
    }
}

/// A rest that takes no longer than it has to.
const fn rest_at(line: ProgramLine) -> Item {
    line.item(ItemKind::Dwell(0.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use glidepath_geometry::{AxisVector, Segment};
    use glidepath_program::{Event, PathMode, Smoothing};

    const FEED_V: f64 = 100.0;

    fn pace() -> EventPace {
        EventPace::new(&Settings {
            limits: Limits::uniform(200.0, 2000.0, 40_000.0),
            tolerance_mm: 0.02,
            direction: glidepath_program::DirectionTolerance::default(),
            smoothing: Smoothing::Auto,
            corners: glidepath_program::Corners::default(),
            period_t: 0.004,
            effort: glidepath_program::Effort::Optimal,
        })
    }

    fn event() -> Item {
        ProgramLine::NONE.item(ItemKind::Event(Event::SpindleSpeed(1.0)))
    }

    /// The rate that is left of a move.
    fn driven(pace: &mut EventPace, length_mm: f64) -> Rate {
        let kind = ItemKind::Move {
            segment: Segment::line(AxisVector::zeros(), AxisVector::x() * length_mm),
            rate: Rate::Feed(FEED_V),
            mode: PathMode::Continuous { tolerance_mm: None },
        };
        match pace.take(&ProgramLine::NONE.item(kind)).item.kind {
            ItemKind::Move { rate, .. } => rate,
            _ => unreachable!("a move stays one"),
        }
    }

    #[test]
    fn a_word_every_tenth_of_a_millimetre_does_not_change_the_feed() {
        let mut pace = pace();
        for _ in 0..1000 {
            assert!(pace.take(&event()).rest.is_none());
            let rate = driven(&mut pace, 0.1);
            assert!(rate.most_v() > 1.4 * FEED_V, "{rate:?}");
        }
    }

    #[test]
    fn denser_ones_make_the_moves_slower_and_a_heap_of_them_makes_a_rest() {
        let mut pace = pace();
        let mut time_t = 0.0;
        for _ in 0..1000 {
            assert!(pace.take(&event()).rest.is_none());
            let rate = driven(&mut pace, 0.02);
            let most_v = rate.most_v().min(2.0 * FEED_V);
            time_t += 0.02 / most_v;
        }
        let events = time_t / 0.004 * RATE + BURST + DEBT;
        assert!(events >= 1000.0, "{events} events in {time_t} s");
        let rests = (0..30).filter(|_| pace.take(&event()).rest.is_some());
        assert!(rests.count() >= 3);
        // Nobody waits for an event alone.
        let mut pace = self::pace();
        assert!((0..8).all(|_| pace.take(&event()).rest.is_none()));
        assert_eq!(driven(&mut pace, 1e-4), Rate::Feed(FEED_V));
    }
}
