//! The test of circles: there are none of files inside a crate.

use crate::modules::{self, Modules};
use std::fmt::Write as _;

/// A circle that stands on purpose.
struct Allowed {
    /// The crate, by its folder.
    house: &'static str,
    /// All of its files, from the crate's `src`.
    files: &'static [&'static str],
    /// Why it stands.
    reason: &'static str,
}

/// The circles that stand, each with its reason. Neither more files nor fewer: one that was opened
/// has to go from here.
const ALLOWED: &[Allowed] = &[];

/// Circles of files: those that reach each other. Each sorted, the largest first.
fn circles(modules: &Modules) -> Vec<Vec<usize>> {
    let count = modules.files.len();
    let mut reaches = vec![vec![false; count]; count];
    for (from, to) in modules.arrows.keys() {
        reaches[*from][*to] = true;
    }
    for by in 0..count {
        let onward = reaches[by].clone();
        for row in &mut reaches {
            if row[by] {
                for (reach, onward) in row.iter_mut().zip(&onward) {
                    *reach |= onward;
                }
            }
        }
    }
    let mut found: Vec<Vec<usize>> = Vec::new();
    for (file, reached) in reaches.iter().enumerate() {
        if reached[file] && !found.iter().any(|circle| circle.contains(&file)) {
            let circle = (0..count).filter(|other| reached[*other] && reaches[*other][file]);
            found.push(circle.collect());
        }
    }
    found.sort_by_key(|circle| std::cmp::Reverse(circle.len()));
    found
}

/// A circle in words: its files, and what ties them.
fn told(modules: &Modules, circle: &[usize]) -> String {
    let mut text = format!("a circle of {} files\n", circle.len());
    for ((from, to), names) in &modules.arrows {
        if circle.contains(from) && circle.contains(to) {
            let names = names.iter().cloned().collect::<Vec<_>>().join(", ");
            let (from, to) = (&modules.files[*from], &modules.files[*to]);
            let _ = writeln!(text, "  {from} -> {to}: {names}");
        }
    }
    text
}

/// Fails with every circle of a crate that is not allowed, and every allowed one that is no more.
fn judge(house: &str) {
    let modules = modules::read(&crate::root().join(format!("crates/{house}/src/lib.rs")));
    assert!(modules.files.len() > 1, "{house}: no modules were found");
    let names = |circle: &[usize]| {
        let mut names: Vec<_> = circle
            .iter()
            .map(|file| modules.files[*file].as_str())
            .collect();
        names.sort_unstable();
        names
    };
    let found = circles(&modules);
    let is_allowed = |allowed: &Allowed, circle: &[usize]| {
        let mut files = allowed.files.to_vec();
        files.sort_unstable();
        allowed.house == house && files == names(circle)
    };
    let mut text = String::new();
    for circle in &found {
        if !ALLOWED.iter().any(|allowed| is_allowed(allowed, circle)) {
            text.push_str(&told(&modules, circle));
        }
    }
    for allowed in ALLOWED.iter().filter(|allowed| allowed.house == house) {
        if !found.iter().any(|circle| is_allowed(allowed, circle)) {
            let _ = writeln!(text, "no more, take it off the list: {}", allowed.reason);
        }
    }
    assert!(text.is_empty(), "crates/{house}/src:\n{text}");
}

macro_rules! houses {
    ($($test:ident: $house:literal,)*) => {
        $(#[test]
        fn $test() {
            judge($house);
        })*

        #[test]
        fn every_crate_is_judged() {
            let folders = std::fs::read_dir(crate::root().join("crates")).expect("the crates");
            let folders = folders.map(|entry| entry.expect("a folder").path());
            let mut folders: Vec<_> = folders.filter(|path| path.join("Cargo.toml").exists()).collect();
            folders.sort();
            let mut judged = vec![$($house),*];
            judged.sort_unstable();
            let found: Vec<_> = folders.iter().filter_map(|path| path.file_name()?.to_str()).collect();
            assert_eq!(found, judged);
        }
    };
}

houses! {
    audit: "audit",
    capi: "capi",
    curve: "curve",
    emulator: "emulator",
    ethercat: "ethercat",
    fit: "fit",
    gcode: "gcode",
    geometry: "geometry",
    grbl: "grbl",
    glidepath: "glidepath",
    hal: "hal",
    interpolator: "interpolator",
    persistence: "persistence",
    kinematics: "kinematics",
    link: "link",
    live: "live",
    migration: "migration",
    motion: "motion",
    planner: "planner",
    plant: "plant",
    program: "program",
    realtime: "realtime",
    recording: "recording",
    telemetry: "telemetry",
}

#[test]
fn planted_circles_are_found() {
    let folder = tempfile::tempdir().expect("a folder");
    let write = |name: &str, text: &str| {
        let path = folder.path().join(name);
        std::fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
        std::fs::write(path, text).expect("a file");
    };
    write(
        "lib.rs",
        "mod a; mod b; mod c; mod d; pub use a::A; pub(crate) use c::C;",
    );
    write("a.rs", "use crate::b::B; pub struct A(B);");
    // by way of the facade
    write(
        "b/mod.rs",
        "mod deep; pub struct B; #[cfg(test)] mod tests { use crate::d::f; }",
    );
    write(
        "b/deep.rs",
        "use super::B; fn g() -> B { println!(\"{}\", crate::c::h()); B }",
    );
    write(
        "c.rs",
        "pub struct C; pub fn h() -> u8 { 1 } fn k(_: super::A) {}",
    );
    write("d.rs", "use crate::{A, C}; pub fn f(_: A, _: C) {}");
    let found = modules::read(&folder.path().join("lib.rs"));
    assert!(circles(&found).is_empty(), "{found:?}");
    assert_eq!(found.arrows.len(), 6, "{:?}", found.arrows);

    write("b/mod.rs", "mod deep; pub struct B; fn f() { deep::g(); }");
    let found = modules::read(&folder.path().join("lib.rs"));
    let circle = circles(&found);
    // mod.rs uses its child, which goes on to c.rs, from there by the facade to a.rs, and back
    assert_eq!(circle.len(), 1, "{:?}", found.arrows);
    assert_eq!(circle[0].len(), 4, "{}", told(&found, &circle[0]));
}
