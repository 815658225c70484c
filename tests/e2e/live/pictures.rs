//! Tests of what a machinist sees: the page of a mill, a lathe and a five-axis machine, in each state, on every screen. Nothing
//! covers Hold, no text is cut, lies over another one or has to be scrolled to sideways. With `GLIDEPATH_PICTURES` each is
//! kept as a picture.

use glidepath_link::MachineState;
use glidepath_tests::{Browser, Instance, Operated, Process, Watchdog};
use rustix::process::Signal;
use serde_json::json;

use super::screens::{CUT, HOLD_IS_IN_ITS_CORNER, OVERLAPS, SIDEWAYS, resize};
use super::{Live, PATIENCE};

/// A monitor, a tablet, a panel, and a telephone both ways.
const SCREENS: [(u32, u32); 5] = [(1440, 900), (1024, 768), (800, 480), (390, 844), (844, 390)];

/// Has the page hear of a load, which no simulated spindle tells.
const LOADED: &str = "(() => { const was = heard; heard = (kind, payload) => { if (kind !== 1) return was(kind, payload); \
     const status = { ...JSON.parse(new TextDecoder().decode(payload)), spindle_load: 0.98 }; \
     return was(1, new TextEncoder().encode(JSON.stringify(status)).buffer); }; })()";

/// What is waited for at a tool change.
const TABLES: &str = "[m_codes.M6]\ndone = \"acknowledge\"\ntimeout_s = 120\n";

/// A machine that is looked at.
struct Looked<'a> {
    name: &'a str,
    theme: &'a str,
    operated: Operated<'a>,
    /// A program: a tool, the spindle as fast as it goes with both coolants, and a long way.
    program: &'a str,
}

/// Looks at a state on every screen, in the views given; a telephone has its own. All that is wrong is told together.
fn look(browser: &mut Browser, name: &str, state: &str, views: &[&str]) {
    let mut wrong = Vec::new();
    for screen in SCREENS {
        resize(browser, screen);
        let is_phone = browser.evaluate("S.phone") == true;
        let views = if is_phone { &["glance"] } else { views };
        for view in views {
            if !is_phone {
                browser.evaluate(&format!("setView('{view}')"));
            }
            // Painted at least once as it is now.
            browser.evaluate(
                "new Promise(done => requestAnimationFrame(() => setTimeout(done, 120)))",
            );
            let what = format!("{name}-{state}-{view}-{}x{}", screen.0, screen.1);
            browser.picture(&what);
            let seen = browser.evaluate(&format!(
                "[{HOLD_IS_IN_ITS_CORNER}, {CUT}, {OVERLAPS}, {SIDEWAYS}]"
            ));
            if seen != json!([true, "", "", ""]) {
                wrong.push(format!("{what}: Hold, cut, overlapping, too wide: {seen}"));
            }
        }
    }
    resize(browser, SCREENS[0]);
    browser.evaluate("setView('operate')");
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// Brings the machine from one state to the next one, and looks at each.
fn looks_well(looked: &Looked<'_>, instance: &Instance) {
    let Some(mut browser) = Browser::start(1440, 900) else {
        return;
    };
    let (name, operated) = (looked.name, &looked.operated);
    let _interpolator = operated.process(&["interpolator", "--best-effort"]);
    let servo = operated.process(&["servo", "--best-effort"]);
    let _service = operated.service();
    let _off = operated.wait_for_drives();
    let folder = instance.path("programs");
    std::fs::create_dir(&folder).unwrap();
    std::fs::write(format!("{folder}/part.ngc"), looked.program).unwrap();
    let config = ["--may", "operate", "--config", operated.config()];
    let live = Live::start(instance, &[&config[..], &["--programs", &folder]].concat());
    browser.open(&live.url);
    browser.wait("typeof S !== 'undefined' && S.operates && S.state === 'off' && SETUP.jog");
    browser.evaluate(LOADED);
    browser.evaluate(&format!("theme('{}')", looked.theme));
    look(&mut browser, name, "off", &["operate", "setup"]);

    let _on = operated.operate(&["enable"]);
    browser.wait("S.state === 'idle'");
    browser.evaluate("setView('programs')");
    browser.wait("document.querySelector('[data-name=\"part.ngc\"]')");
    browser.press("[data-name=\"part.ngc\"]");
    browser.wait("LOOK.info && LOOK.info.report");
    browser.evaluate("showTable('spindle')");
    look(
        &mut browser,
        name,
        "idle",
        &["operate", "setup", "programs"],
    );

    let _faster = operated.operate(&["override", "--spindle", "105"]);
    let running = operated.process(&["run-file", &format!("{folder}/part.ngc")]);
    browser.wait("S.state === 'awaiting' && S.status.asked && S.status.program_is_shown && PLAN");
    look(&mut browser, name, "awaiting", &["operate", "setup"]);
    let _done = operated.operate(&["acknowledge"]);
    browser.wait("S.state === 'running' && Math.abs(S.status.spindle_rpm) > 1000");
    look(&mut browser, name, "running", &["operate", "setup", "tune"]);
    let _held = operated.operate(&["hold"]);
    browser.wait("S.state === 'held'");
    look(&mut browser, name, "held", &["operate", "setup"]);
    // The drives say nothing any more.
    servo.signal(Signal::STOP);
    let _fault = operated.wait_for(MachineState::Faulted);
    browser.wait("S.state === 'faulted'");
    look(
        &mut browser,
        name,
        "faulted",
        &["operate", "setup", "health"],
    );
    // What silent drives said last is not told as so now.
    browser.wait("document.querySelector('#spin').textContent === '–'");
    browser.wait("document.querySelector('#a-fol').textContent.startsWith('Not known')");
    servo.signal(Signal::CONT);
    let _ended = running.wait();
    drop(live);
    ended(servo);
}

/// Ends the servo, whatever it has to say of the time that it stood still.
fn ended(servo: Process) {
    servo.signal(Signal::TERM);
    let _ended = servo.wait();
}

#[test]
fn a_mill_looks_well_in_every_state() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let looked = Looked {
        name: "mill",
        theme: "dark",
        operated: Operated::new(&instance, &[], &format!("\n{TABLES}")),
        program: "G21 G90 F1200\nT12 M6\n(POCKET ROUGH)\nS18000 M4 M7\nM8\nG0 X20 Y10\nG1 X160 Y80\nX0 Y0\nX160 Y80\nX0 Y0\nM2\n",
    };
    looks_well(&looked, &instance);
}

#[test]
fn a_lathe_looks_well_in_every_state() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let looked = Looked {
        name: "lathe",
        theme: "light",
        operated: Operated::shipped(&instance, "lathe", TABLES),
        program: "G18 G21 G90 G8 F300\nT12 M6\n(ROUGH)\nS2400 M4 M7\nM8\nG0 X30 Z2\nG1 Z-100\nX40\nZ2\nX20\nZ-100\nM2\n",
    };
    looks_well(&looked, &instance);
}

#[test]
fn a_five_axis_machine_looks_well_in_every_state() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let looked = Looked {
        name: "five",
        theme: "dark",
        operated: Operated::shipped(&instance, "nutating-head", TABLES),
        program: "G21 G90 F1200\nT12 M6\n(SWARF)\nS18000 M3 M7\nM8\nG0 X20 Y10\nG1 X160 Y80 B30 C90\nX0 Y0 B0 C0\nX160 Y80 B45 C-180\nM2\n",
    };
    looks_well(&looked, &instance);
}
