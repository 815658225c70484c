//! Tests of the page, which follows the machine: it shows what runs, whoever began it, and never
//! another program.

use std::process::Stdio;

use glidepath_link::MachineState;
use glidepath_tests::{Browser, Instance, Operated, Process, Services, Watchdog};
use serde_json::{Value, json};

use super::{Live, PATIENCE};
use crate::programs::long_program;

fn runs(status: &Value, name: &str) -> bool {
    status["end_of_epoch"] == "open" && status["active_program"]["name"] == name
}

#[test]
fn a_page_shows_what_runs_whoever_began_it() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let first = instance.file("first.ngc", &long_program());
    let second = instance.file("second.ngc", &format!("(second)\n{}", long_program()));
    let services = Services::start(&instance);
    let live = Live::start(&instance, &[]);
    assert_eq!(live.get("/api/plan")["program"], Value::Null);

    for (program, name, line) in [
        (&first, "first.ngc", "G21 G90 F3000"),
        (&second, "second.ngc", "(second)"),
    ] {
        let planner = Process::join(&instance, &["planner", program]);
        let _moving = services.wait_for(MachineState::Running);
        let told = live.told(|status| runs(status, name) && status["program_is_shown"] == true);
        let bytes = std::fs::metadata(program).unwrap().len();
        assert_eq!(told["active_program"]["bytes"], bytes);
        let plan = live.get("/api/plan");
        assert_eq!(plan["program"]["name"], name);
        let generation = plan["generation"].as_u64().unwrap();
        let lines = |of: u64| live.get(&format!("/api/lines?of={of}&from=1&count=1"));
        assert_eq!(lines(generation), json!([line]));
        // Whoever has no page is told, too.
        let status = Process::join(&instance, &["status", "--json"]).wait();
        let status = status.expect(0).json();
        assert_eq!(status["active_program"], told["active_program"]);
        assert_eq!(status["active_program"]["file"], program.as_str());
        let text = Process::join(&instance, &["status"]).wait().expect(0);
        assert!(text.stdout.contains(name), "{}", text.stdout);
        let abort = Process::join(&instance, &["abort"]).wait();
        let _aborted = abort.expect(0);
        drop(planner.wait());
        let _idle = services.wait_for(MachineState::Idle);
    }
    drop(live);
    drop(services.end());
}

#[test]
fn nothing_of_another_program_is_shown_in_the_place_of_what_runs() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let given = instance.file("given.ngc", &long_program());
    let services = Services::start(&instance);
    let live = Live::start(&instance, &[&given]);
    let before = live.told(|_| true);
    assert_eq!(before["program_is_shown"], false);

    // A pipe has no text that could be read again.
    let mut pipe = Process::join_with(&instance, &["planner", "-"], Stdio::piped());
    pipe.feed(&long_program());
    let _moving = services.wait_for(MachineState::Running);
    let told = live.told(|status| status["end_of_epoch"] == "open");
    assert_eq!(told["active_program"], Value::Null);
    assert_eq!(told["program_is_shown"], false);
    for of_another in ["program", "block_text", "progress", "place"] {
        assert_eq!(told[of_another], Value::Null, "{of_another}");
    }
    assert!(
        told["job"]["text"]
            .as_str()
            .unwrap()
            .starts_with("standard input")
    );
    let _aborted = Process::join(&instance, &["abort"]).wait().expect(0);
    drop(pipe.wait());
    let _idle = services.wait_for(MachineState::Idle);

    // A file that becomes another text while it runs is not shown with that.
    let planner = Process::join(&instance, &["planner", &given]);
    let moving = services.wait_for(MachineState::Running);
    let _shown =
        live.told(|status| runs(status, "given.ngc") && status["program_is_shown"] == true);
    let edited = instance.path("edited.ngc");
    std::fs::write(&edited, "G0 X1 (edited)\n").unwrap();
    std::fs::rename(&edited, &given).unwrap();
    let late = Live::start(&instance, &[]);
    let told = late
        .told(|status| runs(status, "given.ngc") && late.get("/api/plan")["program"]["lines"] == 1);
    assert_eq!(told["program_is_shown"], false);
    assert_eq!(told["block_text"], Value::Null);
    // It runs on: who shows it disturbs nobody.
    let _on = services.wait(|status| status.frames_executed > moving.frames_executed);
    let _aborted = Process::join(&instance, &["abort"]).wait().expect(0);
    drop((live, late, planner.wait()));
    drop(services.end());
}

