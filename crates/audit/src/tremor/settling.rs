//! The settling time: how long a motion may take to become calm.

/// Settling time, s: as long as a tremor is not told before and behind what gives cause to move.
pub const SETTLING_T: f64 = 0.1;
/// The settling time in periods, where those are long.
pub const SETTLING_PERIODS: u32 = 25;

/// The settling time, with some time in addition, in whole periods.
pub(super) fn settling_ticks(period_t: f64, more_t: f64) -> u64 {
    let periods = ((SETTLING_T + more_t) / period_t).ceil();
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a cast saturates, and then nothing is judged"
    )]
    let periods = periods.max(0.0) as u64;
    periods.max(SETTLING_PERIODS.into())
}
