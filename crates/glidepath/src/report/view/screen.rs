//! The view for people: one screen of 80 columns.

use super::seen::{View, clock};
use crate::machine_options::complete;
use crate::report::auxiliary::auxiliary_words;
use crate::report::machine::{awaited_text, power_text};
use crate::report::quantity::{counted, decimals, grouped};
use crate::report::status::{adaptive_text, manner_text, remedy, superposition_text};
use core::fmt::Write as _;
use glidepath_geometry::AXES;
use glidepath_link::{MachineState, MotionMode, Status};

/// Columns.
const WIDTH: usize = 80;
/// Columns before the words of a line.
const INDENT: usize = 12;
/// Columns of the bar of progress.
const BAR: usize = 24;

/// The screen.
#[must_use]
pub fn view_text(view: &View<'_>) -> String {
    let status = view.status;
    let state = status.state().ok();
    let mut lines = Vec::new();
    let name = state.map_or("unknown", MachineState::name).to_uppercase();
    let words = complete(status.state_text().unwrap_or_default());
    lines.push(format!("{}   {name}   {words}", view.instance));
    if let Some(fault) = status.fault_text() {
        lines.push(format!("  FAULT     {fault}"));
        let remedy = complete(remedy(status).unwrap_or_default());
        lines.push(format!("  clears it {remedy}"));
    }
    lines.push(String::new());
    program_lines(view, &mut lines);
    position_lines(view, &mut lines);
    lines.push(format!(
        "  feed      {:.0} mm/min on the path",
        status.feed_v * 60.0
    ));
    lines.push(format!(
        "  override  feed {:.0} %, rapid {:.0} %, jog {:.0} %, spindle {:.0} %; executed {:.0} %{}",
        status.feed_override * 100.0,
        status.rapid_override * 100.0,
        status.jog_override * 100.0,
        status.spindle_override * 100.0,
        status.effective_override * 100.0,
        manner_text(status)
    ));
    if let Some(adaptive) = adaptive_text(status) {
        lines.push(format!("  input     {adaptive}"));
    }
    if let Some(superposed) = superposition_text(status) {
        lines.extend(wrapped(&format!("  superposed {superposed}")));
    }
    let told = view.auxiliary.map(auxiliary_words);
    let told = told.unwrap_or_else(|| "nothing is known of it yet".to_owned());
    lines.push(format!("  tool      {told}"));
    let message = status.message.as_str();
    if !message.is_empty() {
        lines.push(format!("  says      {message}"));
    }
    if let Some(awaited) = awaited_text(status, &view.asked) {
        lines.push(format!("  waits for {awaited}"));
    }
    lines.push(format!("  drives    {}", power_text(status)));
    health_lines(status, &mut lines);
    lines.push(String::new());
    for (ago, text) in &view.events {
        lines.push(format!("  {:>8} ago  {text}", clock(ago.as_secs_f64())));
    }
    lines.iter().fold(String::new(), |mut text, line| {
        // Writing to a String does not fail.
        for line in wrapped(line.trim_end()) {
            let _ = writeln!(text, "{line}");
        }
        text
    })
}

fn program_lines(view: &View<'_>, lines: &mut Vec<String>) {
    let status = view.status;
    let Some(place) = &view.place else {
        let known = if status.program == 0 {
            "none yet".to_owned()
        } else {
            format!("line {}, {:.3} mm of path", status.line, status.path_s)
        };
        lines.push(format!("  program   {known}"));
        return;
    };
    lines.push(cut(&format!("  program   {}", place.program)));
    let text = format!("  line      {:<6} {}", status.line, place.text.trim());
    lines.push(cut(&text));
    let progress = match (view.progress(), place.planned_t, view.left_t()) {
        _ if place.has_failed => "not known: it cannot be planned here".to_owned(),
        (Some(_), Some(_), _) if place.is_on_its_way => {
            let behind = view.left_behind_t().map_or_else(String::new, |left| {
                format!(", from where it takes about {}", clock(left))
            });
            format!("on the way to line {}{behind}", status.line)
        }
        (Some(part), Some(all), left) => {
            let left = left.map_or_else(
                || {
                    let goes_back = view.status.mode() == Ok(MotionMode::Backwards);
                    let does = if goes_back {
                        "goes back along its path"
                    } else {
                        "stands at override 0"
                    };
                    does.to_owned()
                },
                |left| format!("about {} left", clock(left)),
            );
            let all = clock(all);
            format!("{} {:.0} % of {all}, {left}", bar(part), part * 100.0)
        }
        _ => "is being planned".to_owned(),
    };
    lines.push(format!("  progress  {progress}"));
}

