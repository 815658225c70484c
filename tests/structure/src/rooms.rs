//! The test of rooms: which folder of a crate may import which.
//!
//! The block `rooms` of `crates/README.md` lists for every room of a crate those that it imports.
//! What only tests import does not count (`modules` reads the imports).

use crate::arrows::{self, Arrows};
use crate::modules;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// Files that are in no room: of every crate its facade, and of some what only their tests share.
const IN_NO_ROOM: &[(&str, &[&str])] = &[
    ("interpolator", &["lib.rs", "testing.rs"]),
    ("planner", &["lib.rs"]),
];

/// The rooms of each crate that has some, with those that each imports.
fn drawn() -> BTreeMap<String, Arrows> {
    let mut houses: BTreeMap<String, Arrows> = BTreeMap::new();
    for line in arrows::block("rooms") {
        let parts = line
            .split_once(" ->")
            .and_then(|(from, to)| Some((from.split_once('/')?, to)));
        let ((house, room), to) = parts.expect("`crate/room -> rooms it imports`");
        let to = to.split_whitespace().map(str::to_owned).collect();
        let rooms = houses.entry(house.to_owned()).or_default();
        let before = rooms.insert(room.to_owned(), to);
        assert!(before.is_none(), "{house}/{room} is drawn twice");
    }
    houses
}

/// The room of a file, by its path from `src`; a file in no room is one by itself.
fn room_of(file: &str) -> &str {
    file.split_once('/').map_or(file, |(room, _)| room)
}

/// What is in `src` and in no room, and what of `in_no_room` is not there.
fn misplaced(source: &Path, rooms: &Arrows, in_no_room: &[&str]) -> Vec<String> {
    let entries = std::fs::read_dir(source).expect("the source");
    let entries = entries.map(|entry| entry.expect("an entry").file_name());
    let found: BTreeSet<_> = entries
        .map(|name| name.into_string().expect("a name"))
        .collect();
    let known: BTreeSet<String> = rooms
        .keys()
        .cloned()
        .chain(in_no_room.iter().map(|file| (*file).to_owned()))
        .collect();
    let beside = found.difference(&known).map(|name| {
        format!("{name} is in no room: move it into one, or draw the room in crates/README.md")
    });
    let missing = known
        .difference(&found)
        .map(|name| format!("{name} is not there"));
    beside.chain(missing).collect()
}

/// What is imported against the arrows, and the arrows by which nothing is imported.
fn against(source: &Path, rooms: &Arrows) -> Vec<String> {
    let modules = modules::read(&source.join("lib.rs"));
    let mut complaints = Vec::new();
    let mut used = BTreeSet::new();
    for ((from, to), names) in &modules.arrows {
        let (from, to) = (&modules.files[*from], &modules.files[*to]);
        let ends = (room_of(from), room_of(to));
        let is_drawn = || rooms.get(ends.0).is_some_and(|to| to.contains(ends.1));
        if ends.0 == ends.1 {
            continue;
        } else if is_drawn() {
            used.insert(ends);
        } else {
            let names = names.iter().cloned().collect::<Vec<_>>().join(", ");
            let (room, other) = ends;
            complaints.push(format!(
                "{room} may not import {other}: {from} -> {to}: {names}"
            ));
        }
    }
    for (from, drawn) in rooms {
        for to in drawn {
            if !used.contains(&(from.as_str(), to.as_str())) {
                complaints.push(format!("nothing in {from} imports {to}: take it off"));
            }
        }
    }
    complaints
}

/// Rooms that reach themselves by what is drawn.
fn in_circles(rooms: &Arrows) -> Vec<String> {
    let reaches_itself =
        |room: &&String| arrows::reached(rooms, room.as_str()).contains(room.as_str());
    let told = |room: &String| format!("{room} reaches itself");
    rooms.keys().filter(reaches_itself).map(told).collect()
}

