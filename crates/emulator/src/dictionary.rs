//! The object dictionary of a drive, as CoE tells it.

use crate::channels::Channels;
use crate::eeprom::Identity;
use std::collections::BTreeMap;

/// Index and subindex.
pub(crate) type Object = (u16, u8);

pub(crate) const OUTPUTS_ASSIGNED: u16 = 0x1c12;
pub(crate) const INPUTS_ASSIGNED: u16 = 0x1c13;
pub(crate) const FOLLOWING_WINDOW: Object = (0x6065, 0);
pub(crate) const FOLLOWING_TIMEOUT: Object = (0x6066, 0);
pub(crate) const HOME_OFFSET: Object = (0x607c, 0);
pub(crate) const QUICK_STOP: Object = (0x6085, 0);
pub(crate) const HOMING_METHOD: Object = (0x6098, 0);
pub(crate) const HOMING_SPEED: Object = (0x6099, 1);
pub(crate) const MODE: Object = (0x6060, 0);
/// The limit of torque, thousandths of the rated one.
pub(crate) const MOST_TORQUE: Object = (0x6072, 0);
/// The limits of torque forwards and backwards, the same.
pub(crate) const TORQUE_LIMITS: [Object; 2] = [(0x60e0, 0), (0x60e1, 0)];
pub(crate) const PROBE_FUNCTION: Object = (0x60b8, 0);
pub(crate) const PROBE_SOURCE: u16 = 0x60d0;
pub(crate) const DIGITAL_INPUTS: Object = (0x60fd, 0);
pub(crate) const HISTORY: u16 = 0x10f3;
/// Messages that it keeps at most.
pub(crate) const MESSAGES: u32 = 4;
/// Which of its messages is the newest.
pub(crate) const NEWEST: Object = (HISTORY, 2);
pub(crate) const SYNC_OUTPUTS: Object = (0x1c32, 1);
pub(crate) const SYNC_INPUTS: Object = (0x1c33, 1);

/// How far the objects of an axis are from those of the one before, and its maps.
pub(crate) const OBJECT_STEP: u16 = 0x800;
const MAP_STEP: u16 = 0x10;

/// The objects of one axis of a device.
#[derive(Debug, Clone, Copy)]
pub(crate) struct AxisObjects<'d> {
    pub(crate) all: &'d Dictionary,
    pub(crate) axis: u16,
}

impl AxisObjects<'_> {
    pub(crate) fn value(self, (index, sub): Object) -> u32 {
        self.all.value((index + OBJECT_STEP * self.axis, sub))
    }
}

/// The axis that an object of CiA 402 belongs to, and its index at the first one.
pub(crate) const fn own(index: u16) -> (u16, u16) {
    match index {
        0x6000..0xa000 => ((index - 0x6000) / OBJECT_STEP, 0x6000 | (index & 0x7ff)),
        _ => (0, index),
    }
}

/// An object in the process data: which, where it begins, how many bytes.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Mapped {
    pub(crate) index: u16,
    pub(crate) sub: u8,
    pub(crate) offset: u16,
    pub(crate) length: u16,
}

/// Objects with their size in bytes and value.
#[derive(Debug, Clone)]
pub(crate) struct Dictionary(BTreeMap<Object, (u8, u32)>);

impl Dictionary {
    /// The objects of a drive as it is delivered.
    pub(crate) fn new(
        identity: Identity,
        axes: u16,
        following_counts: u32,
        quick_stop: u32,
    ) -> Self {
        let mut all = Self::of_one(identity, following_counts, quick_stop);
        let own: Vec<_> = all
            .0
            .iter()
            .filter(
                |((index, _), _)| matches!(index, 0x1600..0x1700 | 0x1a00..0x1b00 | 0x6000..0x6800),
            )
            .map(|(object, value)| (*object, *value))
            .collect();
        for axis in 1..axes {
            for ((index, sub), (size, value)) in &own {
                let step = if *index < 0x6000 {
                    MAP_STEP
                } else {
                    OBJECT_STEP
                };
                // What is mapped as delivered is of the same axis.
                let is_entry = *index < 0x6000 && *sub > 0 && *value != 0;
                let more = if is_entry {
                    u32::from(OBJECT_STEP * axis) << 16
                } else {
                    0
                };
                let object = (index + step * axis, *sub);
                all.0.insert(object, (*size, value + more));
            }
        }
        // Room for the maps of all.
        for assignment in [OUTPUTS_ASSIGNED, INPUTS_ASSIGNED] {
            for sub in 3..=u8::try_from(4 * axes).unwrap_or(u8::MAX) {
                all.0.insert((assignment, sub), (2, 0));
            }
        }
        all
    }

