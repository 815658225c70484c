//! Configurations of other controls to convert, for the tests of the conversion and of the loader.

#![allow(
    clippy::expect_used,
    clippy::panic,
    reason = "test code, which clippy does not see as such"
)]

use glidepath_migration::{Conversion, from_grbl, from_klipper, from_linuxcnc};
use std::path::{Path, PathBuf};

/// The samples: the control, the file, and the files it includes.
pub(crate) const SAMPLES: [(&str, &str, &[&str]); 12] = [
    ("linuxcnc", "mill-mm.ini", &[]),
    ("linuxcnc", "gantry-inch.ini", &["gantry-axes.inc"]),
    ("linuxcnc", "gantry-mm.ini", &[]),
    ("linuxcnc", "delta.ini", &[]),
    ("grbl", "router.txt", &[]),
    ("grbl", "router-force-origin.txt", &[]),
    ("grbl", "grblhal.txt", &[]),
    ("grbl", "gantry.txt", &[]),
    ("klipper", "cartesian.cfg", &["macros.cfg"]),
    ("klipper", "gantry.cfg", &[]),
    ("klipper", "corexy.cfg", &[]),
    ("klipper", "delta.cfg", &[]),
];

pub(crate) fn folder(control: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../tests/data/migration")
        .join(control)
}

pub(crate) fn read(control: &str, file: &str) -> String {
    std::fs::read_to_string(folder(control).join(file)).expect("a sample")
}

pub(crate) fn convert(control: &str, text: &str) -> Conversion {
    let include = |name: &str| {
        std::fs::read_to_string(folder(control).join(name)).map_err(|error| error.to_string())
    };
    let converted = match control {
        "linuxcnc" => from_linuxcnc(text, &include),
        "grbl" => from_grbl(text),
        _ => from_klipper(text, &include),
    };
    converted.unwrap_or_else(|error| panic!("{control}: {error}"))
}
