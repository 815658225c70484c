//! Tests of probing with a probe that answers.
#![allow(
    clippy::unwrap_used,
    clippy::float_cmp,
    clippy::panic,
    reason = "a test: what is exact is compared exactly"
)]

use glidepath_gcode::{Connections, Dialect, Options, Probed, Program, check};
use glidepath_geometry::AxisVector;
use glidepath_program::{Event, Item, ItemKind};

fn options() -> Options {
    Options {
        connections: Connections::Real,
        probing_v: Some(10.0),
        ..Options::default()
    }
}

fn at(x: f64, z: f64) -> AxisVector {
    AxisVector::x() * x + AxisVector::z() * z
}

/// Items up to a probing move, or to the end.
fn until_probe(program: &mut Program<&[u8]>) -> Vec<Item> {
    let mut items = Vec::new();
    while !program.is_at_probe() {
        match program.next() {
            Some(item) => items.push(item.unwrap()),
            None => break,
        }
    }
    items
}

fn ends(items: &[Item]) -> Vec<(f64, f64)> {
    let end = |item: &Item| match &item.kind {
        ItemKind::Move { segment, .. } => Some((segment.end()[0], segment.end()[2])),
        _ => None,
    };
    items.iter().filter_map(end).collect()
}

fn answer(contact: Option<AxisVector>, was_so: bool, stands: AxisVector) -> Probed {
    Probed {
        contact,
        was_so,
        stands,
    }
}

#[test]
fn a_program_goes_on_from_where_the_machine_came_to_rest() {
    let text =
        "G10 L2 P1 X1 Z2\nG0 X4\nG38.2 Z-5 F300\nG91 G1 X1\nG90 G1 X[#5061] Z[#5063+#5070]\nM2\n";
    let mut program = Program::new(text.as_bytes(), options());
    let before = until_probe(&mut program);
    assert_eq!(ends(&before), [(5.0, 0.0), (5.0, -3.0)]);
    let event = Event::Probe { release: false };
    assert_eq!(before[1].kind, ItemKind::Event(event));
    // It touches at −1.5 and comes to rest a little behind that.
    let found = answer(Some(at(5.0, -1.5)), false, at(5.0, -1.6));
    program.answer_probe(&found).unwrap();
    let after = until_probe(&mut program);
    assert_eq!(ends(&after), [(6.0, -1.6), (5.0, -0.5)]);
}

#[test]
fn a_fanuc_goes_on_behind_g31_with_or_without_a_contact() {
    let text =
        "G54 G90 G01 X10. F300.\nG31 Z-5.\nX[#5063*10.]\nG91 G31 X3. F60.\nG90 X[#5061+1.]\nM30\n";
    let fanuc = Options {
        dialect: Dialect::Fanuc,
        ..options()
    };
    let mut program = Program::new(text.as_bytes(), fanuc);
    assert_eq!(
        ends(&until_probe(&mut program)),
        [(10.0, 0.0), (10.0, -5.0)]
    );
    let found = answer(Some(at(10.0, -1.5)), false, at(10.0, -1.75));
    program.answer_probe(&found).unwrap();
    // G01 is the mode still.
    let before = until_probe(&mut program);
    assert_eq!(ends(&before), [(-15.0, -1.75), (-12.0, -1.75)]);
    assert_eq!(
        before[1].kind,
        ItemKind::Event(Event::Probe { release: false })
    );
    program
        .answer_probe(&answer(None, false, at(-12.0, -1.75)))
        .unwrap();
    assert_eq!(ends(&until_probe(&mut program)), [(-11.0, -1.75)]);
    let report = check("G31 Z-5 F300\nM2\n".as_bytes(), options());
    assert!(report.diagnostics[0].message.contains("G31"));
}

#[test]
fn parameters_show_the_position_of_the_machine() {
    let text = "G10 L2 P1 X1 Z2\nG0 X4\nG1 X[#5021+#5420] Z#5023 F100\nG20\nX[#5021]\nM2\n";
    let mut program = Program::new(text.as_bytes(), options());
    // X5 of the machine is X4 of the program; 9 is 10, and Z0 of the machine is 2 above its zero.
    let found = ends(&until_probe(&mut program));
    assert_eq!(found[..2], [(5.0, 0.0), (10.0, 2.0)]);
    assert!((found[2].0 - 11.0).abs() < 1e-9, "{found:?}");
}

