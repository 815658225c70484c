//! Tests of programs along the ends of travel: no axis goes beyond, at periods or between them.
//!
//! `GLIDEPATH_TRAVEL` is the number of random programs; a few without. `GLIDEPATH_TRAVEL_SEED` chooses
//! others.

#![allow(
    clippy::expect_used,
    clippy::panic,
    reason = "a test that fails may panic"
)]

use core::f64::consts::TAU;
use std::fmt::Write as _;
use std::io::Cursor;
use std::num::NonZeroUsize;

use crate::support::random::Random;
use glidepath_audit::{Audit, AuditReport, AuditSettings};
use glidepath_gcode::{AxisTravel, Machine, Options, Program};
use glidepath_geometry::{Axis, AxisVector};
use glidepath_motion::{PlanError, Planner};
use glidepath_planner::{ParallelPipeline, Pipeline, ProgramSource, Step};
use glidepath_program::{Effort, Frame, Limits, Override, Settings, Smoothing};

/// A place on an axis, more often than not at one of its ends.
fn place(random: &mut Random, (low, high): (f64, f64)) -> f64 {
    let inside = (random.between(low, high) * 1e3).round() / 1e3;
    random.of(&[low, high, inside, inside])
}

/// A machine of three axes: the ends of travel, and what its axes can do.
#[derive(Debug, Clone, Copy)]
struct Box3 {
    ends: [(f64, f64); 3],
    limits: [f64; 3],
}

const BOXES: [Box3; 3] = [
    Box3 {
        ends: [(0.0, 100.0), (0.0, 100.0), (-100.0, 0.0)],
        limits: [100.0, 500.0, 1e4],
    },
    Box3 {
        ends: [(0.0, 100.0), (-50.0, 50.0), (-60.0, 0.0)],
        limits: [200.0, 2000.0, 4e4],
    },
    Box3 {
        ends: [(-3.7, 33.33), (0.1, 40.3), (-20.0, 5.5)],
        limits: [300.0, 10_000.0, 1e6],
    },
];

impl Box3 {
    fn settings(&self, effort: Effort, period_t: f64, tolerance_mm: f64) -> Settings {
        let [v, a, j] = self.limits;
        let mut limits = Limits::uniform(v, a, j);
        for (i, (low, high)) in self.ends.into_iter().enumerate() {
            (limits.travel.lowest[i], limits.travel.highest[i]) = (low, high);
        }
        Settings {
            limits,
            tolerance_mm,
            direction: glidepath_program::DirectionTolerance::default(),
            smoothing: Smoothing::Auto,
            corners: glidepath_program::Corners::default(),
            period_t,
            effort,
        }
    }

    fn options(&self) -> Options {
        let axes = [Axis::X, Axis::Y, Axis::Z];
        let machine = axes
            .into_iter()
            .zip(self.ends)
            .fold(Machine::new(&axes), |machine, (axis, (min, max))| {
                machine.with_travel(axis, AxisTravel { min, max })
            });
        Options {
            machine,
            start: self.start(),
            default_feed_mm_min: Some(3000.0),
            ..Options::default()
        }
    }

    fn start(&self) -> AxisVector {
        let mut start = AxisVector::zeros();
        for (i, (low, high)) in self.ends.into_iter().enumerate() {
            start[i] = 0.0_f64.clamp(low, high);
        }
        start
    }

    /// A program of this machine.
    fn program(&self, random: &mut Random) -> String {
        let feed = random.of(&[600.0, 3000.0, 6000.0, 12_000.0]);
        let tolerance = random.of(&["G64", "G64", "G64 P0.005", "G64 P0.1", "G61"]);
        let mut text = format!(
            "G21 G90 G94 G17 {tolerance} F{feed}\nG53 G0 Z{}\n",
            self.ends[2].1
        );
        for _ in 0..4 {
            match random.of(&[0, 1, 2, 3, 4, 5]) {
                0 => self.retract(random, &mut text),
                1 => self.rectangle(random, &mut text),
                2 => self.circle(random, &mut text),
                3 => self.polyline(random, &mut text),
                4 => self.raster(random, &mut text),
                _ => self.rounded(random, &mut text),
            }
        }
        text + "M2\n"
    }

    fn retract(&self, random: &mut Random, text: &mut String) {
        let [x, y, (low, high)] = self.ends;
        let (x, y) = (place(random, x), place(random, y));
        let deep = random.between(low, high);
        let cut = place(random, (low, deep));
        let _ = write!(
            text,
            "G0 X{x} Y{y}\nG0 Z{deep:.3}\nG1 Z{cut:.3}\nG1 X{:.3}\nG53 G0 Z{high}\n",
            place(random, self.ends[0]),
        );
    }

