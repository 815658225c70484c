//! Tests of output files: what commands write never takes the place of what somebody else put
//! there, is whole or not there, and is told of when it cannot be written.

#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    reason = "a test that fails may panic"
)]

use std::fs::{self, File};
use std::io::Read as _;
use std::os::unix::fs::FileTypeExt as _;
use std::os::unix::process::ExitStatusExt as _;
use std::path::Path;
use std::process::{Child, Command, Output, Stdio};
use std::time::{Duration, Instant};

const SQUARE: &str = "G21 G90\nG0 X1\nG1 X11 F3000\nY10\nX1\nY0\nM2\n";

/// The command, to its end, or for a minute at most: a pipe may be waited for.
fn glidepath(folder: &Path, args: &[&str]) -> Output {
    let mut command = Command::new("timeout");
    command.args(["--signal=KILL", "60", env!("CARGO_BIN_EXE_glidepath")]);
    command.current_dir(folder).args(args).output().unwrap()
}

fn said(output: &Output) -> (i32, String) {
    let text = String::from_utf8(output.stderr.clone()).unwrap();
    (output.status.code().unwrap(), text)
}

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap();
    let name = |entry: std::io::Result<fs::DirEntry>| entry.unwrap().file_name();
    let mut names: Vec<_> = entries
        .map(|entry| name(entry).into_string().unwrap())
        .collect();
    names.sort();
    names
}

#[test]
fn what_is_read_is_never_overwritten() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    fs::write(here.join("part.ngc"), SQUARE).unwrap();
    std::os::unix::fs::symlink("part.ngc", here.join("link.csv")).unwrap();
    fs::hard_link(here.join("part.ngc"), here.join("hard.svg")).unwrap();
    let config = include_str!("../../../../config/mill.toml");
    fs::write(here.join("mill.toml"), config).unwrap();
    for output in [
        ["--setpoints", "part.ngc"],
        ["--setpoints", "link.csv"],
        ["--plot", "hard.svg"],
        ["--plot", "./mill.toml"],
    ] {
        for force in [&[][..], &["--force"]] {
            let args = ["plan", "part.ngc", "-c", "mill.toml"];
            let args = [&args[..], &output, force].concat();
            let (code, text) = said(&glidepath(here, &args));
            assert_eq!(code, 2, "{args:?}: {text}");
            assert!(text.contains("the command reads it"), "{args:?}: {text}");
        }
    }
    let args = ["fit", "part.ngc", "--tolerance", "0.1", "--output"];
    let args = [&args[..], &["part.ngc", "--force"]].concat();
    assert_eq!(said(&glidepath(here, &args)).0, 2);
    assert_eq!(fs::read_to_string(here.join("part.ngc")).unwrap(), SQUARE);
    assert_eq!(fs::read_to_string(here.join("mill.toml")).unwrap(), config);
    assert_eq!(
        names(here),
        ["hard.svg", "link.csv", "mill.toml", "part.ngc"]
    );
}

/// What a program calls is read, too, wherever it was found.
#[test]
fn a_subroutine_that_is_called_is_never_overwritten() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let drill = "o<drill> sub\nG1 X2 F600\no<drill> endsub\nM2\n";
    fs::create_dir(here.join("lib")).unwrap();
    fs::write(here.join("lib/drill.ngc"), drill).unwrap();
    fs::write(here.join("part.ngc"), "G21 G90\no<drill> call\nM2\n").unwrap();
    for output in ["--setpoints", "--plot"] {
        let args = ["plan", "part.ngc", "--subroutine-path", "lib", "--force"];
        let args = [&args[..], &[output, "lib/drill.ngc"]].concat();
        let (code, text) = said(&glidepath(here, &args));
        assert_eq!(code, 2, "{output}: {text}");
        assert!(text.contains("the command reads it"), "{output}: {text}");
    }
    let kept = fs::read_to_string(here.join("lib/drill.ngc")).unwrap();
    assert_eq!(kept, drill);
}

