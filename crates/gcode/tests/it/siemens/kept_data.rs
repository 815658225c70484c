//! Tests of what the control keeps: offsets of axes, coordinate systems, tools with their names and
//! edges, and what programs read of it. Values are computed by hand.

use std::sync::Arc;

use glidepath_gcode::{Options, Program, SiemensParameters, ToolChangeBy, ToolTable, check};
use glidepath_program::{Event, ItemKind};

use super::{ends, finds, options, xs};
use crate::support::listed;

#[test]
fn g58_and_g59_are_the_parts_of_trans() {
    // TRANS and ATRANS are 10 and 5; G58 is another first part, G59 another second one.
    let text = "TRANS X10\nATRANS X5\nG0 X0\nG58 X20\nX0\nG59 X10\nX0\nG58 Y3\nX0 Y0\nTRANS\nX0 Y0";
    let expected = [
        [15.0, 0.0],
        [25.0, 0.0],
        [30.0, 0.0],
        [30.0, 3.0],
        [0.0, 0.0],
    ];
    let found: Vec<[f64; 2]> = ends(text).into_iter().map(|[x, y, _]| [x, y]).collect();
    assert_eq!(found, expected);
    // TRANS with an axis leaves what G59 has set, and ends what ATRANS has added; alone it ends both.
    assert_eq!(
        xs("G59 X5\nTRANS X10\nG0 X0\nTRANS Y3\nX0\nTRANS\nX0"),
        [15.0, 5.0, 0.0]
    );
    assert_eq!(
        xs("ATRANS X5\nTRANS X10\nG0 X0\nG59 X1\nX0\nTRANS X20\nX0"),
        [10.0, 11.0, 21.0]
    );
    assert_eq!(xs("G59 X5\nROT RPL=0\nTRANS X10\nG0 X0"), [10.0]);
    // They move nothing, and count without a frame, too.
    assert_eq!(xs("G0 X5\nG58 X10\nG0 X5"), [5.0, 15.0]);
    assert_eq!(xs("N10 G59X=2*5\nG0X1"), [11.0]);
    // A turn stays where it was.
    let turned = ends("TRANS X10\nAROT RPL=90\nG58 X20\nG0 X1 Y0");
    assert_eq!(turned, [[20.0, 1.0, 0.0]]);
    finds("AROT RPL=90\nATRANS X5\nG58 X1", &["3:1 not-supported"]);
    finds("G58", &["1:1 missing-word"]);
    finds("G58 X900000000", &["1:1 invalid-value"]);
    finds("G0 G58 X5", &["1:4 unused-word"]);
}

#[test]
fn coordinate_systems_are_set_and_chosen() {
    let text = "$P_UIFR[1]=CTRANS(X,10,Y,5)\nG54 G0 X1 Y1\n$P_UIFR[1,X,TR]=20\nX2\nG54 X1";
    let found: Vec<[f64; 2]> = ends(text).into_iter().map(|[x, y, _]| [x, y]).collect();
    // What is in force changes with the next G54.
    assert_eq!(found, [[11.0, 6.0], [12.0, 6.0], [21.0, 6.0]]);
    assert_eq!(
        ends("$P_UIFR[2]=CTRANS(X,10):CROT(Z,90)\nG55 G0 X1 Y0"),
        [[10.0, 1.0, 0.0]]
    );
    assert_eq!(xs("$P_UIFR[5,X,TR]=20\nG505 G0 X1\nG500 X1"), [21.0, 1.0]);
    assert_eq!(xs("$P_UIFR[30,X,TR]=20\nG530 G0 X1"), [21.0]);
    assert_eq!(
        xs("$P_UIFR[2,X,TR]=20\nR1=$P_UIFR[2,X,TR]+1\nG0 X=R1"),
        [21.0]
    );
    finds("G530 G0 X1", &["1:1 not-supported"]);
    finds("$P_UIFR[1]=CROT(X,90)", &["1:12 not-supported"]);
    finds("$P_UIFR[1,X,FI]=1", &["1:1 not-supported"]);
    finds("$P_UIFR[0,X,TR]=1", &["1:1 not-supported"]);
}

/// A table with lengths and names.
fn named_tools() -> Options {
    let table = b"T1 Z10 D6 ;MILL_6\nT2 Z20 D10 ; drill 10\nT3 X1 Z5 ;TWICE\nT4 Z1 ;TWICE\n";
    Options {
        tools: Some(Arc::new(ToolTable::parse(table).expect("a table"))),
        ..options()
    }
}

fn zs(text: &str, options: Options) -> Vec<f64> {
    Program::new(text.as_bytes(), options)
        .map(|item| item.unwrap_or_else(|d| panic!("{text}\n{d}")))
        .filter_map(|item| match item.kind {
            ItemKind::Move { segment, .. } => Some((segment.end()[2] * 1e6).round() / 1e6),
            _ => None,
        })
        .collect()
}

