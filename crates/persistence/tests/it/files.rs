//! Tests on real files: writers that are killed, one writer at a time, files that are damaged or
//! gone.

#![allow(clippy::expect_used, reason = "a test that fails may panic")]
#![allow(
    clippy::print_stdout,
    reason = "the writer tells which generation was answered"
)]

use crate::generations::kept_of;
use glidepath_persistence::{Directory, Rest, SLOTS, Store, StoreError};
use std::fs::Permissions;
use std::io::{BufRead as _, BufReader};
use std::os::unix::fs::{PermissionsExt as _, symlink};
use std::os::unix::process::CommandExt as _;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Duration;

/// The folder in which this test binary is to be a writer.
const WRITER: &str = "GLIDEPATH_KEPT_WRITER";

fn store(folder: &Path) -> Store<Directory> {
    Store::new(Directory::open(folder).expect("a folder"))
}

fn written(folder: &Path, generations: u64) -> Store<Directory> {
    let mut store = store(folder);
    for generation in 1..=generations {
        let answered = store.write(&kept_of(generation)).expect("it is written");
        assert_eq!(answered, generation);
    }
    store
}

/// Writes generations, and says each when it is answered, until it is killed.
fn write_for_ever(folder: &Path) -> ! {
    let mut store = store(folder);
    let mut generation = store.read().expect("whole").map_or(0, |(number, _)| number);
    loop {
        generation += 1;
        store.write(&kept_of(generation)).expect("it is written");
        println!("answered {generation}");
    }
}

#[test]
fn a_writer_that_is_killed_leaves_the_old_or_the_new_generation() {
    if let Some(folder) = std::env::var_os(WRITER) {
        write_for_ever(Path::new(&folder));
    }
    let folder = tempfile::tempdir().expect("a folder");
    let mut known = 0;
    for kill in 0_u64..25 {
        let mut writer = Command::new(std::env::current_exe().expect("this test"))
            .args(["--exact", "--nocapture"])
            .arg("files::a_writer_that_is_killed_leaves_the_old_or_the_new_generation")
            .env(WRITER, folder.path())
            .stdout(Stdio::piped())
            .spawn()
            .expect("a writer");
        let mut lines = BufReader::new(writer.stdout.take().expect("its output")).lines();
        // The first answer says that it works; the kill comes at some moment behind that.
        // On a host with one processor the name of the test stands before the first.
        let answer = |line: String| line.split_once("answered ")?.1.parse().ok();
        let first: u64 = lines
            .by_ref()
            .find_map(|line| answer(line.expect("text")))
            .expect("an answer");
        assert_eq!(first, known + 1);
        std::thread::sleep(Duration::from_micros(kill * 1379 % 20_000));
        writer.kill().expect("it is killed");
        writer.wait().expect("it ended");
        let last: u64 = lines
            .map_while(|line| answer(line.ok()?))
            .last()
            .unwrap_or(first);
        let (found, kept) = store(folder.path())
            .read()
            .expect("whole")
            .expect("something");
        assert_eq!(kept, kept_of(found));
        assert!(
            found == last || found == last + 1,
            "{found}, {last} was answered"
        );
        known = found;
    }
}

#[test]
fn one_process_writes_at_a_time() {
    let folder = tempfile::tempdir().expect("a folder");
    let directory = Directory::open(folder.path()).expect("a folder");
    let lock = directory.lock().expect("nobody writes");
    let other = Directory::open(folder.path()).expect("a folder");
    let taken = other.lock().expect_err("somebody writes");
    let process = std::process::id();
    assert!(
        taken
            .to_string()
            .starts_with(&format!("process {process} keeps its state in ")),
        "{taken}"
    );
    drop(lock);
    other.lock().expect("nobody writes any more");
}

/// A folder that is a link today leads elsewhere tomorrow.
#[test]
fn a_link_to_a_folder_is_not_the_folder() {
    let folder = tempfile::tempdir().expect("a folder");
    let (here, link) = (folder.path().join("state"), folder.path().join("link"));
    written(&here, 2);
    symlink(&here, &link).expect("a link");
    for name in [link.clone(), link.join("")] {
        let error = Directory::open(&name)
            .expect_err("it is refused")
            .to_string();
        assert!(error.contains("symbolic link"), "{error}");
        let error = Store::new(Directory::at(&name))
            .read()
            .expect_err("it is refused");
        assert!(error.to_string().contains("symbolic link"), "{error}");
    }
    // On the way to it they are what the owner of the host made of them.
    let way = folder.path().join("way");
    symlink(folder.path(), &way).expect("a link");
    let store = Store::new(Directory::open(&way.join("state")).expect("a folder"));
    store.read().expect("whole").expect("it was written");
}

