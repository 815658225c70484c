//! The machines that the programs are read for.

use std::sync::Arc;

use glidepath_gcode::{
    Connections, CoordinateSystem, Dialect, FanucControl, FanucParameters, Firmware, Machine,
    OffsetMemory, Options, Threading, Tool, ToolTable, WorkOffsets,
};
use glidepath_geometry::{Axis, AxisVector};
use glidepath_kinematics::{FiveAxis, Rotaries, Tilt};
use glidepath_program::Limits;
use nalgebra::Vector3;

fn xyz(x: f64, y: f64, z: f64) -> AxisVector {
    let mut place = AxisVector::zeros();
    (place[0], place[1], place[2]) = (x, y, z);
    place
}

/// Zeros of G54 to G57.
fn systems(machine: &str) -> [AxisVector; 4] {
    if is_lathe(machine) {
        return [150.0, 160.0, 170.0, 180.0].map(|z| xyz(0.0, 0.0, z));
    }
    if machine.starts_with("printer") {
        return [AxisVector::zeros(); 4];
    }
    if machine.starts_with("five") {
        return [
            xyz(0.0, 0.0, 0.0),
            xyz(20.0, 10.0, 5.0),
            xyz(0.0, 0.0, 0.0),
            xyz(0.0, 0.0, 0.0),
        ];
    }
    [
        (100.0, 50.0),
        (-100.0, 50.0),
        (100.0, -50.0),
        (-100.0, -50.0),
    ]
    .map(|(x, y)| xyz(x, y, -200.0))
}

fn is_lathe(machine: &str) -> bool {
    machine.contains("lathe") || machine.starts_with("xz")
}

/// A zero by its name, or by its coordinates.
pub(super) fn zero(name: &str, machine: &str) -> AxisVector {
    let systems = systems(machine);
    match name {
        "machine" => AxisVector::zeros(),
        "G54" => systems[0],
        "G55" => systems[1],
        "G56" => systems[2],
        "G57" => systems[3],
        _ => {
            let place: Vec<f64> = name
                .split(',')
                .map(|word| word.parse().expect("a coordinate"))
                .collect();
            xyz(place[0], place[1], place[2])
        }
    }
}

/// A tool: ten times its number long, of 10 mm; on lathes with an X (a radius), too, and sharp.
pub(super) fn tool(number: u32, of_lathe: bool) -> Tool {
    let mut tool = Tool {
        diameter_mm: 10.0,
        ..Tool::default()
    };
    tool.offset[2] = 10.0 * f64::from(number);
    if of_lathe {
        tool.offset[0] = 0.5 * f64::from(number);
        // One of them has a tip that is round.
        tool.diameter_mm = if number == 6 { 0.8 } else { 0.0 };
        tool.orientation = if number == 6 { 2 } else { 0 };
    }
    tool
}

/// The linear axes of the table-table machine for a tip, without the length that it is built for.
pub(super) fn joints(axes: &AxisVector) -> AxisVector {
    let (sa, ca) = axes[Axis::A.index()].to_radians().sin_cos();
    let (sc, cc) = axes[Axis::C.index()].to_radians().sin_cos();
    let (u, v) = (axes[0] * cc - axes[1] * sc, axes[0] * sc + axes[1] * cc);
    let mut joints = *axes;
    (joints[0], joints[1], joints[2]) = (u, v * ca - axes[2] * sa, v * sa + axes[2] * ca);
    joints
}

fn axes(machine: &str) -> Vec<Axis> {
    use Axis::{A, B, C, U, X, Y, Z};
    let machine = machine.trim_end_matches("-thread");
    match machine {
        "mill" | "haas" | "siemens" | "xyz" => vec![X, Y, Z],
        "mill-a" | "haas-a" => vec![X, Y, Z, A],
        "mill-b" => vec![X, Y, Z, B],
        "five" | "five-haas" => vec![X, Y, Z, A, C],
        "lathe-xzc" | "siemens-lathe-c" => vec![X, Z, C],
        _ if is_lathe(machine) => vec![X, Z],
        _ if machine.starts_with("printer") => vec![X, Y, Z, U],
        _ => panic!("no machine {machine}"),
    }
}

/// Where the machine stands: where a move to its zero is one.
fn start(machine: &str) -> AxisVector {
    match machine {
        "xyz" => AxisVector::zeros(),
        _ if machine.starts_with("five") || machine.starts_with("printer") => AxisVector::zeros(),
        _ if is_lathe(machine) => xyz(30.0, 0.0, 40.0),
        _ => xyz(-20.0, -30.0, -40.0),
    }
}

/// The options of a program in a dialect for a machine.
pub(super) fn options(machine: &str, dialect: &str) -> Options {
    let mut tools = ToolTable::new();
    for number in 1..=20 {
        tools.set(number, tool(number, is_lathe(machine)));
    }
    let mut offsets = WorkOffsets::default();
    for (system, origin) in offsets.systems.iter_mut().zip(systems(machine)) {
        *system = CoordinateSystem {
            origin,
            ..CoordinateSystem::default()
        };
    }
    let follows = machine.ends_with("-thread");
    Options {
        dialect: match dialect {
            "fanuc" => Dialect::Fanuc,
            "siemens" => Dialect::Siemens,
            "marlin" => Dialect::Marlin,
            _ => Dialect::LinuxCnc,
        },
        machine: Machine::new(&axes(machine)),
        connections: Connections::Simulated,
        tools: Some(Arc::new(tools)),
        offsets,
        start: start(machine),
        fanuc: FanucParameters {
            control: match machine {
                "lathe-b" => Some(FanucControl::LatheB),
                "lathe-c" => Some(FanucControl::LatheC),
                _ => None,
            },
            offset_memory: if machine.contains("haas") {
                OffsetMemory::Haas
            } else {
                OffsetMemory::Unsaid
            },
            ..FanucParameters::default()
        },
        five_axis: machine.starts_with("five").then(|| FiveAxis {
            rotaries: Rotaries::TableTable {
                tilt_point: Vector3::zeros(),
                rotary_point: Vector3::zeros(),
            },
            tilt: Tilt::A,
            tilt_reversed: false,
            rotary_reversed: false,
            tool_mm: 50.0,
        }),
        extruder: machine.starts_with("printer").then_some(Axis::U),
        firmware: match machine {
            "printer-marlin" => Some(Firmware::Marlin),
            "printer-klipper" => Some(Firmware::Klipper),
            _ => None,
        },
        orients: follows,
        threading: follows.then(|| Threading {
            rigid_tapping: true,
            spindle_a: Some(40.0),
            ..Threading::new(Limits::uniform(200.0, 2_000.0, 40_000.0), 0.004)
        }),
        ..Options::default()
    }
}
