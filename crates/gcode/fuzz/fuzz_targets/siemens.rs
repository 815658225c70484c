//! Any SINUMERIK program made of its statements is judged in bounded time, and what is given out is
//! sound.
#![no_main]

use std::fmt::Write;
use std::sync::Arc;

use glidepath_gcode::{Connections, Dialect, LoopLimits, Options, Program, Tool, ToolTable, check};
use glidepath_program::ItemKind;
use libfuzzer_sys::fuzz_target;

const LINES: [&str; 48] = [
    "IF @", "ELSE", "ENDIF", "WHILE @", "ENDWHILE", "FOR R1=@ TO @", "ENDFOR", "LOOP", "ENDLOOP",
    "REPEAT", "UNTIL @", "GOTOF A_A", "GOTOB A_A", "GOTO B_B", "GOTOC N7", "IF @ GOTOB A_A", "A_A:",
    "B_B: G0 X=@", "N7 R1=@", "REPEAT A_A P=@", "REPEAT A_A B_B", "REPEATB B_B P=@", "ENDLABEL:",
    "DEF REAL A_A=@, C_C", "DEF INT D_D=@", "C_C=@", "D_D=@ E_E=@", "TRANS X=@ Z=@", "ATRANS Y=@",
    "ROT X=@ Y=@ Z=@", "AROT RPL=@", "MIRROR X0", "AMIRROR Z0", "SCALE X=@ Y=@ Z=@", "ASCALE X=@",
    "G0 X=@ Y=@ Z=@", "G1 X=IC(@) Y=AC(@) F=@", "G2 X=@ Y=@ CR=@", "G3 I=@ J=AC(@) TURN=@",
    "G18 G91", "G17 G90 M3 S100", "T1 M6 G41 D1", "G40",
    "CYCLE83(@,@,@,@,@,@,@,@,@,@,@,@)", "MCALL CYCLE81(@,@,@,@)", "MCALL",
    "POCKET3(@,@,@,@,@,@,@,@,@,@,@,@,@,@,@,@,@,@)", "POCKET4(@,@,@,@,@,@,@,@,@,@,@,@,@,@)",
];

const VALUES: [&str; 24] = [
    "R1", "R2", "0", "1", "-1", "2.5", "10", "-10", "20", "90", "45", "30", "(R1+1)", "R[R1]", "A_A",
    "D_D", "(R1<3)", "(R1==2) AND TRUE", "SIN(R1)", "1/R1", "11", "12", "0.001", "1000000",
];

fn program(bytes: &[u8]) -> String {
    let mut text = String::new();
    let mut bytes = bytes.iter().copied();
    while let Some(line) = bytes.next() {
        for part in LINES[usize::from(line) % LINES.len()].split_inclusive('@') {
            let Some(before) = part.strip_suffix('@') else {
                text.push_str(part);
                continue;
            };
            let value = VALUES[usize::from(bytes.next().unwrap_or(0)) % VALUES.len()];
            write!(text, "{before}{value}").expect("a string");
        }
        text.push('\n');
    }
    text
}

fuzz_target!(|bytes: &[u8]| {
    let text = program(bytes);
    let mut tools = ToolTable::new();
    tools.set(1, Tool { diameter_mm: 6.0, ..Tool::default() });
    let options = Options {
        dialect: Dialect::Siemens,
        connections: Connections::Simulated,
        default_feed_mm_min: Some(1000.0),
        tools: Some(Arc::new(tools)),
        loops: LoopLimits {
            idle_lines: 2_000,
            checked_lines: 4_000,
            may_run_unchecked: false,
        },
        ..Options::default()
    };
    let lines = text.lines().count();
    let report = check(text.as_bytes(), options.clone());
    for diagnostic in &report.diagnostics {
        assert!((1..=lines).contains(&(diagnostic.line as usize)), "{text}\n{diagnostic:?}");
        let length = text.lines().nth(diagnostic.line as usize - 1).map_or(0, str::len);
        assert!(diagnostic.column as usize <= length + 1, "{text}\n{diagnostic:?}");
        assert!(!diagnostic.message.is_empty());
    }
    let mut end = options.start;
    for item in Program::new(text.as_bytes(), options).take(5_000) {
        let Ok(item) = item else { return };
        if let ItemKind::Move { segment, .. } = item.kind {
            assert_eq!(segment.start(), end, "{text}");
            end = segment.end();
            assert!(end.iter().all(|p| p.is_finite()) && segment.length() > 0.0, "{text}");
        }
    }
});
