//! The test of names: no public type name stands twice across crates that know each other.
//!
//! Whoever reads a crate sees the types of all that it uses, directly or by way of others. Two of
//! one name are two meanings of a word, of which each file has to say which one it means. Private
//! types, and those of crates that never meet, may share a name.

use crate::arrows::{self, Arrows};
use crate::modules::is_test;
use crate::told::sources;
use std::collections::{BTreeMap, BTreeSet};

/// A name that stands twice on purpose.
struct Allowed {
    name: &'static str,
    /// The crates that define it, by their folders.
    houses: &'static [&'static str],
    /// Why it stands.
    reason: &'static str,
}

/// The names that stand twice, each with its reason. One that does not any more has to go from here.
const ALLOWED: &[Allowed] = &[
    Allowed {
        name: "Command",
        houses: &["ethercat", "link"],
        reason: "EtherCAT's word for what a datagram does; no file has both",
    },
    Allowed {
        name: "Event",
        houses: &["ethercat", "program"],
        reason: "what a bus tells, and what a program asks for; no file has both",
    },
    Allowed {
        name: "Frame",
        houses: &["ethercat", "program"],
        reason: "EtherCAT's word for what is on the wire; no file has both",
    },
    Allowed {
        name: "Settings",
        houses: &["ethercat", "program"],
        reason: "those of a crate, named with it: `ethercat::Settings`; no file has both",
    },
];

/// From the name of a type to the crates that define it in public.
type Types = BTreeMap<String, BTreeSet<String>>;

/// The public types among items, and in modules among them.
fn public_types(items: &[syn::Item]) -> Vec<String> {
    let of_item = |item: &syn::Item| {
        let (visibility, name) = match item {
            syn::Item::Struct(item) => (&item.vis, &item.ident),
            syn::Item::Enum(item) => (&item.vis, &item.ident),
            syn::Item::Union(item) => (&item.vis, &item.ident),
            syn::Item::Trait(item) => (&item.vis, &item.ident),
            syn::Item::Type(item) => (&item.vis, &item.ident),
            syn::Item::Mod(item) if !is_test(&item.attrs) => {
                return match &item.content {
                    Some((_, items)) => public_types(items),
                    None => Vec::new(),
                };
            }
            _ => return Vec::new(),
        };
        let is_public = matches!(visibility, syn::Visibility::Public(_));
        is_public
            .then(|| name.to_string())
            .into_iter()
            .collect::<Vec<_>>()
    };
    items.iter().flat_map(of_item).collect()
}

/// The public types of a crate.
fn types_of(house: &str) -> Vec<String> {
    let mut files = Vec::new();
    sources(
        &crate::root().join("crates").join(house).join("src"),
        &mut files,
    );
    assert!(!files.is_empty(), "{house}: no sources were found");
    let read = |file: &std::path::PathBuf| {
        let text = std::fs::read_to_string(file).expect("UTF-8");
        let syntax = syn::parse_file(&text).unwrap_or_else(|e| panic!("{}: {e}", file.display()));
        public_types(&syntax.items)
    };
    files.iter().flat_map(read).collect()
}

/// The names that stand in several crates of which one knows another, with those crates.
fn twice(types: &Types, arrows: &Arrows) -> Types {
    let reached: BTreeMap<&str, BTreeSet<&str>> = arrows
        .keys()
        .map(|house| (house.as_str(), arrows::reached(arrows, house)))
        .collect();
    let knows = |one: &str, other: &str| {
        reached
            .get(one)
            .is_some_and(|reached| reached.contains(other))
    };
    let meet = |houses: &BTreeSet<String>| -> BTreeSet<String> {
        let meets = |one: &&String| {
            houses
                .iter()
                .any(|other| knows(one, other) || knows(other, one))
        };
        houses.iter().filter(meets).cloned().collect()
    };
    let found = types.iter().map(|(name, houses)| (name, meet(houses)));
    found
        .filter(|(_, houses)| !houses.is_empty())
        .map(|(name, houses)| (name.clone(), houses))
        .collect()
}

#[test]
fn no_type_name_stands_twice() {
    let arrows = arrows::drawn();
    let mut types = Types::new();
    for house in arrows.keys() {
        for name in types_of(house) {
            types.entry(name).or_default().insert(house.clone());
        }
    }
    assert!(types.len() > 500, "types are not found: {}", types.len());
    let found = twice(&types, &arrows);
    let is_allowed = |allowed: &Allowed, name: &str, houses: &BTreeSet<String>| {
        allowed.name == name && houses.iter().eq(allowed.houses.iter().copied())
    };
    let more: Vec<_> = found
        .iter()
        .filter(|(name, houses)| !ALLOWED.iter().any(|it| is_allowed(it, name, houses)))
        .collect();
    assert!(more.is_empty(), "name one of them otherwise: {more:#?}");
    for allowed in ALLOWED {
        let stands = found
            .iter()
            .any(|(name, houses)| is_allowed(allowed, name, houses));
        let Allowed { name, reason, .. } = allowed;
        assert!(stands, "no more, take it off the list: {name} ({reason})");
    }
}

#[test]
fn planted_names_are_found() {
    let arrow = |from: &str, to: &[&str]| {
        let to = to.iter().map(ToString::to_string).collect();
        (from.to_owned(), to)
    };
    let arrows = Arrows::from([
        arrow("a", &["b"]),
        arrow("b", &["c"]),
        arrow("c", &[]),
        arrow("d", &[]),
    ]);
    let stands = |name: &str, houses: &[&str]| {
        let houses: BTreeSet<_> = houses.iter().map(ToString::to_string).collect();
        (name.to_owned(), houses)
    };
    let types = Types::from([
        // a knows c by way of b, d nobody
        stands("Way", &["a", "c", "d"]),
        stands("Place", &["a", "d"]),
        stands("Once", &["b"]),
    ]);
    assert_eq!(
        twice(&types, &arrows),
        Types::from([stands("Way", &["a", "c"])])
    );

    let text = "pub struct A; pub(crate) struct B; enum C {} pub trait D {} pub type E = u8;
        pub mod inner { pub union F { a: u8 } struct G; }
        #[cfg(test)] mod tests { pub struct H; }
        pub fn f() { pub struct I; }";
    let syntax = syn::parse_file(text).expect("Rust");
    assert_eq!(public_types(&syntax.items), ["A", "D", "E", "F"]);
}
