//! A browser without a screen: Chromium, driven over its DevTools protocol by two pipes.

use std::fs::File;
use std::io::{Read as _, Write as _};
use std::os::unix::process::CommandExt as _;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};
use std::rc::Rc;
use std::sync::OnceLock;
use std::time::{Duration, Instant};

use glidepath_testing::skip;
use rustix::process::{Pid, Signal, kill_process_group};
use serde_json::{Value, json};
use tempfile::TempDir;

use crate::{of_this_test, seats};

/// How long something may take until it is true on the page.
const PATIENCE: Duration = Duration::from_secs(180);
/// How often a finger may miss what it is put on.
const MISSES: u32 = 10;

/// Chromium with one page. Dropping it ends it.
#[derive(Debug)]
pub struct Browser {
    child: Child,
    to: ChildStdin,
    from: ChildStdout,
    /// What came behind the last answer.
    rest: Vec<u8>,
    number: u64,
    session: Option<String>,
    _profile: TempDir,
    _seat: Rc<File>,
}

impl Browser {
    /// Starts Chromium with a window of this size; `None`, aloud, where there is none.
    #[must_use]
    pub fn start(width: u32, height: u32) -> Option<Self> {
        Self::start_with((width, height), &[])
    }

    /// The same with arguments of its own.
    #[must_use]
    pub fn start_with((width, height): (u32, u32), more: &[&str]) -> Option<Self> {
        let Some(name) = installed() else {
            skip("a page in a browser", "Chromium is not installed");
            return None;
        };
        let seat = seats::of_browser();
        let profile = tempfile::tempdir().unwrap();
        // Chromium hears at its third file and answers at its fourth.
        let line = "exec \"$0\" \"$@\" 3<&0 4>&1 0</dev/null 1>/dev/null 2>/dev/null";
        let mut child = of_this_test(&mut Command::new("sh"))
            .args(["-c", line, name, "--headless", "--no-sandbox"])
            .args(["--disable-gpu", "--disable-dev-shm-usage", "--no-first-run"])
            .args(["--disable-background-networking", "--remote-debugging-pipe"])
            .arg(format!("--user-data-dir={}", profile.path().display()))
            .arg(format!("--window-size={width},{height}"))
            .args(more)
            .arg("about:blank")
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            // A group of their own: a signal for the browser is for all of its processes.
            .process_group(0)
            .spawn()
            .unwrap();
        let (to, from) = (child.stdin.take().unwrap(), child.stdout.take().unwrap());
        let mut browser = Self {
            child,
            to,
            from,
            rest: Vec::new(),
            number: 0,
            session: None,
            _profile: profile,
            _seat: seat,
        };
        browser.attach();
        Some(browser)
    }

    fn attach(&mut self) {
        let targets = self.call("Target.getTargets", &json!({}));
        let targets = targets["targetInfos"].as_array().unwrap().clone();
        let page = targets.iter().find(|target| target["type"] == "page");
        let attach = json!({ "targetId": page.unwrap()["targetId"], "flatten": true });
        let session = self.call("Target.attachToTarget", &attach);
        self.session = session["sessionId"].as_str().map(str::to_owned);
    }

    /// Asks for something of the DevTools protocol, and waits for the answer.
    pub fn call(&mut self, method: &str, parameters: &Value) -> Value {
        self.number += 1;
        let mut message = json!({ "id": self.number, "method": method, "params": parameters });
        if let Some(session) = &self.session {
            message["sessionId"] = session.as_str().into();
        }
        self.to.write_all(message.to_string().as_bytes()).unwrap();
        self.to.write_all(b"\0").unwrap();
        loop {
            let answer = self.message();
            if answer["id"] == self.number {
                assert!(answer["error"].is_null(), "{method}: {answer}");
                return answer["result"].clone();
            }
        }
    }

    fn message(&mut self) -> Value {
        loop {
            if let Some(end) = self.rest.iter().position(|byte| *byte == 0) {
                let text: Vec<u8> = self.rest.drain(..=end).collect();
                return serde_json::from_slice(&text[..end]).unwrap();
            }
            let mut more = vec![0; 65_536];
            let got = self.from.read(&mut more).unwrap();
            assert!(got > 0, "the browser ended");
            self.rest.extend_from_slice(&more[..got]);
        }
    }

