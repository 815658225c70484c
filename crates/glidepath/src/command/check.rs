//! `glidepath check`: everything wrong with programs.

use super::fitting::name_offset;
use super::program_diagnostics::print_diagnostics;
use super::reading::for_program;
use crate::cli::CheckArgs;
use crate::command::failure::Failure;
use crate::config::MachineConfig;
use crate::exit::Exit;
use crate::file_error::FileError;
use crate::joints;
use crate::output;
use crate::program_file::ProgramFile;
use crate::progress::ProgressDisplay;
use crate::report::{WARNING, counted, diagnostic_object, warnings};
use glidepath_gcode::{Diagnostic, Diagnostics, Report};
use glidepath_geometry::{Axis, AxisVector};
use glidepath_planner::{check_file, find_in_file};
use serde_json::{Map, Value, json};

/// Reads every program to its end.
///
/// # Errors
/// A file cannot be opened.
pub(super) fn check(args: &CheckArgs, config: &MachineConfig) -> Result<Exit, Failure> {
    let mut reports = Vec::new();
    for file in &args.files {
        file.open()?;
        let report = read(file, config, args.basic.json)?;
        reports.push((file.name().display().to_string(), report));
    }
    if args.basic.json {
        output::object(&object(&reports));
    } else {
        for (name, report) in &reports {
            print(name, report);
        }
    }
    let reports = || reports.iter().map(|(_, report)| report);
    let whole = reports().all(|report| report.is_complete() || config.program.may_run_unchecked);
    Ok(match (reports().all(Report::is_accepted), whole) {
        (false, _) => Exit::Rejected,
        (true, false) => Exit::Unchecked,
        (true, true) => Exit::Done,
    })
}

/// Checks one program for a machine at its home.
///
/// # Errors
/// The file cannot be opened.
fn read(file: &ProgramFile, config: &MachineConfig, json: bool) -> Result<Report, Failure> {
    let config = &for_program(file, config);
    let options = config.program_options(config.start());
    let progress = progress(file, json);
    let report = check_file(file.path(), options, &config.settings(), &mut |bytes| {
        progress.at(bytes);
    });
    progress.finish();
    let mut report = report.map_err(FileError::open(file.name()))?;
    name_offset(&mut report.diagnostics, file, config);
    // A program whose loops do not end would have joints judged for ever.
    if !report.is_accepted() || !report.is_complete() {
        return Ok(report);
    }
    let diagnostics = along_joints(file, config, report.totals.lines, json)?;
    Ok(Report {
        diagnostics,
        ..report
    })
}

/// A program that may be run.
pub(super) struct Accepted {
    /// How many it has, or, where it is not checked to its end, were read.
    pub(super) lines: u32,
    /// The time that its feeds and dwells take at least, s.
    pub(super) least_time_s: f64,
}

impl Accepted {
    const fn of(found: &Diagnostics) -> Self {
        Self {
            lines: found.lines,
            least_time_s: found.least_time_s,
        }
    }
}

/// Checks a program that is to be run.
///
/// # Errors
/// The file cannot be opened, the program has something to mend, or it is not checked to its end
/// and may not be run so.
pub(super) fn accepted(
    file: &ProgramFile,
    config: &MachineConfig,
    json: bool,
) -> Result<Accepted, Failure> {
    let config = &for_program(file, config);
    let options = config.program_options(config.start());
    let progress = progress(file, json);
    let found = find_in_file(file.path(), options, &config.settings(), &mut |bytes| {
        progress.at(bytes);
    });
    progress.finish();
    let mut found = found.map_err(FileError::open(file.name()))?;
    if found.diagnostics.is_empty() {
        for warning in warnings(found.lacks) {
            output::note(&format!("{}: {WARNING}{warning}", file.name().display()));
        }
    }
    if let Some(line) = found.given_up_at.filter(|_| found.diagnostics.is_empty()) {
        let has_joints = config.joint_watch().is_some();
        if config.program.may_run_unchecked && !has_joints {
            output::note(&not_checked(&file.name().display().to_string(), line));
            return Ok(Accepted::of(&found));
        }
        return Err(Failure::Unchecked {
            program: file.name().display().to_string(),
            line,
            has_joints,
        });
    }
    if found.diagnostics.is_empty() {
        found.diagnostics = along_joints(file, config, found.lines, json)?;
    }
    if found.diagnostics.is_empty() {
        return Ok(Accepted::of(&found));
    }
    name_offset(&mut found.diagnostics, file, config);
    Err(Failure::Rejected {
        program: file.name().display().to_string(),
        diagnostics: found.diagnostics,
        more: found.more,
        moved: false,
    })
}

