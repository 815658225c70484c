//! The grants: what the host lets the interpolator have.

/// The real-time grants that the interpolator holds, one bit each.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Grants(pub u32);

impl Grants {
    /// Scheduled by `SCHED_FIFO`.
    pub const FIFO: Self = Self(1);
    /// Pinned to its CPU.
    pub const PINNED: Self = Self(1 << 1);
    /// Memory locked.
    pub const MEMORY_LOCKED: Self = Self(1 << 2);
    /// Stack and rings touched beforehand.
    pub const PREFAULTED: Self = Self(1 << 3);
    /// `/dev/cpu_dma_latency` held.
    pub const DMA_LATENCY: Self = Self(1 << 4);
    /// Started with leave to go on without some of the above.
    pub const BEST_EFFORT: Self = Self(1 << 5);

    /// These and others.
    #[must_use]
    pub const fn with(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    /// True if all of `other` are held.
    #[must_use]
    pub const fn contains(self, other: Self) -> bool {
        self.0 & other.0 == other.0
    }

    pub(super) const KNOWN: u32 = (1 << 6) - 1;
}