    /// The objects of a device with one drive.
    fn of_one(identity: Identity, following_counts: u32, quick_stop: u32) -> Self {
        let mut objects = BTreeMap::new();
        let mut set = |index, sub, size, value| {
            objects.insert((index, sub), (size, value));
        };
        set(0x1000, 0, 4, 0x0002_0192);
        set(0x1018, 0, 1, 4);
        for (sub, value) in (1..).zip(identity) {
            set(0x1018, sub, 4, value);
        }
        set(0x1c00, 0, 1, 4);
        for sub in 1..=4 {
            set(0x1c00, sub, 1, sub.into());
        }
        for (assigned, map) in [(0x1c12, 0x1600), (0x1c13, 0x1a00)] {
            set(assigned, 0, 1, 1);
            set(assigned, 1, 2, map);
        }
        // What it maps before anybody asks: less than a master needs.
        set(0x1600, 0, 1, 2);
        set(0x1600, 1, 4, 0x6040_0010);
        set(0x1600, 2, 4, 0x607a_0020);
        set(0x1a00, 0, 1, 2);
        set(0x1a00, 1, 4, 0x6041_0010);
        set(0x1a00, 2, 4, 0x6064_0020);
        for map in [0x1600, 0x1a00] {
            for sub in 3..=8 {
                set(map, sub, 4, 0);
            }
            for more in 1..=3 {
                for sub in 0..=8 {
                    let size = if sub == 0 { 1 } else { 4 };
                    set(map + more, sub, size, 0);
                }
            }
        }
        set(0x1c12, 2, 2, 0);
        set(0x1c13, 2, 2, 0);
        for sync in [0x1c32, 0x1c33] {
            set(sync, 0, 1, 32);
            set(sync, 1, 2, 0);
            set(sync, 2, 4, 0);
            set(sync, 4, 2, 0x1c07);
            set(sync, 5, 4, 125_000);
            set(sync, 6, 4, 30_000);
        }
        set(0x6060, 0, 1, 0);
        set(0x6072, 0, 2, 1000);
        set(0x60e0, 0, 2, 1000);
        set(0x60e1, 0, 2, 1000);
        set(0x605a, 0, 2, 2);
        set(0x605e, 0, 2, 2);
        set(0x6065, 0, 4, following_counts);
        set(0x6066, 0, 2, 10);
        set(0x607c, 0, 4, 0);
        set(0x6085, 0, 4, quick_stop);
        for ratio in [0x608f, 0x6091, 0x6092] {
            set(ratio, 0, 1, 2);
            set(ratio, 1, 4, 1);
            set(ratio, 2, 4, 1);
        }
        set(0x6098, 0, 1, 0);
        set(0x6099, 0, 1, 2);
        set(0x6099, 1, 4, 0);
        set(0x6099, 2, 4, 0);
        set(0x609a, 0, 4, 0);
        set(0x60c2, 0, 1, 2);
        set(0x60c2, 1, 1, 1);
        set(0x60c2, 2, 1, 0xfd);
        set(0x60fd, 0, 4, 0);
        // Cyclic position and velocity, homing, profile velocity, velocity.
        set(0x6502, 0, 4, 1 << 8 | 1 << 7 | 1 << 5 | 1 << 2 | 1 << 1);
        Self(objects)
    }

    /// The objects of a device that is no drive: who it is, its maps, and which of them are assigned.
    pub(crate) fn of_channels(identity: Identity, channels: &Channels) -> Self {
        let mut objects = BTreeMap::new();
        let mut set = |index, sub, size, value| {
            objects.insert((index, sub), (size, value));
        };
        set(0x1000, 0, 4, 0x0140_1389);
        set(0x1018, 0, 1, 4);
        for (sub, value) in (1..).zip(identity) {
            set(0x1018, sub, 4, value);
        }
        let ways = [
            (0x1600_u16, 0x1c12, &channels.outputs, None),
            (0x1a00, 0x1c13, &channels.inputs, channels.assigned.as_ref()),
        ];
        for (first, assignment, maps, assigned) in ways {
            for (map, entries) in (first..).zip(maps) {
                set(map, 0, 1, u32::try_from(entries.len()).unwrap_or(0));
                for (sub, entry) in (1..).zip(entries) {
                    set(map, sub, 4, *entry);
                }
            }
            let all: Vec<u16> = (first..).zip(maps).map(|(map, _)| map).collect();
            let assigned = assigned.unwrap_or(&all);
            set(assignment, 0, 1, u32::try_from(assigned.len()).unwrap_or(0));
            for (sub, nth) in (1..).zip(0..all.len()) {
                let map = assigned.get(nth).copied().unwrap_or(0);
                set(assignment, sub, 2, map.into());
            }
        }
        // A setting, as terminals have them from here on.
        set(0x8000, 1, 2, 0);
        Self(objects)
    }

