//! The gears of a spindle at work: which one is in, and how another one comes in.
//!
//! ```text
//!   in ──(another is commanded)──► is to stand ──(it stands)──► its output is on ──(its input alone)──► in
//!    └──(its input falls)──► none is in: not to turn
//! ```
//!
//! What counts is what inputs say, and not what was commanded: by the ratio of a gear that is not in, a
//! spindle would turn at another speed than anybody wants. So a spindle whose gear is not known does not
//! turn, and after its time that is a fault.

use super::gear_settings::{GearSettings, Swing};

/// How long inputs have to say the same until it counts, ns: contacts bounce.
const SETTLED_NS: u64 = 20_000_000;

/// Something that is wrong with the gears.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum GearTrouble {
    /// A gear did not come in in time.
    NotIn(u32),
    /// A gear that was in is not any more.
    Lost(u32),
    /// Nobody said which gear is to be in, and inputs tell none.
    Unknown,
}

/// One cycle of the gears.
#[derive(Debug, Clone, Copy)]
pub(super) struct GearCycle {
    pub(super) now_ns: u64,
    /// All digital inputs by their numbers.
    pub(super) inputs: u64,
    /// The gear that is commanded, from 1; 0 for the one that is in.
    pub(super) commanded: u32,
    /// That was commanded anew.
    pub(super) is_asked: bool,
    /// The spindle is as it is to be where gears are changed.
    pub(super) may_shift: bool,
    /// It is to turn.
    pub(super) is_to_turn: bool,
}

/// The gears of a spindle.
#[derive(Debug, Clone, Copy)]
pub(super) struct Gearbox {
    settings: GearSettings,
    /// What inputs say, 0 for none or several, and since when, ns.
    seen: u32,
    seen_ns: Option<u64>,
    /// The gear whose output is on, 0 for none.
    put_in: u32,
    /// The gear that is in, 0 for none.
    present: u32,
    commanded: u32,
    /// It was commanded, and has not come in since.
    is_asked: bool,
    /// It is to come in: no motor begins to swing because a contact falls at rest.
    is_awaited: bool,
    /// Since when one is waited for, ns.
    since_ns: Option<u64>,
}

impl Gearbox {
    pub(super) const fn new(settings: GearSettings) -> Self {
        Self {
            settings,
            seen: 0,
            seen_ns: None,
            put_in: 0,
            present: 0,
            commanded: 0,
            is_asked: false,
            is_awaited: false,
            since_ns: None,
        }
    }

    pub(super) const fn settings(&self) -> &GearSettings {
        &self.settings
    }

    /// The gear whose output is to be on, 0 for none.
    pub(super) const fn put_in(&self) -> u32 {
        self.put_in
    }

    /// The gear that is in, 0 for none.
    pub(super) const fn present(&self) -> u32 {
        self.present
    }

    /// Whether the gear that is commanded is in, so that the spindle may turn.
    pub(super) const fn is_in(&self) -> bool {
        self.present != 0 && (self.commanded == 0 || self.commanded == self.present)
    }

    /// Whether a gear is to come in.
    pub(super) const fn is_awaited(&self) -> bool {
        self.is_awaited && self.commanded != 0
    }

    /// The operator has reset what there was: gears have their time anew.
    pub(super) const fn reset(&mut self) {
        self.since_ns = None;
    }

    /// The speed of the motor while gears are changed, rev/min.
    pub(super) fn swing_rpm(&self, now_ns: u64) -> f64 {
        let (Some(Swing { rpm, way_ns }), Some(since_ns)) = (self.settings.swing, self.since_ns)
        else {
            return 0.0;
        };
        let ways = now_ns.saturating_sub(since_ns) / way_ns;
        if ways.is_multiple_of(2) { rpm } else { -rpm }
    }

    /// Looks at inputs, and has the gear that is commanded come in.
    pub(super) fn step(&mut self, cycle: GearCycle) -> Option<GearTrouble> {
        let has_settled = self.look(&cycle);
        self.commanded = cycle.commanded;
        self.is_asked |= cycle.is_asked;
        let is_lost = self.present != 0 && has_settled && self.seen != self.present;
        let lost = is_lost.then(|| core::mem::take(&mut self.present));
        if self.present == 0 && self.put_in == 0 && has_settled {
            // What is in when the machine is switched on stays in.
            (self.present, self.put_in) = (self.seen, self.seen);
        }
        if let Some(gear) = lost.filter(|_| cycle.is_to_turn) {
            return Some(GearTrouble::Lost(gear));
        }
        self.is_awaited = !self.is_in() && (self.is_asked || cycle.is_to_turn);
        if !self.is_awaited {
            (self.is_asked, self.since_ns) = (false, None);
            return None;
        }
        self.bring_in(&cycle, has_settled)
    }

    /// Brings the gear in that is commanded, or the one that was put in.
    fn bring_in(&mut self, cycle: &GearCycle, has_settled: bool) -> Option<GearTrouble> {
        let target = if self.commanded == 0 {
            self.put_in
        } else {
            self.commanded
        };
        if !cycle.may_shift {
            // Its time begins where the spindle stands.
            self.since_ns = None;
            return None;
        }
        if self.put_in != target {
            (self.put_in, self.present) = (target, 0);
            // The contact of the one before falls, and that of this one comes.
            (self.seen_ns, self.since_ns) = (None, Some(cycle.now_ns));
        } else if has_settled && target != 0 && self.seen == target {
            (self.present, self.since_ns) = (target, None);
            (self.is_asked, self.is_awaited) = (false, false);
            return None;
        }
        let since_ns = *self.since_ns.get_or_insert(cycle.now_ns);
        if cycle.now_ns.saturating_sub(since_ns) <= self.settings.within_ns {
            return None;
        }
        self.is_asked = false;
        Some(match target {
            0 => GearTrouble::Unknown,
            target => GearTrouble::NotIn(target),
        })
    }

    /// Takes up what inputs say. Returns whether they have said it for a while.
    fn look(&mut self, cycle: &GearCycle) -> bool {
        let is_on = |input: usize| cycle.inputs >> (input & 63) & 1 == 1;
        let mut on = self.settings.all().filter(|(_, gear)| is_on(gear.input));
        let seen = match (on.next(), on.next()) {
            (Some((number, _)), None) => number,
            _ => 0,
        };
        if seen != self.seen || self.seen_ns.is_none() {
            (self.seen, self.seen_ns) = (seen, Some(cycle.now_ns));
        }
        let since_ns = self.seen_ns.unwrap_or(cycle.now_ns);
        cycle.now_ns.saturating_sub(since_ns) >= SETTLED_NS
    }
}
