//! Tests of subroutines in other files, which belong to the program: resumption asks whether it is
//! the same. A file that changes while it is read is none.

#![expect(clippy::unwrap_used, reason = "a test that fails may panic")]

use std::fs::File;
use std::io::Write as _;
use std::path::Path;
use std::time::Duration;

use glidepath_gcode::{NoSubroutineFile, Options, SubroutineFile, Subroutines};
use glidepath_planner::{ItemSource, ProgramSource, Refusal, Supply};

fn fingerprint(program: &Path, called: &'static str) -> u64 {
    let subroutines = Subroutines::new(move |name| {
        if name != "a.ngc" {
            return Err(NoSubroutineFile::Missing { looked_in: vec![] });
        }
        Ok(SubroutineFile {
            name: name.into(),
            text: called.as_bytes().into(),
        })
    });
    let options = Options {
        subroutines: Some(subroutines),
        ..Options::default()
    };
    ProgramSource::open(program, options).unwrap().fingerprint()
}

#[test]
fn a_program_whose_subroutine_changed_is_another_one() {
    let folder = tempfile::tempdir().unwrap();
    let calling = folder.path().join("calling.ngc");
    std::fs::write(&calling, "o<a> call\nM2\n").unwrap();
    let (one, other) = (
        "o<a> sub\nG0 X1\no<a> endsub",
        "o<a> sub\nG0 X2\no<a> endsub",
    );
    assert_eq!(fingerprint(&calling, one), fingerprint(&calling, one));
    assert_ne!(fingerprint(&calling, one), fingerprint(&calling, other));

    let alone = folder.path().join("alone.ngc");
    std::fs::write(&alone, "G0 X1\nM2\n").unwrap();
    assert_eq!(fingerprint(&alone, one), fingerprint(&alone, other));
}

/// Longer than what is read at a time.
fn long_program() -> String {
    let moves: String = (0..20_000).map(|i| format!("G1 X{}\n", i % 7)).collect();
    format!("G21 G90 F600\n{moves}M2\n")
}

/// The items of a program that is changed when its first one has been taken, and how it ends.
fn read_while(change: impl FnOnce(&Path)) -> (usize, Supply) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("part.ngc");
    std::fs::write(&path, long_program()).unwrap();
    let mut source = ProgramSource::open(&path, Options::default()).unwrap();
    assert!(matches!(source.next_item(), Supply::Item(_)));
    // The clock of a file system may be coarse.
    std::thread::sleep(Duration::from_millis(20));
    change(&path);
    let mut items = 1;
    loop {
        match source.next_item() {
            Supply::Item(_) => items += 1,
            last => return (items, last),
        }
    }
}

fn is_refused_for_a_change(supply: &Supply) -> bool {
    let Supply::Refused(Refusal::Program { diagnostics, .. }) = supply else {
        return false;
    };
    diagnostics[0].to_string().contains("was changed while")
}

#[test]
fn a_program_that_is_cut_off_does_not_look_as_if_it_had_ended() {
    for length in [0, 40, 100_000] {
        let (items, last) = read_while(|path| {
            let file = File::options().write(true).open(path).unwrap();
            file.set_len(length).unwrap();
        });
        assert!(is_refused_for_a_change(&last), "{length}: {last:?}");
        assert!(items < 19_000, "{items}");
    }
}

#[test]
fn a_program_that_is_written_over_is_not_mixed_with_the_other() {
    let (_, last) = read_while(|path| std::fs::write(path, long_program()).unwrap());
    assert!(is_refused_for_a_change(&last), "{last:?}");
    let (_, last) = read_while(|path| {
        let mut file = File::options().append(true).open(path).unwrap();
        file.write_all(b"G1 X1\n").unwrap();
    });
    assert!(is_refused_for_a_change(&last), "{last:?}");
}

#[test]
fn another_file_of_the_same_name_changes_nothing() {
    let (items, last) = read_while(|path| {
        let other = path.with_extension("new");
        std::fs::write(&other, "M2\n").unwrap();
        std::fs::rename(other, path).unwrap();
    });
    assert!(matches!(last, Supply::End), "{last:?}");
    assert!(items > 17_000, "{items}");
}
