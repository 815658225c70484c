//! Tests of the unit in which a page shows and takes lengths, and of X of a lathe, which is a diameter there. What is in
//! force for lines that somebody types stays as it is.

use glidepath_link::MachineState;
use glidepath_tests::{Browser, Instance, Process, Watchdog};
use serde_json::json;

use super::life::{HALF, press};
use super::{Live, PATIENCE};

/// A machine that only simulates, and keeps what it is set up with.
struct Machine<'i> {
    instance: &'i Instance,
    config: String,
}

impl<'i> Machine<'i> {
    fn new(instance: &'i Instance, text: &str) -> Self {
        let state = instance.path("state");
        std::fs::create_dir(&state).unwrap();
        let kept = format!("directory = \"{state}\"");
        let text = match text.contains("# directory = \"state\"") {
            true => text.replace("# directory = \"state\"", &kept),
            false => format!("{text}\n[state]\n{kept}\n"),
        };
        let config = instance.file("machine.toml", &text);
        Self { instance, config }
    }

    fn process(&self, arguments: &[&str]) -> Process {
        let config = ["--config", &self.config];
        Process::join(self.instance, &[arguments, &config].concat())
    }

    fn line(&self, line: &str) {
        let _done = self.process(&["mdi", line]).wait().expect(0);
    }

    fn position(&self, axis: usize) -> f64 {
        let idle = MachineState::Idle.code();
        let status = self.instance.wait_for_status(|now| now.state == idle);
        status.position[axis]
    }

    fn is_at(&self, axis: usize, mm: f64) {
        let idle = MachineState::Idle.code();
        let is_there = |at: f64| (at - mm).abs() < 1e-6;
        let _there = self
            .instance
            .wait_for_status(|now| now.state == idle && is_there(now.position[axis]));
    }
}

/// Opens the sheet of an axis, and writes into it.
fn write(browser: &mut Browser, axis: &str, text: &str) {
    browser.press(&format!("#s{axis}"));
    browser.wait("document.querySelector('#number') === document.activeElement");
    browser.evaluate(&format!(
        "document.querySelector('#number').value = '{text}'"
    ));
}

fn shown(browser: &mut Browser, selector: &str) -> String {
    let text = browser.evaluate(&format!("document.querySelector('{selector}').textContent"));
    text.as_str().unwrap().to_owned()
}

#[test]
fn lengths_are_shown_and_typed_in_inches_and_modes_stay() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let Some(mut browser) = Browser::start(1024, 768) else {
        return;
    };
    let table = instance.file("tools.tbl", "T1 P1 Z50.8 D6.35\n");
    let printed = Process::start(&instance, &["config", "--default"]).wait();
    let tools = (
        "# tool_table = \"tools.tbl\"",
        format!("tool_table = \"{table}\""),
    );
    let text = printed.expect(0).stdout.replace(tools.0, &tools.1);
    let machine = Machine::new(&instance, &text);
    let interpolator = machine.process(&["interpolator", "--best-effort"]);
    let service = machine.process(&["planner", "--listen"]);
    service.wait_until_it_is_ready();
    let _ready = machine.position(0);
    // Inches, increments, feeds per revolution: whoever typed that finds it again.
    machine.line("G21 G90 G0 X25.4 Y12.7");
    machine.line("G20 G91 G95 F0.1");
    let live = Live::start(
        &instance,
        &["--may", "operate", "--config", &machine.config],
    );
    browser.open(&live.url);
    browser.wait(
        "typeof S !== 'undefined' && S.operates && S.state === 'idle' && SETUP.jog && RINGED.count",
    );
    browser.evaluate("setView('setup')");
    browser.wait("document.querySelector('#sX').textContent === '25.400'");
    browser.press("#setdro [data-do=unit]");
    browser.wait("document.querySelector('#sX').textContent === '1.0000'");
    assert_eq!(shown(&mut browser, "#jogmm"), "23.6 in/min");
    let steps = browser.evaluate("$$('#steps button').map(b => b.textContent)");
    assert_eq!(
        steps,
        json!(["while pressed", "0.1", "0.01", "0.001", "0.0001"])
    );

    // A value, with its unit or in that of the page.
    for (text, zero_mm) in [("0.5", 12.7), ("12.7 mm", 12.7), ("0,25in", 19.05)] {
        write(&mut browser, "X", text);
        press(
            &mut browser,
            "#sheet [data-do=value]",
            core::time::Duration::ZERO,
        );
        browser.wait(&format!(
            "active() && Math.abs(active().origin.X - {zero_mm}) < 1e-9"
        ));
        browser.wait("S.sheet === null");
    }
    browser.wait("document.querySelector('#undo').textContent.includes('was 0.5000')");
    write(&mut browser, "X", "1");
    press(&mut browser, "#sheet [data-do=go-to]", HALF);
    machine.is_at(0, 19.05 + 25.4);
    browser.wait("S.sheet === null && S.state === 'idle'");
    browser.press("#steps [data-step=\"0.1\"]");
    browser.press(".jog[aria-label=\"move Y−\"]");
    machine.is_at(1, 12.7 - 2.54);

    // Tables.
    browser.evaluate("showTable('tools')");
    let cells = browser.evaluate("$$('#table .cell').map(b => b.textContent)");
    assert_eq!(cells, json!(["2.0000", "0.2500"]));
    browser.press("#table .cell");
    browser.evaluate("S.editing.value = '3'");
    let enter = json!({ "type": "keyDown", "key": "Enter", "code": "Enter" });
    let _entered = browser.call("Input.dispatchKeyEvent", &enter);
    browser.wait("Math.abs(SETUP.tools[0].offset.Z - 76.2) < 1e-9 && !S.editing");
    browser.wait("document.querySelector('#undo').textContent.includes('was 2.0000')");

    // Another page of this browser has the same unit, and Run shows it.
    browser.open("about:blank");
    browser.open(&live.url);
    browser.wait("typeof S !== 'undefined' && S.status && RINGED && RINGED.count && UNIT.inch");
    browser.wait("document.querySelector('#wX').textContent === '1.0000'");
    assert_eq!(shown(&mut browser, "#dro [data-do=unit]"), "in");
    assert_eq!(shown(&mut browser, "[data-unit=feed]"), "in/min");

    // One inch further, as somebody left it.
    machine.line("G0 X1");
    machine.is_at(0, 19.05 + 50.8);
    drop(live);
    for process in [service, interpolator] {
        let _ended = process.end().expect(0);
    }
}

