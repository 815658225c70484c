//! The conversion between what is kept and what the reader of programs works with.

use glidepath_gcode::{CoordinateSystem, KEPT_VARIABLES, KeptVariables, ToolTable, WorkOffsets};
use glidepath_geometry::AxisVector;
use glidepath_persistence::{AXES, Offsets, SYSTEMS, System, Tool, Variable};
use std::sync::Arc;

fn array(vector: &AxisVector) -> [f64; AXES] {
    let mut array = [0.0; AXES];
    for (slot, value) in array.iter_mut().zip(vector.iter()) {
        *slot = *value;
    }
    array
}

/// What a program begins with: the offset of G92 is at hand for G92.3, and not in force.
pub(crate) fn begun_with(kept: &Offsets) -> WorkOffsets {
    let mut systems = [CoordinateSystem::default(); SYSTEMS];
    for (system, kept) in systems.iter_mut().zip(&kept.systems) {
        system.origin = AxisVector::from(kept.origin);
        system.rotation_deg = kept.rotation_deg;
    }
    WorkOffsets {
        systems,
        active: usize::from(kept.active).saturating_sub(1),
        reference: [AxisVector::from(kept.g28), AxisVector::from(kept.g30)],
        shift: AxisVector::zeros(),
        saved_shift: AxisVector::from(kept.g92),
    }
}

/// What is kept of how a program left the machine.
pub(crate) fn left_with(offsets: &WorkOffsets) -> Offsets {
    let mut systems = [System::default(); SYSTEMS];
    for (kept, system) in systems.iter_mut().zip(&offsets.systems) {
        kept.origin = array(&system.origin);
        kept.rotation_deg = system.rotation_deg;
    }
    let [g28, g30] = &offsets.reference;
    Offsets {
        active: u8::try_from(offsets.active + 1).unwrap_or(1),
        g28: array(g28),
        g30: array(g30),
        g92: array(&offsets.saved_shift),
        systems,
    }
}

/// Takes over what a program changed: what it left as it was stays what is kept now.
pub(crate) fn merge(kept: &mut Offsets, before: &Offsets, after: &Offsets) {
    let systems = before.systems.iter().zip(&after.systems);
    for (kept, (before, after)) in kept.systems.iter_mut().zip(systems) {
        take(kept, before, after);
    }
    take(&mut kept.g28, &before.g28, &after.g28);
    take(&mut kept.g30, &before.g30, &after.g30);
    take(&mut kept.g92, &before.g92, &after.g92);
    take(&mut kept.active, &before.active, &after.active);
}

fn take<T: Copy + PartialEq>(kept: &mut T, before: &T, after: &T) {
    if before != after {
        *kept = *after;
    }
}

/// The tool table with what programs made of it before.
pub(crate) fn with_tools(table: &Arc<ToolTable>, kept: &[Tool]) -> Arc<ToolTable> {
    let mut table = Arc::clone(table);
    for tool in kept {
        let changed = glidepath_gcode::Tool {
            offset: AxisVector::from(tool.offset),
            diameter_mm: tool.diameter_mm,
            orientation: tool.orientation,
        };
        Arc::make_mut(&mut table).set_edge(tool.number, tool.edge, changed);
    }
    table
}

/// Takes over the edges of tools that a program changed.
pub(crate) fn merge_tools(kept: &mut Vec<Tool>, before: &ToolTable, after: &ToolTable) {
    for (number, edge, tool) in after.edges() {
        if before.edge(number, edge) == Some(tool) {
            continue;
        }
        let changed = Tool {
            number,
            edge,
            offset: array(&tool.offset),
            diameter_mm: tool.diameter_mm,
            orientation: tool.orientation,
        };
        let is_same = |kept: &&mut Tool| (kept.number, kept.edge) == (number, edge);
        match kept.iter_mut().find(is_same) {
            Some(kept) => *kept = changed,
            None => kept.push(changed),
        }
    }
}

/// What is kept of the parameters of programs.
pub(crate) fn left_variables(variables: &KeptVariables) -> Vec<Variable> {
    let all = variables.iter();
    all.map(|(number, value)| Variable {
        number: *number,
        value: *value,
    })
    .collect()
}

/// The same for a program to begin with.
pub(crate) fn begun_variables(kept: &[Variable]) -> Arc<KeptVariables> {
    let known = kept.iter().filter(|it| KEPT_VARIABLES.contains(&it.number));
    Arc::new(known.map(|it| (it.number, it.value)).collect())
}

/// G54 … G59.3 by its number from 1.
pub(crate) fn system_name(number: u8) -> String {
    match number {
        1..=6 => format!("G{}", 53 + number),
        _ => format!("G59.{}", number.saturating_sub(6)),
    }
}

/// The axes of a vector that are not zero, in words.
pub(crate) fn axis_words(vector: &[f64; AXES]) -> String {
    let words: Vec<String> = "XYZABCUVW"
        .chars()
        .zip(vector)
        .filter(|(_, value)| **value != 0.0)
        .map(|(axis, value)| format!("{axis}{value}"))
        .collect();
    words.join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_program_left_alone_stays_as_it_is_kept() {
        let mut before = Offsets::default();
        before.systems[3].rotation_deg = 1.0;
        let mut kept = before.clone();
        kept.systems[1].origin[0] = 5.0;
        let mut after = before.clone();
        after.systems[3].origin[2] = 7.0;
        after.g92[8] = 2.0;
        after.active = 4;
        merge(&mut kept, &before, &after);
        assert_eq!(kept.systems[1].origin[0].to_bits(), 5.0_f64.to_bits());
        assert_eq!(kept.systems[3], after.systems[3]);
        assert_eq!((kept.active, kept.g92), (4, after.g92));
    }

    #[test]
    fn each_edge_of_a_tool_is_kept() {
        let text = b"T1 Z10\nT2 Z20 D8\nT2 E2 Z25 D9\nT2 E3 Z26\n";
        let before = Arc::new(ToolTable::parse(text).unwrap());
        let mut after = ToolTable::clone(&before);
        let mut change = |number, edge, length| {
            let mut tool = after.edge(number, edge).copied().unwrap_or_default();
            tool.offset[2] = length;
            after.set_edge(number, edge, tool);
        };
        change(2, 2, 27.0);
        change(1, 2, 11.0);
        let mut kept = Vec::new();
        merge_tools(&mut kept, &before, &after);
        let numbers: Vec<_> = kept.iter().map(|it| (it.number, it.edge)).collect();
        assert_eq!(numbers, [(1, 2), (2, 2)]);
        assert_eq!(*with_tools(&before, &kept), after);
        // The same edge again is the same entry.
        let mut again = after.clone();
        again.set_edge(2, 2, glidepath_gcode::Tool::default());
        merge_tools(&mut kept, &after, &again);
        assert_eq!(kept.len(), 2);
        assert_eq!(*with_tools(&before, &kept), again);
    }

    #[test]
    fn there_and_back_is_the_same_but_g92_is_not_in_force() {
        let mut kept = Offsets {
            active: 9,
            ..Offsets::default()
        };
        kept.g92[0] = 3.0;
        kept.systems[8].origin[5] = -1.5;
        let begun = begun_with(&kept);
        assert!(begun.shift.iter().all(|value| *value == 0.0));
        assert_eq!(left_with(&begun), kept);
        assert_eq!(system_name(9), "G59.3");
        assert_eq!(system_name(6), "G59");
        assert_eq!(axis_words(&kept.g92), "X3");
    }
}
