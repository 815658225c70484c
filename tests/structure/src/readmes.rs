//! The test of what a registry shows of a crate: `README.md`, made from the crate's own
//! documentation.
//!
//! `GLIDEPATH_BLESS=1 cargo test -p glidepath-structure readmes` writes them.

use crate::root;
use std::path::Path;

const PLACE: &str = "https://github.com/glidepath/glidepath";

/// A value of a manifest, as it is in the package's own table.
fn value(manifest: &str, key: &str) -> String {
    let mut lines = manifest
        .lines()
        .filter_map(|line| line.strip_prefix(key)?.strip_prefix(" = "));
    lines.next().expect("the key").trim_matches('"').to_owned()
}

/// The documentation of a crate as a page by itself: no lines that rustdoc hides, and no links that
/// only rustdoc knows.
fn page(documentation: &str) -> String {
    let mut text = String::new();
    let mut code = None;
    for line in documentation
        .lines()
        .map_while(|line| line.strip_prefix("//!"))
    {
        let line = line.strip_prefix(' ').unwrap_or(line);
        if let Some(kind) = line.strip_prefix("```") {
            let is_rust = matches!(kind, "" | "no_run" | "rust");
            let opens = code.is_none();
            code = opens.then_some(is_rust);
            text.push_str(if opens && is_rust { "```rust" } else { line });
        } else if code == Some(true) && (line == "#" || line.starts_with("# ")) {
            continue;
        } else if code.is_some() {
            text.push_str(line);
        } else {
            text.push_str(&without_links(line));
        }
        text.push('\n');
    }
    text
}

/// Links whose target is no address are those of rustdoc: their text is left.
fn without_links(line: &str) -> String {
    let mut text = String::new();
    let mut rest = line;
    while let Some((before, link)) = rest.split_once('[') {
        text.push_str(before);
        let Some((words, behind)) = link.split_once(']') else {
            text.push('[');
            rest = link;
            continue;
        };
        rest = match behind
            .strip_prefix('(')
            .and_then(|target| target.split_once(')'))
        {
            Some((target, behind)) if target.starts_with("http") => {
                text.push_str(&format!("[{words}]({target})"));
                behind
            }
            Some((_, behind)) => {
                text.push_str(words);
                behind
            }
            None if words.starts_with('`') => {
                text.push_str(words);
                behind
            }
            None => {
                text.push_str(&format!("[{words}]"));
                behind
            }
        };
    }
    text + rest
}

fn readme(folder: &Path) -> String {
    let read =
        |name: &str| std::fs::read_to_string(folder.join(name)).expect("a file of the crate");
    let manifest = read("Cargo.toml");
    format!(
        "# {}\n\n{}.\n\nPart of [Glidepath]({PLACE}), a hard-real-time toolpath\n\
         interpolator.\n\n{}\n\
         ## Licence\n\nMIT or Apache-2.0, as you like.\n",
        value(&manifest, "name"),
        value(&manifest, "description"),
        page(&read("src/lib.rs")).trim_end().to_owned() + "\n"
    )
}

#[test]
fn every_crate_has_a_page_that_says_what_its_documentation_says() {
    for entry in std::fs::read_dir(root().join("crates")).expect("the crates") {
        let folder = entry.expect("a folder").path();
        if !folder.join("Cargo.toml").exists() {
            continue;
        }
        let (place, expected) = (folder.join("README.md"), readme(&folder));
        if std::env::var_os("GLIDEPATH_BLESS").is_some() {
            std::fs::write(&place, &expected).expect("a file that can be written");
        }
        let actual = std::fs::read_to_string(&place).unwrap_or_default();
        assert!(
            actual == expected,
            "{} is not what the crate's documentation says: write it with GLIDEPATH_BLESS=1 \
             cargo test -p glidepath-structure readmes",
            place.display()
        );
    }
}

#[test]
fn links_of_rustdoc_become_words() {
    for (line, expected) in [
        (
            "as [`Kept`] and [the rest](crate::x) are",
            "as `Kept` and the rest are",
        ),
        (
            "[MCAP](https://mcap.dev) [1]",
            "[MCAP](https://mcap.dev) [1]",
        ),
        ("a[", "a["),
    ] {
        assert_eq!(without_links(line), expected);
    }
}