/// What is wrong along the path with joints that are not the axes.
///
/// # Errors
/// The file cannot be read any more.
fn along_joints(
    file: &ProgramFile,
    config: &MachineConfig,
    lines: u32,
    json: bool,
) -> Result<Vec<Diagnostic>, Failure> {
    let progress = ProgressDisplay::lines(lines.into(), json);
    progress.doing("judging");
    let found = joints::check_path(file.path(), config, &mut |lines| progress.at(lines));
    progress.finish();
    Ok(found?.into_iter().collect())
}

/// A bar for the check of a file.
fn progress(file: &ProgramFile, json: bool) -> ProgressDisplay {
    let bytes = std::fs::metadata(file.path()).map_or(0, |metadata| metadata.len());
    let progress = ProgressDisplay::bytes(bytes, json);
    progress.doing("checking");
    progress
}

fn print(name: &str, report: &Report) {
    print_diagnostics(name, &report.diagnostics, report.more);
    let totals = &report.totals;
    let verdict = match report.diagnostics.len() + usize::try_from(report.more).unwrap_or(0) {
        0 if report.is_complete() => "no findings".to_owned(),
        0 => "no findings as far as it was checked".to_owned(),
        1 => "1 finding".to_owned(),
        count => format!("{count} findings"),
    };
    output::result(&format!(
        "{name}: {verdict}; {}, {}, {}, {}, {:.3} mm at feed, {:.3} mm rapid\n",
        counted(totals.lines.into(), "line"),
        counted(totals.straight_feeds.into(), "straight move"),
        counted(totals.arcs.into(), "arc"),
        counted(totals.rapids.into(), "rapid"),
        totals.feed_length_mm,
        totals.rapid_length_mm
    ));
    output::result(&survey(report));
    for warning in warnings(report.lacks) {
        output::note(&format!("{name}: {WARNING}{warning}"));
    }
    if let Some(line) = report.given_up_at {
        output::result(&(not_checked(name, line) + "; the figures above are of what was\n"));
    }
}

/// That a program was not checked to its end.
fn not_checked(name: &str, line: u32) -> String {
    format!("{name}: not checked beyond line {line}, because its loops go on for too long")
}

/// Where the program goes and how long it takes at its feedrates.
fn survey(report: &Report) -> String {
    let totals = &report.totals;
    let mut text = String::new();
    let mut tell = |of: &str, (low, high): (&AxisVector, &AxisVector)| {
        text.push_str(&format!("  {of}:"));
        for axis in Axis::ALL {
            let i = axis.index();
            if low[i] != 0.0 || high[i] != 0.0 {
                text.push_str(&format!(" {axis} {:.3} … {:.3}", low[i], high[i]));
            }
        }
        text.push('\n');
    };
    for part in &report.part {
        let of = format!("box of the feed moves, in {}", part.system);
        tell(&of, (&part.low, &part.high));
    }
    if let Some((low, high)) = &totals.bounding_box {
        tell(
            "box of all moves from the start on, in machine coordinates",
            (low, high),
        );
    }
    text.push_str(&format!(
        "  at the feedrates, without acceleration: {:.1} s straight, {:.1} s in arcs, {:.1} s dwell\n",
        report.survey.straight_time_s, report.survey.arc_time_s, totals.dwell_s
    ));
    if let Some(corner) = report.survey.corner {
        text.push_str(&format!(
            "  sharpest corner between feed moves: {:.1}° in front of line {}\n",
            corner.angle_deg, corner.line
        ));
    }
    let turns = report.survey.pole_turns;
    if turns.count > 0 {
        text.push_str(&format!(
            "  {} of C at the pole, at rapid while the tip rests in the cut: the widest by {:.1}° in line {}\n",
            counted(turns.count.into(), "turn"),
            turns.angle_deg,
            turns.line
        ));
    }
    let beyond = report.soft_limit_violations();
    if beyond > 0 {
        text.push_str(&format!(
            "  {beyond} of the findings are moves beyond a soft limit\n"
        ));
    }
    text
}

