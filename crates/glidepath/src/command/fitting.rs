//! The work offset with which a program would fit into the travel of the axes. What is outside is
//! so most often because its work offset is not set yet.

use super::reading::for_program;
use crate::config::MachineConfig;
use crate::program_file::ProgramFile;
use glidepath_gcode::{Diagnostic, DiagnosticCode};
use glidepath_geometry::{AXES, Axis, AxisVector};
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
    let Some(extent) = extent(file, config) else {
        return;
    };
    if let Some(too_large) = too_large(&extent, config) {
        for diagnostic in diagnostics {
            diagnostic.help.clone_from(&too_large);
        }
    } else if let Some(advice) = advice(&extent, config) {
        for diagnostic in diagnostics {
            diagnostic.help = format!("{advice}, or {}", diagnostic.help);
        }
    }
}

/// The lowest and the highest position that the program goes to; none if it goes nowhere. Each axis counts from its
/// first move on: before that it stands where the machine was left, and no work offset changes that.
fn extent(file: &ProgramFile, config: &MachineConfig) -> Option<(AxisVector, AxisVector)> {
    let (home, config) = (config.home(), without_travel(&for_program(file, config)));
    let options = config.program_options(home);
    let mut source = FileSource::unchecked(file.path(), options, &config.settings()).ok()?;
    let mut extent: Option<(AxisVector, AxisVector)> = None;
    let mut has_moved = [false; AXES];
    for _ in 0..MOST_ITEMS {
        let Supply::Item(item) = source.next_item() else {
            break;
        };
        let ItemKind::Move { segment, .. } = &item.kind else {
            continue;
        };
        let (low, high) = segment.bounding_box();
        let end = segment.end();
        let (lowest, highest) = extent.get_or_insert((end, end));
        for (i, has_moved) in has_moved.iter_mut().enumerate() {
            if *has_moved {
                (lowest[i], highest[i]) = (lowest[i].min(low[i]), highest[i].max(high[i]));
            } else if low[i] < high[i] {
                // Where it sets out from is where the machine stands.
                (lowest[i], highest[i], *has_moved) = (end[i], end[i], true);
            }
        }
    }
    extent
}

/// Why no work offset fits, and what does, as a sentence; none where one fits.
fn too_large((low, high): &(AxisVector, AxisVector), config: &MachineConfig) -> Option<String> {
    let mut sizes = Vec::new();
    for axis in &config.axes {
        let i = axis.axis.index();
        let size = high[i] - low[i];
        if let Some((min, max)) = axis.travel
            && size > max - min
        {
            let (name, unit) = (axis.axis, unit_of(axis.axis));
            let (size, travel) = (short(size), short(max - min));
            sizes.push(format!(
                "{name} takes {size}{unit} of a travel of {travel}{unit}"
            ));
        }
    }
    let sizes = (!sizes.is_empty()).then(|| sizes.join(", "))?;
    Some(format!(
        "no work offset fits, because {sizes}: make the part smaller"
    ))
}

fn unit_of(axis: Axis) -> &'static str {
    if axis.is_rotary() { "°" } else { " mm" }
}

/// By how much the offset of each axis has to be moved, as a sentence; none where no axis is left.
fn advice((low, high): &(AxisVector, AxisVector), config: &MachineConfig) -> Option<String> {
    let mut moves = Vec::new();
    for axis in &config.axes {
        let Some((min, max)) = axis.travel else {
            continue;
        };
        let i = axis.axis.index();
        let (name, unit) = (axis.axis, unit_of(axis.axis));
        let (least, most) = (min - low[i], max - high[i]);
        if !(least..=most).contains(&0.0) {
            moves.push(format!(
                "{name} by {} to {}{unit}",
                short(least),
                short(most)
            ));
        }
    }
    (!moves.is_empty()).then(|| format!("move the work offset: {}", moves.join(", ")))
}

/// To the micrometre, for people.
fn short(value: f64) -> f64 {
    (value * 1e3).round() / 1e3 + 0.0
}
