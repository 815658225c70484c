//! A command that serves others on a port that it tells.

use std::io::{BufRead as _, BufReader};
use std::process::{Child, Command, Stdio};

use serde_json::Value;

use crate::{Instance, glidepath, of_this_test};

/// Starts `glidepath COMMAND --json --port 0` in an instance, and waits until it tells where it serves: the process, and
/// what it tells.
#[must_use]
pub fn served(instance: &Instance, command: &str, arguments: &[&str]) -> (Child, Value) {
    let mut child = of_this_test(&mut Command::new(glidepath()))
        .args([command, "--json", "--port", "0"])
        .args(["--instance", &instance.config().instance])
        .args(arguments)
        .env("XDG_RUNTIME_DIR", instance.directory())
        .env_remove("GLIDEPATH_CONFIG")
        .current_dir(instance.directory())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    let mut text = String::new();
    for line in BufReader::new(child.stdout.take().unwrap()).lines() {
        let line = line.unwrap();
        text.push_str(&line);
        if line == "}" {
            break;
        }
    }
    (child, serde_json::from_str(&text).unwrap())
}