fn object(reports: &[(String, Report)]) -> Value {
    let findings: u64 = reports
        .iter()
        .map(|(_, report)| report.diagnostics.len() as u64 + u64::from(report.more))
        .sum();
    let programs: Vec<Value> = reports
        .iter()
        .map(|(name, report)| program(name, report))
        .collect();
    json!({ "findings": findings, "programs": programs })
}

/// A program as an object: its totals and what is wrong with it.
fn program(name: &str, report: &Report) -> Value {
    let totals = &report.totals;
    let findings: Vec<Value> = report
        .diagnostics
        .iter()
        .map(|diagnostic| diagnostic_object(name, diagnostic))
        .collect();
    json!({
        "program": name,
        "accepted": report.is_accepted() && report.is_complete(),
        "checked_to_end": report.is_complete(),
        "not_checked_beyond_line": report.given_up_at,
        "lines": totals.lines,
        "straight_moves": totals.straight_feeds,
        "arcs": totals.arcs,
        "rapids": totals.rapids,
        "dwells": totals.dwells,
        "feed_length_mm": totals.feed_length_mm,
        "rapid_length_mm": totals.rapid_length_mm,
        "box": bounding_box(report),
        "part_boxes": part_boxes(report),
        "straight_time_s": report.survey.straight_time_s,
        "arc_time_s": report.survey.arc_time_s,
        "dwell_s": totals.dwell_s,
        "sharpest_corner": report.survey.corner.map(|corner| json!({
            "line": corner.line,
            "angle_deg": corner.angle_deg,
            "position": corner.at.as_slice(),
        })),
        "pole_turns": json!({
            "count": report.survey.pole_turns.count,
            "line": report.survey.pole_turns.line,
            "angle_deg": report.survey.pole_turns.angle_deg,
        }),
        "soft_limit_violations": report.soft_limit_violations(),
        "warnings": warnings(report.lacks).collect::<Vec<_>>(),
        "findings": findings,
        "findings_not_shown": report.more,
    })
}

/// Lowest and highest machine coordinate of every axis that moves.
fn bounding_box(report: &Report) -> Value {
    let of = report.totals.bounding_box.as_ref();
    Value::Object(of.map_or_else(Map::new, |(low, high)| box_object(low, high)))
}

/// The same of the feed moves, in the coordinates of each system.
fn part_boxes(report: &Report) -> Value {
    let boxes = report.part.iter().map(|part| {
        let mut object = box_object(&part.low, &part.high);
        object.insert("system".to_owned(), part.system.as_str().into());
        Value::Object(object)
    });
    boxes.collect()
}

fn box_object(low: &AxisVector, high: &AxisVector) -> Map<String, Value> {
    let axes = Axis::ALL.into_iter().map(|axis| (axis, axis.index()));
    let moved = axes.filter(|(_, i)| low[*i] != 0.0 || high[*i] != 0.0);
    moved
        .map(|(axis, i)| (axis.to_string(), json!([low[i], high[i]])))
        .collect()
}