#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    clippy::cast_precision_loss,
    reason = "columns"
)]
fn bar(part: f64) -> String {
    let done = (part * BAR as f64) as usize;
    format!(
        "[{}{}]",
        "#".repeat(done),
        "-".repeat(BAR.saturating_sub(done))
    )
}

fn position_lines(view: &View<'_>, lines: &mut Vec<String>) {
    let status = view.status;
    let work = view
        .offsets
        .as_ref()
        .map(|offset| (offset, offset.work(&status.position)));
    let system = work
        .as_ref()
        .map_or_else(String::new, |(offset, _)| offset.short());
    let is_away = status.away.iter().any(|away| *away != 0.0);
    let away = if is_away { "from path" } else { "" };
    lines.push(String::new());
    lines.push(format!(
        "  {:<8}{:>14}{:>14}{:>14}",
        "", "machine", system, away
    ));
    for axis in view.axes {
        let of = |values: &[f64; AXES]| values.get(axis.index()).copied().unwrap_or(0.0);
        let number = |values: &[f64; AXES]| decimals(of(values), 4);
        let mut line = format!("  {:<8}{:>14}", axis.to_string(), number(&status.position));
        match &work {
            Some((_, work)) => {
                let _ = write!(line, "{:>14}", number(work));
            }
            None => line.push_str(&" ".repeat(14)),
        }
        if is_away {
            let _ = write!(line, "{:>14}", number(&status.away));
        }
        if view.not_homed.contains(axis) {
            line.push_str("  not homed");
        }
        lines.push(line.trim_end().to_owned());
    }
    let turned = view
        .offsets
        .as_ref()
        .filter(|offset| offset.rotation_deg != 0.0);
    if let Some(offset) = turned {
        lines.push(format!("  turned    {:.4}° about Z", offset.rotation_deg));
    }
    lines.push(String::new());
}

#[allow(clippy::cast_precision_loss, reason = "counts of frames are exact")]
fn health_lines(status: &Status, lines: &mut Vec<String>) {
    let ahead_t = f64::from(status.queue_depth) * status.period_ns as f64 * 1e-9;
    lines.push(format!(
        "  buffer    {} of {} frames, {ahead_t:.2} s; starved for {} so far",
        status.queue_depth,
        status.queue_capacity,
        counted(status.starved_ticks, "tick")
    ));
    lines.push(format!(
        "  health    {} missed, {} lost, {} frames and {} commands refused",
        counted(status.missed_ticks, "tick"),
        counted(status.setpoints_lost, "setpoint"),
        grouped(status.frames_refused.iter().sum::<u64>()),
        grouped(status.commands_refused)
    ));
}

/// A line in as many as it takes; those that follow begin where its words do.
fn wrapped(line: &str) -> Vec<String> {
    let mut lines = Vec::new();
    let mut rest: Vec<char> = line.chars().collect();
    while rest.len() > WIDTH {
        let room = rest.get(..WIDTH).unwrap_or(&rest);
        let space = room.iter().rposition(|c| *c == ' ');
        // A word that is longer than what is left of a line is broken.
        let end = space.filter(|at| *at > INDENT + 8).unwrap_or(WIDTH);
        let tail: String = rest.split_off(end).into_iter().collect();
        lines.push(rest.into_iter().collect());
        rest = format!("{}{}", " ".repeat(INDENT), tail.trim_start())
            .chars()
            .collect();
    }
    lines.push(rest.into_iter().collect());
    lines
}

/// The beginning of a line, if it is too long: text that others wrote.
fn cut(line: &str) -> String {
    if line.chars().count() <= WIDTH {
        return line.to_owned();
    }
    line.chars().take(WIDTH - 1).chain(['…']).collect()
}

#[cfg(test)]
mod tests {
    #![allow(clippy::float_cmp, reason = "values are exact")]

    use super::*;
    use crate::report::machine::AwaitedEvent;
    use crate::report::view::ahead::Ahead;
    use crate::report::view::object::view_object;
    use crate::report::view::seen::ProgramPlace;
    use crate::report::work_offset::WorkOffset;
    use core::time::Duration;
    use glidepath_gcode::PositionOffsets;
    use glidepath_geometry::Axis;
    use glidepath_link::Auxiliary;
    use glidepath_program::Event;
    use serde_json::Value;

    /// The place in a program of 100 s, all of it at a feed.
    fn a_quarter_done(text: &str) -> ProgramPlace {
        ProgramPlace {
            program: "part.ngc".to_owned(),
            text: text.to_owned(),
            planned_t: Some(100.0),
            elapsed_t: Some(25.0),
            ahead: Some(Ahead {
                feed_t: 75.0,
                ..Ahead::default()
            }),
            ..ProgramPlace::default()
        }
    }

