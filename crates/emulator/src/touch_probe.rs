//! The touch probe of a drive: two units that keep where the motor was at an edge (CiA 402, 0x60B8 to
//! 0x60BD).

/// Units of a drive.
const UNITS: usize = 2;
/// Bits of a unit in 0x60B8: on, every edge instead of the first, source, rising and falling edges.
const ON: u16 = 1;
const CONTINUOUS: u16 = 2;
const SOURCE: u16 = 0x0c;
const BY_OBJECT: u16 = 8;
const BY_ZERO: u16 = 4;
const RISING: u16 = 0x10;
/// Bits of a unit in 0x60B9: on; a place is stored, of a rising edge, and of a falling one behind it.
const IS_ON: u16 = 1;
const STORED: u16 = 2;
/// The source of a unit by 0x60D0 that is its own input.
const OWN_INPUT: u32 = 1;

/// What a drive has of a touch probe, as it is delivered.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TouchProbe {
    /// Whether its objects can be mapped into process data.
    pub is_mappable: bool,
    /// Whether it has 0x60D0, by which a source is chosen.
    pub has_sources: bool,
    /// What is wrong in what it captures, counts; 0 for nothing.
    pub off_counts: i32,
    /// The zero impulse of its encoder, if that has one.
    pub zero: Option<ZeroImpulse>,
    /// It does not take the zero impulse as a source.
    pub refuses_zero: bool,
}

impl TouchProbe {
    /// Whether it refuses what 0x60B8 is to be.
    pub(crate) fn refuses(self, function: u32) -> bool {
        let is_by_zero = |unit: usize| {
            let word = function >> (8 * unit);
            word & u32::from(ON) != 0 && word & u32::from(SOURCE) == u32::from(BY_ZERO)
        };
        self.refuses_zero && (0..UNITS).any(is_by_zero)
    }
}

/// The zero impulse of an encoder: once a turn, and so wide that where it rises depends on the direction.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ZeroImpulse {
    /// Counts of a turn, > 0.
    pub turn_counts: i64,
    /// Where its lower side is, counts.
    pub at_counts: i64,
    /// How wide it is, counts, less than a turn.
    pub wide_counts: i64,
}

impl ZeroImpulse {
    /// Where it first rises on a way of the motor, counts.
    #[allow(clippy::cast_precision_loss, reason = "places are far below 2⁵³")]
    pub(crate) fn rises(self, from: f64, to: f64) -> Option<f64> {
        let turn = self.turn_counts as f64;
        let (lower, upper) = (
            self.at_counts as f64,
            (self.at_counts + self.wide_counts) as f64,
        );
        let place = if to > from {
            lower + turn * (((from - lower) / turn).floor() + 1.0)
        } else {
            upper + turn * (((from - upper) / turn).ceil() - 1.0)
        };
        let (low, high) = (from.min(to), from.max(to));
        (high > low && (low..=high).contains(&place)).then_some(place)
    }
}

impl Default for TouchProbe {
    /// One that can be mapped, and is right.
    fn default() -> Self {
        Self {
            is_mappable: true,
            has_sources: false,
            off_counts: 0,
            zero: None,
            refuses_zero: false,
        }
    }
}

/// The units at work.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct ProbeUnits {
    /// What the master asked for in the step before: a drive takes one to obey.
    asked: u16,
    function: u16,
    /// They are off, whatever is asked for.
    pub(crate) are_off: bool,
    /// Since when each is on, ns.
    since_ns: [u64; UNITS],
    pub(crate) status: u16,
    /// 0x60BA to 0x60BD: of each unit, at a rising and at a falling edge.
    pub(crate) places: [[i32; 2]; UNITS],
}

impl ProbeUnits {
    /// A step that ends at a time: what was asked for in the step before counts from there on.
    pub(crate) fn step(&mut self, asked: u16, at_ns: u64) {
        let asked = if self.are_off { 0 } else { asked };
        let function = core::mem::replace(&mut self.asked, asked);
        for (unit, since_ns) in self.since_ns.iter_mut().enumerate() {
            let shift = 8 * unit;
            let (word, before) = (function >> shift, self.function >> shift);
            if word & ON == 0 {
                self.status &= !(0xff << shift);
            } else if before & ON == 0 {
                *since_ns = at_ns;
                self.status = (self.status & !(0xff << shift)) | IS_ON << shift;
            }
        }
        self.function = function;
    }

