//! The processes of consumers.

use crate::build::{self, Place};
use std::io::{BufRead as _, BufReader, Read as _};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdout, Command, ExitStatus, Stdio};

/// Python, if it is installed.
pub(crate) fn python() -> Option<String> {
    let found = Command::new("python3").arg("--version").output();
    found
        .is_ok_and(|output| output.status.success())
        .then(|| "python3".to_owned())
}

/// Whether Python has pip.
pub(crate) fn has_pip(python: &str) -> bool {
    let found = Command::new(python)
        .args(["-m", "pip", "--version"])
        .output();
    found.is_ok_and(|output| output.status.success())
}

/// Builds the wheel, and installs it into a folder, which it gives.
pub(crate) fn wheel(place: Place<'_>, python: &str) -> PathBuf {
    let (wheels, installed) = (
        place.directory.join("wheels"),
        place.directory.join("python"),
    );
    let pip = |arguments: &[&str]| {
        let output = Command::new(python)
            .args(["-m", "pip", "--quiet", "--disable-pip-version-check"])
            .args(arguments)
            .env("GLIDEPATH_LIBRARY", build::library(build::Linked::Shared))
            .env("TMPDIR", place.directory)
            .output()
            .unwrap();
        assert!(output.status.success(), "{output:?}");
    };
    // Nothing is fetched: the package has no requirements, neither to be built nor to be used.
    let folder = wheels.to_str().unwrap();
    let source = build::source("python");
    pip(&["wheel", "--no-deps", "--no-index", "-w", folder, &source]);
    let target = installed.to_str().unwrap();
    pip(&[
        "install",
        "--no-index",
        "--find-links",
        folder,
        "--target",
        target,
        "glidepath",
    ]);
    installed
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

    /// The example in Python, with the package that was installed and the library in it.
    pub(crate) fn from_wheel(
        place: Place<'_>,
        python: &str,
        installed: &Path,
        script: &str,
        count: u64,
    ) -> Self {
        let file = place.directory.join("wheel.bin");
        let mut command = Command::new(python);
        command
            .args([
                script,
                place.instance,
                &count.to_string(),
                file.to_str().unwrap(),
            ])
            .env("XDG_RUNTIME_DIR", place.directory)
            .env("PYTHONPATH", installed)
            .env_remove("GLIDEPATH_LIBRARY")
            .env_remove("LD_LIBRARY_PATH");
        Self::spawn("wheel", command, file)
    }

    fn run(place: Place<'_>, name: &str, program: &str, arguments: &[&str]) -> Self {
        let library = build::library_folder(place).join(build::soname());
        let mut command = Command::new(program);
        command
            .args(arguments)
            .env("XDG_RUNTIME_DIR", place.directory)
            .env("GLIDEPATH_LIBRARY", library)
            .env("PYTHONPATH", build::source("python"))
            .env("PYTHONDONTWRITEBYTECODE", "1");
        Self::spawn(name, command, place.directory.join(format!("{name}.bin")))
    }

    fn spawn(name: &str, mut command: Command, file: PathBuf) -> Self {
        let mut child = command
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        let output = BufReader::new(child.stdout.take().unwrap());
        Self {
            name: name.to_owned(),
            child,
            output,
            file,
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
        let (status, complaint) = self.end();
        assert!(
            status.success(),
            "{}: {status}, {told}{complaint}",
            self.name
        );
        let written = std::fs::read(&self.file).unwrap_or_default();
        (self.name.clone(), told, written)
    }
}

impl Consumer {
    fn end(&mut self) -> (ExitStatus, String) {
        let mut complaint = String::new();
        let stderr = self.child.stderr.take();
        stderr.unwrap().read_to_string(&mut complaint).unwrap();
        (self.child.wait().unwrap(), complaint)
    }

    /// What it complained of: it is not to succeed.
    pub(crate) fn fails(mut self) -> String {
        let (status, complaint) = self.end();
        assert!(!status.success(), "{}: {complaint}", self.name);
        complaint
    }
}

impl Drop for Consumer {
    fn drop(&mut self) {
        // One that has ended already cannot be killed, and need not be.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
