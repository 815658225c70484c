//! Tests of the report, of a made-up measurement.

use super::*;

use crate::jitter::{LoopBeat, Windows};
use glidepath_realtime::{Mode, Request};

fn setup() -> Setup {
    Setup {
        period_ns: 4_000_000,
        seconds: 2,
        request: Request {
            priority: Some(80),
            cpu: Some(1),
            ..Request::default()
        },
        mode: Mode::BestEffort,
        motion: None,
        against_cyclictest: true,
    }
}

/// 998 beats 20 µs late, one 1 ms late without steal, one 9 ms late with steal.
fn measured() -> Measurement {
    let mut windows = Windows::new(Some(7));
    let mut beat = |latency_ns: u64, missed: u64| {
        windows.record(&LoopBeat {
            latency_ns,
            lateness_ns: latency_ns.saturating_sub(20_000),
            missed,
            work_ns: 500,
            is_moving: false,
        });
    };
    (0..998).for_each(|_| beat(20_000, 0));
    beat(1_000_000, 0);
    windows.close(Some(7));
    windows.record(&LoopBeat {
        latency_ns: 9_000_000,
        lateness_ns: 980_000,
        missed: 2,
        work_ns: 500,
        is_moving: false,
    });
    windows.close(Some(9));
    let text = "000016 000500\n000030 000500\n# Max Latencies: 00030\n";
    Measurement {
        windows,
        grants: Grants::NONE,
        lost_beats: 0,
        cyclictest: Some(Latencies::parse(text).unwrap()),
    }
}

#[test]
fn the_object_has_both_sets_and_the_difference() {
    let (setup, measured) = (setup(), measured());
    let object = JitterReport::new(&setup, &measured).object();
    assert_eq!(object["ticks"], 1_000);
    assert_eq!(object["missed_ticks"], 2);
    assert_eq!(object["latency_us"]["max"], 9_000.0);
    assert_eq!(object["latency_without_steal_us"]["max"], 1_000.0);
    assert_eq!(object["latency_without_steal_us"]["missed_ticks"], 0);
    assert_eq!(object["lateness_us"]["p50"], 0.0);
    assert_eq!(object["lateness_us"]["max"], 980.0);
    assert_eq!(object["windows_with_steal"], 1);
    assert_eq!(object["steal_ms"], 20);
    assert_eq!(object["realtime"]["fifo"], false);
    assert_eq!(object["cyclictest"]["p50"], 16.0);
    assert_eq!(object["cyclictest"]["p999"], 30.0);
    assert_eq!(object["difference_us"]["max"], 8_970.0);
    let p50 = object["difference_us"]["p50"].as_f64().unwrap();
    assert!((p50 - 4.0).abs() < 0.3, "{p50}");
    let counted: u64 = object["histogram"]
        .as_array()
        .unwrap()
        .iter()
        .map(|bin| bin["count"].as_u64().unwrap())
        .sum();
    assert_eq!(counted, 1_000);
}

#[test]
fn the_text_shows_outliers_and_steal() {
    let (setup, measured) = (setup(), measured());
    let text = JitterReport::new(&setup, &measured).text();
    assert!(
        text.starts_with("empty loop, period 4000 µs, 2 s: 1 000 ticks, 2 missed\n"),
        "{text}"
    );
    assert!(text.contains("20 ms in 1 of 2 windows"), "{text}");
    assert!(text.contains("windows without steal"), "{text}");
    assert!(text.contains("latency − cyclictest"), "{text}");
    let last = text.lines().last().unwrap();
    assert!(
        last.contains("5000 to 10000") && last.ends_with("█ 1"),
        "{text}"
    );
}

#[test]
fn the_plot_has_both_curves() {
    let (setup, measured) = (setup(), measured());
    let plot = JitterReport::new(&setup, &measured).plot();
    assert!(plot.starts_with("<svg") && plot.ends_with("</svg>\n"));
    assert!(plot.contains(">glidepath<") && plot.contains(">cyclictest<"));
    assert_eq!(plot.matches("<path ").count(), 2);
}