    /// An edge at its input: where the motor was then.
    pub(crate) fn capture(&mut self, rises: bool, at_ns: u64, place: i32, sources: [u32; UNITS]) {
        self.keep(rises, at_ns, place, &|unit, source| match source {
            0 => true,
            BY_OBJECT => sources[unit] == OWN_INPUT,
            _ => false,
        });
    }

    /// The zero impulse of the encoder rises at a place.
    pub(crate) fn pass_zero(&mut self, at_ns: u64, place: i32) {
        self.keep(true, at_ns, place, &|_, source| source == BY_ZERO);
    }

    fn keep(&mut self, rises: bool, at_ns: u64, place: i32, wired: &dyn Fn(usize, u16) -> bool) {
        let edge = u16::from(!rises);
        for unit in 0..UNITS {
            let shift = 8 * unit;
            let (word, stored) = (self.function >> shift, STORED << edge << shift);
            let is_wired = wired(unit, word & SOURCE);
            let is_on = word & ON != 0 && word & (RISING << edge) != 0;
            let is_late = self.status & stored != 0 && word & CONTINUOUS == 0;
            if is_on && is_wired && !is_late && at_ns >= self.since_ns[unit] {
                self.status |= stored;
                self.places[unit][usize::from(edge)] = place;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_unit_keeps_the_first_edge_after_it_is_on() {
        let mut units = ProbeUnits::default();
        let sources = [0; 2];
        let mut places = Vec::new();
        for (function, at_ns) in [
            (0x31, 10),
            (0x31, 20),
            (0x31, 30),
            (0, 40),
            (0x1100, 50),
            (0, 60),
        ] {
            units.step(function, at_ns);
            // One that was before the unit was on does not count.
            units.capture(true, at_ns - 1, 7, sources);
            units.capture(true, at_ns, i32::from(units.function), sources);
            units.capture(false, at_ns + 1, 9, sources);
            places.push((units.status, units.places));
        }
        let first = [[0x31, 9], [0, 0]];
        assert_eq!(places[0], (0, [[0; 2]; 2]));
        assert_eq!(places[1], (7, first));
        assert_eq!(places[2], (7, first));
        assert_eq!(places[3], (7, first));
        assert_eq!(places[4].0, 0);
        assert_eq!(places[5], (0x300, [first[0], [0x1100, 0]]));
    }

    #[test]
    fn a_zero_impulse_rises_once_a_turn_at_the_side_that_is_met() {
        let zero = ZeroImpulse {
            turn_counts: 100,
            at_counts: 10,
            wide_counts: 4,
        };
        for (from, to, place) in [
            (0.0, 50.0, Some(10.0)),
            (10.0, 50.0, None),
            (50.0, 0.0, Some(14.0)),
            (-50.0, -100.0, Some(-86.0)),
            (13.0, 0.0, None),
            (95.0, 250.0, Some(110.0)),
            (12.0, 12.0, None),
        ] {
            assert_eq!(zero.rises(from, to), place, "{from} {to}");
        }
        let mut units = ProbeUnits::default();
        for at_ns in 0..3 {
            units.step(0x1511, at_ns);
        }
        units.pass_zero(5, 7);
        // The first unit has its input, the second one the zero impulse.
        assert_eq!((units.status, units.places[1][0]), (0x301, 7));
    }

    #[test]
    fn a_source_by_object_is_the_one_that_is_chosen() {
        let mut units = ProbeUnits::default();
        for at_ns in 0..2 {
            units.step(0x1919, at_ns);
        }
        units.capture(true, 5, 3, [OWN_INPUT, 5]);
        assert_eq!((units.status, units.places), (0x103, [[3, 0], [0, 0]]));
    }
}
