//! The differences between the machine as it is and as a program expects it at a line.

use super::failure::Failure;
use crate::config::MachineConfig;
use crate::report::{coolant_words, decimals, spindle_words};
use core::fmt::Write as _;
use glidepath_geometry::AxisVector;
use glidepath_link::Auxiliary;
use glidepath_planner::{Approach, Control, FramePublisher, LineStart, StartLine};

/// How the machine goes to where the program is to begin.
///
/// # Errors
/// The link fails.
pub(super) fn approach(
    config: &MachineConfig,
    position: AxisVector,
    publisher: &FramePublisher<'_>,
    control: &mut Control<'_>,
) -> Result<Approach, Failure> {
    let tool_axis = config.jog.tool_axis;
    let axis = config.axes.iter().find(|axis| axis.axis == tool_axis);
    let now = publisher.auxiliary(control)?;
    Ok(Approach {
        position,
        now,
        tool_axis,
        top: axis.and_then(|axis| axis.travel).map(|(_, top)| top),
    })
}

/// What has to be agreed to before the machine moves.
pub(super) fn agreement<S: glidepath_planner::ItemSource>(
    from: StartLine,
    found: &mut LineStart<S>,
    approach: &Approach,
    config: &MachineConfig,
) -> String {
    let down_mm_min = found.way_down_v() * 60.0;
    let (now, then) = (&approach.now, found.expected());
    let mut text = format!("begins with line {}, time {}", from.line, from.pass);
    // Writing to a String does not fail.
    let mut differs = |what: &str, now: String, then: String| {
        if now != then {
            let _ = write!(text, "\n{what}: {now} -> {then}");
        }
    };
    let place = |position: &AxisVector| {
        let axes = config.axes.iter().map(|axis| {
            let value = position[axis.axis.index()];
            format!("{}{}", axis.axis, decimals(value, 4))
        });
        axes.collect::<Vec<_>>().join(" ")
    };
    differs(
        "position",
        place(&approach.position),
        place(&found.begins_at()),
    );
    differs("tool", format!("T{}", now.tool), format!("T{}", then.tool));
    let prepared = |record: &Auxiliary| format!("T{}", record.prepared_tool);
    differs("tool selected", prepared(now), prepared(then));
    differs("spindle", spindle_words(now), spindle_words(then));
    differs("coolant", coolant_words(now), coolant_words(then));
    let outputs = |record: &Auxiliary| format!("{:#x}", record.digital_out);
    differs("digital outputs", outputs(now), outputs(then));
    let analog = |record: &Auxiliary| record.analog_out.map(f64::to_bits);
    if analog(now) != analog(then) {
        text.push_str("\nanalog outputs differ");
    }
    if found.told() > 0 {
        let told = found.told();
        let _ = write!(
            text,
            "\nwhat inputs and the probe said before that line, {told} answers: as in the run before"
        );
    }
    let axis = approach.tool_axis;
    let down_mm = approach.up_to(&found.begins_at()) - found.begins_at()[axis.index()];
    let down_s = down_mm / found.way_down_v();
    let _ = write!(
        text,
        "\nthe way: {axis} up, what differs, the other axes at rapid, {axis} down {down_mm:.0} mm at {down_mm_min:.0} mm/min, \
         which takes {down_s:.0} s"
    );
    text
}