    /// Opens an address.
    pub fn open(&mut self, url: &str) {
        let _opened = self.call("Page.navigate", &json!({ "url": url }));
    }

    /// The page is the one that a person is at, from now on: no other window has the keyboard.
    pub fn focus(&mut self) {
        let _focused = self.call(
            "Emulation.setFocusEmulationEnabled",
            &json!({ "enabled": true }),
        );
    }

    /// What an expression gives on the page; null where it throws.
    pub fn evaluate(&mut self, expression: &str) -> Value {
        let asked = json!({
            "expression": expression,
            "returnByValue": true,
            "awaitPromise": true,
        });
        self.call("Runtime.evaluate", &asked)["result"]["value"].clone()
    }

    /// Waits until an expression is true on the page; the test ends with the expression if it never is, or if the page
    /// could not paint something.
    pub fn wait(&mut self, expression: &str) {
        let begun = Instant::now();
        while self.evaluate(&format!("!!({expression})")) != true {
            if begun.elapsed() > PATIENCE {
                let shown = self.evaluate("document.body.innerText.replace(/\\s+/g, ' ')");
                panic!("never true: {expression}; the page shows: {shown}");
            }
            std::thread::sleep(Duration::from_millis(50));
        }
        let failures = self.evaluate("typeof S === 'undefined' ? '' : (S.failures || []).join()");
        assert!(
            failures.as_str().unwrap_or("").is_empty(),
            "{expression}: {failures}"
        );
    }

    /// Presses the middle of an element, and lets it go.
    pub fn press(&mut self, selector: &str) {
        self.press_for(selector, Duration::ZERO);
    }

    /// Presses the middle of an element, and lets it go after a while, by the timers of the page: on a busy host
    /// the page may be behind by more than that, and would have seen the finger come up too soon.
    pub fn press_for(&mut self, selector: &str, long: Duration) {
        let place = self.finger_down(selector);
        let ms = long.as_millis();
        self.evaluate(&format!("new Promise(done => setTimeout(done, {ms}))"));
        self.finger_up(&place);
    }

    /// Drops a file on the middle of an element, as a mouse does that drags it from a folder.
    pub fn drop_file(&mut self, selector: &str, path: &str) {
        let place = self.evaluate(&format!(
            "(() => {{ const r = document.querySelector('{selector}').getBoundingClientRect(); \
             return [r.x + r.width / 2, r.y + r.height / 2]; }})()"
        ));
        for kind in ["dragEnter", "dragOver", "drop"] {
            let data = json!({ "items": [], "files": [path], "dragOperationsMask": 1 });
            let event = json!({ "type": kind, "x": place[0], "y": place[1], "data": data });
            let _done = self.call("Input.dispatchDragEvent", &event);
        }
    }

    /// Puts a finger down in the middle of an element, once that is in sight and stays where it is. Returns where that is: the
    /// element may be gone when the finger comes up. Where the page moved it away under the finger, that is put down anew, as
    /// a person would do.
    pub fn finger_down(&mut self, selector: &str) -> Value {
        let place = format!(
            "(async () => {{ \
             const of = document.querySelector('{selector}'); \
             for (let e = of; e && (e = e.parentElement);) if (/auto|scroll/.test(getComputedStyle(e).overflowY)) {{ \
             const r = of.getBoundingClientRect(), c = e.getBoundingClientRect(); \
             e.scrollTop += Math.max(0, r.bottom - c.bottom) - Math.max(0, c.top - r.top); }} \
             const at = () => {{ const r = document.querySelector('{selector}').getBoundingClientRect(); \
             return [r.x + r.width / 2, r.y + r.height / 2]; }}; \
             window.under = null; \
             addEventListener('pointerdown', e => {{ under = !!e.target.closest('{selector}'); }}, {{ capture: true, once: true }}); \
             for (let before = at(), k = 0; ; k++) {{ await new Promise(done => setTimeout(done, 30)); \
             const now = at(); if (k > 20 || '' + now === '' + before) return now; before = now; }} }})()"
        );
        for _ in 0..MISSES {
            let at = self.evaluate(&place);
            self.mouse("mousePressed", &at);
            if self.evaluate("under") != false {
                return at;
            }
            self.mouse("mouseReleased", &at);
        }
        panic!("{selector} is not under the finger");
    }

