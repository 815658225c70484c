//! The holder of the jog: which client jogs, and whether what is heard counts.
//!
//! | heard | counts |
//! |---|---|
//! | sent longer ago than the jog time-out allows, or from the future | never: a late demand starts no motion |
//! | from another client than the one that jogs | not before the motion has come to rest |
//! | an older number than the last | never |
//! | the same number again | as a sign of life |
//! | a step whose number was done already | never: a step is one step |
//! | while jogging is not possible, or after it was ended from elsewhere | not before it was let go: nothing sets out by itself because a key is still down |
//! | that it is let go | always |

use crate::shared::message::jog_demand::{Demand, Jogged};
use glidepath_link::JogMode;

/// The meaning of a demand.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Heard {
    /// Nothing.
    Nothing,
    /// The client that jogs lives.
    Alive,
    /// Something new is wanted.
    New,
    /// The client lets go.
    LetGo,
}

/// A client and what it asked for last.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Caller {
    client: u64,
    number: u64,
    sent_ns: u64,
}

/// The holder of the jog.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Holder {
    owner: Option<Caller>,
    /// Whose demands do not count before they let go.
    shut_out: Option<Caller>,
    /// Who jogged last.
    before: Option<Caller>,
    valid_ns: u64,
    /// How far ahead of the tick the clock of a demand may be.
    ahead_ns: u64,
}

impl Holder {
    pub(crate) const fn new(valid_ns: u64, period_ns: u64) -> Self {
        Self {
            owner: None,
            shut_out: None,
            before: None,
            valid_ns,
            ahead_ns: 2 * period_ns,
        }
    }

    /// The demand that was followed last, of whoever jogs or jogged last.
    pub(crate) fn jogged(&self) -> Jogged {
        let last = self.owner.or(self.before);
        last.map_or_else(Jogged::default, |last| Jogged {
            client: last.client,
            number: last.number,
        })
    }

    /// True if nobody heard of the owner for so long that it must be taken for dead.
    pub(crate) fn is_overdue(&self, now_ns: u64) -> bool {
        self.owner
            .is_none_or(|owner| now_ns >= owner.sent_ns.saturating_add(self.valid_ns))
    }

    /// Whether a demand is for now.
    fn is_fresh(&self, demand: &Demand, now_ns: u64) -> bool {
        now_ns < demand.sent_ns.saturating_add(self.valid_ns)
            && demand.sent_ns <= now_ns.saturating_add(self.ahead_ns)
    }

    /// What a demand means; `may_start` if jogging is possible.
    pub(crate) fn hear(&mut self, demand: &Demand, now_ns: u64, may_start: bool) -> Heard {
        let caller = Caller {
            client: demand.client,
            number: demand.number,
            sent_ns: demand.sent_ns,
        };
        if !demand.wants_motion() {
            if self.shut_out.is_some_and(|out| out.client == caller.client) {
                self.shut_out = None;
            }
            let is_owner = self.owner.is_some_and(|o| o.client == caller.client);
            return if is_owner {
                Heard::LetGo
            } else {
                Heard::Nothing
            };
        }
        if !self.is_fresh(demand, now_ns) || self.is_shut_out(&caller, demand.mode) {
            return Heard::Nothing;
        }
        let Some(owner) = &mut self.owner else {
            return self.take_up(caller, demand.mode, may_start);
        };
        if owner.client != caller.client || caller.number < owner.number {
            return Heard::Nothing;
        }
        let is_new = caller.number > owner.number;
        owner.number = caller.number;
        owner.sent_ns = owner.sent_ns.max(caller.sent_ns);
        if is_new { Heard::New } else { Heard::Alive }
    }

    /// The first demand of a client while nobody jogs.
    fn take_up(&mut self, caller: Caller, mode: JogMode, may_start: bool) -> Heard {
        let was_done = |before: Caller| {
            before.client == caller.client
                && (caller.number < before.number
                    || (mode == JogMode::Incremental && caller.number == before.number))
        };
        if self.before.is_some_and(was_done) {
            return Heard::Nothing;
        }
        if !may_start {
            self.shut_out = Some(caller);
            return Heard::Nothing;
        }
        self.owner = Some(caller);
        Heard::New
    }

    /// Whether a client was shut out and has not let go since. Steps are pressed one by one: a new
    /// number is a new one.
    fn is_shut_out(&mut self, caller: &Caller, mode: JogMode) -> bool {
        let Some(out) = &mut self.shut_out else {
            return false;
        };
        if out.client != caller.client {
            return false;
        }
        let paused = caller.sent_ns > out.sent_ns.saturating_add(self.valid_ns);
        let is_another = mode == JogMode::Incremental && caller.number > out.number;
        if paused || is_another {
            self.shut_out = None;
            return false;
        }
        out.sent_ns = out.sent_ns.max(caller.sent_ns);
        true
    }

