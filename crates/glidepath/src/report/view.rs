//! What an operator looks at while the machine works: one screen of 80 columns.

use super::machine::power_text;
use super::quantity::grouped;
use super::status::{fault_text, state_name};
use core::fmt::Write as _;
use core::time::Duration;
use glidepath_geometry::{AXES, Axis};
use glidepath_link::{MachineState, Status};
use glidepath_program::Event;
use serde_json::{Map, Value, json};

/// Columns.
const WIDTH: usize = 80;
/// Columns before the words of a line.
const INDENT: usize = 12;
/// Columns of the bar of progress.
const BAR: usize = 24;

/// What a program has told tool, spindle and coolant.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Modal {
    tool: Option<u32>,
    speed_rpm: f64,
    /// 3, 4 or 5.
    spindle: u32,
    mist: bool,
    flood: bool,
}

impl Modal {
    /// Takes an event of the program into account.
    pub const fn take(&mut self, event: Event) {
        match event {
            Event::SpindleSpeed(rpm) => self.speed_rpm = rpm,
            Event::SelectTool(tool) => self.tool = Some(tool),
            Event::MCode(code @ 3..=5) => self.spindle = code,
            Event::MCode(7) => self.mist = true,
            Event::MCode(8) => self.flood = true,
            Event::MCode(9) => (self.mist, self.flood) = (false, false),
            Event::MCode(2 | 30) => {
                self.spindle = 5;
                (self.mist, self.flood) = (false, false);
            }
            _ => {}
        }
    }

    fn words(&self) -> String {
        let tool = self
            .tool
            .map_or_else(|| "no tool named".to_owned(), |tool| format!("T{tool}"));
        let spindle = match self.spindle {
            3 => format!("spindle {:.0} rev/min (M3)", self.speed_rpm),
            4 => format!("spindle {:.0} rev/min backwards (M4)", self.speed_rpm),
            _ => "spindle off".to_owned(),
        };
        let coolant = match (self.mist, self.flood) {
            (false, false) => "coolant off",
            (true, false) => "mist on",
            (false, true) => "flood on",
            (true, true) => "mist and flood on",
        };
        format!("{tool}, {spindle}, {coolant}")
    }
}

/// Where the machine is in a program that is known.
#[derive(Debug, Clone, PartialEq)]
pub struct Place {
    /// The program's name.
    pub program: String,
    /// Text of the line that is executed; empty if it is not known.
    pub text: String,
    /// How long the whole of it takes, s; `None` while that is not known yet.
    pub planned_t: Option<f64>,
    /// How much of that is done, s.
    pub elapsed_t: Option<f64>,
    /// It could not be planned here.
    pub has_failed: bool,
    /// What it has told tool, spindle and coolant.
    pub modal: Modal,
}

/// A coordinate system.
#[derive(Debug, Clone, PartialEq)]
pub struct WorkOffset {
    /// Its name, as G54.
    pub name: String,
    /// Its zero, in machine coordinates, mm or degrees.
    pub origin: [f64; AXES],
    /// How far X and Y are turned about Z, degrees.
    pub rotation_deg: f64,
}

impl WorkOffset {
    /// A machine position in this system.
    fn work(&self, machine: &[f64; AXES]) -> [f64; AXES] {
        let mut work = *machine;
        for (place, origin) in work.iter_mut().zip(&self.origin) {
            *place -= origin;
        }
        let (sin, cos) = self.rotation_deg.to_radians().sin_cos();
        let [x, y, ..] = work;
        if self.rotation_deg != 0.0 {
            [work[0], work[1]] = [x * cos + y * sin, y * cos - x * sin];
        }
        work
    }
}

/// What is shown.
#[derive(Debug)]
pub struct View<'a> {
    /// Name of the machine's instance.
    pub instance: &'a str,
    /// What the interpolator says.
    pub status: &'a Status,
    /// The machine's axes.
    pub axes: &'a [Axis],
    /// Where it is in the program; `None` if that is not known.
    pub place: Option<Place>,
    /// The coordinate system in force; `None` if none is kept.
    pub offsets: Option<WorkOffset>,
    /// What happened lately, the newest first, and how long ago.
    pub events: Vec<(Duration, String)>,
}

