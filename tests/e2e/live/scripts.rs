//! The test of the page's scripts without a browser: that they can be read at all. One that cannot leaves the page
//! without what it does, and where no browser is installed nothing else would tell.

use std::fs;
use std::path::Path;
use std::process::Command;

use glidepath_testing::skip;

const PAGE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../crates/live/page");

/// Whether node takes it for a script, and what it says if not.
fn read(script: &Path) -> Result<(), String> {
    let said = Command::new("node").arg("--check").arg(script).output();
    let said = said.unwrap();
    let text = String::from_utf8_lossy(&said.stderr).into_owned();
    if said.status.success() {
        Ok(())
    } else {
        Err(text)
    }
}

#[test]
fn the_scripts_of_the_page_can_be_read() {
    if Command::new("node").arg("--version").output().is_err() {
        skip("scripts of the page", "node is not installed");
        return;
    }
    let index = fs::read_to_string(Path::new(PAGE).join("index.html")).unwrap();
    let names = index.split("<script src=\"").skip(1);
    let names: Vec<&str> = names.filter_map(|rest| rest.split('"').next()).collect();
    assert!(names.len() > 20, "{names:?}");
    // They share one scope: what two of them declare is an error in the second.
    let mut whole = String::new();
    for name in &names {
        let script = Path::new(PAGE).join(name);
        read(&script).unwrap_or_else(|text| panic!("{name}: {text}"));
        whole += &fs::read_to_string(&script).unwrap();
        whole += "\n";
    }
    let folder = tempfile::tempdir().unwrap();
    let together = folder.path().join("together.js");
    fs::write(&together, &whole).unwrap();
    read(&together).unwrap_or_else(|text| panic!("all scripts together: {text}"));
    // The test can fail.
    fs::write(&together, format!("{whole}\nconst text = 'the page's';")).unwrap();
    assert!(read(&together).is_err());
}
