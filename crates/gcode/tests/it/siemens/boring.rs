//! Tests of CYCLE87, 88, 89 and 840, and cycles with a feed per revolution.

use glidepath_program::{Event, ItemKind, Rate};

use super::{finds, items};

/// What a program does along Z: ends, `r` behind rapids; dwells, codes and stops.
fn steps(text: &str) -> Vec<String> {
    items(text)
        .into_iter()
        .filter_map(|item| match item.kind {
            ItemKind::Move { segment, rate, .. } => {
                let z = (segment.end()[2] * 1e6).round() / 1e6 + 0.0;
                Some(match rate {
                    Rate::Feed(feed_v) => format!("{z} F{}", (feed_v * 60.0).round()),
                    _ => format!("{z}r"),
                })
            }
            ItemKind::Dwell(seconds) => Some(format!("{seconds}s")),
            ItemKind::Event(Event::MCode(code)) => Some(format!("M{code}")),
            ItemKind::Event(Event::ProgramStop(code)) => Some(format!("M{code} stop")),
            _ => None,
        })
        .collect()
}

const HEAD: &str = "S500 M3\nG0 Z50 F100\n";

#[test]
fn holes_are_bored_as_the_cycles_say() {
    let behind = |text: &str| steps(&format!("{HEAD}{text}"))[2..].to_vec();
    assert_eq!(
        behind("CYCLE87(20,0,2,-10,,3)"),
        ["2r", "M3", "-10 F100", "M5", "M0 stop", "20r"]
    );
    assert_eq!(
        behind("CYCLE88(20,0,2,,10,1.5,4)"),
        ["2r", "M4", "-10 F100", "1.5s", "M5", "M0 stop", "20r"]
    );
    assert_eq!(
        behind("CYCLE89(20,0,2,-10,,0.5)"),
        ["2r", "-10 F100", "0.5s", "2 F100", "20r"]
    );
    finds(
        &format!("{HEAD}CYCLE87(20,0,2,-10,,5)"),
        &["3:1 canned-cycle"],
    );
}

#[test]
fn a_chuck_that_gives_way_taps_at_the_feed_of_its_pitch() {
    // 500 turns a minute of 1.5 mm.
    let made = |arguments: &str| steps(&format!("{HEAD}CYCLE840(20,0,2,-10,,{arguments})\nG1 X1"));
    let codes = |made: &[String]| -> Vec<String> {
        let all = made
            .iter()
            .filter(|step| ["M3", "M4", "M5"].contains(&step.as_str()));
        all.cloned().collect()
    };
    let reversed = made("0,0,,0,,1.5");
    let feeds: Vec<&String> = reversed.iter().filter(|step| step.contains('F')).collect();
    assert_eq!(feeds, ["-10 F750", "2 F750", "20 F100"]);
    // Out the other way round, and then as before; SDAC counts with SDR alone.
    assert_eq!(codes(&reversed), ["M3", "M4", "M3"]);
    assert_eq!(codes(&made("0,0,4,0,,1.5")), ["M3", "M4", "M3"]);
    assert_eq!(codes(&made("0,4,5,0,,1.5")), ["M3", "M4", "M3", "M5"]);
    // Threads to the inch, and what ENC says besides an encoder.
    for arguments in ["0,0,5,0,,20,,2", "0,0,5,11,,1.5"] {
        finds(
            &format!("{HEAD}CYCLE840(20,0,2,-10,,{arguments})"),
            &["3:1 canned-cycle"],
        );
    }
    finds("CYCLE840(20,0,2,-10,,0,0,5,0,,1.5)", &["1:1 canned-cycle"]);
    finds(
        &format!("{HEAD}CYCLE840(20,0,2,-10,,0,3,5,0,,1.5)"),
        &["3:1 canned-cycle"],
    );
}

#[test]
fn cycles_count_feeds_as_the_program_does() {
    // 0.1 mm a turn, at half of it for the first stroke.
    let text = "S600 M3\nG95 F0.1\nG0 Z50\nCYCLE83(20,0,2,-20,,-10,,0,,,0.5,1)\nG1 X1";
    let feeds: Vec<String> = steps(text)
        .into_iter()
        .filter(|step| step.contains('F'))
        .collect();
    assert_eq!(feeds, ["-10 F30", "-20 F60", "20 F60"]);
    finds("G93\nCYCLE81(20,0,2,-10)", &["2:1 canned-cycle"]);
}
