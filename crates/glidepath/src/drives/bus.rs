//! The judgement of `[bus]`.

use super::raw::RawBus;
use crate::config::Judge;
use glidepath_ethercat::BusSettings;
use toml::Spanned;

pub(super) fn bus(judge: &mut Judge, raw: &RawBus) -> BusSettings {
    let default = BusSettings::default();
    let mut whole = |key, value: &Option<Spanned<i64>>, range, help, unit_ns: u64, default| {
        let value = value
            .as_ref()
            .map(|value| judge.whole(key, value, range, help));
        value
            .flatten()
            .map_or(default, |value: u64| value * unit_ns)
    };
    let help = "1000, 2000 or 4000 is what most drives like";
    let period_ns = whole(
        "bus.period_us",
        &raw.period_us,
        (250, 20_000),
        help,
        1000,
        default.period_ns,
    );
    let most = i64::try_from(period_ns / 1000).unwrap_or(i64::MAX) * 9 / 10;
    let help =
        "half of the period; more for a host that wakes late, less for a drive that computes long";
    let shift_ns = whole(
        "bus.shift_us",
        &raw.shift_us,
        (50, most),
        help,
        1000,
        period_ns / 2,
    );
    let least = i64::try_from(shift_ns / 1000).unwrap_or(0);
    let help = "more than the shift, by what setpoints may be late: 2000 µs on a quiet host";
    let delay_ns = whole(
        "bus.delay_us",
        &raw.delay_us,
        (least, 100_000),
        help,
        1000,
        shift_ns + 2_000_000,
    );
    let help = "frames in a row after which every drive stops by itself";
    let lost = whole(
        "bus.lost_frames",
        &raw.lost_frames,
        (1, 100),
        help,
        1,
        default.lost_frames.into(),
    );
    // A drive is not to stop by itself before the bus counts as lost.
    let least_ns = (lost + 1) * period_ns;
    let least = i64::try_from(least_ns.div_ceil(1_000_000)).unwrap_or(i64::MAX);
    let help = "longer than lost_frames periods: then a drive that hears nothing stops by itself";
    let watchdog_ns = whole(
        "bus.watchdog_ms",
        &raw.watchdog_ms,
        (least, 1000),
        help,
        1_000_000,
        default.watchdog_ns.max(least_ns),
    );
    BusSettings {
        period_ns,
        shift_ns,
        delay_ns,
        lost_frames: u32::try_from(lost).unwrap_or(u32::MAX),
        watchdog_ns,
    }
}
