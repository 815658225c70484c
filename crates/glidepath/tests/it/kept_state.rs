//! Tests of what a machine keeps over a restart, with the real binary: set by hand, begun with,
//! changed by what was run and by nothing else.

#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    reason = "a test that fails may panic"
)]

use serde_json::{Value, json};
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::sync::atomic::{AtomicU32, Ordering};

struct Machine {
    folder: tempfile::TempDir,
    /// Where its processes meet. They are killed, and would leave their shared memory elsewhere.
    runtime: tempfile::TempDir,
}

impl Machine {
    fn new() -> Self {
        let folder = tempfile::tempdir().unwrap();
        let mill = include_str!("../../../../config/mill.toml");
        let mill = mill.replace("# directory = \"state\"", "directory = \"state\"");
        std::fs::write(folder.path().join("mill.toml"), mill).unwrap();
        let runtime = tempfile::tempdir_in("/dev/shm").unwrap();
        Self { folder, runtime }
    }

    fn command(&self) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_glidepath"));
        command.env("XDG_RUNTIME_DIR", self.runtime.path());
        command
    }

    /// A process that goes on, in an instance.
    fn start(&self, instance: &str, args: &[&str]) -> Running {
        let mut command = self.command();
        command.args(args).args(["--instance", instance]);
        command.arg("--config").arg(self.path("mill.toml"));
        command.stdout(Stdio::null()).stderr(Stdio::null());
        Running(command.current_dir(self.folder.path()).spawn().unwrap())
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    fn file(&self, name: &str, text: &str) -> String {
        std::fs::write(self.path(name), text).unwrap();
        self.path(name).to_str().unwrap().to_owned()
    }

    fn glidepath(&self, args: &[&str]) -> Output {
        self.command()
            .args(args)
            .arg("--config")
            .arg(self.path("mill.toml"))
            .current_dir(self.folder.path())
            .output()
            .unwrap()
    }

    /// The object that a command prints; its exit code has to be 0.
    fn object(&self, args: &[&str]) -> Value {
        let output = self.glidepath(&[args, &["--json"]].concat());
        let told = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(0), "{told}");
        serde_json::from_slice(&output.stdout).expect("one object")
    }

    /// Has a program executed by a planner and an interpolator, as on a machine: `run` keeps nothing.
    fn execute(&self, args: &[&str]) {
        static STARTED: AtomicU32 = AtomicU32::new(0);
        let number = STARTED.fetch_add(1, Ordering::Relaxed);
        let instance = format!("kept-{}-{number}", std::process::id());
        let mut interpolator = self
            .command()
            .args([
                "interpolator",
                "--best-effort",
                "--instance",
                &instance,
                "--config",
            ])
            .arg(self.path("mill.toml"))
            .current_dir(self.folder.path())
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        let output = self.glidepath(&[&["planner"], args, &["--instance", &instance]].concat());
        interpolator.kill().unwrap();
        interpolator.wait().unwrap();
        let told = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(0), "{told}");
    }

    fn refused(&self, args: &[&str], exit: i32) -> String {
        let output = self.glidepath(args);
        let told = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(exit), "{told}");
        told
    }
}

fn axes(object: &Value, name: &str) -> Vec<f64> {
    let axes = object["offsets"][name]["axes"].as_array().unwrap();
    axes.iter().map(|value| value.as_f64().unwrap()).collect()
}

