//! The picture of a motion: well-formed, complete, and bounded in size.

use glidepath::report::{AxisFigures, DiagnosisReport, ShapeFigures, SmoothnessFigures};
use glidepath::{plot::Plot, sample::TickSample};
use glidepath_audit::diagnosis::Deviation;
use glidepath_audit::shape::ShapeReport;
use glidepath_geometry::{Axis, AxisVector, Segment};
use glidepath_program::{Item, ItemKind, Limits, PathMode, Rate};
use std::collections::BTreeMap;

const PERIOD_T: f64 = 0.004;

/// A motion that is nowhere straight.
fn wander(tick: u32) -> TickSample {
    // Away from rest without a jump of acceleration.
    let t = f64::from(tick) * PERIOD_T;
    let t = t.powi(4) / (1.0 + t.powi(3));
    let mut position = AxisVector::zeros();
    position[0] = 80.0 * (0.9 * t).sin() + 8.0 * (7.1 * t).cos();
    position[1] = 50.0 * (0.7 * t).cos() + 8.0 * (6.3 * t).sin();
    position[2] = 5.0 * (1.3 * t).sin();
    TickSample {
        tick: u64::from(tick),
        time_t: t,
        line: 1,
        state: "running",
        rapid: (tick / 500) % 4 == 3,
        binding: None,
        deviation: None,
        programmed_v: 0.0,
        feed_v: 60.0 + 50.0 * (2.1 * t).sin(),
        path_s: 0.0,
        position,
        velocity: AxisVector::zeros(),
        acceleration: AxisVector::zeros(),
        joints: glidepath_kinematics::JointVector::zeros(),
    }
}

fn plot(axes: &[Axis], samples: impl Iterator<Item = TickSample>) -> String {
    let mut plot = Plot::new(axes, Limits::uniform(200.0, 2000.0, 40000.0), PERIOD_T);
    samples.for_each(|sample| plot.push(&sample));
    plot.render("part <1> & \"two\".ngc", "cycle time 8.000 s")
}

/// Follows every tag; true if each is closed in order.
fn is_well_formed(svg: &str) -> bool {
    let mut open: Vec<&str> = Vec::new();
    let mut rest = svg;
    while let Some(start) = rest.find('<') {
        if rest[..start].contains('>') {
            return false;
        }
        let Some(end) = rest.find('>') else {
            return false;
        };
        let tag = &rest[start + 1..end];
        rest = &rest[end + 1..];
        if tag.contains('<') || !tag.matches('"').count().is_multiple_of(2) {
            return false;
        }
        if let Some(name) = tag.strip_prefix('/') {
            if open.pop() != Some(name) {
                return false;
            }
        } else if !tag.ends_with('/') {
            open.push(tag.split(' ').next().unwrap_or_default());
        }
    }
    open.is_empty()
}

#[test]
fn a_plot_shows_path_and_every_quantity_with_its_limits() {
    let svg = plot(&[Axis::X, Axis::Y, Axis::Z], (0..4000).map(wander));
    assert!(is_well_formed(&svg));
    for words in [
        "part &lt;1&gt; &amp; &quot;two&quot;.ngc",
        "cycle time 8.000 s",
        "isometric",
    ] {
        assert!(svg.contains(words), "{words}");
    }
    for axis in ["X", "Y", "Z"] {
        for quantity in ["velocity", "acceleration", "jerk"] {
            assert!(
                svg.contains(&format!(">{axis} {quantity}<")),
                "{axis} {quantity}"
            );
        }
    }
    assert!(svg.contains("40\u{202f}000"), "the jerk limit is labelled");
    assert!(!svg.contains("NaN") && !svg.contains("inf"));
}

#[test]
fn an_axis_that_rests_takes_no_room() {
    let svg = plot(&[Axis::X, Axis::A], (0..400).map(wander));
    assert!(svg.contains(">X jerk<") && !svg.contains(">A jerk<"));
}

