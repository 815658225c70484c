//! Tests of SINUMERIK's cycles for pockets: rings, levels, and what finishing leaves.

use core::f64::consts::TAU;

use glidepath_geometry::Segment;
use glidepath_program::Rate;

use super::moves;

/// Length of the arcs at a level, and how far from the centre the tool comes.
fn at_level(text: &str, z: f64, center: [f64; 2]) -> (f64, f64) {
    let (mut length, mut reach) = (0.0, 0.0_f64);
    for (segment, ..) in moves(text) {
        if (segment.end()[2] - z).abs() < 1e-9 {
            if matches!(segment, Segment::Arc(_)) {
                length += segment.length();
            }
            let (low, high) = segment.bounding_box();
            for axis in 0..2 {
                reach = reach
                    .max(high[axis] - center[axis])
                    .max(center[axis] - low[axis]);
            }
        }
    }
    (length, reach)
}

#[test]
fn circular_pockets_are_cleared_in_rings() {
    // Diameter 8 in a radius of 20 with 1 left: the middle of the tool goes to 15, in rings of at
    // most 6.4, which are three, 5 apart.
    let text = "T8 M6\nG0 Z20 F500\nM3 S1000\nCYCLE832()\nPOCKET4(20,0,2,-10,20,30,40,5,1,1,300,100,0,11)\nX0";
    let (length, reach) = at_level(text, -4.5, [30.0, 40.0]);
    assert!((length - TAU * 30.0).abs() < 1e-6 && (reach - 15.0).abs() < 1e-9);
    let (length, _) = at_level(text, -9.0, [30.0, 40.0]);
    assert!((length - TAU * 30.0).abs() < 1e-6, "{length}");
    // Climbing with M3 is counterclockwise inside.
    for (head, cdir, counter) in [
        ("M3", 0, true),
        ("M3", 1, false),
        ("M4", 0, false),
        ("", 2, false),
        ("", 3, true),
    ] {
        let text =
            format!("T8 M6\n{head}\nG0 Z20\nPOCKET4(20,0,2,-10,20,30,40,,,,300,100,{cdir},11)");
        for (segment, ..) in moves(&text) {
            if let Segment::Arc(arc) = segment {
                assert_eq!(arc.sweep_rad > 0.0, counter, "{head} {cdir}");
            }
        }
    }
}

#[test]
fn pockets_are_finished_at_the_edge_and_on_the_bottom() {
    let text = "T8 M6\nG0 Z20\nPOCKET4(20,0,2,-10,20,0,0,5,1,1,300,100,3,12)";
    let (length, reach) = at_level(text, -5.0, [0.0, 0.0]);
    // Once around at 16, and two quarters of half of it.
    assert!((length - TAU * (16.0 + 0.5 * 8.0)).abs() < 1e-6, "{length}");
    assert!((reach - 16.0).abs() < 1e-9);
    // The bottom: the edge, and rings at 16/3, 32/3 and 16.
    let (length, _) = at_level(text, -10.0, [0.0, 0.0]);
    assert!((length - TAU * (20.0 + 32.0)).abs() < 1e-6, "{length}");
    // Nothing of it goes down at rapid, even with VARI 2.
    let text = text.replace(",3,12)", ",3,2)");
    for (segment, rate, _) in moves(&text) {
        assert!(rate != Rate::Rapid || segment.end()[2] >= 2.0);
    }
}

#[test]
fn helices_lead_into_pockets() {
    let text = "T8 M6\nG0 Z20\nPOCKET4(20,0,2,-10,20,0,0,5,,,300,100,2,21,,,,3,2)";
    let helix = moves(text)
        .into_iter()
        .find_map(|(segment, ..)| match segment {
            Segment::Arc(arc) if arc.end[2] < arc.start[2] => Some(arc),
            _ => None,
        });
    let helix = helix.unwrap();
    assert_eq!((helix.start[2], helix.end[2]), (0.0, -5.0));
    assert!(
        (helix.sweep_rad + 3.0 * TAU).abs() < 1e-9,
        "2.5 turns of 2 mm, rounded up"
    );
}

/// Where the middle of the tool comes, every 0.2 mm.
fn trace(segments: &[Segment]) -> Vec<[f64; 2]> {
    let mut all = Vec::new();
    for segment in segments {
        let (length, mut way) = (segment.length(), 0.0);
        while way <= length {
            let at = segment.jet(way).position;
            all.push([at[0], at[1]]);
            way += 0.2;
        }
    }
    all
}

#[test]
fn rectangular_pockets_are_cleared_to_their_corners() {
    for (length, width, angle, cdir) in [
        (50.0, 30.0, 0.0, 2),
        (30.0, 50.0, 0.0, 3),
        (40.0, 40.0, 30.0, 2),
    ] {
        let text = format!(
            "T6 M6\nG0 Z20\nPOCKET3(20,0,2,-4,{length},{width},5,10,20,{angle},,,,300,100,{cdir},11)"
        );
        let segments: Vec<Segment> = moves(&text)
            .into_iter()
            .map(|(segment, ..)| segment)
            .filter(|segment| segment.start()[2] == -4.0 && segment.end()[2] == -4.0)
            .collect();
        let (sin, cos) = f64::to_radians(angle).sin_cos();
        let place = |u: f64, v: f64| [10.0 + u * cos - v * sin, 20.0 + u * sin + v * cos];
        let (a, b) = (0.5 * length, 0.5 * width);
        let trace = trace(&segments);
        let is_cut = |[x, y]: [f64; 2]| {
            let mut near = trace.iter();
            near.any(|at| (at[0] - x).hypot(at[1] - y) <= 3.02)
        };
        // Inside of the pocket everything is cut, corners of 5 mm left apart.
        let mut inside = 0;
        for i in -25..=25 {
            for j in -25..=25 {
                let (u, v) = (f64::from(i), f64::from(j));
                let (du, dv) = (
                    (u.abs() - (a - 5.0)).max(0.0),
                    (v.abs() - (b - 5.0)).max(0.0),
                );
                if u.abs() <= a && v.abs() <= b && du.hypot(dv) <= 5.0 {
                    inside += 1;
                    assert!(is_cut(place(u, v)), "{length} {width}: {u} {v}");
                }
            }
        }
        assert!(inside > 1000);
        // Nothing outside is.
        for segment in &segments {
            for i in 0..=100 {
                let at = segment
                    .jet(segment.length() * f64::from(i) / 100.0)
                    .position;
                let (x, y) = (at[0] - 10.0, at[1] - 20.0);
                let (u, v) = ((x * cos + y * sin).abs(), (y * cos - x * sin).abs());
                let (du, dv) = ((u - (a - 5.0)).max(0.0), (v - (b - 5.0)).max(0.0));
                let fits = u <= a - 3.0 + 1e-9 && v <= b - 3.0 + 1e-9 && du.hypot(dv) <= 2.0 + 1e-9;
                assert!(fits, "{length} {width} {u} {v}");
            }
        }
    }
}

#[test]
fn rectangular_pockets_are_finished() {
    let text = "T6 M6\nG0 Z20\nPOCKET3(20,0,2,-4,50,30,5,0,0,0,2,0.5,,300,100,3,12)";
    let (length, reach) = at_level(text, -2.0, [0.0, 0.0]);
    // Four corners of 2, and two quarters of 6.
    assert!((length - TAU * (2.0 + 3.0)).abs() < 1e-6, "{length}");
    assert!((reach - 22.0).abs() < 1e-9);
}
