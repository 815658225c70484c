//! The test of the generated files: they are what the lists say.

use super::render;
use std::path::{Path, PathBuf};

const BEGIN: &str = "/* layout: begin, written by a test of the library */\n";
const END: &str = "/* layout: end */\n";

fn path(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(name)
}

/// Compares a file with what it is to be, or makes it that.
#[allow(
    clippy::unwrap_used,
    reason = "a test that cannot read its files fails"
)]
fn hold(name: &str, expected: &str) {
    let path = path(name);
    let is_blessed = std::env::var_os("GLIDEPATH_BLESS").is_some();
    if is_blessed {
        std::fs::write(&path, expected).unwrap();
    }
    let actual = std::fs::read_to_string(&path).unwrap_or_default();
    let differs = actual
        .lines()
        .zip(expected.lines())
        .position(|(is, is_to_be)| is != is_to_be);
    assert!(
        actual == expected,
        "{name} is not what the lists of structures say, from line {:?} on: after a new version of \
         the ABI (`ABI` in layout/abi.rs), write it with GLIDEPATH_BLESS=1 cargo test -p \
         glidepath-capi --lib",
        differs.map(|line| line + 1)
    );
}

#[test]
#[allow(
    clippy::unwrap_used,
    reason = "a test that cannot read its files fails"
)]
fn the_header_has_the_structures_of_the_library() {
    let header = std::fs::read_to_string(path("include/glidepath.h")).unwrap();
    let (before, rest) = header.split_once(BEGIN).unwrap();
    let (_, after) = rest.split_once(END).unwrap();
    let expected = [before, BEGIN, &render::header(), END, after].concat();
    hold("include/glidepath.h", &expected);
}

#[test]
fn the_python_package_has_the_structures_of_the_library() {
    hold("python/glidepath/_layout.py", &render::python());
}

#[test]
fn the_manual_has_the_offsets_of_the_library() {
    hold("../glidepath/docs/abi.md", &render::page());
}
