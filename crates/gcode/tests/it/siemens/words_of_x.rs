//! Every word of X on a lathe of SINUMERIK in DIAMON: which are diameters and which are radii. The control's
//! manual ("Channel-specific diameter/radius programming") counts ends in G90 and G91, places of centres (AC)
//! and `$P_EP[X]` and `$AA_IW[X]` as diameters; frames, ways, radii, leads and tools are radii.

use glidepath_gcode::{LatheX, Machine, Options, Program, SiemensParameters, Threading, check};
use glidepath_geometry::Axis;
use glidepath_program::{Event, ItemKind, Limits};

use super::options;
use crate::support::listed;

fn lathe() -> Options {
    Options {
        machine: Machine::new(&[Axis::X, Axis::Z]),
        threading: Some(Threading::new(
            Limits::uniform(200.0, 2_000.0, 40_000.0),
            0.004,
        )),
        siemens: SiemensParameters {
            lathe_x: LatheX::Diameter,
            ..SiemensParameters::default()
        },
        ..options()
    }
}

fn items(text: &str) -> Vec<ItemKind> {
    Program::new(text.as_bytes(), lathe())
        .map(|item| item.unwrap_or_else(|d| panic!("{text}\n{d}")).kind)
        .collect()
}

/// The radius at which the program ends.
fn radius(text: &str) -> f64 {
    let all = items(text).into_iter().rev();
    let mut ends = all.filter_map(|item| match item {
        ItemKind::Move { segment, .. } => Some(segment.end()[0]),
        _ => None,
    });
    (ends.next().expect("a move") * 1e6).round() / 1e6
}

/// The length of the last move.
fn length(text: &str) -> f64 {
    let all = items(text).into_iter().rev();
    let mut lengths = all.filter_map(|item| match item {
        ItemKind::Move { segment, .. } => Some(segment.length()),
        _ => None,
    });
    lengths.next().expect("a move")
}

#[test]
fn diameters() {
    for (word, text, right) in [
        ("X", "G0 X20", 10.0),
        ("X in G91", "G0 X20\nG91 X10", 15.0),
        ("AC, IC", "G0 X=AC(20)\nX=IC(10)", 15.0),
        ("SUPA", "TRANS X5\nG0 SUPA X20", 10.0),
        ("R parameter", "R1=20\nG0 X=R1", 10.0),
        ("$P_EP", "G0 X20\nR1=$P_EP[X]\nX=R1+10", 15.0),
        ("$AA_IW", "G0 X20\nR1=$AA_IW[X]\nX=R1+10", 15.0),
        ("$P_EP in a frame", "TRANS X5\nG0 X20\nX=$P_EP[X]+10", 20.0),
        (
            "$P_EP in DIAM90 and G91",
            "DIAM90\nG0 X20\nG91\nR1=$P_EP[X]\nG90 X=R1+10",
            15.0,
        ),
        ("$P_EP in DIAMOF", "DIAMOF\nG0 X20\nX=$P_EP[X]+10", 30.0),
        ("end of CR", "G0 X20 Z-10\nG3 X30 Z-15 CR=5 F100", 15.0),
        ("end of CT", "G0 X20 Z0\nG1 Z-10 F100\nCT X40 Z-20", 20.0),
        ("pole", "G111 X50 Z-25\nG0 RP=10 AP=90", 35.0),
        (
            "DM1 of CYCLE97",
            "S500 M3\nG0 X60 Z10\nCYCLE97(2,,0,-20,40,40,5,2,1,0,0,0,1,0,1,1,3)",
            23.0,
        ),
    ] {
        assert_eq!(radius(text), right, "{word}");
    }
}

