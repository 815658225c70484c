//! The judgement of touch probes: of each drive, and of all together.

use super::raw::RawTouchProbe;
use crate::config::{ConfigDiagnostic, HomingBy, Judge, MachineConfig};
use core::ops::Range as Span;
use glidepath_ethercat::{DIGITAL_INPUTS, DriveSettings, TouchProbe};
use glidepath_interpolator::IndexPulse;
use toml::Spanned;

/// Judges that of a drive.
pub(super) fn touch_probe(judge: &mut Judge, raw: &RawTouchProbe) -> Option<TouchProbe> {
    let most = i64::try_from(DIGITAL_INPUTS).unwrap_or(64) - 1;
    let help = "the input that is the probe, as [probe] of the machine's configuration has it";
    let number = judge.whole("drive.probe.number", &raw.number, (0, most), help);
    let unit = raw.unit.as_ref().map_or(Some(1), |unit| {
        let help = "a drive has two touch probes, 1 and 2 (0x60B8)";
        judge.whole("drive.probe.unit", unit, (1, 2), help)
    });
    let source = raw.source.as_ref().and_then(|source| {
        let help = "what 0x60D0 is to be, by the drive's manual";
        judge.whole("drive.probe.source", source, (1, 0x7fff), help)
    });
    Some(TouchProbe {
        unit: unit?,
        number: number?,
        is_inverted: raw.invert,
        source,
    })
}

/// Judges which one keeps the index pulse of a drive's encoder.
pub(super) fn index(
    judge: &mut Judge,
    raw: Option<&Spanned<i64>>,
    probe: Option<TouchProbe>,
) -> Option<u8> {
    let raw = raw?;
    let help = "a drive has two touch probes, 1 and 2 (0x60B8)";
    let unit = judge.whole("drive.index", raw, (1, 2), help)?;
    if let Some(probe) = probe.filter(|probe| probe.unit != unit) {
        judge.diagnostics.push(ConfigDiagnostic {
            key: "drive.index".to_owned(),
            message: format!(
                "the index pulse is kept by touch probe {unit}, and `probe` is touch probe {}",
                probe.unit
            ),
            help: Some("one touch probe of a drive does both: give the same".to_owned()),
            span: Some(raw.span()),
        });
    }
    Some(unit)
}

/// Whether the drive of a joint that comes home by its index pulse is told how to keep that.
pub(super) fn is_index_known(
    judge: &mut Judge,
    drive: &DriveSettings,
    machine: &MachineConfig,
    span: &Span<usize>,
) {
    let home = machine.home_of_joints.get(drive.joint).copied().flatten();
    let is_asked = machine.feedback.homing == HomingBy::Controller
        && home.is_some_and(|home| home.index == Some(IndexPulse::Drive));
    if is_asked && drive.index.is_none() {
        let joint = drive.joint;
        judge.diagnostics.push(ConfigDiagnostic {
            key: "drive.index".to_owned(),
            message: format!(
                "[home.J{joint}] of the machine has index = \"drive\", and the drive of J{joint} has no `index`"
            ),
            help: Some(
                "add index = 1: the touch probe of the drive that keeps the zero impulse of its encoder".to_owned(),
            ),
            span: Some(span.clone()),
        });
    }
}

/// Judges all together: every drive has one or none has, and all of the same probe, whose input is among these
/// numbers.
pub(super) fn together(
    judge: &mut Judge,
    drives: &[(DriveSettings, Span<usize>)],
    numbers: &[usize],
    machine: &MachineConfig,
) {
    let Some((first, probe, span)) = drives.iter().find_map(|(drive, span)| {
        let probe = drive.probe?;
        Some((drive.joint, probe, span.clone()))
    }) else {
        return;
    };
    let mut tell = |message: String, help: String, span: &Span<usize>| {
        judge.diagnostics.push(ConfigDiagnostic {
            key: "drive.probe".to_owned(),
            message,
            help: Some(help),
            span: Some(span.clone()),
        });
    };
    for (drive, span) in drives {
        let joint = drive.joint;
        match drive.probe {
            None => tell(
                format!("J{joint} has no `probe`, and J{first} has"),
                "where a contact was is kept by all drives at once: give each [[drive]] a probe, and wire the \
                 probe to an input of each, or leave it out of all"
                    .to_owned(),
                span,
            ),
            Some(other) if other.number != probe.number => tell(
                format!(
                    "J{joint} has the probe of input {}, and J{first} that of input {}",
                    other.number, probe.number
                ),
                "a machine has one probe: give the same number".to_owned(),
                span,
            ),
            Some(_) => {}
        }
    }
    let number = probe.number;
    if !numbers.contains(&usize::from(number)) {
        tell(
            format!("no input of this file has number = {number}"),
            "the probe stops the motion by that input: give an input of a [[device]] or a [[drive]] this number".to_owned(),
            &span,
        );
    }
    let wanted = machine.probe.map(|probe| probe.input.number);
    if wanted != Some(number) {
        tell(
            format!("input {number} is not the probe of the machine"),
            format!("give [probe] of the machine's configuration input = {number}"),
            &span,
        );
    }
}
