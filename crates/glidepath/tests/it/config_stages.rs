//! Tests of the two stages of a configuration: what is wrong in one place does not hide what only a
//! later stage finds in another, nor does it make anything up.

#![allow(clippy::expect_used, reason = "a test that fails may panic")]

use glidepath::config;

const AXIS: &str = "[axis.X]\nmin_position = -10\nmax_position = 10\nmax_velocity = 100\n\
                    max_acceleration = 1000\nmax_jerk = 10000\n";

/// One thing each that is wrong, at every stage.
const WRONG: [&str; 7] = [
    "[path]\ntolerance = \"x\"\n",
    "[path]\ntolerance = -1\n",
    "[path]\nqqqq = 1\n",
    "[paht]\n",
    "[interpolator]\npriority = 200\n",
    "[home.J7]\n",
    "[axis.Y]\nmin_position = 5\nmax_position = -5\nmax_velocity = -1\nmax_acceleration = 1\n\
     max_jerk = 1\n",
];

fn messages(text: &str) -> Vec<String> {
    let error = config::parse("m.toml", text).expect_err("the text has to be refused");
    let found = error.diagnostics().iter();
    found.map(|found| found.message.clone()).collect()
}

#[test]
fn a_velocity_per_minute_is_told_beside_whatever_else_is_wrong() {
    let grbl = AXIS.replace("max_velocity = 100", "max_velocity = 12000");
    for wrong in WRONG {
        let found = messages(&format!("{grbl}{wrong}"));
        let told = "axis.X.max_velocity = 12000 mm/s is 720 m/min";
        let is_told = found.iter().any(|message| message.starts_with(told));
        assert!(is_told && found.len() > 1, "{wrong}: {found:?}");
        let found = messages(&format!("{AXIS}{wrong}"));
        let is_told = found.iter().any(|message| message.contains("mm/min"));
        assert!(!is_told, "{wrong}: {found:?}");
    }
}

#[test]
fn a_key_that_does_not_belong_there_hides_nothing_of_its_table() {
    let grbl = AXIS.replace("max_velocity = 100", "max_velocity = 12000\nbacklash_ = 1");
    let found = messages(&grbl);
    let told = "axis.X.max_velocity = 12000 mm/s is 720 m/min";
    assert!(
        found.len() == 2 && found.iter().any(|message| message.starts_with(told)),
        "{found:?}"
    );
    // One that is meant for a key that is then missing leaves nothing to judge by.
    let found = messages(&AXIS.replace("max_jerk", "max_jrek"));
    assert!(
        found.len() == 1 && found[0].starts_with("unknown key"),
        "{found:?}"
    );
}

/// What a joint can do on its way home is what its axis can do.
#[test]
fn a_limit_that_is_not_known_condemns_no_way_home() {
    let homing = "[feedback]\nsource = \"drives\"\nhoming = \"controller\"\n[home.J0]\n\
                  search_velocity = 20\nlatch_velocity = -2\nsearch_travel = 20\nclearance = 5\n";
    for (right, wrong, told) in [
        ("max_jerk", "max_jerc", "unknown key `max_jerc`"),
        (
            "max_velocity = 100",
            "max_velocity = -100",
            "axis.X.max_velocity = -100 mm/s",
        ),
        (
            "search_velocity = 20",
            "search_velocity = 2e9",
            "home.J0.search_velocity",
        ),
    ] {
        let found = messages(&format!("{AXIS}{homing}").replace(right, wrong));
        assert_eq!(found.len(), 1, "{found:?}");
        assert!(found[0].starts_with(told), "{found:?}");
    }
    let short = format!("{AXIS}{homing}").replace("clearance = 5", "clearance = 0.01");
    let found = messages(&short);
    assert!(
        found.len() == 1 && found[0].starts_with("J0 cannot come home"),
        "{found:?}"
    );
}

#[test]
fn a_horizon_that_is_too_short_is_told_beside_what_does_not_concern_it() {
    let short = format!("{AXIS}[interpolator]\nhorizon_s = 0.5\n");
    for wrong in WRONG.iter().filter(|wrong| wrong.starts_with("[pa")) {
        let found = messages(&format!("{short}{wrong}"));
        let told = "interpolator.horizon_s = 0.5 s is too short for this machine";
        assert!(
            found.iter().any(|message| message == told),
            "{wrong}: {found:?}"
        );
    }
    // Of an axis whose numbers are wrong nobody knows how long it takes to stop.
    let found = messages(&short.replace("= 1000\n", "= -1\n"));
    assert_eq!(
        found,
        ["axis.X.max_acceleration = -1 mm/s² is out of range"]
    );
}
