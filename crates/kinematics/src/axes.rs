//! Ordered sets of axes.

use glidepath_geometry::{AXES, Axis};

/// Axes in the order X Y Z A B C U V W, each at most once.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct AxisList {
    has: [bool; AXES],
}

impl AxisList {
    /// Those axes, in the order of [`Axis::ALL`].
    #[must_use]
    pub fn new(axes: &[Axis]) -> Self {
        let mut has = [false; AXES];
        for axis in axes {
            has[axis.index()] = true;
        }
        Self { has }
    }

    /// The axes that are not among `others`.
    #[must_use]
    pub fn without(self, others: &[Axis]) -> Self {
        let others = Self::new(others);
        Self {
            has: core::array::from_fn(|i| self.has[i] && !others.has[i]),
        }
    }

    /// The axes in order.
    pub fn iter(&self) -> impl Iterator<Item = Axis> + '_ {
        Axis::ALL.into_iter().filter(|axis| self.has[axis.index()])
    }

    /// Whether the axis of that index is among them.
    pub(crate) const fn has(&self, index: usize) -> bool {
        self.has[index]
    }

    /// The number of axes.
    #[must_use]
    pub fn len(&self) -> usize {
        self.iter().count()
    }

    /// Whether there is none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}
