//! Tests of conversions: golden conversions, and every key in exactly one list.

#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test that fails may panic"
)]

mod support;

use glidepath_migration::{Conversion, from_grbl, from_klipper, from_linuxcnc};
use proptest::prelude::*;
use std::collections::BTreeMap;
use support::{SAMPLES, convert, folder, read};

/// The keys of a text, counted without any of the code that converts it.
fn keys_of(control: &str, text: &str) -> BTreeMap<String, u32> {
    let mut keys = BTreeMap::new();
    let mut section = String::new();
    for line in text.lines() {
        let saved = line.strip_prefix("#*#");
        let indented = line.starts_with([' ', '\t']) || saved.is_some_and(|l| l.starts_with(" \t"));
        let line = saved.unwrap_or(line).trim();
        let comment = line.starts_with('#') || line.starts_with(';');
        if line.is_empty()
            || comment
            || line.starts_with("[include")
            || (indented && control == "klipper")
        {
            continue;
        }
        let key = if control == "grbl" {
            let line = line.trim_start_matches('>');
            match (
                line.split_once('='),
                line.strip_prefix('[').and_then(|l| l.split_once(':')),
            ) {
                _ if ["ok", "$$", "$#"].contains(&line) => continue,
                (Some((key, _)), _) if line.starts_with('$') => key.to_owned(),
                (_, Some((key, _))) => key.to_owned(),
                _ => line.to_owned(),
            }
        } else if let Some(name) = line.strip_prefix('[') {
            section = name.trim_end_matches(']').to_owned();
            continue;
        } else {
            let Some(end) = line.find(['=', ':']) else {
                continue;
            };
            format!("[{section}]{}", line[..end].trim())
        };
        *keys.entry(key).or_default() += 1;
    }
    keys
}

fn all_keys(control: &str, file: &str, included: &[&str]) -> BTreeMap<String, u32> {
    let mut keys = keys_of(control, &read(control, file));
    for file in included {
        for (key, count) in keys_of(control, &read(control, file)) {
            *keys.entry(key).or_default() += count;
        }
    }
    keys
}

fn listed(conversion: &Conversion) -> BTreeMap<String, u32> {
    let lists = [
        &conversion.converted,
        &conversion.changed,
        &conversion.no_counterpart,
    ];
    let mut keys = BTreeMap::new();
    for verdict in lists.into_iter().flatten() {
        assert!(!verdict.note.is_empty(), "{verdict:?}");
        *keys.entry(verdict.key.clone()).or_default() += 1;
    }
    keys
}

#[test]
fn conversions_are_those_kept() {
    for (control, file, _) in SAMPLES {
        let conversion = convert(control, &read(control, file));
        let golden = folder(control).join(file).with_extension("toml");
        if std::env::var_os("GLIDEPATH_BLESS").is_some() {
            std::fs::write(&golden, &conversion.configuration).unwrap();
        }
        let kept = std::fs::read_to_string(&golden).expect("a golden conversion");
        assert_eq!(conversion.configuration, kept, "{control}/{file}");
    }
}

#[test]
fn every_key_is_in_exactly_one_list() {
    for (control, file, included) in SAMPLES {
        let conversion = convert(control, &read(control, file));
        assert_eq!(
            listed(&conversion),
            all_keys(control, file, included),
            "{control}/{file}"
        );
    }
}

#[test]
fn what_cannot_be_read_is_refused_with_its_place() {
    let nothing = |_: &str| Err("no such file".to_owned());
    let error = from_linuxcnc("[EMC]\nMACHINE\n", &nothing).expect_err("no key");
    assert_eq!(
        error.to_string(),
        "line 2: `MACHINE` is neither a section nor a key with a value"
    );
    let error = from_klipper("[include a.cfg]\n", &nothing).expect_err("no file");
    assert_eq!(error.to_string(), "line 1: cannot read a.cfg: no such file");
    let itself = |_: &str| Ok("#INCLUDE again.inc\n".to_owned());
    let error = from_linuxcnc("#INCLUDE again.inc\n", &itself).expect_err("no end");
    assert!(
        error.reason.starts_with("more than 64 files are included"),
        "{error}"
    );
    let unknown = convert(
        "linuxcnc",
        "[KINS]\nKINEMATICS = genserkins\n[TRAJ]\nLINEAR_UNITS = cubit\n",
    );
    assert!(
        unknown
            .asked
            .iter()
            .any(|asked| asked.key == "machine.kinematics")
    );
}

