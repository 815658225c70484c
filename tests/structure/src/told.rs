//! The test of what people are told: no name of a variant as Rust derives it, and no state or
//! command for which a text was forgotten.

use crate::modules::is_test;
use std::path::{Path, PathBuf};
use syn::visit::{self, Visit};

/// Where a value is written as Rust derives it, and why nobody is told so: a file below `crates`, and
/// the reason.
const DERIVED: &[(&str, &str)] = &[
    (
        "capi/src/layout/codes.rs",
        "names of variants become names of the header",
    ),
    (
        "glidepath/src/curve_file/write.rs",
        "the shortest number that reads back",
    ),
    (
        "glidepath/src/command/setup/text.rs",
        "numbers as TOML has them: with their point, and shortest",
    ),
    (
        "migration/src/draft.rs",
        "the shortest number that reads back",
    ),
];

/// Enums of which every value is considered wherever one is.
const WHOLE: &[&str] = &[
    "Command",
    "CommandKind",
    "CommandRefusal",
    "EndOfEpoch",
    "FaultCause",
    "FrameRefusal",
    "JobState",
    "MachineState",
    "MotionMode",
    "SegmentRefusal",
];

/// Whether a text in tokens asks for the derived form: `{:?}`, `{name:?}`, `{:#?}`.
fn is_derived(tokens: &str) -> bool {
    let text = tokens.replace("{{", "");
    let mut places = text.split('{').skip(1);
    places.any(|rest| {
        let place = rest.split('}').next().unwrap_or_default();
        place
            .split_once(':')
            .is_some_and(|(_, form)| form.ends_with('?'))
    })
}

/// What a file tells people badly.
#[derive(Debug, Default)]
struct Reader {
    derived: Vec<String>,
    forgetful: Vec<String>,
}

impl Reader {
    fn look(&mut self, tokens: &impl ToString) {
        let text = tokens.to_string();
        if is_derived(&text) {
            self.derived.push(text);
        }
    }
}

impl<'ast> Visit<'ast> for Reader {
    fn visit_item(&mut self, item: &'ast syn::Item) {
        let attributes = match item {
            syn::Item::Mod(item) => &item.attrs,
            syn::Item::Fn(item) => &item.attrs,
            syn::Item::Impl(item) => &item.attrs,
            _ => &Vec::new(),
        };
        if !is_test(attributes) {
            visit::visit_item(self, item);
        }
    }

    fn visit_attribute(&mut self, attribute: &'ast syn::Attribute) {
        if attribute.path().is_ident("error") {
            let list = attribute.meta.require_list();
            self.look(&list.expect("error(…)").tokens);
        }
    }

    fn visit_macro(&mut self, called: &'ast syn::Macro) {
        let name = called.path.segments.last().map(|it| it.ident.to_string());
        let is_for_developers = name.is_some_and(|name| {
            name.starts_with("assert") || name.starts_with("debug_assert") || name == "panic"
        });
        if !is_for_developers {
            self.look(&called.tokens);
        }
    }

    fn visit_expr_match(&mut self, matched: &'ast syn::ExprMatch) {
        let names = matched.arms.iter().flat_map(|arm| whole_in(&arm.pat));
        let mut names: Vec<String> = names.collect();
        names.dedup();
        let takes_the_rest = matched.arms.iter().any(|arm| {
            let is_any = matches!(&arm.pat, syn::Pat::Wild(_))
                || matches!(&arm.pat, syn::Pat::Ident(it) if it.subpat.is_none() && is_a_name(it));
            is_any && arm.guard.is_none()
        });
        if takes_the_rest && let Some(name) = names.first() {
            self.forgetful.push(name.clone());
        }
        visit::visit_expr_match(self, matched);
    }
}

/// A small letter begins a binding, a capital a constant.
fn is_a_name(pattern: &syn::PatIdent) -> bool {
    let name = pattern.ident.to_string();
    name.starts_with(|c: char| c.is_lowercase())
}