/// What the machine does, as one says it.
#[must_use]
pub const fn doing(state: MachineState) -> &'static str {
    match state {
        MachineState::Idle => "ready: at rest, no program",
        MachineState::Running => "the program runs",
        MachineState::Holding => "slowing down for a hold",
        MachineState::Held => "held: `glidepath resume` goes on",
        MachineState::Starving => "slowing down for want of a plan",
        MachineState::Starved => "waits for the planner",
        MachineState::ProgramStop => "stopped by the program: `glidepath resume` goes on",
        MachineState::Stopping => "stopping",
        MachineState::Faulted => "a fault: `glidepath reset` takes note of it",
        MachineState::Waiting => "waits for more of the program",
        MachineState::Awaiting => "waits for an answer of the machine",
        MachineState::Jogging => "moved by hand",
        MachineState::Homing => "joints are on their way home",
        MachineState::Off => "off: `glidepath enable` switches on",
        MachineState::NotHomed => "not homed: `glidepath home`",
    }
}

/// A time as people read it: 1:02:03, 2:03 or 3.4 s.
fn clock(t: f64) -> String {
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a time that is not negative"
    )]
    let s = t.max(0.0).round() as u64;
    match (s / 3600, s / 60 % 60, s % 60) {
        (0, 0, _) if t < 10.0 => format!("{t:.1} s"),
        (0, 0, s) => format!("{s} s"),
        (0, min, s) => format!("{min}:{s:02}"),
        (h, min, s) => format!("{h}:{min:02}:{s:02}"),
    }
}

impl View<'_> {
    /// What is done of the program, 0 to 1.
    fn progress(&self) -> Option<f64> {
        let place = self.place.as_ref()?;
        let (all, done) = (place.planned_t?, place.elapsed_t?);
        (all > 0.0).then(|| (done / all).clamp(0.0, 1.0))
    }

    /// How long it takes yet under the present override, s.
    fn left_t(&self) -> Option<f64> {
        let place = self.place.as_ref()?;
        let left = place.planned_t? - place.elapsed_t?;
        let ratio = self.status.feed_override;
        (ratio > 0.0).then(|| left.max(0.0) / ratio)
    }

    /// What is awaited, and for how long, s.
    fn awaited(&self) -> Option<(String, f64)> {
        let status = self.status;
        (status.awaited_since_ns != 0).then(|| {
            let waited = status.updated_ns.saturating_sub(status.awaited_since_ns);
            let what = format!(
                "the answer to the event of frame {}",
                status.awaited_sequence
            );
            (what, Duration::from_nanos(waited).as_secs_f64())
        })
    }
}

/// What a view tells besides its status, as an object.
#[must_use]
pub fn view_object(view: &View<'_>) -> Map<String, Value> {
    let by_axis = |values: &[f64; AXES]| -> Map<String, Value> {
        let axes = view.axes.iter();
        axes.filter_map(|axis| Some((axis.to_string(), (*values.get(axis.index())?).into())))
            .collect()
    };
    let place = view.place.as_ref();
    let object = json!({
        "updated_ns": view.status.updated_ns,
        "program": place.map(|place| place.program.as_str()),
        "block_text": place.map(|place| place.text.as_str()),
        "progress": view.progress(),
        "planned_s": place.and_then(|place| place.planned_t),
        "left_s": view.left_t(),
        "tool": place.and_then(|place| place.modal.tool),
        "offset": view.offsets.as_ref().map(|offset| json!({
            "system": offset.name,
            "origin": by_axis(&offset.origin),
            "rotation_deg": offset.rotation_deg,
        })),
        "work_position": view.offsets.as_ref()
            .map(|offset| by_axis(&offset.work(&view.status.position))),
        "events": view.events.iter()
            .map(|(ago, text)| json!({ "ago_s": ago.as_secs_f64(), "text": text }))
            .collect::<Vec<_>>(),
    });
    match object {
        Value::Object(object) => object,
        _ => Map::new(),
    }
}

