//! The report of `calibrate`: a piece of a configuration, with all else in its comments.

use crate::config::MachineConfig;
use crate::measured_points::PointsFile;
use core::fmt::Write as _;
use glidepath_kinematics::{
    Calibration, DimensionName, DimensionSum, DimensionUnit, FoundDimension, PointResiduals,
    ResidualSize,
};
use serde_json::{Value, json};

/// How many times the stated accuracy points may be off before it is told.
const WIDE_R: f64 = 3.0;
/// The column at which comments begin.
const COMMENT: usize = 44;

/// The report of `glidepath calibrate`.
#[derive(Debug)]
pub struct CalibrationReport<'a> {
    /// Name of the file of points.
    pub name: &'a str,
    /// The points.
    pub file: &'a PointsFile,
    /// The machine as it is configured.
    pub config: &'a MachineConfig,
    /// What was found.
    pub calibration: &'a Calibration,
}

impl CalibrationReport<'_> {
    /// As TOML.
    #[must_use]
    pub fn text(&self) -> String {
        let mut text = String::new();
        self.head(&mut text);
        text.push_str(&self.table());
        self.zeros(&mut text);
        self.sums(&mut text);
        text
    }

    /// As one JSON object.
    #[must_use]
    pub fn object(&self) -> Value {
        let found = self.calibration;
        let sums = |sums: &[DimensionSum]| -> Vec<Value> {
            sums.iter().map(|sum| self.sum_object(sum)).collect()
        };
        json!({
            "points": self.name,
            "point_count": self.file.points.len(),
            "numbers": found.numbers,
            "dimensions": found.dimensions.iter().map(|d| self.dimension_object(d)).collect::<Vec<_>>(),
            "before": self.residuals_object(&found.before),
            "after": self.residuals_object(&found.after),
            "untold": sums(&found.untold),
            "weak": sums(&found.weak),
            "spread": found.spread_r,
            "toml": self.table(),
        })
    }

    fn head(&self, text: &mut String) {
        let found = self.calibration;
        let told = found.dimensions.iter().filter(|d| d.deviation.is_some());
        // Writing to a String does not fail.
        let _ = writeln!(
            text,
            "# {}: {} points, {} numbers; {} of {} dimensions found",
            self.name,
            self.file.points.len(),
            found.numbers,
            told.count(),
            found.dimensions.len(),
        );
        let pairs = [
            (
                "tip off by",
                "mm",
                found.before.position_mm,
                found.after.position_mm,
            ),
            (
                "angles off by",
                "°",
                found.before.angle_deg,
                found.after.angle_deg,
            ),
        ];
        for (what, unit, before, after) in pairs {
            if let (Some(before), Some(after)) = (before, after) {
                let _ = writeln!(text, "#   before: {what} {}", self.miss(&before, unit));
                let _ = writeln!(text, "#   after:  {what} {}", self.miss(&after, unit));
            }
        }
        match found.spread_r {
            None => text.push_str(
                "# As many dimensions as numbers: every point fits, right or wrong. Measure more of them.\n",
            ),
            Some(spread_r) if spread_r > WIDE_R => {
                let _ = writeln!(
                    text,
                    "# The points are off by {spread_r:.1} times --accuracy as they are: a mistake in a row (look at the \
                     worst one),\n# play, or something that is no dimension of the table. Deviations below count that in."
                );
            }
            Some(_) => {}
        }
        text.push('\n');
    }

    fn miss(&self, size: &ResidualSize, unit: &str) -> String {
        format!(
            "{:.4} {unit} rms, {:.4} {unit} at most (line {})",
            size.rms, size.worst, self.file.lines[size.worst_point]
        )
    }

    /// The mechanism's table.
    fn table(&self) -> String {
        let mut text = format!("[machine.{}]\n", self.config.kinematics());
        let mut of_table = self.calibration.dimensions.iter().peekable();
        while let Some(dimension) = of_table.next() {
            match dimension.name {
                DimensionName::Zero { .. } => {}
                DimensionName::Key { key, unit } => {
                    let value = number(dimension);
                    let comment = comment(&[dimension], unit);
                    let _ = writeln!(text, "{}# {comment}", padded(&format!("{key} = {value}")));
                }
                DimensionName::Of { key, unit, .. } => {
                    let mut three = vec![dimension];
                    let is_same = |next: &&FoundDimension| matches!(next.name, DimensionName::Of { key: other, .. } if other == key);
                    while let Some(next) = of_table.next_if(is_same) {
                        three.push(next);
                    }
                    let values: Vec<String> = three.iter().map(|d| number(d)).collect();
                    let line = padded(&format!("{key} = [{}]", values.join(", ")));
                    let _ = writeln!(text, "{line}# {}", comment(&three, unit));
                }
            }
        }
        text
    }

    fn zeros(&self, text: &mut String) {
        text.push_str(
            "\n# Zeros: what each joint is further than it says. Add them to where its drive counts from, which is\n\
             # `home_offset` in drives.toml.\n",
        );
        for dimension in &self.calibration.dimensions {
            let DimensionName::Zero { joint, unit } = dimension.name else {
                continue;
            };
            let sign = unit.sign();
            let _ = match dimension.deviation {
                Some(deviation) => writeln!(
                    text,
                    "#   J{joint} {:+.4} {sign}, ± {} {sign}",
                    dimension.value,
                    rough(deviation)
                ),
                None => writeln!(text, "#   J{joint} kept as it is"),
            };
        }
    }

    fn sums(&self, text: &mut String) {
        let found = self.calibration;
        if !found.untold.is_empty() {
            text.push_str(
                "\n# The points do not tell, because with these changed together the tip stays where it is:\n",
            );
        }
        for sum in &found.untold {
            let kept = &found.dimensions[sum.parts[0].place];
            let how = if sum.deviation.is_finite() {
                format!("± {} {}", rough(sum.deviation), kept.name.unit().sign())
            } else {
                "not at all".to_owned()
            };
            let _ = writeln!(
                text,
                "#   {}: {how}; {} keeps {}",
                self.sum(sum),
                kept.name,
                decimal(kept.nominal)
            );
        }
        if !found.weak.is_empty() {
            text.push_str("\n# They tell with little certainty:\n");
        }
        for sum in &found.weak {
            let _ = writeln!(text, "#   {}: ± {}", self.sum(sum), rough(sum.deviation));
        }
    }

    fn sum(&self, sum: &DimensionSum) -> String {
        let mut text = String::new();
        for (index, part) in sum.parts.iter().enumerate() {
            let name = self.calibration.dimensions[part.place].name;
            let sign = match (index, part.factor < 0.0) {
                (0, false) => "",
                (_, false) => " + ",
                (0, true) => "− ",
                (_, true) => " − ",
            };
            let factor = part.factor.abs();
            let _ = if (factor - 1.0).abs() < 5e-4 {
                write!(text, "{sign}{name}")
            } else {
                write!(text, "{sign}{factor:.3} {name}")
            };
        }
        text
    }

    fn dimension_object(&self, dimension: &FoundDimension) -> Value {
        let key = match dimension.name {
            DimensionName::Key { key, .. } | DimensionName::Of { key, .. } => {
                Some(format!("machine.{}.{key}", self.config.kinematics()))
            }
            DimensionName::Zero { .. } => None,
        };
        let (index, joint) = match dimension.name {
            DimensionName::Key { .. } => (None, None),
            DimensionName::Of { index, .. } => (Some(index), None),
            DimensionName::Zero { joint, .. } => (None, Some(joint)),
        };
        json!({
            "name": dimension.name.to_string(),
            "key": key,
            "index": index,
            "joint": joint,
            "unit": dimension.name.unit().sign(),
            "before": dimension.nominal,
            "value": dimension.value,
            "deviation": dimension.deviation,
        })
    }

    fn residuals_object(&self, residuals: &PointResiduals) -> Value {
        let of = |size: &Option<ResidualSize>| {
            size.map(|size| {
                json!({
                    "rms": size.rms,
                    "worst": size.worst,
                    "worst_line": self.file.lines[size.worst_point],
                })
            })
        };
        json!({ "position_mm": of(&residuals.position_mm), "angle_deg": of(&residuals.angle_deg) })
    }

    fn sum_object(&self, sum: &DimensionSum) -> Value {
        let name = |place: usize| self.calibration.dimensions[place].name.to_string();
        let parts: Vec<Value> = sum
            .parts
            .iter()
            .map(|part| json!({ "dimension": name(part.place), "factor": part.factor }))
            .collect();
        json!({
            "parts": parts,
            "deviation": sum.deviation.is_finite().then_some(sum.deviation),
        })
    }
}

