//! The text of the configuration that answers make, with what each choice means.

use super::answers::{Answers, AxisAnswer, DeltaAnswer, Home, Motors};
use std::fmt::Write as _;

/// The time in which an acceleration is reached, s: short enough to be quick, long enough not to shake a machine.
const TO_ACCELERATION_T: f64 = 0.05;
/// Parts of the fastest speed at which a switch is looked for, and left.
const SEARCH_R: f64 = 0.1;
const LATCH_R: f64 = 0.01;

/// The configuration.
pub(super) fn configuration(answers: &Answers) -> String {
    let mut text = format!(
        "# A {}, as it was described to `glidepath setup`. Every key: glidepath config --explain, and the manual's\n\
         # page of the configuration. Lengths are in mm, speeds in mm/s.\n",
        answers.kind.name()
    );
    if let Some(delta) = &answers.delta {
        text += &delta_tables(delta);
    }
    for axis in &answers.axes {
        text += &axis_table(axis);
    }
    text += &format!(
        "\n[path]\n# How far the motion may be from the program. Smaller is slower at corners.\ntolerance = {:?}\n",
        answers.tolerance_mm
    );
    text += &feedback(answers);
    if answers.home == Home::Switches {
        text += &homes(&answers.axes);
    }
    if answers.has_encoder {
        text += "\n[spindle]\n# Threads (G33, G76) follow its angle.\nencoder = true\n";
    }
    if answers.has_torch_height {
        text += TORCH;
    }
    text += "\n[state]\n# Work offsets, tools and parameters are kept here over a restart; beside this file.\n\
             directory = \"state\"\n";
    text
}

/// A speed in mm/s, of one in mm/min, in thousandths.
fn per_second(feed: f64) -> f64 {
    thousandths(feed / 60.0)
}

fn thousandths(number: f64) -> f64 {
    (1000.0 * number).round() / 1000.0
}

fn jerk(acceleration: f64) -> f64 {
    (acceleration / TO_ACCELERATION_T).round()
}

fn axis_table(axis: &AxisAnswer) -> String {
    let mut text = format!(
        "\n[axis.{}]\n# Soft limits in machine coordinates: nothing moves beyond them.\nmin_position = {:?}\n\
         max_position = {:?}\n\
         # {} mm/min.\nmax_velocity = {:?}\nmax_acceleration = {:?}\n\
         # The acceleration is reached within {} ms. More is quicker and shakes more: see the page on tuning.\n\
         max_jerk = {:?}\n",
        axis.letter,
        axis.min,
        axis.max,
        axis.feed,
        per_second(axis.feed),
        axis.acceleration,
        TO_ACCELERATION_T * 1e3,
        jerk(axis.acceleration),
    );
    if axis.is_gantry {
        text += "# Two motors move it: by so much they may differ, mm.\ngantry_difference = 0.5\n";
    }
    text
}

fn delta_tables(delta: &DeltaAnswer) -> String {
    let DeltaAnswer {
        rod_mm,
        radius_mm,
        reach_mm,
        height_mm,
        feed,
        acceleration,
    } = *delta;
    let mut text = format!(
        "\n[machine]\nkinematics = \"linear-delta\"\n\n[machine.linear-delta]\nrod = {rod_mm:?}\nradius = {radius_mm:?}\n"
    );
    // What is reached is round, the travel of axes is a box in it.
    let side = (reach_mm / std::f64::consts::SQRT_2 * 100.0).floor() / 100.0;
    for (letter, min, max) in [
        ('X', -side, side),
        ('Y', -side, side),
        ('Z', 0.0, height_mm),
    ] {
        let _ = write!(
            text,
            "\n[axis.{letter}]\nmin_position = {min:?}\nmax_position = {max:?}\n"
        );
    }
    for joint in 0..3 {
        let _ = write!(
            text,
            "\n[joint.J{joint}]\n# The carriage of a tower.\nmax_velocity = {:?}\nmax_acceleration = {acceleration:?}\n\
             max_jerk = {:?}\n",
            per_second(feed),
            jerk(acceleration)
        );
    }
    text
}

fn feedback(answers: &Answers) -> String {
    let (source, homing) = match (answers.motors, answers.home) {
        (Motors::Simulated, _) => ("none", "none"),
        (_, Home::Nothing) => ("drives", "none"),
        (_, Home::Drives) => ("drives", "drive"),
        (_, Home::Switches) => ("drives", "controller"),
    };
    format!(
        "\n[feedback]\n# \"none\": the drives are taken to do what they are told, and to be always on. \"drives\": they report where\n\
         # they are, and the machine is off until `glidepath enable`.\nsource = \"{source}\"\n\
         # Who brings joints home before a program starts: \"none\", \"drive\", or \"controller\" (switches).\n\
         homing = \"{homing}\"\n"
    )
}

