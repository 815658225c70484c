//! Resets.

use super::*;

#[test]
fn a_hold_at_rest_keeps_lines_and_a_reset_out_of_it_is_no_alarm() {
    let mut desk = Desk::new();
    desk.says(b"!");
    assert_eq!(desk.state(), "Hold:0");
    assert!(desk.acts.is_empty());
    assert_eq!(answers(&desk.says(b"G0 X20\n")), [""; 0]);
    // bCNC does this after every job.
    let said = desk.says(b"\x18$G\n");
    assert!(said.contains(&"Grbl 1.1h ['$' for help]".to_owned()));
    assert_eq!(
        answers(&said),
        ["ok"],
        "the line before the reset is dropped"
    );
    assert!(!said.iter().any(|line| line.contains("ALARM")));
    assert_eq!(desk.state(), "Idle");
    assert!(desk.executed.is_empty());
    assert_eq!(desk.acts, [Act::Abort], "it stops spindle and coolant");
}

#[test]
fn a_reset_in_motion_ends_the_job_and_keeps_what_comes_behind_it() {
    let mut desk = Desk::new();
    desk.says(b"G1 X100 F100\n");
    desk.machine.doing = Doing::Running;
    desk.is_full = true;
    desk.says(b"G1 X200\nG1 X300\n");
    desk.is_full = false;
    let said = desk.says(b"\x18G55\n");
    assert!(desk.acts.contains(&Act::Abort));
    let welcome = said.iter().position(|it| it.starts_with("Grbl")).unwrap();
    assert_eq!(answers(&said[..welcome]), [""; 0]);
    assert_eq!(answers(&said[welcome..]), ["ok"]);
    assert_eq!(desk.executed, ["G1 X100 F100", "G55"]);
    assert!(!said.iter().any(|line| line.contains("ALARM")));
}

/// grbl's `mc_reset` stops spindle and coolant in every state, and `gc_init` brings the modes back to their defaults.
#[test]
fn a_reset_stops_spindle_and_coolant_and_begins_with_the_modes_of_a_start() {
    for before in [&b""[..], b"!"] {
        let mut desk = Desk::new();
        desk.says(b"G91 G55 M3 S1000\n");
        desk.facts.modes = "G1 G55 G17 G21 G91 G94 M3 M8 T0 F600 S1000".to_owned();
        desk.says(before);
        desk.acts.clear();
        let said = desk.says(b"\x18$G\n");
        assert!(desk.acts.contains(&Act::Abort), "{:?}", desk.acts);
        assert_eq!(desk.resets, 1);
        let modes = "[GC:G0 G54 G17 G21 G90 G94 M5 M9 T0 F0 S0]".to_owned();
        let place = |line: &str| said.iter().position(|it| it == line);
        let welcome = place("Grbl 1.1h ['$' for help]").unwrap();
        assert!(place(&modes).unwrap() > welcome, "{said:?}");
        // A stop leaves them as they are.
        desk.says(b"\x19");
        assert_eq!(desk.resets, 1);
    }
}

#[test]
fn a_reset_is_over_also_where_nobody_executes_lines() {
    let mut desk = Desk::new();
    desk.session.hear(b"\x18", desk.now);
    desk.session.accepted(&Act::Abort);
    desk.session.see(&desk.machine, desk.now);
    desk.session.request();
    desk.session.service_lost("nobody is there", desk.now);
    desk.session.see(&desk.machine, desk.now);
    let said = desk.said();
    assert!(said.iter().any(|line| line.starts_with("Grbl")), "{said:?}");
}

/// The abort is on its way as long as the machine has not answered: it would end what is executed behind the reset.
#[test]
fn a_reset_is_over_when_the_machine_has_heard_of_it() {
    for reset in [&b"\x18G55\n"[..], b"\x19G55\n"] {
        let mut desk = Desk::new();
        desk.is_silent = true;
        assert_eq!(desk.says(reset), [""; 0]);
        assert_eq!(desk.acts, [Act::Abort]);
        assert!(desk.executed.is_empty());
        desk.is_silent = false;
        desk.session.accepted(&Act::Abort);
        assert_eq!(answers(&desk.says(b"")), ["ok"]);
        assert_eq!(desk.executed, ["G55"]);
        assert_eq!(desk.state(), "Idle");
    }
    // Where it has nothing to end, and where nobody is there to answer, it is over as well.
    let mut desk = Desk::new();
    desk.is_silent = true;
    desk.says(b"\x18");
    desk.session
        .refused(&Act::Abort, "the interpolator does not answer");
    assert!(desk.says(b"").iter().any(|line| line.starts_with("Grbl")));
}
