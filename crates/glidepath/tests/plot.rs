//! The picture of a motion: well-formed, complete, and bounded in size.

use glidepath::{plot::Plot, sample::Sample};
use glidepath_geometry::{Axis, AxisVector};
use glidepath_program::Limits;

const PERIOD_T: f64 = 0.004;

/// A motion that is nowhere straight.
fn wander(tick: u32) -> Sample {
    // Away from rest without a jump of acceleration.
    let t = f64::from(tick) * PERIOD_T;
    let t = t.powi(4) / (1.0 + t.powi(3));
    let mut position = AxisVector::zeros();
    position[0] = 80.0 * (0.9 * t).sin() + 8.0 * (7.1 * t).cos();
    position[1] = 50.0 * (0.7 * t).cos() + 8.0 * (6.3 * t).sin();
    position[2] = 5.0 * (1.3 * t).sin();
    Sample {
        tick: u64::from(tick),
        time_t: t,
        line: 1,
        state: "running",
        rapid: (tick / 500) % 4 == 3,
        binding: None,
        feed_v: 60.0 + 50.0 * (2.1 * t).sin(),
        path_s: 0.0,
        position,
        velocity: AxisVector::zeros(),
        acceleration: AxisVector::zeros(),
        joints: glidepath_kinematics::JointVector::zeros(),
    }
}

fn plot(axes: &[Axis], samples: impl Iterator<Item = Sample>) -> String {
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
    let svg = plot(&[Axis::X, Axis::Z], (0..400).map(lathe));
    assert!(svg.contains(">front: ") && !svg.contains(">top: "));
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
