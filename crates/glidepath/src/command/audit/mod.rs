//! `glidepath audit`: judges what was recorded, by the limits of the machine, and by the program.

mod axis_state;
mod continuity;
mod finding;
mod follows;
mod led;
mod outline;
mod program;
mod trace;

use crate::cli::AuditArgs;
use crate::command::failure::Failure;
use crate::config::MachineConfig;
use crate::exit::Exit;
use crate::output;
use crate::program_file::ProgramFile;
use crate::report::{ShapeFigures, grouped};
use continuity::Continuity;
use finding::Findings;
use follows::Follows;
use glidepath_link::{EndOfEpoch, Setpoint};
use glidepath_recording::Entry;
use outline::Outline;
use program::Program;
use serde_json::json;
use std::path::Path;
use trace::Trace;

/// Two places that are the same but for rounding, mm or degrees.
const SAME_MM: f64 = 1e-9;
/// Findings in the text; the object has more.
const SHOWN: usize = 20;

/// Judges a recording or a CSV file.
///
/// # Errors
/// It cannot be read, or its program cannot be planned.
pub(super) fn audit(args: &AuditArgs, config: &MachineConfig) -> Result<Exit, Failure> {
    args.file.keep_whole()?;
    if let Some(program) = &args.program {
        program.open()?;
    }
    let program = Program::of(args, config)?;
    let verdict = judge(&args.file, &program)?;
    verdict.tell(args);
    Ok(verdict.exit())
}

/// What came of it.
#[derive(Debug, Default)]
struct Verdict {
    setpoints: u64,
    seconds: f64,
    is_cut: bool,
    most: [f64; 3],
    max_deviation_mm: Option<f64>,
    shape: Option<ShapeFigures>,
    was_replanned: bool,
    findings: Findings,
    notes: Vec<String>,
}

/// Judges a file by a machine and, if there is one, by a program.
fn judge(file: &ProgramFile, program: &Program) -> Result<Verdict, Failure> {
    let config = &program.config;
    let mut trace = Trace::open(file, config)?;
    let mut continuity = Continuity::new(config);
    let mut outline = Outline::default();
    let (mut first, mut last) = (None, None::<Setpoint>);
    while let Some(entry) = trace.next_entry()? {
        match entry {
            Entry::Setpoint(setpoint) => {
                continuity.take(&setpoint);
                outline.take(&setpoint, last.as_ref());
                first.get_or_insert(setpoint.tick);
                last = Some(setpoint);
            }
            Entry::Status(status) => {
                continuity.know(&status);
                outline.has_statuses = true;
                outline.end = status.end_of_epoch().ok();
                if status.epoch != 0 {
                    outline.program = Some((status.program, status.program_start.into()));
                }
            }
        }
    }
    let ticks = last.map_or(0, |last| last.tick.saturating_sub(first.unwrap_or(0)));
    #[allow(clippy::cast_precision_loss, reason = "for people")]
    let seconds = ticks as f64 * config.period_t();
    let mut verdict = Verdict {
        setpoints: continuity.setpoints,
        seconds,
        is_cut: trace.is_cut(),
        most: continuity.most,
        findings: continuity.findings,
        ..Verdict::default()
    };
    if verdict.is_cut {
        verdict.note("the recording was cut short: judged as far as it goes");
    }
    outline.goes_back &= !trace.has_program_time();
    let Some(path) = program.path() else {
        verdict.note("no program was given: its path is not judged (--program)");
        return Ok(verdict);
    };
    let why = outline.unjudged().map(str::to_owned);
    match why.or_else(|| program.unjudged(&outline)) {
        Some(why) => verdict.note(&why),
        None => follow(file, (config, path), &outline, &mut verdict)?,
    }
    Ok(verdict)
}

fn follow(
    file: &ProgramFile,
    (config, program): (&MachineConfig, &Path),
    outline: &Outline,
    verdict: &mut Verdict,
) -> Result<(), Failure> {
    let stands = outline.begin.unwrap_or_else(|| config.home());
    let overrides = outline.overrides.unwrap_or((1.0, 1.0));
    let mut follows = Follows::new(program, config, stands, overrides)?;
    if let Some((executed, started)) = outline.program {
        if executed != follows.fingerprint() {
            verdict.note("another program was executed: its path is not judged");
            return Ok(());
        }
        if (started - stands).amax() > SAME_MM {
            verdict.note("the motion goes on with a program: its path is not judged");
            return Ok(());
        }
    }
    verdict.was_replanned = follows.has_plan();
    let mut trace = Trace::open(file, config)?;
    while let Some(entry) = trace.next_entry()? {
        if let Entry::Setpoint(setpoint) = entry
            && outline.epochs.first() == Some(&setpoint.epoch)
        {
            follows.take(&setpoint);
        }
    }
    let was_stopped = matches!(outline.end, Some(EndOfEpoch::Aborted | EndOfEpoch::Faulted));
    let was_stopped = was_stopped || outline.is_cut;
    let is_whole = !verdict.is_cut && !was_stopped && (outline.is_idle || !outline.has_statuses);
    if !is_whole {
        verdict.note("the motion ends before the program does");
    }
    let (findings, max_deviation_mm, shape) = follows.finish(is_whole);
    verdict.findings.join(findings);
    verdict.max_deviation_mm = Some(max_deviation_mm);
    verdict.shape = Some(ShapeFigures::new(&shape, &config.axis_names()));
    Ok(())
}

impl Verdict {
    fn note(&mut self, text: &str) {
        self.notes.push(text.to_owned());
    }

    const fn exit(&self) -> Exit {
        if self.findings.count == 0 {
            Exit::Done
        } else {
            Exit::Fault
        }
    }

    fn tell(&self, args: &AuditArgs) {
        let [velocity, acceleration, jerk] = self.most;
        if args.basic.json {
            let listed = self.findings.listed.iter();
            output::object(&json!({
                "file": args.file.name(),
                "setpoints": self.setpoints,
                "seconds": self.seconds,
                "is_cut": self.is_cut,
                "max_velocity_ratio": velocity,
                "max_acceleration_ratio": acceleration,
                "max_jerk_ratio": jerk,
                "max_deviation_mm": self.max_deviation_mm,
                "shape": self.shape,
                "was_replanned": self.was_replanned,
                "notes": self.notes,
                "finding_count": self.findings.count,
                "findings": listed.map(finding::Finding::object).collect::<Vec<_>>(),
            }));
            return;
        }
        let mut text = format!(
            "{}: {} setpoints, {:.1} s\n  limits used   velocity {:.2} %, acceleration {:.2} %, \
             jerk {:.2} %\n",
            args.file.name().display(),
            grouped(self.setpoints),
            self.seconds,
            velocity * 100.0,
            acceleration * 100.0,
            jerk * 100.0
        );
        if let Some(deviation_mm) = self.max_deviation_mm {
            let plan = if self.was_replanned {
                "; held against its plan"
            } else {
                ""
            };
            text.push_str(&format!("  deviation     {deviation_mm:.4} mm{plan}\n"));
        }
        if let Some(shape) = &self.shape {
            text.push_str(&shape.text());
        }
        for note in &self.notes {
            text.push_str(&format!("  note          {note}\n"));
        }
        let count = self.findings.count;
        if count == 0 {
            text.push_str("  verdict       nothing found\n");
        } else {
            text.push_str(&format!(
                "  verdict       {} findings, the first:\n",
                grouped(count)
            ));
        }
        for finding in self.findings.listed.iter().take(SHOWN) {
            text.push_str(&finding.line());
        }
        output::result(&text);
    }
}

#[cfg(test)]
mod tests;
