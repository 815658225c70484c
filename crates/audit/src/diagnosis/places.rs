//! The places where a motion is slower than programmed.
//!
//! ```text
//!  feed ─────────┐        ┌──┐          ┌────
//!                 \      /    \   ┌┐   /
//!                  \____/      \_/  \_/
//!                  place 1      2    3
//! ```
//!
//! A place is a valley of the speed: it begins where the speed leaves the feed, or at the top
//! between two valleys, and ends likewise. Its line is that of the bottom.

use super::binding::{Binding, COUNT};

/// From this share of the feed on nothing is lost that is worth a line in a report.
const AS_FAST_R: f64 = 0.95;
/// A top between two valleys stands out from both of them by this factor.
const TOP_R: f64 = 1.25;
/// Places kept.
const KEPT: usize = 10;

/// A place where time is lost.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SlowPlace {
    /// Source line of the slowest period, and of the first and the last one.
    pub line: u32,
    /// Source line where it begins.
    pub first_line: u32,
    /// Source line where it ends.
    pub last_line: u32,
    /// Program time at its start, s.
    pub start_t: f64,
    /// How long it lasts, s.
    pub duration_t: f64,
    /// Lowest speed, mm/s.
    pub speed_v: f64,
    /// Programmed speed at the slowest period, override included, mm/s.
    pub feed_v: f64,
    /// What binds for most of the time.
    pub binding: Binding,
    /// Time lost against the programmed speed, s.
    pub lost_t: f64,
}

/// One period, as far as it matters here.
#[derive(Debug, Clone, Copy)]
pub(super) struct Visit {
    pub(super) sequence: u64,
    pub(super) line: u32,
    pub(super) speed_v: f64,
    pub(super) feed_v: f64,
    pub(super) binding: Binding,
    /// The program asks for the rest, or there is no motion yet or any more.
    pub(super) is_wait: bool,
}

/// A valley, or a part of one, as it grows.
#[derive(Debug, Clone)]
struct Valley {
    start: u64,
    periods: u64,
    first_line: u32,
    last_line: u32,
    bottom: Visit,
    lost_periods: f64,
    counts: [u32; COUNT],
}

/// Collects places.
#[derive(Debug)]
pub(super) struct Places {
    period_t: f64,
    /// The valley at hand as far as its highest top behind the bottom, and what follows that top.
    valley: Option<Valley>,
    behind: Option<Valley>,
    top_v: f64,
    kept: Vec<SlowPlace>,
}

impl Valley {
    fn new(visit: &Visit) -> Self {
        let mut valley = Self {
            start: visit.sequence,
            periods: 0,
            first_line: visit.line,
            last_line: visit.line,
            bottom: *visit,
            lost_periods: 0.0,
            counts: [0; COUNT],
        };
        valley.add(visit);
        valley
    }

    fn add(&mut self, visit: &Visit) {
        self.periods += 1;
        self.last_line = visit.line;
        if visit.speed_v < self.bottom.speed_v {
            self.bottom = *visit;
        }
        self.lost_periods += 1.0 - visit.speed_v / visit.feed_v;
        if let Some(count) = self.counts.get_mut(visit.binding.index()) {
            *count = count.saturating_add(1);
        }
    }

    fn join(&mut self, other: &Self) {
        self.periods += other.periods;
        self.last_line = other.last_line;
        if other.bottom.speed_v < self.bottom.speed_v {
            self.bottom = other.bottom;
        }
        self.lost_periods += other.lost_periods;
        for (count, other) in self.counts.iter_mut().zip(other.counts) {
            *count = count.saturating_add(other);
        }
    }

    fn place(&self, period_t: f64) -> SlowPlace {
        let most = Binding::all()
            .zip(self.counts)
            .reduce(|a, b| if b.1 > a.1 { b } else { a });
        #[allow(
            clippy::cast_precision_loss,
            reason = "2^53 periods are a million years"
        )]
        let seconds = |periods: u64| periods as f64 * period_t;
        SlowPlace {
            line: self.bottom.line,
            first_line: self.first_line,
            last_line: self.last_line,
            start_t: seconds(self.start.saturating_sub(1)),
            duration_t: seconds(self.periods),
            speed_v: self.bottom.speed_v,
            feed_v: self.bottom.feed_v,
            binding: most.map_or(Binding::None, |(binding, _)| binding),
            lost_t: self.lost_periods * period_t,
        }
    }
}

impl Places {
    pub(super) const fn new(period_t: f64) -> Self {
        Self {
            period_t,
            valley: None,
            behind: None,
            top_v: 0.0,
            kept: Vec::new(),
        }
    }

    pub(super) fn next(&mut self, visit: &Visit) {
        if visit.is_wait || visit.speed_v >= AS_FAST_R * visit.feed_v || visit.feed_v.is_infinite()
        {
            self.close();
            return;
        }
        let Some(valley) = &mut self.valley else {
            self.valley = Some(Valley::new(visit));
            self.top_v = 0.0;
            return;
        };
        match &mut self.behind {
            Some(behind) => behind.add(visit),
            None => self.behind = Some(Valley::new(visit)),
        }
        let bottom_v = valley.bottom.speed_v;
        let is_top = visit.speed_v >= self.top_v;
        if visit.speed_v <= bottom_v || (is_top && visit.speed_v >= TOP_R * bottom_v) {
            // Deeper, or higher than before: all so far is one valley.
            if let Some(behind) = self.behind.take() {
                valley.join(&behind);
            }
            self.top_v = if visit.speed_v <= bottom_v {
                0.0
            } else {
                visit.speed_v
            };
        } else if self.top_v > 0.0 && TOP_R * visit.speed_v <= self.top_v {
            let behind = self.behind.take();
            let done = core::mem::replace(&mut self.valley, behind);
            self.keep(done);
            self.top_v = 0.0;
        }
    }

    fn close(&mut self) {
        if self.valley.is_none() {
            return;
        }
        let mut valley = self.valley.take();
        if let (Some(valley), Some(behind)) = (&mut valley, self.behind.take()) {
            valley.join(&behind);
        }
        self.keep(valley);
    }

    fn keep(&mut self, valley: Option<Valley>) {
        let Some(place) = valley.map(|valley| valley.place(self.period_t)) else {
            return;
        };
        let before = self
            .kept
            .partition_point(|kept| kept.lost_t >= place.lost_t);
        if before < KEPT {
            self.kept.truncate(KEPT - 1);
            self.kept.insert(before, place);
        }
    }

    pub(super) fn finish(mut self) -> Vec<SlowPlace> {
        self.close();
        self.kept
    }
}
