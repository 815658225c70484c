//! Tests of what pages order: by role, by seat, by a finger that is down, and by the planner's
//! service.

use std::time::{Duration, Instant};

use glidepath_link::{MachineState, Status};
use glidepath_tests::{Instance, Process, Services, Watchdog};
use rustix::process::{Pid, Signal, kill_process};
use serde_json::{Value, json};

use super::{Live, PATIENCE, given_now, of_page};

/// How long the axes may take to rest once nothing is heard: two time-outs, and the way to rest of a slow jog
/// on a busy host.
const REST: Duration = Duration::from_millis(1500);

/// A page of a number, with leave to operate.
pub(super) struct Page<'l>(pub(super) &'l Live, pub(super) u64);

impl Page<'_> {
    pub(super) fn order(&self, body: &Value) -> (u16, Value) {
        let fields = format!("{}{}", self.0.token(), of_page(self.1));
        let body = given_now(body);
        let (status, said) =
            self.0
                .post("/api/command", "application/json", &fields, body.as_bytes());
        (status, serde_json::from_str(&said).unwrap_or(Value::Null))
    }

    pub(super) fn accepted(&self, body: &Value) -> Value {
        let (status, said) = self.order(body);
        assert_eq!(
            (status, &said["accepted"]),
            (200, &true.into()),
            "{body}: {said}"
        );
        said
    }

    /// One message of a finger.
    fn finger(&self, gesture: u64, number: u64, at: Instant, feed: f64) {
        let at_ms = at.elapsed().as_secs_f64() * 1e3;
        let body = json!({
            "kind": "jog", "gesture": gesture, "number": number, "at_ms": at_ms, "axes": { "X": feed },
        });
        let _said = self.accepted(&body);
    }

    fn upload(&self, query: &str, piece: &str) -> (u16, String) {
        let fields = format!("{}{}", self.0.token(), of_page(self.1));
        let path = format!("/api/upload?{query}");
        self.0
            .post(&path, "application/octet-stream", &fields, piece.as_bytes())
    }
}

pub(super) fn x(status: &Status) -> f64 {
    status.position[0]
}

/// Waits until the axes rest, and looks whether they stay.
pub(super) fn rests(services: &Services<'_>) -> Status {
    let begun = Instant::now();
    let rest = services.wait_for(MachineState::Idle);
    assert!(begun.elapsed() < REST, "{:?}", begun.elapsed());
    std::thread::sleep(Duration::from_millis(400));
    let later = services.wait(|_| true);
    assert_eq!(x(&rest).to_bits(), x(&later).to_bits());
    later
}

#[test]
fn a_page_does_what_its_role_allows_and_one_page_operates() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let services = Services::start(&instance);
    let live = Live::start(&instance, &["--may", "operate"]);
    let orders = [
        json!({ "kind": "enable" }),
        json!({ "kind": "home" }),
        json!({ "kind": "reset" }),
        json!({ "kind": "resume" }),
        json!({ "kind": "mdi", "line": "G0 X1" }),
        json!({ "kind": "sequence", "name": "go", "lines": ["G0 X1"] }),
        json!({ "kind": "jog-step", "axes": { "X": 1.0 }, "feed": 600.0 }),
        json!({ "kind": "jog", "gesture": 1, "number": 1, "at_ms": 0.0, "axes": { "X": 600.0 } }),
        json!({ "kind": "feed-override", "value": 0.5 }),
        json!({ "kind": "ask-seat" }),
    ];
    for role in ["look", "hold"] {
        let token = live.token_for(role);
        for order in &orders {
            let (status, said) = live.command(&token, &order.to_string());
            assert_eq!(status, 403, "{role}: {order}: {said}");
        }
        let hold = live.command(&token, "{\"kind\":\"hold\"}").0;
        assert_eq!(hold, if role == "hold" { 200 } else { 403 });
        let (query, bytes) = (
            "/api/upload?name=a.ngc&at=0&size=1",
            "application/octet-stream",
        );
        assert_eq!(live.post(query, bytes, &token, b"x").0, 403);
    }
    assert!(x(&services.wait(|_| true)).abs() < 1e-12);

    let (first, second) = (Page(&live, 1), Page(&live, 2));
    let slower = json!({ "kind": "feed-override", "value": 0.5 });
    let _first = first.accepted(&slower);
    let (status, said) = second.order(&slower);
    assert_eq!(status, 409);
    assert!(
        said["reason"]
            .as_str()
            .unwrap()
            .contains("another page operates"),
        "{said}"
    );
    // Neither does it put a program there.
    let (status, said) = second.upload("name=a.ngc&at=0&size=1", "x");
    assert_eq!(status, 409);
    assert!(said.contains("another page operates"), "{said}");
    // Whoever has not the seat stops the machine all the same.
    let _held = second.accepted(&json!({ "kind": "hold" }));
    assert_eq!(
        second.accepted(&json!({ "kind": "ask-seat" }))["asks"],
        true
    );
    let here = json!({ "kind": "here" });
    assert_eq!(first.accepted(&here)["asked"], true);
    let _kept = first.accepted(&json!({ "kind": "answer-seat", "give": false }));
    assert_eq!(second.order(&slower).0, 409);
    let _asks = second.accepted(&json!({ "kind": "ask-seat" }));
    let _given = first.accepted(&json!({ "kind": "answer-seat", "give": true }));
    let _second = second.accepted(&slower);
    assert_eq!(first.order(&slower).0, 409);
    // Whoever falls silent has left the seat.
    std::thread::sleep(Duration::from_millis(5300));
    let _first = first.accepted(&slower);
    drop(live);
    drop(services.end());
}

