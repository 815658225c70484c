//! Tests of the page on screens of all sizes: Hold is always there, texts can be read, and a lathe is drawn as one.

use glidepath_tests::{Browser, Instance, Process, Services, Watchdog};
use serde_json::json;

use super::{Live, PATIENCE};

/// A panel, a monitor, a tablet, and a telephone both ways.
const SCREENS: [(u32, u32); 6] = [
    (1440, 900),
    (1024, 768),
    (800, 480),
    (768, 1024),
    (390, 844),
    (844, 390),
];

/// Whether a finger in the lower right corner is on Hold, and all of Hold can be seen.
pub(super) const HOLD_IS_IN_ITS_CORNER: &str = "(() => { const hold = document.querySelector('[data-c=hold]'), r = hold.getBoundingClientRect(); \
     const edge = parseFloat(getComputedStyle(document.querySelector('#app')).borderRightWidth); \
     const at = (x, y) => { const found = document.elementFromPoint(x, y); return !!found && hold.contains(found); }; \
     return r.width > 60 && r.height > 44 && at(innerWidth - edge - 3, innerHeight - edge - 3) \
       && at(r.left + 3, r.top + 3) && at(r.left + 3, r.bottom - 3) && at(r.right - 3, r.top + 3); })()";

/// Texts that are smaller than 12 px.
const SMALL: &str = "[...document.querySelectorAll('#app *')].filter(e => !e.children.length && \
     e.textContent.trim() && e.getClientRects().length && parseFloat(getComputedStyle(e).fontSize) < 11.99) \
     .map(e => `${e.className} ${e.textContent} ${getComputedStyle(e).fontSize}`).join('; ')";

/// Texts of which a part is not shown: beyond an element that hides what is beyond it, or beyond the screen. What can be scrolled
/// to is shown. Names and lines of programs may be shortened, and a telephone shows as many entries of the log as it can.
pub(super) const CUT: &str = "(() => { \
     const short = '.program b, .sections .name, .section-keys b, #chosen .title b, .folder .h b, .around div, .blocks, #slowbox pre, #typed code, .g-log, [aria-hidden=true]'; \
     const scrolls = (e, way) => /auto|scroll/.test(getComputedStyle(e)['overflow' + way]) && (way === 'X' ? e.scrollWidth > e.clientWidth : e.scrollHeight > e.clientHeight); \
     const hides = (e, way) => getComputedStyle(e)['overflow' + way] !== 'visible' && !scrolls(e, way); \
     const range = document.createRange(), walk = document.createTreeWalker($('#app'), NodeFilter.SHOW_TEXT), found = new Set(); \
     for (let node; (node = walk.nextNode());) { const of = node.parentElement; \
       if (!node.textContent.trim() || of.closest(short) || !of.checkVisibility({ visibilityProperty: true, opacityProperty: true })) continue; \
       range.selectNodeContents(node); \
       for (const r of range.getClientRects()) { if (r.width < 1) continue; const high = r.height / 4; \
         for (let e = of; ; e = e.parentElement) { \
           const c = e ? e.getBoundingClientRect() : { left: 0, top: 0, right: innerWidth, bottom: innerHeight }; \
           const isCut = (!e || hides(e, 'X')) && (r.left < c.left - 1.5 || r.right > c.right + 1.5) \
             || (!e || hides(e, 'Y')) && (r.top < c.top - high || r.bottom > c.bottom + high); \
           if (isCut) found.add(`${node.textContent.trim()} (${e ? e.id || e.className : 'screen'})`); \
           if (isCut || !e || scrolls(e, 'X') || scrolls(e, 'Y')) break; } } } \
     return [...found].join('; '); })()";

/// Texts that lie over others: of what can be seen of each, a third of its height and a px each way does not count.
pub(super) const OVERLAPS: &str = "(() => { \
     const range = document.createRange(), walk = document.createTreeWalker($('#app'), NodeFilter.SHOW_TEXT), all = []; \
     for (let node; (node = walk.nextNode());) { const of = node.parentElement; \
       if (!node.textContent.trim() || !of.checkVisibility({ visibilityProperty: true, opacityProperty: true })) continue; \
       range.selectNodeContents(node); \
       for (const r of range.getClientRects()) { let [left, top, right, bottom] = [r.left + 1, r.top + r.height / 3, r.right - 1, r.bottom - r.height / 3]; \
         for (let e = of; e; e = e.parentElement) { if (getComputedStyle(e).overflow === 'visible') continue; const c = e.getBoundingClientRect(); \
           left = Math.max(left, c.left); right = Math.min(right, c.right); top = Math.max(top, c.top); bottom = Math.min(bottom, c.bottom); } \
         if (right > left && bottom > top) all.push({ left, top, right, bottom, node, text: node.textContent.trim() }); } } \
     const found = new Set(); \
     all.forEach((a, k) => { for (const b of all.slice(k + 1)) if (a.node !== b.node && a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom) found.add(`${a.text} | ${b.text}`); }); \
     return [...found].join('; '); })()";