#[test]
fn x_of_a_lathe_is_a_diameter() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let Some(mut browser) = Browser::start(1024, 768) else {
        return;
    };
    let config = concat!(env!("CARGO_MANIFEST_DIR"), "/../config/lathe.toml");
    let machine = Machine::new(&instance, &std::fs::read_to_string(config).unwrap());
    let interpolator = machine.process(&["interpolator", "--best-effort"]);
    let service = machine.process(&["planner", "--listen"]);
    service.wait_until_it_is_ready();
    let _ready = machine.position(0);
    machine.line("G21 G90 G8 G0 X20 Z-5");
    // Radii, as programs have them unless they say G7.
    let live = Live::start(
        &instance,
        &["--may", "operate", "--config", &machine.config],
    );
    browser.open(&live.url);
    browser.wait(
        "typeof S !== 'undefined' && S.operates && S.state === 'idle' && SETUP.jog && RINGED.count",
    );
    browser.evaluate("setView('setup')");
    browser.wait("document.querySelector('#sX').textContent === '40.000'");
    assert_eq!(shown(&mut browser, "#smX"), "40.000");
    assert_eq!(shown(&mut browser, "#sZ"), "−5.000");
    // The part has a diameter of 30 where the tool stands.
    write(&mut browser, "X", "30");
    press(
        &mut browser,
        "#sheet [data-do=value]",
        core::time::Duration::ZERO,
    );
    browser.wait("active() && active().origin.X === 5 && S.sheet === null");
    browser.wait("document.querySelector('#sX').textContent === '30.000'");
    browser.evaluate("showTable('offsets')");
    assert_eq!(shown(&mut browser, "#table .cell"), "10.000");
    browser.press("#steps [data-step=\"1\"]");
    browser.press(".jog[aria-label=\"move X−\"]");
    machine.is_at(0, 19.5);
    browser.wait("document.querySelector('#sX').textContent === '29.000'");
    write(&mut browser, "X", "20");
    press(&mut browser, "#sheet [data-do=go-to]", HALF);
    machine.is_at(0, 15.0);
    // For whoever types X is what it was: a radius.
    machine.line("G0 X7");
    machine.is_at(0, 12.0);
    machine.line("G7");
    browser.wait("S.state === 'idle'");
    browser.press("#sX");
    press(
        &mut browser,
        "#sheet [data-do=zero]",
        core::time::Duration::ZERO,
    );
    browser.wait("active().origin.X === 12");
    machine.line("G0 X7");
    machine.is_at(0, 15.5);
    drop(live);
    for process in [service, interpolator] {
        let _ended = process.end().expect(0);
    }
}
