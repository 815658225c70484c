//! The judge of what drives recorded: whether what they were told keeps the limits, wherever the
//! host let anybody tell them.
//!
//! A tick that the host left out, a setpoint that did not arrive and a target in motion for which
//! there was no setpoint are no fault of what was computed, and across them the limits are not kept.
//! The record says at which SYNC0 each of them was known, so those around it are left out and all
//! others are judged.

use std::ops::Range;

use glidepath_audit::{Audit, AuditSettings, Sample};
use glidepath_geometry::AxisVector;
use glidepath_tests::settings;

pub(super) const JOINTS: usize = 3;
/// Counts a mm of the emulated drives.
pub(super) const COUNTS: f64 = 8_388_608.0 / 5.0;
/// How far a SYNC0 may be from where it was expected, ns; a lost frame is a period.
const IN_TIME_NS: u64 = 100_000;
/// What is left out before it is known that a setpoint is missing: its period, those after it, and
/// these 20 ms.
const BEFORE_NS: u64 = 20_000_000;
const SETPOINT_NS: u64 = 4_000_000;
/// What is left out after that. The next setpoint applies a period later and is played 12.5 ms after
/// that (for a desk), and a servo that coasted is back on the way one and a half periods later: after
/// 25 ms it plays again what it is sent. This is four times that.
const AFTER_NS: u64 = 100_000_000;
/// The part of all SYNC0 of which it takes a verdict to be one.
const ENOUGH: f64 = 0.9;
/// The speed of the program, mm/s.
const FASTEST_V: f64 = 150.0;

/// A drive at a SYNC0.
#[derive(Debug, Clone, Copy)]
pub(super) struct Row {
    pub(super) sync_ns: u64,
    pub(super) meant_ns: u64,
    pub(super) target: f64,
    pub(super) actual: f64,
    pub(super) follows: bool,
    /// Ticks missed and setpoints lost, as far as the bridge knew.
    missing: u64,
    /// Targets in motion for which there was no setpoint.
    coasts: u64,
}

impl Row {
    /// Whether its target was meant for this SYNC0; before there is power, any is.
    const fn came_in_time(&self) -> bool {
        !self.follows || self.sync_ns.abs_diff(self.meant_ns) < IN_TIME_NS
    }
}

/// The rows of each joint in a record.
pub(super) fn rows(text: &str) -> [Vec<Row>; JOINTS] {
    let mut rows: [Vec<Row>; JOINTS] = Default::default();
    for line in text.lines().skip(1) {
        let cells: Vec<&str> = line.split(',').collect();
        let count = |nth: usize| cells[nth].parse::<u64>().unwrap();
        rows[cells[0].parse::<usize>().unwrap()].push(Row {
            sync_ns: count(1),
            meant_ns: count(2),
            target: cells[3].parse().unwrap(),
            actual: cells[4].parse().unwrap(),
            follows: count(6) == 1,
            missing: count(7) + count(8),
            coasts: count(9),
        });
    }
    rows
}

/// What the rows of all joints came to.
#[derive(Debug)]
pub(super) struct Verdict {
    /// The largest parts of velocity, acceleration and jerk at the period of the bus.
    pub(super) ratios: [f64; 3],
    /// That of the jerk in the plan, at this period.
    pub(super) planned: f64,
    /// What rounding may add to it.
    pub(super) rounding: f64,
    /// The part of the SYNC0 that was judged.
    pub(super) judged: f64,
    /// The part that was left out because a setpoint was missing.
    pub(super) left_out: f64,
}

impl Verdict {
    /// Whether enough was judged.
    pub(super) fn is_enough(&self) -> bool {
        self.judged >= ENOUGH
    }

    /// Whether the limits are kept, as far as the plan keeps them between its setpoints. To velocity
    /// and acceleration rounding adds up to a thousandth, at 1 ms.
    pub(super) fn keeps_limits(&self) -> bool {
        let most = 1.0 + 2e-3;
        let [v, a, j] = self.ratios;
        v <= most && a <= most && j <= self.planned.max(1.0) + self.rounding
    }
}

