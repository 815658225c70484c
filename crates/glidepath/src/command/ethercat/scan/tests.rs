//! Tests of the scan over emulated devices: what it writes is a file of drives as soon as it is no comment.
#![allow(clippy::unwrap_used, reason = "tests")]

use super::look;
use crate::config;
use crate::drives::{DrivesConfig, Found, parse, written};
use glidepath_emulator::{ClockKind, DriveSettings as Emulated, Segment, TouchProbe};
use glidepath_ethercat::Wire;
use std::collections::VecDeque;
use std::io;

/// A wire in memory, whose frames take no time.
struct Line {
    segment: Segment,
    now_ns: u64,
    back: VecDeque<Vec<u8>>,
}

impl Line {
    fn of(devices: &[Emulated]) -> Self {
        Self {
            segment: Segment::new_at(devices, 1_000_000_000),
            now_ns: 2_000_000_000,
            back: VecDeque::new(),
        }
    }
}

impl Wire for Line {
    fn now_ns(&self) -> u64 {
        self.now_ns
    }

    fn sleep_until(&mut self, deadline_ns: u64) {
        self.now_ns = self.now_ns.max(deadline_ns);
        self.segment.advance(self.now_ns);
    }

    fn send(&mut self, frame: &[u8]) -> io::Result<()> {
        let mut frame = frame.to_vec();
        self.now_ns += 10_000;
        self.segment.pass(&mut frame, self.now_ns);
        self.back.push_back(frame);
        Ok(())
    }

    fn receive(&mut self, into: &mut [u8], until_ns: u64) -> io::Result<Option<usize>> {
        let Some(frame) = self.back.pop_front() else {
            self.sleep_until(until_ns);
            return Ok(None);
        };
        into[..frame.len()].copy_from_slice(&frame);
        Ok(Some(frame.len()))
    }
}

fn found(devices: &[Emulated]) -> Vec<Found> {
    look(&mut Line::of(devices)).unwrap()
}

fn drive(is_mappable: bool, has_sources: bool) -> Emulated {
    Emulated {
        touch_probe: Some(TouchProbe {
            is_mappable,
            has_sources,
            ..TouchProbe::default()
        }),
        ..Emulated::default()
    }
}

/// The file with what only the builder knows, and with every line that is a comment for the builder to take.
fn taken(text: &str) -> String {
    let is_key = |line: &str| {
        let word = line.split([' ', '=']).next().unwrap_or_default();
        let keys = [
            "probe",
            "index",
            "inputs",
            "encoder",
            "[[device]]",
            "position",
            "vendor",
            "product",
        ];
        keys.contains(&word) || line.starts_with("    {") || line.starts_with(']')
    };
    let lines = text.lines().map(|line| {
        let bare = line.strip_prefix("# ").filter(|bare| is_key(bare));
        let line = bare.unwrap_or(line);
        let known = line.replace("counts_per_mm = 0.0", "counts_per_mm = 1000.0");
        known.replace("counts_per_rev = 0", "counts_per_rev = 4096") + "\n"
    });
    lines.collect()
}

fn read(text: &str) -> DrivesConfig {
    let machine = config::EMBEDDED.replacen("# input = 0\n", "input = 0\n", 1);
    let machine = machine.replace("source = \"none\"", "source = \"drives\"");
    let machine = config::parse("machine.toml", &machine).unwrap();
    parse("drives.toml", text, &machine).unwrap_or_else(|error| panic!("{error:?}\n{text}"))
}

#[test]
fn touch_probes_and_the_encoder_of_a_spindle_are_found() {
    // One whose touch probe is asked by its mailbox, one that can choose its source, and one of two axes less one.
    let line = [
        drive(true, false),
        drive(false, true),
        drive(true, false),
        Emulated::terminal("COUPLER", ClockKind::ReceiveTimes),
        Emulated::inputs(4),
        Emulated::encoder(32),
        Emulated::encoder(16),
    ];
    let found = found(&line);
    assert_eq!(found[1].probes.len(), 1);
    assert!(found[1].probes[0].has_sources && found[1].probes[0].units == [true, true]);
    let text = written("eth9", &found);
    // As it stands it lacks what nobody but the builder knows, and nothing else.
    let mended = text.replace("counts_per_mm = 0.0", "counts_per_mm = 1000.0");
    assert!(
        read(&mended)
            .drives
            .iter()
            .all(|drive| drive.probe.is_none())
    );
    let drives = read(&taken(&text));
    for drive in &drives.drives {
        let probe = drive.probe.unwrap();
        assert_eq!((probe.number, probe.unit, probe.source), (0, 1, None));
        assert_eq!(drive.index, Some(1));
    }
    let of = |position| drives.terminals.iter().find(|t| t.position == position);
    assert_eq!(of(4).unwrap().inputs[0].number, Some(0));
    let encoder = of(5).unwrap().encoder.unwrap();
    assert!(encoder.has_index && encoder.counts_per_rev == 4096);
    // What leads its counter is no output of programs.
    assert!(of(5).unwrap().outputs.is_empty() && of(5).unwrap().inputs.is_empty());
    // A machine has one.
    assert_eq!(of(6).unwrap().encoder, None);
    assert_eq!(text.matches("encoder = {").count(), 2, "{text}");
    assert_eq!(text.matches("0x60D0").count(), 1, "{text}");
}

#[test]
fn the_probe_is_an_input_of_a_drive_where_no_terminal_has_one() {
    let text = written(
        "eth9",
        &found(&[drive(true, false), drive(true, false), drive(true, false)]),
    );
    let drives = read(&taken(&text));
    assert!(drives.drives.iter().all(|drive| drive.probe.is_some()));
    assert_eq!(drives.drive_inputs.len(), 1, "{text}");
    assert_eq!(drives.drive_inputs[0].1.number, Some(0));
}

#[test]
fn no_drive_is_given_a_touch_probe_where_one_lacks_it() {
    let text = written(
        "eth9",
        &found(&[drive(true, false), Emulated::default(), drive(true, false)]),
    );
    assert!(!text.contains("probe = {"), "{text}");
    assert_eq!(
        text.matches("that of J1 lacks the objects").count(),
        2,
        "{text}"
    );
    read(&taken(&text));
}

#[test]
fn every_axis_of_a_device_has_its_own_touch_probe() {
    let both = Emulated {
        axes: 2,
        start_counts: vec![0; 2],
        ..drive(true, false)
    };
    let found = found(&[both, drive(true, false), Emulated::inputs(2)]);
    assert_eq!(found[0].probes.len(), 2);
    let drives = read(&taken(&written("eth9", &found)));
    assert!(drives.drives.len() == 3 && drives.drives.iter().all(|drive| drive.probe.is_some()));
}

#[test]
fn the_bits_of_an_encoder_are_no_input_for_the_probe() {
    let text = written(
        "eth9",
        &found(&[
            drive(true, false),
            drive(true, false),
            drive(true, false),
            Emulated::encoder(32),
        ]),
    );
    let drives = read(&taken(&text));
    assert_eq!(drives.drive_inputs.len(), 1, "{text}");
}
