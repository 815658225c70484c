//! Questions, which are answered in every state.

use super::*;
use crate::Spindle;

const QUESTIONS: [(&str, &str); 4] = [
    ("$$", "$110="),
    ("$I", "[VER:"),
    ("$#", "[G54:"),
    ("$G", "[GC:"),
];

#[test]
fn questions_are_answered_whatever_the_machine_does() {
    for doing in [
        Doing::Idle,
        Doing::Running,
        Doing::Holding,
        Doing::Held,
        Doing::ProgramStop,
        Doing::AwaitingTool,
        Doing::Stopping,
        Doing::Jogging,
        Doing::Homing,
        Doing::NotHomed,
        Doing::Off,
        Doing::Faulted,
    ] {
        let mut desk = Desk::new();
        desk.machine.doing = doing;
        desk.look();
        for (question, answer) in QUESTIONS {
            let said = desk.says(format!("{question}\n").as_bytes());
            assert_eq!(answers(&said), ["ok"], "{doing:?} {question}");
            let is_told = said.iter().any(|line| line.starts_with(answer));
            assert!(is_told, "{doing:?} {question}: {said:?}");
        }
    }
}

/// M0 is answered when somebody goes on. What is asked meanwhile is told at once, and its `ok` keeps its place.
#[test]
fn questions_behind_a_line_that_waits_are_told_at_once() {
    let mut desk = Desk::new();
    desk.is_full = true;
    desk.says(b"M0\n");
    desk.machine.doing = Doing::ProgramStop;
    desk.looks(3);
    assert_eq!(desk.state(), "Hold:0");
    for (question, answer) in QUESTIONS {
        let said = desk.says(format!("{question}\n").as_bytes());
        assert_eq!(answers(&said), [""; 0], "{question}");
        let told = said.iter().filter(|line| line.starts_with(answer)).count();
        assert_eq!(told, 1, "{question}: {said:?}");
    }
    desk.is_full = false;
    let said = desk.says(b"~");
    assert_eq!(said, ["ok"; 5], "nothing is told twice");
}

/// An abort by somebody else stops spindle and coolant; the service still has what the last line left.
#[test]
fn modes_say_of_spindle_and_coolant_what_is_so() {
    let mut desk = Desk::new();
    desk.facts.modes = "G1 G54 G17 G21 G90 G94 M3 M7 M8 T0 F600 S1000".to_owned();
    (desk.machine.spindle, desk.machine.flood) = (Spindle::Clockwise, true);
    desk.looks(1);
    let said = desk.says(b"$G\n");
    assert!(said[0].contains(" G94 M3 M8 T0"), "{said:?}");
    (desk.machine.spindle, desk.machine.flood) = (Spindle::Off, false);
    desk.looks(1);
    let said = desk.says(b"$G\n");
    assert!(said[0].contains(" G94 M5 M9 T0"), "{said:?}");
}
