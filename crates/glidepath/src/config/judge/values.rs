//! The judge of single values: a number in its range, one of several names.

use crate::config::diagnostic::ConfigDiagnostic;
use crate::config::raw::Optional;
use glidepath_geometry::Axis;
use toml::Spanned;

/// The range of a number.
pub(crate) struct Range {
    pub(crate) min: f64,
    pub(crate) max: f64,
    pub(crate) unit: &'static str,
    /// How to choose a value.
    pub(crate) help: &'static str,
}

pub(crate) struct Judge {
    pub(crate) diagnostics: Vec<ConfigDiagnostic>,
}

impl Judge {
    /// Whether anything is wrong with tables of these names, or in them. A finding without a name may
    /// be about any; a key that is not of the table leaves the others as they are.
    pub(super) fn has_found(&self, tables: &[&str]) -> bool {
        let amiss = |found: &&ConfigDiagnostic| !found.is_superfluous_key();
        self.diagnostics.iter().filter(amiss).any(|found| {
            let is_of = |table: &&str| {
                let rest = found.key.strip_prefix(*table);
                rest.is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
            };
            found.key.is_empty() || tables.iter().any(is_of)
        })
    }

    /// A number, which is in its range in any case: the nearest one that is stands for one that is
    /// not, so that whatever is computed from it before the file is refused comes to an end.
    pub(crate) fn number(&mut self, key: &str, value: &Spanned<f64>, range: &Range) -> f64 {
        let number = *value.as_ref();
        // Not a number is in no range.
        if !(range.min..=range.max).contains(&number) {
            let Range {
                min,
                max,
                unit,
                help,
            } = range;
            self.diagnostics.push(ConfigDiagnostic {
                key: key.to_owned(),
                message: format!("{key} = {number} {unit} is out of range"),
                help: Some(format!("give {min} to {max} {unit}: {help}")),
                span: Some(value.span()),
            });
        }
        // `max` before `min`: what is no number becomes the least.
        number.max(range.min).min(range.max)
    }

    /// The same for each of three numbers.
    pub(super) fn three(
        &mut self,
        key: &str,
        value: &Optional<[f64; 3]>,
        range: &Range,
        default: [f64; 3],
    ) -> [f64; 3] {
        value.as_ref().map_or(default, |value| {
            let each = |number| self.number(key, &Spanned::new(value.span(), number), range);
            value.as_ref().map(each)
        })
    }

    pub(crate) fn number_or(
        &mut self,
        key: &str,
        value: &Optional<f64>,
        range: &Range,
        default: f64,
    ) -> f64 {
        value
            .as_ref()
            .map_or(default, |value| self.number(key, value, range))
    }

    /// A whole number of any type that holds the range.
    pub(crate) fn whole<T: TryFrom<i64>>(
        &mut self,
        key: &str,
        value: &Spanned<i64>,
        (min, max): (i64, i64),
        help: &str,
    ) -> Option<T> {
        let number = *value.as_ref();
        let fitting = (min..=max)
            .contains(&number)
            .then(|| T::try_from(number).ok())
            .flatten();
        if fitting.is_none() {
            self.diagnostics.push(ConfigDiagnostic {
                key: key.to_owned(),
                message: format!("{key} = {number} is out of range"),
                help: Some(format!("give {min} to {max}: {help}")),
                span: Some(value.span()),
            });
        }
        fitting
    }

    /// One of the named values; the first is the default.
    pub(super) fn choice<T: Copy>(
        &mut self,
        key: &str,
        value: Optional<String>,
        known: &[(&str, T)],
    ) -> T {
        let default = known[0].1;
        let Some(value) = value else { return default };
        let found = known
            .iter()
            .find(|(name, _)| *name == value.as_ref().as_str());
        if found.is_none() {
            let list: Vec<String> = known
                .iter()
                .map(|(name, _)| format!("\"{name}\""))
                .collect();
            self.diagnostics.push(ConfigDiagnostic {
                key: key.to_owned(),
                message: format!("{key} = \"{}\" is not known", value.as_ref()),
                help: Some(format!("give {}", list.join(" or "))),
                span: Some(value.span()),
            });
        }
        found.map_or(default, |(_, value)| *value)
    }

    /// An axis by its letter, checked; the default if it is missing or not known.
    pub(super) fn named_axis(&mut self, key: &str, value: Optional<String>, default: Axis) -> Axis {
        let names = Axis::ALL.map(|axis| (axis.to_string(), axis));
        let mut known: Vec<(&str, Axis)> = names
            .iter()
            .map(|(name, axis)| (name.as_str(), *axis))
            .collect();
        // The first is the default.
        known.swap(0, default.index());
        self.choice(key, value, &known)
    }
}
