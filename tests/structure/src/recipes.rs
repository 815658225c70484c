//! The test of the recipes in the page for contributors: what they name is there. A link to a file says where; a
//! name in the same step stands in that file, a file without a link beside it. Commands name packages, targets and
//! tests that there are.

use crate::arrows::metadata;
use crate::root;
use std::cell::OnceCell;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

const PAGE: &str = ".github/CONTRIBUTING.md";

fn page() -> String {
    std::fs::read_to_string(root().join(PAGE)).expect("the page")
}

/// The steps of all recipes: paragraphs, and items of lists.
fn steps(page: &str) -> Vec<String> {
    let sections = page.split("\n## ").skip(1);
    let recipes = sections.filter(|it| it.starts_with("Adding ") || it.starts_with("Changing "));
    let mut steps = vec![String::new()];
    for line in recipes.flat_map(str::lines) {
        let begins = line.starts_with(|c: char| c.is_ascii_digit() || c == '|');
        if begins || line.is_empty() {
            steps.push(String::new());
        }
        let step = steps.last_mut().expect("there is one");
        step.push_str(line);
        step.push('\n');
    }
    steps.retain(|step| !step.trim().is_empty());
    steps
}

/// What stands in code marks: by itself, and as links with where they lead.
fn marked(step: &str) -> (Vec<String>, Vec<(String, String)>) {
    let (mut names, mut links) = (Vec::new(), Vec::new());
    let mut parts = step.split('`');
    while let (Some(before), Some(name)) = (parts.next(), parts.next()) {
        let behind = parts.clone().next().unwrap_or_default();
        let target = behind.strip_prefix("](").filter(|_| before.ends_with('['));
        match target.and_then(|target| target.split_once(')')) {
            Some((target, _)) => links.push((name.to_owned(), target.to_owned())),
            None => names.push(name.to_owned()),
        }
    }
    (names, links)
}

/// Every file of a folder, or a file by itself.
fn files(path: &Path, found: &mut Vec<PathBuf>) {
    if !path.is_dir() {
        found.push(path.to_path_buf());
        return;
    }
    for entry in std::fs::read_dir(path).expect("a folder") {
        let entry = entry.expect("an entry").path();
        if !entry.ends_with("target") {
            files(&entry, found);
        }
    }
}

fn is_of_name(letter: char) -> bool {
    letter.is_alphanumeric() || letter == '_'
}

/// The last part of a name in a program: `b` of `a::b`, `each` of `each!`; of nothing else.
fn last_part(name: &str) -> Option<&str> {
    let last = name.rsplit("::").next()?.trim_end_matches('!');
    let is_path = name.split("::").all(|part| {
        let part = part.trim_end_matches('!');
        part.starts_with(|c: char| c.is_ascii_alphabetic()) && part.chars().all(is_of_name)
    });
    is_path.then_some(last)
}

/// What a step names that is not where it says.
fn missing_in(step: &str) -> Vec<String> {
    let (names, links) = marked(step);
    let mut missing = Vec::new();
    let (mut there, mut beside) = (Vec::new(), Vec::new());
    for (name, target) in &links {
        let file = target.split('#').next().unwrap_or_default();
        if (name.contains('/') || name.ends_with(".rs")) && !file.ends_with(name.as_str()) {
            missing.push(format!("{name} leads to {target}"));
        }
        let path = root().join(".github").join(file);
        if path.exists() {
            files(&path, &mut there);
            beside.extend(path.parent().map(Path::to_path_buf));
            beside.push(path);
        }
    }
    let texts = there.iter().map(std::fs::read_to_string);
    let texts: Vec<String> = texts.filter_map(Result::ok).collect();
    let words = texts.iter().flat_map(|text| text.split(|c| !is_of_name(c)));
    let words: BTreeSet<&str> = words.collect();
    for name in &names {
        let is_there = match last_part(name) {
            Some(last) => words.contains(last),
            None if name.ends_with(".rs") => beside.iter().any(|path| path.join(name).exists()),
            None => true,
        };
        if !is_there {
            missing.push(format!("{name} is in none of the files that this links to"));
        }
    }
    missing
}

#[test]
fn recipes_name_what_is_there() {
    let steps = steps(&page());
    assert!(steps.len() > 50, "{}", steps.len());
    let missing = steps.iter().flat_map(|step| {
        let head: String = step.chars().take(60).collect();
        missing_in(step)
            .into_iter()
            .map(move |it| format!("{it}: {head:?}"))
    });
    let missing: Vec<String> = missing.collect();
    assert!(missing.is_empty(), "{}", missing.join("\n"));
}

