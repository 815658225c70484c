//! The judge of what drives and outputs themselves have recorded.

use crate::machine::{Outcome, Setup, limits};
use glidepath_audit::{Audit, AuditReport, AuditSettings, Sample};
use glidepath_emulator::{OutputRecord, SyncRecord};
use glidepath_geometry::AxisVector;
use glidepath_program::Event as Told;

/// The auditor's report on the targets that the drives took over, at the period of the bus.
pub(crate) fn audited(setup: &Setup, records: &[Vec<SyncRecord>]) -> AuditReport {
    let mut audit = Audit::new(&AuditSettings {
        limits: limits(),
        period_t: setup.bus.period_ns as f64 * 1e-9,
        tolerance_mm: 0.02,
        direction: glidepath_program::DirectionTolerance::default(),
        corners: glidepath_program::Corners::default(),
    });
    let count = records.iter().map(Vec::len).min().unwrap_or(0);
    let mut last = AxisVector::zeros();
    for nth in 0..count {
        let of_all = records.iter().map(|records| records[nth]);
        for (joint, (drive, record)) in setup.drives.iter().zip(of_all).enumerate() {
            // Without power the target goes with the joint, which is no motion of ours.
            if record.follows {
                last[joint] = drive.place(record.target);
            }
        }
        let position = last;
        audit.sample(&Sample {
            tick: nth as u64,
            line: 0,
            position,
            reported: None,
            is_between_frames: false,
        });
    }
    audit.finish()
}

/// What rounding to counts may add to a ratio of the nth difference.
pub(crate) fn rounding(setup: &Setup, nth: i32) -> f64 {
    let period_t = setup.bus.period_ns as f64 * 1e-9;
    let limit = [200.0, 2000.0, 40_000.0][nth as usize - 1];
    // Half a count up and half a count down, by the sum of the difference's coefficients.
    f64::from(1 << nth) * 0.5 / setup.drives[0].counts_per_unit / period_t.powi(nth) / limit
}

/// The largest difference of the motor to where the model has it: behind the target by what is left
/// of it after a lag; mm.
pub(crate) fn model_error(setup: &Setup, outcome: &Outcome, joint: usize) -> f64 {
    let drive = &setup.drives[joint];
    let lag_t = setup.emulated[drive.position].lag_t;
    let stays = (-(setup.bus.period_ns as f64) * 1e-9 / lag_t).exp();
    let mut worst = 0.0_f64;
    for pair in outcome.records[joint].windows(2) {
        let (before, after) = (drive.place(pair[0].actual), drive.place(pair[1].actual));
        let target = drive.place(pair[1].target);
        if pair[0].follows && pair[1].follows {
            worst = worst.max((after - (target - (target - before) * stays)).abs());
        }
    }
    worst
}

/// The changes of a bit of the outputs, from the first on.
pub(crate) fn output_changes(records: &[OutputRecord], bit: u8) -> Vec<(u64, bool)> {
    let mut changes: Vec<(u64, bool)> = Vec::new();
    for record in records {
        let is_on = record.outputs[0] & bit != 0;
        if changes.last().map_or(is_on, |(_, before)| *before != is_on) {
            changes.push((record.at_ns, is_on));
        }
    }
    changes
}

/// When an output of programs was commanded to be on and off.
pub(crate) fn commanded(outcome: &Outcome, output: u32) -> Vec<(u64, bool)> {
    let of = |setpoint: &glidepath_link::Setpoint| {
        let events = setpoint.events().to_vec().into_iter();
        let since_ns = setpoint.scheduled_ns;
        events.filter_map(move |record| match record.event() {
            Ok(Told::DigitalOutput { number, on }) if number == output => {
                Some((since_ns + u64::from(record.offset_ns), on))
            }
            _ => None,
        })
    };
    outcome.setpoints.iter().flat_map(of).collect()
}
