//! A part of a chord.

/// Part of a chord, as parameters 0…1; empty if `from` > `to`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ParameterRange {
    pub(crate) from: f64,
    pub(crate) to: f64,
}

impl ParameterRange {
    pub(crate) const EMPTY: Self = Self { from: 1.0, to: 0.0 };
    pub(crate) const WHOLE: Self = Self { from: 0.0, to: 1.0 };

    pub(crate) fn is_empty(self) -> bool {
        // Not a number is nowhere.
        !matches!(
            self.from.partial_cmp(&self.to),
            Some(core::cmp::Ordering::Less | core::cmp::Ordering::Equal)
        )
    }

    pub(crate) fn not_before(self, from: f64) -> Self {
        Self {
            from: self.from.max(from),
            to: self.to,
        }
    }

    pub(crate) fn cut(self, other: Self) -> Self {
        Self {
            from: self.from.max(other.from),
            to: self.to.min(other.to),
        }
    }
}
