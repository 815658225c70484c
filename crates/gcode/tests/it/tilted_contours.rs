//! Contours with cutter radius compensation in tilted planes, and places of the machine while the tip
//! is followed: by hand.

use glidepath_gcode::{Dialect, Program};
use glidepath_geometry::AxisVector;
use glidepath_program::ItemKind;

use crate::five_axes::{at, finds, joints, last, near, options};

/// Ends and lengths of the moves.
fn moves(dialect: Dialect, text: &str) -> Vec<(AxisVector, f64)> {
    Program::new(text.as_bytes(), options(dialect))
        .map(|item| item.unwrap_or_else(|d| panic!("{text}\n{d}")))
        .filter_map(|item| match item.kind {
            ItemKind::Move { segment, .. } => Some((segment.end(), segment.length())),
            _ => None,
        })
        .collect()
}

/// A place in the plane at (20, 10, 0) that is turned by 30 degrees about X.
fn in_plane(x: f64, y: f64, z: f64) -> AxisVector {
    let (sin, cos) = 30.0_f64.to_radians().sin_cos();
    at(
        20.0 + x,
        10.0 + y * cos - z * sin,
        y * sin + z * cos,
        -30.0,
        0.0,
    )
}

/// A radius of 5 mm outside of a contour with a round and a sharp corner.
const CONTOUR: &str =
    "G0 X-20 Y-10 Z2\nG41 D2 G1 X0 Y0 F600\nY30\nG2 X10 Y40 I10 J0\nG1 X40\nY0\nG40 X60";
const RADIUS: &str = "G10 L12 P2 R5.\n";
const PLANE: &str = "G68.2 X20 Y10 Z0 J30\nG53.1\n";

#[test]
fn a_contour_in_a_tilted_plane_is_that_of_the_flat_one() {
    let flat = moves(Dialect::Fanuc, &format!("{RADIUS}{CONTOUR}"));
    let tilted = moves(Dialect::Fanuc, &format!("{RADIUS}{PLANE}{CONTOUR}\nG69"));
    // The corners by hand, in this order.
    let mut left = tilted.iter();
    for (x, y) in [
        (-20.0, -10.0),
        (-5.0, 30.0),
        (10.0, 45.0),
        (45.0, 45.0),
        (45.0, 0.0),
        (60.0, 0.0),
    ] {
        let right = in_plane(x, y, 2.0);
        let found = left.any(|(end, _)| (end - right).amax() < 1e-6);
        assert!(found, "never at {x} {y}: {tilted:?}");
    }
    let feed = |all: &[(AxisVector, f64)]| -> f64 {
        let begins = all.iter().position(|(end, _)| (end[0] - 15.0).abs() < 1e-9);
        let begins = begins.or(all.iter().position(|(end, _)| (end[0] + 5.0).abs() < 1e-9));
        all[begins.expect("a move")..]
            .iter()
            .map(|(_, length)| length)
            .sum()
    };
    assert!((feed(&flat) - feed(&tilted)).abs() < 1e-4);
    // With the length of the tool the axes stand as much higher along it.
    let long = format!("{RADIUS}{PLANE}G43 H1 Z50\n{CONTOUR}");
    let (sin, cos) = 30.0_f64.to_radians().sin_cos();
    near(
        last(Dialect::Fanuc, &long),
        in_plane(60.0, 0.0, 2.0) + at(0.0, -10.0 * sin, 10.0 * cos, 0.0, 0.0),
    );
    // A plane of the machine that is another one.
    let upright = format!("{RADIUS}G68.2 X0 Y0 Z0 J90\nG53.1\n{CONTOUR}");
    let on_wall = moves(Dialect::Fanuc, &upright);
    let right = at(-5.0, -2.0, 30.0, -90.0, 0.0);
    assert!(on_wall.iter().any(|(end, _)| (end - right).amax() < 1e-6));
}

