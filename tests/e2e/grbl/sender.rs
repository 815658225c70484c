//! A plain sender with character counting, and the endpoint that it connects to.

use std::collections::VecDeque;
use std::io::{ErrorKind, Read as _, Write as _};
use std::net::TcpStream;
use std::process::Child;
use std::time::{Duration, Instant};

use glidepath_tests::{Instance, served};
use rustix::process::{Pid, Signal, kill_process};

/// How long anything may take.
const PATIENCE: Duration = Duration::from_secs(30);
/// What may be unanswered, bytes, unless the endpoint allows more.
const WINDOW: usize = 128;
/// Between two questions for a report.
const ASK_EVERY: Duration = Duration::from_millis(50);

/// `glidepath grbl` at work.
pub(crate) struct Endpoint {
    child: Child,
    pub(crate) port: u16,
}

impl Endpoint {
    pub(crate) fn start(instance: &Instance, arguments: &[&str]) -> Self {
        let (child, told) = served(instance, "grbl", arguments);
        let port = told["port"].as_u64().unwrap().try_into().unwrap();
        Self { child, port }
    }

    pub(crate) fn signal(&self, signal: Signal) {
        let pid = Pid::from_raw(self.child.id().try_into().unwrap()).unwrap();
        kill_process(pid, signal).unwrap();
    }

    pub(crate) fn end(mut self) {
        self.signal(Signal::TERM);
        assert!(self.child.wait().unwrap().success());
    }
}

impl Drop for Endpoint {
    fn drop(&mut self) {
        // Nobody is left to tell.
        let _killed = self.child.kill();
        let _ended = self.child.wait();
    }
}

/// A plain sender.
pub(crate) struct Sender {
    stream: TcpStream,
    pub(crate) window: usize,
    come: Vec<u8>,
    /// Every line that it was told, but reports.
    pub(crate) log: Vec<String>,
    /// How many of them were looked at.
    seen: usize,
    report: String,
    asked: Instant,
}

impl Sender {
    /// Connects, and waits for the welcome.
    pub(crate) fn connect(port: u16) -> Self {
        Self::connect_raw(port)
    }

    pub(crate) fn connect_raw(port: u16) -> Self {
        let stream = TcpStream::connect(("127.0.0.1", port)).unwrap();
        stream.set_nodelay(true).unwrap();
        let patience = Some(Duration::from_millis(1));
        stream.set_read_timeout(patience).unwrap();
        Self {
            stream,
            window: WINDOW,
            come: Vec::new(),
            log: Vec::new(),
            seen: 0,
            report: String::new(),
            asked: Instant::now(),
        }
    }

    pub(crate) fn send(&mut self, bytes: &[u8]) {
        self.stream.write_all(bytes).unwrap();
    }

    /// All that comes until the other side closes.
    pub(crate) fn rest(mut self) -> String {
        self.stream.set_read_timeout(Some(PATIENCE)).unwrap();
        let mut text = Vec::new();
        // What was sent and is not read makes the other side's end an abrupt one.
        let _read = self.stream.read_to_end(&mut text);
        String::from_utf8_lossy(&text).into_owned()
    }

    /// Takes what has come, and asks for reports; the answers among it.
    pub(crate) fn look(&mut self) -> Vec<String> {
        if self.asked.elapsed() >= ASK_EVERY {
            self.asked = Instant::now();
            self.send(b"?");
        }
        let mut bytes = [0; 4096];
        match self.stream.read(&mut bytes) {
            Ok(length) => self.come.extend_from_slice(&bytes[..length]),
            Err(error) => assert!(
                matches!(error.kind(), ErrorKind::WouldBlock | ErrorKind::TimedOut),
                "{error}"
            ),
        }
        let mut answers = Vec::new();
        while let Some(end) = self.come.iter().position(|byte| *byte == b'\n') {
            let line: Vec<u8> = self.come.drain(..=end).collect();
            let line = String::from_utf8(line).unwrap().trim().to_owned();
            if line.starts_with('<') {
                self.report = line;
                continue;
            }
            if line == "ok" || line.starts_with("error:") {
                answers.push(line.clone());
            }
            self.log.push(line);
        }
        answers
    }

