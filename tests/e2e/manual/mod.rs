//! The test of every command of the manual, typed as it stands there: at a desk, or at a machine
//! with drives.

mod blocks;
mod machine;

use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::time::Duration;

use glidepath_tests::{Instance, Watchdog, glidepath, of_this_test};

use blocks::{How, root};
use machine::Machine;

const PATIENCE: Duration = Duration::from_secs(300);

/// What a shell is given: where the program is, and where processes meet.
struct Shell<'a> {
    instance: &'a Instance,
    programs: PathBuf,
}

impl<'a> Shell<'a> {
    /// The program under its name. This host need not be fit for real time: what the manual says of
    /// one that is holds for one that is not with `--best-effort`.
    fn new(instance: &'a Instance) -> Self {
        let programs = instance.directory().join("bin");
        std::fs::create_dir(&programs).unwrap();
        let script = format!(
            "#!/bin/sh\ncase \"$1\" in\ninterpolator) exec '{0}' \"$@\" --best-effort ;;\n\
             *) exec '{0}' \"$@\" ;;\nesac\n",
            glidepath().display()
        );
        let place = programs.join("glidepath");
        std::fs::write(&place, script).unwrap();
        std::fs::set_permissions(&place, PermissionsExt::from_mode(0o755)).unwrap();
        Self { instance, programs }
    }

    fn command(&self, folder: &Path, program: &str) -> Command {
        let path = std::env::var("PATH").unwrap();
        let mut command = Command::new(program);
        of_this_test(&mut command)
            .current_dir(folder)
            .env("PATH", format!("{}:{path}", self.programs.display()))
            .env("XDG_RUNTIME_DIR", self.instance.directory())
            .env("TMPDIR", self.instance.directory())
            .env("NO_COLOR", "1")
            .env("SHELL", "/bin/sh");
        command
    }

    fn run(&self, folder: &Path, text: &str) -> Output {
        let mut command = self.command(folder, "bash");
        command.args(["-euo", "pipefail", "-c", text]);
        command.output().unwrap()
    }
}

/// A folder with what the manual takes to be there.
fn desk(instance: &Instance, number: usize) -> PathBuf {
    let folder = instance.directory().join(format!("desk-{number}"));
    std::fs::create_dir(&folder).unwrap();
    let write = |name: &str, text: &str| std::fs::write(folder.join(name), text).unwrap();
    write("part.ngc", &part());
    let mill = std::fs::read_to_string(root().join("config/mill.toml")).unwrap();
    write("mill.toml", &mill.replace("# directory = ", "directory = "));
    write("linuxcnc.var", "5220\t1\n5221\t1.5\n5222\t0\n5223\t0\n");
    let delta = std::fs::read_to_string(root().join("config/rotary-delta.toml")).unwrap();
    write("delta.toml", &delta);
    let points = root().join("tests/data/calibration/rotary-delta.csv");
    std::fs::copy(points, folder.join("points.csv")).unwrap();
    write("x.csv", "position,error\n0,0\n100,0.004\n");
    let data = root().join("tests/data/migration");
    for (name, from) in [
        ("machine.ini", "linuxcnc/mill-mm.ini"),
        ("settings.txt", "grbl/router.txt"),
        ("printer.cfg", "klipper/corexy.cfg"),
    ] {
        std::fs::copy(data.join(from), folder.join(name)).unwrap();
    }
    // One lap shows it as well as ten.
    let place = "crates/glidepath/examples";
    let curve = std::fs::read_to_string(root().join(place).join("viviani.toml")).unwrap();
    std::fs::create_dir_all(folder.join(place)).unwrap();
    write(
        &format!("{place}/viviani.toml"),
        &curve.replace("laps = 10", "laps = 1"),
    );
    folder
}

/// A program as short as can be that still has a line 120 to begin with.
fn part() -> String {
    let mut text = "G21 G90 F3000\n".to_owned();
    for line in 0..128 {
        text.push_str(&format!("G1 X{:.1}\n", f64::from(line) * 0.1));
    }
    text + "M2\n"
}

fn is_code(output: &Output, code: i32) -> bool {
    output.status.code() == Some(code)
}

#[test]
fn every_command_of_the_manual_does_what_it_says() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let shell = Shell::new(&instance);
    let mut machine = Machine::new(&shell);
    let mut bad = Vec::new();
    let mut counts = [0; 2];
    for (number, block) in blocks::all().into_iter().enumerate() {
        match block.how {
            How::Desk(code) => {
                counts[0] += 1;
                let folder = desk(&instance, number);
                let output = shell.run(&folder, &block.text);
                if !is_code(&output, code) {
                    bad.push(format!("{}\n{}\n{output:#?}", block.place, block.text));
                }
            }
            How::Machine => {
                counts[1] += 1;
                let lines = block.text.lines().filter(|line| !line.trim().is_empty());
                for line in lines {
                    if let Err(why) = machine.type_line(line) {
                        bad.push(format!("{}\n{line}\n{why}", block.place));
                    }
                }
            }
            How::Not(_) => {}
        }
    }
    machine.end();
    assert!(bad.is_empty(), "{}", bad.join("\n\n"));
    assert!(
        counts[0] > 4 && counts[1] > 4,
        "few blocks are run: {counts:?}"
    );
}
