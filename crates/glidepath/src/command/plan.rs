//! `glidepath plan`: the motion of a program without waiting for the clock.

use super::check;
use crate::cli::PlanArgs;
use crate::clock;
use crate::config::MachineConfig;
use crate::exit::Exit;
use crate::failure::Failure;
use crate::interrupt::Interrupt;
use crate::output;
use crate::progress::Progress;
use crate::recording::Recording;
use crate::report::{MotionReport, Planning, peak_rss_bytes};
use crate::sample::Sample;
use glidepath_motion::audit::{Audit, AuditSettings};
use glidepath_planner::{Output, Pipeline, ProgramSource};
use std::fs::File;
use std::io::BufReader;
use std::path::Path;

/// Steps of the planner between two looks at progress and Ctrl-C.
const STEPS_PER_TURN: usize = 512;

/// Plans a program, audits the motion, and writes the files asked for.
///
/// # Errors
/// The program is rejected, a file cannot be read or written, or the user interrupted.
pub(super) fn plan(args: &PlanArgs, config: &MachineConfig) -> Result<Exit, Failure> {
    let checked = check::accepted(&args.file, config)?;
    let interrupt = Interrupt::install().map_err(Failure::Signals)?;
    let (csv, plot) = (args.setpoints.as_deref(), args.plot.as_deref());
    let mut recording = Recording::create(config, csv, plot)?;
    let progress = Progress::lines(checked.totals.lines.into());
    progress.doing("planning");
    let mut pass = Pass::start(&args.file, config)?;
    while pass.turn(&mut recording)? {
        progress.at(pass.pipeline.statistics().lines);
        if interrupt.is_set() {
            return Err(Failure::Interrupted);
        }
    }
    progress.finish();

    let mut report = pass.report(config);
    report.program = args.file.display().to_string();
    report.setpoints.clone_from(&args.setpoints);
    report.plot.clone_from(&args.plot);
    recording.finish(&title(&args.file), &report.caption())?;
    if args.basic.json {
        output::object(&report);
    } else {
        output::result(&(report.text() + &report.files()));
    }
    Ok(report.exit())
}

/// The name of a program on its plot.
pub(super) fn title(path: &Path) -> String {
    path.file_name()
        .unwrap_or(path.as_os_str())
        .to_string_lossy()
        .into_owned()
}

/// One pass of the planner over a program.
struct Pass {
    pipeline: Pipeline<ProgramSource<BufReader<File>>>,
    audit: Audit,
    period_t: f64,
}

impl Pass {
    fn start(path: &Path, config: &MachineConfig) -> Result<Self, Failure> {
        let file = File::open(path).map_err(Failure::open(path))?;
        let home = config.home();
        let reader = BufReader::with_capacity(1 << 16, file);
        let source = ProgramSource::new(reader, config.program_options(home));
        let settings = config.settings();
        Ok(Self {
            pipeline: Pipeline::new(source, settings, home).with_clock(clock::elapsed),
            audit: Audit::new(&AuditSettings {
                limits: settings.limits,
                period_t: settings.period_t,
                tolerance_mm: settings.tolerance_mm,
            }),
            period_t: settings.period_t,
        })
    }

    /// Takes some steps; false at the end.
    fn turn(&mut self, recording: &mut Recording) -> Result<bool, Failure> {
        for _ in 0..STEPS_PER_TURN {
            match self.pipeline.advance()? {
                Output::Item(item) => self.audit.program(&item),
                Output::Frame(frame) => {
                    self.audit.sample(&(&frame).into());
                    recording.push(&Sample::planned(&frame, self.period_t))?;
                }
                // A file is never without its next item.
                Output::Pending => {}
                Output::End => return Ok(false),
            }
        }
        Ok(true)
    }

    fn report(self, config: &MachineConfig) -> MotionReport {
        let statistics = self.pipeline.statistics();
        let planning = Planning {
            lines: statistics.lines,
            segments: statistics.segments,
            plan_wall_s: statistics.planning.as_secs_f64(),
            peak_rss_bytes: peak_rss_bytes(),
        };
        MotionReport::new(&planning, &self.audit.finish(), config)
    }
}