#[test]
fn what_a_recipe_names_wrongly_is_found() {
    let file = "[`tests/structure/src/lib.rs`](../tests/structure/src/lib.rs)";
    let told = |text: &str| missing_in(&format!("{file}: {text}")).len();
    assert_eq!(
        told("`root`, `links.rs`, `crate::root`, `--flag`, `a b`"),
        0
    );
    assert_eq!(told("`no_such_function`"), 1);
    assert_eq!(told("`no_such_file.rs`"), 1);
    assert_eq!(told("[`other.rs`](../tests/structure/src/names.rs)"), 1);
}

/// A package: its folder, its targets, and its functions and modules.
struct Package {
    folder: PathBuf,
    targets: BTreeSet<String>,
    names: OnceCell<BTreeSet<String>>,
}

fn packages() -> BTreeMap<String, Package> {
    let metadata = metadata();
    let text = |value: &serde_json::Value| value.as_str().expect("a text").to_owned();
    let packages = metadata["packages"].as_array().expect("packages");
    let packages = packages.iter().map(|package| {
        let manifest = PathBuf::from(text(&package["manifest_path"]));
        let folder = manifest.parent().expect("its folder").to_path_buf();
        let targets = package["targets"].as_array().expect("targets");
        let targets = targets.iter().map(|target| text(&target["name"])).collect();
        (
            text(&package["name"]),
            Package {
                folder,
                targets,
                names: OnceCell::new(),
            },
        )
    });
    packages.collect()
}

/// The functions and modules that the sources of a folder have.
fn names(folder: &Path) -> BTreeSet<String> {
    let mut sources = Vec::new();
    files(folder, &mut sources);
    sources.retain(|file| file.extension().is_some_and(|ending| ending == "rs"));
    let texts = sources
        .iter()
        .filter_map(|file| std::fs::read_to_string(file).ok());
    let of_text = |text: String| -> Vec<String> {
        let behind = text.split("fn ").skip(1).chain(text.split("mod ").skip(1));
        let name = |rest: &str| rest.split(|c| !is_of_name(c)).next().map(str::to_owned);
        behind.filter_map(name).collect()
    };
    texts.flat_map(of_text).collect()
}

/// Commands of cargo on a page, up to what they hand on.
fn commands(page: &str) -> Vec<String> {
    let page = page.replace("\\\n", " ");
    let spans = page.split(['`', '\n']).filter_map(|text| {
        let at = text.find("cargo ")?;
        let text = text[at..].split(" -- ").next()?.split(['#', '&']).next()?;
        text.contains(" -p ").then(|| text.trim().to_owned())
    });
    spans.collect()
}

/// What of a command there is not.
fn wrong_with(command: &str, packages: &BTreeMap<String, Package>) -> Option<String> {
    let words = command.split_whitespace().skip(1);
    let mut words = words.skip_while(|word| word.starts_with('+')).skip(1);
    let (mut package, mut target, mut tests) = (None, None, Vec::new());
    while let Some(word) = words.next() {
        match word {
            "-p" => package = words.next(),
            "--test" | "--example" => target = words.next(),
            "--target" | "--target-dir" => drop(words.next()),
            _ if word.starts_with('-') => {}
            _ => tests.push(word),
        }
    }
    let Some(package) = packages.get(package?) else {
        return Some(format!("no package: {command}"));
    };
    if target.is_some_and(|target| !package.targets.contains(target)) {
        return Some(format!("no target: {command}"));
    }
    let names = package.names.get_or_init(|| names(&package.folder));
    let is_named = |part: &str| names.iter().any(|name| name.contains(part));
    let mut parts = tests.iter().flat_map(|test| test.split("::"));
    let forgotten = parts.find(|part| !is_named(part));
    forgotten.map(|part| format!("no test or module {part}: {command}"))
}

#[test]
fn commands_name_what_is_there() {
    let (commands, packages) = (commands(&page()), packages());
    assert!(commands.len() > 40, "{}", commands.len());
    let wrong = commands
        .iter()
        .filter_map(|command| wrong_with(command, &packages));
    let wrong: Vec<String> = wrong.collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn what_a_command_names_wrongly_is_found() {
    let packages = packages();
    let told = |rest: &str| wrong_with(&format!("cargo test {rest}"), &packages);
    assert_eq!(told("-p glidepath-structure recipes::commands_name"), None);
    assert_eq!(told("--release -p glidepath-tests --test e2e"), None);
    assert!(told("-p glidepath-nobody").is_some());
    assert!(told("-p glidepath-tests --test nothing").is_some());
    assert!(told("-p glidepath-structure no_such_test").is_some());
}
