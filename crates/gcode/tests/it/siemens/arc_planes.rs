//! Tests of arcs in another plane than the one in force. Values are computed by hand.

use glidepath_geometry::{Plane, Segment};

use super::{finds, moves};

#[test]
fn an_arc_in_the_plane_of_its_centre() {
    // A quarter in ZX as posts write it with G17: as G18 has it, G2 leads from +Z to +X.
    let arc = |text: &str| match moves(text).last() {
        Some((Segment::Arc(arc), ..)) => (arc.plane, arc.sweep_rad.to_degrees().round(), arc.end),
        other => panic!("{other:?}"),
    };
    let start = "G17 F100\nG0 X0 Y5 Z0\n";
    for end in [
        "G2 X10 Z10 I10 K0",
        "G2 X10 Y5 Z10 I10 K0",
        "G18 G2 X10 Z10 I10 K0",
    ] {
        let (plane, sweep, to) = arc(&format!("{start}{end}"));
        assert_eq!((plane, sweep), (Plane::Zx, -270.0), "{end}");
        assert_eq!([0, 1, 2].map(|axis| to[axis]), [10.0, 5.0, 10.0]);
    }
    // Half a circle with an end in one axis, whole circles, one in YZ, increments.
    assert_eq!(arc(&format!("{start}G3 X20 I10 K0")).0, Plane::Zx);
    assert_eq!(arc(&format!("{start}G3 I10 K0")).1, 360.0);
    assert_eq!(arc(&format!("{start}G2 Y15 Z-10 J0 K-10")).0, Plane::Yz);
    assert_eq!(arc(&format!("{start}G91 G2 X10 Z-10 K-10")).0, Plane::Zx);
    assert_eq!(arc(&format!("{start}G2 X10 Z-10 I0 J0 K-10")).0, Plane::Zx);
    assert_eq!(arc("G19 G2 X10 Y10 I10 J0").0, Plane::Xy);
    // Helices and arcs of the plane in force.
    assert_eq!(arc(&format!("{start}G2 X10 Y5 I5 K0")).0, Plane::Xy);
    assert_eq!(arc(&format!("{start}G2 X10 I5 J0 K0")).0, Plane::Xy);
    assert_eq!(arc(&format!("{start}G2 X10 Z-1 I5 J0")).0, Plane::Xy);
    // Either would do; no helix, compensation or angle in another plane.
    finds(&format!("{start}G2 X10 Z-10 CR=10"), &["3:1 arc-plane"]);
    assert_eq!(arc(&format!("{start}G2 X10 Y5 Z-10 CR=10")).0, Plane::Xy);
    for helix in ["G2 X10 Y6 Z-10 K-10 I0", "G2 X10 Y6 Z10 I10 K0"] {
        finds(&format!("{start}{helix}"), &["3:1 arc-plane"]);
    }
    finds(&format!("{start}G2 I10 K0 AR=90"), &["3:1 arc-plane"]);
    let side = "T1 M6\nG17 G41 G1 X20 Y0 F100\nX40\nG2 X50 Z-10 K-10\nG1 X60\nG40 Y9";
    finds(side, &["4:1 arc-plane"]);
}
