//! Subroutines in other files belong to the program: resumption asks whether it is the same.

#![expect(clippy::unwrap_used, reason = "a test that fails may panic")]

use std::path::Path;

use glidepath_gcode::{NoSubroutineFile, Options, SubroutineFile, Subroutines};
use glidepath_planner::{ItemSource, ProgramSource};

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
