//! The events of the machine, from setpoint to setpoint.

use super::message::unix_ms;
use glidepath_link::{EventRecord, MachineState, Setpoint};
use glidepath_program::{CodeWord, Event};
use serde_json::json;

/// Events in a second that are told; more are counted by the next.
const MOST_IN_A_SECOND: u32 = 50;

/// What was seen last.
#[derive(Debug, Default)]
pub(super) struct Events {
    last: Option<(u64, MachineState)>,
    second: u64,
    told: u32,
    left_out: u32,
}

impl Events {
    /// What happens with a setpoint, if anything does: a change of state, an event of the program, a
    /// new life of the interpolator.
    pub(super) fn next(&mut self, setpoint: &Setpoint, now_ns: u64) -> Option<String> {
        let state = setpoint.state().ok()?;
        let before = self.last.replace((setpoint.boot_id, state));
        let starts = before.is_none_or(|(boot, _)| boot != setpoint.boot_id);
        let from = before.map(|(_, state)| state).filter(|_| !starts);
        let of_program = words(setpoint);
        if !starts && from == Some(state) && of_program.is_none() {
            return None;
        }
        let second = now_ns / 1_000_000_000;
        if second != self.second {
            (self.second, self.told) = (second, 0);
        }
        if self.told >= MOST_IN_A_SECOND {
            self.left_out += 1;
            return None;
        }
        self.told += 1;
        let left_out = core::mem::take(&mut self.left_out);
        let message = json!({
            "unix_ms": unix_ms(),
            "t_ns": setpoint.apply_ns,
            "boot": format!("{:x}", setpoint.boot_id),
            "number": setpoint.number,
            "line": setpoint.line,
            "from": from.map(MachineState::name),
            "to": state.name(),
            "event": of_program,
            "left_out": left_out,
        });
        Some(message.to_string())
    }
}

/// What happens in the period of a setpoint, as a program says it; nothing if nothing does.
fn words(setpoint: &Setpoint) -> Option<String> {
    let events = setpoint.events().iter().flat_map(EventRecord::event);
    let words: Vec<String> = events.map(word).collect();
    (!words.is_empty()).then(|| words.join(" "))
}

/// An event as a program says it.
fn word(event: Event) -> String {
    match event {
        Event::SpindleSpeed(speed) => format!("S{speed}"),
        Event::SpindleAngle { deg, .. } => format!("the spindle's angle {deg}"),
        Event::SpindleGear(gear) => format!("gear {gear} of the spindle"),
        Event::SelectTool(tool) => format!("T{tool}"),
        Event::MCode(number) | Event::PassingCode(number) | Event::ProgramStop(number) => {
            format!("M{number}")
        }
        Event::OptionalStop => "M1".to_owned(),
        Event::Probe { release: false } => "G38.2".to_owned(),
        Event::Probe { release: true } => "G38.4".to_owned(),
        Event::CodeWord { word, value } => match word {
            CodeWord::P => format!("P{value}"),
            CodeWord::Q => format!("Q{value}"),
        },
        Event::Await(code) => format!("the answer to M{code}"),
        Event::Synchronise { pitch_mm, .. } => format!("G33 K{pitch_mm}"),
        Event::Tap { pitch_mm, .. } => format!("G33.1 K{}", pitch_mm.abs()),
        Event::DigitalOutput { number, on } => format!("M{} P{number}", if on { 62 } else { 63 }),
        Event::AnalogOutput { number, value } => format!("M67 E{number} Q{value}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use bytemuck::Zeroable as _;
    use serde_json::Value;

    fn setpoint(number: u64, state: MachineState) -> Setpoint {
        Setpoint {
            boot_id: 0xab,
            number,
            state: state.code(),
            line: 7,
            ..Setpoint::zeroed()
        }
    }

    fn told(events: &mut Events, setpoint: &Setpoint, now_ns: u64) -> Option<Value> {
        let text = events.next(setpoint, now_ns)?;
        Some(serde_json::from_str(&text).expect("JSON"))
    }

    #[test]
    fn changes_of_state_and_events_of_the_program_are_told_and_nothing_else() {
        let mut events = Events::default();
        let (idle, running) = (MachineState::Idle, MachineState::Running);
        let first = told(&mut events, &setpoint(0, idle), 0).expect("a new life");
        assert_eq!(
            (&first["from"], &first["to"]),
            (&Value::Null, &json!("idle"))
        );
        assert_eq!(told(&mut events, &setpoint(1, idle), 0), None);
        let begins = told(&mut events, &setpoint(2, running), 0).expect("a change");
        assert_eq!(
            (&begins["from"], &begins["to"]),
            (&json!("idle"), &json!("running"))
        );
        assert_eq!(
            (&begins["line"], &begins["boot"]),
            (&json!(7), &json!("ab"))
        );
        let mut with_event = setpoint(3, running);
        assert!(with_event.tell(EventRecord::new(Event::MCode(3), 0)));
        let event = told(&mut events, &with_event, 0).expect("an event");
        assert_eq!(event["event"], json!("M3"));
        assert_eq!(told(&mut events, &setpoint(4, running), 0), None);
    }

    #[test]
    fn more_than_fifty_in_a_second_are_counted_and_told_of_in_the_next() {
        let mut events = Events::default();
        let states = [MachineState::Idle, MachineState::Running];
        let mut told_of = 0;
        for (number, state) in (0..80).zip(states.into_iter().cycle()) {
            told_of += usize::from(events.next(&setpoint(number, state), 5).is_some());
        }
        assert_eq!(told_of, 50);
        let next = told(&mut events, &setpoint(80, states[0]), 1_000_000_005).expect("a second on");
        assert_eq!(next["left_out"], 30);
    }
}