#[test]
fn programs_begin_with_what_was_set_and_leave_what_was_run() {
    let machine = Machine::new();
    let nothing = machine.object(&["offsets", "show"]);
    assert_eq!(nothing["generation"], 0);
    machine.object(&["offsets", "set", "G54", "X100", "Y-50.25"]);
    let set = machine.object(&["offsets", "set", "G30", "Z-1.5"]);
    assert_eq!(set["generation"], 2);
    assert_eq!(axes(&set, "G54")[..2], [100.0, -50.25]);

    let text = "G21 G90\nG0 X1 Y0\nG10 L2 P2 X5 R1.5\nG92 X0\nG28.1\nG1 X4 F6000\nM2\n";
    let part = machine.file("part.ngc", text);
    let checked = machine.object(&["check", &part]);
    assert_eq!(checked["programs"][0]["box"]["X"], json!([0.0, 105.0]));
    assert_eq!(checked["programs"][0]["box"]["Y"], json!([-50.25, 0.0]));
    machine.object(&["plan", &part]);
    assert_eq!(machine.object(&["offsets", "show"]), set, "nothing was run");

    let ran = machine.object(&["run", &part, "--best-effort"]);
    assert!(ran["cycle_time_s"].as_f64().unwrap() > 0.1);
    assert_eq!(
        machine.object(&["offsets", "show"]),
        set,
        "run keeps nothing"
    );

    machine.execute(&[&part]);
    let left = machine.object(&["offsets", "show"]);
    assert_eq!(axes(&left, "G54"), axes(&set, "G54"));
    assert_eq!(axes(&left, "G55")[0].to_bits(), 5.0_f64.to_bits());
    assert_eq!(left["offsets"]["G55"]["rotation_deg"], 1.5);
    assert_eq!(axes(&left, "G28")[..2], [101.0, -50.25]);
    assert_eq!(axes(&left, "G30")[2].to_bits(), (-1.5_f64).to_bits());
    assert_eq!(axes(&left, "G92")[0].to_bits(), 1.0_f64.to_bits());
    assert_eq!(left["rest"]["clean"], true);
    assert_eq!(left["rest"]["position"][0], 105.0);
    assert_eq!(left["program_under_way"], false);

    // G92 is kept, and not in force: X1 is where it was at first.
    let again = machine.file("again.ngc", "G21 G90\nG0 X1\nM2\n");
    let output = machine.glidepath(&["check", &again, "--json"]);
    let told = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(
        told.contains("the kept offset of G92 (X1) is not in force here"),
        "{told}"
    );
    let checked: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(checked["programs"][0]["box"]["X"], json!([0.0, 101.0]));
    let restored = machine.file("restored.ngc", "G21 G90\nG92.3\nG0 X1\nM2\n");
    let checked = machine.object(&["check", &restored]);
    assert_eq!(checked["programs"][0]["box"]["X"], json!([0.0, 102.0]));
}

#[test]
fn what_a_program_takes_back_is_kept_as_it_left_it() {
    let machine = Machine::new();
    machine.object(&["offsets", "set", "G55", "X100"]);
    // Long enough in G55 that it is kept under way, before M2 takes it back.
    let text = "G21 G90 G55 F6000\nG10 L2 P3 X7\nG1 X-60\nX-40\nG10 L2 P3 X0\nX-60\nM2\n";
    let part = machine.file("part.ngc", text);
    machine.execute(&[&part]);
    let left = machine.object(&["offsets", "show"]);
    assert_eq!(left["active"], "G54", "{left}");
    assert_eq!(axes(&left, "G56")[0].to_bits(), 0.0_f64.to_bits());
    assert_eq!(axes(&left, "G55")[0].to_bits(), 100.0_f64.to_bits());
}

#[test]
fn tools_that_g10_changed_are_kept_until_the_table_is_edited() {
    let machine = Machine::new();
    let table = machine.file("tools.tbl", "T1 P1 Z10 D6\nT2 P2 Z20 D8\n");
    let text = "G21 G90\nG10 L1 P2 Z33.5 R5\nG43 H2\nG0 Z1\nM2\n";
    let part = machine.file("part.ngc", text);
    machine.execute(&[&part, "--tool-table", &table]);
    let left = machine.object(&["offsets", "show"]);
    assert_eq!(left["tools_changed"][0]["number"], 2);
    assert_eq!(left["tools_changed"][0]["diameter_mm"], 10.0);
    let use_it = machine.file("use.ngc", "G21 G90\nG43 H2\nG0 Z1\nM2\n");
    let z_of = |part: &str| {
        let checked = machine.object(&["check", part, "--tool-table", &table]);
        checked["programs"][0]["box"]["Z"][1].as_f64().unwrap()
    };
    assert_eq!(z_of(&use_it).to_bits(), 34.5_f64.to_bits());
    machine.file("tools.tbl", "T1 P1 Z10 D6\nT2 P2 Z21 D8\n");
    assert_eq!(z_of(&use_it).to_bits(), 22.0_f64.to_bits());
}

