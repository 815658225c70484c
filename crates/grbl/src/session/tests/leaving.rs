//! What a sender leaves that goes.

use super::*;

#[test]
fn a_sender_that_is_lost_leaves_a_hold_and_the_next_one_is_told() {
    let mut desk = Desk::new();
    desk.says(b"G1 X1 F1\n");
    desk.machine.doing = Doing::Running;
    desk.is_full = true;
    desk.says(b"G1 X2\nG1 X3\nG1 X");
    desk.session.lost();
    desk.is_full = false;
    desk.looks(5);
    desk.machine.doing = Doing::Idle;
    desk.looks(5);
    assert_eq!(desk.executed, ["G1 X1 F1"]);
    desk.session.connected(desk.now);
    let said = desk.said();
    assert!(
        said.last().unwrap().contains("2 lines of it dropped"),
        "{said:?}"
    );
    assert_eq!(desk.state(), "Hold:0");
    assert_eq!(answers(&desk.says(b"~G0 X5\n")), ["ok"]);
}

/// A sender that was told `ok` for all of its lines has done what it wanted, whatever the machine still does.
#[test]
fn a_sender_that_leaves_behind_its_last_answer_is_not_lost() {
    for (doing, ahead_t) in [
        (Doing::Idle, 0.0),
        (Doing::Preparing, 0.0),
        (Doing::Waiting, 0.0),
        (Doing::Idle, 0.2),
        (Doing::Running, 0.2),
    ] {
        let mut desk = Desk::new();
        (desk.machine.doing, desk.ahead_t) = (doing, ahead_t);
        desk.session.hear(b"G1 X30 F3000\nG1 X0\n", desk.now);
        desk.looks(4);
        assert_eq!(answers(&desk.said()), ["ok", "ok"]);
        desk.session.lost();
        desk.session.connected(desk.now);
        let said = desk.said();
        assert!(!said.iter().any(|line| line.contains("was lost")));
        assert!(!desk.state().starts_with("Hold"), "{doing:?} {ahead_t}");
        (desk.machine.doing, desk.ahead_t) = (Doing::Idle, 0.0);
        desk.looks(4);
        assert_eq!(desk.state(), "Idle", "{doing:?} {ahead_t}");
        assert_eq!(answers(&desk.says(b"G0 X5\n")), ["ok"]);
    }
}

#[test]
fn a_sender_that_leaves_in_the_middle_of_a_line_is_lost() {
    let mut desk = Desk::new();
    (desk.machine.doing, desk.ahead_t) = (Doing::Running, 0.2);
    desk.session.hear(b"G1 X30 F3000\nG1 X", desk.now);
    desk.looks(4);
    assert_eq!(answers(&desk.said()), ["ok"]);
    desk.session.lost();
    desk.session.connected(desk.now);
    let said = desk.said();
    assert!(
        said.iter().any(|line| line.contains("was lost")),
        "{said:?}"
    );
    assert!(desk.state().starts_with("Hold"));
}