fn judge(house: &str) {
    let houses = drawn();
    let rooms = houses.get(house).expect("its rooms in crates/README.md");
    let listed = IN_NO_ROOM.iter().find(|(name, _)| *name == house);
    let (_, in_no_room) = listed.expect("the files that are in no room");
    let source = crate::root().join(format!("crates/{house}/src"));
    let mut complaints = in_circles(rooms);
    complaints.extend(misplaced(&source, rooms, in_no_room));
    complaints.extend(against(&source, rooms));
    let complaints = complaints.join("\n");
    assert!(complaints.is_empty(), "crates/{house}/src:\n{complaints}");
}

#[test]
fn rooms_of_the_interpolator_import_what_the_map_draws() {
    judge("interpolator");
}

#[test]
fn rooms_of_the_planner_import_what_the_map_draws() {
    judge("planner");
}

#[test]
fn every_crate_with_rooms_is_judged() {
    let houses = drawn();
    let drawn: BTreeSet<_> = houses.keys().map(String::as_str).collect();
    let judged = IN_NO_ROOM.iter().map(|(house, _)| *house).collect();
    assert_eq!(drawn, judged);
}

/// A crate whose room `low` imports `high` in the way given, with what else lies in its `src`.
fn planted(import: &str, beside: &[&str]) -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    let write = |name: &str, text: &str| {
        let path = folder.path().join(name);
        std::fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
        std::fs::write(path, text).expect("a file");
    };
    let facade = "mod high; mod low; pub use high::a::A; pub use low::b::B;";
    write("lib.rs", facade);
    write("high/mod.rs", "pub(crate) mod a;");
    write("high/a.rs", "use crate::low::b::B; pub struct A(B);");
    write("low/mod.rs", "pub(crate) mod b;");
    let of_tests = "#[cfg(test)] mod tests { use crate::high::a::A; }";
    write("low/b.rs", &format!("{import} pub struct B; {of_tests}"));
    for name in beside {
        write(name, "");
    }
    folder
}

fn two_rooms() -> Arrows {
    let low = ("low".to_owned(), BTreeSet::new());
    let high = ("high".to_owned(), BTreeSet::from(["low".to_owned()]));
    Arrows::from([low, high])
}

#[test]
fn planted_imports_against_the_arrows_are_found() {
    let clean = planted("", &[]);
    assert_eq!(against(clean.path(), &two_rooms()), Vec::<String>::new());
    for import in [
        "use crate::high::a::A;",
        "use super::super::high::a::A;",
        "use crate::A;",
        "fn f() { let _ = crate::high::a::A::new(); }",
    ] {
        let folder = planted(import, &[]);
        let found = against(folder.path(), &two_rooms());
        assert_eq!(found.len(), 1, "{import}: {found:?}");
        assert!(
            found[0].starts_with("low may not import high: low/b.rs -> high/a.rs"),
            "{import}: {found:?}"
        );
    }
}

#[test]
fn an_arrow_that_nothing_uses_is_found() {
    let clean = planted("", &[]);
    let mut rooms = two_rooms();
    rooms
        .entry("low".to_owned())
        .or_default()
        .insert("high".to_owned());
    let found = against(clean.path(), &rooms);
    assert_eq!(found, ["nothing in low imports high: take it off"]);
    assert_eq!(in_circles(&rooms).len(), 2);
    assert!(in_circles(&two_rooms()).is_empty());
}

#[test]
fn what_is_in_no_room_is_found() {
    let clean = planted("", &[]);
    let found = misplaced(clean.path(), &two_rooms(), &["lib.rs"]);
    assert_eq!(found, Vec::<String>::new());
    let folder = planted("", &["c.rs", "attic/mod.rs"]);
    let found = misplaced(folder.path(), &two_rooms(), &["lib.rs", "testing.rs"]);
    let begins = [
        "attic is in no room",
        "c.rs is in no room",
        "testing.rs is not there",
    ];
    assert_eq!(found.len(), begins.len(), "{found:?}");
    for (found, begin) in found.iter().zip(begins) {
        assert!(found.starts_with(begin), "{found}");
    }
}
