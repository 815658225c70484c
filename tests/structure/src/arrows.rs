//! The test of arrows: which crate depends on which.
//!
//! `crates/README.md` says it in two blocks: `arrows` lists for every crate those that it uses,
//! `never` the pairs that must not know each other, with the reason.

use std::collections::{BTreeMap, BTreeSet};
use std::process::Command;

/// From a crate to those it uses.
pub(crate) type Arrows = BTreeMap<String, BTreeSet<String>>;

/// A pair that must not know each other, and why.
#[derive(Debug)]
struct Never {
    from: String,
    to: String,
    reason: String,
}

/// What Cargo knows of the packages of the workspace.
pub(crate) fn metadata() -> serde_json::Value {
    let output = Command::new(env!("CARGO"))
        .args([
            "metadata",
            "--no-deps",
            "--format-version",
            "1",
            "--offline",
        ])
        .current_dir(crate::root())
        .output()
        .expect("cargo runs");
    assert!(output.status.success(), "cargo metadata: {output:?}");
    serde_json::from_slice(&output.stdout).expect("JSON")
}

/// The arrows that Cargo sees: what is built into production, and what tests use too.
fn measured(is_wanted: impl Fn(&str) -> bool) -> Arrows {
    let metadata = metadata();
    let short = |name: &serde_json::Value| {
        let name = name.as_str().expect("a name");
        name.strip_prefix("glidepath-").unwrap_or(name).to_owned()
    };
    let packages = metadata["packages"].as_array().expect("packages");
    let packages = packages.iter().filter(|package| {
        !["tests", "structure", "testing"].contains(&short(&package["name"]).as_str())
    });
    let arrows = packages.map(|package| {
        let uses = package["dependencies"].as_array().expect("dependencies");
        let uses = uses.iter().filter(|dependency| {
            // a path: one of ours
            !dependency["path"].is_null() && is_wanted(dependency["kind"].as_str().unwrap_or(""))
        });
        (
            short(&package["name"]),
            uses.map(|used| short(&used["name"])).collect(),
        )
    });
    arrows.collect()
}

/// The lines of a fenced block of `crates/README.md`.
pub(crate) fn block(name: &str) -> Vec<String> {
    let text = std::fs::read_to_string(crate::root().join("crates/README.md")).expect("the map");
    let begin = format!("```{name}");
    let lines = text
        .lines()
        .map(str::trim)
        .skip_while(|line| *line != begin)
        .skip(1);
    let lines: Vec<_> = lines
        .take_while(|line| *line != "```")
        .map(str::to_owned)
        .collect();
    assert!(!lines.is_empty(), "crates/README.md has no block `{name}`");
    lines
}

pub(crate) fn drawn() -> Arrows {
    let arrow = |line: &String| {
        let (from, to) = line.split_once(" ->").expect("`crate -> crates it uses`");
        (
            from.trim().to_owned(),
            to.split_whitespace().map(str::to_owned).collect(),
        )
    };
    block("arrows").iter().map(arrow).collect()
}

fn forbidden() -> Vec<Never> {
    let pair = |line: &String| {
        let (from, rest) = line.split_once(" -x ").expect("`crate -x crate : reason`");
        let (to, reason) = rest.split_once(" : ").expect("`crate -x crate : reason`");
        Never {
            from: from.trim().to_owned(),
            to: to.trim().to_owned(),
            reason: reason.trim().to_owned(),
        }
    };
    block("never").iter().map(pair).collect()
}

/// All that a crate reaches, by any way.
pub(crate) fn reached<'a>(arrows: &'a Arrows, from: &'a str) -> BTreeSet<&'a str> {
    let mut found = BTreeSet::new();
    let mut open = vec![from];
    while let Some(at) = open.pop() {
        for to in arrows.get(at).into_iter().flatten() {
            if found.insert(to.as_str()) {
                open.push(to);
            }
        }
    }
    found
}

/// What is broken: pairs that must not know each other and do.
fn broken(arrows: &Arrows, never: &[Never]) -> Vec<String> {
    let breaks = |pair: &&Never| reached(arrows, &pair.from).contains(pair.to.as_str());
    let told = |pair: &Never| format!("{} reaches {}: {}", pair.from, pair.to, pair.reason);
    never.iter().filter(breaks).map(told).collect()
}

#[test]
fn crates_use_what_the_map_draws() {
    assert_eq!(
        measured(str::is_empty),
        drawn(),
        "left: Cargo.toml, right: crates/README.md"
    );
}

#[test]
fn crates_that_must_not_know_each_other_do_not() {
    let (arrows, never) = (measured(str::is_empty), forbidden());
    for pair in &never {
        assert!(
            arrows.contains_key(&pair.from),
            "no crate has the name {}",
            pair.from
        );
        assert!(
            arrows.contains_key(&pair.to),
            "no crate has the name {}",
            pair.to
        );
    }
    assert_eq!(broken(&arrows, &never), Vec::<String>::new());
}

#[test]
fn a_forbidden_arrow_is_found_however_long_its_way() {
    let (mut arrows, never) = (measured(str::is_empty), forbidden());
    for pair in &never {
        let mut detour = arrows.clone();
        detour
            .entry(pair.from.clone())
            .or_default()
            .insert("detour".to_owned());
        detour.insert("detour".to_owned(), BTreeSet::from([pair.to.clone()]));
        assert_eq!(
            broken(&detour, &never).len(),
            1.max(broken(&detour, &never).len())
        );
        assert!(!broken(&detour, &never).is_empty(), "{pair:?} is not found");
    }
    arrows.clear();
    assert!(broken(&arrows, &never).is_empty());
}