    /// Sends lines by character counting, until all are answered, or `go_on`, which is asked between two looks,
    /// says no. Returns the answers.
    pub(crate) fn stream(
        &mut self,
        lines: &[&str],
        go_on: &mut dyn FnMut(&mut Self, usize) -> bool,
    ) -> Vec<String> {
        let (mut out, mut sent, mut answers) = (VecDeque::new(), 0, Vec::new());
        let mut progress = Instant::now();
        while answers.len() < lines.len() {
            while let Some(line) = lines.get(sent)
                && out.iter().sum::<usize>() + line.len() < self.window
            {
                self.send(format!("{line}\n").as_bytes());
                out.push_back(line.len() + 1);
                sent += 1;
            }
            for answer in self.look() {
                assert!(out.pop_front().is_some(), "an answer to nothing: {answer}");
                answers.push(answer);
                progress = Instant::now();
            }
            let seen = self.log.len();
            if !go_on(self, answers.len()) {
                return answers;
            }
            // What came while somebody else looked.
            for line in self.log[seen..].iter().cloned() {
                if line == "ok" || line.starts_with("error:") {
                    assert!(out.pop_front().is_some(), "an answer to nothing: {line}");
                    answers.push(line);
                    progress = Instant::now();
                }
            }
            assert!(
                progress.elapsed() < PATIENCE,
                "{} answers: {:?}",
                answers.len(),
                self.last()
            );
        }
        self.seen = self.log.len();
        answers
    }

    /// Sends lines one after the other, each when the one before was answered; the answers, as far as they come
    /// within some seconds.
    pub(crate) fn answers(&mut self, lines: &[&str]) -> Vec<String> {
        let mut answers = Vec::new();
        for line in lines {
            self.send(format!("{line}\n").as_bytes());
            let begun = Instant::now();
            let answered = loop {
                let answered = self.look();
                if !answered.is_empty() || begun.elapsed() > Duration::from_secs(6) {
                    break answered;
                }
            };
            answers.extend(answered);
        }
        self.seen = self.log.len();
        answers
    }

    /// Waits for a line that begins or goes on with these words, behind what was waited for before.
    pub(crate) fn wait_for(&mut self, words: &str) {
        let begun = Instant::now();
        loop {
            let new = &self.log[self.seen..];
            if let Some(at) = new.iter().position(|line| line.contains(words)) {
                self.seen += at + 1;
                return;
            }
            assert!(begun.elapsed() < PATIENCE, "not {words}: {:?}", self.last());
            let _answers = self.look();
        }
    }

    /// What it was told last.
    fn last(&self) -> &[String] {
        &self.log[self.log.len().saturating_sub(12)..]
    }

    /// Whether such a line has come.
    pub(crate) fn said(&self, words: &str) -> bool {
        self.log.iter().any(|line| line.contains(words))
    }

    /// The state as a new report tells it.
    pub(crate) fn state(&mut self) -> String {
        self.report.clear();
        let begun = Instant::now();
        while self.report.is_empty() {
            assert!(begun.elapsed() < PATIENCE, "no report");
            let _answers = self.look();
        }
        self.report[1..]
            .split(['|', '>'])
            .next()
            .unwrap()
            .to_owned()
    }

    /// The report that has come last.
    pub(crate) fn report(&self) -> &str {
        &self.report
    }

    pub(crate) fn wait_for_state(&mut self, wanted: &str) {
        let begun = Instant::now();
        loop {
            let state = self.state();
            if state == wanted {
                return;
            }
            assert!(
                begun.elapsed() < PATIENCE,
                "{state}, not {wanted}: {:?}",
                self.log
            );
        }
    }

    /// Waits until the machine is beyond a place on X.
    pub(crate) fn wait_until_beyond(&mut self, x: f64) {
        let begun = Instant::now();
        while self.position()[0] <= x {
            assert!(begun.elapsed() < PATIENCE, "{:?}", self.last());
            let _state = self.state();
        }
    }

    /// Where the last report says that the machine is.
    pub(crate) fn position(&self) -> [f64; 3] {
        let fields = self.report.split('|');
        let text = fields
            .filter_map(|field| field.strip_prefix("MPos:"))
            .next();
        let numbers = text.unwrap_or("0,0,0").trim_end_matches('>').split(',');
        let all: Vec<f64> = numbers.map(|number| number.parse().unwrap()).collect();
        [all[0], all[1], all[2]]
    }
}
