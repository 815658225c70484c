//! The catalogue `bench.json`: what is known of the benchmark programs, and what of it holds for a
//! machine.
//!
//! A bound holds for one jerk limit and one tolerance. Where the study has none for the machine's
//! tolerance, that for another tolerance and the same jerk stands in, and the row says so.

use crate::text_file;
use serde::Deserialize;
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// The reason why the catalogue of benchmark programs cannot be used.
#[derive(Debug, Error)]
pub enum CatalogueError {
    /// The file cannot be read.
    #[error(
        "cannot read {path}: {source}; give the folder that has bench.json and its programs",
        path = path.display()
    )]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
    /// The file is not what it should be.
    #[error("{path} is not a catalogue of benchmark programs: {source}", path = path.display())]
    Malformed {
        /// The file.
        path: PathBuf,
        /// Where and why.
        source: serde_json::Error,
    },
}

/// All benchmark programs.
#[derive(Debug, Deserialize)]
pub struct Catalogue {
    /// In the order of the table.
    pub bench: Vec<CatalogueEntry>,
}

/// A benchmark program, and what is known of it.
#[derive(Debug, Deserialize)]
pub struct CatalogueEntry {
    /// Its file, in the folder of the catalogue.
    pub file: PathBuf,
    /// The machine it is for: the name of a configuration without `.toml`.
    pub profile: String,
    exact_stop_s: BTreeMap<String, f64>,
    anchors: Vec<Anchor>,
    exact_curve: Option<BTreeMap<String, Value>>,
    linuxcnc: Vec<Run>,
}

#[derive(Debug, Deserialize)]
struct Anchor {
    tolerance_mm: f64,
    jerk: Option<f64>,
    tube_s: Option<f64>,
    copp_bezier_b_s: Option<f64>,
}

/// A run of another control.
#[derive(Debug, Deserialize)]
struct Run {
    version: String,
    jerk: Option<f64>,
    #[serde(rename = "G64")]
    path_mode: String,
    time_s: f64,
    deviation_mm: Option<f64>,
}

/// The known times of a program on a machine, s.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Anchors {
    /// The best time any geometry inside the tolerance allows, and that tolerance in mm.
    pub tube: Option<(f64, f64)>,
    /// Jerk-limited along corner by corner Bézier transitions of that tolerance.
    pub copp: Option<f64>,
    /// Along the exact curve the chords were taken from.
    pub exact_curve: Option<f64>,
    /// With a stop at every corner.
    pub exact_stop: Option<f64>,
    /// The fastest run of LinuxCNC's jerk-limited planner.
    pub linuxcnc: Option<OtherControl>,
}

/// A run of another control, and how it differs.
#[derive(Debug, Clone, PartialEq)]
pub struct OtherControl {
    /// Cycle time, s.
    pub time_s: f64,
    /// Its jerk limit, mm/s³.
    pub jerk_j: f64,
    /// Its path mode.
    pub path_mode: String,
    /// Its deviation, mm.
    pub deviation_mm: Option<f64>,
}

/// Largest catalogue, bytes.
const MOST_BYTES: u64 = 1 << 20;

impl Catalogue {
    /// Reads the catalogue of a folder.
    ///
    /// # Errors
    /// The file cannot be read, or is not a catalogue.
    pub fn read(folder: &Path) -> Result<Self, CatalogueError> {
        let path = folder.join("bench.json");
        let text = match text_file::read(&path, MOST_BYTES) {
            Ok(text) => text,
            Err(source) => return Err(CatalogueError::Unreadable { path, source }),
        };
        serde_json::from_str(&text).map_err(|source| CatalogueError::Malformed { path, source })
    }
}

fn is_same(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-9 * b.abs()
}

