//! The table of all keys of the configuration: what `glidepath config --explain` prints.
//!
//! The table says what the loader does, and `tests/it/keys.rs` holds it against the loader: a key that
//! one of the two does not have, a range, a list of names or a default that is another there fails
//! the test.

mod adaptive_feed;
mod compensation;
mod cross_compensation;
mod example;
mod key;
mod mechanisms;
mod probing;
mod programs;
mod spindle;
mod stops;
mod superposition;
mod tables;

pub use example::example;
pub use key::{Key, LeftOut, Takes};

/// Every key, in the order of the tables of a file.
pub fn all() -> impl Iterator<Item = &'static Key> {
    let tables = [
        tables::MACHINE,
        tables::AXIS,
        tables::JOINT,
        tables::HOME,
        compensation::COMPENSATION,
        cross_compensation::SQUARENESS,
        cross_compensation::STRAIGHTNESS,
        tables::PATH,
        tables::INTERPOLATOR,
        tables::JOG,
        tables::FEEDBACK,
        probing::PROBE,
        spindle::SPINDLE,
        adaptive_feed::ADAPTIVE_FEED,
        superposition::SUPERPOSITION,
        programs::LINK,
        programs::PROGRAM,
        programs::M_CODES,
        stops::STOPS,
        programs::PREVIEW,
        programs::STATE,
    ];
    tables
        .into_iter()
        .chain(mechanisms::TABLES)
        .flat_map(|table| table.iter())
}

/// The keys that a name asks for: a key itself, all keys of a table, or all with such a last part.
/// Every axis and every joint can be asked for. None: there is no such key.
#[must_use]
pub fn asked(name: &str) -> Vec<&'static Key> {
    let general = general(name);
    let is_of_table = |key: &&Key| {
        key.name
            .strip_prefix(general.as_str())
            .is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
    };
    let found: Vec<_> = all().filter(is_of_table).collect();
    if !found.is_empty() {
        return found;
    }
    all()
        .filter(|key| key.name.rsplit('.').next() == Some(name))
        .collect()
}

/// The key of that name, of any axis or joint.
pub(super) fn known(name: &str) -> Option<&'static Key> {
    let general = general(name);
    all().find(|key| key.name == general)
}

/// The known name that is most like one that is not known.
#[must_use]
pub fn nearest(name: &str) -> Option<&'static str> {
    let general = general(name);
    let likeness = |known: &str| {
        let last = known.rsplit('.').next().unwrap_or(known);
        strsim::jaro_winkler(&general, known).max(strsim::jaro_winkler(&general, last))
    };
    all()
        .map(|key| (likeness(key.name), key.name))
        .filter(|(likeness, _)| *likeness > 0.75)
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, name)| name)
}

/// A name with the axis and the joint that stand for all of them in the table.
fn general(name: &str) -> String {
    let mut parts: Vec<&str> = name.split('.').collect();
    match parts.as_mut_slice() {
        ["axis", axis, ..] if axis.len() == 1 && "XYZABCUVW".contains(*axis) => *axis = "X",
        ["joint" | "home" | "compensation", joint, ..] if is_joint(joint) => *joint = "J0",
        ["straightness", pair, ..] if is_pair(pair) => *pair = "ZX",
        ["m_codes", code, ..] if code.starts_with('M') => *code = "M6",
        _ => {}
    }
    parts.join(".")
}

fn is_pair(name: &str) -> bool {
    name.len() == 2 && name.chars().all(|axis| "XYZABCUVW".contains(axis))
}

fn is_joint(name: &str) -> bool {
    name.strip_prefix('J')
        .is_some_and(|number| number.len() == 1 && number.bytes().all(|b| b.is_ascii_digit()))
}