/// What has no plan that could be drawn is followed all the same.
#[test]
fn a_page_without_a_plan_goes_on_painting() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let Some(mut browser) = Browser::start(1024, 768) else {
        return;
    };
    let services = Services::start(&instance);
    let live = Live::start(&instance, &[]);
    browser.open(&live.url);
    browser.wait("typeof S !== 'undefined' && S.state === 'idle'");
    let mut pipe = Process::join_with(&instance, &["planner", "-"], Stdio::piped());
    pipe.feed(&long_program());
    browser.wait("S.state === 'running' && PLAN === null && S.status.feed_mm_s > 1");
    // Where the motion is may be known before its plan has come.
    let drawn = browser.evaluate("(SPACE.draw(3), SPACE.draw(9), true)");
    assert_eq!(drawn, true);
    let painted = browser.evaluate("FRAMES.count").as_u64().unwrap();
    browser.wait(&format!("FRAMES.count > {painted} + 20"));
    let _held = Process::join(&instance, &["hold"]).wait().expect(0);
    browser.wait("document.querySelector('#word').textContent.startsWith('Held')");
    let _aborted = Process::join(&instance, &["abort"]).wait().expect(0);
    drop((live, pipe.wait()));
    drop(services.end());
}

#[test]
fn a_person_is_told_in_full_what_is_asked() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let table = instance.file(
        "tools.tbl",
        "T1 P1 Z50 D6 ; end mill\nT4 P4 Z118.25 D5 ; drill\n",
    );
    let changes = [("# tool_table = \"tools.tbl\"", "tool_table = \"tools.tbl\"")];
    let tables = "\n[m_codes.M6]\ntimeout_s = 60\n";
    let operated = Operated::new(&instance, &changes, tables);
    assert!(table.ends_with("tools.tbl"));
    let _interpolator = operated.process(&["interpolator", "--best-effort"]);
    let _servo = operated.process(&["servo", "--best-effort"]);
    let _drives = operated.wait_for_drives();
    operated.operate(&["enable"]);
    let program = instance.file(
        "tools.ngc",
        "G21 G90 F3000\nT1 M6\nG1 X5\nT4 M6\nG1 X0\n(MSG, look at the vice)\nM0 (measure the pocket)\nM2\n",
    );
    let live = Live::start(&instance, &["--config", operated.config()]);
    let planner = operated.process(&["planner", &program]);
    let _asked = operated.wait_for(MachineState::Awaiting);
    operated.operate(&["acknowledge"]);
    let told = live.told(|status| status["asked"]["tools"]["wanted"]["number"] == 4);
    let asked = &told["asked"];
    assert_eq!(
        (&asked["what"], &asked["line"]),
        (&"tool".into(), &4.into())
    );
    assert_eq!(
        asked["tools"]["wanted"],
        json!({ "number": 4, "name": "drill", "diameter_mm": 5.0, "length_mm": 118.25 })
    );
    assert_eq!(asked["tools"]["before"]["name"], "end mill");
    operated.operate(&["acknowledge"]);
    // What the program says is told a moment behind the state.
    let told = live.told(|status| status["asked"]["says"] == "measure the pocket");
    assert_eq!(told["asked"]["what"], "stop");
    operated.operate(&["resume"]);
    drop((planner.wait(), live));
}