/// Found by fuzzing: each further joint of an axis asked for the same key again.
#[test]
fn an_axis_with_three_joints_is_asked_for_once_and_told() {
    let conversion = convert("linuxcnc", "[TRAJ]\nCOORDINATES = X Y A A A\n");
    let parsed: Result<toml::Table, _> = conversion.configuration.parse();
    assert!(parsed.is_ok(), "{parsed:?}");
    let asked = conversion.asked.iter();
    let asked = asked.filter(|asked| asked.key == "axis.A.gantry_difference");
    assert_eq!(asked.count(), 1);
    let told = format!("{conversion:?}");
    assert!(
        told.contains("an axis has two joints here at most"),
        "{told}"
    );
}

/// Lines as they may stand in such files, and some that may not.
fn lines() -> impl Strategy<Value = String> {
    let section = prop::sample::select(vec![
        "[TRAJ]",
        "[KINS]",
        "[AXIS_X]",
        "[AXIS_A]",
        "[JOINT_0]",
        "[RS274NGC]",
        "[EMCIO]",
        "[printer]",
        "[stepper_x]",
        "[stepper_a]",
        "[include x]",
        "[",
        "[]",
    ]);
    let key = prop::sample::select(vec![
        "COORDINATES",
        "LINEAR_UNITS",
        "KINEMATICS",
        "MIN_LIMIT",
        "MAX_LIMIT",
        "MAX_VELOCITY",
        "MAX_ACCELERATION",
        "MAX_JERK",
        "TOOL_TABLE",
        "SUBROUTINE_PATH",
        "PARAMETER_FILE",
        "G64_DEFAULT_TOLERANCE",
        "kinematics",
        "max_velocity",
        "max_accel",
        "position_min",
        "arm_length",
        "angle",
        "$110",
        "$130",
        "$22",
        "$23",
        "$11",
        "$13",
        "[G54",
        "[OPT",
    ]);
    let value = prop_oneof![
        Just("XYZ".to_owned()),
        Just("XXYAAA".to_owned()),
        Just("mm".to_owned()),
        Just("inch".to_owned()),
        Just("trivkins".to_owned()),
        Just("lineardeltakins".to_owned()),
        Just("corexy".to_owned()),
        Just("delta".to_owned()),
        Just("1e99".to_owned()),
        Just("nan".to_owned()),
        any::<f64>().prop_map(|v| v.to_string()),
        "[-0-9.,:\"\\\\ ]{0,12}",
        ".{0,12}",
    ];
    let line = prop_oneof![
        1 => section.prop_map(str::to_owned),
        4 => (key, prop::sample::select(vec!["=", ":", " = ", ""]), value)
            .prop_map(|(key, sign, value)| format!("{key}{sign}{value}")),
        1 => ".{0,20}",
    ];
    prop::collection::vec(line, 0..25).prop_map(|lines| lines.join("\n"))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn any_text_is_converted_or_refused(text in lines()) {
        let include = |_: &str| Err("no files here".to_owned());
        let results = [from_linuxcnc(&text, &include), from_grbl(&text), from_klipper(&text, &include)];
        for conversion in results.into_iter().flatten() {
            // It is TOML, and what the loader finds missing or wrong was asked for or stood there.
            let parsed: Result<toml::Table, _> = conversion.configuration.parse();
            prop_assert!(parsed.is_ok(), "{:?}\n{}", parsed, conversion.configuration);
        }
    }
}
