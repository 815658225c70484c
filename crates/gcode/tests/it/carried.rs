//! Tests of the state in force: it goes from one program to the next as text, too, and means the
//! same there.

use std::sync::Arc;

use glidepath_gcode::{
    Connections, Dialect, FanucControl, FanucParameters, FeedAtStart, InForce, Options, Program,
    Tool, ToolTable,
};
use glidepath_geometry::AxisVector;
use glidepath_program::{Event, Item, ItemKind, Rate};

fn options(dialect: Dialect) -> Options {
    let mut tools = ToolTable::new();
    let mut offset = AxisVector::zeros();
    offset[2] = 1.0 / 3.0;
    let tool = Tool {
        offset,
        diameter_mm: 6.1,
        orientation: 3,
    };
    tools.set(7, tool);
    Options {
        tools: Some(Arc::new(tools)),
        default_feed_mm_min: Some(600.0),
        connections: Connections::Simulated,
        dialect,
        ..Options::default()
    }
}

fn left_by(text: &str, dialect: Dialect) -> InForce {
    let mut program = Program::new(text.as_bytes(), options(dialect));
    for item in &mut program {
        item.expect("a program without findings");
    }
    program.in_force()
}

/// Its items; `None` for a finding.
fn items(text: &str, dialect: Dialect, in_force: Option<InForce>) -> Vec<Option<Item>> {
    let mut options = options(dialect);
    if let Some(in_force) = &in_force {
        options.offsets = in_force.work_offsets();
        options.tools = in_force.tools().cloned();
    }
    options.in_force = in_force;
    let program = Program::new(text.as_bytes(), options);
    program.map(Result::ok).collect()
}

#[test]
fn a_program_means_the_same_behind_what_was_carried_as_text() {
    // What one leaves, and one that depends on it.
    let pairs = [
        (
            Dialect::LinuxCnc,
            "G20 G91 G18 G98 G64 P0.001\n#31=[1/3] #4999=-2 #<_depth>=0.7\nG10 L2 P3 X[1/7] R30\nG56 G43 H7 S800 M3 M8\n\
             G92 Y0.2\nG10 L1 P7 Z0.4\nF[100/7] G1 X1\n",
            "X#31 Z[#4999 / 10]\nY#<_depth>\nG90 G43 H7 Z0\nG56 X0 Y0\n",
        ),
        (
            Dialect::LinuxCnc,
            "G81 X1 Y1 Z-1 R2 F100\nG61\n",
            "X2\nG80 G1 X0\n",
        ),
        (
            Dialect::Fanuc,
            "#100=5.5\nG54 G21 G90 G0 X1\nM30\n",
            "G90 G0 X#100 Y#101\nG1 X1 F100\nM30\n",
        ),
    ];
    for (dialect, before, after) in pairs {
        let left = left_by(before, dialect);
        let text = toml::to_string(&left).expect("text");
        let carried: InForce = toml::from_str(&text).expect("what is in force");
        let wanted = items(after, dialect, Some(left));
        assert!(wanted.iter().all(Option::is_some), "{after}");
        assert_ne!(
            wanted,
            items(after, dialect, None),
            "it depends on nothing: {after}"
        );
        assert_eq!(items(after, dialect, Some(carried)), wanted, "{text}");
    }
}

/// Between two programs somebody sets a system, chooses another and sets what G92.3 brings back.
#[test]
fn what_is_set_by_hand_meanwhile_counts() {
    let left = left_by("G21 G91 G54 F100\nG1 X1\n", Dialect::LinuxCnc);
    let mut options = options(Dialect::LinuxCnc);
    options.offsets = left.work_offsets();
    options.offsets.systems[1].origin[0] = 50.0;
    options.offsets.active = 1;
    options.offsets.saved_shift[0] = 7.0;
    options.in_force = Some(left);
    let mut program = Program::new(&b"G90 G1 X0\nG92.3\nX0\n"[..], options);
    let ends = program.by_ref().filter_map(|item| match item.ok()?.kind {
        ItemKind::Move { segment, .. } => Some(segment.end()[0]),
        _ => None,
    });
    assert_eq!(ends.collect::<Vec<_>>(), [50.0, 57.0]);
}

#[test]
fn text_of_others_does_no_harm() {
    let left = left_by("#31=1 G55\n", Dialect::LinuxCnc);
    let text = toml::to_string(&left).expect("text");
    let wild = text.replace("active = 1", "active = 70000");
    assert_ne!(wild, text);
    let carried: InForce = toml::from_str(&wild).expect("what is in force");
    assert!(!items("G1 X1 Y2\n", Dialect::LinuxCnc, Some(carried)).is_empty());
}

/// A lathe of FANUC with a feed per revolution at its start.
fn lathe(in_force: Option<InForce>) -> Options {
    Options {
        fanuc: FanucParameters {
            control: Some(FanucControl::LatheA),
            feed_at_start: FeedAtStart::PerRevolution,
            ..FanucParameters::default()
        },
        in_force,
        ..options(Dialect::Fanuc)
    }
}

/// Where the moves end in X, which is a radius there, and what is left.
fn xs_and_left(text: &str, options: Options) -> (Vec<f64>, InForce) {
    let mut program = Program::new(text.as_bytes(), options);
    let ends = program.by_ref().filter_map(|item| {
        match item.unwrap_or_else(|d| panic!("{text}\n{d}")).kind {
            ItemKind::Move { segment, .. } => Some(segment.end()[0]),
            _ => None,
        }
    });
    (ends.collect(), program.in_force())
}