/// Whether no frame came in time for so long that whoever leads the drives was not there: by then
/// the joints have stopped by themselves, and the interpolator misses them.
pub(super) fn was_left_alone(rows: &[Row]) -> bool {
    let mut spans = rows.chunk_by(|before, after| before.came_in_time() == after.came_in_time());
    spans.any(|span| {
        let lasts_ns = span[span.len() - 1].sync_ns - span[0].sync_ns;
        !span[0].came_in_time() && lasts_ns > BEFORE_NS
    })
}

/// When setpoints were missing, with what is left out on both sides.
fn missing_spans(rows: &[Row]) -> Vec<Range<u64>> {
    let (mut missing, mut coasts) = (0, 0);
    let mut spans = Vec::new();
    for row in rows {
        // A target that nobody remembers tells nothing of what was known.
        let more = row.missing.saturating_sub(missing);
        let coasted = row.coasts.saturating_sub(coasts);
        if more + coasted > 0 {
            let before_ns = BEFORE_NS + more * SETPOINT_NS;
            spans.push(row.sync_ns.saturating_sub(before_ns)..row.sync_ns + AFTER_NS);
        }
        (missing, coasts) = (missing + more, coasts + coasted);
    }
    spans
}

/// Judges the rows of all joints. Not those at which no frame came in time, because it was lost or
/// the host stood still: drives repeat what they had, and differences across them tell nothing of
/// what was sent. And not those around missing setpoints. `planned` is the largest part of the limit of
/// the jerk that the plan has at this period.
pub(super) fn judge(all: &[Vec<Row>; JOINTS], period_t: f64, planned: f64) -> Verdict {
    let mut audit = Audit::new(&AuditSettings {
        limits: settings().limits,
        period_t,
        tolerance_mm: 0.02,
        direction: glidepath_program::DirectionTolerance::default(),
        corners: glidepath_program::Corners::default(),
    });
    let spans = missing_spans(&all[0]);
    let mut position = AxisVector::zeros();
    let count = all.iter().map(Vec::len).min().unwrap();
    let (mut judged, mut left_out) = (0, 0);
    for nth in 0..count {
        let now_ns = all[0][nth].sync_ns;
        if spans.iter().any(|span| span.contains(&now_ns)) {
            left_out += 1;
            continue;
        }
        if !all.iter().all(|rows| rows[nth].came_in_time()) {
            continue;
        }
        judged += 1;
        for (joint, rows) in all.iter().enumerate() {
            let row = rows[nth];
            if row.follows {
                position[joint] = row.target;
            }
        }
        audit.sample(&Sample {
            tick: nth as u64,
            line: 0,
            position,
            reported: None,
            is_between_frames: false,
        });
    }
    let report = audit.finish();
    let limits = settings().limits;
    Verdict {
        ratios: [
            report.max_velocity_ratio.ratio,
            report.max_acceleration_ratio.ratio,
            report.max_jerk_ratio.ratio,
        ],
        planned,
        // To counts, and of the time to whole nanoseconds.
        rounding: (4.0 / COUNTS + 4e-9 * FASTEST_V) / period_t.powi(3) / limits.jerk[0],
        judged: f64::from(judged) / count as f64,
        left_out: f64::from(left_out) / count as f64,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PERIOD_T: f64 = 0.002;
    const PERIOD_NS: u64 = 2_000_000;
    const PLANNED: f64 = 1.0;
    const COUNT: usize = 5000;

    /// Ten seconds of a wave on every joint at 96 % of the limit of the jerk; it grows in the first of
    /// them, and dies away in the last.
    fn wave() -> [Vec<Row>; JOINTS] {
        let (amplitude, rate) = (0.6, 40.0);
        let row = |nth: usize| {
            let time_t = PERIOD_T * nth as f64;
            let from_end_t = time_t.min(PERIOD_T * (COUNT - 1 - nth) as f64).min(1.0);
            let grown = from_end_t.powi(2) * (3.0 - 2.0 * from_end_t);
            let place = amplitude * grown * (rate * time_t).sin();
            let target = (place * COUNTS).round() / COUNTS;
            let sync_ns = 1_000_000_000 + nth as u64 * PERIOD_NS;
            Row {
                sync_ns,
                meant_ns: sync_ns,
                target,
                actual: target,
                follows: true,
                missing: 0,
                coasts: 0,
            }
        };
        std::array::from_fn(|_| (0..COUNT).map(row).collect())
    }

    /// A setpoint is known to be missing from this row on.
    fn lose(all: &mut [Vec<Row>; JOINTS], from: usize) {
        for row in all.iter_mut().flat_map(|rows| &mut rows[from..]) {
            row.missing += 1;
        }
    }

    #[test]
    fn a_motion_inside_its_limits_is_judged_as_a_whole() {
        let verdict = judge(&wave(), PERIOD_T, PLANNED);
        assert!(verdict.is_enough() && verdict.keeps_limits(), "{verdict:?}");
        assert!(verdict.ratios[2] > 0.95, "{verdict:?}");
        assert_eq!((verdict.judged, verdict.left_out), (1.0, 0.0));
    }

    #[test]
    fn a_row_that_is_off_breaks_the_limits_wherever_nothing_was_missing() {
        // A micrometre, once.
        for (off, missing, keeps) in [
            (3000, None, false),
            (4999, None, false),
            // Left out from 24 ms before to 100 ms after.
            (3000, Some(3000), true),
            (3000, Some(3008), true),
            (3000, Some(2960), true),
            // Not any more.
            (3000, Some(3040), false),
            (3000, Some(2940), false),
        ] {
            let mut all = wave();
            all[1][off].target += 1e-3;
            if let Some(from) = missing {
                lose(&mut all, from);
            }
            let verdict = judge(&all, PERIOD_T, PLANNED);
            assert!(verdict.is_enough(), "{verdict:?}");
            assert_eq!(
                verdict.keeps_limits(),
                keeps,
                "{off} {missing:?} {verdict:?}"
            );
        }
    }

    #[test]
    fn targets_that_the_servo_made_up_are_left_out_and_those_behind_are_not() {
        let mut all = wave();
        for rows in &mut all {
            rows[3000].target += 1e-3;
            rows[3000..].iter_mut().for_each(|row| row.coasts = 1);
        }
        let verdict = judge(&all, PERIOD_T, PLANNED);
        assert!(verdict.is_enough() && verdict.keeps_limits(), "{verdict:?}");
        // 20 ms, the row itself and 100 ms, without the last.
        assert_eq!((verdict.left_out * COUNT as f64).round() as usize, 60);
        all[2][3060].target += 1e-3;
        assert!(!judge(&all, PERIOD_T, PLANNED).keeps_limits());
    }

    #[test]
    fn a_frame_that_did_not_come_hides_its_own_row_alone() {
        let mut all = wave();
        for rows in &mut all {
            rows[3000].target = rows[2999].target;
            rows[3000].meant_ns = rows[2999].meant_ns;
        }
        let verdict = judge(&all, PERIOD_T, PLANNED);
        assert!(verdict.is_enough() && verdict.keeps_limits(), "{verdict:?}");
        all[0][3004].target += 1e-3;
        assert!(!judge(&all, PERIOD_T, PLANNED).keeps_limits());
    }

    #[test]
    fn drives_are_left_alone_where_no_frame_comes_for_long() {
        for (count, is_alone) in [(0, false), (5, false), (11, false), (12, true)] {
            let [mut rows, ..] = wave();
            for row in &mut rows[3000..3000 + count] {
                row.meant_ns -= 4 * PERIOD_NS;
            }
            assert_eq!(was_left_alone(&rows), is_alone, "{count}");
        }
    }

    #[test]
    fn without_nine_tenths_there_is_no_verdict() {
        let mut all = wave();
        for nth in 0..8 {
            lose(&mut all, 500 + nth * 500);
        }
        let verdict = judge(&all, PERIOD_T, PLANNED);
        assert!(verdict.is_enough(), "{verdict:?}");
        lose(&mut all, 4700);
        let verdict = judge(&all, PERIOD_T, PLANNED);
        assert!(!verdict.is_enough(), "{verdict:?}");
        assert!(verdict.judged + verdict.left_out > 0.999_9);
    }
}
