//! Letters of words, and sets of them.

use glidepath_geometry::{AXES, Axis};

/// Letters of the axes in index order, as [`Slot`]s.
pub(crate) const AXIS_LETTERS: [u8; AXES] = *b"XYZABCUVW";

/// Where the values of the letters from A stand: those of the axes first, in index order.
const SLOTS: [usize; 26] = {
    let mut slots = [0; 26];
    let (mut letter, mut others) = (0, AXES);
    while letter < 26 {
        let mut axis = 0;
        while axis < AXES && AXIS_LETTERS[axis] as usize != b'A' as usize + letter {
            axis += 1;
        }
        slots[letter] = if axis < AXES { axis } else { others };
        others += (axis == AXES) as usize;
        letter += 1;
    }
    slots
};

/// Where what belongs to a letter stands, below 26.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Slot(u8);

impl Slot {
    /// The slot of a letter, in either case.
    #[expect(clippy::cast_possible_truncation, reason = "slots are below 26")]
    pub(crate) const fn of(letter: u8) -> Self {
        Self(SLOTS[(letter.to_ascii_uppercase().wrapping_sub(b'A') % 26) as usize] as u8)
    }

    pub(crate) const fn index(self) -> usize {
        self.0 as usize
    }

    /// The letter in a set.
    const fn bit(self) -> u32 {
        1 << (self.0 & 31)
    }
}

/// A set of word letters, by their slots.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) struct Letters(pub(crate) u32);

impl Letters {
    pub(crate) const fn of(letters: &[u8]) -> Self {
        let mut bits = 0;
        let mut i = 0;
        while i < letters.len() {
            bits |= Slot::of(letters[i]).bit();
            i += 1;
        }
        Self(bits)
    }

    /// The set of one letter.
    pub(crate) const fn one(letter: u8) -> Self {
        Self(Slot::of(letter).bit())
    }

    /// The words of some axes.
    pub(crate) fn of_axes(wanted: impl Fn(Axis) -> bool) -> Self {
        let axes = Axis::ALL.into_iter().filter(|&axis| wanted(axis));
        Self(axes.fold(0, |bits, axis| {
            bits | Slot::of(AXIS_LETTERS[axis.index()]).bit()
        }))
    }

    pub(crate) const fn has(self, letter: u8) -> bool {
        self.holds(Slot::of(letter))
    }

    pub(crate) const fn holds(self, slot: Slot) -> bool {
        self.0 & slot.bit() != 0
    }

    pub(crate) const fn is_empty(self) -> bool {
        self.0 == 0
    }

    pub(crate) const fn and(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }
}

/// All axis words.
pub(crate) const AXIS_WORDS: Letters = Letters::of(&AXIS_LETTERS);

/// Words with a value: the letters, and what stands behind them. G, M, N and O are not among them.
#[derive(Debug, Clone, Default)]
pub(crate) struct WordValues {
    /// One bit per letter that has a value.
    present: u32,
    /// The values by slot; what is left from another line where a letter has none.
    values: [f64; 26],
}

impl WordValues {
    /// Value of a word.
    pub(crate) const fn get(&self, letter: u8) -> Option<f64> {
        let slot = Slot::of(letter);
        if self.present & slot.bit() == 0 {
            None
        } else {
            Some(self.values[slot.index()])
        }
    }

    /// True if there is any of these words.
    pub(crate) const fn has_any(&self, letters: Letters) -> bool {
        self.present & letters.0 != 0
    }

    /// True if a value of one of these letters is above `most`, or below it with a sign.
    pub(crate) fn exceeds(&self, letters: Letters, most: f64) -> bool {
        let mut left = self.present & letters.0;
        while left != 0 {
            let slot = left.trailing_zeros() as usize;
            if self.values[slot].abs() > most {
                return true;
            }
            left &= left - 1;
        }
        false
    }

    /// The letters that are not among `used`.
    pub(crate) const fn beside(&self, used: Letters) -> Letters {
        Letters(self.present & !used.0)
    }

    /// The axis words, in index order.
    #[inline]
    pub(crate) fn axes(&self) -> impl Iterator<Item = (Axis, f64)> + '_ {
        // The slots of the axes are their indices.
        let mut left = self.present & AXIS_WORDS.0;
        core::iter::from_fn(move || {
            let axis = *Axis::ALL.get(left.trailing_zeros() as usize)?;
            left &= left - 1;
            Some((axis, self.values[axis.index()]))
        })
    }

    #[inline]
    pub(crate) const fn clear(&mut self) {
        self.present = 0;
    }

    /// Takes a word out.
    pub(super) const fn take(&mut self, letter: u8) -> Option<f64> {
        let value = self.get(letter);
        self.present &= !Slot::of(letter).bit();
        value
    }

    /// Adds a word; `None` if there is one of that letter.
    #[inline]
    pub(crate) const fn add(&mut self, slot: Slot, value: f64) -> Option<()> {
        if self.present & slot.bit() != 0 {
            return None;
        }
        self.present |= slot.bit();
        self.values[slot.index()] = value;
        Some(())
    }
}
