//! Tests of another user of the host, who wants to have a say.
//!
//! Skipped, with a word about it, unless root runs it.

use crate::instance::{Instance, frame, take, wait_for};
use crate::peer::{CAPACITY, Peer, say};
use core::time::Duration;
use glidepath_link::{Delivery, Ipc, LinkConfig, LinkError, Transport};
use glidepath_testing::{can_be_another_user, leave_out};
use std::fs::{File, Permissions};
use std::os::unix::fs::{MetadataExt as _, PermissionsExt as _, symlink};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;

/// User and group `nobody`.
const NOBODY: u32 = 65_534;

fn open_to_all(path: &Path) {
    std::fs::set_permissions(path, Permissions::from_mode(0o755)).unwrap();
}

/// How long an instance comes and goes before the eyes of an intruder.
const TIME: Duration = Duration::from_secs(2);
/// Set where `/dev/shm` is this test's own, so that whatever is there is of the instance.
const OWN_MEMORY: &str = "GLIDEPATH_TEST_OWN_MEMORY";

/// What an intruder does: for a while, everything it can to what it finds under a path, and, where that is
/// the test's own, in shared memory. It says how often it got hold of something, and of what first.
pub(crate) fn intrude(root: &Path) {
    let folder = root.parent().unwrap();
    let looks_around = std::env::var_os(OWN_MEMORY).is_some();
    say("looking");
    let (started, mut hold, mut looks) = (Instant::now(), Vec::new(), 0);
    while started.elapsed() < TIME || looks <= 10 {
        looks += 1;
        attack(root, &mut hold);
        for entry in std::fs::read_dir("/dev/shm").unwrap().flatten() {
            let path = entry.path();
            if looks_around && path != folder {
                attack(&path, &mut hold);
                hold.push(path);
            }
        }
    }
    let first = hold.first().map(PathBuf::as_path).unwrap_or(Path::new(""));
    say(&format!("{} {}", hold.len(), first.display()));
}

/// Opens what there is, and makes, links and moves what is not to be there; then whatever is below.
fn attack(path: &Path, hold: &mut Vec<PathBuf>) {
    let mut take = |taken: bool| {
        if taken {
            hold.push(path.to_owned());
        }
    };
    take(File::options().write(true).open(path).is_ok());
    take(
        File::options()
            .read(true)
            .open(path)
            .is_ok_and(|file| !is_directory(&file)),
    );
    take(std::fs::write(path.join("made"), "").is_ok());
    take(symlink("/etc/passwd", path.join("link")).is_ok());
    take(std::fs::rename(path, path.with_extension("moved")).is_ok());
    take(std::fs::remove_file(path).is_ok());
    for entry in std::fs::read_dir(path).into_iter().flatten().flatten() {
        hold.push(entry.path());
        attack(&entry.path(), hold);
    }
}

fn is_directory(file: &File) -> bool {
    file.metadata().is_ok_and(|data| data.is_dir())
}

/// Runs a command where `/dev/shm` is a file system of its own: what others leave in that of the host is
/// nothing of ours.
fn with_own_memory(program: &Path, arguments: &[&str]) -> Command {
    let script = "mount -t tmpfs -o mode=1777 none /dev/shm && exec \"$0\" \"$@\"";
    let mut command = Command::new("unshare");
    command
        .args(["--mount", "--propagation", "private", "sh", "-c", script])
        .arg(program)
        .args(arguments)
        .env(OWN_MEMORY, "");
    command
}

#[test]
fn nothing_of_an_instance_is_ever_in_the_hands_of_another_user() {
    if !can_be_another_user() {
        return;
    }
    if std::env::var_os(OWN_MEMORY).is_some() {
        return come_and_go_before_an_intruder();
    }
    let nothing = with_own_memory(Path::new("true"), &[]).output();
    if !nothing.is_ok_and(|output| output.status.success()) {
        leave_out(
            "shared memory outside of an instance",
            "a file system cannot be mounted in a namespace here",
        );
        return come_and_go_before_an_intruder();
    }
    let this = std::env::current_exe().unwrap();
    let test = "intruder::nothing_of_an_instance_is_ever_in_the_hands_of_another_user";
    let output = with_own_memory(&this, &[test, "--exact", "--nocapture"]).output();
    let output = output.unwrap();
    let said = String::from_utf8_lossy(&output.stdout);
    assert!(
        output.status.success() && said.contains("1 passed"),
        "{output:?}"
    );
}

fn come_and_go_before_an_intruder() {
    let instance = Instance::new();
    open_to_all(instance.config.root.parent().unwrap());
    let mut intruder = Peer::start_as(NOBODY, "intruder", &instance.config);
    assert_eq!(intruder.says(), "looking");
    let started = Instant::now();
    let mut rounds = 0;
    while started.elapsed() < TIME || rounds <= 3 {
        // Everything an instance has comes and goes.
        let link = instance.connect();
        let mut source = link.frame_source().unwrap();
        let mut sink = link.frame_sink().unwrap();
        let _ports = (
            link.setpoint_sink().unwrap(),
            link.setpoint_source().unwrap(),
        );
        let _status = (link.status_sink().unwrap(), link.status_source().unwrap());
        let _commands = (
            link.command_server().unwrap(),
            link.command_client().unwrap(),
        );
        wait_for(|| (sink.offer(&frame(1)).unwrap() == Delivery::Delivered).then_some(()));
        assert_eq!(take(&mut *source).sequence, 1);
        rounds += 1;
    }
    assert_eq!(intruder.says(), "0 ");
}

#[test]
fn a_place_that_is_taken_is_named_and_not_touched() {
    if !can_be_another_user() {
        return;
    }
    let folder = tempfile::tempdir_in("/dev/shm").unwrap();
    let victim = folder.path().join("victim");
    std::fs::create_dir(&victim).unwrap();
    open_to_all(&victim);
    let squatted = folder.path().join("squatted");
    std::fs::create_dir(&squatted).unwrap();
    std::fs::set_permissions(&squatted, Permissions::from_mode(0o700)).unwrap();
    std::os::unix::fs::chown(&squatted, Some(NOBODY), None).unwrap();
    let linked = folder.path().join("linked");
    symlink(&victim, &linked).unwrap();
    let file = folder.path().join("file");
    std::fs::write(&file, "").unwrap();
    // A directory on the way in which everybody may put another in its place.
    let open = folder.path().join("open");
    std::fs::create_dir(&open).unwrap();
    std::fs::set_permissions(&open, Permissions::from_mode(0o777)).unwrap();
    for (root, why) in [
        (squatted, "user 65534"),
        (linked, "a symbolic link"),
        (file, "no directory"),
        (open.join("link"), "others can replace"),
    ] {
        let config = LinkConfig {
            instance: "squatted".to_owned(),
            root,
            capacity: CAPACITY,
        };
        let error = Ipc::connect(&config).unwrap_err();
        assert!(matches!(error, LinkError::Root { .. }), "{error}");
        let text = error.to_string();
        assert!(text.contains(config.root.to_str().unwrap()), "{text}");
        assert!(text.contains(why), "{text}");
    }
    assert_eq!(victim.metadata().unwrap().mode() & 0o777, 0o755);
    assert_eq!(std::fs::read_dir(&victim).unwrap().count(), 0);
}
