//! Tests of colours: texts can be read, and what is told by a colour is told apart by whoever sees fewer of them.

use glidepath_tests::{Browser, Instance, Services, Watchdog};
use serde_json::Value;

use super::{Live, PATIENCE};

/// Limits and rapids, as the path and the ribbon have them.
const LINES: [&str; 8] = [
    "b-feed", "b-vel", "b-acc", "b-jerk", "b-tol", "b-chord", "b-none", "rapid",
];

/// What eyes without one kind of cones see of linear red, green and blue: Machado, Oliveira and Fernandes 2009, severity
/// 1; first what all of them see.
const EYES: [(&str, [[f64; 3]; 3]); 4] = [
    ("all", [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]),
    (
        "protan",
        [
            [0.152_286, 1.052_583, -0.204_868],
            [0.114_503, 0.786_281, 0.099_216],
            [-0.003_882, -0.048_116, 1.051_998],
        ],
    ),
    (
        "deutan",
        [
            [0.367_322, 0.860_646, -0.227_968],
            [0.280_085, 0.672_501, 0.047_413],
            [-0.011_820, 0.042_940, 0.968_881],
        ],
    ),
    (
        "tritan",
        [
            [1.255_528, -0.076_749, -0.178_779],
            [-0.078_411, 0.930_809, 0.147_602],
            [0.004_733, 0.691_367, 0.303_900],
        ],
    ),
];

type Colour = [f64; 3];

fn times(matrix: &[[f64; 3]; 3], colour: Colour) -> Colour {
    matrix.map(|row| row.iter().zip(colour).map(|(a, b)| a * b).sum())
}

/// Linear red, green and blue of `#rrggbb`.
fn linear(text: &str) -> Colour {
    let digits = text.trim().trim_start_matches('#');
    [0, 2, 4].map(|at| {
        let part = f64::from(u8::from_str_radix(&digits[at..at + 2], 16).unwrap()) / 255.0;
        if part <= 0.04045 {
            part / 12.92
        } else {
            ((part + 0.055) / 1.055).powf(2.4)
        }
    })
}

/// CIELAB under D65.
fn lab(colour: Colour) -> Colour {
    let to_xyz = [
        [0.4124, 0.3576, 0.1805],
        [0.2126, 0.7152, 0.0722],
        [0.0193, 0.1192, 0.9505],
    ];
    let [x, y, z] = times(&to_xyz, colour);
    let f = |t: f64| {
        if t > 0.008_856 {
            t.cbrt()
        } else {
            7.787 * t + 16.0 / 116.0
        }
    };
    let (x, y, z) = (f(x / 0.950_47), f(y), f(z / 1.088_83));
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
}

fn distance(a: Colour, b: Colour) -> f64 {
    a.iter()
        .zip(b)
        .map(|(a, b)| (a - b).powi(2))
        .sum::<f64>()
        .sqrt()
}

fn contrast(a: Colour, b: Colour) -> f64 {
    let light = |colour: Colour| times(&[[0.2126, 0.7152, 0.0722]; 3], colour)[0] + 0.05;
    let (a, b) = (light(a), light(b));
    (a / b).max(b / a)
}

fn lines_are_told_apart(browser: &mut Browser, theme: &str) {
    let mut colour = |name: &str| {
        let value = browser.evaluate(&format!(
            "getComputedStyle(document.documentElement).getPropertyValue('--{name}')"
        ));
        linear(value.as_str().unwrap())
    };
    let panel = colour("panel");
    let lines = LINES.map(|name| (name, colour(name)));
    for (at, (name, line)) in lines.iter().enumerate() {
        let seen = contrast(*line, panel);
        assert!(seen >= 3.6, "{theme}: {name} on the panel: {seen}");
        for (other, another) in lines.iter().skip(at + 1) {
            for (eyes, matrix) in &EYES {
                let seen = |colour| lab(times(matrix, colour).map(|part| part.clamp(0.0, 1.0)));
                let apart = distance(seen(*line), seen(*another));
                assert!(
                    apart >= 12.0,
                    "{theme}, {eyes}: {name} and {other}: {apart}"
                );
            }
        }
    }
}

