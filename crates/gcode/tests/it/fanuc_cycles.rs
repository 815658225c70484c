//! Tests of words that FANUC's mills take where others do not: modes, D, cycles, dwells.

use glidepath_gcode::{
    FanucParameters, Machine, OffsetMemory, Options, PointInput, Program, Threading, check,
};
use glidepath_geometry::Axis;
use glidepath_program::{Event, ItemKind, Limits};

use crate::fanuc_calls::{ends, finds, options};
use crate::support::listed;

pub(crate) fn last(text: &str) -> [f64; 3] {
    *ends(text).last().expect("a move")
}

fn dwells(text: &str) -> Vec<f64> {
    dwells_of(text, options())
}

/// Seconds of every dwell.
pub(crate) fn dwells_of(text: &str, options: Options) -> Vec<f64> {
    Program::new(text.as_bytes(), options)
        .map(|item| item.unwrap_or_else(|d| panic!("{text}\n{d}")))
        .filter_map(|item| match item.kind {
            ItemKind::Dwell(seconds) => Some(seconds),
            _ => None,
        })
        .collect()
}

#[test]
fn the_last_code_of_a_group_counts() {
    assert_eq!(last("G1 X1 F600\nG91 G90 G0 G1 X5"), [5.0, 0.0, 0.0]);
    assert_eq!(last("G90 G91 G0 X5\nX1"), [6.0, 0.0, 0.0]);
    assert_eq!(last("G20 G21 G0 X5"), [5.0, 0.0, 0.0]);
    assert_eq!(last("G0 G43 G49 H1 Z5"), [0.0, 0.0, 5.0]);
    // A cycle and a move: the one that is written last.
    assert_eq!(last("G0 Z5\nG81 G0 X3 Z2"), [3.0, 0.0, 2.0]);
    // Codes that act once, and moves of one block, are not modes.
    finds("G28 G53 X0", &["1:5 modal-group-conflict"]);
    finds("G0 G31 X5", &["1:4 modal-group-conflict"]);
}

#[test]
fn d_stays_until_the_next_one() {
    // Tool 2 has a radius of 5: beside X0 at X-5.
    let beside = |text: &str| ends(&format!("G0 Y-20\n{text}"))[1];
    for text in [
        "D2\nG41 G1 X0 Y-10\nY20\nG40 X-20",
        "G43 H1 D2 Z0\nG41 G1 X0 Y-10\nY20\nG40 X-20",
        "G0 X-20 D2\nG41 G1 X0 Y-10\nY20\nG40 X-20",
    ] {
        let at = ends(&format!("G0 Y-20\n{text}"));
        assert!(
            at.iter().any(|end| end[0] == -5.0 && end[1] == 20.0),
            "{at:?}"
        );
    }
    assert_eq!(
        beside("G41 D1 G1 X0 Y-10\nY20\nG40 X-20"),
        [-3.0, -10.0, 0.0]
    );
    // The way to the contour may be shorter than the radius.
    assert_eq!(
        beside("G41 D2 G1 X0 Y-18\nY20\nG40 X-20"),
        [-5.0, -18.0, 0.0]
    );
    finds(
        "G41 D1 G1 X0 Y-10\nY-30 D2\nG40 X-20",
        &["2:6 cutter-radius"],
    );
    finds("G96 S100 D2000", &["1:10 unused-word"]);
    finds("G81 X1 Z-1 R1 D2", &["1:15 unused-word"]);
}

#[test]
fn words_of_cycles_stay_when_the_cycle_changes() {
    let levels =
        |text: &str| -> Vec<[f64; 2]> { ends(text).iter().map(|end| [end[0], end[2]]).collect() };
    // R2 and Z-5 of G81: pecks at 1, then to the bottom.
    let found = levels("G0 Z5\nG81 X10 Z-5 R2 F500\nG83 X20 Q4");
    let second: Vec<_> = found.into_iter().filter(|[x, _]| *x == 20.0).collect();
    assert_eq!(
        second,
        [
            [20.0, 5.0],
            [20.0, 2.0],
            [20.0, -2.0],
            [20.0, 2.0],
            [20.0, -1.746],
            [20.0, -5.0],
            [20.0, 5.0]
        ]
    );
    // Until G80, or another move.
    finds(
        "G0 Z5\nG81 X1 Z-5 R2\nG80\nG83 X2 Q1",
        &["4:1 missing-word"],
    );
    // A depth has no sign.
    assert_eq!(
        levels("G0 Z5\nG73 X0 Z-5 R2 Q-4 F500"),
        levels("G0 Z5\nG73 X0 Z-5 R2 Q4 F500")
    );
    // R alone drills again.
    assert_eq!(
        levels("G0 Z5\nG81 X0 Z-5 R2 F500\nR1."),
        [
            [0.0, 5.0],
            [0.0, 2.0],
            [0.0, -5.0],
            [0.0, 5.0],
            [0.0, 1.0],
            [0.0, -5.0],
            [0.0, 5.0]
        ]
    );
}

