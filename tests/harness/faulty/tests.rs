//! Faults happen when they are meant to, and are the ones that are meant.

use super::{Fault, Faulty};
use bytemuck::Zeroable;
use glidepath_link::{
    Delivery, InProcess, Record, RecordError, SetpointFrame, Subscriber, Transport,
};
use proptest::prelude::*;

fn frame(sequence: u64) -> SetpointFrame {
    SetpointFrame {
        epoch: 1,
        sequence,
        period_ns: 4_000_000,
        planned_override: 1.0,
        path_s: 0.1,
        ..SetpointFrame::zeroed()
    }
}

/// A source with so many frames in it.
fn source(frames: u64) -> Box<dyn Subscriber<SetpointFrame>> {
    let link = InProcess::default();
    let source = link.frame_source().unwrap();
    let mut sink = link.frame_sink().unwrap();
    for sequence in 0..frames {
        assert_eq!(sink.offer(&frame(sequence)).unwrap(), Delivery::Delivered);
    }
    source
}

fn drain(source: &mut dyn Subscriber<SetpointFrame>) -> Vec<SetpointFrame> {
    core::iter::from_fn(|| source.take().unwrap()).collect()
}

fn sequences(frames: u64, script: &[(u64, Fault)]) -> Vec<u64> {
    let mut faulty = Faulty::scripted(source(frames), 1, script);
    drain(&mut faulty)
        .iter()
        .map(|frame| frame.sequence)
        .collect()
}

#[test]
fn faults_happen_where_the_script_says() {
    assert_eq!(sequences(5, &[]), [0, 1, 2, 3, 4]);
    assert_eq!(sequences(5, &[(2, Fault::Lose(1))]), [0, 1, 3, 4]);
    assert_eq!(sequences(6, &[(1, Fault::Lose(3))]), [0, 4, 5]);
    assert_eq!(sequences(4, &[(1, Fault::Repeat(2))]), [0, 1, 1, 1, 2, 3]);
    assert_eq!(sequences(4, &[(1, Fault::Swap)]), [0, 2, 1, 3]);
    assert_eq!(sequences(5, &[(3, Fault::Stop)]), [0, 1, 2]);
    assert_eq!(
        sequences(5, &[(1, Fault::Lose(1)), (3, Fault::Repeat(1))]),
        [0, 2, 3, 3, 4]
    );
}

#[test]
fn a_delayed_record_comes_later_and_in_order() {
    let mut faulty = Faulty::scripted(source(3), 1, &[(1, Fault::Delay(2))]);
    let mut take = || faulty.take().unwrap().map(|frame| frame.sequence);
    assert_eq!([take(), take(), take()], [Some(0), None, None]);
    assert_eq!([take(), take(), take()], [Some(1), Some(2), None]);
}

proptest! {
    #[test]
    fn a_corrupt_record_differs_in_one_bit(seed: u64) {
        let mut faulty = Faulty::scripted(source(1), seed, &[(0, Fault::Corrupt)]);
        let corrupt = faulty.take().unwrap().unwrap();
        let good = frame(0);
        let bits: u32 = bytemuck::bytes_of(&corrupt)
            .iter()
            .zip(bytemuck::bytes_of(&good))
            .map(|(corrupt, good)| (corrupt ^ good).count_ones())
            .sum();
        prop_assert_eq!(bits, 1);
    }

    #[test]
    fn a_spoilt_number_is_found_by_the_check(seed: u64) {
        let mut faulty = Faulty::scripted(source(1), seed, &[(0, Fault::NotFinite)]);
        let spoilt = faulty.take().unwrap().unwrap();
        let found = matches!(spoilt.check(), Err(RecordError::NotFinite { .. }));
        prop_assert!(found);
    }

    #[test]
    fn the_same_seed_makes_the_same_faults(seed: u64) {
        let faults = [Fault::Lose(2), Fault::Repeat(1), Fault::Swap, Fault::Corrupt];
        let run = |seed| {
            let received = drain(&mut Faulty::random(source(200), seed, 5, &faults));
            received.iter().flat_map(|frame| bytemuck::bytes_of(frame).to_vec()).collect::<Vec<_>>()
        };
        prop_assert_eq!(run(seed), run(seed));
        prop_assert_ne!(run(seed), run(seed.wrapping_add(1)));
    }
}