#[test]
fn damage_and_another_machine_need_the_operator() {
    let machine = Machine::new();
    machine.object(&["offsets", "set", "G54", "X1"]);
    machine.object(&["offsets", "set", "G54", "X2"]);
    let part = machine.file("part.ngc", "G0 X1\nM2\n");
    let newest = machine.path("state/kept.0");
    let text = std::fs::read_to_string(&newest).unwrap();
    std::fs::write(&newest, text.replace("2.0", "3.0")).unwrap();
    let told = machine.refused(&["check", &part], 3);
    assert!(
        told.contains("kept.0 is damaged: its checksum is another"),
        "{told}"
    );
    assert!(
        told.contains("`glidepath offsets recover --config "),
        "{told}"
    );
    let recovered = machine.object(&["offsets", "recover"]);
    assert_eq!(axes(&recovered, "G54")[0].to_bits(), 1.0_f64.to_bits());
    machine.object(&["check", &part]);

    // With no file whole there is nothing to recover, and the way on is told.
    let files = ["kept.0", "kept.1"].map(|name| machine.path(&format!("state/{name}")));
    let whole = files.each_ref().map(|file| std::fs::read(file).unwrap());
    for file in &files {
        std::fs::write(file, "nothing").unwrap();
    }
    let told = machine.refused(&["offsets", "recover"], 3);
    assert!(told.contains("what was kept is lost. Move"), "{told}");
    assert!(!told.contains("offsets recover"), "{told}");
    for (file, bytes) in files.iter().zip(&whole) {
        std::fs::rename(file, file.with_extension("away")).unwrap();
        std::fs::write(file, bytes).unwrap();
    }
    machine.object(&["check", &part]);

    let mill = std::fs::read_to_string(machine.path("mill.toml")).unwrap();
    machine.file("mill.toml", &mill.replace("[axis.Y]", "[axis.U]"));
    let told = machine.refused(&["check", &part], 3);
    assert!(
        told.contains("belongs to a machine with other axes"),
        "{told}"
    );
    machine.object(&["offsets", "adopt"]);
    machine.object(&["check", &part]);
}

#[test]
fn linuxcnc_s_parameters_come_and_go_in_their_units() {
    let machine = Machine::new();
    let parameters = "5161\t1\n5210\t1\n5211\t0.5\n5220\t2\n5221\t-4\n5241\t2\n5250\t30\n";
    let file = machine.file("linuxcnc.var", parameters);
    let args = ["offsets", "import", &file, "--linear-units", "inch"];
    let output = machine.glidepath(&args);
    let told = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(
        told.contains("the offset of G92 was in force; it is kept and is not"),
        "{told}"
    );
    let kept = machine.object(&["offsets", "show"]);
    assert_eq!(kept["active"], "G55");
    assert!((axes(&kept, "G54")[0] + 101.6).abs() < 1e-12);
    let export = machine.glidepath(&["offsets", "export", "--linear-units", "inch"]);
    let text = String::from_utf8(export.stdout).unwrap();
    assert!(
        text.contains("\n5221\t-4\n") && text.contains("\n5250\t30\n"),
        "{text}"
    );
    // The units have to be said.
    machine.refused(&["offsets", "import", &file], 2);
    // Neither of two numbers for one axis can be the one that is meant.
    let told = machine.refused(&["offsets", "set", "G54", "X1", "Y2", "x10"], 2);
    assert!(told.contains("given before"), "{told}");
    let bad = machine.file("bad.var", "5221\t1\n5161\t1\n");
    let told = machine.refused(&["offsets", "import", &bad, "--linear-units", "mm"], 2);
    assert!(
        told.contains("line 2: parameter 5161 stands behind 5221"),
        "{told}"
    );
    assert_eq!(machine.object(&["offsets", "show"]), kept);
    let part = machine.file("part.ngc", "G0 X1\nM2\n");
    let told = machine.glidepath(&["check", &part]).stderr;
    let told = String::from_utf8_lossy(&told).into_owned();
    assert!(
        told.contains("programs begin in G55, which is kept"),
        "{told}"
    );
}

#[test]
fn nothing_is_kept_without_a_folder() {
    let mill = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../config/mill.toml");
    let output = Command::new(env!("CARGO_BIN_EXE_glidepath"))
        .args(["offsets", "show", "--config"])
        .arg(mill)
        .output()
        .unwrap();
    assert_eq!(output.status.code(), Some(3));
    let told = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(
        told.contains("names no folder to keep anything in"),
        "{told}"
    );
}

/// Ends with its test.
struct Running(std::process::Child);

impl Drop for Running {
    fn drop(&mut self) {
        self.0.kill().ok();
        self.0.wait().ok();
    }
}

