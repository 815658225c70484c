//! Tests of previews.

use super::*;

/// Generations of what is known of programs, by their names.
struct Desk {
    preview: Preview,
    place: tempfile::TempDir,
}

impl Desk {
    fn new(names: &[&str]) -> Self {
        let desk = Self {
            preview: Preview::new(&crate::config::load(None).unwrap()),
            place: tempfile::tempdir().unwrap(),
        };
        for name in names {
            desk.write(name, "G21 G90 F600\nG1 X5\nM2\n");
        }
        desk
    }

    fn write(&self, name: &str, text: &str) {
        std::fs::write(self.place.path().join(name), text).unwrap();
    }

    fn look(&self, name: &str, look: Look) -> Result<u64, GivenUp> {
        self.look_as(Looker::Seat, name, look)
    }

    fn object(&self, name: &str) -> Value {
        let file = self.place.path().join(name);
        let as_seat = (Looker::Seat, Look::First);
        self.preview.object((&file, name), 1, as_seat).unwrap()
    }

    fn look_as(&self, looker: Looker, name: &str, look: Look) -> Result<u64, GivenUp> {
        let file = self.place.path().join(name);
        let object = self.preview.object((&file, name), 1, (looker, look))?;
        Ok(object["generation"].as_u64().unwrap())
    }
}

/// What a program should say and does not is told of one that is looked at, too.
#[test]
fn warnings_are_told_of_a_program_that_is_looked_at() {
    let desk = Desk::new(&["whole"]);
    desk.write("cut-off", "G21 G90 F600\nG1 X5\n");
    let warnings = |name: &str| loop {
        let object = desk.object(name);
        if object["report"].is_object() {
            break object["warnings"].clone();
        }
        std::thread::sleep(std::time::Duration::from_millis(5));
    };
    let end = "the text ends without M2, M30 or a last %: make sure that nothing of it is missing";
    assert_eq!(warnings("cut-off"), serde_json::json!([end]));
    assert_eq!(warnings("whole"), serde_json::json!([]));
}

#[test]
fn programs_that_are_looked_at_side_by_side_are_planned_once() {
    let desk = Desk::new(&["a", "b"]);
    let first = desk.look("a", Look::First).unwrap();
    let second = desk.look("b", Look::First).unwrap();
    for _ in 0..5 {
        assert_eq!(desk.look("a", Look::Again), Ok(first));
        assert_eq!(desk.look("b", Look::Again), Ok(second));
    }
    // Another page that chooses one is shown the same plan.
    assert_eq!(desk.look("a", Look::First), Ok(first));
    for generation in [first, second] {
        assert!(desk.preview.shown(generation).is_some());
    }
    // Another text is another program, and so is one of which somebody has heard that it is.
    desk.write("a", "G21 G90 F600\nG1 X5 Y5\nM2\n");
    let other = desk.look("a", Look::Again).unwrap();
    assert!(other > second);
    assert!(desk.look("a", Look::Anew).unwrap() > other);
    assert!(desk.preview.shown(first).is_none());
}

#[test]
fn the_program_that_was_asked_for_least_recently_is_given_up_for_good() {
    let names = ["a", "b", "c", "d", "e"];
    let desk = Desk::new(&names);
    let seen: Vec<u64> = names[..4]
        .iter()
        .map(|name| desk.look(name, Look::First).unwrap())
        .collect();
    assert_eq!(desk.look("a", Look::Again), Ok(seen[0]));
    let fifth = desk.look("e", Look::First).unwrap();
    assert_eq!(desk.look("b", Look::Again), Err(GivenUp));
    assert!(desk.preview.shown(seen[1]).is_none());
    // Whoever asks for it again and again disturbs nobody.
    for (name, generation) in [("a", seen[0]), ("c", seen[2]), ("e", fifth)] {
        assert_eq!(desk.look("b", Look::Again), Err(GivenUp));
        assert_eq!(desk.look(name, Look::Again), Ok(generation), "{name}");
    }
    assert!(desk.look("b", Look::First).unwrap() > fifth);
}

#[test]
fn nobody_who_only_looks_has_given_up_what_the_seat_looks_at() {
    let of_seat = ["a", "b", "c", "d"];
    let of_others = ["e", "f", "g", "h"];
    let desk = Desk::new(&[of_seat, of_others].concat());
    let other = |name, look| desk.look_as(Looker::Other, name, look);
    // One that another page looks at already is the seat's from now on.
    let shared = other("a", Look::First).unwrap();
    let seen = of_seat.map(|name| desk.look(name, Look::First).unwrap());
    assert_eq!(seen[0], shared, "it is planned once");
    for _ in 0..3 {
        for name in of_others {
            let _looked = other(name, Look::First).unwrap();
            let _looked = other(name, Look::Anew).unwrap();
        }
    }
    assert_eq!(other("e", Look::Again), Err(GivenUp), "others have few");
    // Nor is what the seat looks at planned again because another page says so.
    for (name, generation) in of_seat.into_iter().zip(seen) {
        assert_eq!(other(name, Look::Anew), Ok(generation), "{name}");
        assert!(desk.preview.shown(generation).is_some(), "{name}");
    }
    // Whoever looked last is the seat, whatever others have asked for since.
    let _fifth = desk.look("e", Look::First).unwrap();
    assert_eq!(desk.look("a", Look::Again), Err(GivenUp));
    assert_eq!(desk.look("b", Look::Again), Ok(seen[1]));
}

#[test]
fn long_texts_are_remembered_one_at_a_time() {
    let desk = Desk::new(&["short"]);
    let long = "(a remark)\n".repeat(MOST_TEXT / 2 / 11 + 1);
    desk.write("long", &long);
    desk.write("longer", &long);
    let short = desk.look("short", Look::First).unwrap();
    let first = desk.look("long", Look::First).unwrap();
    assert_eq!(desk.look("short", Look::Again), Ok(short));
    assert_eq!(desk.look("long", Look::Again), Ok(first));
    let _second = desk.look("longer", Look::First).unwrap();
    assert_eq!(desk.look("long", Look::Again), Err(GivenUp));
}

#[test]
fn a_program_has_its_fingerprint_also_where_something_is_wrong_with_it() {
    let desk = Desk::new(&["right"]);
    desk.write("wrong", "G21 G90\nG1 X5 Q\n");
    for name in ["right", "wrong"] {
        let file = desk.place.path().join(name);
        let begun = std::time::Instant::now();
        let fingerprint = loop {
            let look = (Looker::Seat, Look::First);
            let object = desk.preview.object((&file, name), 1, look).unwrap();
            if let Some(fingerprint) = object["fingerprint"].as_str() {
                break fingerprint.to_owned();
            }
            assert!(begun.elapsed().as_secs() < 60, "{object}");
            std::thread::sleep(std::time::Duration::from_millis(5));
        };
        assert_eq!(fingerprint.len(), 16, "{name}");
    }
}
