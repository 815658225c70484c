//! The plan for the page, made beside the machine.

use super::course::Course;
use super::shown::{Board, WholePlan};
use crate::command::forecast::Spectator;
use crate::command::reading::for_program_silently;
use crate::command::text_lines::TextLines;
use crate::config::MachineConfig;
use crate::page;
use crate::program_file::ProgramFile;
use crate::report::{DiagnosisReport, warnings};
use crate::sample::TickSample;
use glidepath_audit::AuditSettings;
use glidepath_audit::diagnosis::Diagnosis;
use glidepath_gcode::{Lacking, ReadingWatch};
use glidepath_geometry::AxisVector;
use glidepath_kinematics::{JointVector, Kinematics as _};
use glidepath_live::Motion;
use glidepath_planner::{FileSource, ItemSource as _, Supply};
use glidepath_program::{Frame, Item};
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::JoinHandle;

/// Collects the plan for the page.
pub(super) struct Planned {
    config: MachineConfig,
    board: Board,
    diagnosis: Diagnosis,
    motion: Motion,
    course: Course,
    path_mm: f64,
    /// Largest deviation and tolerance, mm.
    most: [f64; 2],
}

impl Planned {
    pub(super) fn new(config: &MachineConfig, board: Board) -> Self {
        Self {
            diagnosis: config.diagnosis(&AuditSettings::from(&config.settings())),
            motion: page::motion(config),
            course: Course::new(config),
            config: config.clone(),
            board,
            path_mm: 0.0,
            most: [0.0; 2],
        }
    }
}

impl Spectator for Planned {
    fn lacks(&mut self, lacks: Lacking) {
        self.board.warnings(warnings(lacks).collect());
    }

    fn text(&mut self, lines: &TextLines) {
        self.course.text(lines);
    }

    fn item(&mut self, item: &Item) {
        self.diagnosis.program(item);
    }

    fn frame(&mut self, frame: &Frame) {
        if self.config.joints() > 0
            && let Ok(joints) = self.config.mechanism.inverse(&frame.position)
        {
            self.diagnosis.joints(joints.as_slice());
        }
        let binding = self.diagnosis.frame(frame);
        let sample = TickSample::planned(frame, self.config.period_t(), JointVector::zeros());
        page::push(
            &mut self.motion,
            &sample.diagnosed(binding, &self.diagnosis),
        );
        self.course.frame(frame);
        let deviation = self.diagnosis.deviation();
        let now = [deviation.distance_mm, deviation.tolerance_mm];
        for (most, now) in self.most.iter_mut().zip(now) {
            *most = most.max(now);
        }
        self.path_mm = frame.path_s;
    }

    fn end(&mut self, trouble: Option<&str>) {
        if let Some(trouble) = trouble {
            self.board.trouble(trouble);
            return;
        }
        let settings = AuditSettings::from(&self.config.settings());
        let diagnosis = core::mem::replace(&mut self.diagnosis, self.config.diagnosis(&settings));
        let diagnosis = DiagnosisReport::new(&diagnosis.finish(), &self.config);
        let mut report = page::report_object(&diagnosis, self.path_mm, self.most);
        report["course"] = self.course.object();
        self.board.plan(WholePlan {
            columns: self.motion.columns(),
            path: self.motion.path(),
            report,
        });
    }
}

/// A thread that reads the program for its path, which is there long before its plan. It ends when
/// this is dropped.
pub(super) struct Reading {
    over: Arc<AtomicBool>,
    watch: ReadingWatch,
    thread: Option<JoinHandle<()>>,
}

impl Drop for Reading {
    fn drop(&mut self) {
        self.over.store(true, Ordering::Relaxed);
        self.watch.end();
        let _ended = self.thread.take().map(JoinHandle::join);
    }
}

/// Reads a program for its path from where it begins.
pub(super) fn read(
    path: &Path,
    config: &MachineConfig,
    begins: AxisVector,
    board: Board,
) -> Reading {
    let over = Arc::<AtomicBool>::default();
    let watch = ReadingWatch::default();
    // Its subroutines are read apart from those of the plan, whose fingerprint is made of them.
    let (mut config, _) = for_program_silently(&ProgramFile::named(path), config);
    let path = path.to_owned();
    config.program.watch = Some(watch.clone());
    let flag = Arc::clone(&over);
    let thread = std::thread::spawn(move || {
        let options = config.program_options(begins);
        // What is wrong with it is told by whoever plans it.
        let Ok(mut source) = FileSource::unchecked(&path, options, &config.settings()) else {
            return;
        };
        let mut motion = page::motion(&config);
        let mut is_first = true;
        while !flag.load(Ordering::Relaxed) {
            match source.next_item() {
                Supply::Item(item) => {
                    page::push_item(&mut motion, &item, is_first);
                    is_first = false;
                }
                Supply::Pending | Supply::Probe => {}
                Supply::End | Supply::Refused(_) => {
                    board.program(motion.programmed_path());
                    return;
                }
            }
        }
    });
    let thread = Some(thread);
    Reading {
        over,
        watch,
        thread,
    }
}
