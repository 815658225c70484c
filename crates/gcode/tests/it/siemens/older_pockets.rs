//! Tests of POCKET1 and POCKET2. Values are computed by hand.

use glidepath_program::Rate;

use super::{finds, moves, ways};

/// The least and the greatest coordinate of the tool's centre on each axis, at feed.
fn extent(text: &str) -> [[f64; 2]; 3] {
    let mut extent = [[f64::INFINITY, f64::NEG_INFINITY]; 3];
    for (segment, rate, _) in moves(text) {
        if rate == Rate::Rapid {
            continue;
        }
        for step in 0..=50 {
            let at = segment.jet(segment.length() * f64::from(step) / 50.0);
            for (axis, [low, high]) in extent.iter_mut().enumerate() {
                *low = low.min(at.position[axis]);
                *high = high.max(at.position[axis]);
            }
        }
    }
    extent.map(|bounds| bounds.map(|bound| (bound * 1e6).round() / 1e6 + 0.0))
}

const HEAD: &str = "G17 G90 T8 D1 M6\nS1000 M3\nG0 X0 Y0 Z50\n";

#[test]
fn a_round_pocket_is_roughed_out_and_finished() {
    // Radius 20 about (30, 40), tool of 8 mm, 1 left: rings of 5, 10 and 15, in two levels of 5. Finishing
    // at 16 in one level of 10, on quarters of 8.
    let text = format!("{HEAD}POCKET2(10,0,1,-10,,20,30,40,100,300,5,3,1,0,10,200)");
    let level = |z: &str| {
        [
            "30 40 _", "35 40 _", "35 40 _+", "40 40 _", "40 40 _+", "45 40 _", "45 40 _+",
            "30 40 _",
        ]
        .map(|way| way.replace('_', z))
    };
    let mut expected = vec!["0 0 10r".to_owned(), "30 40 10r".into(), "30 40 1r".into()];
    expected.extend(level("-5"));
    expected.extend(level("-10"));
    expected.extend(
        [
            "30 40 10r",
            "30 40 1r",
            "30 40 -10",
            "38 32 -10",
            "46 40 -10+",
            "46 40 -10+",
            "38 48 -10+",
            "30 40 -10",
            "30 40 10r",
        ]
        .map(str::to_owned),
    );
    assert_eq!(ways(&text)[1..], expected);
    let feeds: Vec<Rate> = moves(&text).into_iter().map(|(_, rate, _)| rate).collect();
    let at = |per_minute: f64| Rate::Feed(per_minute / 60.0);
    assert_eq!(feeds[4..6], [at(100.0), at(300.0)]);
    assert_eq!(feeds[22..24], [at(100.0), at(200.0)]);
    // Roughing alone, finishing alone, in levels of MID at the feed FFP1 where nothing else is said.
    let rough = text.replace(",0,10,200)", ",1,10,200)");
    assert_eq!(
        ways(&rough)[1..],
        [&expected[..19], &expected[27..]].concat()
    );
    let finish = ways(&text.replace(",0,10,200)", ",2)"));
    assert_eq!(finish[4..6], ["30 40 -5", "38 32 -5"]);
    let downs = finish.iter().filter(|way| way.starts_with("46 40"));
    assert_eq!(downs.count(), 4);
    // Clockwise.
    let other = ways(&text.replace(",5,3,1,", ",5,2,1,"));
    assert_eq!(
        other[23..27],
        ["38 48 -10", "46 40 -10-", "46 40 -10-", "38 32 -10-"]
    );
    // Nothing to finish.
    let plain = text.replace(",5,3,1,", ",5,3,0,");
    assert_eq!(extent(&plain)[0], [14.0, 46.0]);
    assert_eq!(ways(&plain).last().map(String::as_str), Some("30 40 10r"));
}

#[test]
fn a_rectangular_pocket_stays_inside() {
    let head = HEAD.replace("T8", "T6");
    // 50 x 30 about (10, 20), tool of 6 mm: 22 and 12 to each side, .5 less with FAL.
    for (arguments, x, y) in [
        ("0,100,300,2,2,.5,1", [-11.5, 31.5], [8.5, 31.5]),
        ("0,100,300,2,3,.5,2", [-12.0, 32.0], [8.0, 32.0]),
        ("0,100,300,2,3,.5", [-12.0, 32.0], [8.0, 32.0]),
        ("90,100,300,2,2,.5,1", [-1.5, 21.5], [-1.5, 41.5]),
        ("90,100,300,2,2,0,0,,,500", [-2.0, 22.0], [-2.0, 42.0]),
    ] {
        for depth in ["-4,", ",4"] {
            let text = format!("{head}POCKET1(10,0,1,{depth},50,30,5,10,20,{arguments})");
            let found = extent(&text);
            assert_eq!(found[..2], [x, y], "{arguments}");
            assert_eq!(found[2], [-4.0, 1.0], "{arguments}");
        }
    }
    // Nothing goes down at rapid below the clearance.
    let text = format!("{head}POCKET1(10,0,1,-4,,50,30,5,10,20,0,100,300,2,2,.5,0)");
    for (segment, rate, _) in moves(&text) {
        assert!(rate != Rate::Rapid || segment.end()[2] >= 1.0);
    }
}

#[test]
fn what_is_not_meant_is_refused() {
    for (cycle, found) in [
        // CDIR left out, a centre left out, no step, no feeds.
        ("POCKET2(10,0,1,-10,,20,30,40,100,300,5)", "canned-cycle"),
        ("POCKET2(10,0,1,-10,,20,30,,100,300,5,3)", "missing-word"),
        ("POCKET2(10,0,1,-10,,20,30,40,100,300,,3)", "missing-word"),
        ("POCKET2(10,0,1,-10,,20,30,40,,300,5,3)", "missing-word"),
        // CDIR, VARI, and another speed for finishing.
        ("POCKET2(10,0,1,-10,,20,30,40,100,300,5,0)", "canned-cycle"),
        (
            "POCKET2(10,0,1,-10,,20,30,40,100,300,5,3,1,3)",
            "canned-cycle",
        ),
        (
            "POCKET2(10,0,1,-10,,20,30,40,100,300,5,3,1,0,,,900)",
            "canned-cycle",
        ),
        // The tool does not fit, also into corners.
        (
            "POCKET2(10,0,1,-10,,4.5,30,40,100,300,5,3,1)",
            "canned-cycle",
        ),
        (
            "POCKET1(10,0,1,-4,,50,30,3,10,20,0,100,300,2,2)",
            "canned-cycle",
        ),
        (
            "POCKET1(10,0,1,-4,,50,30,5,10,20,0,100,300,2,2,,,,,,1)",
            "not-supported",
        ),
    ] {
        finds(&format!("{HEAD}{cycle}"), &[&format!("4:1 {found}")]);
    }
    // A contour has one place.
    finds("MCALL CYCLE95(,1)", &["1:7 not-supported"]);
}