/// Nor is the program that becomes part of a recording.
#[test]
fn a_program_that_is_recorded_is_not_overwritten_by_its_recording() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    fs::write(here.join("part.ngc"), SQUARE).unwrap();
    let args = ["record", "part.ngc", "--program", "part.ngc", "--force"];
    let args = [&args[..], &["--seconds", "0.1", "--instance", "outputs"]].concat();
    let (code, text) = said(&glidepath(here, &args));
    assert_eq!(code, 2, "{text}");
    assert!(text.contains("the command reads it"), "{text}");
    assert_eq!(fs::read_to_string(here.join("part.ngc")).unwrap(), SQUARE);
}

#[test]
fn a_file_of_another_kind_is_overwritten_only_when_told() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    fs::write(here.join("part.ngc"), SQUARE).unwrap();
    fs::write(here.join("notes"), "the work of a week\n").unwrap();
    for kind in ["--setpoints", "--plot"] {
        let (code, text) = said(&glidepath(here, &["plan", "part.ngc", kind, "notes"]));
        assert_eq!(code, 2, "{text}");
        assert!(text.contains("--force"), "{text}");
        let kept = fs::read_to_string(here.join("notes")).unwrap();
        assert_eq!(kept, "the work of a week\n");
    }
    let both = ["plan", "part.ngc", "--setpoints", "new", "--plot", "./new"];
    assert_eq!(said(&glidepath(here, &both)).0, 2);
    assert_eq!(names(here), ["notes", "part.ngc"]);
    let forced = ["plan", "part.ngc", "--setpoints", "notes", "--force"];
    assert_eq!(said(&glidepath(here, &forced)).0, 0);
    // Its own kind is overwritten, through a link too, and the file keeps its rights.
    std::os::unix::fs::symlink("notes", here.join("link")).unwrap();
    let again = ["plan", "part.ngc", "--setpoints", "link"];
    assert_eq!(said(&glidepath(here, &again)).0, 0);
    assert!(here.join("link").is_symlink());
    let csv = fs::read_to_string(here.join("notes")).unwrap();
    assert!(csv.starts_with("tick,time_s,") && csv.ends_with('\n'));
    assert_eq!(names(here), ["link", "notes", "part.ngc"]);
}

/// A path that leads through a folder of devices is a path like another.
#[test]
fn what_only_looks_like_a_device_is_a_file() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path().canonicalize().unwrap();
    let here = here.as_path();
    fs::write(here.join("part.ngc"), SQUARE).unwrap();
    fs::write(here.join("notes"), "the work of a week\n").unwrap();
    std::os::unix::fs::symlink("/proc/self", here.join("me")).unwrap();
    std::os::unix::fs::symlink(here, here.join("around")).unwrap();
    let below = here.strip_prefix("/").unwrap().to_str().unwrap();
    for way in [
        format!("/dev/../{below}"),
        format!("/dev/shm/../../{below}"),
        "/proc/self/cwd".to_owned(),
        "me/cwd".to_owned(),
        "around".to_owned(),
    ] {
        for (name, why, force) in [
            ("notes", "--force", &[][..]),
            ("part.ngc", "the command reads it", &["--force"]),
        ] {
            let path = format!("{way}/{name}");
            let args = [&["plan", "part.ngc", "--setpoints", &path], force].concat();
            let (code, text) = said(&glidepath(here, &args));
            assert_eq!(code, 2, "{path}: {text}");
            assert!(text.contains(why), "{path}: {text}");
        }
        let new = format!("{way}/new");
        let both = ["plan", "part.ngc", "--setpoints", &new, "--plot", "new"];
        let (code, text) = said(&glidepath(here, &both));
        assert_eq!(code, 2, "{new}: {text}");
    }
    // Nor is what is read appended to where it is standard output.
    let status = Command::new(env!("CARGO_BIN_EXE_glidepath"))
        .current_dir(here)
        .args(["plan", "part.ngc", "--setpoints", "/dev/stdout"])
        .stdout(
            File::options()
                .append(true)
                .open(here.join("part.ngc"))
                .unwrap(),
        )
        .status()
        .unwrap();
    assert_eq!(status.code(), Some(2));
    assert_eq!(fs::read_to_string(here.join("part.ngc")).unwrap(), SQUARE);
    let notes = fs::read_to_string(here.join("notes")).unwrap();
    assert_eq!(notes, "the work of a week\n");
    assert_eq!(names(here), ["around", "me", "notes", "part.ngc"]);
}