#[test]
fn a_program_in_the_xz_plane_is_seen_from_the_front() {
    let lathe = |tick| {
        let mut sample = wander(tick);
        sample.position[1] = 0.0;
        sample
    };
    let svg = plot(&Axis::ALL[..3], (0..400).map(lathe));
    assert!(svg.contains(">front: ") && !svg.contains(">top: "));
    // A machine without Y is a lathe, whose work turns about Z.
    let svg = plot(&[Axis::X, Axis::Z], (0..400).map(lathe));
    assert!(svg.contains(">from above: Z → X"));
}

#[test]
fn a_flat_program_has_no_side_views() {
    let flat = |tick| {
        let mut sample = wander(tick);
        sample.position[2] = 0.0;
        sample
    };
    let svg = plot(&[Axis::X, Axis::Y], (0..400).map(flat));
    assert!(!svg.contains("isometric") && !svg.contains("front"));
}

#[test]
fn a_long_motion_stays_below_two_megabytes() {
    let svg = plot(&[Axis::X, Axis::Y, Axis::Z], (0..200_000).map(wander));
    assert!(is_well_formed(&svg));
    assert!(svg.len() < 2_000_000, "{} bytes", svg.len());
}

#[test]
fn nothing_and_a_single_sample_can_be_drawn() {
    for count in 0..3 {
        let svg = plot(&[Axis::X], (0..count).map(|_| wander(0)));
        assert!(is_well_formed(&svg));
        assert!(
            !svg.contains("NaN") && !svg.contains("inf"),
            "{count} samples"
        );
    }
}

#[test]
fn a_gap_in_the_ticks_makes_no_peak() {
    let samples = (0..1000).filter(|tick| *tick != 500).map(wander);
    let whole = (0..1000).map(wander);
    let peak = |svg: &str| {
        let from = svg.find(">X jerk<").unwrap();
        let from = from + svg[from..].find("peak ").unwrap();
        svg[from..from + 30].to_owned()
    };
    let axes = [Axis::X];
    let (gap, whole) = (plot(&axes, samples), plot(&axes, whole));
    assert_eq!(peak(&gap), peak(&whole));
}

/// A line along X in `count` samples, a little beside it, with its program and its figures.
fn line(count: u32) -> String {
    let mut plot = Plot::new(
        &[Axis::X, Axis::Y],
        Limits::uniform(200.0, 2000.0, 40000.0),
        PERIOD_T,
    );
    let mut end = AxisVector::zeros();
    end[0] = 40.0;
    let segment = Segment::line(AxisVector::zeros(), end);
    let kind = ItemKind::Move {
        segment,
        rate: Rate::Feed(50.0),
        mode: PathMode::Continuous { tolerance_mm: None },
    };
    plot.program(&Item {
        line: 1,
        block: 1,
        kind,
    });
    for tick in 0..=count {
        let share = f64::from(tick) / f64::from(count);
        let mut sample = wander(tick);
        sample.rapid = false;
        sample.position = end * share;
        sample.deviation = Some(Deviation {
            distance_mm: 0.013 * share,
            tolerance_mm: 0.02,
        });
        plot.push(&sample);
    }
    let axis = |rms_jerk: f64, reversals: u64| AxisFigures {
        unit: "mm",
        rms_jerk,
        peak_jerk: 3.0 * rms_jerk,
        acceleration_above_30_hz: 12.5,
        reversals,
    };
    let figures = SmoothnessFigures {
        periods: 1234,
        mean_deviation_mm: 0.0081,
        rms_deviation_mm: 0.0092,
        axes: [("X", axis(4321.0, 7)), ("Y", axis(0.0, 0))]
            .map(|(name, axis)| (name.to_owned(), axis))
            .into(),
    };
    let nowhere = SmoothnessFigures {
        periods: 0,
        ..figures.clone()
    };
    let mut below = ShapeReport::default();
    below.below[0].distance_mm = 0.0188;
    below.below[0].line = 7;
    plot.told(&DiagnosisReport {
        binding: BTreeMap::new(),
        slowest: Vec::new(),
        smoothness: BTreeMap::from([("whole", figures), ("at_feed", nowhere)]),
        shape: ShapeFigures::new(&below, &[Axis::X, Axis::Y]),
    });
    plot.render("line", "")
}

