//! Tests of files that are mistaken for others, and of files that a configuration names.

#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    reason = "a test that fails may panic"
)]

use crate::support::{glidepath, object};
use glidepath::config::{self, ConfigDiagnostic};
use serde_json::Value;
use std::path::Path;

const AXIS: &str = "[axis.X]\nmin_position = -10\nmax_position = 10\nmax_velocity = 100\n\
                    max_acceleration = 1000\nmax_jerk = 10000\n";

fn found(text: &str) -> Vec<ConfigDiagnostic> {
    let error = config::parse("m.toml", text).expect_err("the text has to be refused");
    error.diagnostics().to_vec()
}

#[test]
fn a_decimal_comma_is_named_and_shown_with_a_point() {
    let text = AXIS
        .replace("= 100\n", "= 100,5  # fast\n")
        .replace("= -10\n", "=-1.000,25\n");
    let found_in = found(&format!("{text}[path]\ntolerence = 1\n"));
    let [low, fast, misspelt] = found_in.as_slice() else {
        panic!("{found_in:?}");
    };
    assert_eq!(
        low.message,
        "axis.X.min_position = -1.000,25 has a decimal comma"
    );
    assert_eq!(fast.key, "axis.X.max_velocity");
    assert_eq!(
        fast.message,
        "axis.X.max_velocity = 100,5 has a decimal comma"
    );
    let help = fast.help.as_deref();
    assert_eq!(
        help,
        Some("the decimal sign is a point: max_velocity = 100.5")
    );
    assert_eq!(text.get(fast.span.clone().unwrap()), Some("100,5"));
    // All is told at once.
    assert!(misspelt.message.starts_with("unknown key"), "{misspelt:?}");
    let thousands = found(&AXIS.replace("= 10000\n", "= 10,000\n"));
    let help = thousands[0].help.as_deref().unwrap();
    assert!(
        help.ends_with(
            "max_jerk = 10.000. If the comma parts thousands, leave it out: max_jerk = 10000"
        ),
        "{help}"
    );
    // Whatever else is no TOML is told as before.
    let other = found(&format!("{AXIS}[path\n"));
    assert!(
        other.iter().all(|it| !it.message.contains("comma")),
        "{other:?}"
    );
}

#[test]
fn a_number_in_quotes_is_shown_without() {
    for (written, shown) in [
        ("\"100.5\"", "write it without quotes: max_velocity = 100.5"),
        ("'100'", "write it without quotes: max_velocity = 100.0"),
        (
            "\"100,5\"",
            "write it without quotes, and with a decimal point: max_velocity = 100.5",
        ),
        (
            "\"fast\"",
            "write a number without quotes (0.001 to 100000 mm/s or °/s), such as max_velocity = 10.0",
        ),
    ] {
        let found = found(&AXIS.replace("velocity = 100", &format!("velocity = {written}")));
        assert_eq!(found[0].help.as_deref(), Some(shown), "{found:?}");
    }
}

#[test]
fn a_configuration_of_another_control_is_called_by_its_name() {
    for (file, what, command) in [
        ("linuxcnc/mill-mm.ini", "LinuxCNC", "from-linuxcnc"),
        ("grbl/router.txt", "grbl", "from-grbl"),
        ("grbl/router-force-origin.txt", "grbl", "from-grbl"),
        ("klipper/cartesian.cfg", "Klipper", "from-klipper"),
        ("klipper/delta.cfg", "Klipper", "from-klipper"),
    ] {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/data/migration");
        let path = folder.join(file);
        let path = path.to_str().unwrap();
        let error = config::load(Some(Path::new(path))).expect_err("another's");
        let [told] = error.diagnostics() else {
            panic!("{error:?}");
        };
        assert!(told.message.contains(what), "{told:?}");
        let help = told.help.as_deref().unwrap();
        let command = format!("`glidepath config {command} {path} > machine.toml`");
        assert!(help.contains(&command), "{help}");
        assert!(error.line_and_column(told).is_some());
    }
    // An ini that happens to be TOML, and an ini of nobody.
    assert_eq!(found("[AXIS_X]\nMAX_VELOCITY = 100\n").len(), 1);
    assert!(found("[motor]\nspeed = fast\n")[0].message != found("[TRAJ]\n")[0].message);
}

/// What `--check` finds, as keys and messages with their help.
fn checked(folder: &Path, lines: &str) -> (Option<i32>, Vec<(String, String)>) {
    let path = folder.join("m.toml");
    std::fs::write(&path, format!("{AXIS}{lines}")).unwrap();
    let output = glidepath(&["config", "--check", path.to_str().unwrap(), "--json"]);
    let object = object(&output);
    let found = object["findings"].as_array().unwrap().iter().map(|it| {
        assert!(it["line"].as_u64().is_some(), "{it}");
        let text = |key: &str| it[key].as_str().unwrap_or_default().to_owned();
        (
            text("key"),
            format!("{} → {}", text("message"), text("help")),
        )
    });
    let found = found.collect();
    if let Value::String(error) = &object["error"] {
        assert!(error.contains("to mend"), "{error}");
    }
    (output.status.code(), found)
}

#[test]
fn a_check_looks_at_the_files_that_are_named() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let program = "[program]\ntool_table = \"tools.tbl\"\nsubroutine_path = [\"subs\"]\n\
                   [state]\ndirectory = \"kept/state\"\n";
    let (code, found) = checked(folder, program);
    assert_eq!(code, Some(3));
    let keys: Vec<&str> = found.iter().map(|(key, _)| key.as_str()).collect();
    assert_eq!(
        keys,
        [
            "program.tool_table",
            "program.subroutine_path",
            "state.directory"
        ]
    );
    for ((_, told), words) in found.iter().zip(["tools.tbl", "subs", "kept"]) {
        assert!(
            told.contains(words) && told.contains("No such file"),
            "{told}"
        );
        assert!(!told.ends_with("→ "), "{told}");
    }
    // All of it there, and right; what is kept may still be made.
    std::fs::create_dir(folder.join("subs")).unwrap();
    std::fs::create_dir(folder.join("kept")).unwrap();
    std::fs::write(folder.join("tools.tbl"), "T1 P1 Z10 D6\n").unwrap();
    assert_eq!(checked(folder, program), (Some(0), Vec::new()));
    // There, and wrong.
    std::fs::write(folder.join("tools.tbl"), "T1 P1 Z10 D6\nT2 Pxx Z\n").unwrap();
    std::fs::write(folder.join("kept/state"), "a file").unwrap();
    let (code, found) = checked(folder, program);
    assert_eq!(code, Some(3));
    let told: Vec<&str> = found.iter().map(|(_, told)| told.as_str()).collect();
    assert!(told[0].contains("tools.tbl, line 2: "), "{told:?}");
    assert!(
        told.iter().any(|told| told.contains("it is no folder")),
        "{told:?}"
    );
    std::fs::remove_file(folder.join("kept/state")).unwrap();
    std::fs::create_dir(folder.join("kept/state")).unwrap();
    std::fs::write(folder.join("kept/state/kept.0"), "not what is kept").unwrap();
    let (_, found) = checked(folder, program);
    assert!(
        found.iter().any(|(key, _)| key == "state.directory"),
        "{found:?}"
    );
    // A folder is no table.
    let (_, found) = checked(folder, "[program]\ntool_table = \"subs\"\n");
    assert!(found[0].1.contains("it is no ordinary file"), "{found:?}");
}