#[test]
fn a_sinumerik_has_contours_in_swivelled_planes_too() {
    let swivel = "CYCLE800(0,\"\",0,57,20,10,0,30,0,0,0,0,0,-1)\n";
    let text = format!(
        "$TC_DP6[1,1]=5\nT1 M6 D1\n{swivel}{}",
        CONTOUR.replace(" D2", "")
    );
    let (sin, cos) = 30.0_f64.to_radians().sin_cos();
    let right = in_plane(-5.0, 30.0, 2.0) + at(0.0, -10.0 * sin, 10.0 * cos, 0.0, 0.0);
    let found = moves(Dialect::Siemens, &text);
    assert!(
        found.iter().any(|(end, _)| (end - right).amax() < 1e-6),
        "{found:?}"
    );
}

#[test]
fn what_would_leave_the_plane_of_a_contour_is_refused() {
    let within = |line: &str| format!("{RADIUS}{PLANE}G41 D2 G1 X10 Y10 F600\nY40\n{line}");
    finds(Dialect::Fanuc, &within("G69"), &["6:1 cutter-radius"]);
    finds(Dialect::Fanuc, &within("G53.1"), &["6:1 cutter-radius"]);
    finds(Dialect::Fanuc, &within("G53 Z0"), &["6:1 cutter-radius"]);
    finds(Dialect::Fanuc, &within("M30"), &[]);
    let mirrored = format!("{RADIUS}{PLANE}G51.1 X0\nG41 D2");
    finds(Dialect::Fanuc, &mirrored, &["5:1 cutter-radius"]);
    for length in ["H1", "H0"] {
        let text = format!("{RADIUS}G43.4 {length}\nG41 D2 G1 X20 F100");
        finds(Dialect::Fanuc, &text, &["3:1 cutter-radius"]);
    }
}

#[test]
fn places_of_the_machine_are_reached_in_tilted_planes() {
    let place = |text: &str| joints(&last(Dialect::Fanuc, &format!("{PLANE}{text}")));
    let start = place("G0 X0 Y0 Z10");
    let close = |found: [f64; 3], right: [f64; 3]| {
        let far = found.into_iter().zip(right).map(|(a, b)| (a - b).abs());
        assert!(far.fold(0.0, f64::max) < 1e-6, "{found:?} right {right:?}");
    };
    let top = [start[0], start[1], 0.0];
    close(place("G0 X0 Y0 Z10\nG53 Z0"), top);
    close(place("G0 X0 Y0 Z10\nG91 G28 Z0"), top);
    // The length of the tool is none of such a place.
    close(place("G43 H1 G0 X0 Y0 Z10\nG53 Z0"), top);
    // Behind it the plane is in force: 5 along its X.
    close(
        place("G43 H1 G0 X0 Y0 Z10\nG53 Z0\nG91 X5"),
        [top[0] + 5.0, top[1], 0.0],
    );
    close(place("G0 X0 Y0 Z10\nG53 Z0\nZ10"), start);
    // The tool stands along the normal no more.
    let text = format!("{PLANE}G0 X0 Y0 Z10\nG53 A0\nX1");
    finds(Dialect::Fanuc, &text, &["5:1 not-supported"]);
    let again = place("G0 X0 Y0 Z10\nG53 A0\nG53.1\nG0 X0 Y0 Z10");
    close(again, start);
}

#[test]
fn places_of_the_machine_are_without_the_length_that_is_followed() {
    for text in ["G53 Z0", "G91 G28 Z0", "G90 G28 Z20"] {
        let text = format!("G43.4 H1\nG0 Z20\n{text}");
        near(last(Dialect::Fanuc, &text), at(0.0, 0.0, 0.0, 0.0, 0.0));
        let back = format!("{text}\nG90 G0 Z20");
        near(last(Dialect::Fanuc, &back), at(0.0, 0.0, 30.0, 0.0, 0.0));
    }
    near(
        last(Dialect::Siemens, "T1 M6 D1\nTRAORI\nG0 Z20\nSUPA G0 Z0 D0"),
        at(0.0, 0.0, 0.0, 0.0, 0.0),
    );
    // Where the rotary axes are turned it is not clear what would move.
    finds(
        Dialect::Fanuc,
        "G43.4 H1\nG0 A30\nG53 Z0",
        &["3:1 machine-coordinates"],
    );
}
