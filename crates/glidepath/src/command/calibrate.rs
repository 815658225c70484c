//! `glidepath calibrate`: the dimensions of a mechanism from measured points.

use crate::cli::CalibrateArgs;
use crate::command::failure::Failure;
use crate::config::MachineConfig;
use crate::exit::Exit;
use crate::file_error::FileError;
use crate::measured_points::{self, PointsFile, PointsOf};
use crate::output;
use crate::report::CalibrationReport;
use crate::text_file;
use glidepath_kinematics::{
    CalibrationError, CalibrationSettings, DimensionName, MeasuringAccuracy, calibrate as fit,
    dimension_names,
};

/// Fits the dimensions and reports them.
///
/// # Errors
/// The points are rejected, or give no dimensions.
pub(super) fn calibrate(args: &CalibrateArgs, config: &MachineConfig) -> Result<Exit, Failure> {
    let names = dimension_names(&config.mechanism);
    let settings = CalibrationSettings {
        accuracy: MeasuringAccuracy {
            position_mm: args.accuracy,
            angle_deg: args.angle_accuracy,
        },
        most_deviation: args.within,
        held: held(&names, &args.keep)?,
    };
    args.file.keep(measured_points::MOST_BYTES)?;
    let (path, name) = (args.file.path(), args.file.name());
    let text = text_file::read(path, measured_points::MOST_BYTES).map_err(FileError::open(name))?;
    let name = name.display().to_string();
    let is_zero = |name: &&DimensionName| matches!(name, DimensionName::Zero { .. });
    let of = PointsOf {
        joints: names.iter().filter(is_zero).count(),
        axes: config.axis_names(),
        home: config.home(),
    };
    if names.is_empty() {
        return Err(failure(CalibrationError::NoDimensions));
    }
    let file = measured_points::parse(&name, &text, &of)
        .map_err(|(rows, more)| Failure::Points { rows, more })?;
    let found = fit(&config.mechanism, &file.points, &settings);
    let calibration = found.map_err(|error| told(error, &file, (&name, &text)))?;
    let report = CalibrationReport {
        name: &name,
        file: &file,
        config,
        calibration: &calibration,
    };
    if args.basic.json {
        output::object(&report.object());
    } else {
        output::result(&report.text());
    }
    Ok(Exit::Done)
}

/// The places of the dimensions that keep their values: a key names all of its numbers, a joint its zero.
fn held(names: &[DimensionName], keep: &[String]) -> Result<Vec<usize>, Failure> {
    let mut held = Vec::new();
    for wanted in keep {
        let is_meant = |name: &DimensionName| match name {
            DimensionName::Zero { joint, .. } => *wanted == format!("J{joint}"),
            DimensionName::Key { key, .. } | DimensionName::Of { key, .. } => {
                wanted == key || *wanted == name.to_string()
            }
        };
        let places = names.iter().enumerate().filter(|(_, name)| is_meant(name));
        let before = held.len();
        held.extend(places.map(|(place, _)| place));
        if held.len() == before && !names.is_empty() {
            let mut known: Vec<String> = names.iter().map(asked_for).collect();
            known.dedup();
            return Err(Failure::UnknownDimension {
                name: wanted.clone(),
                names: known,
            });
        }
    }
    Ok(held)
}

/// How a dimension is asked for.
fn asked_for(name: &DimensionName) -> String {
    match name {
        DimensionName::Key { key, .. } | DimensionName::Of { key, .. } => (*key).to_owned(),
        DimensionName::Zero { joint, .. } => format!("J{joint}"),
    }
}

fn told(error: CalibrationError, file: &PointsFile, text: (&str, &str)) -> Failure {
    let CalibrationError::Unreachable { point, .. } = error else {
        return failure(error);
    };
    let help = "look for a mistake in the row, in the order of the joints, and in the dimensions";
    Failure::Points {
        rows: vec![file.diagnostic(text, point, error.to_string(), help)],
        more: 0,
    }
}

fn failure(error: CalibrationError) -> Failure {
    let remedy = match error {
        CalibrationError::NoDimensions => {
            "where joints are the axes, screws are compensated instead: `glidepath config --explain compensation`"
        }
        CalibrationError::TooFew { .. } => {
            "measure more points, several times as many numbers as dimensions, or name with --keep what is known"
        }
        CalibrationError::NothingTold => {
            "measure points all over the workspace, or allow a larger deviation with --within"
        }
        CalibrationError::Unreachable { .. } | CalibrationError::NotSettled => {
            "look for mistakes in the order of the joints and in the signs, and begin with dimensions that are \
             nearer to the machine's"
        }
    };
    Failure::NotCalibrated { error, remedy }
}