#[test]
fn a_plot_is_not_called_what_it_is_not() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    fs::write(here.join("part.ngc"), SQUARE).unwrap();
    for name in ["out.png", "out.pdf", "new.v2"] {
        let (code, text) = said(&glidepath(here, &["plan", "part.ngc", "--plot", name]));
        assert_eq!(code, 2, "{text}");
        assert!(text.contains("NAME.svg"), "{text}");
    }
    for name in ["OUT.SVG", "out.html", "out"] {
        let (code, text) = said(&glidepath(here, &["plan", "part.ngc", "--plot", name]));
        assert_eq!(code, 0, "{text}");
    }
    assert_eq!(names(here), ["OUT.SVG", "out", "out.html", "part.ngc"]);
}

#[test]
fn a_folder_and_standard_input_are_told_from_programs() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    fs::create_dir(here.join("parts.ngc")).unwrap();
    for command in ["check", "plan", "run", "run-file"] {
        let (code, text) = said(&glidepath(here, &[command, "parts.ngc"]));
        assert_eq!(code, 2, "{command}: {text}");
        assert!(text.contains("it is a folder"), "{command}: {text}");
    }
    let (code, text) = said(&glidepath(here, &["run-file", "-"]));
    assert_eq!(code, 2, "{text}");
    assert!(text.contains("`glidepath planner -`"), "{text}");
}

#[test]
fn an_interrupted_command_leaves_what_was_there() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let mut long = String::from("G21 G90 F600\n");
    for i in 0..200_000 {
        long += &format!("G1 X{}.{} Y{}\n", i % 97, i % 10, i % 89);
    }
    fs::write(here.join("long.ngc"), long + "M2\n").unwrap();
    let old = "tick,time_s,line,state,feed_mm_s,path_mm,pos_X\nold\n";
    fs::write(here.join("out.csv"), old).unwrap();
    let args = [
        "plan",
        "long.ngc",
        "--setpoints",
        "out.csv",
        "--plot",
        "out.svg",
    ];
    let mut child = Command::new(env!("CARGO_BIN_EXE_glidepath"))
        .current_dir(here)
        .args(args)
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    // Both files have been begun; nothing that was there has been touched.
    wait_for_outputs(&mut child, here, "long.ngc");
    let pid = child.id().to_string();
    assert!(
        Command::new("kill")
            .args(["-INT", &pid])
            .status()
            .unwrap()
            .success()
    );
    let status = child.wait().unwrap();
    assert_eq!((status.code(), status.signal()), (Some(130), None));
    assert_eq!(fs::read_to_string(here.join("out.csv")).unwrap(), old);
    assert_eq!(names(here), ["long.ngc", "out.csv"]);
}

#[test]
fn a_fit_that_is_interrupted_ends_with_a_word_and_writes_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    // A run that is fitted for long.
    let mut dense = String::from("G21 G90 F600\n");
    for i in 0..60_000 {
        let x = f64::from(i) * 0.01;
        dense += &format!(
            "G1 X{:.4} Y{:.4}\n",
            90.0 * (x / 9.0).cos(),
            90.0 * (x / 7.0).sin()
        );
    }
    fs::write(here.join("dense.ngc"), dense + "M2\n").unwrap();
    for (signal, after) in [("-INT", 300), ("-TERM", 1500)] {
        let mut child = Command::new(env!("CARGO_BIN_EXE_glidepath"))
            .current_dir(here)
            .args([
                "fit",
                "dense.ngc",
                "--method",
                "hybrid",
                "--tolerance",
                "0.001",
                "--output",
                "out.ngc",
            ])
            .stdout(Stdio::null())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        std::thread::sleep(Duration::from_millis(after));
        let asked = Instant::now();
        let kill = Command::new("kill")
            .args([signal, &child.id().to_string()])
            .status();
        assert!(kill.unwrap().success());
        let status = child.wait().unwrap();
        let took = asked.elapsed();
        assert_eq!((status.code(), status.signal()), (Some(130), None));
        assert!(took < Duration::from_secs(5), "{took:?}");
        let mut told = String::new();
        child
            .stderr
            .take()
            .unwrap()
            .read_to_string(&mut told)
            .unwrap();
        assert!(told.contains("interrupted"), "{told}");
        assert_eq!(names(here), ["dense.ngc"]);
    }
}

