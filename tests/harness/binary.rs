//! The programs under test.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;

/// The `glidepath` binary of the profile and target directory these tests were built with, brought
/// up to date by cargo the first time (which takes a moment if `cargo test --workspace` has just
/// built it, and longer if only the tests were built). Outside of cargo, and where `GLIDEPATH_BUILT`
/// says that everything was built just now, it is taken as it is.
#[must_use]
pub fn glidepath() -> &'static Path {
    static BINARY: OnceLock<PathBuf> = OnceLock::new();
    BINARY.get_or_init(|| {
        built(
            &["--package", "glidepath", "--bin", "glidepath"],
            "glidepath",
        )
    })
}

/// The example `onlooker` of `glidepath-link`, likewise.
#[must_use]
pub fn onlooker() -> &'static Path {
    static BINARY: OnceLock<PathBuf> = OnceLock::new();
    BINARY.get_or_init(|| {
        built(
            &["--package", "glidepath-link", "--example", "onlooker"],
            "examples/onlooker",
        )
    })
}

fn built(what: &[&str], place: &str) -> PathBuf {
    // <target>/<profile>/deps/<this test>
    let this = std::env::current_exe().unwrap();
    let profile = this.parent().and_then(Path::parent).unwrap();
    if std::env::var_os("GLIDEPATH_BUILT").is_none()
        && let Some(cargo) = std::env::var_os("CARGO")
    {
        build(Path::new(&cargo), profile, what);
    }
    let binary = profile.join(place);
    assert!(
        binary.is_file(),
        "{} is missing: cargo build {}",
        binary.display(),
        what.join(" ")
    );
    binary
}

fn build(cargo: &Path, profile: &Path, what: &[&str]) {
    let name = match profile.file_name().and_then(|name| name.to_str()) {
        Some("debug") => "dev",
        Some(name) => name,
        None => panic!("{}: no profile", profile.display()),
    };
    let status = Command::new(cargo)
        .args(["build", "--quiet"])
        .args(what)
        .args(["--profile", name, "--target-dir"])
        .arg(profile.parent().unwrap())
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .status()
        .unwrap();
    assert!(
        status.success(),
        "{place} does not build",
        place = what.join(" ")
    );
}
