//! The operator's seat: one page operates at a time.
//!
//! A page takes the seat when nobody has it, or when whoever has it has been silent for [`SILENCE`]. Else
//! it asks for it, and whoever has it gives it, or keeps it. Nobody is put out by anybody else.

use core::time::Duration;
use std::time::Instant;

/// A page that has said nothing for so long has left the seat.
pub const SILENCE: Duration = Duration::from_secs(5);
/// A page that has asked for the seat and does not ask any more does not want it.
const WISH: Duration = Duration::from_secs(30);

/// The operator's seat: who has it, and who wants it. Pages are told by the numbers that they have
/// given themselves.
#[derive(Debug, Default)]
pub struct Seat {
    holder: Option<(u64, Instant)>,
    asking: Option<(u64, Instant)>,
}

impl Seat {
    /// A page says that it is there. It takes the seat if nobody has it. Returns whether it has it.
    pub fn here(&mut self, page: u64, now: Instant) -> bool {
        self.look(now);
        let holder = self.holder.get_or_insert((page, now));
        if holder.0 != page {
            return false;
        }
        holder.1 = now;
        if self.asking.is_some_and(|(asking, _)| asking == page) {
            self.asking = None;
        }
        true
    }

    /// A page wants the seat. Returns whether it has it.
    pub fn ask(&mut self, page: u64, now: Instant) -> bool {
        if self.here(page, now) {
            return true;
        }
        // Whoever asked first is answered first.
        match &mut self.asking {
            Some((asking, since)) if *asking == page => *since = now,
            Some(_) => {}
            None => self.asking = Some((page, now)),
        }
        false
    }

    /// The page that has the seat answers the one that asks for it. Returns whether there was one.
    pub fn answer(&mut self, page: u64, gives: bool, now: Instant) -> bool {
        self.look(now);
        let Some((asking, _)) = self.asking.filter(|_| self.holds(page)) else {
            return false;
        };
        self.asking = None;
        if gives {
            self.holder = Some((asking, now));
        }
        true
    }

    /// A page leaves the seat.
    pub fn leave(&mut self, page: u64) {
        if self.holds(page) {
            self.holder = None;
        }
        if self.asking.is_some_and(|(asking, _)| asking == page) {
            self.asking = None;
        }
    }

    /// Whether a page has the seat.
    #[must_use]
    pub fn holds(&self, page: u64) -> bool {
        self.holder.is_some_and(|(holder, _)| holder == page)
    }

    /// Who has the seat, and who asks for it.
    pub fn who(&mut self, now: Instant) -> [Option<u64>; 2] {
        self.look(now);
        [self.holder, self.asking].map(|who| who.map(|(page, _)| page))
    }

    fn look(&mut self, now: Instant) {
        let is_there = |since: Instant, patience| now.saturating_duration_since(since) < patience;
        self.holder = self.holder.filter(|(_, heard)| is_there(*heard, SILENCE));
        self.asking = self.asking.filter(|(_, asked)| is_there(*asked, WISH));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_page_has_the_seat_until_it_is_silent() {
        let (mut seat, start) = (Seat::default(), Instant::now());
        let at = |s| start + Duration::from_secs(s);
        assert!(seat.here(1, at(0)));
        assert!(!seat.here(2, at(1)) && !seat.ask(2, at(2)));
        assert!(seat.here(1, at(4)));
        assert!(!seat.ask(2, at(8)), "it was heard 4 s ago");
        assert_eq!(seat.who(at(8)), [Some(1), Some(2)]);
        assert!(seat.ask(2, at(9)), "it is silent for 5 s");
        assert_eq!(seat.who(at(9)), [Some(2), None]);
        assert!(!seat.here(1, at(10)), "it has to ask now");
    }

    #[test]
    fn the_seat_is_given_by_whoever_has_it_and_by_nobody_else() {
        let (mut seat, start) = (Seat::default(), Instant::now());
        assert!(seat.here(1, start) && !seat.ask(2, start) && !seat.ask(3, start));
        assert_eq!(
            seat.who(start),
            [Some(1), Some(2)],
            "the first one is answered first"
        );
        assert!(!seat.answer(2, true, start) && !seat.answer(3, true, start));
        assert!(seat.answer(1, false, start), "it is kept");
        assert_eq!(seat.who(start), [Some(1), None]);
        assert!(!seat.ask(3, start) && seat.answer(1, true, start));
        assert!(seat.holds(3) && !seat.holds(1));
        seat.leave(1);
        assert!(seat.holds(3), "who has it not cannot leave it for another");
        seat.leave(3);
        assert!(seat.here(2, start));
    }

    #[test]
    fn a_wish_is_forgotten() {
        let (mut seat, start) = (Seat::default(), Instant::now());
        assert!(seat.here(1, start) && !seat.ask(2, start));
        for second in 1..40 {
            assert!(seat.here(1, start + Duration::from_secs(second)));
        }
        let later = start + Duration::from_secs(40);
        assert!(!seat.answer(1, true, later) && seat.holds(1));
    }
}
