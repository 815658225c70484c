//! The content of each generation of a test: every number says which.

use glidepath_persistence::{
    AXES, Offsets, PersistentState, Rest, SYSTEMS, System, Tool, UnderWay, Variable,
};

/// The state of a generation.
#[must_use]
pub(crate) fn kept_of(generation: u64) -> PersistentState {
    #[allow(clippy::cast_precision_loss, reason = "small numbers")]
    let base = generation as f64 + 0.1;
    let vector = |part: u8| {
        let mut vector = [0.0; AXES];
        for (axis, value) in (0_u8..).zip(&mut vector) {
            *value = base * 1000.0 + f64::from(part) * 10.0 + f64::from(axis) / 3.0;
        }
        vector
    };
    let mut systems = [System::default(); SYSTEMS];
    for (number, system) in (10_u8..).zip(&mut systems) {
        system.origin = vector(number);
        system.rotation_deg = base;
    }
    let offsets = Offsets {
        active: u8::try_from(generation % 9).unwrap_or_default() + 1,
        g28: vector(1),
        g30: vector(2),
        g92: vector(3),
        systems,
    };
    // Files of many lengths, so that a part of one is never the whole of another.
    let tools = (1..=u32::try_from(generation % 40).unwrap_or_default())
        .map(|number| Tool {
            number,
            edge: 1 + number % 3,
            offset: vector(4),
            diameter_mm: base,
            orientation: 3,
        })
        .collect();
    let variables: Vec<Variable> = (500..500 + u32::try_from(generation % 7).unwrap_or_default())
        .map(|number| Variable {
            number,
            value: base,
        })
        .collect();
    PersistentState {
        configuration: generation.wrapping_mul(0x9e37_79b9_7f4a_7c15),
        spindle_tool: u32::try_from(generation % 1000).unwrap_or_default(),
        tool_table: generation,
        offsets: offsets.clone(),
        rest: Some(Rest {
            position: vector(5),
            clean: generation.is_multiple_of(2),
        }),
        under_way: generation.is_multiple_of(3).then(|| UnderWay {
            program: generation,
            offsets,
            tools: Vec::new(),
            variables: variables.clone(),
            tolerance_ratio: if generation.is_multiple_of(2) {
                1.0
            } else {
                2.5
            },
        }),
        tools,
        variables,
    }
}
