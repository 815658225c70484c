//! The codes and words that are in force, as a line of a program would say them.

use crate::execute::state::coolant::Coolant;
use crate::execute::state::modal::Modal;
use crate::execute::state::mode_codes::{g_word, motion_tenths, plane_tenths};
use crate::execute::state::offsets::system_code;
use crate::execute::state::program_state::State;
use crate::execute::state::spindle::SpindleDirection;
use crate::syntax::modes::{Distance, FeedMode, Motion, Units};

/// The motion, the coordinate system, plane, units, distance and feed mode, spindle, coolant, tool, feed and
/// speed: `G1 G54 G17 G21 G90 G94 M3 M8 T2 F600 S8000`.
pub(crate) fn words_in_force(state: &State) -> String {
    let modal = &state.modal;
    let system = system_code(state.offsets.active);
    let spindle = match state.spindle.turning {
        None => "M5",
        Some(SpindleDirection::Clockwise) => "M3",
        Some(SpindleDirection::Counterclockwise) => "M4",
    };
    let coolant = match state.coolant {
        Coolant {
            mist: false,
            flood: false,
        } => "M9",
        Coolant { flood: false, .. } => "M7",
        Coolant { mist: false, .. } => "M8",
        Coolant { .. } => "M7 M8",
    };
    let motion = modal.motion.map_or_else(|| g_word(800), motion_word);
    format!(
        "{motion} {system} {} {} {} {} {spindle} {coolant} T{} F{} S{}",
        g_word(plane_tenths(modal.plane)),
        match modal.units {
            Units::Inch => "G20",
            Units::Millimetre => "G21",
        },
        match modal.distance {
            Distance::Absolute => "G90",
            Distance::Incremental => "G91",
        },
        match modal.feed_mode {
            FeedMode::InverseTime => "G93",
            FeedMode::PerMinute => "G94",
            FeedMode::PerRevolution => "G95",
        },
        state.selected_tool,
        feed(modal),
        rounded(state.spindle.speed),
    )
}

/// The F word that would give the feed in force, 0 where there is none.
fn feed(modal: &Modal) -> f64 {
    let feed = modal.feed.map_or(0.0, |feed| feed.linear_v);
    let per_second = match modal.feed_mode {
        FeedMode::PerMinute => 60.0,
        FeedMode::PerRevolution | FeedMode::InverseTime => 1.0,
    };
    rounded(feed * per_second / modal.units.mm())
}

/// Without what the conversion of units leaves behind the sixth decimal.
fn rounded(value: f64) -> f64 {
    (value * 1e6).round() / 1e6
}

/// The code of a motion mode; one that other languages write without a code is `G80` here.
fn motion_word(motion: Motion) -> String {
    let tenths = match motion {
        Motion::Lathe(_)
        | Motion::ArcThrough
        | Motion::ArcTangent
        | Motion::TapIn
        | Motion::TapOut
        | Motion::Turning(_)
        | Motion::Groove(_)
        | Motion::CirclePocket(_)
        | Motion::HolePattern(_) => 800,
        motion => motion_tenths(motion),
    };
    g_word(tenths)
}

#[cfg(test)]
mod tests {
    use crate::{Options, Program};

    #[test]
    fn words_are_those_that_were_said() {
        for (said, words) in [
            ("", "G80 G54 G17 G21 G90 G94 M5 M9 T0 F0 S0"),
            (
                "G20\nG1 G55 G18 G91 X1 F10 S800 M3 M8 T2",
                "G1 G55 G18 G20 G91 G94 M3 M8 T2 F10 S800",
            ),
            (
                "G59.2 G0 X1 M4 S1.5",
                "G0 G59.2 G17 G21 G90 G94 M4 M9 T0 F0 S1.5",
            ),
        ] {
            let text = format!("{said}\n");
            let mut program = Program::new(text.as_bytes(), Options::default()).typed();
            for item in program.by_ref() {
                assert!(item.is_ok(), "{item:?}");
            }
            assert_eq!(program.words_in_force(), words);
            assert!(!program.has_ended() && program.is_settled());
        }
    }
}
