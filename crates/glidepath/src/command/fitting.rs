//! The work offset with which a program would fit into the travel of the axes. What is outside is
//! so most often because its work offset is not set yet.

use super::reading::for_program;
use crate::config::MachineConfig;
use crate::program_file::ProgramFile;
use glidepath_gcode::{Diagnostic, DiagnosticCode};
use glidepath_geometry::AxisVector;
use glidepath_planner::{FileSource, ItemSource, Supply};
use glidepath_program::ItemKind;

/// Items of a program that are looked at: some seconds. Loops may go on for ever.
const MOST_ITEMS: u32 = 5_000_000;

/// The machine with travel without end: to look where a program goes.
pub(super) fn without_travel(config: &MachineConfig) -> MachineConfig {
    let mut config = config.clone();
    for axis in &mut config.axes {
        axis.travel = None;
    }
    config
}

/// Whether nothing is wrong but that the travel is left.
pub(super) fn is_all_that_is_wrong(diagnostics: &[Diagnostic]) -> bool {
    let mut codes = diagnostics.iter().map(|found| found.code);
    !diagnostics.is_empty() && codes.all(|code| code == DiagnosticCode::SoftLimit)
}

/// Has findings of the travel say by how much the work offset would have to be moved.
pub(super) fn name_offset(
    diagnostics: &mut [Diagnostic],
    file: &ProgramFile,
    config: &MachineConfig,
) {
    if !is_all_that_is_wrong(diagnostics) {
        return;
    }
    if let Some(advice) = extent(file, config).and_then(|extent| advice(&extent, config)) {
        for diagnostic in diagnostics {
            diagnostic.help = format!("{advice}, or {}", diagnostic.help);
        }
    }
}

/// The lowest and the highest position that the program goes to; none if it goes nowhere.
fn extent(file: &ProgramFile, config: &MachineConfig) -> Option<(AxisVector, AxisVector)> {
    let (home, config) = (config.home(), without_travel(&for_program(file, config)));
    let options = config.program_options(home);
    let mut source = FileSource::unchecked(file.path(), options, &config.settings()).ok()?;
    let mut extent: Option<(AxisVector, AxisVector)> = None;
    for _ in 0..MOST_ITEMS {
        let Supply::Item(item) = source.next_item() else {
            break;
        };
        let ItemKind::Move { segment, .. } = &item.kind else {
            continue;
        };
        // Where it sets out from is where the machine stands, or what was counted already.
        let (mut low, mut high) = segment.bounding_box();
        if extent.is_none() {
            (low, high) = (segment.end(), segment.end());
        }
        let so_far = extent.get_or_insert((low, high));
        *so_far = (so_far.0.inf(&low), so_far.1.sup(&high));
    }
    extent
}

/// By how much the offset of each axis has to be moved, as a sentence; none where no axis is left.
fn advice((low, high): &(AxisVector, AxisVector), config: &MachineConfig) -> Option<String> {
    let (mut moves, mut sizes) = (Vec::new(), Vec::new());
    for axis in &config.axes {
        let Some((min, max)) = axis.travel else {
            continue;
        };
        let i = axis.axis.index();
        let (name, unit) = (axis.axis, if axis.axis.is_rotary() { "°" } else { " mm" });
        let (least, most) = (min - low[i], max - high[i]);
        if least > most {
            sizes.push(format!(
                "{name} takes {}{unit} of a travel of {}{unit}",
                short(high[i] - low[i]),
                short(max - min)
            ));
        } else if !(least..=most).contains(&0.0) {
            moves.push(format!(
                "{name} by {} to {}{unit}",
                short(least),
                short(most)
            ));
        }
    }
    if !sizes.is_empty() {
        return Some(format!(
            "no work offset fits, because {}: make the part smaller",
            sizes.join(", ")
        ));
    }
    (!moves.is_empty()).then(|| format!("move the work offset: {}", moves.join(", ")))
}

/// To the micrometre, for people.
fn short(value: f64) -> f64 {
    (value * 1e3).round() / 1e3 + 0.0
}