/// What is wider than its place and can be scrolled sideways, or is wider than the screen. Places of programs are scrolled to.
pub(super) const SIDEWAYS: &str = "[document.scrollingElement, ...document.querySelectorAll('#app, #app *')].filter(e => \
     e.scrollWidth > e.clientWidth + 1 && !e.closest('.finding pre, #judged pre') && (e === document.scrollingElement || /auto|scroll/.test(getComputedStyle(e).overflowX)) \
     && e.checkVisibility({ visibilityProperty: true })).map(e => e.id || e.className || e.tagName).join('; ')";

pub(super) fn resize(browser: &mut Browser, (width, height): (u32, u32)) {
    let size = json!({
        "width": width, "height": height, "deviceScaleFactor": 1, "mobile": false,
    });
    let _resized = browser.call("Emulation.setDeviceMetricsOverride", &size);
    browser.wait(&format!(
        "innerWidth === {width} && innerHeight === {height} && S.phone === isPhone()"
    ));
}

#[test]
fn hold_is_in_its_corner_on_every_screen() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let Some(mut browser) = Browser::start(1440, 900) else {
        return;
    };
    let services = Services::start(&instance);
    let live = Live::start(&instance, &["--may", "operate"]);
    for role in ["operate", "hold"] {
        browser.open("about:blank");
        browser.open(live.urls[role].as_str().unwrap());
        browser.wait(&format!(
            "typeof S !== 'undefined' && S.may === '{role}' && S.status"
        ));
        for screen in SCREENS {
            resize(&mut browser, screen);
            let views = "$$('#tabs button').map(b => b.dataset.v)";
            let is_phone = browser.evaluate("S.phone") == true;
            let views = if is_phone {
                json!(["glance"])
            } else {
                browser.evaluate(views)
            };
            for view in views.as_array().unwrap() {
                let view = view.as_str().unwrap();
                if !is_phone {
                    browser.evaluate(&format!("setView('{view}')"));
                }
                browser.wait(&format!("S.view === '{view}'"));
                for state in ["idle", "awaiting", "faulted", "stale"] {
                    // As the band, the frame and the panel are then.
                    let shows = format!(
                        "S.state = '{state}', paintState(), [{HOLD_IS_IN_ITS_CORNER}, {CUT}]"
                    );
                    let shown = browser.evaluate(&shows);
                    assert_eq!(shown, json!([true, ""]), "{role} {screen:?} {view} {state}");
                }
                if ["operate", "setup", "programs"].contains(&view) {
                    let small = browser.evaluate(SMALL);
                    assert_eq!(small, "", "{screen:?} {view}");
                }
            }
        }
        // Whoever turned a telephone is where they were before.
        resize(&mut browser, (1024, 768));
        assert_eq!(browser.evaluate("S.view !== 'glance'"), true);
    }
    drop(live);
    drop(services.end());
}

/// The contrast of two colours of the page, as WCAG defines it.
const CONTRAST: &str = "(a, b) => { const light = name => { const c = document.createElement('canvas').getContext('2d'); \
     c.fillStyle = getComputedStyle(document.documentElement).getPropertyValue(name); c.fillRect(0, 0, 1, 1); \
     const [r, g, h] = [...c.getImageData(0, 0, 1, 1).data].map(x => x / 255).map(x => x <= 0.03928 ? x / 12.92 : ((x + 0.055) / 1.055) ** 2.4); \
     return 0.2126 * r + 0.7152 * g + 0.0722 * h; }; const [x, y] = [light(a), light(b)].sort((p, q) => q - p); \
     return (x + 0.05) / (y + 0.05); }";

/// Buttons, fields and tabs without a name, on a view.
const NAMELESS: &str = "[...document.querySelectorAll('#app button, #app input')].filter(e => e.getClientRects().length && \
     !(e.getAttribute('aria-label') || e.title || e.textContent.trim() || (e.labels && e.labels.length) || e.placeholder)) \
     .map(e => e.outerHTML.slice(0, 80)).join('; ')";