#[test]
fn devices_and_pipes_are_written_as_they_are() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    fs::write(here.join("part.ngc"), SQUARE).unwrap();
    let args = ["plan", "part.ngc", "--setpoints", "/dev/stdout"];
    let piped = glidepath(here, &args);
    assert!(piped.status.success(), "{}", said(&piped).1);
    assert!(piped.stdout.starts_with(b"tick,time_s,"));
    let dash = glidepath(here, &["plan", "part.ngc", "--setpoints", "-"]);
    assert!(dash.status.success(), "{}", said(&dash).1);
    assert!(dash.stdout.starts_with(b"tick,time_s,"));
    let of = |bytes: &[u8]| String::from_utf8_lossy(bytes).contains("cycle time");
    assert!(!of(&dash.stdout) && of(&dash.stderr), "{}", said(&dash).1);
    for args in [
        &["plan", "part.ngc", "--setpoints", "-", "--plot", "-"][..],
        &["record", "-"],
    ] {
        let (code, text) = said(&glidepath(here, args));
        assert!(
            code != 0 && text.contains("- is not written"),
            "{code} {text}"
        );
    }
    assert_eq!(names(here), ["part.ngc"]);
    // Into a file, both the setpoints and the report.
    let status = Command::new(env!("CARGO_BIN_EXE_glidepath"))
        .current_dir(here)
        .args(args)
        .stdout(File::create(here.join("all.txt")).unwrap())
        .status()
        .unwrap();
    assert!(status.success());
    let all = fs::read_to_string(here.join("all.txt")).unwrap();
    assert!(
        all.contains("tick,time_s,") && all.contains("cycle time"),
        "{all}"
    );
    let fifo = here.join("fifo");
    assert!(
        Command::new("mkfifo")
            .arg(&fifo)
            .status()
            .unwrap()
            .success()
    );
    let pipe = fifo.clone();
    let reader = std::thread::spawn(move || fs::read(pipe).unwrap());
    let (code, text) = said(&glidepath(
        here,
        &["plan", "part.ngc", "--setpoints", "fifo"],
    ));
    assert_eq!(code, 0, "{text}");
    // It is still there, or the reader would wait for ever.
    assert!(fifo.metadata().unwrap().file_type().is_fifo());
    assert!(reader.join().unwrap().starts_with(b"tick,time_s,"));
}

#[test]
fn what_cannot_be_written_is_told_with_its_path() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    fs::write(here.join("part.ngc"), SQUARE).unwrap();
    let full = |args: &[&str]| {
        Command::new(env!("CARGO_BIN_EXE_glidepath"))
            .current_dir(here)
            .args(args)
            .stdout(File::options().write(true).open("/dev/full").unwrap())
            .output()
            .unwrap()
    };
    for args in [&["check", "part.ngc"][..], &["plan", "part.ngc", "--json"]] {
        let (code, text) = said(&full(args));
        assert_eq!(code, 5, "{args:?}: {text}");
        assert!(text.contains("standard output: No space left"), "{text}");
    }
    let (code, text) = said(&glidepath(
        here,
        &["plan", "part.ngc", "--plot", "/dev/full"],
    ));
    assert_eq!(code, 5, "{text}");
    assert!(text.contains("/dev/full: No space left"), "{text}");
    // In the thread that receives from the mock servo, too.
    let args = [
        "run",
        "part.ngc",
        "--best-effort",
        "--setpoints",
        "/dev/full",
    ];
    let (code, text) = said(&glidepath(here, &args));
    assert_eq!(code, 5, "{text}");
    assert!(text.contains("/dev/full: No space left"), "{text}");
    let (code, text) = said(&glidepath(
        here,
        &["plan", "part.ngc", "--plot", "no/p.svg"],
    ));
    assert_eq!(code, 2, "{text}");
    assert!(text.contains("no/p.svg: No such file"), "{text}");
}

#[test]
fn the_plot_nobody_asked_for_is_in_the_present_folder() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    fs::write(here.join("part.ngc"), SQUARE).unwrap();
    let (code, text) = said(&glidepath(here, &["run", "part.ngc", "--best-effort"]));
    assert_eq!(code, 0, "{text}");
    assert_eq!(names(here), ["part.ngc", "part.svg"]);
    fs::write(here.join("part.svg"), "<svg>a drawing</svg>").unwrap();
    let (code, text) = said(&glidepath(here, &["run", "part.ngc", "--best-effort"]));
    assert_eq!(code, 0, "{text}");
    assert!(text.contains("no plot: part.svg is not written"), "{text}");
    let kept = fs::read_to_string(here.join("part.svg")).unwrap();
    assert_eq!(kept, "<svg>a drawing</svg>");
}

