//! Tests of ORIVECT: the tool turns on great circles. Values are computed by hand.

use glidepath_gcode::Dialect;
use glidepath_geometry::Axis;
use glidepath_program::Rate;
use nalgebra::Vector3;

use crate::five_axes::{at, finds, last, moves, near, options};

/// Directions of the tool on the work at the ends of the moves.
fn directions(text: &str) -> Vec<Vector3<f64>> {
    let machine = options(Dialect::Siemens).five_axis.expect("a machine");
    let ends = moves(Dialect::Siemens, text).into_iter();
    ends.map(|(_, end, ..)| machine.tool_axis(end[Axis::A.index()], end[Axis::C.index()]))
        .collect()
}

#[test]
fn orivect_turns_the_tool_on_a_great_circle() {
    // From (1, 0, 1) to (0, 1, 1): the plane of both has the normal (-1, -1, 1).
    let normal = Vector3::new(-1.0, -1.0, 1.0).normalize();
    let start = "TRAORI\nG0 X0 Y0 Z20 A3=1 B3=0 C3=1\n";
    let turn = "G1 X10 A3=0 B3=1 C3=1 F600";
    for word in ["ORIVECT", "ORIPLANE", "ORIWKS ORIVECT"] {
        let text = format!("{word}\n{start}{turn}");
        let all = directions(&text);
        assert!(all.len() > 10, "{}", all.len());
        for direction in all.iter().skip(1) {
            assert!(direction.dot(&normal).abs() < 1e-4, "{direction}");
        }
        // The same angle on the same way: 60 degrees in 10 mm.
        for (_, end, ..) in moves(Dialect::Siemens, &text).into_iter().skip(1) {
            let machine = options(Dialect::Siemens).five_axis.expect("a machine");
            let way = machine.tool_axis(end[Axis::A.index()], end[Axis::C.index()]);
            let angle = way
                .normalize()
                .dot(&Vector3::new(1.0, 0.0, 1.0).normalize())
                .acos();
            assert!(
                (angle.to_degrees() - 6.0 * end[0]).abs() < 1e-6,
                "{angle} {end}"
            );
        }
        let time: f64 = moves(Dialect::Siemens, &text)
            .into_iter()
            .skip(1)
            .map(|(.., rate, length)| match rate {
                Rate::Feed(feed_v) => length / feed_v,
                other => panic!("{other:?}"),
            })
            .sum();
        assert!((time - 1.0).abs() < 1e-9, "{time}");
    }
    // With even angles it does not.
    let even = directions(
        &format!("ORIVECT ORIAXES\n{start}{turn}").replace("ORIVECT ORIAXES", "ORIVECT\nORIAXES"),
    );
    assert!(
        even.iter()
            .all(|direction| (direction.z - 0.5_f64.sqrt()).abs() < 1e-9)
    );
    // With a longer tool the tip still goes straight: X from 0 to 10, Y and Z at rest.
    let text = format!("T1 M6 D1\nORIVECT\n{start}{turn}");
    let all = moves(Dialect::Siemens, &text).into_iter();
    for (_, end, ..) in all.filter(|(_, _, rate, _)| *rate != Rate::Rapid) {
        let machine = options(Dialect::Siemens).five_axis.expect("a machine");
        let tip = Vector3::new(end[0], end[1], end[2])
            - machine.tool_axis(end[Axis::A.index()], end[Axis::C.index()]) * 10.0;
        assert!(tip.y.abs() < 1e-3 && (tip.z - 20.0).abs() < 1e-3, "{tip}");
    }
}

#[test]
fn orivect_at_the_pole_and_beyond_half_a_turn() {
    // From the pole, angles change evenly: the last place is the right one.
    near(
        last(
            Dialect::Siemens,
            "TRAORI\nORIVECT\nG0 X0 Z20 A0 C0\nG1 X10 A30 C40 F600",
        ),
        at(10.0, 0.0, 20.0, 30.0, 40.0),
    );
    finds(
        Dialect::Siemens,
        "TRAORI\nORIVECT\nG0 X0 Z20 A30 C0\nG1 X10 A30 C179 F600",
        &["4:1 not-supported"],
    );
    finds(
        Dialect::Siemens,
        "TRAORI\nORIVECT\nG0 X0 Z20 A30 C0\nG1 X10 C200 F600",
        &["4:1 not-supported"],
    );
    // Without TRAORI it says nothing.
    near(
        last(Dialect::Siemens, "ORIVECT\nG0 A30 C0\nG1 C200 F600"),
        last(Dialect::Siemens, "G0 A30 C0\nG1 C200 F600"),
    );
}
