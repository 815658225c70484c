//! The judgement of what a drive is told of the motion beside its targets.

use super::raw::RawFeedForward;
use crate::config::{ConfigDiagnostic, Judge, Range};
use core::f64::consts::TAU;
use core::ops::Range as Span;
use glidepath_ethercat::{FeedForward, TorqueModel};
use toml::Spanned;

const UNITS: Range = Range {
    min: 1e-6,
    max: 1e9,
    unit: "units",
    help: "what a mm/s or °/s is in the drive's unit of 0x60B1 (0x60A9, by its manual): counts_per_mm where that \
           is counts/s",
};
const INERTIA: Range = Range {
    min: 1e-6,
    max: 1e6,
    unit: "kg·cm²",
    help: "rotor, coupling, screw and load as the motor feels them: the rotor's by its data sheet, times one more \
           than the drive's ratio of inertia",
};
const RATED: Range = Range {
    min: 1e-4,
    max: 1e5,
    unit: "N·m",
    help: "the rated torque of the motor, by its data sheet or 0x6076 (mN·m)",
};
const REVOLUTION: Range = Range {
    min: 1e-3,
    max: 1e5,
    unit: "mm or °",
    help: "how far the joint goes in a revolution of the motor",
};
const PER_ACCELERATION: Range = Range {
    min: 1e-9,
    max: 1e3,
    unit: "% of the rated torque",
    help: "for a mm/s² or °/s²: what the drive shows in acceleration less what it shows at constant speed, over \
           the acceleration",
};
const VISCOUS: Range = Range {
    min: 0.0,
    max: 100.0,
    unit: "% of the rated torque",
    help: "for a mm/s or °/s: the difference of what the drive shows at two constant speeds, over that of the speeds",
};
const COULOMB: Range = Range {
    min: 0.0,
    max: 100.0,
    unit: "% of the rated torque",
    help: "what the drive shows at a slow constant speed",
};
const FRICTION_FROM: Range = Range {
    min: 1e-3,
    max: 1e3,
    unit: "mm/s or °/s",
    help: "at this speed three quarters of coulomb are told, so that a reversal is no step",
};
const MOST: Range = Range {
    min: 0.1,
    max: 500.0,
    unit: "% of the rated torque",
    help: "the most that is told, whatever the motion is; what the drive gives for a moment at the most",
};
/// What is told at most, and from which speed on, if the file does not say.
const MOST_PERCENT: f64 = 50.0;
const FRICTION_FROM_V: f64 = 1.0;

/// Thousandths in a part of a hundred.
const PER_MILLE: f64 = 10.0;

/// Judges that of a drive: what it counts for a mm or a degree, and the highest speed and acceleration of its joint.
pub(super) fn feed_forward(
    judge: &mut Judge,
    raw: &Spanned<RawFeedForward>,
    counts_per_unit: f64,
    (max_v, max_a): (f64, f64),
) -> Option<FeedForward> {
    let (span, raw) = (raw.span(), raw.as_ref());
    let units = judge.number_or(
        "drive.feed_forward.velocity_units",
        &raw.velocity_units,
        &UNITS,
        counts_per_unit,
    );
    let told = FeedForward {
        velocity_units: raw.velocity.then_some(units),
        torque: torque(judge, raw, &span),
    };
    let mut tell = |key: &str, message: String, help: String, span| {
        judge.diagnostics.push(ConfigDiagnostic {
            key: format!("drive.feed_forward{key}"),
            message,
            help: Some(help),
            span: Some(span),
        });
    };
    if let Some(units) = raw.velocity_units.as_ref().filter(|_| !raw.velocity) {
        let message = "velocity_units counts for nothing without velocity = true".to_owned();
        tell(
            ".velocity_units",
            message,
            "leave it out".to_owned(),
            units.span(),
        );
    }
    if told.velocity_units.is_none() && told.torque.is_none() {
        let message = "feed_forward tells the drive nothing".to_owned();
        let help =
            "give velocity = true, or inertia, rated_torque and revolution, or leave the table out";
        tell("", message, help.to_owned(), span);
        return None;
    }
    let takes = told.torque.map_or(0.0, |model| {
        (model.per_acceleration * max_a + model.per_velocity * max_v + model.coulomb) / PER_MILLE
    });
    let most = told.torque.map_or(0.0, |model| model.most / PER_MILLE);
    if takes.is_finite() && takes > most {
        let message = format!(
            "the limits of the joint take {takes:.1} % of the rated torque, and {most} % are told at most"
        );
        let help = format!(
            "give most = {:.0} if the drive gives that for a moment, or look at inertia, viscous and coulomb again",
            takes.ceil()
        );
        tell(".most", message, help, span);
    }
    Some(told)
}

/// What a motion takes of torque; `None` if nothing of it is said.
fn torque(judge: &mut Judge, raw: &RawFeedForward, span: &Span<usize>) -> Option<TorqueModel> {
    let is_said = raw.inertia.is_some()
        || raw.acceleration_torque.is_some()
        || raw.viscous.is_some()
        || raw.coulomb.is_some();
    if !is_said {
        return None;
    }
    let viscous = judge.number_or("drive.feed_forward.viscous", &raw.viscous, &VISCOUS, 0.0);
    let coulomb = judge.number_or("drive.feed_forward.coulomb", &raw.coulomb, &COULOMB, 0.0);
    let coulomb_v = judge.number_or(
        "drive.feed_forward.friction_from",
        &raw.friction_from,
        &FRICTION_FROM,
        FRICTION_FROM_V,
    );
    let most = judge.number_or("drive.feed_forward.most", &raw.most, &MOST, MOST_PERCENT);
    Some(TorqueModel {
        per_acceleration: per_acceleration(judge, raw, span),
        per_velocity: PER_MILLE * viscous,
        coulomb: PER_MILLE * coulomb,
        coulomb_v,
        most: PER_MILLE * most,
    })
}

/// What a mm/s² or °/s² takes, thousandths of the rated torque; 0 if that is not said.
fn per_acceleration(judge: &mut Judge, raw: &RawFeedForward, span: &Span<usize>) -> f64 {
    let by_inertia = [&raw.inertia, &raw.rated_torque, &raw.revolution];
    let said = by_inertia.iter().filter(|value| value.is_some()).count();
    if let (Some(per_acceleration), 0) = (&raw.acceleration_torque, said) {
        let key = "drive.feed_forward.acceleration_torque";
        return PER_MILLE * judge.number(key, per_acceleration, &PER_ACCELERATION);
    }
    if let ([Some(inertia), Some(rated), Some(revolution)], None) =
        (by_inertia, &raw.acceleration_torque)
    {
        let inertia = judge.number("drive.feed_forward.inertia", inertia, &INERTIA);
        let rated = judge.number("drive.feed_forward.rated_torque", rated, &RATED);
        let revolution = judge.number("drive.feed_forward.revolution", revolution, &REVOLUTION);
        // kg·cm² · rad/s² = 10⁻⁴ N·m.
        return 1000.0 * inertia * 1e-4 * TAU / revolution / rated;
    }
    if said > 0 || raw.acceleration_torque.is_some() {
        judge.diagnostics.push(ConfigDiagnostic {
            key: "drive.feed_forward.inertia".to_owned(),
            message: "what an acceleration takes is inertia, rated_torque and revolution, or acceleration_torque"
                .to_owned(),
            help: Some("give all three, or that one alone".to_owned()),
            span: Some(span.clone()),
        });
    }
    0.0
}
