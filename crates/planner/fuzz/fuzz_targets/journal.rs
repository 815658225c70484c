//! The fuzz target: whatever an interpolator says of where a program was left: the rest of the
//! program is found and begins within the tolerance of the machine, or it is refused.
#![no_main]

use glidepath_gcode::Options;
use glidepath_geometry::AxisVector;
use glidepath_planner::{ItemSource, ProgramSource, Remainder, ResumePoint, Supply};
use glidepath_program::ItemKind;
use libfuzzer_sys::fuzz_target;

const TOLERANCE_MM: f64 = 0.02;
const PROGRAM: u64 = 7;

/// A text as if it were a file.
struct Text<'a>(ProgramSource<&'a [u8]>);

impl ItemSource for Text<'_> {
    fn next_item(&mut self) -> Supply {
        self.0.next_item()
    }

    fn lines_read(&self) -> u64 {
        self.0.lines_read()
    }

    fn fingerprint(&self) -> u64 {
        PROGRAM
    }
}

/// Position, block, path position, where the block began, and the program.
type Left<'a> = ([f64; 3], u8, f64, f64, &'a [u8]);

fuzz_target!(|left: Left<'_>| {
    let (at, block, path_s, block_path_s, text) = left;
    // The record is refused with other numbers.
    if !at
        .iter()
        .chain([&path_s, &block_path_s])
        .all(|x| x.is_finite())
    {
        return;
    }
    let mut position = AxisVector::zeros();
    position.as_mut_slice()[..3].copy_from_slice(&at);
    let point = ResumePoint {
        line: 0,
        position,
        program_start: AxisVector::zeros(),
        program: PROGRAM,
        block: block.into(),
        path_s,
        block_path_s,
        unanswered: block % 2 == 1,
        found: None,
    };
    let source = Text(ProgramSource::new(text, Options::default()));
    let Ok(mut rest) = Remainder::find(source, point, TOLERANCE_MM) else {
        return;
    };
    for _ in 0..200 {
        match rest.next_item() {
            Supply::Item(item) => {
                if let ItemKind::Move { segment, .. } = item.kind {
                    let ends = [segment.start(), segment.end()];
                    assert!(ends.iter().flatten().all(|x| x.is_finite()));
                }
            }
            Supply::Pending | Supply::Probe | Supply::End | Supply::Refused(_) => return,
        }
    }
});