/// The screen.
#[must_use]
pub fn view_text(view: &View<'_>) -> String {
    let status = view.status;
    let state = status.state().ok();
    let mut lines = Vec::new();
    let name = state.map_or("unknown", state_name).to_uppercase();
    let words = state.map_or("", doing);
    lines.push(format!("{}   {name}   {words}", view.instance));
    if let Some(fault) = fault_text(status) {
        lines.push(format!("  FAULT     {fault}"));
    }
    lines.push(String::new());
    program_lines(view, &mut lines);
    position_lines(view, &mut lines);
    lines.push(format!(
        "  feed      {:.0} mm/min on the path",
        status.feed_v * 60.0
    ));
    lines.push(format!(
        "  override  feed {:.0} %, rapid {:.0} %, jog {:.0} %; executed {:.0} %{}",
        status.feed_override * 100.0,
        status.rapid_override * 100.0,
        status.jog_override * 100.0,
        status.effective_override * 100.0,
        if status.single_block == 1 {
            "; single block"
        } else {
            ""
        }
    ));
    let modal = view.place.as_ref().map(|place| place.modal.words());
    let unknown = "known only with the program: status --watch PROGRAM";
    lines.push(format!(
        "  tool      {}",
        modal.map_or_else(
            || unknown.to_owned(),
            |words| format!("{words}, says the program")
        )
    ));
    if let Some((what, waited_t)) = view.awaited() {
        lines.push(format!("  waits     {} for {what}", clock(waited_t)));
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
        (Some(part), Some(all), left) => {
            let left = left.map_or_else(
                || "stands at override 0".to_owned(),
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
    let system = work.as_ref().map_or("", |(offset, _)| offset.name.as_str());
    let is_away = status.away.iter().any(|away| *away != 0.0);
    let away = if is_away { "from path" } else { "" };
    lines.push(String::new());
    lines.push(format!(
        "  {:<8}{:>14}{:>14}{:>14}",
        "", "machine", system, away
    ));
    for axis in view.axes {
        let of = |values: &[f64; AXES]| values.get(axis.index()).copied().unwrap_or(0.0);
        let mut line = format!("  {:<8}{:>14.4}", axis.to_string(), of(&status.position));
        match &work {
            Some((_, work)) => {
                let _ = write!(line, "{:>14.4}", of(work));
            }
            None => line.push_str(&" ".repeat(14)),
        }
        if is_away {
            let _ = write!(line, "{:>14.4}", of(&status.away));
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
        "  buffer    {} of {} frames, {ahead_t:.2} s; starved for {} ticks so far",
        status.queue_depth,
        status.queue_capacity,
        grouped(status.starved_ticks)
    ));
    lines.push(format!(
        "  health    {} ticks missed, {} setpoints lost, {} frames and {} commands refused",
        grouped(status.missed_ticks),
        grouped(status.setpoints_lost),
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

    #[test]
    fn a_screen_has_eighty_columns_and_says_what_an_operator_asks() {
        let mut status: Status = bytemuck::Zeroable::zeroed();
        status.state = MachineState::Running.code();
        status.period_ns = 4_000_000;
        (status.line, status.program, status.feed_override) = (12, 7, 0.5);
        (status.queue_depth, status.queue_capacity) = (150, 768);
        status.position = [110.0, 0.0, -1.5, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
        let mut modal = Modal::default();
        for event in [
            Event::SelectTool(3),
            Event::SpindleSpeed(8000.0),
            Event::MCode(3),
            Event::MCode(8),
        ] {
            modal.take(event);
        }
        let mut origin = [0.0; AXES];
        origin[0] = 100.0;
        let view = View {
            instance: "mill",
            status: &status,
            axes: &[Axis::X, Axis::Y, Axis::Z],
            place: Some(Place {
                program: "part.ngc".to_owned(),
                text: "G1 X10 F1200 ".to_owned() + &"(a long comment)".repeat(9),
                planned_t: Some(100.0),
                elapsed_t: Some(25.0),
                has_failed: false,
                modal,
            }),
            offsets: Some(WorkOffset {
                name: "G54".to_owned(),
                origin,
                rotation_deg: 0.0,
            }),
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
            "  progress  [######------------------] 25 % of 1:40, about 2:30 left",
            "  X             110.0000       10.0000",
            "  tool      T3, spindle 8000 rev/min (M3), flood on, says the program",
            "  buffer    150 of 768 frames, 0.60 s; starved for 0 ticks so far",
            "      1:15 ago  the program runs, line 1",
        ] {
            assert!(text.contains(words), "{words}\n{text}");
        }
        let object = Value::Object(view_object(&view));
        assert_eq!(object["progress"], 0.25);
        assert_eq!(object["left_s"], 150.0);
        assert_eq!(object["work_position"]["X"], 10.0);
        assert_eq!(object["tool"], 3);
    }

    #[test]
    fn long_lines_go_on_below() {
        let line = "  drives    ".to_owned() + &"on, homed ".repeat(12);
        let lines = wrapped(line.trim_end());
        assert!(lines.len() == 2 && lines.iter().all(|line| line.chars().count() <= WIDTH));
        assert!(lines[1].starts_with("            on, homed"), "{lines:?}");
        assert_eq!(wrapped(&"x".repeat(200)).len(), 3);
    }

    #[test]
    fn a_turned_system_turns_positions_back() {
        let offset = WorkOffset {
            name: "G55".to_owned(),
            origin: [0.0; AXES],
            rotation_deg: 90.0,
        };
        let mut machine = [0.0; AXES];
        machine[1] = 5.0;
        let work = offset.work(&machine);
        assert!((work[0] - 5.0).abs() < 1e-12 && work[1].abs() < 1e-12);
    }
}
