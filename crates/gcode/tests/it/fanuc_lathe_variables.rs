//! Tests of the variables of FANUC's and Haas' lathes: X is a diameter in them, as in words. Values
//! are computed by hand; X of the machine is a radius.

use std::sync::Arc;

use glidepath_gcode::{
    Connections, Dialect, FanucControl, FanucParameters, Machine, OffsetMemory, Options, Program,
    Tool, ToolTable, check,
};
use glidepath_geometry::Axis;
use glidepath_program::ItemKind;

use crate::support::listed;

/// Tool 1: 10 mm along X (a radius) and 3 mm along Z, radius 0.4 mm, direction 3 (2 of LinuxCNC).
fn options(control: FanucControl, offset_memory: OffsetMemory) -> Options {
    let mut tools = ToolTable::new();
    let mut tool = Tool {
        diameter_mm: 0.8,
        orientation: 2,
        ..Tool::default()
    };
    (tool.offset[0], tool.offset[2]) = (10.0, 3.0);
    tools.set(1, tool);
    Options {
        dialect: Dialect::Fanuc,
        connections: Connections::Simulated,
        tools: Some(Arc::new(tools)),
        machine: Machine::new(&[Axis::X, Axis::Z]),
        fanuc: FanucParameters {
            control: Some(control),
            offset_memory,
            ..FanucParameters::default()
        },
        ..Options::default()
    }
}

fn last_with(text: &str, options: Options) -> [f64; 2] {
    let ends = Program::new(text.as_bytes(), options)
        .map(|item| item.unwrap_or_else(|d| panic!("{text}\n{d}")))
        .filter_map(|item| match item.kind {
            ItemKind::Move { segment, .. } => Some(segment.end()),
            _ => None,
        });
    let end = ends.last().expect("a move");
    [0, 2].map(|axis| (end[axis] * 1e6).round() / 1e6 + 0.0)
}

fn last(text: &str) -> [f64; 2] {
    last_with(text, options(FanucControl::LatheA, OffsetMemory::Unsaid))
}

#[test]
fn places_are_diameters() {
    for variable in ["#5001", "#5021", "#5041"] {
        let text = format!("G98\nG0 X40 Z2\n#1={variable}\nG0 X60\nX#1 Z[#5002+1]");
        assert_eq!(last(&text), [20.0, 3.0], "{variable}");
        let inches = format!("G20 G98\nG0 X2 Z1\n#1={variable}\nG0 X3\nX#1");
        assert_eq!(last(&inches), [25.4, 25.4], "{variable}");
    }
    // With the offset of the tool: 2 · (20 + 10).
    assert_eq!(last("G98\nT0101\nG0 X40 Z2\n#1=#5041\nX#1"), [40.0, 5.0]);
    assert_eq!(last("G98\nT0101\nG0 X#5081 Z#5082"), [20.0, 6.0]);
    // A contact at X20.
    assert_eq!(
        last("G98\nG0 X40 Z10\nG31 X20 F100\nG0 X[#5061+2]"),
        [11.0, 10.0]
    );
}

#[test]
fn work_offsets_are_diameters() {
    assert_eq!(last("#5221=40\nG54 G0 X10 Z1"), [25.0, 1.0]);
    assert_eq!(
        last("G10 L2 P1 X40 Z0\nG54 G0 X10 Z[#5221+1]"),
        [25.0, 41.0]
    );
    assert_eq!(last("#5201=6\n#5202=1\nG0 X10 Z1"), [8.0, 2.0]);
}

#[test]
fn offsets_of_tools_are_where_the_memory_of_lathes_has_them() {
    let with = |memory, text: &str| last_with(text, options(FanucControl::LatheA, memory));
    let read = |memory, numbers: [u32; 3]| {
        let [x, z, radius] = numbers;
        let first = with(memory, &format!("G0 X#{x} Z#{z}"));
        [
            first[0],
            first[1],
            with(memory, &format!("G0 Z#{radius}"))[1],
        ]
    };
    let (a, c, haas) = (OffsetMemory::A, OffsetMemory::C, OffsetMemory::Haas);
    assert_eq!(read(c, [2701, 2801, 2901]), [10.0, 3.0, 0.4]);
    assert_eq!(read(c, [15_001, 16_001, 17_001]), [10.0, 3.0, 0.4]);
    assert_eq!(read(a, [2001, 2101, 2201]), [10.0, 3.0, 0.4]);
    assert_eq!(read(haas, [2001, 2101, 2201]), [10.0, 3.0, 0.4]);
    for memory in [a, c, haas] {
        assert_eq!(with(memory, "G0 Z#2301")[1], 3.0);
        assert_eq!(with(memory, "#2301=2\nG0 Z#2301")[1], 2.0);
    }
    // Wear: 0.4 mm of diameter, 0.5 mm along Z.
    let wear = |x: u32, z: u32| format!("#{x}=0.4\n#{z}=0.5\nT0101\nG0 X20 Z0");
    assert_eq!(with(c, &wear(2001, 2101)), [20.2, 3.5]);
    assert_eq!(with(c, &wear(10_001, 11_001)), [20.2, 3.5]);
    assert_eq!(with(haas, &wear(2701, 2801)), [20.2, 3.5]);
    assert_eq!(with(a, &wear(2001, 2101)), [10.2, 0.5]);
    assert_eq!(with(c, &wear(2701, 2801)), [10.2, 0.5]);
    for text in ["#2301=12", "#2301=1.5"] {
        let report = check(text.as_bytes(), options(FanucControl::LatheA, c));
        assert_eq!(listed(&report), ["1:1 parameter"], "{text}");
    }
}

#[test]
fn modes_are_in_the_groups_of_lathes() {
    let a = |text: &str, group: u32| last(&format!("{text}\nG0 Z#{group}"))[1];
    assert_eq!(a("G99", 4005), 99.0);
    assert_eq!(a("G98", 4005), 98.0);
    assert_eq!(a("G97 S100 M3", 4002), 97.0);
    assert_eq!(a("G18", 4016), 18.0);
    assert_eq!(a("T0201\nT0200", 4120), 200.0);
    // 101, and 3 mm of the tool.
    assert_eq!(a("T0101", 4120), 104.0);
    let turning = "G98 G97 S100 M3\nG0 X40 Z2\nG90 X30 Z-5 F100\n#1=#4001\nG0 Z#1";
    assert_eq!(last(turning)[1], 90.0);
    let of = |control| last_with("G0 Z#4003", options(control, OffsetMemory::Unsaid))[1];
    assert_eq!(of(FanucControl::LatheB), 90.0);
    let options = options(FanucControl::LatheA, OffsetMemory::Unsaid);
    assert_eq!(
        listed(&check(&b"G0 Z#4003"[..], options)),
        ["1:5 parameter"]
    );
}
