//! Tests of programs that are looked at before they run: each is planned once, whoever looks at others, and what
//! runs is what was looked at.

use std::time::{Duration, Instant};

use glidepath_link::MachineState;
use glidepath_tests::{Browser, Instance, Process, Services, Watchdog};
use serde_json::{Value, json};

use super::hands::{Page, x};
use super::{Live, PATIENCE};

/// What is known of a program once its fingerprint is.
fn looked_at(live: &Live, query: &str) -> Value {
    let begun = Instant::now();
    loop {
        let preview = live.get(&format!("/api/preview?{query}"));
        if preview["fingerprint"].is_string() {
            return preview;
        }
        assert!(begun.elapsed() < Duration::from_secs(60), "{preview}");
        std::thread::sleep(Duration::from_millis(20));
    }
}

#[test]
fn what_runs_is_what_was_looked_at() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let folder = instance.path("programs");
    std::fs::create_dir(&folder).unwrap();
    let write = |name: &str, text: &str| std::fs::write(format!("{folder}/{name}"), text).unwrap();
    write("part.ngc", "G21 G90 F3000\nG1 X2\nO<more> CALL\nX3\nM2\n");
    write("more.ngc", "O<more> SUB\nG1 Y1\nO<more> ENDSUB\nM2\n");
    let services = Services::start(&instance);
    let service = Process::service(&instance);
    let live = Live::start(&instance, &["--may", "operate", "--programs", &folder]);
    let page = Page(&live, 1);
    let run = |program: &Value| json!({ "kind": "run", "name": "part.ngc", "program": program });
    let begun = Instant::now();
    while page
        .order(&json!({ "kind": "mdi", "line": "G21 G90 G0 X0" }))
        .0
        != 200
    {
        assert!(begun.elapsed() < Duration::from_secs(30));
        std::thread::sleep(Duration::from_millis(100));
    }

    // Nobody runs what nobody has looked at.
    let unseen = page.order(&json!({ "kind": "run", "name": "part.ngc" }));
    assert_eq!(unseen.0, 400, "{unseen:?}");
    for none in ["", "0000000000000000", "1"] {
        assert_eq!(page.order(&run(&none.into())).0, 400, "{none}");
    }
    let first = looked_at(&live, "name=part.ngc");
    // The text, or that of a subroutine, is another one by now. The service looks at it, not the page.
    for (name, text) in [
        ("part.ngc", "G21 G90 F3000\nG1 X200\nO<more> CALL\nM2\n"),
        ("more.ngc", "O<more> SUB\nG1 Y100\nO<more> ENDSUB\nM2\n"),
    ] {
        let before = std::fs::read_to_string(format!("{folder}/{name}")).unwrap();
        write(name, text);
        for agreed in [json!({}), json!({ "from_line": 2, "agreed": true })] {
            let mut order = run(&first["fingerprint"]);
            for (field, value) in agreed.as_object().unwrap() {
                order[field] = value.clone();
            }
            let (status, said) = page.order(&order);
            assert_eq!(status, 412, "{name}: {said}");
            let reason = said["reason"].as_str().unwrap();
            assert!(reason.contains("not the text any more"), "{reason}");
        }
        assert!(x(&services.wait_for(MachineState::Idle)).abs() < 1e-9);
        write(name, &before);
    }
    // It is the same text again, and runs.
    let _runs = page.accepted(&run(&first["fingerprint"]));
    let _there = services.wait(|status| (x(status) - 3.0).abs() < 1e-9);
    let _idle = services.wait_for(MachineState::Idle);
    // A subroutine that has changed is not seen from here: it is looked at anew where the service says so.
    write("more.ngc", "O<more> SUB\nG1 Y2\nO<more> ENDSUB\nM2\n");
    let anew = looked_at(&live, "name=part.ngc&look=anew");
    assert_ne!(anew["fingerprint"], first["fingerprint"]);
    let _runs = page.accepted(&run(&anew["fingerprint"]));
    let _there = services.wait(|status| (status.position[1] - 2.0).abs() < 1e-9);
    drop((live, service));
    drop(services.end());
}

/// Opens the page, and chooses a program.
fn choose(browser: &mut Browser, live: &Live, name: &str) {
    browser.open(&live.url);
    browser.wait("typeof S !== 'undefined' && S.may === 'operate' && S.status");
    browser.evaluate("setView('programs')");
    browser.wait(&format!("document.querySelector('[data-name=\"{name}\"]')"));
    browser.press(&format!("[data-name=\"{name}\"]"));
}

