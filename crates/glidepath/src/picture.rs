//! The picture of a motion that was asked for: an SVG file, or a page.

use crate::config::MachineConfig;
use crate::output_file::OutputKind;
use crate::page;
use crate::plot::Plot;
use crate::report::MotionReport;
use crate::sample::TickSample;
use crate::work_zero;
use glidepath_live::Motion;
use glidepath_program::Item;
use serde_json::{Value, json};
use std::ffi::OsStr;
use std::path::Path;

/// The text of larger programs is no part of a page, bytes.
const MOST_TEXT: u64 = 8 << 20;

/// A picture as it grows.
#[derive(Debug)]
pub enum Picture {
    /// A drawing.
    Svg(Box<Plot>, Box<MachineConfig>),
    /// A page, for files that end in `.html` or `.htm`.
    Page(Box<PlanPage>),
}

/// A page as it grows.
#[derive(Debug)]
pub struct PlanPage {
    motion: Motion,
    machine: Value,
    has_program: bool,
    report: Value,
    text: String,
}

impl Picture {
    /// What a file of this name is.
    #[must_use]
    pub fn kind(path: &Path) -> OutputKind {
        let ending = path.extension().and_then(OsStr::to_str);
        match ending.map(str::to_ascii_lowercase).as_deref() {
            Some("html" | "htm") => OutputKind::Page,
            _ => OutputKind::Plot,
        }
    }

    /// An empty picture of a machine's motion, for a file of this name.
    #[must_use]
    pub fn new(config: &MachineConfig, path: &Path) -> Self {
        if Self::kind(path) == OutputKind::Page {
            return Self::Page(Box::new(PlanPage {
                motion: page::motion(config),
                machine: page::machine_object(config, ""),
                has_program: false,
                report: Value::Null,
                text: String::new(),
            }));
        }
        let plot = Plot::new(&config.axis_names(), config.own_limits(), config.period_t());
        let plot = plot.with_joints(&config.joint_limits, config.joints());
        Self::Svg(Box::new(plot), Box::new(config.clone()))
    }

    /// Takes the next item of the program that the motion follows.
    pub fn program(&mut self, item: &Item) {
        match self {
            Self::Svg(plot, _) => plot.program(item),
            Self::Page(page) => {
                page::push_item(&mut page.motion, item, !page.has_program);
                page.has_program = true;
            }
        }
    }

    /// Takes the next sample; their ticks ascend.
    pub fn push(&mut self, sample: &TickSample) {
        match self {
            Self::Svg(plot, _) => plot.push(sample),
            Self::Page(page) => page::push(&mut page.motion, sample),
        }
    }

    /// Takes what is known of the motion as a whole, and where its program is.
    pub fn told(&mut self, report: &MotionReport, program: &Path) {
        let Some(diagnosis) = &report.diagnosis else {
            return;
        };
        match self {
            Self::Svg(plot, config) => {
                plot.told(diagnosis);
                if let Some(zero) = work_zero::find(program, config) {
                    plot.work_zero([zero[0], zero[1], zero[2]]);
                }
            }
            Self::Page(page) => {
                let deviation = [report.max_deviation_mm, report.tolerance_mm];
                page.report = page::report_object(diagnosis, report.path_length_mm, deviation);
                if let Value::Object(object) = &mut page.report {
                    object.insert("violations".to_owned(), report.violation_count.into());
                }
                let is_short = program.metadata().is_ok_and(|file| file.len() <= MOST_TEXT);
                if is_short && let Ok(bytes) = std::fs::read(program) {
                    page.text = String::from_utf8_lossy(&bytes).into_owned();
                }
            }
        }
    }

    /// The text of the file.
    #[must_use]
    pub fn render(&self, title: &str, caption: &str) -> String {
        match self {
            Self::Svg(plot, _) => plot.render(title, caption),
            Self::Page(page) => {
                let lines = page.text.lines().count();
                let plan = json!({
                    "machine": page.machine,
                    "program": { "name": title, "lines": lines },
                    "report": page.report,
                });
                glidepath_live::file::page(&plan.to_string(), &page.text, &page.motion)
            }
        }
    }
}