/// The enums of [`WHOLE`] of which a pattern names a value.
fn whole_in(pattern: &syn::Pat) -> Vec<String> {
    struct Paths(Vec<String>);
    impl<'ast> Visit<'ast> for Paths {
        fn visit_path(&mut self, path: &'ast syn::Path) {
            let mut segments = path.segments.iter().rev().skip(1);
            if let Some(of) = segments.next().map(|it| it.ident.to_string())
                && WHOLE.contains(&of.as_str())
            {
                self.0.push(of);
            }
        }
    }
    let mut paths = Paths(Vec::new());
    paths.visit_pat(pattern);
    paths.0
}

fn read(text: &str) -> Reader {
    let syntax = syn::parse_file(text).expect("Rust");
    let mut reader = Reader::default();
    reader.visit_file(&syntax);
    reader
}

/// The sources of a folder, without those that only tests have.
pub(crate) fn sources(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        let is_of_tests = matches!(&*name, "tests" | "tests.rs" | "testing" | "testing.rs");
        if is_of_tests {
            continue;
        }
        if path.is_dir() {
            sources(&path, found);
        } else if path.extension().is_some_and(|ending| ending == "rs") {
            found.push(path);
        }
    }
}

/// Every source of the house that is in production, by its place below `crates`.
fn house() -> Vec<(String, Reader)> {
    let crates = crate::root().join("crates");
    let mut found = Vec::new();
    for krate in std::fs::read_dir(&crates).expect("the crates") {
        let folder = krate.expect("an entry").path().join("src");
        if folder.is_dir() {
            sources(&folder, &mut found);
        }
    }
    let name = |path: &Path| {
        let name = path.strip_prefix(&crates).expect("below the crates");
        name.display().to_string()
    };
    let read = |path: PathBuf| {
        let text = std::fs::read_to_string(&path).expect("UTF-8");
        (name(&path), read(&text))
    };
    found.into_iter().map(read).collect()
}

#[test]
fn nobody_is_told_the_name_of_a_variant() {
    let house = house();
    assert!(house.len() > 500, "{}", house.len());
    let is_allowed = |name: &str| DERIVED.iter().any(|(file, _)| *file == name);
    let told: Vec<_> = house
        .iter()
        .filter(|(name, reader)| !reader.derived.is_empty() && !is_allowed(name))
        .map(|(name, reader)| (name, &reader.derived))
        .collect();
    assert!(told.is_empty(), "{told:#?}");
    for (file, reason) in DERIVED {
        let stands = house
            .iter()
            .any(|(name, reader)| name == file && !reader.derived.is_empty());
        assert!(stands, "{file} has none any more ({reason}): take it off");
    }
}

#[test]
fn no_command_and_no_state_is_forgotten() {
    let told: Vec<_> = house()
        .into_iter()
        .filter(|(_, reader)| !reader.forgetful.is_empty())
        .map(|(name, reader)| (name, reader.forgetful))
        .collect();
    assert!(told.is_empty(), "name every value: {told:#?}");
}

#[test]
fn what_is_looked_for_is_found() {
    let reader = read(
        r#"
        #[error("refused: {refusal:?}")]
        struct Refused;
        fn tell(state: MachineState) -> String {
            match state {
                MachineState::Idle => format!("{state:#?}"),
                Some(state) if state == 1 => String::new(),
                _ => format!("{} {{:?}}", one(format!("{:.3?}", 2))),
            }
        }
        fn rest(command: Option<link::Command>) {
            match command {
                Some(link::Command::Hold) => {}
                other => drop(other),
            }
        }
        fn whole(state: MachineState) -> u8 {
            assert!(true, "{state:?}");
            match state {
                MachineState::Idle => 1,
                MachineState::Off => 2,
            }
        }
        #[cfg(test)]
        mod tests {
            fn shown() { println!("{:?}", 1); }
        }
        "#,
    );
    assert_eq!(reader.derived.len(), 3, "{reader:?}");
    assert_eq!(reader.forgetful, ["MachineState", "Command"]);
}
