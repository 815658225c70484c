//! CYCLE71. Values are computed by hand, for a tool with a radius of 4 mm.

use glidepath_program::Rate;

use super::{finds, moves};

const HEAD: &str = "T8 M6\nF100\n";

/// Ends of moves; of those at feed, mm/min.
fn ways(cycle: &str) -> Vec<([f64; 3], Option<f64>)> {
    let all = moves(&format!("{HEAD}{cycle}")).into_iter();
    all.map(|(segment, rate, _)| {
        let end = segment.end();
        let place = [0, 1, 2].map(|axis| (end[axis] * 1e6).round() / 1e6 + 0.0);
        let feed = match rate {
            Rate::Feed(feed_v) => Some((feed_v * 60.0).round()),
            _ => None,
        };
        (place, feed)
    })
    .collect()
}

/// Where the moves at feed go along the face.
fn strokes(cycle: &str) -> Vec<[f64; 2]> {
    let all = ways(cycle).into_iter();
    all.filter(|(_, feed)| feed.is_some())
        .map(|([x, y, _], _)| [x, y])
        .collect()
}

#[test]
fn a_face_is_milled_to_and_fro_in_levels() {
    // 20 and 1 beyond: four strokes, 5.25 wide each; they go 4 and 3 beyond the edges.
    let (rapid, feed) = (None, Some(800.0));
    let mut expected = vec![([0.0, 0.0, 10.0], rapid), ([93.0, 51.25, 10.0], rapid)];
    for (level, clear) in [(-2.0, 2.0), (-4.0, 0.0)] {
        if level < -2.0 {
            expected.push(([93.0, 51.25, 2.0], rapid));
        }
        expected.push(([93.0, 51.25, clear], rapid));
        for [x, y] in [
            [93.0, 51.25],
            [167.0, 51.25],
            [167.0, 56.5],
            [93.0, 56.5],
            [93.0, 61.75],
            [167.0, 61.75],
            [167.0, 67.0],
            [93.0, 67.0],
        ] {
            expected.push(([x, y, level], feed));
        }
        expected.push(([93.0, 67.0, clear], rapid));
    }
    expected.push(([93.0, 67.0, 10.0], rapid));
    assert_eq!(
        ways("CYCLE71(10,0,2,-4,100,50,60,20,0,2,6,3,0,800,31,1)"),
        expected
    );
    // The feed from before holds again.
    let behind = ways("CYCLE71(10,0,2,-4,100,50,60,20,0,2,6,3,0,800,31,1)\nG1 X0");
    assert_eq!(behind.last(), Some(&([0.0, 67.0, 10.0], Some(100.0))));
}

#[test]
fn strokes_go_where_the_signs_and_the_angle_say() {
    // Along Y in one direction, towards lower X: ten strokes, 6 wide, as MIDA is left out.
    let upright = ways("CYCLE71(10,0,2,-4,100,50,-60,20,0,0,,3,,800,21)");
    let down: Vec<[f64; 3]> = upright
        .iter()
        .filter(|(place, feed)| feed.is_some() && (place[1] - 43.0).abs() < 1e-9)
        .map(|(place, _)| *place)
        .collect();
    assert_eq!(down.len(), 10);
    assert_eq!((down[0], down[9]), ([98.0, 43.0, -4.0], [44.0, 43.0, -4.0]));
    // At rapid above what is not cut yet, back to the beginning of the next one.
    let first = upright
        .iter()
        .position(|(place, _)| *place == [98.0, 77.0, -4.0])
        .expect("the end of the first stroke");
    assert_eq!(
        upright[first + 1..first + 4],
        [
            ([98.0, 77.0, 2.0], None),
            ([92.0, 43.0, 2.0], None),
            ([92.0, 43.0, -4.0], Some(800.0))
        ]
    );
    // By 90 degrees about the corner.
    let turned = strokes("CYCLE71(10,0,2,-4,100,50,60,20,90,0,6,3,0,800,31,1)");
    assert_eq!(turned[..2], [[98.75, 43.0], [98.75, 117.0]]);
}

#[test]
fn what_roughing_leaves_is_finished_in_one_level() {
    let levels = |cycle: &str| -> Vec<f64> {
        let all = ways(cycle).into_iter();
        let mut levels: Vec<f64> = all
            .filter(|(_, feed)| feed.is_some())
            .map(|([_, _, z], _)| z)
            .collect();
        levels.dedup();
        levels
    };
    let face = |words: &str| format!("CYCLE71(10,0,2,-4,100,50,60,20,0,{words})");
    assert_eq!(levels(&face("1.5,6,3,0.4,800,31")), [-1.2, -2.4, -3.6]);
    assert_eq!(levels(&face("1.5,6,3,0.4,800,32")), [-4.0]);
    // From above what is left.
    assert!(ways(&face("1.5,6,3,0.4,800,32")).contains(&([93.0, 51.0, -1.6], None)));
    for (words, place) in [
        ("1.5,9,3,0,800,31", "3:1 canned-cycle"),
        ("1.5,6,3,4,800,31", "3:1 canned-cycle"),
        ("1.5,6,3,0,800,51", "3:1 canned-cycle"),
        ("1.5,6,-3,0,800,31", "3:1 canned-cycle"),
        ("0.0001,0.01,3,0,800,31", "3:1 canned-cycle"),
        ("1.5,6,3,0,800,31,0,7", "3:1 not-supported"),
    ] {
        finds(&format!("{HEAD}{}", face(words)), &[place]);
    }
    finds(
        "CYCLE71(10,0,2,-4,0,0,60,20,0,0,6,3,0,800,31)",
        &["1:1 canned-cycle"],
    );
    finds(
        &format!("{HEAD}CYCLE71(10,0,2,-4,0,0,0,20,0,0,6,3,0,800,31)"),
        &["3:1 canned-cycle"],
    );
}