    fn rectangle(&self, random: &mut Random, text: &mut String) {
        let [(x0, x1), (y0, y1), z] = self.ends;
        let inside = random.of(&[0.0, 0.0, 0.005, 3.0]);
        let (x0, x1, y0, y1) = (x0 + inside, x1 - inside, y0 + inside, y1 - inside);
        let depth = place(random, z);
        let _ = write!(
            text,
            "G0 X{x0} Y{y0}\nG1 Z{depth}\nG1 X{x1}\nG1 Y{y1}\nG1 X{x0}\nG1 Y{y0}\nG0 Z{}\n",
            z.1
        );
    }

    /// A circle that touches walls, as an arc or in chords.
    fn circle(&self, random: &mut Random, text: &mut String) {
        let [(x0, x1), (y0, y1), _] = self.ends;
        let most = 0.5 * (x1 - x0).min(y1 - y0);
        let r = random.of(&[most, 0.25 * most, 2.0, 5.0]);
        let (x, y) = random.of(&[
            (x0 + r, y0 + r),
            (x1 - r, y1 - r),
            (x1 - r, 0.5 * (y0 + y1)),
        ]);
        let _ = writeln!(text, "G0 X{:.6} Y{y:.6}", x - r);
        match random.of(&[0, 1, 2]) {
            0 => {
                let _ = writeln!(text, "G2 I{r:.6} J0");
            }
            1 => {
                let _ = write!(
                    text,
                    "G3 X{x:.6} Y{:.6} I{r:.6} J0\nG1 X{:.6}\nG1 Y{y:.6}\n",
                    y - r,
                    x + r
                );
            }
            _ => {
                let chord = random.of(&[0.05, 0.3, 1.0]);
                let chords = (TAU * r / chord).round().max(24.0);
                let mut k = 1.0;
                while k <= chords {
                    let (sin, cos) = (TAU * k / chords).sin_cos();
                    let _ = writeln!(text, "G1 X{:.4} Y{:.4}", x - r * cos, y + r * sin);
                    k += 1.0;
                }
            }
        }
    }

    fn polyline(&self, random: &mut Random, text: &mut String) {
        for _ in 0..12 {
            let code = random.of(&["G1", "G1", "G1", "G0"]);
            let [x, y, z] = self.ends.map(|ends| place(random, ends));
            let _ = match random.of(&[0, 1, 2, 3]) {
                0 => writeln!(text, "{code} X{x} Y{y} Z{z}"),
                1 => writeln!(text, "{code} X{x} Z{z}"),
                2 => writeln!(text, "{code} Z{z}"),
                _ => writeln!(text, "{code} X{x} Y{y}"),
            };
        }
    }

    /// There and back between two walls.
    fn raster(&self, random: &mut Random, text: &mut String) {
        let [(x0, x1), (y0, y1), _] = self.ends;
        let step = random.of(&[0.02, 0.2, 1.0]);
        let _ = writeln!(text, "G0 X{x0} Y{y0}");
        let mut y = y0;
        for k in 0..6 {
            let _ = writeln!(text, "G1 X{}", if k % 2 == 0 { x1 } else { x0 });
            y = (y + step).min(y1);
            let _ = writeln!(text, "G1 Y{y:.4}");
        }
    }

    /// A plate with round corners, its sides on the walls.
    fn rounded(&self, random: &mut Random, text: &mut String) {
        let [(x0, x1), (y0, y1), _] = self.ends;
        let r = random.of(&[0.1, 1.0, 8.0]);
        let _ = write!(
            text,
            "G0 X{:.4} Y{y0}\nG1 X{:.4}\nG3 X{x1} Y{:.4} I0 J{r}\nG1 Y{:.4}\nG3 X{:.4} Y{y1} I-{r} J0\n\
             G1 X{:.4}\nG3 X{x0} Y{:.4} I0 J-{r}\nG1 Y{:.4}\nG3 X{:.4} Y{y0} I{r} J0\n",
            x0 + r,
            x1 - r,
            y0 + r,
            y1 - r,
            x1 - r,
            x0 + r,
            y1 - r,
            y0 + r,
            x0 + r
        );
    }
}