/// The switch of each joint is at the end where machine zero is.
fn homes(axes: &[AxisAnswer]) -> String {
    let second = axes.iter().enumerate().filter(|(_, axis)| axis.is_gantry);
    let joints = axes.iter().enumerate().chain(second).enumerate();
    joints.fold(String::new(), |mut text, (joint, (nth, axis))| {
        let sign = if axis.max > 0.0 { -1.0 } else { 1.0 };
        let fast_v = per_second(axis.feed);
        // Three periods of reaction, and the stop by the acceleration that comes by the jerk.
        let search_v = (SEARCH_R * fast_v).max(1.0);
        let stop_mm = search_v * (0.012 + search_v / axis.acceleration + TO_ACCELERATION_T);
        let _ = write!(
            text,
            "\n[home.J{joint}]\n# The switch of {} is looked for at this speed; the sign is the direction.\n\
             search_velocity = {:?}\n# Its edge is found slowly, on the way back.\nlatch_velocity = {:?}\n\
             search_travel = {:?}\n# How far the joint may go past the edge.\nclearance = {:?}\n\
             # Where machine zero is from the edge, and where the joint goes in the end.\noffset = {:?}\nposition = 0.0\n\
             # Z, with the tool, first; joints of the same negative number together.\nsequence = {}\n",
            axis.letter,
            sign * thousandths(search_v),
            -sign * thousandths((LATCH_R * fast_v).max(0.2)),
            (1.1 * (axis.max - axis.min)).ceil(),
            (2.0 * stop_mm).ceil(),
            sign * 2.0,
            sequence(nth, axis),
        );
        text
    })
}

/// When an axis goes home: Z at first, the others one after the other.
fn sequence(nth: usize, axis: &AxisAnswer) -> String {
    match (axis.letter, axis.is_gantry) {
        ('Z', _) => "0".to_owned(),
        (_, false) => format!("{}", nth + 1),
        (_, true) => format!("-{}", nth + 1),
    }
}

const TORCH: &str = "
[superposition]
# The arc's voltage moves Z in addition to the program: torch height. M64 P3 switches it on, M65 P3 off.
axis = \"Z\"
input = 0
# The voltage at the right height, and mm/s for each volt above it.
target = 120.0
gain = -0.75
lowest = -10.0
highest = 0.0
switched_by = 3
";

#[cfg(test)]
mod tests {
    use super::super::kind::{KINDS, Kind};
    use super::super::questions::Questions;
    use super::*;
    use crate::config;

    /// Every kind with every way to move it and to come home.
    #[test]
    fn whatever_is_answered_is_a_configuration() {
        for (name, kind) in KINDS {
            for motors in [Motors::Simulated, Motors::Ethercat, Motors::Hal] {
                for home in [Home::Nothing, Home::Drives, Home::Switches] {
                    let simulated = motors == Motors::Simulated;
                    if (simulated || kind == Kind::Delta) && home != Home::Nothing {
                        continue;
                    }
                    let usual = Answers::ask(&Questions::new(true)).unwrap();
                    let axes = kind.axes().iter().map(|usual| AxisAnswer {
                        letter: usual.letter,
                        min: if usual.zero_is_high {
                            -usual.travel_mm
                        } else {
                            0.0
                        },
                        max: if usual.zero_is_high {
                            0.0
                        } else {
                            usual.travel_mm
                        },
                        feed: usual.feed,
                        acceleration: usual.acceleration,
                        is_gantry: kind == Kind::Plasma
                            && usual.letter == 'X'
                            && home == Home::Switches,
                    });
                    let answers = Answers {
                        kind,
                        motors,
                        home,
                        axes: axes.collect(),
                        delta: (kind == Kind::Delta).then_some(DeltaAnswer {
                            rod_mm: 269.0,
                            radius_mm: 130.25,
                            reach_mm: 80.0,
                            height_mm: 150.0,
                            feed: 18_000.0,
                            acceleration: 3000.0,
                        }),
                        has_encoder: kind == Kind::Lathe,
                        has_torch_height: kind == Kind::Plasma && !simulated,
                        ..usual
                    };
                    let text = configuration(&answers);
                    if let Err(error) = config::parse("machine.toml", &text) {
                        panic!(
                            "{name} {motors:?} {home:?}: {:#?}\n{text}",
                            error.diagnostics()
                        );
                    }
                }
            }
        }
    }
}