#[test]
fn what_is_pressed_and_read_can_be_seen_and_has_a_name() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let Some(mut browser) = Browser::start(1024, 768) else {
        return;
    };
    let services = Services::start(&instance);
    let live = Live::start(&instance, &["--may", "operate"]);
    browser.open(&live.url);
    browser.wait("typeof S !== 'undefined' && S.operates && S.status && SETUP.jog");
    for name in ["light", "dark"] {
        browser.evaluate(&format!("theme('{name}')"));
        for (colour, ground, least) in [
            ("--ink", "--panel", 7.0),
            ("--quiet", "--panel", 4.5),
            ("--quiet", "--faint", 4.5),
            ("--fault", "--panel", 4.5),
            ("--on-wait", "--wait", 4.5),
            ("--on-hold", "--hold", 4.5),
            ("--on-fault", "--fault", 4.5),
            ("--edge", "--panel", 3.0),
            ("--edge", "--bg", 3.0),
        ] {
            let contrast = browser.evaluate(&format!("({CONTRAST})('{colour}', '{ground}')"));
            let contrast = contrast.as_f64().unwrap();
            assert!(
                contrast >= least,
                "{name}: {colour} on {ground}: {contrast}"
            );
        }
    }
    for view in ["setup", "programs", "operate", "tune", "health"] {
        browser.evaluate(&format!("setView('{view}')"));
        assert_eq!(browser.evaluate(NAMELESS), "", "{view}");
        let chosen = browser
            .evaluate("$$('#tabs [role=tab][aria-selected=true]').map(b => b.dataset.v).join()");
        assert_eq!(chosen, view);
    }
    // What each key is called is told apart.
    let names = browser.evaluate("$$('.jog').map(b => b.getAttribute('aria-label'))");
    let names: std::collections::BTreeSet<_> = names
        .as_array()
        .unwrap()
        .iter()
        .map(|name| name.as_str().unwrap().to_owned())
        .collect();
    assert_eq!(names.len(), 10, "{names:?}");
    drop(live);
    drop(services.end());
}

#[test]
fn a_lathe_is_drawn_and_jogged_as_one() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let Some(mut browser) = Browser::start(1024, 768) else {
        return;
    };
    let config = concat!(env!("CARGO_MANIFEST_DIR"), "/../config/lathe.toml");
    let folder = instance.path("programs");
    std::fs::create_dir(&folder).unwrap();
    let program = "G18 G21 G90 G8 F600\nG0 X20 Z2\nG1 Z-30\nX25\nG0 Z2\nM2\n";
    std::fs::write(format!("{folder}/turn.ngc"), program).unwrap();
    let process =
        |arguments: &[&str]| Process::join(&instance, &[arguments, &["--config", config]].concat());
    let interpolator = process(&["interpolator", "--best-effort"]);
    let service = process(&["planner", "--listen"]);
    service.wait_until_it_is_ready();
    let arguments = [
        "--may",
        "operate",
        "--config",
        config,
        "--programs",
        &folder,
    ];
    let _idle = instance.wait_for_status(|_| true);
    let live = Live::start(&instance, &arguments);
    browser.open(&live.url);
    browser.wait(
        "typeof S !== 'undefined' && S.operates && S.state === 'idle' && SETUP.jog && RINGED.count",
    );
    browser.evaluate("setView('setup')");
    let keys = "$$('.jog').map(b => b.getAttribute('aria-label')).join()";
    assert_eq!(browser.evaluate(keys), "move X+,move Z−,move Z+,move X−");
    let way = browser.evaluate(
        "(() => { const r = name => document.querySelector(`.jog[aria-label=\"move ${name}\"]`).getBoundingClientRect(); \
         return r('Z+').left > r('Z−').right && r('X−').top > r('X+').bottom; })()",
    );
    assert_eq!(way, true);

    browser.evaluate("setView('programs')");
    browser.wait("document.querySelector('[data-name=\"turn.ngc\"]')");
    browser.press("[data-name=\"turn.ngc\"]");
    browser.wait("LOOK.info && LOOK.info.report && MOTION && SPACE.R");
    // Z goes to the right, X up, and the tool is where the machine is.
    let drawn = browser.evaluate(
        "(() => { const [ox, oy] = SPACE.at(0, 0, 0), [zx, zy] = SPACE.at(0, 0, 10), [xx, xy] = SPACE.at(10, 0, 0); \
         return zx > ox && Math.abs(zy - oy) < 1e-9 && xy < oy && Math.abs(xx - ox) < 1e-9; })()",
    );
    assert_eq!(drawn, true);
    let mdi = process(&["mdi", "G21 G90 G8 G0 X30 Z-12"]).wait();
    let _there = mdi.expect(0);
    browser.wait("Math.abs(inSpace(k => RINGED.last_position(k))[2] + 12) < 1e-6");
    let place = browser
        .evaluate("inSpace(k => RINGED.last_position(k)).map(x => Math.round(x * 1e6) / 1e6)");
    assert_eq!(place, json!([30, 0, -12]));
    drop(live);
    for process in [service, interpolator] {
        let _ended = process.end().expect(0);
    }
}
