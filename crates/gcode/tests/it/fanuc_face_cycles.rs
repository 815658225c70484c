//! Tests of the cycles on the face that a Haas lathe has beside FANUC's: G81, G82, G86, G89, G184.

use glidepath_gcode::{
    Connections, Dialect, FanucParameters, Machine, OffsetMemory, Options, Program, check,
};
use glidepath_geometry::Axis;
use glidepath_program::{Event, ItemKind, Rate};

use crate::support::listed;

fn haas() -> Options {
    Options {
        dialect: Dialect::Fanuc,
        connections: Connections::Simulated,
        machine: Machine::new(&[Axis::X, Axis::Z]),
        fanuc: FanucParameters {
            offset_memory: OffsetMemory::Haas,
            ..FanucParameters::default()
        },
        ..Options::default()
    }
}

/// What a cycle does from X0 Z10 on: where moves end in Z (`r` at rapid), dwells, M codes.
fn done(spindle: &str, cycle: &str) -> Vec<String> {
    let text = format!("G98 S600 {spindle}\nG0 X0 Z10\n{cycle}\nG80");
    let shown = |kind: ItemKind| match kind {
        ItemKind::Move { segment, rate, .. } => {
            let rapid = if matches!(rate, Rate::Rapid) { "r" } else { "" };
            Some(format!("{rapid}{}", segment.end()[2]))
        }
        ItemKind::Dwell(seconds) => Some(format!("{seconds} s")),
        ItemKind::Event(Event::MCode(code)) => Some(format!("M{code}")),
        _ => None,
    };
    Program::new(text.as_bytes(), haas())
        .filter_map(|item| shown(item.unwrap_or_else(|d| panic!("{text}\n{d}")).kind))
        .skip(2)
        .collect()
}

/// As Haas' manual of lathes describes them: R is the place of the R plane, P the dwell at the bottom; drills come out
/// at rapid, G86 with a spindle that stands, G89 and G85 at feed.
#[test]
fn a_haas_drills_and_bores_the_face() {
    let drilled = ["r2", "-15", "r10"];
    assert_eq!(done("M3", "G81 Z-15. R2. F100."), drilled);
    let dwelled = ["r2", "-15", "1.5 s", "r10"];
    assert_eq!(done("M3", "G82 Z-15. R2. P1.5 F100."), dwelled);
    let stopped = ["r2", "-15", "0 s", "M5", "r10", "M3"];
    assert_eq!(done("M3", "G86 Z-15. R2. F100."), stopped);
    let bored = ["r2", "-15", "1.5 s", "2", "r10"];
    assert_eq!(done("M3", "G89 Z-15. R2. P1.5 F100."), bored);
}

/// G184 taps threads to the left, as G74 of a mill; G74 of a lathe is a groove.
#[test]
fn a_haas_taps_to_the_left_by_g184() {
    let tapped = ["r2", "M49", "-15", "M3", "0 s", "2", "M4", "M48", "r10"];
    assert_eq!(done("M4", "G184 Z-15. R2. F600."), tapped);
    let text = "G98 S600 M3\nG0 X0 Z10\nG184 Z-15. R2. F600.";
    assert_eq!(listed(&check(text.as_bytes(), haas())), ["3:1 spindle"]);
}

/// On FANUC's lathes these numbers are no cycles on the face, and never those of a mill.
#[test]
fn a_fanuc_has_no_such_cycles() {
    let fanuc = Options {
        fanuc: FanucParameters::default(),
        ..haas()
    };
    for cycle in ["G81", "G82", "G86", "G89", "G184"] {
        let text = format!("G98 S600 M4\nG0 X0 Z10\n{cycle} Z-15. R2. F600.");
        let report = check(text.as_bytes(), fanuc.clone());
        assert_eq!(listed(&report), ["3:1 not-supported"], "{cycle}");
        assert!(report.diagnostics[0].help.contains("haas"), "{cycle}");
    }
}
