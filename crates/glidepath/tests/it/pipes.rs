//! A program is the same program in a file, on standard input and in a pipe.

#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    reason = "a test that fails may panic"
)]

use crate::support::finish;
use std::io::Write as _;
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::time::Duration;

/// A command that waits for a pipe which it has read already never ends.
const PATIENCE: Duration = Duration::from_secs(60);

/// A program longer than what is read to tell its dialect, which ends with a line.
fn long(last: &str) -> String {
    let mut text = String::from("G21 G90 G64\nF600\n");
    for i in 0..6_000 {
        text += &format!("G1 X{}.5 Y{}\n", i % 7, i % 5);
    }
    text + last + "\nM2\n"
}

/// What a command says of a program that it gets in four ways; standard input is given to all.
fn four_ways(text: &str, args: &[&str]) -> [(i32, String); 4] {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("program.ngc");
    std::fs::write(&file, text).unwrap();
    let fifo = folder.path().join("fifo");
    assert!(
        Command::new("mkfifo")
            .arg(&fifo)
            .status()
            .unwrap()
            .success()
    );
    let writer = {
        let (fifo, text) = (fifo.clone(), text.to_owned());
        // Ends when the command has read all of it, once.
        std::thread::spawn(move || std::fs::write(fifo, text))
    };
    let said = [&*file, Path::new("-"), Path::new("/dev/stdin"), &*fifo].map(|program| {
        let output = fed(text, args, program);
        let all = [output.stdout, output.stderr].concat();
        let all = String::from_utf8(all).unwrap();
        let name = program.display().to_string();
        (output.status.code().unwrap(), common(&all, &name))
    });
    writer.join().unwrap().unwrap();
    said
}

fn fed(text: &str, args: &[&str], program: &Path) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_glidepath"));
    let child = command.arg(args[0]).arg(program).args(&args[1..]);
    let child = child.stdin(Stdio::piped()).stdout(Stdio::piped());
    let mut child = child.stderr(Stdio::piped()).spawn().unwrap();
    let mut input = child.stdin.take().unwrap();
    let text = text.to_owned();
    // A command that is given a file does not read its input.
    let writer = std::thread::spawn(move || input.write_all(text.as_bytes()).ok());
    let output = finish(child, PATIENCE);
    writer.join().unwrap();
    output
}

/// What is to be the same: all but the name, and what the clock and the size of the process say.
fn common(text: &str, name: &str) -> String {
    let measured = ["planning", "wall", " in "];
    let lines = text.lines();
    let lines = lines.filter(|line| !measured.iter().any(|word| line.contains(word)));
    let unnamed = lines.map(|line| {
        // A name of one dash is in many words.
        let line = match line.strip_prefix(&format!("{name}:")) {
            Some(rest) => format!("PROGRAM:{rest}"),
            None => line.to_owned(),
        };
        let line = line.replace(&format!("[{name}:"), "[PROGRAM:");
        line.replace(&format!(": {name} is"), ": PROGRAM is")
    });
    unnamed.collect::<Vec<_>>().join("\n")
}

/// The file's verdict, after that of the others was found to be the same.
fn agreed(text: &str, args: &[&str]) -> (i32, String) {
    let [file, others @ ..] = four_ways(text, args);
    for other in others {
        assert_eq!(other, file, "{args:?}");
    }
    file
}

#[test]
fn check_finds_the_same_in_a_pipe() {
    let (code, said) = agreed("G1 X99999 F600\n", &["check"]);
    assert_eq!(code, 1, "{said}");
    let (code, said) = agreed(&long("G1 X99999"), &["check"]);
    assert_eq!(code, 1, "{said}");
    assert!(said.contains("PROGRAM:6003"), "{said}");
    let (code, _) = agreed(&long("G0 X0 Y0"), &["check"]);
    assert_eq!(code, 0);
}

#[test]
fn plan_plans_the_same_from_a_pipe() {
    let text = "G21 G90\nG1 X20 F1200\nG2 X30 Y10 I0 J10\nM2\n";
    let (code, said) = agreed(text, &["plan"]);
    assert_eq!(code, 0, "{said}");
    assert!(
        said.contains("3 segments") || said.contains("2 segments"),
        "{said}"
    );
    let (code, said) = agreed(&long("G1 X1.2.3"), &["plan"]);
    assert_eq!(code, 1, "{said}");
}

#[test]
fn fit_fits_the_same_from_a_pipe() {
    let mut text = String::from("G21 G90 G64\nF600\n");
    for i in 0..200 {
        let angle = f64::from(i) * 0.02;
        text += &format!(
            "G1 X{:.4} Y{:.4}\n",
            10.0 * angle.cos() - 10.0,
            10.0 * angle.sin()
        );
    }
    let (code, said) = agreed(&(text + "M2\n"), &["fit", "--tolerance", "0.01"]);
    assert_eq!(code, 0, "{said}");
}