#[test]
fn the_programmed_path_lies_under_the_motion() {
    let svg = line(300);
    assert!(is_well_formed(&svg));
    let programmed = svg.find("stroke-width=\"5\"").unwrap();
    let motion = svg.find("stroke-width=\"2\"").unwrap();
    assert!(programmed < motion, "what is drawn first is below");
    assert!(svg.contains(">programmed path<"));
    // From one margin of the view to the other: the line is all there is.
    let path = svg[..programmed].rfind("<path d=\"M80 ").unwrap();
    assert!(
        svg[path..programmed].contains("l1162 0"),
        "{}",
        &svg[path..programmed]
    );
    // Without a program there is none.
    let svg = plot(&[Axis::X], (0..400).map(wander));
    assert!(!svg.contains("programmed path") && !svg.contains("stroke-width=\"5\""));
}

/// A square far from machine zero, with a rapid there, at a tolerance that is tightened on the way.
#[test]
fn the_views_fit_the_part_in_its_own_coordinates() {
    let axes = [Axis::X, Axis::Y];
    let mut plot = Plot::new(&axes, Limits::uniform(200.0, 2000.0, 40000.0), PERIOD_T);
    let mut tick = 0;
    let mut go = |x: f64, y: f64, rapid, tolerance_mm: f64| {
        let mut sample = wander(tick);
        sample.position = AxisVector::zeros();
        (sample.position[0], sample.position[1], sample.rapid) = (x, y, rapid);
        sample.deviation = Some(Deviation {
            distance_mm: 0.8 * tolerance_mm,
            tolerance_mm,
        });
        tick += 1;
        plot.push(&sample);
    };
    go(0.0, 0.0, true, 0.02);
    go(300.0, -250.0, true, 0.02);
    for (x, y) in [(20.0, 0.0), (20.0, 15.0), (0.0, 15.0), (0.0, 0.0)] {
        go(300.0 + x, -250.0 + y, false, 0.005);
    }
    plot.work_zero([300.0, -250.0, -120.0]);
    let svg = plot.render("far", "");
    assert!(is_well_formed(&svg));
    for words in [
        ">work coordinates<",
        "begins outside, at X −300 Y 250 Z 120",
        ">80 % of the tolerance<",
    ] {
        assert!(svg.contains(words), "{words}: {svg}");
    }
    // Labels of the grid are those of the part: from 0 to 20, and nothing near 300.
    assert!(
        svg.contains(">20</text>") && !svg.contains(">300</text>"),
        "{svg}"
    );
}

#[test]
fn the_deviation_is_drawn_in_its_tolerance() {
    let svg = line(300);
    for words in [
        ">deviation<",
        ">peak 13 µm<",
        ">65 % of the tolerance<",
        ">20<",
    ] {
        assert!(svg.contains(words), "{words}");
    }
    assert_eq!(svg.matches("fill=\"#e3f4e8\"").count(), 1, "the band");
    let svg = plot(&[Axis::X], (0..400).map(wander));
    assert!(!svg.contains(">deviation<") && !svg.contains("#e3f4e8"));
}

#[test]
fn the_figures_of_smoothness_stand_below() {
    let svg = line(300);
    for words in [
        ">Smoothness of the whole motion<",
        "234 setpoints, off the programmed path by 8.1 µm in the mean, 9.2 µm rms",
        ">4\u{202f}321 mm/s³<",
        ">12\u{202f}963 mm/s³<",
        ">12.5 mm/s²<",
        ">7<",
        ">Smoothness where the programmed feed binds<",
        ">it binds nowhere<",
        ">Shape beside that of the program<",
        ">X 0.0188 mm below (line 7)<",
    ] {
        assert!(svg.contains(words), "{words}");
    }
    let axes = svg.matches(">Y<").count();
    assert_eq!(axes, 0, "an axis that rests has no figures");
    let bottom = |from: &str| {
        let after = &svg[svg.find(from).unwrap()..];
        after.split('"').nth(1).unwrap().parse::<f64>().unwrap()
    };
    let height = bottom("height=");
    let lowest = svg.match_indices(" y=\"").map(|(at, found)| {
        let number = &svg[at + found.len()..];
        number.split('"').next().unwrap().parse::<f64>().unwrap()
    });
    assert!(lowest.fold(0.0, f64::max) < height, "inside the page");
}
