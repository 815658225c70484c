//! Tests of touching off on the page: the part zero and the length of a tool from where a probe touched, and the way
//! back to what was in force before.

use glidepath_link::MachineState;
use glidepath_tests::{Browser, Instance, Operated, Watchdog};

use super::life::{HALF, press};
use super::{Live, PATIENCE};

/// Where the imitated part begins, machine coordinates, mm.
const PART_Z: f64 = -7.25;
/// How exactly a drive says where it touched at 100 mm/min, mm.
const EXACT: f64 = 0.02;

fn write(browser: &mut Browser, name: &str, value: &str) {
    let script = format!(
        "(() => {{ const field = document.querySelector('[data-touch={name}]'); field.value = '{value}'; \
         field.dispatchEvent(new Event('input', {{ bubbles: true }})); }})()"
    );
    browser.evaluate(&script);
}

fn number(browser: &mut Browser, expression: &str) -> f64 {
    browser.evaluate(expression).as_f64().unwrap()
}

/// Probing a place is one job: nobody else gets in between.
fn touches(browser: &mut Browser) {
    let jobs = |browser: &mut Browser| {
        browser.wait("S.status.page_jobs.every(job => job.state !== 'running')");
        number(browser, "S.status.page_jobs.length")
    };
    let before = jobs(browser);
    browser.evaluate("TOUCH.step = 0");
    // A key that is painted anew under the finger, as the table is when the tool becomes known, does nothing.
    while browser.evaluate("TOUCH.step") == 0 {
        press(browser, "#table [data-do=touch-go]", HALF);
    }
    browser.wait("TOUCH.step === 4 || TOUCH.says");
    assert_eq!(browser.evaluate("TOUCH.says"), "");
    let after = jobs(browser);
    assert!((after - before - 1.0).abs() < 1e-9, "{before} {after}");
}

/// What cannot be is said on the key.
fn numbers_are_looked_at(browser: &mut Browser) {
    let key = "document.querySelector('#table [data-do=touch-go]')";
    for (field, wrong, right, why) in [
        ("feed", "90000", "100", "the feed is at most"),
        ("reach", "-1", "30", "the way is more than 0"),
        ("plate", "", "5", "a number is missing"),
    ] {
        write(browser, field, wrong);
        browser.wait(&format!(
            "{key}.textContent.includes('{why}') && {key}.getAttribute('aria-disabled')"
        ));
        write(browser, field, right);
    }
}

/// Cells of tables, and an undo beside somebody else's changes.
fn tables_are_shared(browser: &mut Browser, bench: &Operated<'_>) {
    // A cell that is pressed is edited for as long as nobody leaves it.
    browser.evaluate("showTable('offsets')");
    browser.press("#table [data-do=edit]");
    assert_eq!(
        browser.evaluate("S.editing === document.activeElement"),
        true
    );
    browser.evaluate("(S.editing.blur(), showTable('touch'))");

    // What somebody else has set since is not set back, and what is no plain number is none.
    browser.evaluate("offerUndo(zeroToUndo('Z'))");
    bench.operate(&["mdi", "G21 G10 L2 P1 X1.5"]);
    browser.wait("active().origin.X === 1.5 && S.undo.after");
    bench.operate(&["mdi", "G21 G10 L2 P1 X1"]);
    browser.wait("active().origin.X === 1 && S.undo === null");
    let read = browser.evaluate("['+1,5', '−.5', '1e3', '0x10', '', '1,000.5'].map(numberOf)");
    assert_eq!(read, serde_json::json!([1.5, -0.5, null, null, null, null]));
}

#[test]
fn part_zero_and_the_length_of_a_tool_are_touched_off() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let Some(mut browser) = Browser::start(1024, 768) else {
        return;
    };
    let state = instance.path("state");
    std::fs::create_dir(&state).unwrap();
    let kept = format!("directory = \"{state}\"");
    let table = format!(
        "tool_table = \"{}\"",
        instance.file("tools.tbl", "T1 P1 Z50 D6\n")
    );
    let changes = [
        ("inputs_outputs = \"none\"", "inputs_outputs = \"feedback\""),
        ("# input = 0\n", "input = 0\n"),
        ("# directory = \"state\"", kept.as_str()),
        ("# tool_table = \"tools.tbl\"", table.as_str()),
    ];
    let bench = Operated::new(&instance, &changes, "");
    let interpolator = bench.process(&["interpolator", "--best-effort"]);
    let probe = format!("J2={PART_Z}");
    let servo = bench.process(&[
        "servo",
        "--best-effort",
        "--stands",
        "1,2,10",
        "--probe",
        &probe,
    ]);
    let _seen = bench.wait_for_drives();
    let service = bench.service();
    bench.operate(&["enable"]);
    let _ready = bench.wait_for(MachineState::Idle);
    bench.operate(&["mdi", "G21 G10 L2 P1 X1 Y2 Z3"]);
    let live = Live::start(&instance, &["--may", "operate", "--config", bench.config()]);
    browser.open(&live.url);
    browser.wait(
        "typeof S !== 'undefined' && S.operates && S.state === 'idle' && SETUP.probe && active()",
    );
    browser.evaluate("setView('setup')");
    browser.press("#tables-tabs .t-touch");

    numbers_are_looked_at(&mut browser);
    assert!((bench.position()[2] - 10.0).abs() < 1e-9);

    // A plate of 5 mm lies on the part.
    touches(&mut browser);
    browser.wait("Math.abs(active().origin.Z - 3) > 1");
    let zero = number(&mut browser, "active().origin.Z");
    assert!((zero - (PART_Z - 5.0)).abs() < EXACT, "{zero}");
    // X and Y stay as they were. The tool rests behind the contact, and goes 2 mm back from there.
    let stay = "active().origin.X === 1 && active().origin.Y === 2";
    assert_eq!(browser.evaluate(stay), true);
    let above = bench.position()[2] - PART_Z;
    assert!(above > 1.5 && above < 2.0 + EXACT, "{above}");

    // What was in force before comes back.
    press(
        &mut browser,
        "#undo [data-do=undo]",
        core::time::Duration::ZERO,
    );
    browser.wait("active().origin.Z === 3 && !document.querySelector('#undo').textContent");

    tables_are_shared(&mut browser, &bench);

    // The length of the tool in the spindle, over the same plate: the part is at -15 of the program.
    let change = bench.process(&["mdi", "T1 M6"]);
    let _asked = bench.wait_for(MachineState::Awaiting);
    bench.operate(&["acknowledge"]);
    let _in_the_spindle = change.wait().expect(0);
    browser.wait("S.status.tool === 1 && S.state === 'idle'");
    write(&mut browser, "place", "-15");
    browser.press("[data-kind=of][data-value=length]");
    touches(&mut browser);
    browser.wait("SETUP.tools[0].offset.Z !== 50");
    let length = number(&mut browser, "SETUP.tools[0].offset.Z");
    assert!((length - (PART_Z - 3.0 + 10.0)).abs() < EXACT, "{length}");
    assert_eq!(browser.evaluate("active().origin.Z"), 3);
    let above = bench.position()[2] - PART_Z;
    assert!(above > 1.5 && above < 2.0 + EXACT, "{above}");

    // Nothing is there: the probing move says so, and nothing is set.
    write(&mut browser, "reach", "0.5");
    press(&mut browser, "#table [data-do=touch-go]", HALF);
    browser.wait("TOUCH.says.includes('no contact within')");
    assert!((number(&mut browser, "SETUP.tools[0].offset.Z") - length).abs() < 1e-12);
    drop(live);
    for process in [service, servo, interpolator] {
        let _ended = process.end().expect(0);
    }
}
