//! Tests of programs that leave the travel: which work offset would fit, and that they can be
//! looked at.

#![allow(clippy::unwrap_used, reason = "a test that fails may panic")]

use crate::support::{glidepath, object};

#[test]
fn a_program_outside_of_the_travel_is_told_what_fits_and_can_be_looked_at() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str| folder.path().join(name).display().to_string();
    let (shifted, large) = (file("shifted.ngc"), file("large.ngc"));
    std::fs::write(
        &shifted,
        "G21 G90 F6000\nG0 X10 Y10\nG1 X560 Y20\nX400\nM2\n",
    )
    .unwrap();
    std::fs::write(&large, "G21 G90 F6000\nG0 X-600\nG1 X600\nM2\n").unwrap();
    let told = |args: &[&str]| {
        let output = glidepath(args);
        let text = [output.stdout, output.stderr].concat();
        (output.status.code(), String::from_utf8(text).unwrap())
    };
    let fits = "move the work offset: X by -510 to -60 mm";
    let (code, text) = told(&["check", &shifted]);
    assert!(code == Some(1) && text.contains(fits), "{text}");
    let (code, text) = told(&["check", &large]);
    let never = "no work offset fits, because X takes 1200 mm of a travel of 1000 mm";
    assert!(code == Some(1) && text.contains(never), "{text}");

    let plot = file("shifted.svg");
    let (code, text) = told(&["plan", &shifted]);
    assert!(code == Some(1) && text.contains(fits), "{text}");
    let (code, text) = told(&["plan", &shifted, "--plot", &plot]);
    assert!(code == Some(1) && text.contains(fits), "{text}");
    let picture = std::fs::read_to_string(&plot).unwrap();
    assert!(picture.contains("shifted.ngc: outside of the travel"));
    let page = file("shifted.html");
    let output = glidepath(&["plan", &shifted, "--plot", &page, "--json"]);
    assert_eq!(output.status.code(), Some(1));
    assert_eq!(object(&output)["findings"][0]["code"], "soft-limit");
    assert!(std::fs::read_to_string(&page).unwrap().starts_with("<!"));
    // With the offset that was named it is a plan.
    let moved = file("moved.ngc");
    let text = "G10 L2 P1 X-60\nG21 G90 G54 F6000\nG0 X10 Y10\nG1 X560 Y20\nX400\nM2\n";
    std::fs::write(&moved, text).unwrap();
    assert_eq!(told(&["check", &moved]).0, Some(0));
}

/// Where an axis stands before its first move is no place of the part.
#[test]
fn an_axis_counts_from_its_first_move_and_what_is_too_large_is_told_once() {
    let folder = tempfile::tempdir().unwrap();
    let help = |text: &str| {
        let path = folder.path().join("part.ngc");
        std::fs::write(&path, text).unwrap();
        let output = glidepath(&["check", &path.display().to_string()]);
        String::from_utf8([output.stdout, output.stderr].concat()).unwrap()
    };
    let far = help("G21 G90 F6000\nG0 Z-10\nG0 X1200\nG1 X1300\nM2\n");
    assert!(
        far.contains("move the work offset: X by -1700 to -800 mm"),
        "{far}"
    );
    let large = help("G21 G90 F6000\nG0 X-600\nG1 X0\nM2\n");
    assert!(!large.contains("no work offset fits"), "{large}");
    let large = help("G21 G90 F6000\nG0 X-600\nG1 X600\nX0\nM2\n");
    let times = |words: &str| large.matches(words).count();
    let findings = times("no work offset fits");
    assert!(findings > 0, "{large}");
    assert_eq!(times("make the part smaller"), findings, "{large}");
}
