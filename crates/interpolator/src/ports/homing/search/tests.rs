//! Tests of a search for the index pulse that a drive keeps: what it believes of what the drive says.

use super::*;

/// Upwards from 10.0, up to 5.5 mm.
const ALONE: JointHoming = JointHoming {
    search_v: 0.0,
    latch_v: 2.0,
    final_v: 50.0,
    index: Some(IndexPulse::Drive),
    offset: 3.0,
    home: 0.5,
    absolute: None,
    sequence: 0,
    is_shared: false,
    is_volatile: false,
    ignores_limits: false,
    search_travel: 5.5,
    clearance: 2.0,
};
const FROM: f64 = 10.0;

/// What is seen after so many ms, at a place.
fn seen(ms: u64, place: f64, kept: Kept) -> Seen {
    Seen {
        now_ns: ms * 1_000_000,
        place,
        actual: place,
        index: IndexSeen {
            latched: None,
            kept,
        },
        ..Seen::default()
    }
}

fn at_rest(ms: u64, place: f64, kept: Kept) -> Seen {
    Seen {
        rests: true,
        ..seen(ms, place, kept)
    }
}

fn begun(kept: Kept) -> HomeSearch {
    let mut search = HomeSearch::new(&ALONE).unwrap();
    assert_eq!(search.step(&at_rest(0, FROM, kept), true), Step::Wait);
    search
}

/// One that has set out.
fn under_way() -> HomeSearch {
    let mut search = begun(Kept::No);
    let told = search.step(&at_rest(4, FROM, Kept::Armed), true);
    assert!(matches!(told, Step::Go { .. }), "{told:?}");
    search
}

#[test]
fn a_drive_that_is_not_ready_any_more_ends_the_way_whatever_it_says_later() {
    let mut search = under_way();
    assert_eq!(search.step(&seen(8, 10.5, Kept::Armed), true), Step::Wait);
    let told = search.step(&seen(12, 11.0, Kept::No), true);
    assert_eq!(told, Step::Failed(SearchFailure::Disarmed));
}

#[test]
fn what_a_drive_was_asked_before_does_not_count() {
    for before in [Kept::Armed, Kept::At(12.0)] {
        let mut search = begun(before);
        for ms in [4, 8] {
            assert_eq!(search.step(&at_rest(ms, FROM, before), true), Step::Wait);
        }
        assert_eq!(search.step(&at_rest(12, FROM, Kept::No), true), Step::Wait);
        let told = search.step(&at_rest(16, FROM, Kept::Armed), true);
        assert!(matches!(told, Step::Go { .. }), "{told:?}");
    }
}

#[test]
fn a_joint_that_stands_on_its_pulse_is_told_as_that() {
    let mut search = begun(Kept::No);
    let told = search.step(&at_rest(4, FROM, Kept::At(FROM)), true);
    assert_eq!(told, Step::Failed(SearchFailure::OnPulse));
    // And what comes while it begins to move.
    for beside in [-0.009, 0.009] {
        let told = under_way().step(&seen(8, 10.01, Kept::At(FROM + beside)), true);
        assert_eq!(told, Step::Failed(SearchFailure::OnPulse), "{beside}");
    }
}

#[test]
fn a_place_is_ahead_of_where_the_joint_set_out_and_not_beyond_where_it_is() {
    for (place, is_on_way) in [
        (9.985, false),
        (10.015, true),
        (11.019, true),
        (11.021, false),
    ] {
        let told = under_way().step(&seen(500, 11.0, Kept::At(place)), true);
        let elsewhere = Step::Failed(SearchFailure::Elsewhere(place, FROM, 11.0));
        let expected = if is_on_way { Step::Stop } else { elsewhere };
        assert_eq!(told, expected, "{place}");
    }
}

#[test]
fn a_place_that_is_told_late_counts_at_the_end_of_the_way() {
    let end = FROM + ALONE.search_travel;
    for (late_ms, is_found) in [(0, true), (1900, true), (2300, false)] {
        let mut search = under_way();
        for ms in (3000..3000 + late_ms).step_by(100) {
            let told = search.step(&at_rest(ms, end, Kept::Armed), true);
            assert!(search.asks_index());
            if told != Step::Wait {
                assert_eq!(told, Step::Failed(SearchFailure::NoIndex(5.5)));
                assert!(ms > 5000 && !is_found, "{ms}");
                return;
            }
        }
        let told = search.step(&at_rest(3000 + late_ms, end, Kept::At(11.0)), true);
        assert_eq!(told == Step::Stop, is_found, "{late_ms}");
    }
    panic!("it waits for ever");
}

#[test]
fn a_joint_that_is_ready_is_held_back() {
    let mut search = begun(Kept::No);
    for ms in 1..3 {
        let ready = at_rest(4000 * ms, FROM, Kept::Armed);
        assert_eq!(search.step(&ready, false), Step::Wait);
    }
    let told = search.step(&at_rest(9000, FROM, Kept::Armed), true);
    assert!(matches!(told, Step::Go { .. }), "{told:?}");
}
