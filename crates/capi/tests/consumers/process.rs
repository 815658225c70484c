//! Consumers as processes.

use crate::build::{self, Place};
use std::io::{BufRead as _, BufReader, Read as _};
use std::path::PathBuf;
use std::process::{Child, ChildStdout, Command, Stdio};

/// Python, if it is installed.
pub(crate) fn python() -> Option<String> {
    let found = Command::new("python3").arg("--version").output();
    found
        .is_ok_and(|output| output.status.success())
        .then(|| "python3".to_owned())
}

/// A consumer at work.
#[derive(Debug)]
pub(crate) struct Consumer {
    name: String,
    child: Child,
    output: BufReader<ChildStdout>,
    file: PathBuf,
}

impl Consumer {
    /// One that follows so many setpoints, and writes them to a file.
    pub(crate) fn follow(
        place: Place<'_>,
        name: &str,
        program: &str,
        first: &[&str],
        count: u64,
    ) -> Self {
        let file = place.directory.join(format!("{name}.bin"));
        let count = count.to_string();
        let rest = [place.instance, &count, file.to_str().unwrap()];
        let arguments: Vec<&str> = first.iter().copied().chain(rest).collect();
        Self::run(place, name, program, &arguments)
    }

    /// One that is given the instance, behind its script, and before its other arguments.
    pub(crate) fn start(place: Place<'_>, name: &str, program: &str, others: &[&str]) -> Self {
        let (scripts, others): (Vec<&str>, Vec<&str>) = others
            .iter()
            .partition(|argument| argument.ends_with(".py"));
        let mut arguments = scripts;
        arguments.push(place.instance);
        arguments.extend(others);
        Self::run(place, name, program, &arguments)
    }

    fn run(place: Place<'_>, name: &str, program: &str, arguments: &[&str]) -> Self {
        let library = build::library_folder(place).join("libglidepath.so.0");
        let mut child = Command::new(program)
            .args(arguments)
            .env("XDG_RUNTIME_DIR", place.directory)
            .env("GLIDEPATH_LIBRARY", library)
            .env("PYTHONPATH", build::source("python"))
            .env("PYTHONDONTWRITEBYTECODE", "1")
            .stdout(Stdio::piped())
            .spawn()
            .unwrap();
        let output = BufReader::new(child.stdout.take().unwrap());
        Self {
            name: name.to_owned(),
            child,
            output,
            file: place.directory.join(format!("{name}.bin")),
        }
    }

    /// Until it has joined.
    pub(crate) fn wait_until_ready(&mut self) {
        let mut line = String::new();
        self.output.read_line(&mut line).unwrap();
        assert_eq!(line, "ready\n", "{}", self.name);
    }

    /// Its name, what it said, and what it wrote.
    pub(crate) fn finish(mut self) -> (String, String, Vec<u8>) {
        let mut told = String::new();
        self.output.read_to_string(&mut told).unwrap();
        let status = self.child.wait().unwrap();
        assert!(status.success(), "{}: {status}, {told}", self.name);
        let written = std::fs::read(&self.file).unwrap_or_default();
        (self.name.clone(), told, written)
    }
}

impl Drop for Consumer {
    fn drop(&mut self) {
        // One that has ended already cannot be killed, and need not be.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
