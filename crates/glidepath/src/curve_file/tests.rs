//! Tests of curve files: they read back, and diagnostics have a place.

use super::*;
use std::path::Path;

const ARCH: &str = "\
degree = 3
control_points = [[0.0, 0.0], [0.0, 20.0], [30.0, 20.0], [30.0, 0.0]]
weights = [1.0, 0.5, 2.0, 1.0]
knots = [0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0]
";

fn refused(text: &str) -> (String, (usize, usize), String) {
    let error = parse("arch.toml", text).expect_err("refused");
    (
        error.to_string(),
        error.line_and_column(),
        error.help.clone(),
    )
}

#[test]
fn what_is_written_reads_back() {
    let mut file = parse("arch.toml", ARCH).expect("valid");
    assert_eq!(file.name.as_deref(), Some("arch.toml"));
    let name = "an \"arch\"";
    file.name = Some(name.to_owned());
    file.feed_mm_min = Some(1234.5);
    let text = to_toml(name, file.feed_mm_min, &file.curve);
    let mut back = parse("other", &text).expect("valid");
    back.place = file.place.clone();
    assert_eq!(back, file);
}

#[test]
fn the_reference_curves_are_json_curve_files() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/data/method/");
    for (name, degree) in [("butterfly", 3), ("infinity", 2), ("helix3d", 3)] {
        let path = format!("{folder}{name}.json");
        let file = read(Path::new(&path), Path::new(&path)).expect("valid");
        assert_eq!(
            (file.name.as_deref(), file.curve.degree()),
            (Some(name), degree)
        );
    }
}

#[test]
fn weights_may_be_left_out() {
    let text = ARCH.replace("weights = [1.0, 0.5, 2.0, 1.0]\n", "");
    let file = parse("arch.toml", &text).expect("valid");
    assert_eq!(file.curve.weights(), [1.0; 4]);
}

#[test]
fn findings_have_a_place_and_a_remedy() {
    let (message, place, help) = refused(&ARCH.replace("0.5", "-0.5"));
    assert_eq!(message, "weight 1 is -0.5: weights are greater than zero");
    assert_eq!(place, (3, 17));
    assert!(help.starts_with("give a positive weight"));

    let (message, place, _) = refused(&ARCH.replace("[30.0, 20.0]", "[30.0]"));
    assert_eq!(message, "control point 2 has 1 coordinates, the first 2");
    assert_eq!(place, (2, 44));

    let (message, place, help) = refused(&ARCH.replace("knots", "knot"));
    assert!(message.starts_with("unknown key `knot`"), "{message}");
    assert_eq!(place, (4, 1));
    assert!(help.contains("`knots`"), "{help}");

    let (message, place, _) = refused(&ARCH.replace("degree = 3", "degree = 9"));
    assert_eq!(
        (message.as_str(), place),
        ("degree 9: it must be 1 to 7", (1, 1))
    );

    let (_, place, _) = refused(&format!("{ARCH}feed = 0.0\n"));
    assert_eq!(place, (5, 1));
    let (message, _, _) = refused(&format!("{ARCH}units = \"inch\"\n"));
    assert_eq!(message, "units \"inch\" are not known");
}

#[test]
fn json_errors_have_places_too() {
    let json =
        "{\"degree\": 1,\n \"control_points\": [[0, 0], [1, 0]],\n \"knots\": [0, 0, 1, oops]}";
    let error = parse("line.json", json).expect_err("no JSON");
    assert_eq!(error.line_and_column(), (3, 21));
    let json = json.replace("oops", "0.5");
    let error = parse("line.json", &json).expect_err("knots descend");
    assert_eq!(
        error.to_string(),
        "knot 3 is 0.5: knots are finite and never descend"
    );
    assert_eq!(error.line_and_column(), (3, 21));
}