#[test]
fn pages_that_look_at_different_programs_see_all_of_them() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let Some(mut first) = Browser::start(1024, 768) else {
        return;
    };
    let mut second = Browser::start(1024, 768).unwrap();
    let folder = instance.path("programs");
    std::fs::create_dir(&folder).unwrap();
    // Long enough that both are being planned at the same time.
    for (name, reach) in [("a.ngc", 11), ("b.ngc", 13)] {
        let lines = (0..250).map(|n| format!("G1 X{} Y{}\n", n % reach, n % 7));
        let text = format!("G21 G90 F3000\n{}M2\n", lines.collect::<String>());
        std::fs::write(format!("{folder}/{name}"), text).unwrap();
    }
    for name in ["c.ngc", "d.ngc", "e.ngc"] {
        std::fs::write(format!("{folder}/{name}"), "G21 G90 F600\nG1 X1\nM2\n").unwrap();
    }
    let services = Services::start(&instance);
    let live = Live::start(&instance, &["--may", "operate", "--programs", &folder]);
    choose(&mut first, &live, "a.ngc");
    choose(&mut second, &live, "b.ngc");
    let has_all = "LOOK.info && LOOK.info.report && LOOK.motion && LOOK.lines.length === 40";
    first.wait(has_all);
    second.wait(has_all);
    for (browser, name) in [(&mut first, "a.ngc"), (&mut second, "b.ngc")] {
        assert_eq!(browser.evaluate("LOOK.info.program.name"), name);
    }
    // The first page operates: what it looks at is there however much others look at, also where they say that they
    // are the page that operates.
    for name in ["c.ngc", "d.ngc", "e.ngc"] {
        second.press(&format!("[data-name=\"{name}\"]"));
        second.wait(&format!("{has_all} || (LOOK.info && LOOK.info.report && LOOK.lines.length === 3 && LOOK.info.program.name === '{name}')"));
    }
    let operates = first.evaluate("S.operates && PAGE");
    let same = format!("X-Glidepath-Page: {}\r\n", operates.as_str().unwrap());
    let only_looks = format!("{}{same}", live.token_for("look"));
    for name in ["b", "c", "d", "b", "c", "d"] {
        let path = format!("/api/preview?name={name}.ngc&look=");
        let _looked = live.get_with(&only_looks, path.trim_end_matches("&look="));
        let _looked = live.get_with(&only_looks, &format!("{path}anew"));
    }
    let still = first.evaluate("lookAtChosen().then(() => [LOOK.lost, !!LOOK.motion, whyNoRun()])");
    assert_eq!(still, json!(["", true, ""]), "nothing was taken from it");
    // Others have a few. Of one that was given up the page says so, and has it planned again only if somebody wants it.
    let count = live.get("/api/preview?name=d.ngc&look=again")["generation"].clone();
    second.evaluate("lookAtChosen()");
    second.wait("document.querySelector('#found').textContent.includes('was given up')");
    assert_eq!(second.evaluate("whyNoRun() !== ''"), true);
    let again = live.get("/api/preview?name=d.ngc&look=again")["generation"].clone();
    assert_eq!(count, again, "the others are left alone");
    second.press("#found [data-do=choose]");
    second.wait("LOOK.info && LOOK.info.report && LOOK.lines.length === 3");
    drop(live);
    drop(services.end());
}

/// What `check` warns of is shown of a program that is chosen, in the same words.
#[test]
fn what_a_program_does_not_say_is_shown_before_it_runs() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let Some(mut browser) = Browser::start(1024, 768) else {
        return;
    };
    let folder = instance.path("programs");
    std::fs::create_dir(&folder).unwrap();
    for (name, text) in [
        ("cut-off.ngc", "G21 G90 F600\nG1 X1\n"),
        ("whole.ngc", "G21 G90 F600\nG1 X1\nM2\n"),
    ] {
        std::fs::write(format!("{folder}/{name}"), text).unwrap();
    }
    let services = Services::start(&instance);
    let live = Live::start(&instance, &["--may", "operate", "--programs", &folder]);
    choose(&mut browser, &live, "cut-off.ngc");
    browser.wait("LOOK.info && LOOK.info.report");
    let found = "document.querySelector('#found').textContent";
    browser.wait(&format!(
        "{found}.includes('The text ends without M2, M30 or a last %')"
    ));
    assert_eq!(
        browser.evaluate(&format!("{found}.includes('No mistakes found')")),
        false
    );
    // It runs all the same.
    browser.wait("whyNoRun() === ''");
    browser.press("[data-name=\"whole.ngc\"]");
    browser.wait(&format!("{found}.includes('No mistakes found')"));
    assert_eq!(
        browser.evaluate(&format!("{found}.includes('The text ends')")),
        false
    );
    drop(live);
    drop(services.end());
}