/// What another user put there, or may put there, is neither read nor written through.
#[test]
fn what_others_may_change_is_not_taken_for_what_was_kept() {
    let mode = |path: &Path, mode: u32| {
        std::fs::set_permissions(path, Permissions::from_mode(mode)).expect("its mode is set");
    };
    let folder = tempfile::tempdir().expect("a folder");
    let here = folder.path().join("state");
    let mut store = written(&here, 2);
    let slot = here.join(SLOTS[0]);
    let told = |result: Result<_, StoreError>| result.expect_err("it is refused").to_string();
    for (open, closed) in [(&here, 0o750), (&slot, 0o640)] {
        mode(open, closed | 0o002);
        let error = told(store.read());
        assert!(error.contains("everybody may write to it"), "{error}");
        mode(open, closed);
        store.read().expect("whole");
    }
    mode(&here, 0o777);
    let error = Directory::open(&here)
        .expect_err("it is refused")
        .to_string();
    assert!(error.contains("everybody may write to it"), "{error}");
    mode(&here, 0o750);
    // A file elsewhere is not written to in the place of a generation.
    let victim = folder.path().join("victim");
    std::fs::write(&victim, "the work of a week").expect("it is written");
    symlink(&victim, here.join("kept.new")).expect("a link");
    store.write(&kept_of(3)).expect("it is written");
    let left = std::fs::read_to_string(&victim).expect("text");
    assert_eq!(left, "the work of a week");
    symlink(&victim, here.join("lock")).expect("a link");
    let directory = Directory::open(&here).expect("a folder");
    assert!(matches!(directory.lock(), Err(StoreError::Io { .. })));
    // Nor is one that is linked there read, and what is no file is not waited for.
    std::fs::rename(&slot, folder.path().join("other")).expect("it is moved");
    symlink(folder.path().join("other"), &slot).expect("a link");
    assert!(matches!(store.read(), Err(StoreError::Io { .. })));
    std::fs::remove_file(&slot).expect("it is gone");
    let made = Command::new("mkfifo").arg(&slot).status().expect("a FIFO");
    assert!(made.success());
    let error = told(store.read());
    assert!(error.contains("it is no file"), "{error}");
}

/// Skipped, with a word about it, unless root runs it.
#[test]
fn nothing_is_written_in_the_folder_of_another_user() {
    const NOBODY: u32 = 65_534;
    const AS_NOBODY: &str = "GLIDEPATH_KEPT_NOBODY";
    if let Some(folder) = std::env::var_os(AS_NOBODY) {
        let error = Directory::open(Path::new(&folder)).expect_err("it is another's");
        println!("refused: {error}");
        return;
    }
    if !glidepath_testing::can_be_another_user() {
        return;
    }
    let folder = tempfile::tempdir().expect("a folder");
    let shared = folder.path().join("state");
    std::fs::create_dir(&shared).expect("a folder");
    std::os::unix::fs::chown(&shared, Some(1), Some(NOBODY)).expect("it is given away");
    for (path, mode) in [(folder.path(), 0o755), (&*shared, 0o770)] {
        std::fs::set_permissions(path, Permissions::from_mode(mode)).expect("its mode is set");
    }
    // Another user cannot go where this test was built.
    let own = folder.path().join("test");
    std::fs::copy(std::env::current_exe().expect("this test"), &own).expect("a copy");
    let output = Command::new(own)
        .args(["--exact", "--nocapture"])
        .arg("files::nothing_is_written_in_the_folder_of_another_user")
        .env(AS_NOBODY, &shared)
        .current_dir("/")
        .uid(NOBODY)
        .gid(NOBODY)
        .output()
        .expect("the other user");
    let told = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(output.status.success(), "{output:?}");
    assert!(told.contains("it belongs to user 1"), "{told}");
}

#[test]
fn a_damaged_file_needs_the_operator() {
    for (slot, newest) in [(SLOTS[0], 4), (SLOTS[1], 4), (SLOTS[0], 5), (SLOTS[1], 5)] {
        let folder = tempfile::tempdir().expect("a folder");
        let mut store = written(folder.path(), newest);
        let path = folder.path().join(slot);
        let good = std::fs::read(&path).expect("a file");
        for at in (0..good.len()).step_by(97) {
            let mut bad = good.clone();
            bad[at] ^= 1;
            std::fs::write(&path, &bad).expect("it is written");
            let read = store.read().expect_err("it is damaged");
            let is_told = matches!(&read, StoreError::Damaged { file, .. } if file.ends_with(slot));
            // The version itself may have become a later one.
            assert!(
                is_told || matches!(read, StoreError::Newer { .. }),
                "{at}: {read}"
            );
            assert!(
                store.write(&kept_of(9)).is_err(),
                "nothing is written over it"
            );
        }
        for gone in [true, false] {
            if gone {
                std::fs::remove_file(&path).expect("it is gone");
            } else {
                std::fs::write(&path, &good[..good.len() / 2]).expect("it is written");
            }
            assert!(matches!(store.read(), Err(StoreError::Damaged { .. })));
        }
        // The operator takes what is left: the older or the newer of the two.
        let (generation, kept) = store.recover().expect("the other file is whole");
        let is_newest =
            usize::from(newest % 2 == 1) == SLOTS.iter().position(|s| *s == slot).expect("a slot");
        let left = if is_newest { newest - 1 } else { newest };
        assert_eq!((generation, &kept), (left + 1, &kept_of(left)));
        assert_eq!(store.read().expect("whole"), Some((left + 1, kept)));
    }
}

#[test]
fn what_is_no_number_is_not_kept() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut store = written(folder.path(), 1);
    let mut bad = kept_of(2);
    bad.rest = Some(Rest {
        position: [f64::NAN; 9],
        clean: true,
    });
    assert!(matches!(
        store.write(&bad),
        Err(StoreError::NotKeepable { .. })
    ));
    for far in [f64::INFINITY, 1e300, -1e10] {
        bad = kept_of(2);
        bad.offsets.systems[3].origin[1] = far;
        let refused = store.write(&bad).expect_err("no machine is there");
        assert!(matches!(refused, StoreError::NotKeepable { .. }), "{far}");
    }
    bad = kept_of(2);
    bad.offsets.active = 10;
    assert!(matches!(
        store.write(&bad),
        Err(StoreError::NotKeepable { .. })
    ));
    assert_eq!(store.read().expect("whole"), Some((1, kept_of(1))));
}
