//! Tests of how deep cycles for holes go: DP, DPR, the planes, and the arguments of CYCLE81.

use glidepath_program::ItemKind;

use super::{ends, finds, items};

fn zs(cycle: &str) -> Vec<f64> {
    let text = format!("S500 M3 F300\nG0 Z20\n{cycle}");
    ends(&text).into_iter().skip(1).map(|[_, _, z]| z).collect()
}

#[test]
fn a_depth_of_zero_is_one_that_is_left_out() {
    // Down to 2 mm above the surface, to the bottom, and out to RTP.
    let hole = [2.0, -22.0, 10.0];
    for cycle in [
        "CYCLE81(10,0,2,-22,0)",
        "CYCLE82(10,0,2,-22,0,0)",
        "CYCLE82(10,0,2,,22,0)",
        "CYCLE87(10,0,2,-22,0,3)",
        "CYCLE88(10,0,2,-22,0,0,3)",
        // Where they differ, DPR decides.
        "CYCLE81(10,0,2,-5,22)",
        "CYCLE81(10,0,2,-22,0,0,0,1,12)",
        "CYCLE81(10,0,2,22,0,0,0,1,11)",
    ] {
        assert_eq!(zs(cycle), hole, "{cycle}");
    }
    let slowly = [2.0, -22.0, 2.0, 10.0];
    for cycle in [
        "CYCLE85(10,0,2,-22,0,0,300,300)",
        "CYCLE89(10,0,2,-22,0,0)",
        "CYCLE840(10,0,2,-22,0,0,4,3,1,0,1)",
    ] {
        let found = zs(cycle);
        assert_eq!(found[..2], slowly[..2], "{cycle}");
        assert_eq!(found.last(), Some(&10.0), "{cycle}");
    }
    // The first depth of CYCLE83 likewise: FDEP -6, FDPR 0; each stroke 6 mm.
    assert_eq!(
        zs("CYCLE83(10,0,2,-12,0,-6,0,0,0,0,1,0)"),
        [2.0, -6.0, -5.0, -12.0, 10.0]
    );
    assert_eq!(
        ends("G0 Z20 F300\nMCALL CYCLE82(10,0,2,-22,0,0)\nX5\nMCALL")
            .iter()
            .map(|[_, _, z]| *z)
            .fold(f64::MAX, f64::min),
        -22.0
    );
    finds("G0 Z20 F300\nCYCLE81(10,0,2,,0)", &["2:1 missing-word"]);
}

#[test]
fn the_tool_may_retract_to_the_surface() {
    assert_eq!(zs("CYCLE81(0,0,2,-22)"), [2.0, -22.0, 0.0]);
    assert_eq!(zs("CYCLE82(5,5,2,-22,0,0)"), [7.0, -22.0, 5.0]);
    // Alarm 61101.
    for cycle in [
        "CYCLE81(0,0,2,,22)",
        "CYCLE81(0,0,2,-22,22)",
        "CYCLE81(-1,0,2,-22)",
        "CYCLE81(10,0,2,0.5)",
    ] {
        finds(&format!("G0 Z20 F300\n{cycle}"), &["2:1 canned-cycle"]);
    }
}

#[test]
fn cycle81_has_a_dwell_in_front_of_its_modes() {
    let dwells = |cycle: &str| -> Vec<f64> {
        items(&format!("G0 Z20 F300\n{cycle}"))
            .into_iter()
            .filter_map(|item| match item.kind {
                ItemKind::Dwell(seconds) => Some(seconds),
                _ => None,
            })
            .collect()
    };
    for (cycle, dwell) in [
        ("CYCLE81(10,0,2,-22,,1.5)", Some(1.5)),
        ("CYCLE81(10,0,2,-22,,1.5,0,1,12)", Some(1.5)),
        ("CYCLE81(10,0,2,-22,0,0.5,0,1)", Some(0.5)),
        // AMODE is left out: DMODE is the plane, and DP a coordinate.
        ("CYCLE81(10,0,2,-22,,0,0,1)", None),
        ("CYCLE81(10,0,2,-22,,0,0,10)", None),
    ] {
        assert_eq!(zs(cycle), [2.0, -22.0, 10.0], "{cycle}");
        assert_eq!(
            dwells(cycle),
            dwell.into_iter().collect::<Vec<_>>(),
            "{cycle}"
        );
    }
    for cycle in [
        // DMODE of G18, and digits that it does not have; a centring by diameter.
        "CYCLE81(10,0,2,-22,,0,0,2)",
        "CYCLE81(10,0,2,-22,,0,0,12)",
        "CYCLE81(10,0,2,-22,,1,0,10)",
        "CYCLE81(10,0,2,-22,,0,1,12)",
        "CYCLE81(10,0,2,-22,,0,10,1,12)",
        "CYCLE81(10,0,2,-22,,2,0,1,22)",
    ] {
        finds(&format!("G0 Z20 F300\n{cycle}"), &["2:1 not-supported"]);
    }
}