/// P of G73 and G83 of a Haas is a pause at the bottom; those of a FANUC's mill have none, and keep it.
#[test]
fn a_haas_pauses_at_the_bottom_of_deep_holes() {
    let dwells_of = |text: &str, offset_memory| -> Vec<f64> {
        let options = Options {
            fanuc: FanucParameters {
                offset_memory,
                ..FanucParameters::default()
            },
            ..options()
        };
        Program::new(text.as_bytes(), options)
            .map(|item| item.unwrap_or_else(|d| panic!("{text}\n{d}")))
            .filter_map(|item| match item.kind {
                ItemKind::Dwell(seconds) => Some(seconds),
                _ => None,
            })
            .collect()
    };
    for cycle in ["G73", "G83"] {
        let text = format!("G0 Z5.\n{cycle} Z-5. R2. Q2. P500 F600.\nX10.");
        assert_eq!(dwells_of(&text, OffsetMemory::Haas), [0.5, 0.5], "{text}");
        assert!(dwells_of(&text, OffsetMemory::A).is_empty(), "{text}");
        let kept = format!("{text}\nG82 X20.");
        assert_eq!(dwells_of(&kept, OffsetMemory::A), [0.5], "{text}");
    }
}

/// K counts, also where lengths without a point are least increments.
#[test]
fn k_counts_holes_whatever_a_number_without_a_point_is() {
    for (point, head) in [
        (PointInput::Increment, "G0 Z5."),
        (PointInput::Increment, "G20 G0 Z5."),
        (PointInput::Calculator, "G0 Z5."),
    ] {
        for word in ["K3", "K3.", "L3"] {
            let options = Options {
                fanuc: FanucParameters {
                    point,
                    ..FanucParameters::default()
                },
                ..options()
            };
            let text = format!("{head}\nG91 G98 G81 X1. R-3. Z-4. {word} F60.");
            let ends = crate::fanuc_calls::ends_with(&text, options);
            // Across, to R, to the bottom and out.
            assert_eq!(ends.len(), 1 + 3 * 4, "{text}: {ends:?}");
        }
    }
}

#[test]
fn a_dwell_may_be_alone_or_in_u() {
    assert_eq!(dwells("G4"), [0.0]);
    assert_eq!(dwells("G4 U2."), [2.0]);
    assert_eq!(dwells("G4 X2.5"), [2.5]);
    finds("G4 F2.", &["1:1 missing-word"]);
    finds("G0 U2.", &["1:4 axis-not-configured"]);
    let report = check(&b"G103 P1\nG103\nG187 P3 E0.01\nG187"[..], options());
    assert!(report.diagnostics.is_empty());
}

#[test]
fn a_corner_without_a_move_of_its_own_is_refused() {
    for (text, place) in [
        ("G0 X10. ,R2.\nG1 Y10. F100", "1:9"),
        ("G81 X1. Z-5. R2. F100. ,R2.", "1:24"),
        ("G4 X1. ,C2.", "1:8"),
        ("G1 F100. ,R2.\nX5.", "1:10"),
    ] {
        finds(text, &[&format!("{place} unused-word")]);
    }
    finds("G0 X10. ,R0\nG1 Y10. F100", &[]);
}

#[test]
fn a_block_that_is_another_program_does_not_end_this_one() {
    for (number, place) in [(":30 T6 M6", "3:1"), ("O30 G0 X5", "3:1")] {
        finds(
            &format!("O1\nG0 X1\n{number}\nX9\nM30"),
            &[&format!("{place} flow-structure")],
        );
    }
    // With its comment it is, and the first line may go on.
    finds("O1 G21\nG0 X1\nO30 (NEXT)\nG0 X9", &[]);
}

