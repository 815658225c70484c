//! The reports of commands, as text and as JSON.

mod active_program;
mod auxiliary;
mod beside;
mod calibration;
mod diagnosis;
mod diagnostic;
mod fit;
mod machine;
mod memory;
mod motion;
mod quantity;
mod run;
mod shape;
mod smoothness;
mod status;
mod superposition;
mod view;
mod warnings;
mod work_offset;

pub use active_program::{active_object, active_text};
pub use auxiliary::{coolant_words, spindle_words};
pub use beside::Beside;
pub use calibration::CalibrationReport;
pub use diagnosis::{DiagnosisReport, PlaceReport};
pub use diagnostic::{ProgramDiagnostic, diagnostic_object};
pub use fit::{FitReport, FittedRun};
pub use machine::{AskedTool, AwaitedEvent, awaited_code, names};
pub use memory::peak_rss_bytes;
pub use motion::{MotionReport, Planning};
pub use quantity::{counted, decimals, driven, grouped, rough_time, seconds};
pub use run::RunReport;
pub use shape::{AxisShape, ShapeDistance, ShapeFigures};
pub use smoothness::{AxisFigures, SmoothnessFigures};
pub use status::{
    quantiles_object, quantiles_text, realtime_object, realtime_text, status_object, status_text,
    timing_text,
};
pub use view::{Ahead, ProgramPlace, View, view_object, view_text};
pub use warnings::{WARNING, warnings};
pub use work_offset::WorkOffset;
