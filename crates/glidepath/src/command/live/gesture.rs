//! A gesture, a finger on a button that moves an axis: what of the page's messages still counts.
//!
//! While a finger is down the page sends a message every 50 ms, with a number that rises and the time of
//! its own clock. The motion lasts for as long as they come. One that comes late (a browser that was
//! stopped, a network that kept it back) does not count, and a gesture that has fallen silent is over:
//! only a new one, a finger that came down again, moves the axis.

use core::time::Duration;
use std::time::Instant;

/// A gesture of which nothing was heard for so long is over.
pub(super) const SILENCE: Duration = Duration::from_millis(150);
/// A message that was on its way for so much longer than the quickest one is late, ms.
const LATE_MS: f64 = 60.0;

/// The outcome of a message.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Heard {
    /// It counts.
    Fresh,
    /// It is older than one that was heard, or came late: as if it had not been sent.
    Late,
    /// The gesture is over.
    Over,
}

/// The gesture that counts.
#[derive(Debug)]
pub(super) struct Gesture {
    id: u64,
    number: u64,
    begun: Instant,
    heard: Instant,
    /// The least of the time here less that of the page's clock, ms.
    quickest_ms: f64,
    is_over: bool,
}

impl Gesture {
    /// Begins with a message.
    pub(super) fn begin(id: u64, number: u64, at_ms: f64, now: Instant) -> Self {
        Self {
            id,
            number,
            begun: now,
            heard: now,
            quickest_ms: -at_ms,
            is_over: false,
        }
    }

    pub(super) const fn id(&self) -> u64 {
        self.id
    }

    /// Takes a message of this gesture.
    pub(super) fn hear(&mut self, number: u64, at_ms: f64, now: Instant) -> Heard {
        if self.is_over(now) {
            return Heard::Over;
        }
        let here_ms = now.saturating_duration_since(self.begun).as_secs_f64() * 1e3;
        let way_ms = here_ms - at_ms;
        // A number that is none is late.
        let is_late = way_ms.is_nan() || way_ms > self.quickest_ms + LATE_MS;
        if number <= self.number || is_late {
            return Heard::Late;
        }
        (self.number, self.heard) = (number, now);
        self.quickest_ms = self.quickest_ms.min(way_ms);
        Heard::Fresh
    }

    /// Whether it is over: nothing was heard for too long. It stays over then.
    pub(super) fn is_over(&mut self, now: Instant) -> bool {
        self.is_over |= now.saturating_duration_since(self.heard) > SILENCE;
        self.is_over
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(start: Instant, ms: u64) -> Instant {
        start + Duration::from_millis(ms)
    }

    #[test]
    fn a_gesture_lasts_as_long_as_it_is_heard() {
        let start = Instant::now();
        // The page's clock began long before.
        let mut gesture = Gesture::begin(7, 1, 5000.0, start);
        for message in 1..100_u32 {
            let now = at(start, u64::from(message) * 50);
            let told = gesture.hear(
                u64::from(message) + 1,
                5000.0 + f64::from(message) * 50.0,
                now,
            );
            assert_eq!(told, Heard::Fresh);
        }
        let last = 99 * 50;
        assert!(!gesture.is_over(at(start, last + 150)));
        assert!(gesture.is_over(at(start, last + 151)));
        // Whatever comes now.
        let told = gesture.hear(500, 5000.0 + 9999.0, at(start, last + 152));
        assert_eq!(told, Heard::Over);
    }

    #[test]
    fn what_was_kept_back_does_not_count() {
        let start = Instant::now();
        let mut gesture = Gesture::begin(7, 1, 0.0, start);
        assert_eq!(gesture.hear(2, 50.0, at(start, 51)), Heard::Fresh);
        assert_eq!(
            gesture.hear(2, 50.0, at(start, 52)),
            Heard::Late,
            "the same again"
        );
        assert_eq!(
            gesture.hear(1, 0.0, at(start, 53)),
            Heard::Late,
            "overtaken"
        );
        assert_eq!(
            gesture.hear(3, 60.0, at(start, 140)),
            Heard::Late,
            "80 ms on its way"
        );
        assert_eq!(gesture.hear(4, f64::NAN, at(start, 141)), Heard::Late);
        assert_eq!(gesture.hear(5, 130.0, at(start, 142)), Heard::Fresh);
        // A burst of what was sent while the network stood still keeps nothing alive.
        for kept in 6..20_u32 {
            let sent = 142.0 + f64::from(kept);
            let _late = gesture.hear(u64::from(kept), sent, at(start, 280));
        }
        assert!(gesture.is_over(at(start, 293)));
    }
}