#[test]
fn tools_have_names_and_their_first_edge() {
    assert_eq!(zs("T=\"1\" M6\nD1\nG0 Z1", named_tools()), [11.0]);
    assert_eq!(zs("T=\"MILL_6\" M6\nD1\nG0 Z1", named_tools()), [11.0]);
    assert_eq!(zs("T=\"drill 10\"\nM6\nG0 Z1", named_tools()), [21.0]);
    // D1 is in force behind a change, and the length of the tool before is not.
    assert_eq!(
        zs("T1 M6\nG0 Z1\nT2 M6\nZ1\nD0 Z2\nT0 M6\nZ1", named_tools()),
        [11.0, 21.0, 2.0, 1.0]
    );
    let without = Options {
        siemens: SiemensParameters {
            edge_after_change: false,
            ..SiemensParameters::default()
        },
        ..named_tools()
    };
    assert_eq!(zs("T1 M6\nG0 Z1\nD1 Z1", without), [1.0, 11.0]);
    // T alone waits for M6 on a mill, unless the machine data say otherwise.
    assert_eq!(zs("T1 D1\nG0 Z1", named_tools()), [1.0]);
    let by_t = Options {
        siemens: SiemensParameters {
            tool_change: Some(ToolChangeBy::T),
            ..SiemensParameters::default()
        },
        ..named_tools()
    };
    assert_eq!(zs("T1 D1\nG0 Z1\nT2\nZ1", by_t.clone()), [11.0, 21.0]);
    let events: Vec<Event> = Program::new("T1".as_bytes(), by_t)
        .filter_map(|item| match item.expect("a sound program").kind {
            ItemKind::Event(event) => Some(event),
            _ => None,
        })
        .collect();
    assert_eq!(events, [Event::SelectTool(1), Event::MCode(6)]);
    for text in ["T=\"MILL_8\"", "T=\"TWICE\"", "T=\"\""] {
        let report = check(text.as_bytes(), named_tools());
        assert_eq!(listed(&report), ["1:3 unknown-tool"], "{text}");
    }
}

#[test]
fn edges_are_set_and_read() {
    let text = "$TC_DP1[7,1]=120\n$TC_DP3[7,1]=50\n$TC_DP6[7,1]=4\nT7 M6\nG0 Z1\nZ=$TC_DP6[7,1] \nZ=$P_TOOLR+$P_TOOLL[1]";
    assert_eq!(zs(text, named_tools()), [51.0, 54.0, 104.0]);
    assert_eq!(xs("T3 M6\nR1=$P_TOOLNO+$P_TOOL/10\nG0 X=R1"), [3.1]);
    finds("$TC_DP25[1,1]=5", &["1:1 not-supported"]);
    finds("R1=$TC_DP1[1,1]", &["1:4 not-supported"]);
}

#[test]
fn programs_read_places_and_modes() {
    assert_eq!(
        xs("$P_UIFR[1,X,TR]=100\nG54 G0 X10\nX=$P_EP[X]+5\nX=$AA_IM[X]\nX=$AA_IW[X]+1"),
        [110.0, 115.0, 215.0, 216.0]
    );
    assert_eq!(
        xs("G18 G91\nR1=$P_GG[6] R2=$P_GG[14]\nG17 G90 G0 X=R1*10+R2"),
        [22.0]
    );
    assert_eq!(xs("F250 S1200\nR1=$P_F R2=$P_S\nG0 X=R1+R2"), [1450.0]);
    assert_eq!(xs("IF $P_SEARCH==0 GOTOF A\nX9\nA: G0 X1"), [1.0]);
    finds("R1=$AC_TIME", &["1:4 not-supported"]);
    finds("R1=$MN_USER_DATA[0]", &["1:4 not-supported"]);
    finds("$MC_X=1", &["1:1 not-supported"]);
}

#[test]
fn g70_leaves_what_the_control_keeps_in_millimetres_and_g700_does_not() {
    let length = |units: &str| format!("{units}\n$TC_DP3[2,1]=1\nG71\nT2 D1 M6\nG0 Z0");
    assert_eq!(zs(&length("G70"), named_tools()), [1.0]);
    assert_eq!(zs(&length("G700"), named_tools()), [25.4]);
    let read = |units: &str| format!("$TC_DP3[2,1]=25.4\n{units}\nR1=$TC_DP3[2,1]\nG71 G0 Z=R1");
    assert_eq!(zs(&read("G70"), named_tools()), [25.4]);
    assert_eq!(zs(&read("G700"), named_tools()), [1.0]);
    let system = |units: &str| {
        format!("{units}\n$P_UIFR[1]=CTRANS(X,1)\n$P_UIFR[1,Y,TR]=2\nG71 G54 G0 X0 Y0")
    };
    assert_eq!(ends(&system("G70")), [[1.0, 2.0, 0.0]]);
    assert_eq!(ends(&system("G700")), [[25.4, 50.8, 0.0]]);
    let frame =
        |units: &str| format!("{units}\n$P_PFRAME=CTRANS(X,1)\nR1=$P_PFRAME[X,TR]\nG71 G0 X0 Y=R1");
    assert_eq!(ends(&frame("G70")), [[1.0, 1.0, 0.0]]);
    assert_eq!(ends(&frame("G700")), [[25.4, 1.0, 0.0]]);
    let place = |units: &str| format!("G0 X25.4\n{units}\nR1=$P_EP[X] R2=$AA_IM[X]\nG71 X=R1 Y=R2");
    assert_eq!(ends(&place("G70"))[1], [25.4, 25.4, 0.0]);
    assert_eq!(ends(&place("G700"))[1], [1.0, 1.0, 0.0]);
    // Words of the workpiece follow G70, TRANS as X.
    assert_eq!(xs("G70\nTRANS X1\nG0 X1"), [50.8]);
}