#[test]
fn a_limit_of_the_size_of_files_is_told_where_it_is_met() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    fs::write(here.join("part.ngc"), SQUARE).unwrap();
    let command = format!(
        "ulimit -f 4; exec {} plan part.ngc --setpoints part.csv",
        env!("CARGO_BIN_EXE_glidepath")
    );
    let mut shell = Command::new("sh");
    let output = shell
        .current_dir(here)
        .args(["-c", &command])
        .output()
        .unwrap();
    assert_eq!(output.status.signal(), None, "{output:?}");
    let (code, text) = said(&output);
    assert_eq!(code, 5, "{text}");
    assert!(
        text.contains("part.csv") && text.contains("ulimit -f"),
        "{text}"
    );
    assert_eq!(names(here), ["part.ngc"]);
}

/// A run that is killed removes nothing: the next one does, when the processes of the first have ended.
#[test]
fn the_shared_memory_of_a_run_that_was_killed_goes_with_the_next_run() {
    let folder = tempfile::tempdir_in("/dev/shm").unwrap();
    let here = folder.path();
    fs::write(here.join("part.ngc"), "G21 G90\nG1 X10 F60\nM2\n").unwrap();
    fs::write(here.join("short.ngc"), "G21 G90\nG0 X.1\nM2\n").unwrap();
    let run = |program: &str| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_glidepath"));
        command
            .current_dir(here)
            .env("XDG_RUNTIME_DIR", here)
            .args(["run", program, "--best-effort", "--force"]);
        command.stdout(Stdio::null()).stderr(Stdio::null());
        command.spawn().unwrap()
    };
    let left = || {
        let runs = fs::read_dir(here.join("glidepath")).into_iter().flatten();
        runs.count()
    };
    let begun = Instant::now();
    let mut killed = run("part.ngc");
    while left() == 0 {
        assert!(begun.elapsed() < Duration::from_secs(60));
    }
    killed.kill().unwrap();
    killed.wait().unwrap();
    assert_eq!(left(), 1);
    while left() > 0 {
        assert!(begun.elapsed() < Duration::from_secs(60));
        assert!(run("short.ngc").wait().unwrap().success());
    }
}

/// Waits until a command that reads a program of a folder has two more of its files open, named or not.
fn wait_for_outputs(command: &mut Child, folder: &Path, program: &str) {
    let descriptors = format!("/proc/{}/fd", command.id());
    let is_output = |entry: &fs::DirEntry| {
        let link = fs::read_link(entry.path()).unwrap_or_default();
        link.starts_with(folder) && !link.ends_with(program)
    };
    let begun = Instant::now();
    while fs::read_dir(&descriptors)
        .unwrap()
        .flatten()
        .filter(is_output)
        .count()
        < 2
    {
        assert!(command.try_wait().unwrap().is_none());
        assert!(begun.elapsed() < Duration::from_secs(60));
        std::thread::sleep(Duration::from_millis(5));
    }
}

/// Whatever is being written has no name before it is whole.
#[test]
fn a_run_that_is_killed_leaves_no_file_behind() {
    let folder = tempfile::tempdir_in("/dev/shm").unwrap();
    let here = folder.path();
    let long = "G21 G90\nG1 X100 F60\nM2\n";
    fs::write(here.join("part.ngc"), long).unwrap();
    let mut command = Command::new(env!("CARGO_BIN_EXE_glidepath"));
    command
        .current_dir(here)
        .args(["run", "part.ngc", "--best-effort"]);
    command.args(["--plot", "r.svg", "--setpoints", "r.csv"]);
    command.stdout(Stdio::null()).stderr(Stdio::null());
    let mut run = command.spawn().unwrap();
    wait_for_outputs(&mut run, here, "part.ngc");
    run.kill().unwrap();
    run.wait().unwrap();
    assert_eq!(names(here), ["part.ngc"]);
}
