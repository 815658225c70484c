//! The judgement of a configuration, [`RawConfig`] to [`MachineConfig`]: every value is judged by
//! its range, and all that has to be mended is told at once. One file for each table of the
//! configuration.

mod adaptive_feed;
mod axes;
mod axis_share;
mod compensation;
mod cross_compensation;
mod feedback;
mod gears;
mod home;
mod horizon;
mod interpolator;
mod jog;
mod joints;
mod link;
mod m_codes;
mod mechanism;
mod path;
mod path_words;
mod preview;
mod probe;
mod program;
mod spindle;
mod stopped;
mod stops;
mod superposition;
mod values;

pub use horizon::MAX_FRAMES_AHEAD;
pub use path_words::{effort, tolerance, tolerance_ratio};
pub(crate) use values::{Judge, Range};

use super::diagnostic::ConfigDiagnostic;
use super::machine::MachineConfig;
use super::raw::RawConfig;
use super::settings::AxisConfig;
use glidepath_geometry::Axis;
use glidepath_kinematics::Mechanism;
use home::HomeSurroundings;
use spindle::SpindleSurroundings;
use std::sync::Arc;

/// Judges every value, beside what was found wrong with the text before.
///
/// # Errors
/// All diagnostics, in the order of the tables.
pub(super) fn judge(
    raw: RawConfig,
    found: Vec<ConfigDiagnostic>,
) -> Result<MachineConfig, Vec<ConfigDiagnostic>> {
    let mut judge = Judge { diagnostics: found };
    let axes_span = raw.axis.span();
    let raw_axes = raw.axis.into_inner().in_order();
    let raw_axes = || Axis::ALL.into_iter().zip(&raw_axes);
    let mut axes: Vec<AxisConfig> = raw_axes()
        .filter_map(|(axis, raw)| Some(judge.axis(axis, raw.as_ref()?)))
        .collect();
    judge.require_axis(&axes, axes_span);
    let names: Vec<Axis> = axes.iter().map(|axis| axis.axis).collect();
    let mut mechanism = judge.mechanism(&raw.machine, &names);
    let joint_limits = judge.joints(&raw.joint, &mechanism);
    let given = raw_axes().filter_map(|(axis, raw)| Some((axis, raw.as_ref()?)));
    let given: Vec<_> = given.collect();
    judge.complete(&mut axes, &given, (&mechanism, &joint_limits));
    let compensation = judge.compensation(&raw.compensation, &mechanism, &mut axes, &given);
    let cross = (&raw.squareness, &raw.straightness);
    judge.cross_compensation(cross, &mut mechanism, &mut axes);
    let feedback = judge.feedback(raw.feedback);
    let is_axes = matches!(mechanism, Mechanism::Trivial(_));
    // Drives come home with all of it.
    let whole_axes = axes.clone();
    let sources = (is_axes, feedback.is_expected);
    let superposition = judge.superposition(raw.superposition, &mut axes, sources);
    let axis_share = judge.axis_share(&mechanism, &joint_limits, &axes);
    let of_axes: Vec<_> = given.iter().map(|(_, raw)| raw.as_ref()).collect();
    let interpolator = judge.interpolator(&raw.interpolator, (&axes, &joint_limits), &of_axes);
    let by_axis = || given.iter().map(|(axis, raw)| (*axis, raw.as_ref()));
    let jog = judge.jog(raw.jog, by_axis());
    let gantries = judge.gantries(by_axis(), &mechanism, feedback.homing);
    let home_of_joints = judge.homes(
        &raw.home,
        &HomeSurroundings {
            mechanism: &mechanism,
            axes: &whole_axes,
            gantries: &gantries,
            homing: feedback.homing,
            period_t: f64::from(interpolator.period_us) * 1e-6,
        },
    );
    let expects_feedback = feedback.is_expected;
    let m_codes = judge.m_codes(raw.m_codes);
    let spindle_override = judge.spindle_override(&raw.spindle);
    let of_spindle = SpindleSurroundings {
        is_axes,
        axes: &names,
        m_codes: &m_codes,
        has_drives: expects_feedback,
    };
    let gears = judge.gears(&raw.spindle, &of_spindle);
    let spindle = judge.spindle(raw.spindle, &of_spindle);
    let program = judge.program(raw.program, &mechanism, expects_feedback);
    let config = MachineConfig {
        spindle_override,
        gears: Arc::new(gears),
        mechanism,
        home_of_joints,
        compensation,
        gantries,
        joint_limits,
        axis_share,
        axes,
        path: judge.path(raw.path, &names),
        interpolator,
        jog,
        feedback,
        probe: judge.probe(raw.probe, expects_feedback),
        spindle,
        adaptive_feed: judge.adaptive_feed(raw.adaptive_feed, expects_feedback),
        superposition,
        preview: judge.preview(&raw.preview),
        instance: judge.instance(raw.link),
        program,
        m_codes,
        stops: stopped::stopped(&raw.stops),
        state_directory: raw.state.directory.map(|path| path.into_inner().into()),
    };
    if judge.diagnostics.is_empty() {
        Ok(config)
    } else {
        Err(judge.diagnostics)
    }
}

impl Judge {
    /// A machine has an axis.
    fn require_axis(&mut self, axes: &[AxisConfig], span: core::ops::Range<usize>) {
        if axes.is_empty() {
            self.diagnostics.push(ConfigDiagnostic {
                key: "axis".to_owned(),
                message: "the machine has no axis".to_owned(),
                help: Some("add a table such as [axis.X]".to_owned()),
                span: Some(span),
            });
        }
    }
}
