//! The test of links: those within the repository lead to what is there: to a file, and to a
//! heading of it.

use crate::root;
use std::path::{Path, PathBuf};

fn pages() -> Vec<PathBuf> {
    let mut pages: Vec<PathBuf> = [
        "README.md",
        ".github/CONTRIBUTING.md",
        "crates/README.md",
        "crates/glidepath/CHANGELOG.md",
    ]
    .map(|page| root().join(page))
    .into();
    let manual = std::fs::read_dir(root().join("crates/glidepath/docs")).expect("the manual");
    pages.extend(manual.map(|page| page.expect("a page").path()));
    pages.retain(|page| page.extension().is_some_and(|ending| ending == "md"));
    pages.sort();
    pages
}

/// A page without its blocks of code.
fn text(page: &Path) -> String {
    let text = std::fs::read_to_string(page).expect("a page");
    let parts = text.split("\n```").step_by(2);
    parts.collect::<Vec<_>>().join("\n")
}

/// What follows `](`, up to its bracket.
fn targets(text: &str) -> impl Iterator<Item = &str> {
    let behind = text.split("](").skip(1);
    behind.filter_map(|behind| behind.split_once(')').map(|(target, _)| target))
}

/// The name by which a heading is linked to.
fn slug(heading: &str) -> String {
    let words = heading.trim_start_matches('#').trim().to_lowercase();
    let kept = words
        .chars()
        .filter(|letter| letter.is_alphanumeric() || " -_".contains(*letter));
    kept.map(|letter| if letter == ' ' { '-' } else { letter })
        .collect()
}

fn has_heading(page: &Path, name: &str) -> bool {
    let text = text(page);
    let mut headings = text.lines().filter(|line| line.starts_with('#'));
    headings.any(|heading| slug(heading) == name)
}

#[test]
fn links_lead_to_what_is_there() {
    let mut dead = Vec::new();
    let mut count = 0;
    for page in pages() {
        let text = text(&page);
        for target in targets(&text).filter(|target| !target.starts_with("http")) {
            count += 1;
            let (file, heading) = target.split_once('#').unwrap_or((target, ""));
            let to = if file.is_empty() {
                page.clone()
            } else {
                page.with_file_name("").join(file)
            };
            let is_page = to.extension().is_some_and(|ending| ending == "md");
            let is_there =
                to.exists() && (heading.is_empty() || !is_page || has_heading(&to, heading));
            if !is_there {
                dead.push(format!("{}: {target}", page.display()));
            }
        }
    }
    assert!(dead.is_empty(), "{}", dead.join("\n"));
    assert!(count > 300, "the links are not found: {count}");
}

#[test]
fn a_heading_is_named_as_pages_name_it() {
    assert_eq!(
        slug("## Feed, velocity: `acc_1` (1/s)"),
        "feed-velocity-acc_1-1s"
    );
    assert_eq!(targets("[a](b#c) d](e").collect::<Vec<_>>(), ["b#c"]);
    assert!(!has_heading(&root().join("README.md"), "no-such-heading"));
}
