//! A seeded sample of what the fuzz targets of the dialects try.

use glidepath_gcode::{Dialect, Program};
use glidepath_program::ItemKind;

use crate::dialect_program::{judge, options, program};

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

#[test]
fn a_way_home_begins_where_the_last_move_ended() {
    // The turned frame makes the programmed Y another one by a rounding; G28 leaves the tip and its frame.
    let text =
        "G0 X0 Y-0.5 Z10\nG234 H0\nM3 S500 G97\nG1 X90 ,A11\nG51.1 X20\nG68 X20 Y-10 R20\nG28 Z3\n";
    judge(Dialect::Fanuc, text);
}

#[test]
fn an_arc_of_a_swivelled_plane_begins_where_the_last_move_ended() {
    let text = "CYCLE800(0,\"\",0,57,1,11,0.001,2.5,5,-10,-1,100,-1,-1)\nG3 I=270\n";
    judge(Dialect::Siemens, text);
}

#[test]
fn what_is_held_back_at_the_end_is_a_move_of_the_turned_axes() {
    let ends = |text: &str| {
        judge(Dialect::Fanuc, text);
        let items = Program::new(text.as_bytes(), options(Dialect::Fanuc));
        let moves = items.filter_map(|item| match item.expect("a program").kind {
            ItemKind::Move { segment, .. } => Some(segment.end()),
            _ => None,
        });
        moves.collect::<Vec<_>>()
    };
    // A compensated move, and one behind a corner.
    for text in ["C11\nG41 D1\nX7\n", "C11\nG1 X5 F100\nY5 ,R1\nX2\n"] {
        let found = ends(text);
        assert_eq!(found, ends(&format!("{text}M30\n")), "{text}");
        let last = found.last().expect("a move");
        assert!((last[5] - 11.0).abs() < 1e-12 && last[0] > 0.5, "{text}");
    }
}

#[test]
fn an_arc_beyond_a_kilometre_on_a_turned_table_is_refused() {
    let text = "G1 X=1000000 ANG=1\nG112 X=11\nG3 I=-45. J=AC(-45.) TURN=10\nENDLABEL:\nA_A:\nG1 A=7 C=3\n\
                C=ACN(-10)\nG3 I=12 J=AC(10) TURN=3\nG1 X=0 ANG=0\n";
    judge(Dialect::Siemens, text);
}

#[test]
fn a_scale_that_is_given_again_and_again_moves_nothing() {
    // Z of its centre is where the tool is.
    let text = "#1=0\nN7 #1=#1+1\nG44 H1\nG1 X1.\nG51 X-0.5 Y#1 P3\nIF[#1LT50]GOTO7\nM30\n";
    judge(Dialect::Fanuc, text);
    let items = Program::new(text.as_bytes(), options(Dialect::Fanuc));
    let moves = items.filter_map(|item| match item.expect(text).kind {
        ItemKind::Move { segment, .. } => Some(segment.end()),
        _ => None,
    });
    for end in moves {
        assert_eq!(end[2], 0.0, "{end}");
    }
}