#[test]
fn axes_move_for_as_long_as_a_finger_is_down() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let services = Services::start(&instance);
    let live = Live::start(&instance, &["--may", "operate"]);
    let (page, clock) = (Page(&live, 1), Instant::now());
    let down = |gesture: u64, from: u64, count: u64| {
        for number in from..from + count {
            page.finger(gesture, number, clock, 600.0);
            std::thread::sleep(Duration::from_millis(50));
        }
    };
    // A host that has other things to do lets messages come late: then the finger comes down anew.
    let mut gestures = 7..;
    let mut moving = |count: u64| {
        loop {
            let gesture = gestures.next().unwrap();
            let from = x(&rests(&services));
            down(gesture, 1, count);
            let status = services.wait(|_| true);
            if status.state == MachineState::Jogging.code() {
                return (gesture, x(&status) - from);
            }
        }
    };
    let (gesture, way) = moving(12);
    assert!(way > 1.0, "{way}");
    // The page dies: nothing more is heard.
    let there = x(&rests(&services));
    // What it sent is sent again, late: that finger is up for good.
    down(gesture, 13, 6);
    assert_eq!(x(&rests(&services)).to_bits(), there.to_bits());

    // A finger that comes up.
    let (gesture, _) = moving(6);
    let _up = page.accepted(&json!({ "kind": "jog-end", "gesture": gesture }));
    let there = x(&rests(&services));
    down(gesture, 7, 4);
    assert_eq!(x(&rests(&services)).to_bits(), there.to_bits());

    // A hold of any page.
    let _moving = moving(6);
    let _held = live.command(&live.token_for("hold"), "{\"kind\":\"hold\"}");
    let _rest = rests(&services);

    // Steps: one is one.
    let before = x(&rests(&services));
    let _step = page.accepted(&json!({ "kind": "jog-step", "axes": { "X": 1.0 }, "feed": 600.0 }));
    let _there = services.wait(|status| (x(status) - before - 1.0).abs() < 1e-9);
    let after = x(&rests(&services));
    assert!((after - before - 1.0).abs() < 1e-9, "{before} {after}");

    // The server is stopped in the middle, and goes on later.
    let (gesture, _) = moving(6);
    let pid = Pid::from_raw(live.id().try_into().unwrap()).unwrap();
    kill_process(pid, Signal::STOP).unwrap();
    let there = x(&rests(&services));
    kill_process(pid, Signal::CONT).unwrap();
    down(gesture, 7, 4);
    assert_eq!(x(&rests(&services)).to_bits(), there.to_bits());
    drop(live);
    drop(services.end());
}

/// What waited at a server that stood still.
#[test]
fn orders_that_come_late_or_behind_an_abort_move_nothing() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let services = Services::start(&instance);
    let service = Process::service(&instance);
    let live = Live::start(&instance, &["--may", "operate"]);
    let page = Page(&live, 1);
    let line = json!({ "kind": "mdi", "line": "G21 G91 G0 X4" });
    let begun = Instant::now();
    while page.order(&line).0 != 200 {
        assert!(begun.elapsed() < Duration::from_secs(30));
        std::thread::sleep(Duration::from_millis(100));
    }
    let there = x(&rests(&services));
    let step = json!({ "kind": "jog-step", "axes": { "X": 3.0 }, "feed": 600.0 });
    let pid = Pid::from_raw(live.id().try_into().unwrap()).unwrap();
    // Within what may be on its way an abort counts for what was asked for before it.
    for (order, still) in [(&line, 3000), (&step, 3000), (&line, 300)] {
        kill_process(pid, Signal::STOP).unwrap();
        std::thread::scope(|scope| {
            let asked = scope.spawn(|| page.order(order));
            std::thread::sleep(Duration::from_millis(still));
            let _aborted = Process::join(&instance, &["abort"]).wait().expect(0);
            kill_process(pid, Signal::CONT).unwrap();
            let (status, said) = asked.join().unwrap();
            assert_eq!(status, 409, "{order}: {said}");
        });
        assert_eq!(x(&rests(&services)).to_bits(), there.to_bits(), "{order}");
    }
    let _goes_on = page.accepted(&line);
    let _there = services.wait(|status| (x(status) - there - 4.0).abs() < 1e-9);
    drop(live);
    drop(service);
    drop(services.end());
}

