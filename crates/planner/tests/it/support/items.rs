//! Sources of items for tests.

use std::collections::VecDeque;

use glidepath_geometry::{AxisVector, Segment};
use glidepath_link::SetpointFrame;
use glidepath_planner::{ItemSource, Pipeline, Refusal, Supply};
use glidepath_program::{Frame, Item, ItemKind, Limits, PathMode, Rate, Settings};

pub(crate) const PERIOD_NS: u64 = 4_000_000;

pub(crate) fn settings() -> Settings {
    Settings {
        limits: Limits::uniform(200.0, 2000.0, 40_000.0),
        tolerance_mm: 0.02,
        direction: glidepath_program::DirectionTolerance::default(),
        smoothing: glidepath_program::Smoothing::Sextic,
        corners: glidepath_program::Corners::default(),
        period_t: 0.004,
        effort: glidepath_program::Effort::Fast,
    }
}

pub(crate) fn point(x: f64, y: f64) -> AxisVector {
    let mut point = AxisVector::zeros();
    (point[0], point[1]) = (x, y);
    point
}

/// Straight moves through the points, in lines 1, 2, …
pub(crate) fn polyline(points: &[AxisVector]) -> Vec<Item> {
    let moves = points.windows(2).enumerate();
    moves
        .map(|(i, ends)| Item {
            block: 0,
            line: u32::try_from(i + 1).unwrap(),
            kind: ItemKind::Move {
                segment: Segment::line(ends[0], ends[1]),
                rate: Rate::Feed(100.0),
                mode: PathMode::Continuous { tolerance_mm: None },
            },
        })
        .collect()
}

/// A staircase of `steps` steps of 5 mm from the origin.
pub(crate) fn staircase(steps: u32) -> Vec<Item> {
    let corner = |i: u32| {
        let (x, y) = (i.div_ceil(2), i / 2);
        point(5.0 * f64::from(x), 5.0 * f64::from(y))
    };
    polyline(&(0..=steps).map(corner).collect::<Vec<_>>())
}

/// Items from a list, with a pause of so many questions before each.
#[derive(Debug, Clone)]
pub(crate) struct Listed {
    items: VecDeque<Item>,
    delays: Vec<u32>,
    asked: u32,
    given: usize,
    /// Whether it ends with a refusal.
    pub(crate) fails: bool,
}

impl Listed {
    pub(crate) fn new(items: &[Item]) -> Self {
        Self::delayed(items, &[])
    }

    pub(crate) fn delayed(items: &[Item], delays: &[u32]) -> Self {
        let items = items.iter().copied().collect();
        Self {
            items,
            delays: delays.to_vec(),
            asked: 0,
            given: 0,
            fails: false,
        }
    }
}

impl ItemSource for Listed {
    fn next_item(&mut self) -> Supply {
        if self.asked < self.delays.get(self.given).copied().unwrap_or(0) {
            self.asked += 1;
            return Supply::Pending;
        }
        (self.asked, self.given) = (0, self.given + 1);
        match self.items.pop_front() {
            Some(item) => Supply::Item(item),
            None if self.fails => {
                Supply::Refused(Refusal::Read(std::io::Error::other("the pipe burst")))
            }
            None => Supply::End,
        }
    }

    fn lines_read(&self) -> u64 {
        self.given as u64
    }
}

/// All frames of a list of items, for a machine at rest at `start`.
pub(crate) fn frames_of(items: &[Item], start: AxisVector) -> Vec<Frame> {
    let mut pipeline = Pipeline::new(Listed::new(items), settings(), start);
    std::iter::from_fn(|| pipeline.next_frame().unwrap()).collect()
}

/// The records of all frames of a list of items, for a machine at rest at the origin.
pub(crate) fn records(items: &[Item], epoch: u64) -> Vec<SetpointFrame> {
    let mut pipeline = Pipeline::new(Listed::new(items), settings(), AxisVector::zeros());
    let next = || {
        let frame = pipeline.next_frame().unwrap()?;
        Some(SetpointFrame {
            block: pipeline.block(),
            ..SetpointFrame::from_frame(&frame, epoch, PERIOD_NS)
        })
    };
    std::iter::from_fn(next).collect()
}