/// A value as a configuration has it: what was kept as it was.
fn number(dimension: &FoundDimension) -> String {
    if dimension.deviation.is_some() {
        format!("{:.5}", dimension.value)
    } else {
        decimal(dimension.nominal)
    }
}

fn comment(dimensions: &[&FoundDimension], unit: DimensionUnit) -> String {
    let list = |of: &dyn Fn(&FoundDimension) -> String| {
        let all: Vec<String> = dimensions.iter().map(|d| of(d)).collect();
        all.join(", ")
    };
    if dimensions.iter().all(|d| d.deviation.is_none()) {
        return "kept".to_owned();
    }
    let before = list(&|d| decimal(d.nominal));
    let deviations = list(&|d| {
        d.deviation.map_or_else(
            || "kept".to_owned(),
            |deviation| format!("± {}", rough(deviation)),
        )
    });
    format!("before {before}; {deviations} {}", unit.sign())
}

fn padded(line: &str) -> String {
    format!("{line:COMMENT$}  ")
}

/// As a configuration has numbers: with a decimal point.
fn decimal(value: f64) -> String {
    let text = value.to_string();
    if text.contains('.') {
        text
    } else {
        text + ".0"
    }
}

/// Two digits that count.
fn rough(value: f64) -> String {
    if value <= 0.0 {
        return "0".to_owned();
    }
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a count of digits"
    )]
    let digits = (1.0 - value.log10().floor()).clamp(0.0, 7.0) as usize;
    format!("{value:.digits$}")
}
