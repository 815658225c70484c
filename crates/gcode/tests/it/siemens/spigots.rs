//! Tests of CYCLE76 and CYCLE77. Values are computed by hand, for tool 6 of 6 mm diameter.

use glidepath_program::Rate;

use super::{finds, moves, ways};

const HEAD: &str = "G17 G90 T6 D1 M6\nS1000 M3\nG0 X0 Y0 Z50\n";

#[test]
fn a_round_spigot_of_one_level() {
    // Diameter 20 about (50, 40), blank of 30: the path has a radius of 13; down at 15 + 3 + 1 from the centre.
    let text = format!("{HEAD}CYCLE77(10,0,1,-5,,20,50,40,0,0,0,300,100,3,1,30)");
    assert_eq!(
        ways(&text)[1..],
        [
            "0 0 10r",
            "69 40 10r",
            "69 40 1r",
            "69 40 -5",
            "63 40 -5-",
            "63 40 -5+",
            "69 40 -5-",
            "69 40 10r",
        ]
    );
    let feeds: Vec<Rate> = moves(&text).into_iter().map(|(_, rate, _)| rate).collect();
    assert_eq!(feeds[4..6], [Rate::Feed(100.0 / 60.0), Rate::Feed(5.0)]);
    // The depth as an increment.
    let text = format!("{HEAD}CYCLE77(10,0,1,,5,20,50,40,0,0,0,300,100,3,1,30)");
    assert_eq!(ways(&text)[4], "69 40 -5");
    // Climbing with the spindle clockwise is clockwise, against it the other way round.
    for (direction, round) in [("0", "-"), ("1", "+"), ("2", "-"), ("3", "+")] {
        let text = format!("{HEAD}CYCLE77(10,0,1,-5,,20,50,40,0,0,0,300,100,{direction},1,30)");
        assert_eq!(
            ways(&text)[6],
            format!("63 40 -5{round}"),
            "CDIR {direction}"
        );
    }
}

#[test]
fn levels_and_allowances() {
    // 10 deep less .5 in levels of 5 at most: 4.75 each; .2 is left at the side.
    let text = format!("{HEAD}CYCLE77(10,0,1,-10,,20,50,40,5,.2,.5,300,100,3,1,30)");
    let downs: Vec<String> = ways(&text)
        .into_iter()
        .filter(|way| way.starts_with("69 40 -"))
        .collect();
    assert_eq!(
        downs,
        ["69 40 -4.75", "69 40 -4.75-", "69 40 -9.5", "69 40 -9.5-"]
    );
    assert_eq!(ways(&text)[6], "63.2 40 -4.75+");
    // Finishing leaves nothing.
    let text = format!("{HEAD}CYCLE77(10,0,1,-10,,20,50,40,0,.2,.5,300,100,3,2,30)");
    assert_eq!(ways(&text)[5..7], ["63 40 -10-", "63 40 -10+"]);
    // Without a blank the tool goes down its radius beside the path.
    let text = format!("{HEAD}CYCLE77(10,0,1,-10,,20,50,40,0,0,0,300,100,3,2)");
    assert_eq!(ways(&text)[4], "66 40 -10");
}

#[test]
fn a_rectangular_spigot() {
    // 40 by 20 with corners of 2 about the zero: the path is 23 and 13 from it, with corners of 5.
    let text = format!("{HEAD}CYCLE76(10,0,2,-5,,40,20,2,0,0,0,0,0,0,300,100,3,1,50,30)");
    assert_eq!(
        ways(&text)[2..],
        [
            "30 0 10r",
            "30 0 2r",
            "30 0 -5",
            "23 0 -5-",
            "23 8 -5",
            "18 13 -5+",
            "-18 13 -5",
            "-23 8 -5+",
            "-23 -8 -5",
            "-18 -13 -5+",
            "18 -13 -5",
            "23 -8 -5+",
            "23 0 -5",
            "30 0 -5-",
            "30 0 10r",
        ]
    );
    // Turned by 90 degrees about (100, 0), clockwise.
    let text = format!("{HEAD}CYCLE76(10,0,2,-5,,40,20,2,100,0,90,0,0,0,300,100,2,1,50,30)");
    assert_eq!(
        ways(&text)[2..8],
        [
            "100 30 10r",
            "100 30 2r",
            "100 30 -5",
            "100 23 -5+",
            "108 23 -5",
            "113 18 -5-"
        ]
    );
}

#[test]
fn spigots_that_are_refused() {
    for call in [
        "CYCLE77(10,0,1,-5,,0,50,40,0,0,0,300,100,3,1,30)",
        "CYCLE77(10,0,1,-5,,20,,40,0,0,0,300,100,3,1,30)",
        "CYCLE77(10,0,1,-5,,20,50,40,0,0,5,300,100,3,1,30)",
        "CYCLE77(10,0,1,-5,,20,50,40,0,0,0,300,100,3,5,30)",
        "CYCLE77(10,0,1,-5,,20,50,40,0,0,0,300,100,3,1,30,2)",
        "CYCLE76(10,0,2,-5,,40,20,11,0,0,0,0,0,0,300,100,3,1,50,30)",
    ] {
        let text = format!("{HEAD}{call}");
        let report = glidepath_gcode::check(text.as_bytes(), super::options());
        assert_eq!(report.diagnostics.len(), 1, "{call}");
    }
    finds(
        "CYCLE77(10,0,1,-5,,20,50,40,0,0,0,300,100,3,1,30)",
        &["1:1 canned-cycle"],
    );
    finds(
        "LONGHOLE(5,0,1,-23,,4,30,40,45,20,45,90,100,320,6)",
        &["1:1 not-supported"],
    );
    finds(
        "CYCLE61(50,2,1,0,0,0,100,80,2,60,0,500,31,0,1,10)",
        &["1:1 not-supported"],
    );
}