#[test]
fn radii() {
    for (word, text, right) in [
        ("TRANS", "TRANS X5\nG0 X20", 15.0),
        ("ATRANS", "TRANS X5\nATRANS X2\nG0 X20", 17.0),
        ("G58, G59", "G58 X5\nG59 X2\nG0 X20", 17.0),
        ("$P_UIFR", "$P_UIFR[1]=CTRANS(X,5)\nG54\nG0 X20", 15.0),
        ("$P_PFRAME", "$P_PFRAME=CTRANS(X,5)\nG0 X20", 15.0),
        (
            "read $P_UIFR",
            "$P_UIFR[1,X,TR]=5\nG0 X=$P_UIFR[1,X,TR]",
            2.5,
        ),
        ("SCALE", "SCALE X2\nG0 X20", 20.0),
        ("RP", "G111 X0 Z0\nG0 RP=10 AP=90", 10.0),
        // 10 mm along Z, as many of the radius.
        ("ANG", "G0 X20 Z0\nG1 Z-10 ANG=135 F100", 20.0),
        // The chamfer and the arc end 2 mm up the face.
        ("CHR", "G0 X20 Z0\nG1 Z-10 CHR=2 F100\nG4 F1\nX24", 12.0),
    ] {
        assert_eq!(radius(text), right, "{word}");
    }
    let quarter = 2.5 * std::f64::consts::PI;
    for (word, text) in [
        ("CR", "G0 X20 Z-10\nG3 X30 Z-15 CR=5 F100"),
        ("I, K", "G0 X20 Z-10\nG3 X30 Z-15 I0 K-5 F100"),
        ("I=AC", "G0 X20 Z-10\nG3 X30 Z-15 I=AC(20) K=AC(-15) F100"),
        ("I=IC", "G0 X20 Z-10\nG3 X30 Z-15 I=IC(0) K=IC(-5) F100"),
    ] {
        assert!((length(text) - quarter).abs() < 1e-9, "{word}");
    }
    // The legs of a chamfer at a right angle.
    let text = "G0 X20 Z0\nG1 Z-10 CHR=2 F100\nX40";
    let along: Vec<f64> = items(text)
        .into_iter()
        .filter_map(|item| match item {
            ItemKind::Move { segment, .. } => Some(segment.end()[0]),
            _ => None,
        })
        .collect();
    assert_eq!(along, [10.0, 10.0, 12.0, 20.0]);
    // The lead of a face thread is that of the axis.
    let leads: Vec<f64> = items("S500 M3\nG0 X20 Z5\nG33 X60 Z5 I2")
        .into_iter()
        .filter_map(|item| match item {
            ItemKind::Event(Event::Synchronise { pitch_mm, .. }) => Some(pitch_mm),
            _ => None,
        })
        .collect();
    assert_eq!(leads, [2.0]);
}

/// What is not known to be one or the other, and cycles that are not made.
#[test]
fn the_others_are_refused_by_name() {
    for (text, place) in [
        ("G0 X20\nR1=$AA_IM[X]", "2:4 not-supported"),
        ("DIAM90\nG0 X20\nG91\nR1=$AA_IM[X]", "4:4 not-supported"),
        ("G0 X20\nG110 X2", "2:6 polar"),
        ("G26 X50", "1:1 not-supported"),
        (
            "CYCLE800(0,\"\",0,57,5,0,0,0,0,0,0,0,0,-1)",
            "1:1 canned-cycle",
        ),
        (
            "CYCLE800(0,\"\",0,57,0,0,0,0,0,0,5,0,0,-1)",
            "1:1 canned-cycle",
        ),
        (
            "CYCLE93(35,60,30,25,5,10,20,0,0,-2,-2,1,1,10,1,5)",
            "1:1 not-supported",
        ),
        ("CYCLE94(20,60,\"E\")", "1:1 not-supported"),
        ("CYCLE96(42,60,\"A\")", "1:1 not-supported"),
        (
            "CYCLE99(0,40,-20,40,,,5,2,1,0,0,0,5,1,1000103)",
            "1:1 not-supported",
        ),
        (
            "CYCLE930(60,0,5,5,10,0,0,0,2,2,2,2,0.2,1,10,10130)",
            "1:1 not-supported",
        ),
        (
            "CYCLE951(60,0,40,-20,40,-20,1,1,0.1,0.1,12,0,0,0,1)",
            "1:1 not-supported",
        ),
        ("CYCLE952(\"A\",\"\",\"\",1101311)", "1:1 not-supported"),
        (
            "G17\nMCALL CYCLE81(20,0,2,-10)\nHOLES1(0,0,0,10,10,2)",
            "3:1 canned-cycle",
        ),
        ("POS[X]=20", "1:1 not-supported"),
    ] {
        let report = check(text.as_bytes(), lathe());
        assert_eq!(listed(&report), [place], "{text}");
    }
}