#[test]
fn what_a_code_wants_and_does_not_get_is_an_error() {
    // Code, contact, already so, whether the program goes on.
    let cases = [
        ("G38.2", true, false, true),
        ("G38.2", false, false, false),
        ("G38.2", true, true, false),
        ("G38.3", false, false, true),
        ("G38.3", true, true, true),
        ("G38.4", false, false, false),
        ("G38.5", false, false, true),
    ];
    for (code, touches, was_so, goes_on) in cases {
        let text = format!("{code} Z-5 F300\nG0 X[10+#5070]\n");
        let mut program = Program::new(text.as_bytes(), options());
        let items = until_probe(&mut program);
        let release = matches!(code, "G38.4" | "G38.5");
        assert_eq!(
            items[0].kind,
            ItemKind::Event(Event::Probe { release }),
            "{code}"
        );
        let contact = touches.then(|| at(0.0, -1.0));
        let answered = program.answer_probe(&answer(contact, was_so, at(0.0, -1.0)));
        let rest = ends(&until_probe(&mut program));
        if goes_on {
            answered.unwrap();
            let made = if touches { 11.0 } else { 10.0 };
            assert_eq!(rest, [(made, -1.0)], "{code} {touches} {was_so}");
        } else {
            let error = answered.unwrap_err();
            assert_eq!((error.line, error.column), (1, 1), "{error:?}");
            assert_eq!(error.code.as_str(), "probe");
            assert_eq!(rest, [], "{code} {touches} {was_so}");
        }
    }
}

#[test]
fn a_feed_from_which_the_machine_could_not_stop_is_refused() {
    let findings = |text: &str, options| {
        let report = check(text.as_bytes(), options);
        let found = report.diagnostics.iter();
        found.map(|f| f.message.clone()).collect::<Vec<_>>()
    };
    assert_eq!(findings("G38.2 Z-5 F600\n", options()), [""; 0]);
    assert_eq!(
        findings("G38.2 Z-5 F601\n", options()),
        ["F601 is too fast for the probe"]
    );
    let without = Options {
        probing_v: None,
        ..options()
    };
    assert_eq!(
        findings("G38.2 Z-5 F100\n", without),
        ["no probe is connected"]
    );
}

/// What the parameters say leads back to where the probe touched, whatever lies between the
/// coordinates of the program and those of the machine.
#[test]
fn the_contact_is_in_the_coordinates_of_the_block() {
    let set_up = [
        "",
        "G92 X3 Y-2 Z7",
        "G52 X-4 Y1 Z2",
        "G10 L2 P1 X1 Y2 Z3 R30",
        "G10 L2 P2 X-5 Y4 Z1 R-75\nG55",
        "G43.1 Z12.5",
        "G20",
        "G10 L2 P1 X1 Y2 Z3 R40\nG92 X1 Y1 Z1\nG43.1 X2 Z10\nG20",
        "G19 G91.1 G61",
    ];
    let touched = AxisVector::x() * 2.5 + AxisVector::y() * -1.25 + AxisVector::z() * -3.75;
    for set_up in set_up {
        for distance in ["G90", "G91"] {
            let text = format!(
                "{set_up}\n{distance} F5\nG38.2 X1 Y1 Z-1\nG90 G1 X#5061 Y#5062 Z#5063\nM2\n"
            );
            let mut program = Program::new(text.as_bytes(), options());
            until_probe(&mut program);
            let stands = touched + AxisVector::z() * -0.1;
            let found = answer(Some(touched), false, stands);
            program.answer_probe(&found).unwrap();
            let items = until_probe(&mut program);
            let end = items.iter().rev().find_map(|item| match &item.kind {
                ItemKind::Move { segment, .. } => Some(segment.end()),
                _ => None,
            });
            let off = (end.unwrap() - touched).amax();
            assert!(off < 1e-12, "{set_up} {distance}: {off}");
        }
    }
    // In diameters, too, they tell radii, as LinuxCNC's do.
    let text = "G7 F5\nG38.2 X-8\nG1 X[#5061*2]\nM2\n";
    let mut program = Program::new(text.as_bytes(), options());
    until_probe(&mut program);
    let found = answer(Some(at(-3.0, 0.0)), false, at(-3.5, 0.0));
    program.answer_probe(&found).unwrap();
    assert_eq!(ends(&until_probe(&mut program)), [(-3.0, 0.0)]);
    // And they are numbers in the units of the block.
    let text = "G20 F5\nG38.2 Z-1\nG1 X[#5063*25.4]\nM2\n";
    let mut program = Program::new(text.as_bytes(), options());
    until_probe(&mut program);
    let found = answer(Some(at(0.0, -12.7)), false, at(0.0, -12.7));
    program.answer_probe(&found).unwrap();
    let [(x, _)] = ends(&until_probe(&mut program))[..] else {
        panic!("one move");
    };
    assert!((x + 12.7 * 25.4).abs() < 1e-9, "{x}");
}