/// Texts whose contrast to what is behind them is less than 4.5, with their opacity and that of what they stand in.
const PALE: &str = "(() => { \
     const parts = text => (text.match(/[\\d.]+/g) || []).map(Number), linear = x => (x /= 255) <= 0.04045 ? x / 12.92 : ((x + 0.055) / 1.055) ** 2.4; \
     const light = c => 0.2126 * linear(c[0]) + 0.7152 * linear(c[1]) + 0.0722 * linear(c[2]) + 0.05; \
     const pale = []; \
     for (const e of document.querySelectorAll('#app *')) { \
       if (![...e.childNodes].some(n => n.nodeType === 3 && n.textContent.trim()) || !e.checkVisibility({ visibilityProperty: true, opacityProperty: true })) continue; \
       const style = getComputedStyle(e), ink = parts(style.color); \
       if (parseFloat(style.fontSize) < 1) continue; \
       let opacity = 1, behind = null; \
       for (let at = e; at && at !== document.documentElement; at = at.parentElement) { \
         const own = getComputedStyle(at), ground = parts(own.backgroundColor); \
         if (!behind && ground.length >= 3 && (ground.length === 3 || ground[3] > 0.99)) behind = ground; \
         if (!behind || at === e) opacity *= +own.opacity; else opacity *= +own.opacity; \
       } \
       behind = behind || parts(getComputedStyle(document.body).backgroundColor); \
       const seen = [0, 1, 2].map(k => behind[k] + (ink[k] - behind[k]) * opacity * (ink[3] === undefined ? 1 : ink[3])), [a, b] = [light(seen), light(behind)], contrast = Math.max(a / b, b / a); \
       if (contrast < 4.5) pale.push(`${e.id || e.className || e.tagName} \"${e.textContent.trim().slice(0, 30)}\" ${contrast.toFixed(2)}`); \
     } \
     return pale.join('; '); })()";

#[test]
fn texts_can_be_read_and_lines_are_told_apart_by_all_eyes() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let Some(mut browser) = Browser::start(1024, 768) else {
        return;
    };
    let folder = instance.path("programs");
    std::fs::create_dir(&folder).unwrap();
    std::fs::write(
        format!("{folder}/a.ngc"),
        "G21 G90 F600\nG0 X2\nG1 X5\nM2\n",
    )
    .unwrap();
    let services = Services::start(&instance);
    let live = Live::start(&instance, &["--may", "operate", "--programs", &folder]);
    browser.open(&live.url);
    browser.wait("typeof S !== 'undefined' && S.operates && S.status && SETUP.jog");
    browser.evaluate("order('queue-add', { name: 'a.ngc' }), setView('programs')");
    browser.wait("queued().length === 1 && document.querySelector('#list .program')");
    browser.press("#list .program");
    browser.wait("document.querySelector('.tolerances') && QUEUE.info && QUEUE.info.seconds");
    for theme in ["light", "dark"] {
        browser.evaluate(&format!("theme('{theme}')"));
        lines_are_told_apart(&mut browser, theme);
        for view in ["setup", "programs", "operate", "tune", "health"] {
            browser.evaluate(&format!("setView('{view}')"));
            browser.wait(&format!("S.view === '{view}'"));
            for state in [
                "idle",
                "running",
                "held",
                "awaiting",
                "faulted",
                "not-homed",
                "stale",
            ] {
                let pale = browser.evaluate(&format!("S.state = '{state}', paintState(), {PALE}"));
                assert_eq!(pale, Value::from(""), "{theme} {view} {state}");
            }
        }
    }
    // Nor is what is done, is to come, and is a rapid told by colours alone: by width, and by dashes.
    let widths = browser.evaluate("[TO_COME, DONE.width, DONE.rapid]");
    let width = |at: usize| widths[at].as_f64().unwrap();
    assert!(width(1) > 2.0 * width(0) && width(2) < width(1), "{widths}");
    let dashes = browser.evaluate(
        "(() => { const drawn = [], c = new Proxy({}, { get: (of, name) => name === 'setLineDash' ? dash => drawn.push(dash.length) : () => {}, set: () => true }); \
         const track = MOTION || LOOK.motion || LOOK.program; SPACE.project(400, 400); \
         SPACE.segments(c, track, track.levels.length - 1, -1, Infinity, DONE, 400, 400); return drawn.includes(2); })()",
    );
    assert_eq!(dashes, true);
    drop(live);
    drop(services.end());
}
