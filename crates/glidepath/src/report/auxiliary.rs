//! The words of a program for what spindle, coolant and tool are to do.

use glidepath_link::{Auxiliary, Coolant, SpindleState};

/// The spindle: `M3 S600`, `M42 M3 S600 at 80 %`, `M5`.
#[must_use]
pub fn spindle_words(record: &Auxiliary) -> String {
    let speed = record.spindle_speed;
    let percent = match (100.0 * record.spindle_override).round() {
        100.0 => String::new(),
        percent => format!(" at {percent} %"),
    };
    let gear = match record.spindle_gear {
        0 => String::new(),
        gear => format!("M{} ", 40 + gear),
    };
    match record.spindle() {
        Ok(SpindleState::Clockwise) => format!("{gear}M3 S{speed}{percent}"),
        Ok(SpindleState::Counterclockwise) => format!("{gear}M4 S{speed}{percent}"),
        Ok(SpindleState::Oriented) => match record.orientation() {
            Some((deg, _)) => format!("M19 R{deg}"),
            None => "M19".to_owned(),
        },
        _ => format!("{gear}M5"),
    }
}

/// The coolant: `M7 M8`, `M9`.
#[must_use]
pub fn coolant_words(record: &Auxiliary) -> String {
    let on = [(Coolant::MIST, "M7"), (Coolant::FLOOD, "M8")];
    let on: Vec<&str> = on
        .iter()
        .filter(|(of, _)| record.coolant().contains(*of))
        .map(|(_, name)| *name)
        .collect();
    if on.is_empty() {
        "M9".to_owned()
    } else {
        on.join(" ")
    }
}

/// Tool, spindle and coolant in one line: `T3, T4 selected, spindle M3 S600, coolant M8`.
pub(super) fn auxiliary_words(record: &Auxiliary) -> String {
    let tool = match record.tool {
        0 => "no tool".to_owned(),
        tool => format!("T{tool}"),
    };
    let selected = match record.prepared_tool {
        prepared if prepared == record.tool => String::new(),
        prepared => format!(", T{prepared} selected"),
    };
    let (spindle, coolant) = (spindle_words(record), coolant_words(record));
    format!("{tool}{selected}, spindle {spindle}, coolant {coolant}")
}
