//! Receiving ends that record, and that play back.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use bytemuck::Zeroable;
use glidepath_link::{
    Delivery, InProcess, Recorder, Recording, RecordingError, Replay, Setpoint, SetpointFrame,
    Subscriber, Transport,
};

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

#[test]
fn what_was_recorded_comes_back_bit_for_bit() {
    let mut spoilt = frame(2);
    spoilt.position[4] = f64::NAN;
    let mut recorder = Recorder::new(Vec::new()).unwrap();
    for frame in [&frame(0), &frame(1), &spoilt] {
        recorder.write(frame).unwrap();
    }
    let file = recorder.finish().unwrap();
    assert_eq!(file.len(), 64 + 3 * size_of::<SetpointFrame>());
    let mut replay = Replay::<SetpointFrame, _>::new(file.as_slice()).unwrap();
    let back = drain(&mut replay);
    let expected = [frame(0), frame(1), spoilt];
    assert_eq!(
        bytemuck::cast_slice::<_, u8>(&back),
        bytemuck::cast_slice::<_, u8>(&expected)
    );
    assert!(replay.next_record().unwrap().is_none());
}

#[test]
fn a_recording_end_passes_everything_on() {
    let mut recording = Recording::new(source(10), Recorder::new(Vec::new()).unwrap());
    let passed = drain(&mut recording);
    assert_eq!(passed, (0..10).map(frame).collect::<Vec<_>>());
    let file = recording.finish().unwrap();
    let mut replay = Replay::new(file.as_slice()).unwrap();
    assert_eq!(drain(&mut replay), passed);
}

#[test]
fn a_header_is_the_one_of_version_1() {
    let file = Recorder::<Setpoint, _>::new(Vec::new())
        .unwrap()
        .finish()
        .unwrap();
    let mut expected = b"GLIDEREC".to_vec();
    expected.extend([1, 0, 0, 0, 0x90, 0x02, 0, 0]);
    expected.extend(b"glidepath.Setpoint.v3");
    expected.resize(64, 0);
    assert_eq!(file, expected);
}

#[test]
fn other_files_are_refused() {
    let good = Recorder::<Setpoint, _>::new(Vec::new())
        .unwrap()
        .finish()
        .unwrap();
    let open = |bytes: &[u8]| Replay::<Setpoint, _>::new(bytes).err();
    assert!(open(&good).is_none());
    assert!(matches!(open(&[]), Some(RecordingError::NotARecording)));
    assert!(matches!(
        open(&good[..63]),
        Some(RecordingError::NotARecording)
    ));
    assert!(matches!(
        open(&[b'x'; 100]),
        Some(RecordingError::NotARecording)
    ));
    let mut later = good.clone();
    later[8] = 2;
    assert!(matches!(
        open(&later),
        Some(RecordingError::Version { found: 2 })
    ));
    let frames = Recorder::<SetpointFrame, _>::new(Vec::new())
        .unwrap()
        .finish()
        .unwrap();
    let error = open(&frames).unwrap();
    let text = "the recording is of glidepath.SetpointFrame.v2, not of glidepath.Setpoint.v3";
    assert_eq!(error.to_string(), text);
}

#[test]
fn a_recording_cut_short_is_good_up_to_its_last_whole_record() {
    let mut recorder = Recorder::new(Vec::new()).unwrap();
    for sequence in 0..3 {
        recorder.write(&frame(sequence)).unwrap();
    }
    let mut file = recorder.finish().unwrap();
    file.truncate(file.len() - 1);
    let mut replay = Replay::<SetpointFrame, _>::new(file.as_slice()).unwrap();
    assert_eq!(replay.next_record().unwrap(), Some(frame(0)));
    assert_eq!(replay.next_record().unwrap(), Some(frame(1)));
    assert!(matches!(
        replay.next_record(),
        Err(RecordingError::CutShort { whole: 2 })
    ));
}
