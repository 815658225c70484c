//! The restoring events: they make spindle, coolant, tools and outputs what they are to be.

use glidepath_link::{Auxiliary, Coolant, SpindleState};
use glidepath_program::Event;

/// The events that wait for what these have told, in front of the first feed: for codes that the machine waits for
/// later than where they stand. For all others they do nothing.
pub(crate) fn awaiting(told: &[Event]) -> Vec<Event> {
    let codes = told.iter().filter_map(|event| match event {
        Event::MCode(code) => Some(Event::Await(*code)),
        _ => None,
    });
    codes.collect()
}

/// The events that make what is now what is expected.
pub(crate) fn restoring(now: &Auxiliary, expected: &Auxiliary) -> Vec<Event> {
    let mut events = Vec::new();
    let mut now = *now;
    let mut tell = |now: &mut Auxiliary, event: Event| {
        now.take(event);
        events.push(event);
    };
    if now.tool != expected.tool {
        tell(&mut now, Event::SelectTool(expected.tool));
        tell(&mut now, Event::MCode(6));
    }
    if now.prepared_tool != expected.prepared_tool {
        tell(&mut now, Event::SelectTool(expected.prepared_tool));
    }
    if now.spindle_gear != expected.spindle_gear && expected.spindle_gear != 0 {
        tell(&mut now, Event::SpindleGear(expected.spindle_gear));
        tell(&mut now, Event::MCode(40 + expected.spindle_gear));
    }
    if (now.spindle_speed - expected.spindle_speed).abs() > 0.0 {
        tell(&mut now, Event::SpindleSpeed(expected.spindle_speed));
    }
    let is_other = now.spindle != expected.spindle || now.orientation() != expected.orientation();
    if is_other && let Some((deg, way)) = expected.orientation() {
        tell(&mut now, Event::SpindleAngle { deg, way });
    }
    if is_other {
        let code = match expected.spindle() {
            Ok(SpindleState::Clockwise) => 3,
            Ok(SpindleState::Counterclockwise) => 4,
            Ok(SpindleState::Oriented) => 19,
            _ => 5,
        };
        tell(&mut now, Event::MCode(code));
    }
    if now.coolant != expected.coolant {
        if now.coolant & !expected.coolant != 0 {
            tell(&mut now, Event::MCode(9));
        }
        for (of, code) in [(Coolant::MIST, 7), (Coolant::FLOOD, 8)] {
            if expected.coolant().contains(of) && !now.coolant().contains(of) {
                tell(&mut now, Event::MCode(code));
            }
        }
    }
    for number in 0..u64::BITS {
        let is_on = |record: &Auxiliary| record.digital_out >> number & 1 == 1;
        let on = is_on(expected);
        if is_on(&now) != on {
            tell(&mut now, Event::DigitalOutput { number, on });
        }
    }
    for (number, value) in (0..).zip(expected.analog_out) {
        let present = now.analog_out.get(number as usize).copied();
        if present.is_some_and(|present| (present - value).abs() > 0.0) {
            tell(&mut now, Event::AnalogOutput { number, value });
        }
    }
    events
}
