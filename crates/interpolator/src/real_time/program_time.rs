//! Program time: how far along the planned trajectory the motion is.

/// Program time in periods: a frame and the part of a period past it.
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd, Default)]
pub(crate) struct ProgramTime {
    /// The frame at or before it.
    pub(crate) sequence: u64,
    /// 0 ≤ fraction < 1.
    pub(crate) fraction: f64,
}

impl ProgramTime {
    /// Exactly at a frame.
    pub(crate) const fn at(sequence: u64) -> Self {
        Self {
            sequence,
            fraction: 0.0,
        }
    }

    /// `periods` ≥ 0 later. Exact if `periods` is whole.
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        clippy::cast_precision_loss,
        reason = "the sum is not negative, and saturates far beyond any program"
    )]
    pub(crate) fn after(self, periods: f64) -> Self {
        let sum = self.fraction + periods;
        // Not `floor`, which is a call where the processor is not known to have an instruction for
        // it.
        let whole = sum as i64;
        Self {
            sequence: self.sequence + whole as u64,
            fraction: sum - whole as f64,
        }
    }

    /// The same, where rounding has made a whole period of the fraction.
    pub(crate) fn normal(self) -> Self {
        if self.fraction >= 1.0 {
            Self::at(self.sequence + 1)
        } else {
            self
        }
    }

    /// This time, but not past a frame that holds the motion, if one does.
    pub(crate) fn held_at(self, frame: Option<u64>) -> Self {
        match frame {
            Some(frame) if self.sequence >= frame => Self::at(frame),
            _ => self,
        }
    }

    /// The nearest frame, if it is within rounding of it; else itself.
    pub(crate) fn snapped(self) -> Self {
        const ROUNDING: f64 = 1e-9;
        if self.fraction < ROUNDING {
            Self::at(self.sequence)
        } else if self.fraction > 1.0 - ROUNDING {
            Self::at(self.sequence + 1)
        } else {
            self
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whole_steps_keep_the_fraction() {
        let time = ProgramTime {
            sequence: 7,
            fraction: 0.3,
        };
        let later = (0..1_000).fold(time, |t, _| t.after(1.0));
        assert_eq!(later.sequence, 1_007);
        assert!((later.fraction - 0.3).abs() < 1e-12);
        assert_eq!(ProgramTime::at(3).after(4.0), ProgramTime::at(7));
    }

    #[test]
    fn rounding_is_removed_at_a_frame_only() {
        assert_eq!(
            ProgramTime {
                sequence: 1,
                fraction: 1.0 - 1e-12
            }
            .snapped(),
            ProgramTime::at(2)
        );
        assert_eq!(
            ProgramTime {
                sequence: 1,
                fraction: 1e-12
            }
            .snapped(),
            ProgramTime::at(1)
        );
        let between = ProgramTime {
            sequence: 1,
            fraction: 0.5,
        };
        assert_eq!(between.snapped(), between);
    }
}