    /// The jog was ended by somebody else: its client has to let go before it may begin another.
    pub(crate) const fn shut_out(&mut self) {
        if let Some(owner) = self.owner {
            self.shut_out = Some(owner);
        }
    }

    /// The axes are at rest: whoever comes first may move them.
    pub(crate) const fn release(&mut self) {
        if let Some(owner) = self.owner.take() {
            self.before = Some(owner);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glidepath_geometry::AxisVector;

    const MS: u64 = 1_000_000;

    fn demand(client: u64, number: u64, sent_ms: u64, mode: JogMode) -> Demand {
        let value = match mode {
            JogMode::None => 0.0,
            _ => 1.0,
        };
        Demand {
            client,
            number,
            sent_ns: sent_ms * MS,
            is_outdated: false,
            behind_stops: 0,
            mode,
            most_v: f64::INFINITY,
            scale: 1.0,
            value: AxisVector::repeat(value),
        }
    }

    fn holder() -> Holder {
        Holder::new(150 * MS, 4 * MS)
    }

    #[test]
    fn what_comes_late_or_from_the_future_starts_nothing() {
        for sent_ms in [0, 850, 1_009] {
            let late = demand(1, 1, sent_ms, JogMode::Continuous);
            assert_eq!(holder().hear(&late, 1_000 * MS, true), Heard::Nothing);
        }
        for sent_ms in [851, 1_000, 1_008] {
            let fresh = demand(1, 1, sent_ms, JogMode::Continuous);
            assert_eq!(holder().hear(&fresh, 1_000 * MS, true), Heard::New);
        }
    }

    #[test]
    fn the_first_client_keeps_the_axes_until_they_are_released() {
        let mut holder = holder();
        let go = |client, number| demand(client, number, 1_000, JogMode::Continuous);
        assert_eq!(holder.hear(&go(1, 7), 1_000 * MS, true), Heard::New);
        assert_eq!(holder.hear(&go(2, 9), 1_000 * MS, true), Heard::Nothing);
        assert_eq!(holder.hear(&go(1, 7), 1_010 * MS, true), Heard::Alive);
        assert_eq!(holder.hear(&go(1, 6), 1_010 * MS, true), Heard::Nothing);
        assert_eq!(holder.hear(&go(1, 8), 1_010 * MS, true), Heard::New);
        let stranger = demand(2, 10, 1_000, JogMode::None);
        assert_eq!(holder.hear(&stranger, 1_010 * MS, true), Heard::Nothing);
        // That it lets go counts however late it comes.
        let gone = demand(1, 9, 1, JogMode::None);
        assert_eq!(holder.hear(&gone, 1_010 * MS, true), Heard::LetGo);
        holder.release();
        assert_eq!(holder.hear(&go(2, 11), 1_010 * MS, true), Heard::New);
    }

    #[test]
    fn a_step_is_one_step() {
        let mut holder = holder();
        let step = |number| demand(1, number, 1_000, JogMode::Incremental);
        assert_eq!(holder.hear(&step(1), 1_000 * MS, true), Heard::New);
        holder.release();
        assert_eq!(holder.hear(&step(1), 1_050 * MS, true), Heard::Nothing);
        assert_eq!(holder.hear(&step(2), 1_050 * MS, true), Heard::New);
    }

    #[test]
    fn a_key_that_is_still_down_starts_nothing() {
        let mut holder = holder();
        let go = |sent_ms| demand(1, 1, sent_ms, JogMode::Continuous);
        // Held while a program ran, and after it.
        assert_eq!(holder.hear(&go(1_000), 1_000 * MS, false), Heard::Nothing);
        assert_eq!(holder.hear(&go(1_050), 1_050 * MS, true), Heard::Nothing);
        assert_eq!(holder.hear(&go(1_200), 1_200 * MS, true), Heard::Nothing);
        // Let go without a word, and pressed again.
        assert_eq!(holder.hear(&go(1_351), 1_351 * MS, true), Heard::New);
        holder.shut_out();
        holder.release();
        assert_eq!(holder.hear(&go(1_400), 1_400 * MS, true), Heard::Nothing);
        let gone = demand(1, 2, 1_410, JogMode::None);
        assert_eq!(holder.hear(&gone, 1_410 * MS, true), Heard::Nothing);
        assert_eq!(holder.hear(&go(1_420), 1_420 * MS, true), Heard::New);
    }
}
