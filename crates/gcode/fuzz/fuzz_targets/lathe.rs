//! The fuzz target: any profile is cut by the lathe cycles, or refused.
#![no_main]

use std::fmt::Write;

use glidepath_gcode::{Options, Program, check};
use glidepath_geometry::Segment;
use glidepath_program::ItemKind;
use libfuzzer_sys::fuzz_target;

const CYCLES: [&str; 7] = ["70", "71", "71.1", "71.2", "72", "72.1", "72.2"];

/// Tenths of a millimetre: places that coincide are what is hard.
fn tenths(byte: u8) -> f64 {
    f64::from(byte.cast_signed()) / 10.0
}

fn program(head: [u8; 6], blocks: &[u8]) -> String {
    let mut text = String::from("G18 F100\nO1 sub\n");
    let (elements, _) = blocks.as_chunks::<4>();
    for (index, [kind, a, b, c]) in elements.iter().enumerate() {
        let [a, b, c] = [*a, *b, *c].map(tenths);
        let end = if index % 2 == 0 { format!("X{a} Z{b}") } else { format!("U{a} W{b}") };
        let words = match kind % 8 {
            _ if index == 0 => format!("G0 X{a} Z{b}"),
            0 => format!("G1 X{a}"),
            1 => format!("G1 Z{b}"),
            2 => format!("G1 {end} A{}", c.abs()),
            3 => format!("G1 {end} C{}", c.abs()),
            4 => format!("G2 {end} R{c}"),
            5 => format!("G3 {end} R{c}"),
            6 => format!("G3 {end} I{c}"),
            _ => format!("G1 {end}"),
        };
        writeln!(text, "{words}").expect("a string");
    }
    let [cycle, x, z, d, i, r] = head;
    let code = CYCLES[usize::from(cycle) % CYCLES.len()];
    let [x, z, d, i, r] = [x, z, d, i, r].map(tenths);
    let words = if code == "70" {
        format!("D{} E{} P{}", d.abs(), r.abs(), head[4] % 4)
    } else {
        format!("D{} I{} R{}", d.abs(), i.abs(), r.abs())
    };
    writeln!(text, "O1 endsub\nG{code} Q1 X{x} Z{z} {words}\nM2").expect("a string");
    text
}

fuzz_target!(|bytes: &[u8]| {
    let Some((head, blocks)) = bytes.split_first_chunk::<6>() else {
        return;
    };
    let text = program(*head, blocks);
    check(text.as_bytes(), Options::default());
    let mut end = Options::default().start;
    for item in Program::new(text.as_bytes(), Options::default()) {
        let Ok(item) = item else {
            return;
        };
        let ItemKind::Move { segment, .. } = item.kind else {
            continue;
        };
        assert_eq!(segment.start(), end);
        end = segment.end();
        assert!(end.iter().all(|p| p.is_finite()) && segment.length() > 0.0, "{text}");
        if let Segment::Arc(arc) = &segment {
            let radius = |p: glidepath_geometry::AxisVector| {
                (p[2] - arc.center[0]).hypot(p[0] - arc.center[1])
            };
            assert!((radius(arc.start) - radius(arc.end)).abs() < 1e-5, "{text}");
            assert!(arc.sweep_rad.abs() <= core::f64::consts::PI + 1e-9, "{text}");
        }
    }
});