#[test]
fn a_page_has_lines_and_programs_of_its_folder_executed() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let services = Services::start(&instance);
    let folder = instance.path("programs");
    std::fs::create_dir(&folder).unwrap();
    let live = Live::start(&instance, &["--may", "operate", "--programs", &folder]);
    let page = Page(&live, 1);
    let line = |line: &str| json!({ "kind": "mdi", "line": line });
    // Nobody is there who could execute it.
    let (status, said) = page.order(&line("G0 X1"));
    assert_eq!(status, 409);
    assert!(
        said["reason"]
            .as_str()
            .unwrap()
            .contains("planner --listen"),
        "{said}"
    );

    let service = Process::service(&instance);
    let begun = Instant::now();
    while page.order(&line("G21 G90 G0 X2")).0 != 200 {
        assert!(begun.elapsed() < Duration::from_secs(30));
        std::thread::sleep(Duration::from_millis(100));
    }
    let _there = services.wait(|status| (x(status) - 2.0).abs() < 1e-9);
    let (status, said) = page.order(&line("G1 X9 Q"));
    assert_eq!(status, 409, "{said}");
    assert!(
        said["reason"].as_str().unwrap().contains("line 1, column"),
        "{said}"
    );

    // A program comes in two pieces, and has its name when it is whole.
    let program = "G21 G90 F3000\nG1 X20\nG1 X5\nM2\n";
    let (a, b) = program.split_at(10);
    let query = |at: usize| format!("name=part%20a.ngc&at={at}&size={}", program.len());
    assert_eq!(page.upload(&query(0), a).0, 200);
    assert_eq!(live.get("/api/programs")["count"], 0);
    assert_eq!(page.upload(&query(10), b).0, 200);
    assert_eq!(
        live.get("/api/programs")["programs"][0]["name"],
        "part a.ngc"
    );
    assert_eq!(page.upload(&query(0), a).0, 412);
    assert_eq!(page.upload("name=..%2Fa.ngc&at=0&size=1", "x").0, 409);
    let begun = Instant::now();
    let planned = loop {
        let preview = live.get("/api/preview?name=part%20a.ngc");
        if preview["seconds"].is_number() && preview["report"].is_object() {
            break preview;
        }
        assert!(begun.elapsed() < Duration::from_secs(30), "{preview}");
        std::thread::sleep(Duration::from_millis(50));
    };
    assert!(planned["seconds"].as_f64().unwrap() > 0.5, "{planned}");

    let looked_at = &planned["fingerprint"];
    let run = json!({ "kind": "run", "name": "part a.ngc", "program": looked_at });
    let _runs = page.accepted(&run);
    let told = live.told(|status| status["active_program"]["name"] == "part a.ngc");
    assert_eq!(told["active_program"]["bytes"], program.len());
    let ended = |status: &Value| status["page_jobs"][0]["state"] == "done";
    let _done = live.told(|status| ended(status) && status["day"][0]["name"] == "part a.ngc");
    let _there = services.wait(|status| (x(status) - 5.0).abs() < 1e-9);
    // From a line: what happens is told before anything does.
    let mut from = run.clone();
    from["from_line"] = 3.into();
    let said = page.accepted(&from);
    assert!(
        said["to_confirm"].as_str().unwrap().contains("line 3"),
        "{said}"
    );
    assert!((x(&services.wait_for(MachineState::Idle)) - 5.0).abs() < 1e-9);
    from["agreed"] = true.into();
    let _agreed = page.accepted(&from);
    let _done = live.told(|status| {
        status["day"]
            .as_array()
            .is_some_and(|jobs| jobs.iter().filter(|job| job["end"] == "done").count() >= 3)
    });
    // Programs are those of the folder.
    let outside = json!({ "kind": "run", "name": "../machine.toml", "program": looked_at });
    let (status, said) = page.order(&outside);
    assert_eq!(status, 409, "{said}");
    drop((live, service));
    drop(services.end());
}
