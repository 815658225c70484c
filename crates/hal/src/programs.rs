//! The programs `halstreamer` and `halsampler`, as processes.

use crate::error::HalError;
use rustix::fs::{OFlags, fcntl_getfl, fcntl_setfl};
use std::io::{self, BufRead as _, BufReader, Read, Write as _};
use std::os::unix::process::CommandExt as _;
use std::process::{Child, ChildStdin, Command, Stdio};
use std::sync::mpsc::{self, Receiver, TryRecvError};
use std::sync::{Arc, Mutex, PoisonError};

pub(crate) const STREAMER: &str = "halstreamer";
pub(crate) const SAMPLER: &str = "halsampler";

/// Longest text of a program that is kept.
const TEXT: usize = 2000;

/// Longest line that is read. A row of nine joints has a few hundred bytes.
const LINE: u64 = 4096;

/// Rows that wait to be taken. Of more HAL's own queue is told.
const ROWS: usize = 4096;

/// The lines of a program. One without an end is cut, and is the last: what follows is no line.
struct Lines<R> {
    from: BufReader<R>,
    is_over: bool,
}

impl<R: Read> Lines<R> {
    fn of(from: R) -> Self {
        Self {
            from: BufReader::new(from),
            is_over: false,
        }
    }
}

impl<R: Read> Iterator for Lines<R> {
    type Item = String;

    fn next(&mut self) -> Option<String> {
        if self.is_over {
            // Taken away, so that the program does not stand still.
            let _ = io::copy(&mut self.from, &mut io::sink());
            return None;
        }
        let mut line = Vec::new();
        let mut rest = self.from.by_ref().take(LINE);
        let read = rest.read_until(b'\n', &mut line).ok()?;
        self.is_over = rest.limit() == 0 && !line.ends_with(b"\n");
        if line.ends_with(b"\n") {
            line.pop();
        }
        (read > 0).then(|| String::from_utf8_lossy(&line).into_owned())
    }
}

/// What a program says on its standard error, as it says it.
#[derive(Debug, Clone, Default)]
struct Said(Arc<Mutex<String>>);

impl Said {
    fn collect(stderr: impl Read + Send + 'static) -> Self {
        let said = Self::default();
        let into = said.clone();
        std::thread::spawn(move || {
            for line in Lines::of(stderr) {
                // What every program of LinuxCNC says on a host without its real time.
                if line.starts_with("Note:") {
                    continue;
                }
                let mut text = into.0.lock().unwrap_or_else(PoisonError::into_inner);
                if text.len() < TEXT {
                    let separator = if text.is_empty() { "" } else { "; " };
                    text.push_str(separator);
                    text.push_str(line.trim());
                }
            }
        });
        said
    }

    fn text(&self) -> String {
        let text = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        text.clone()
    }
}

/// A program that is ended with its value.
#[derive(Debug)]
struct Program {
    name: &'static str,
    child: Child,
    said: Said,
}

impl Program {
    fn start(name: &'static str, command: &mut Command) -> Result<Self, HalError> {
        let refused = |source| HalError::Start {
            program: name,
            source,
        };
        // In a group of its own: Ctrl-C is for this process, which brings the joints to rest by it.
        command.process_group(0).stderr(Stdio::piped());
        let mut child = command.spawn().map_err(refused)?;
        let said = child.stderr.take().map(Said::collect).unwrap_or_default();
        Ok(Self { name, child, said })
    }

    fn ended(&mut self) -> HalError {
        // What it said last may still be on its way.
        let _ = self.child.wait();
        std::thread::sleep(std::time::Duration::from_millis(20));
        HalError::Ended {
            program: self.name,
            text: self.said.text(),
        }
    }

    fn check(&mut self) -> Result<(), HalError> {
        match self.child.try_wait() {
            Ok(None) => Ok(()),
            Ok(Some(_)) => Err(self.ended()),
            Err(source) => Err(self.pipe(source)),
        }
    }

    const fn pipe(&self, source: io::Error) -> HalError {
        HalError::Pipe {
            program: self.name,
            source,
        }
    }
}