    /// Keeps a picture of the page, where the environment names a folder for it (`GLIDEPATH_PICTURES`).
    pub fn picture(&mut self, name: &str) {
        let Some(folder) = std::env::var_os("GLIDEPATH_PICTURES") else {
            return;
        };
        // Until what is to be painted is.
        std::thread::sleep(Duration::from_millis(400));
        let taken = self.call("Page.captureScreenshot", &json!({ "format": "png" }));
        let picture = decoded(taken["data"].as_str().unwrap());
        std::fs::create_dir_all(&folder).unwrap();
        let file = std::path::Path::new(&folder).join(format!("{name}.png"));
        std::fs::write(file, picture).unwrap();
    }

    /// Moves a finger that is down, by px to the right of where it came down.
    pub fn finger_moved(&mut self, place: &Value, by: f64) {
        let x = place[0].as_f64().unwrap() + by;
        let event = json!({
            "type": "mouseMoved", "x": x, "y": place[1], "button": "left", "buttons": 1,
        });
        let _done = self.call("Input.dispatchMouseEvent", &event);
    }

    /// Takes a finger up.
    pub fn finger_up(&mut self, place: &Value) {
        self.mouse("mouseReleased", place);
    }

    /// Signals every process of the browser. One that is stopped answers nothing until it goes on.
    pub fn signal(&self, signal: Signal) {
        let group = Pid::from_child(&self.child);
        kill_process_group(group, signal).unwrap();
    }

    fn mouse(&mut self, kind: &str, place: &Value) {
        let event = json!({
            "type": kind, "x": place[0], "y": place[1], "button": "left", "clickCount": 1,
        });
        let _done = self.call("Input.dispatchMouseEvent", &event);
    }
}

/// The browser of this host that answers first; `None` where there is none.
fn installed() -> Option<&'static str> {
    static FOUND: OnceLock<Option<&str>> = OnceLock::new();
    let names = [
        // The same without the windows that nobody sees: it takes a seventh of the time to start.
        "chromium-headless-shell",
        "chromium",
        "chromium-browser",
        "google-chrome",
    ];
    let runs = |name: &&str| {
        let told = Command::new(name).arg("--version").output();
        told.is_ok_and(|output| output.status.success())
    };
    *FOUND.get_or_init(|| names.into_iter().find(runs))
}

/// The bytes of a text in base64 (RFC 4648).
fn decoded(text: &str) -> Vec<u8> {
    let digits = text.bytes().filter_map(|byte| {
        Some(u32::from(match byte {
            b'A'..=b'Z' => byte - b'A',
            b'a'..=b'z' => byte - b'a' + 26,
            b'0'..=b'9' => byte - b'0' + 52,
            b'+' => 62,
            b'/' => 63,
            _ => return None,
        }))
    });
    let digits: Vec<u32> = digits.collect();
    let whole = digits.chunks(4).flat_map(|four| {
        let number = (0..4).fold(0, |number, nth| number << 6 | four.get(nth).unwrap_or(&0));
        let bytes = number.to_be_bytes();
        bytes[1..four.len()].to_vec()
    });
    whole.collect()
}

impl Drop for Browser {
    fn drop(&mut self) {
        if std::thread::panicking() {
            // What a person would have seen. A browser that is gone cannot tell.
            let shown = catch_unwind(AssertUnwindSafe(|| {
                self.evaluate("document.body.innerText.replace(/\\s+/g, ' ')")
            }));
            let log = catch_unwind(AssertUnwindSafe(|| {
                self.evaluate("JSON.stringify([S.refusal, S.failures, S.status && S.status.log])")
            }));
            eprintln!("the page shows: {shown:?}\nit has had: {log:?}");
        }
        // Nobody is left to tell.
        let _killed = self.child.kill();
        let _ended = self.child.wait();
    }
}