/// Plans a program, with overrides changed under way, and has it judged.
fn planned(
    what: &str,
    text: &str,
    (of, settings): (&Box3, Settings),
    overrides: &[(usize, f64)],
    mut each: impl FnMut(&Frame),
) -> AuditReport {
    let most = overrides.iter().fold(1.0_f64, |most, (_, r)| most.max(*r));
    let mut audit = Audit::new(&AuditSettings::from(&settings)).with_override(most);
    let mut planner = Planner::new(settings, of.start());
    for item in Program::new(Cursor::new(text), of.options()) {
        let item = item.unwrap_or_else(|diagnostic| panic!("{what}: {}", diagnostic.message));
        planner.push(&item).expect("a valid item");
        audit.program(&item);
    }
    planner.finish();
    let mut frames = 0;
    while let Some(frame) = planner
        .pop_frame()
        .unwrap_or_else(|error: PlanError| panic!("{what}: {error}\n{text}"))
    {
        audit.frame(&frame);
        each(&frame);
        frames += 1;
        if let Some((_, feed_r)) = overrides.iter().find(|(at, _)| *at == frames) {
            let rapid_r = feed_r.min(1.0);
            let wanted = Override {
                feed_r: *feed_r,
                rapid_r,
            };
            planner.set_override(wanted).expect("an override");
        }
    }
    audit.finish()
}

fn number(name: &str, otherwise: u32) -> u32 {
    let text = std::env::var(name).ok();
    text.map_or(otherwise, |text| text.parse().expect("a number"))
}

#[test]
fn no_axis_leaves_its_travel() {
    let seed = number("GLIDEPATH_TRAVEL_SEED", 1);
    for k in 0..number("GLIDEPATH_TRAVEL", 3) {
        let mut random = Random(u64::from(seed) << 32 | u64::from(k));
        let of = BOXES[k as usize % BOXES.len()];
        let text = of.program(&mut random);
        let period_t = random.of(&[0.001, 0.004, 0.004, 0.008]);
        let tolerance_mm = random.of(&[0.005, 0.02, 0.02, 0.1]);
        let at = |random: &mut Random| (random.of(&[40, 211, 503, 1207]), random.of(&[0.3, 1.3]));
        let overrides = [at(&mut random), at(&mut random)];
        for effort in [Effort::Optimal, Effort::Fast] {
            for overrides in [&[][..], &overrides] {
                let settings = of.settings(effort, period_t, tolerance_mm);
                let what = format!(
                    "program {k} of seed {seed}, {effort:?}, {period_t} s, {tolerance_mm} mm, {overrides:?}"
                );
                let report = planned(&what, &text, (&of, settings), overrides, |_| {});
                assert!(
                    report.is_clean() && report.is_complete,
                    "{what}: {:#?}\n{text}",
                    report.violations
                );
            }
        }
    }
}

/// An axis that stands outside when a program begins stays there while others move, and comes inwards: one plan by
/// one thread or by several.
#[test]
fn an_axis_that_stands_outside_stays_or_comes_inwards() {
    let machine = BOXES[0];
    let start = AxisVector::from_fn(|i, _| [50.0, 50.0, 4.0].get(i).copied().unwrap_or(0.0));
    let text =
        "G21 G90 G64 P0.1\nG1 X60 F3000\nX60 Y70 Z3\nX20 Z1\nG0 X80 Z-10\nG1 Z0\nX10 Y10\nM2\n";
    for effort in [Effort::Fast, Effort::Optimal] {
        let settings = machine.settings(effort, 0.004, 0.1);
        let source = || {
            let options = Options {
                start,
                ..machine.options()
            };
            ProgramSource::new(text.as_bytes(), options)
        };
        let mut pipeline = Pipeline::new(source(), settings, start);
        let mut frames: Vec<Frame> = Vec::new();
        let mut audit = Audit::new(&AuditSettings::from(&settings).beginning_at(&start));
        loop {
            match pipeline.step().expect("a plan") {
                Step::Item => audit.program(pipeline.item()),
                Step::Frame => {
                    audit.frame(pipeline.frame());
                    frames.push(*pipeline.frame());
                }
                Step::Pending => {}
                Step::End => break,
            }
        }
        let report = audit.finish();
        assert!(report.is_clean(), "{effort:?}: {report:?}");
        let highest = frames.iter().map(|frame| frame.position[2]);
        assert!(highest.fold(f64::MIN, f64::max) <= 4.0 + 1e-9);
        let mut parallel = ParallelPipeline::start(
            source(),
            settings,
            start,
            None,
            NonZeroUsize::MIN.saturating_add(1),
        )
        .expect("threads");
        let mut planned = frames.iter();
        loop {
            match parallel.step().expect("the same plan") {
                Step::Frame => assert_eq!(planned.next(), Some(parallel.frame())),
                Step::End => break,
                Step::Item | Step::Pending => {}
            }
        }
        assert_eq!(planned.next(), None);
    }
}