#[test]
fn a_service_begins_in_the_system_that_was_chosen_meanwhile() {
    let machine = Machine::new();
    let instance = format!("kept-use-{}", std::process::id());
    let start = |args: &[&str]| machine.start(&instance, args);
    let _interpolator = start(&["interpolator", "--best-effort"]);
    let _service = start(&["planner", "--listen"]);
    let ask = |args: &[&str]| machine.glidepath(&[args, &["--instance", &instance]].concat());
    let first = ["mdi", "G21 G90 G54 G10 L2 P1 X7"];
    let begun = std::time::Instant::now();
    while !ask(&first).status.success() {
        assert!(begun.elapsed().as_secs() < 120, "{:?}", ask(&first));
        std::thread::sleep(std::time::Duration::from_millis(100));
    }
    let x = || {
        let told = ask(&["status", "--json"]).stdout;
        let told: Value = serde_json::from_slice(&told).unwrap();
        told["position"]["X"].as_f64().unwrap()
    };
    let goes = |args: &[&str], to: f64| {
        let output = ask(args);
        assert!(output.status.success(), "{output:?}");
        assert!((x() - to).abs() < 1e-9, "{args:?}: X {}, not {to}", x());
    };
    let part = machine.file("part.ngc", "G21 G90\nG0 X0\nM2\n");
    goes(&["mdi", "G10 L2 P2 X50"], 0.0);
    machine.object(&["offsets", "use", "G55"]);
    goes(&["run-file", &part], 50.0);
    // M2 has left G54.
    goes(&["mdi", "G0 X0"], 7.0);
    machine.object(&["offsets", "use", "G55"]);
    goes(&["mdi", "G0 X1"], 51.0);
    goes(&["mdi", "X2"], 52.0);
    goes(&["mdi", "G54 X0"], 7.0);
    machine.object(&["offsets", "set", "G54", "X9"]);
    goes(&["mdi", "X0"], 9.0);

    // Lost under the service, as with their disk: no line begins with other offsets, and none when they are back.
    let (state, away) = (machine.path("state"), machine.path("away"));
    std::fs::rename(&state, &away).unwrap();
    for args in [&["mdi", "X5"][..], &["run-file", &part]] {
        let output = ask(args);
        let told = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(!output.status.success(), "{told}");
        assert!(told.contains("is gone or was set back"), "{told}");
        assert!((x() - 9.0).abs() < 1e-9, "{args:?}: X {}", x());
    }
    std::fs::remove_dir_all(&state).unwrap();
    std::fs::rename(&away, &state).unwrap();
    goes(&["mdi", "X5"], 14.0);
}

/// FANUC keeps its variables from #500 to #999, and so are they here, whatever the language.
#[test]
fn parameters_from_500_to_999_are_kept() {
    let machine = Machine::new();
    let x_and_y = |text: &str| {
        let file = machine.file("asks.ngc", text);
        let planned = machine.object(&["plan", &file]);
        let end = &planned["final_position"];
        format!("{} {}", end["X"], end["Y"])
    };
    let asks = "G21 G90\nG0 X#500 Y[#499 + #999 + #1000]\nM2\n";
    assert_eq!(x_and_y(asks), "0.0 0.0");
    let sets = "G21 G90\n#500 = 7.5\n#499 = 1\n#1000 = 2\nG0 X1\n#999 = -3\nM2\n";
    machine.execute(&[&machine.file("sets.ngc", sets)]);
    assert_eq!(x_and_y(asks), "7.5 -3.0");
    // One that is not run keeps nothing, and 0 is as if nothing was assigned.
    machine.object(&["plan", &machine.file("plans.ngc", "#500 = 1\nM2\n")]);
    assert_eq!(x_and_y(asks), "7.5 -3.0");
    machine.execute(&[&machine.file("clears.ngc", "G21 G90\n#500 = 0\nG0 X1\nM2\n")]);
    assert_eq!(x_and_y(asks), "0.0 -3.0");
    let fanuc = "%\nO1\nG21 G90\nIF [#501 EQ #0] GOTO 10\nG0 X100.\nN10 G0 Y#999\nM30\n%\n";
    assert_eq!(x_and_y(fanuc), "0.0 -3.0");
}

#[test]
fn a_line_that_sets_up_what_will_be_lost_says_so() {
    let machine = Machine::new();
    let text = std::fs::read_to_string(machine.path("mill.toml")).unwrap();
    let instance = format!("kept-lost-{}", std::process::id());
    for keeps in [true, false] {
        if !keeps {
            machine.file("mill.toml", &text.replace("directory = \"state\"", ""));
        }
        let start = |args: &[&str]| machine.start(&instance, args);
        let _interpolator = start(&["interpolator", "--best-effort"]);
        let _service = start(&["planner", "--listen"]);
        let mdi = |line: &str| machine.glidepath(&["mdi", line, "--instance", &instance]);
        let begun = std::time::Instant::now();
        while !mdi("G21 G90").status.success() {
            assert!(begun.elapsed().as_secs() < 120);
            std::thread::sleep(std::time::Duration::from_millis(100));
        }
        for (line, sets_up) in [("G10 L20 P1 X0 Y5", true), ("G0 X1", false)] {
            let output = mdi(line);
            let told = String::from_utf8_lossy(&output.stdout).into_owned();
            assert!(output.status.success(), "{output:?}");
            assert_eq!(
                told.contains("is lost when the planner ends"),
                sets_up && !keeps,
                "{told}"
            );
        }
    }
}
