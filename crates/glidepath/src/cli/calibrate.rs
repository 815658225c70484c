//! Arguments of `calibrate`.

use super::basic::BasicArgs;
use super::program::program_file;
use crate::program_file::ProgramFile;
use clap::Args;

/// Arguments of `calibrate`.
#[derive(Debug, Args)]
pub struct CalibrateArgs {
    /// The measured points (CSV): columns J0, J1 … as the joints said, and X, Y, Z, A, B, C as measured; `-` is
    /// standard input
    #[arg(value_name = "CSV", value_parser = program_file(), value_hint = clap::ValueHint::AnyPath)]
    pub file: ProgramFile,
    /// Configuration and form of the report.
    #[command(flatten)]
    pub basic: BasicArgs,
    /// How accurately X, Y and Z were measured: standard deviation, mm
    #[arg(long, value_name = "MM", default_value = "0.01", value_parser = accuracy)]
    pub accuracy: f64,
    /// How accurately A, B and C were measured: standard deviation, °
    #[arg(long, value_name = "DEG", default_value = "0.005", value_parser = accuracy)]
    pub angle_accuracy: f64,
    /// A dimension with a larger standard deviation counts as not told, and keeps its value, mm or °
    #[arg(long, value_name = "MM_OR_DEG", default_value = "1", value_parser = accuracy)]
    pub within: f64,
    /// A dimension that keeps its value, such as `rod`, `tower_angles` or `J2` (its zero); may be given several
    /// times
    #[arg(long, value_name = "NAME")]
    pub keep: Vec<String>,
}

fn accuracy(text: &str) -> Result<f64, &'static str> {
    text.parse()
        .ok()
        .filter(|number: &f64| (1e-9..=1e6).contains(number))
        .ok_or("give a number from 1e-9 to 1e6")
}