    #[test]
    fn a_screen_has_eighty_columns_and_says_what_an_operator_asks() {
        let mut status: Status = bytemuck::Zeroable::zeroed();
        status.state = MachineState::Running.code();
        status.period_ns = 4_000_000;
        (status.line, status.program, status.feed_override) = (12, 7, 0.5);
        status.adaptive_feed = 0.5;
        (status.queue_depth, status.queue_capacity) = (150, 768);
        status.position = [110.0, 0.0, -1.5, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
        status.message = glidepath_link::Text::new("clean the vice");
        let mut auxiliary = Auxiliary::default();
        for event in [
            Event::SelectTool(3),
            Event::MCode(6),
            Event::SelectTool(4),
            Event::SpindleSpeed(8000.0),
            Event::MCode(3),
            Event::MCode(8),
        ] {
            auxiliary.take(event);
        }
        let mut origin = [0.0; AXES];
        origin[0] = 100.0;
        let view = View {
            instance: "mill",
            status: &status,
            auxiliary: Some(&auxiliary),
            axes: &[Axis::X, Axis::Y, Axis::Z],
            not_homed: &[Axis::Y],
            place: Some(a_quarter_done(
                &("G1 X10 F1200 ".to_owned() + &"(a long comment)".repeat(9)),
            )),
            offsets: Some(WorkOffset {
                name: "G54".to_owned(),
                origin,
                rotation_deg: 0.0,
                beside: PositionOffsets::default(),
                five_axis: None,
            }),
            asked: AwaitedEvent::default(),
            events: vec![(
                Duration::from_secs(75),
                "the program runs, line 1".to_owned(),
            )],
        };
        let text = view_text(&view);
        assert!(
            text.lines().all(|line| line.chars().count() <= 80),
            "{text}"
        );
        assert!(text.lines().count() <= 24, "{text}");
        for words in [
            "mill   RUNNING   the program runs",
            "  program   part.ngc",
            "  line      12     G1 X10 F1200 (a long",
            "  progress  [######------------------] 25 % of 1:40, about 5:00 left",
            "  input     the adaptive feed, or the spindle in G95, lets through 50 %",
            "  X             110.0000       10.0000\n",
            "  Y               0.0000        0.0000  not homed\n",
            "  tool      T3, T4 selected, spindle M3 S8000, coolant M8",
            "  says      clean the vice",
            "  buffer    150 of 768 frames, 0.60 s; starved for 0 ticks so far",
            "      1:15 ago  the program runs, line 1",
        ] {
            assert!(text.contains(words), "{words}\n{text}");
        }
        let object = Value::Object(view_object(&view));
        assert_eq!(object["progress"], 0.25);
        assert_eq!(object["left_s"], 300.0);
        assert_eq!(object["work_position"]["X"], 10.0);
        assert_eq!(
            (&object["tool"], &object["tool_selected"]),
            (&3.into(), &4.into())
        );
        assert_eq!(
            (&object["spindle"], &object["coolant"]),
            (&"M3 S8000".into(), &"M8".into())
        );
    }

    #[test]
    fn going_back_and_what_is_superposed_are_said() {
        let mut status: Status = bytemuck::Zeroable::zeroed();
        status.state = MachineState::Running.code();
        (status.feed_override, status.adaptive_feed) = (-0.5, 1.0);
        status.mode = MotionMode::Backwards.code();
        status.superposition = glidepath_link::SuperpositionState::Frozen.code();
        status.freeze_reason = glidepath_link::FreezeReason::Rapid.code();
        status.superposed[2] = 0.4125;
        let view = View {
            instance: "mill",
            status: &status,
            auxiliary: None,
            axes: &[Axis::X, Axis::Y, Axis::Z],
            not_homed: &[],
            place: Some(a_quarter_done("")),
            offsets: None,
            asked: AwaitedEvent::default(),
            events: Vec::new(),
        };
        let text = view_text(&view);
        for words in [
            "25 % of 1:40, goes back along its path",
            "  superposed Z 0.4125 beside the program; stands still: nothing is added",
        ] {
            assert!(text.contains(words), "{words}\n{text}");
        }
        let is_narrow = text.lines().all(|line| line.chars().count() <= 80);
        assert!(is_narrow, "{text}");
    }

    #[test]
    fn long_lines_go_on_below() {
        let line = "  drives    ".to_owned() + &"on, homed ".repeat(12);
        let lines = wrapped(line.trim_end());
        assert!(lines.len() == 2 && lines.iter().all(|line| line.chars().count() <= WIDTH));
        assert!(lines[1].starts_with("            homed on,"), "{lines:?}");
        assert_eq!(wrapped(&"x".repeat(200)).len(), 3);
    }
}
