//! Tests of forecasts: where they begin, and where a machine is in them.
#![allow(clippy::float_cmp, reason = "places are those that were given")]

use super::*;
use crate::config;
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
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("part.ngc");
    std::fs::write(&path, TEXT).unwrap();
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
