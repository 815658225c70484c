//! Tests of forecasts: where they begin, and where a machine is in them.
#![allow(clippy::float_cmp, reason = "places are those that were given")]

use super::*;
use crate::config;
use crate::report::{AwaitedEvent, View, view_object};
use bytemuck::Zeroable as _;

/// Remembers the frames.
#[derive(Default)]
struct Frames(Vec<Frame>);

impl Spectator for Frames {
    fn frame(&mut self, frame: &Frame) {
        self.0.push(*frame);
    }
}

const TEXT: &str = "G21 G90\nG1 X10 F600\nX20\nX30\nX40\nM2\n";

/// What is planned of a program on a machine that stands at a place.
fn planned(stands: Option<AxisVector>) -> (Plan, Vec<Frame>) {
    planned_of(TEXT, stands)
}

fn planned_of(text: &str, stands: Option<AxisVector>) -> (Plan, Vec<Frame>) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("part.ngc");
    std::fs::write(&path, text).unwrap();
    let mut config = config::parse("built-in machine", config::EMBEDDED).unwrap();
    config.program.stands = stands;
    let plan = Mutex::new(Plan {
        begins: Some(Vec::new()),
        ..Plan::default()
    });
    let mut frames = Frames::default();
    let trouble = work(
        &path,
        (&config, Change::NONE),
        (&plan, &AtomicBool::new(false)),
        &mut frames,
    );
    assert_eq!(trouble, None);
    (plan.into_inner().unwrap(), frames.0)
}

/// As `check` and `plan` beside the planner's service.
#[test]
fn a_forecast_begins_where_the_machine_stands() {
    let mut stands = AxisVector::zeros();
    (stands[0], stands[1]) = (-50.0, 7.0);
    let (_, frames) = planned(Some(stands));
    assert_eq!(frames[0].position, stands);
    let (_, frames) = planned(None);
    assert_eq!(frames[0].position, AxisVector::zeros());
}

#[test]
fn on_the_way_to_a_line_it_is_where_that_line_begins() {
    let (plan, frames) = planned(None);
    let at = |block: u32, line: u32, part: f64| {
        let mut status = Status::zeroed();
        (status.block, status.line) = (block, line);
        status.path_s = 10.0 * part;
        plan.at(&status).unwrap()
    };
    let begins = |line: u32| frames.iter().find(|frame| frame.line == line).unwrap();
    let block = begins(4).block;
    let of_line = begins(4).sequence;
    for behind in 1..=2 {
        let on_its_way = at(block - behind, 4, 0.5);
        assert_eq!(
            on_its_way,
            At {
                sequence: of_line,
                is_on_its_way: true
            },
            "{behind}"
        );
    }
    let shifted = at(block + 1, 4, 0.0);
    assert_eq!((shifted.sequence, shifted.is_on_its_way), (of_line, false));
    let there = at(block, 4, 0.5);
    assert!(
        !there.is_on_its_way && there.sequence > of_line,
        "{there:?}"
    );
    let before = at(block - 1, 3, 0.5);
    assert!(
        !before.is_on_its_way && before.sequence < of_line,
        "{before:?}"
    );
}

/// Seconds that each of three moves may take more than its closed form, for the grid of 4 ms and the rests between.
const GRID_S: f64 = 0.012;

#[test]
fn the_time_left_counts_rapids_and_dwells_by_what_they_obey() {
    let (plan, frames) = planned_of("G21 G90 G61.1 F6000\nG0 X80\nG1 X20\nG4 P0.5\nM2\n", None);
    // From rest to rest within v, 2000 mm/s² and 40000 mm/s³ a way of L takes L / v + v / a + a / j: 80 mm at 200 mm/s
    // 0.55 s, 60 mm at 100 mm/s 0.7 s.
    let (rapid_t, feed_t, dwell_t) = (0.55, 0.7, 0.5);
    let left_t = |line: u32, part: f64, overrides: [f64; 2]| {
        let mut status = Status::zeroed();
        let begin = frames.iter().find(|frame| frame.line == line).unwrap();
        (status.line, status.block) = (line, begin.block);
        status.path_s = if line == 3 { 60.0 * part } else { 80.0 * part };
        (status.feed_override, status.rapid_override) = (overrides[0], overrides[1]);
        status.adaptive_feed = 1.0;
        let at = plan.at(&status).unwrap();
        let ahead = plan.stretches.ahead(at.sequence, plan.frames, 0.004);
        let place = ProgramPlace {
            ahead: Some(ahead),
            ..ProgramPlace::default()
        };
        let view = View {
            instance: "mill",
            status: &status,
            auxiliary: None,
            asked: AwaitedEvent::default(),
            axes: &[],
            not_homed: &[],
            place: Some(place),
            offsets: None,
            events: Vec::new(),
        };
        view_object(&view)["left_s"].as_f64()
    };
    let is_about = |left: Option<f64>, wanted: f64, most: f64| {
        let more = left.unwrap() - wanted;
        assert!((0.0..=most).contains(&more), "{left:?}, wanted {wanted}");
    };
    let whole = left_t(2, 0.0, [1.0, 1.0]);
    is_about(whole, rapid_t + feed_t + dwell_t, 3.0 * GRID_S);
    // 0.55 / 0.25 + 0.7 / 0.5 + 0.5 = 4.1 s.
    is_about(left_t(2, 0.0, [0.5, 0.25]), 4.1, 7.0 * GRID_S);
    // Behind the rapid its override does not count: half of the way at the feed, and the dwell.
    for rapid_override in [1.0, 0.25, 0.0] {
        let left = left_t(3, 0.5, [0.5, rapid_override]);
        is_about(left, 0.5 * feed_t / 0.5 + dwell_t, 2.0 * GRID_S);
    }
    assert_eq!(left_t(2, 0.0, [1.0, 0.0]), None, "it stands at the rapid");
}