#[test]
fn x_is_a_diameter_in_its_own_language_alone() {
    let (_, line) = xs_and_left("G17 G90 G1 X1 F100\n", options(Dialect::LinuxCnc));
    let turning = "G0 X50. Z0.\nS500 M3\nG1 Z-5. F0.2\nG2 X60. Z-10. R5.\nM30\n";
    let (alone, left) = xs_and_left(turning, lathe(None));
    assert_eq!(alone, [25.0, 25.0, 30.0]);
    // Behind a line of another language, and behind another program of the same.
    assert_eq!(xs_and_left(turning, lathe(Some(line))).0, alone);
    assert_eq!(xs_and_left(turning, lathe(Some(left.clone()))).0, alone);
    let behind = Options {
        in_force: Some(left),
        ..options(Dialect::LinuxCnc)
    };
    assert_eq!(xs_and_left("G90 G0 X50\n", behind).0, [50.0]);
}

#[test]
fn a_program_of_a_control_begins_in_its_motion_code() {
    let first_rate = |before: (&str, Dialect), dialect: Dialect| {
        let left = left_by(before.0, before.1);
        let found = items("X9 Y9\n", dialect, Some(left));
        let moved = found
            .into_iter()
            .flatten()
            .find_map(|item| match item.kind {
                ItemKind::Move { rate, .. } => Some(rate),
                _ => None,
            });
        moved.expect("a move")
    };
    let cut = "G1 X5 F600\nM30\n";
    for before in [
        (cut, Dialect::Fanuc),
        (cut, Dialect::LinuxCnc),
        ("G2 X5 I2.5 F600\nM30\n", Dialect::Siemens),
    ] {
        assert_eq!(
            first_rate(before, Dialect::Fanuc),
            Rate::Rapid,
            "{before:?}"
        );
        assert_eq!(
            first_rate(before, Dialect::Siemens),
            Rate::Feed(10.0),
            "{before:?}"
        );
    }
    // What did not end goes on: lines that somebody sends.
    assert_eq!(
        first_rate(("G1 X5 F600\n", Dialect::Fanuc), Dialect::Fanuc),
        Rate::Feed(10.0)
    );
}

/// What stops at the end: LinuxCNC's manual of M2 and M30 ("the spindle is stopped, as if by M5, coolant as if by M9"),
/// grbl's `gc_execute_line`, Haas' of M30.
#[test]
fn the_end_of_a_program_stops_what_is_on() {
    let events = |text: &str, dialect| -> Vec<Event> {
        let items = items(text, dialect, None).into_iter().flatten();
        items
            .filter_map(|item| match item.kind {
                ItemKind::Event(event) => Some(event),
                _ => None,
            })
            .collect()
    };
    for dialect in [Dialect::LinuxCnc, Dialect::Fanuc, Dialect::Siemens] {
        for end in ["M2", "M30"] {
            let on = format!("M3 S1000\nM8\nG1 X1 F100\n{end}\n");
            let told = events(&on, dialect);
            let last = &told[told.len() - 2..];
            assert_eq!(last, [Event::MCode(5), Event::PassingCode(9)], "{on}");
            assert!(left_by(&on, dialect).words().contains(" M5 M9 "), "{on}");
            let off = events(&format!("M3 S1000\nM8\nM5 M9\n{end}\n"), dialect);
            assert_eq!(off.len(), 5, "nothing is told twice: {off:?}");
        }
    }
    // The percent line ends the reading of a file, and stops nothing: what follows is told so.
    let open = "%\nM3 S1000\nM8\nG1 X1 F100\n%\n";
    let stops = |event: &Event| matches!(event, Event::MCode(5) | Event::PassingCode(9));
    assert!(!events(open, Dialect::LinuxCnc).iter().any(stops));
    let words = left_by(open, Dialect::LinuxCnc).words();
    assert!(words.contains(" M3 M8 "), "{words}");
}

/// `gc_init` of grbl, and what is of the machine and stays.
#[test]
fn a_reset_puts_in_force_what_a_machine_begins_with() {
    let text = "G20 G91 G18 G55 G43.1 Z1 S1000 M3 M8 T7\nG10 L2 P3 X2\nG92 X1\n#31=4\nG1 X1 F10\n";
    let left = left_by(text, Dialect::LinuxCnc);
    let begin = left_by("", Dialect::LinuxCnc);
    let reset = left.reset_to(&begin);
    assert_eq!(reset.words(), "G0 G54 G17 G21 G90 G94 M5 M9 T7 F600 S0");
    let beside = reset.position_offsets();
    assert!(beside.shift.norm() + beside.tool.norm() < 1e-12);
    // Parameters are not grbl's.
    let next = items("G21 G90 G0 X#31", Dialect::LinuxCnc, Some(reset.clone()));
    let ItemKind::Move { segment, .. } = &next[0].as_ref().unwrap().kind else {
        panic!("a move");
    };
    assert!((segment.end()[0] - 4.0).abs() < 1e-12);
    let turning = reset.turning_as(&left);
    assert!(turning.words().contains(" M3 M8 "), "{}", turning.words());
}