#[test]
fn rotary_axes_turn_on_the_way_to_a_hole() {
    let text = "G0 Z20\nG99 G81 X10 Y5 A90 Z-5 R2 F100\nA120\nG91 A30 K2";
    use Axis::{A, X, Y, Z};
    let options = Options {
        machine: Machine::new(&[X, Y, Z, A]),
        ..options()
    };
    let bottoms: Vec<[f64; 3]> = Program::new(text.as_bytes(), options)
        .map(|item| item.unwrap_or_else(|d| panic!("{text}\n{d}")))
        .filter_map(|item| match item.kind {
            ItemKind::Move { segment, rate, .. } if !rate.is_rapid() => {
                let end = segment.end();
                Some([end[0], end[2], end[3]])
            }
            _ => None,
        })
        .collect();
    let right = [90.0, 120.0, 150.0, 180.0].map(|a| [10.0, -5.0, a]);
    assert_eq!(bottoms, right);
}

#[test]
fn a_stored_cycle_has_no_place_of_its_own() {
    finds("G81 X5 Z-5 R2 F100 K0\nX10", &["1:5 ambiguous-word"]);
    finds("G91 G81 Y5 Z-5 R-2 F100 L0\nX10", &["1:9 ambiguous-word"]);
    finds("G0 X5\nG81 X5 Y0 Z-5 R2 F100 K0\nX10", &[]);
}

#[test]
fn a_haas_turns_its_spindle_on_for_a_rigid_tap() {
    let codes = |text: &str, offset_memory: OffsetMemory| -> Vec<u32> {
        let threading = Threading {
            rigid_tapping: true,
            ..Threading::new(Limits::uniform(200.0, 2_000.0, 40_000.0), 0.004)
        };
        let options = Options {
            threading: Some(threading),
            fanuc: FanucParameters {
                offset_memory,
                ..FanucParameters::default()
            },
            ..options()
        };
        Program::new(text.as_bytes(), options)
            .map_while(Result::ok)
            .filter_map(|item| match item.kind {
                ItemKind::Event(Event::MCode(code)) => Some(code),
                _ => None,
            })
            .collect()
    };
    let text = "S600\nG0 Z5\nG99 G84 Z-10 R2 F600\nX10\nG80\nG74 X20 Z-10 R2 F600";
    assert_eq!(codes(text, OffsetMemory::Haas), [3, 5, 3, 5, 4, 5]);
    // Others need M3, or M29.
    assert_eq!(codes(text, OffsetMemory::C), [0_u32; 0]);
}

#[test]
fn a_second_block_in_a_line_is_refused() {
    for (text, place) in [
        ("N5G0X1;G0X2;", "1:8"),
        ("G0 X1 ; Y-3", "1:9"),
        ("#1=2; #2=3", "1:7"),
    ] {
        finds(text, &[&format!("{place} unused-word")]);
    }
    // The end of a block by itself, and comments.
    finds(
        "O1;\nG0 X1.;\n;\nG0 X2 ; beside the part\n; T1 END MILL",
        &[],
    );
}

#[test]
fn statements_for_devices_and_names_stand_alone() {
    for (text, place) in [
        ("DPRNT[A] X5", "1:10"),
        ("BPRNT[X#100[3]] X5", "1:17"),
        ("SETVN 100[A] X5", "1:14"),
        ("POPEN X5", "1:7"),
    ] {
        finds(text, &[&format!("{place} flow-structure")]);
    }
    finds(
        "POPEN\nDPRNT[X#100[53]] (AT X)\nBPRNT[X#100[3]];\nSETVN 100[A,B] ;\nPCLOS",
        &[],
    );
}

#[test]
fn a_dwell_has_one_time_and_no_place() {
    for text in ["G0 X5. G4 P500", "G4 X1. P500", "G4 X1. U1."] {
        let found = listed(&check(text.as_bytes(), options()));
        assert!(found[0].ends_with(" ambiguous-word"), "{text} {found:?}");
    }
    finds("G0 Y5. G4 P500", &["1:4 unused-word"]);
    assert_eq!(
        dwells("G4 P500\nG4 X1.5\nG0 G4 P2\nG4 F100 P3"),
        [0.5, 1.5, 0.002, 0.003]
    );
}

#[test]
fn the_plane_changes_behind_a_cycle_and_not_in_it() {
    let cycle = "G0 Z20\nG81 X1 Y2 Z-5 R2 F100\n";
    finds(&format!("{cycle}G18 X3 Z4"), &["3:1 canned-cycle"]);
    finds(&format!("{cycle}G19\nG80"), &["3:1 canned-cycle"]);
    finds(
        &format!("{cycle}G18 G82 X3 Y-4 Z2 R2"),
        &["3:1 canned-cycle"],
    );
    finds(&format!("{cycle}G17 X3"), &[]);
    finds(&format!("{cycle}G80 G18\nG0 X3"), &[]);
    finds(&format!("{cycle}G0 G18 X3 Z20"), &[]);
}