    /// The objects of touch probes; 0x60D0 with the sources of both units, if they are to be chosen.
    pub(crate) fn add_touch_probes(&mut self, axes: u16, has_sources: bool) {
        for first in (0..axes).map(|axis| OBJECT_STEP * axis) {
            let mut add = |index: u16, sub, size, value| {
                self.0.insert((index + first, sub), (size, value));
            };
            add(0x60b8, 0, 2, 0);
            add(0x60b9, 0, 2, 0);
            for index in 0x60ba..=0x60bd {
                add(index, 0, 4, 0);
            }
            if has_sources {
                add(PROBE_SOURCE, 0, 1, 2);
                add(PROBE_SOURCE, 1, 2, 5);
                add(PROBE_SOURCE, 2, 2, 5);
            }
        }
    }

    /// The objects of what is told beside a target.
    pub(crate) fn add_offsets(&mut self, axes: u16) {
        for first in (0..axes).map(|axis| OBJECT_STEP * axis) {
            self.0.insert((0x60b1 + first, 0), (4, 0));
            self.0.insert((0x60b2 + first, 0), (2, 0));
        }
    }

    /// The diagnosis history: how many messages there are at most, and which is the newest.
    pub(crate) fn add_history(&mut self) {
        for (sub, size, value) in [
            (0, 1, 5 + MESSAGES),
            (1, 1, MESSAGES),
            (2, 1, 0),
            (3, 1, 0),
            (4, 1, 0),
            (5, 2, 0),
        ] {
            self.0.insert((HISTORY, sub), (size, value));
        }
    }

    /// The lowest and the highest number of the counter.
    #[allow(clippy::cast_sign_loss, reason = "the bits of a number with a sign")]
    pub(crate) fn add_range(&mut self, axes: u16, (lowest, highest): (i32, i32)) {
        for first in (0..axes).map(|axis| OBJECT_STEP * axis) {
            self.0.insert((0x607b + first, 0), (1, 2));
            self.0.insert((0x607b + first, 1), (4, lowest as u32));
            self.0.insert((0x607b + first, 2), (4, highest as u32));
        }
    }

    /// Takes objects away.
    pub(crate) fn remove(&mut self, lacks: &[u16]) {
        self.0.retain(|(index, _), _| !lacks.contains(index));
    }

    /// Maps that stay: where the master looks for others, there are none.
    pub(crate) fn fix_maps(&mut self, outputs: &[u32], inputs: &[u32]) {
        self.0
            .retain(|(index, _), _| !matches!(index, 0x1600..=0x1bff));
        for (assigned, map, entries) in [(0x1c12, 0x1701, outputs), (0x1c13, 0x1b01, inputs)] {
            self.set((assigned, 1), map.into());
            let count = u32::try_from(entries.len()).unwrap_or(0);
            self.0.insert((map, 0), (1, count));
            for (sub, entry) in (1..).zip(entries) {
                self.0.insert((map, sub), (4, *entry));
            }
        }
    }

    /// Whether a map is still 8 bytes at most if this entry of it becomes another.
    pub(crate) fn is_short(&self, (map, nth): Object, entry: u32) -> bool {
        let before = (1..nth).map(|sub| self.value((map, sub)));
        let bits: u32 = before.chain([entry]).map(|entry| entry & 0xff).sum();
        bits <= 64
    }

    pub(crate) fn get(&self, object: Object) -> Option<(u8, u32)> {
        self.0.get(&object).copied()
    }

    pub(crate) fn value(&self, object: Object) -> u32 {
        self.get(object).map_or(0, |(_, value)| value)
    }

    pub(crate) fn has_index(&self, index: u16) -> bool {
        self.0.range((index, 0)..=(index, u8::MAX)).next().is_some()
    }

    /// Puts another value in the place of one that there is.
    pub(crate) fn set(&mut self, object: Object, value: u32) {
        if let Some((_, place)) = self.0.get_mut(&object) {
            *place = value;
        }
    }

    /// What an assignment maps, in order, and how many bytes that is.
    #[allow(clippy::cast_possible_truncation, reason = "parts of a mapping entry")]
    pub(crate) fn mapped(&self, assigned: u16) -> (Vec<Mapped>, u16) {
        let (mut mapped, mut bits) = (Vec::new(), 0_u16);
        for nth in 1..=self.value((assigned, 0)) as u8 {
            let map = self.value((assigned, nth)) as u16;
            for sub in 1..=self.value((map, 0)) as u8 {
                let entry = self.value((map, sub));
                mapped.push(Mapped {
                    index: (entry >> 16) as u16,
                    sub: (entry >> 8) as u8,
                    offset: bits / 8,
                    length: (entry & 0xff) as u16 / 8,
                });
                bits += (entry & 0xff) as u16;
            }
        }
        (mapped, bits.div_ceil(8))
    }
}
