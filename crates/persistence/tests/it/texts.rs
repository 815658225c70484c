//! Tests of the texts: numbers come back to the bit, and LinuxCNC's files in its units.

#![allow(clippy::expect_used, reason = "a test that fails may panic")]

use glidepath_persistence::var::{Units, export, import};
use glidepath_persistence::{Directory, PersistentState, Store};
use proptest::prelude::*;

const MM: Units = Units {
    linear_mm: 1.0,
    angular_deg: 1.0,
};

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]

    #[test]
    fn numbers_come_back_to_the_bit(bits in prop::array::uniform9(any::<u64>())) {
        let folder = tempfile::tempdir().expect("a folder");
        let mut store = Store::new(Directory::open(folder.path()).expect("a folder"));
        let mut kept = PersistentState::default();
        for (value, bits) in kept.offsets.systems[4].origin.iter_mut().zip(bits) {
            *value = Some(f64::from_bits(bits)).filter(|v| v.abs() <= 1e9).unwrap_or(-0.0);
        }
        store.write(&kept).expect("it is written");
        let (_, read) = store.read().expect("whole").expect("something");
        let written = kept.offsets.systems[4].origin.map(f64::to_bits);
        prop_assert_eq!(read.offsets.systems[4].origin.map(f64::to_bits), written);
    }

    #[test]
    fn any_text_is_read_or_refused(text in "([0-9]{1,5}[ \t]-?[0-9.e]{0,8}\n|.{0,20}\n){0,12}") {
        let inch = Units { linear_mm: 25.4, angular_deg: 1.0 };
        if let Ok(imported) = import(&text, inch) {
            let again = import(&export(&imported.offsets, MM), MM).expect("our own file");
            prop_assert_eq!(again.offsets, imported.offsets);
        }
    }
}

#[test]
fn a_file_of_a_machine_in_inches() {
    let text = "31\t2.5\n5161\t1.000000\n5169\t-0.5\n5181\t0\n5210\t1.000000\n5211\t0.100000\n\
                5214\t15.0\n5220\t2.000000\n5221\t-4.000000\n5224\t90.000000\n5230\t0.000000\n\
                5241\t2\n5250\t30\n5381\t1\n5389\t2\n5390\t-5\n5399\t0\n";
    let inch = Units {
        linear_mm: 25.4,
        angular_deg: 1.0,
    };
    let read = import(text, inch).expect("a sound file");
    let near = |a: f64, b: f64| assert!((a - b).abs() < 1e-12, "{a} {b}");
    near(read.offsets.g28[0], 25.4);
    near(read.offsets.g28[8], -12.7);
    near(read.offsets.g92[0], 2.54);
    near(read.offsets.g92[3], 15.0);
    near(read.offsets.systems[0].origin[0], -101.6);
    near(read.offsets.systems[0].origin[3], 90.0);
    near(read.offsets.systems[1].origin[0], 50.8);
    near(read.offsets.systems[1].rotation_deg, 30.0);
    near(read.offsets.systems[8].origin[8], 50.8);
    near(read.offsets.systems[8].rotation_deg, -5.0);
    assert_eq!(read.offsets.active, 2);
    assert!(read.g92_was_in_force);
    assert_eq!(read.others, [(31, 2.5)]);

    let written = export(&read.offsets, inch);
    assert!(
        written.contains("5221\t-4\n") && written.contains("5210\t0\n"),
        "{written}"
    );
    let again = import(&written, inch).expect("our own file");
    near(again.offsets.systems[8].origin[8], 50.8);
    assert!(!again.g92_was_in_force);
    // LinuxCNC wants all of these, ascending.
    let numbers: Vec<u32> = written
        .lines()
        .map(|line| {
            line.split('\t')
                .next()
                .and_then(|n| n.parse().ok())
                .expect("a number")
        })
        .collect();
    assert!(
        numbers.is_sorted() && numbers.len() == 3 * 9 + 2 + 9 * 10,
        "{numbers:?}"
    );
}

#[test]
fn a_file_that_is_not_sound_is_refused_with_its_line() {
    let refused = |text: &str, told: &str| {
        let error = import(text, MM).expect_err("it is not sound").to_string();
        assert!(error.starts_with(told), "{error}");
    };
    refused(
        "5161\t1\n5161\t2\n",
        "line 2: parameter 5161 stands behind 5161",
    );
    refused(
        "5181\t1\n\n5161\t2\n",
        "line 3: parameter 5161 stands behind 5181",
    );
    refused("5220\t10\n", "line 1: parameter 5220 is 10");
    refused("5221\n", "line 1: give a number and a value");
    refused("5221\t1\t2\n", "line 1: give a number and a value");
    refused("5221\tx\n", "line 1: give a whole number and a value");
    refused(
        "5221\tnan\n",
        "line 1: the value of parameter 5221 is no number",
    );
    refused(
        "5221\t1e308\n5222\t1e400\n",
        "line 2: the value of parameter 5222 is no number",
    );
}
