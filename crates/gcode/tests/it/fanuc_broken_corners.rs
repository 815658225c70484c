//! Tests of `,C` and `,R` of FANUC's and Haas' mills. Values are computed by hand.

use glidepath_gcode::{FanucParameters, OffsetMemory, Options, Program, check};
use glidepath_program::ItemKind;

use crate::fanuc_calls::{ends, finds, options};
use crate::support::listed;

#[track_caller]
fn near(text: &str, expected: &[[f64; 2]]) {
    let found: Vec<[f64; 2]> = ends(text).into_iter().map(|[x, y, _]| [x, y]).collect();
    let is_near = |(a, b): (&[f64; 2], &[f64; 2])| (a[0] - b[0]).hypot(a[1] - b[1]) < 2e-3;
    assert!(
        found.len() == expected.len() && found.iter().zip(expected).all(is_near),
        "{text}: {found:?}"
    );
}

/// The program of the control's manual: chamfers and arcs between lines, and between lines and an arc.
#[test]
fn corners_of_lines_and_arcs() {
    near(
        "G90 G0 X10 Y10\nG1 X50 ,C5 F100\nY25 ,R8\nG3 X80 Y55 R30 ,R8\nG1 X50 ,R8\nY70 ,C5\nX10 ,C5\nY10\nG0 X0 Y0",
        &[
            [10.0, 10.0],
            [45.0, 10.0],
            [50.0, 15.0],
            // The arc's centre is (50, 55): outside of it 38 from there, inside 22.
            [50.0, 17.852],
            [56.316, 25.673],
            [77.946, 44.091],
            [70.494, 55.0],
            [58.0, 55.0],
            [50.0, 63.0],
            [50.0, 65.0],
            [45.0, 70.0],
            [15.0, 70.0],
            [10.0, 65.0],
            [10.0, 10.0],
            [0.0, 0.0],
        ],
    );
}

/// Both ends of a chamfer are as far from the corner as its value, in a straight line.
#[test]
fn chamfers_beside_arcs() {
    let touch = [10.2, 396.0_f64.sqrt() / 10.0];
    near(
        "G1 X10 ,C2 F100\nG2 X20 Y10 R10",
        &[[8.0, 0.0], touch, [20.0, 10.0]],
    );
    near(
        "G0 X20 Y10\nG3 X10 Y0 R10 ,C2 F100\nG1 X0",
        &[[20.0, 10.0], touch, [8.0, 0.0], [0.0, 0.0]],
    );
    // In the cusp between two arcs about (0, 10) and (20, 10).
    let high = 10.0 + 396.0_f64.sqrt() / 10.0;
    near(
        "G0 Y20\nG2 X10 Y10 R10 ,C2 F100\nG2 X20 Y20 R10",
        &[[0.0, 20.0], [9.8, high], [10.2, high], [20.0, 20.0]],
    );
    for text in [
        "G1 X10 ,C15 F100\nG2 X20 Y10 R10",
        "G1 X50 ,C15 F100\nG2 X60 Y10 R10",
    ] {
        finds(text, &["2:1 invalid-value"]);
    }
}

fn haas() -> Options {
    Options {
        fanuc: FanucParameters {
            offset_memory: OffsetMemory::Haas,
            ..FanucParameters::default()
        },
        ..options()
    }
}

#[test]
fn a_haas_makes_chamfers_of_lines() {
    let found = check("G1 X10 ,C2 F100\nG2 X20 Y10 R10".as_bytes(), haas());
    assert_eq!(listed(&found), ["2:1 invalid-value"]);
    let found = check("G1 X10 ,C2 F100\nY20".as_bytes(), haas());
    assert_eq!(listed(&found), [""; 0]);
}

/// One dwell may stand between both moves; it comes behind the chamfer or arc.
#[test]
fn a_dwell_in_between() {
    for dwell in ["G4 P500", "G4 X0.5"] {
        let text = format!("G1 X10 ,C2 F100\n{dwell}\nY20");
        for options in [options(), haas()] {
            let found: Vec<String> = Program::new(text.as_bytes(), options)
                .map(|item| item.unwrap_or_else(|d| panic!("{text}\n{d}")))
                .filter_map(|item| match item.kind {
                    ItemKind::Move { segment, .. } => {
                        Some(format!("{} {}", segment.end()[0], segment.end()[1]))
                    }
                    ItemKind::Dwell(seconds) => Some(format!("{seconds} s")),
                    _ => None,
                })
                .collect();
            assert_eq!(found, ["8 0", "10 2", "0.5 s", "10 20"], "{text}");
        }
    }
    finds(
        "G1 X10 ,C2 F100\nG4 P500\nG4 P500\nY20",
        &["3:4 not-supported"],
    );
    finds("G1 X10 ,C2 F100\nM8\nY20", &["2:1 not-supported"]);
}

#[test]
fn a_corner_of_less_than_nothing_is_refused() {
    for word in ["C-2.", "R-2."] {
        let text = format!("G1 X10. F500 ,{word}\nY10.");
        finds(&text, &["1:14 invalid-value"]);
    }
}
