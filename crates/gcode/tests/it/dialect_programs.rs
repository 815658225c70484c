//! A seeded sample of what the fuzz targets of the dialects try.

use glidepath_gcode::Dialect;

use crate::dialect_program::{judge, program};

/// Programs of each dialect.
const PROGRAMS: u64 = 600;

/// Bytes that depend on the seed alone (splitmix64).
fn bytes(seed: u64, count: usize) -> Vec<u8> {
    let mut state = seed;
    let next = std::iter::repeat_with(move || {
        state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = state;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        (z ^ (z >> 31)).to_le_bytes()
    });
    next.flatten().take(count).collect()
}

fn sample(dialect: Dialect) {
    for seed in 0..PROGRAMS {
        let length = 8 + usize::try_from(seed % 90).expect("a small number");
        judge(dialect, &program(dialect, &bytes(seed, length)));
    }
}

#[test]
fn linuxcnc_programs_are_judged_soundly() {
    sample(Dialect::LinuxCnc);
}

#[test]
fn printer_programs_are_judged_soundly() {
    sample(Dialect::Marlin);
}

#[test]
fn fanuc_programs_are_judged_soundly() {
    sample(Dialect::Fanuc);
}

#[test]
fn siemens_programs_are_judged_soundly() {
    sample(Dialect::Siemens);
}