impl Drop for Program {
    fn drop(&mut self) {
        // One that has ended already cannot be killed, and need not be.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// The process that takes lines.
#[derive(Debug)]
pub(crate) struct Streamer {
    program: Program,
    input: Option<ChildStdin>,
    channel: u32,
    cfg: String,
}

impl Streamer {
    pub(crate) fn start(channel: u32, cfg: String) -> Result<Self, HalError> {
        let mut command = Command::new(STREAMER);
        command.args(["-c", &channel.to_string()]);
        command.stdin(Stdio::piped()).stdout(Stdio::null());
        let mut program = Program::start(STREAMER, &mut command)?;
        let input = program.child.stdin.take();
        if let Some(input) = &input {
            // A HAL that stands still must not have this process stand still.
            let flags = fcntl_getfl(input).map_err(|error| program.pipe(error.into()))?;
            fcntl_setfl(input, flags | OFlags::NONBLOCK)
                .map_err(|error| program.pipe(error.into()))?;
        }
        Ok(Self {
            program,
            input,
            channel,
            cfg,
        })
    }

    /// Writes whole lines.
    pub(crate) fn write(&mut self, lines: &str) -> Result<(), HalError> {
        let said = self.program.said.text();
        if said.contains("skipping") {
            return Err(HalError::Line {
                text: said,
                cfg: self.cfg.clone(),
            });
        }
        // One by one: a short text goes into a pipe as a whole, or not at all.
        for line in lines.split_inclusive('\n') {
            let Some(input) = &mut self.input else { break };
            match input.write(line.as_bytes()) {
                Ok(_) => {}
                Err(error) if error.kind() == io::ErrorKind::WouldBlock => {
                    return Err(HalError::Full {
                        channel: self.channel,
                    });
                }
                Err(error) if error.kind() == io::ErrorKind::BrokenPipe => {
                    return Err(self.program.ended());
                }
                Err(error) => return Err(self.program.pipe(error)),
            }
        }
        self.program.check()
    }
}

/// The process that gives rows.
#[derive(Debug)]
pub(crate) struct Sampler {
    program: Program,
    rows: Receiver<String>,
}

impl Sampler {
    pub(crate) fn start(channel: u32) -> Result<Self, HalError> {
        // Into a pipe it would write tens of rows at a time.
        let mut command = Command::new("stdbuf");
        command.args(["-oL", SAMPLER, "-c", &channel.to_string()]);
        command.stdin(Stdio::null()).stdout(Stdio::piped());
        let mut program = Program::start(SAMPLER, &mut command)?;
        let (into, rows) = mpsc::sync_channel(ROWS);
        if let Some(output) = program.child.stdout.take() {
            std::thread::spawn(move || {
                for line in Lines::of(output) {
                    if into.send(line).is_err() {
                        return;
                    }
                }
            });
        }
        Ok(Self { program, rows })
    }

    /// The next row that has come.
    pub(crate) fn take(&mut self) -> Result<Option<String>, HalError> {
        match self.rows.try_recv() {
            Ok(row) => Ok(Some(row)),
            Err(TryRecvError::Empty) => Ok(None),
            Err(TryRecvError::Disconnected) => Err(self.program.ended()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_without_end_is_cut_and_is_the_last() {
        let lines = |text: &[u8]| -> Vec<String> { Lines::of(text).collect() };
        assert_eq!(lines(b"1 2\n\n3\xff\n4"), ["1 2", "", "3\u{fffd}", "4"]);
        assert!(lines(b"").is_empty());
        // As much as would not fit into any memory.
        let mut endless = Lines::of(io::repeat(b'1').take(1 << 34));
        let row = endless.next().expect("a line");
        assert_eq!(row.len() as u64, LINE);
        assert!(endless.is_over);
        let behind = [b"1".repeat(5000), b"\n2\n".to_vec()].concat();
        assert_eq!(lines(&behind).len(), 1);
        let whole = [b"1".repeat(4095), b"\n2\n".to_vec()].concat();
        assert_eq!(lines(&whole).len(), 2);
    }
}
