//! Tests of the configuration of a superposition: what it leaves for programs, and what is refused.

#![allow(clippy::float_cmp, reason = "products of numbers that are exact")]

use glidepath::config::{self, MachineConfig};

/// A machine with this table, and whether drives send feedback.
fn machine(table: &str, source: &str) -> Result<MachineConfig, String> {
    let axis = |name: &str, min: f64, max: f64| {
        format!(
            "[axis.{name}]\nmin_position = {min:?}\nmax_position = {max:?}\nmax_velocity = 100.0\n\
             max_acceleration = 1000.0\nmax_jerk = 20000.0\n"
        )
    };
    let text = format!(
        "{}{}[feedback]\nsource = \"{source}\"\n[superposition]\n{table}",
        axis("X", 0.0, 300.0),
        axis("Z", -60.0, 0.0)
    );
    config::parse("torch.toml", &text).map_err(|error| {
        let texts = error.diagnostics().iter();
        texts
            .map(|found| format!("{}: {}\n", found.key, found.message))
            .collect()
    })
}

#[test]
fn programs_have_what_the_superposition_leaves_of_limits_and_travel() {
    let table = "axis = \"Z\"\ninput = 2\nshare = 0.4\nlowest = -3.0\nhighest = 5.0\n";
    let machine = machine(table, "drives").expect("a machine");
    let superposed = machine.superposition.expect("a superposition");
    let z = &machine.axes[1];
    assert_eq!(z.travel, Some((-57.0, -5.0)));
    assert_eq!(
        [z.max_velocity, z.max_acceleration, z.max_jerk],
        [60.0, 600.0, 12_000.0]
    );
    assert_eq!(
        [
            superposed.velocity,
            superposed.acceleration,
            superposed.jerk
        ],
        [40.0, 400.0, 8000.0]
    );
    let x = &machine.axes[0];
    assert_eq!((x.travel, x.max_velocity), (Some((0.0, 300.0)), 100.0));
}

#[test]
fn what_cannot_be_is_refused_with_its_reason() {
    let cases = [
        (
            "axis = \"Z\"\ninput = 0\n",
            "none",
            "nobody sends its input",
        ),
        ("axis = \"Z\"\n", "drives", "no input moves the axis"),
        (
            "axis = \"Y\"\ninput = 0\n",
            "drives",
            "the machine has no such axis",
        ),
        ("axis = \"Q\"\ninput = 0\n", "drives", "is not known"),
        (
            "axis = \"Z\"\ninput = 0\nlowest = -40.0\nhighest = 40.0\n",
            "drives",
            "no travel is left for programs",
        ),
        (
            "axis = \"Z\"\ninput = 0\nshare = 1.0\n",
            "drives",
            "out of range",
        ),
    ];
    for (table, source, why) in cases {
        let refused = machine(table, source).expect_err(table);
        assert!(refused.contains(why), "{table}: {refused}");
    }
}