const RING: &str = "# a circle\n\nkind = \"parametric\"\nx = \"5*cos(t)\"\ny = \"5*sin(t)\"\n\
                    z = \"0*t\"\nfrom = 0\nto = \"2*pi\"\nfeed = 1200.0\n";
const ARCH: &str = "{\"kind\": \"nurbs\", \"feed\": 3000.0, \"degree\": 2, \"knots\": [0, 0, 0, 1, 1, 1],\n\
                    \"control_points\": [[0.0, 0.0], [5.0, 10.0], [10.0, 0.0]]}\n";

/// A pipe has no ending that says what comes through it.
#[test]
fn a_curve_is_a_curve_in_a_pipe() {
    let same = |text: &str, command: &str| {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("curve.toml");
        std::fs::write(&file, text).unwrap();
        let whole = |output: Output, name: &Path| {
            let all = String::from_utf8([output.stdout, output.stderr].concat()).unwrap();
            let all = all.replace(&name.display().to_string(), "CURVE");
            (output.status.code().unwrap(), common(&all, "CURVE"))
        };
        let as_file = whole(fed("", &[command], &file), &file);
        let piped = fed(text, &[command], Path::new("/dev/stdin"));
        assert_eq!(whole(piped, Path::new("/dev/stdin")), as_file, "{command}");
        // The name of one dash is in many words.
        let code = fed(text, &[command], Path::new("-")).status.code();
        assert_eq!(code, Some(as_file.0), "{command}");
        as_file
    };
    for curve in [RING, ARCH] {
        for command in ["check", "plan"] {
            let (code, said) = same(curve, command);
            assert_eq!(code, 0, "{said}");
        }
    }
    assert_eq!(same(ARCH, "preview").0, 0);
    let (code, said) = same(&RING.replace("1200.0", "1e-9"), "check");
    assert_eq!(code, 1);
    assert!(said.contains("is out of range"), "{said}");
}

/// All that a command reads, it may read more than once, and the processes that it starts do.
#[test]
fn configuration_and_tools_may_come_through_pipes() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let mill = include_str!("../../../../config/mill.toml");
    std::fs::write(here.join("mill.toml"), mill).unwrap();
    std::fs::write(here.join("t.tbl"), "T1 P1 Z5\n").unwrap();
    let part = "G21 G90\nT1 M6\nG43\nG1 X2 F3000\nM2\n";
    std::fs::write(here.join("part.ngc"), part).unwrap();
    let script = "exec \"$0\" run part.ngc --best-effort --json -c <(cat mill.toml) \
                  --tool-table <(cat t.tbl)";
    let output = bash(here, script);
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(0), "{said}");
}

#[test]
fn a_trace_may_come_through_a_pipe() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let part = "G21 G90\nG1 X5 F3000\nY5\nM2\n";
    std::fs::write(here.join("part.ngc"), part).unwrap();
    let script = "\"$0\" plan part.ngc --setpoints trace.csv --json > /dev/null";
    assert!(bash(here, script).status.success());
    let verdicts = [
        "trace.csv",
        "<(cat trace.csv)",
        "/dev/stdin < trace.csv",
        "- < trace.csv",
    ];
    let verdicts = verdicts.map(|trace| {
        let script = format!("exec \"$0\" audit --program <(cat part.ngc) --json {trace}");
        let output = bash(here, &script);
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(0), "{trace}: {said}");
        let mut verdict: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
        verdict["file"].take();
        verdict
    });
    assert!(verdicts[0]["setpoints"].as_u64() > Some(10));
    assert!(verdicts[0]["max_deviation_mm"].is_number());
    for verdict in &verdicts[1..] {
        assert_eq!(verdict, &verdicts[0]);
    }
}

/// A script for the command, `$0`, in a folder.
fn bash(here: &Path, script: &str) -> Output {
    let mut command = Command::new("timeout");
    command.args(["60", "bash", "-c", script, env!("CARGO_BIN_EXE_glidepath")]);
    command.current_dir(here).output().unwrap()
}

#[test]
fn a_pipe_is_in_no_folder() {
    let [file, pipes @ ..] = four_ways("o<nowhere> call\nM2\n", &["check"]);
    assert_eq!(file.0, 1);
    for pipe in &pipes {
        assert_eq!(pipe, &pipes[0]);
    }
    // The file's folder was looked into, that of /dev/stdin was not.
    assert_ne!(file, pipes[0]);
}
