//! The counts of a consumer of setpoints: what arrived, what is missing, and what came late.

use crate::Setpoint;

/// Counts over all lives of the interpolator that were seen.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct ServoCounts {
    /// Setpoints that arrived and were new.
    pub received: u64,
    /// Setpoints that were published but did not arrive: gaps in the number.
    pub lost: u64,
    /// Gaps, of any length.
    pub gaps: u64,
    /// Setpoints that arrived again, or after a later one.
    pub duplicates: u64,
    /// Setpoints that arrived after the time at which they were to be applied.
    pub late: u64,
    /// Demands in motion for a time to which no setpoint led any more: the joints went on as they
    /// were.
    pub coasts: u64,
    /// Records that failed their check.
    pub refused: u64,
    /// Ticks the interpolator missed while this listened.
    pub missed_ticks: u64,
    /// Times the interpolator was started anew.
    pub restarts: u64,
    /// Times the position was taken anew from the drives, or given another meaning, while this
    /// listened.
    pub references: u64,
    /// Own stops, whatever they were for.
    pub stops: u64,
    /// Setpoints, among those received, that were not played because they jumped.
    pub jumps: u64,
}

/// What a setpoint is, seen after the one before it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Sequel {
    /// The next, or a later one.
    New,
    /// The first of a new reference: it does not continue the one before.
    Reference,
    /// The first of a new life of the interpolator, or the first at all.
    Restart,
    /// One that was there already, or before one that was.
    Duplicate,
}

impl ServoCounts {
    /// Counts a setpoint that passed its check.
    pub(super) fn count(
        &mut self,
        before: Option<&Setpoint>,
        setpoint: &Setpoint,
        now_ns: u64,
    ) -> Sequel {
        let sequel = match before {
            Some(before) if before.boot_id == setpoint.boot_id => {
                let Some(lost) = setpoint.number.checked_sub(before.number + 1) else {
                    self.duplicates += 1;
                    return Sequel::Duplicate;
                };
                self.lost += lost;
                self.gaps += u64::from(lost > 0);
                // Counted by the interpolator, so that a lost setpoint is not taken for a missed
                // tick.
                self.missed_ticks += setpoint.missed_ticks.saturating_sub(before.missed_ticks);
                if setpoint.reference == before.reference {
                    Sequel::New
                } else {
                    self.references += 1;
                    Sequel::Reference
                }
            }
            Some(_) => {
                self.restarts += 1;
                Sequel::Restart
            }
            None => Sequel::Restart,
        };
        self.received += 1;
        self.late += u64::from(now_ns > setpoint.apply_ns);
        sequel
    }
}
