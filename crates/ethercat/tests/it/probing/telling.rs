//! Where a contact is told to have been.

use super::{PART_Z, TOUCH, probe, searched, setup};
use crate::machine::COUNTS;
use glidepath_emulator::Probe;
use glidepath_ethercat::{Event, ProbeTrouble, TouchProbe};
use glidepath_link::{ContactKind, Status};

/// Searches at 20 mm/s, from the machine's zero, where nothing is touched: the way of the other axes for
/// one of Z, and the program.
const FAST: [([f64; 2], &[&str]); 3] = [
    ([0.0, 0.0], &["G21 G90 F1200\nG38.2 Z-5\n"]),
    ([0.5, 0.0], &["G21 G90 F1200\nG38.2 X-2 Z-4\n"]),
    ([1.0, -0.5], &["G21 G90 F1200\nG38.2 X-4 Y2 Z-4\n"]),
];

/// How far what was told is from where the part is, mm.
fn error(status: &Status, [x, y]: [f64; 2]) -> f64 {
    assert_eq!(status.contact(), Ok(ContactKind::Made));
    let [told_x, told_y, told_z, ..] = status.contact;
    let off = [told_x - x * PART_Z, told_y - y * PART_Z, told_z - PART_Z];
    off.iter().map(|off| off.abs()).fold(0.0, f64::max)
}

/// The largest error of searches that begin anywhere in a period.
fn worst(period_ns: u64, touch: Option<TouchProbe>) -> f64 {
    let mut worst = 0.0_f64;
    for phase_ns in [300_000, 1_300_000, 2_100_000, 3_600_000] {
        for (ways, programs) in FAST {
            let mut setup = setup(period_ns, touch);
            setup.phase_ns = phase_ns;
            let (search, events) = searched(&setup, probe(), programs);
            assert!(!events.iter().any(is_of_probe), "{events:?}");
            worst = worst.max(error(&search.found[0], ways));
        }
    }
    worst
}

pub(super) const fn is_of_probe(event: &Event) -> bool {
    matches!(event, Event::Probe(_))
}

#[test]
fn a_contact_is_told_to_the_count_where_drives_keep_it() {
    for period_ns in [1_000_000, 2_000_000, 4_000_000] {
        let (sampled, kept) = (worst(period_ns, None), worst(period_ns, Some(TOUCH)));
        eprintln!(
            "bus {} ms, 20 mm/s: {:.2} um from samples, {:.4} um as drives keep it",
            period_ns / 1_000_000,
            1e3 * sampled,
            1e3 * kept
        );
        assert!(kept <= 1.5 / COUNTS, "{kept}");
        // A filter of 3 ms, and up to a period.
        assert!(sampled > 0.04, "{sampled}: the case says nothing");
    }
}

#[test]
fn slow_searches_and_every_unit_and_source_are_told_to_the_count() {
    const SLOW: &[&str] = &["G21 G90 F30\nG38.2 X-1 Z-2\n"];
    let chosen = TouchProbe {
        source: Some(1),
        ..TOUCH
    };
    for touch in [TOUCH, TouchProbe { unit: 2, ..TOUCH }, chosen] {
        let mut setup = setup(4_000_000, Some(touch));
        for emulated in &mut setup.emulated[..3] {
            emulated.touch_probe.as_mut().unwrap().has_sources = touch.source.is_some();
        }
        let (search, events) = searched(&setup, probe(), SLOW);
        let error = error(&search.found[0], [0.5, 0.0]);
        assert!(error <= 1.5 / COUNTS, "{touch:?}: {error}, {events:?}");
    }
}

/// Down to the part, away from it again, and a second time; then the end of a contact.
#[test]
fn searches_follow_each_other_and_the_end_of_a_contact_is_told_as_well() {
    const PARTS: &[&str] = &[
        "G21 G90 F600\nG38.2 Z-5\n",
        "G21 G91 G0 Z1\n",
        "G21 G90 F60\nG38.2 Z-3\n",
        "G21 G90 F300\nG38.4 Z3\n",
    ];
    // A probe that opens its contact, and drives that see the other edge.
    for is_inverted in [false, true] {
        let touch = TouchProbe {
            is_inverted,
            ..TOUCH
        };
        let mut setup = setup(2_000_000, Some(touch));
        let mut probe = probe();
        if is_inverted {
            probe.is_closed_above = true;
            setup.terminals[0].inputs[0].is_inverted = true;
        }
        let (search, events) = searched(&setup, probe, PARTS);
        assert!(!events.iter().any(is_of_probe), "{events:?}");
        for nth in [0, 2, 3] {
            let error = error(&search.found[nth], [0.0, 0.0]);
            assert!(error <= 1.5 / COUNTS, "{is_inverted} {nth}: {error}");
        }
        assert_eq!(search.found[1].contact(), Ok(ContactKind::None));
    }
}

#[test]
fn a_probe_that_touches_at_the_start_stops_the_search_there() {
    let setup = setup(2_000_000, Some(TOUCH));
    let touching = Probe {
        at_counts: 0.5 * COUNTS,
        ..probe()
    };
    let (search, events) = searched(&setup, touching, &["G21 G90 F600\nG38.2 Z-5\n"]);
    let status = &search.found[0];
    assert_eq!(status.contact(), Ok(ContactKind::AlreadySo));
    assert!(status.contact[2].abs() < 0.01, "{}", status.contact[2]);
    assert!(!events.iter().any(is_of_probe), "{events:?}");
}

#[test]
fn what_cannot_be_is_not_told_and_the_place_of_samples_is() {
    // A joint that moves, and one that stands.
    for (nth, off_counts, is_seen) in [
        (2, 1_000_000, true),
        (2, -2_000_000_000, true),
        (0, 50_000, true),
        (2, 0, false),
    ] {
        let mut setup = setup(4_000_000, Some(TOUCH));
        setup.emulated[nth].touch_probe.as_mut().unwrap().off_counts = off_counts;
        let (search, events) = searched(&setup, probe(), FAST[0].1);
        let found = |event: &&Event| matches!(event, Event::Probe(ProbeTrouble::Elsewhere(joint, ..)) if *joint == nth);
        assert_eq!(
            events.iter().any(|event| found(&event)),
            is_seen,
            "{events:?}"
        );
        let error = error(&search.found[0], [0.0, 0.0]);
        let most = if is_seen { 0.02 * 9.0 } else { 1.5e-6 };
        assert!(error <= most, "{nth} {off_counts}: {error}");
        assert!(error > 1e-3 || !is_seen, "{error}: it was told");
    }
}

#[test]
fn a_drive_that_is_not_wired_is_told_and_the_program_goes_on() {
    let mut setup = setup(4_000_000, Some(TOUCH));
    // Its source is another input than the one that is wired.
    setup.emulated[1].touch_probe.as_mut().unwrap().has_sources = true;
    setup.drives[1].probe = Some(TouchProbe {
        source: Some(5),
        ..TOUCH
    });
    let (search, events) = searched(&setup, probe(), FAST[0].1);
    assert!(
        events.contains(&Event::Probe(ProbeTrouble::Missed(1))),
        "{events:?}"
    );
    let error = error(&search.found[0], [0.0, 0.0]);
    assert!(error < 0.02 * 9.0, "{error}");
    // Two seconds, in ticks.
    assert!(
        (450..600).contains(&search.waited[0]),
        "{:?}",
        search.waited
    );
}
