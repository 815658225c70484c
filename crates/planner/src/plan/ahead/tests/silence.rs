//! Tests of sources that fall silent: what has come is driven to rest, and what comes later goes on
//! from there.

use super::*;
use crate::source::pipe::PipeSource;
use std::io::Write as _;

/// Moves along X; silent where `is_silent` says so, and then until it is asked whether it is.
struct Halting {
    items: VecDeque<Option<Item>>,
    was_asked: bool,
    is_silent: bool,
}

fn line(number: u32, from: [f64; 2], to: [f64; 2]) -> Item {
    let at = |[x, y]: [f64; 2]| {
        let mut at = AxisVector::zeros();
        (at[0], at[1]) = (x, y);
        at
    };
    Item {
        block: 0,
        line: number,
        kind: ItemKind::Move {
            segment: Segment::line(at(from), at(to)),
            rate: Rate::Feed(50.0),
            mode: PathMode::Continuous { tolerance_mm: None },
        },
    }
}

/// Three lines, with silence behind the second.
fn halting(length: f64, is_silent: bool) -> Halting {
    let (a, b) = ([length, 0.0], [2.0 * length, 0.0]);
    Halting {
        items: [
            Some(line(1, [0.0; 2], a)),
            Some(line(2, a, b)),
            None,
            Some(line(3, b, [3.0 * length, 0.0])),
        ]
        .into(),
        was_asked: false,
        is_silent,
    }
}

impl ItemSource for Halting {
    fn next_item(&mut self) -> Supply {
        match self.items.front() {
            Some(Some(item)) => {
                let item = *item;
                self.items.pop_front();
                Supply::Item(item)
            }
            Some(None) if self.was_asked || !self.is_silent => {
                self.items.pop_front();
                self.next_item()
            }
            Some(None) => Supply::Pending,
            None => Supply::End,
        }
    }

    fn is_silent(&mut self) -> bool {
        self.was_asked = true;
        self.is_silent
    }

    fn lines_read(&self) -> u64 {
        0
    }
}

fn stream(effort: Effort, length: f64, is_silent: bool) -> Pipeline<Halting> {
    let source = halting(length, is_silent);
    let mut pipeline = Pipeline::new(source, mill(effort), AxisVector::zeros()).of_stream();
    pipeline.let_rest(true);
    pipeline
}

fn rests_at(frame: &Frame, [x, y]: [f64; 2]) -> bool {
    let away = (frame.position[0] - x)
        .abs()
        .max((frame.position[1] - y).abs());
    frame.velocity.amax() <= 0.0 && away < 1e-9
}

#[test]
fn what_has_come_is_driven_to_rest_when_the_source_is_silent_and_then_gone_on_from() {
    for effort in [Effort::Fast, Effort::Optimal] {
        for length in [3.0, 150.0] {
            let planned = pulled(stream(effort, length, true), &[], usize::MAX);
            assert_eq!(planned.refusal, None);
            let there = [2.0 * length, 0.0];
            let stop = planned.frames.iter().position(|f| rests_at(f, there));
            let stop = stop.expect("it rests where the source fell silent");
            assert_eq!(planned.frames[stop].line, 2);
            let last = planned.frames.last().unwrap();
            assert!(rests_at(last, [3.0 * length, 0.0]));
            assert_eq!((last.line, last.block), (3, 3), "{effort:?}");
            // Without silence it does not.
            let whole = pulled(stream(effort, length, false), &[], usize::MAX);
            assert!(!whole.frames.iter().any(|f| rests_at(f, there)));
            assert!(whole.frames.len() < planned.frames.len());
        }
    }
}

#[test]
fn overrides_find_the_rest_where_it_was() {
    for effort in [Effort::Fast, Effort::Optimal] {
        let length = 40.0;
        let usual = pulled(stream(effort, length, true), &[], usize::MAX);
        let stop = usual
            .frames
            .iter()
            .position(|f| rests_at(f, [80.0, 0.0]))
            .unwrap() as u64;
        let changes = [
            change(stop / 2, 0.5, 1.0),
            change(stop + 40, 2.0, 1.0),
            change(stop + 80, 1.0, 1.0),
        ];
        let expected = pulled(stream(effort, length, true), &changes, usize::MAX);
        let found = ahead(
            stream(effort, length, true),
            &changes,
            usize::MAX,
            2500,
            |_, number| {
                if number % 50 == 0 {
                    std::thread::sleep(Duration::from_millis(2));
                }
            },
        );
        assert!(expected == found, "{effort:?}");
        assert!(expected.frames.iter().any(|f| rests_at(f, [80.0, 0.0])));
    }
}

#[test]
fn two_lines_in_a_pipe_that_stays_open_are_driven_and_a_third_one_later() {
    for effort in [Effort::Fast, Effort::Optimal] {
        let (reader, mut writer) = std::io::pipe().unwrap();
        let source = PipeSource::spawn(
            reader,
            Options::default(),
            crate::source::run_channels::RunChannels::default(),
        )
        .unwrap();
        let mut pipeline = Pipeline::new(source, mill(effort), AxisVector::zeros()).of_stream();
        pipeline.let_rest(true);
        writer
            .write_all(b"G21 G90 G64 F3000\nG1 X10\nG1 X20\n")
            .unwrap();
        let began = std::time::Instant::now();
        let mut frames = Vec::new();
        let mut step = |frames: &mut Vec<Frame>| {
            let step = pipeline.step().unwrap();
            match step {
                Step::Frame => frames.push(*pipeline.frame()),
                Step::Pending => std::thread::sleep(Duration::from_millis(1)),
                Step::Item | Step::End => {}
            }
            step
        };
        while !frames.last().is_some_and(|f| rests_at(f, [20.0, 0.0])) {
            step(&mut frames);
            assert!(began.elapsed() < Duration::from_secs(20), "{effort:?}");
        }
        writer.write_all(b"G1 X25\n").unwrap();
        drop(writer);
        while step(&mut frames) != Step::End {}
        assert!(rests_at(frames.last().unwrap(), [25.0, 0.0]));
    }
}