impl CatalogueEntry {
    /// What is known for a jerk limit (mm/s³) and a tolerance (mm).
    #[must_use]
    pub fn anchors(&self, jerk_j: f64, tolerance_mm: f64) -> Anchors {
        let of_jerk = || {
            self.anchors
                .iter()
                .filter(|anchor| anchor.jerk.is_some_and(|jerk| is_same(jerk, jerk_j)))
        };
        let mut ordered: Vec<_> = of_jerk().collect();
        // The anchors of the machine's tolerance come first.
        ordered.sort_by_key(|anchor| !is_same(anchor.tolerance_mm, tolerance_mm));
        let first = |of: fn(&Anchor) -> Option<f64>| {
            ordered
                .iter()
                .find_map(|anchor| Some((of(anchor)?, anchor.tolerance_mm)))
        };
        let keyed = |key: &str, prefix: &str, suffix: &str| {
            key.strip_prefix(prefix)
                .and_then(|rest| rest.strip_suffix(suffix))
                .and_then(|number| number.parse().ok())
                .is_some_and(|jerk| is_same(jerk, jerk_j))
        };
        let exact_stop = self.exact_stop_s.iter();
        Anchors {
            tube: first(|anchor| anchor.tube_s),
            copp: first(|anchor| anchor.copp_bezier_b_s).map(|(time_s, _)| time_s),
            exact_curve: self.exact_curve.as_ref().and_then(|times| {
                let of_jerk = times.iter().find(|(key, _)| keyed(key, "copp_j=", "_s"));
                of_jerk
                    .map(|(_, time)| time)
                    .or_else(|| times.get("second_order_optimum_s"))
                    .and_then(Value::as_f64)
            }),
            exact_stop: exact_stop
                .clone()
                .find(|(key, _)| keyed(key, "j=", ""))
                .map(|(_, time_s)| *time_s),
            linuxcnc: self.linuxcnc(jerk_j),
        }
    }

    /// The fastest run with a jerk limit, of those whose limit is nearest.
    fn linuxcnc(&self, jerk_j: f64) -> Option<OtherControl> {
        let runs = || {
            self.linuxcnc.iter().filter_map(|run| {
                let is_limited = run.version.contains("S-curve");
                run.jerk.filter(|_| is_limited).map(|jerk| (run, jerk))
            })
        };
        let away = |jerk: f64| (jerk / jerk_j).ln().abs();
        let nearest = runs().map(|(_, jerk)| away(jerk)).reduce(f64::min)?;
        runs()
            .filter(|(_, jerk)| away(*jerk) <= nearest)
            .min_by(|(a, _), (b, _)| a.time_s.total_cmp(&b.time_s))
            .map(|(run, jerk_j)| OtherControl {
                time_s: run.time_s,
                jerk_j,
                path_mode: run.path_mode.clone(),
                deviation_mm: run.deviation_mm,
            })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FOLDER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/data/bench");

    fn anchors(file: &str, jerk_j: f64, tolerance_mm: f64) -> Anchors {
        let catalogue = Catalogue::read(Path::new(FOLDER)).unwrap();
        let entry = catalogue
            .bench
            .iter()
            .find(|entry| entry.file == Path::new(file));
        entry.unwrap().anchors(jerk_j, tolerance_mm)
    }

    #[test]
    fn anchors_are_those_of_the_machine() {
        let zigzag = anchors("zigzag_mill.ngc", 4e4, 0.02);
        assert_eq!(zigzag.tube, Some((2.89057, 0.02)));
        assert_eq!(zigzag.copp, Some(4.16565));
        assert_eq!(zigzag.exact_stop, Some(5.78084));
        assert_eq!(zigzag.exact_curve, None);
        let linuxcnc = zigzag.linuxcnc.unwrap();
        assert_eq!((linuxcnc.time_s, linuxcnc.jerk_j), (6.624, 5e4));
        assert_eq!(linuxcnc.path_mode, "P0.01");
    }

    #[test]
    fn another_tolerance_stands_in_and_curves_have_their_own_bound() {
        let circle = anchors("circle_g1_0.1_seed.ngc", 1e6, 0.05);
        assert_eq!((circle.tube, circle.exact_curve), (None, Some(0.77261)));
        assert_eq!(circle.linuxcnc, None);
        assert_eq!(
            anchors("butterfly_g1_mill.ngc", 4e4, 0.02).exact_curve,
            Some(3.76466)
        );
        assert_eq!(
            anchors("seed5_seed.ngc", 1e6, 0.04).tube,
            Some((0.05646, 0.03))
        );
        assert_eq!(
            anchors("seed5_seed.ngc", 7e5, 0.05),
            Anchors {
                linuxcnc: anchors("seed5_seed.ngc", 1e6, 0.05).linuxcnc,
                ..Anchors::default()
            }
        );
    }

    #[test]
    fn every_program_of_the_catalogue_is_there() {
        for entry in Catalogue::read(Path::new(FOLDER)).unwrap().bench {
            assert!(Path::new(FOLDER).join(&entry.file).is_file(), "{entry:?}");
        }
    }
}
