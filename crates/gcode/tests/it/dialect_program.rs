//! Programs made of the statements of a dialect, and what has to be true of any of them. The fuzz
//! targets of the dialects are built on it, too.

use std::fmt::Write;
use std::sync::Arc;

use glidepath_gcode::{Connections, Dialect, LoopLimits, Options, Program, Tool, ToolTable, check};
use glidepath_geometry::Axis;
use glidepath_kinematics::{FiveAxis, Rotaries, Tilt};
use glidepath_program::ItemKind;
use nalgebra::Vector3;

const SIEMENS: [&str; 106] = [
    "IF @",
    "ELSE",
    "ENDIF",
    "WHILE @",
    "ENDWHILE",
    "FOR R1=@ TO @",
    "ENDFOR",
    "LOOP",
    "ENDLOOP",
    "REPEAT",
    "UNTIL @",
    "GOTOF A_A",
    "GOTOB A_A",
    "GOTO B_B",
    "GOTOC N7",
    "IF @ GOTOB A_A",
    "A_A:",
    "B_B: G0 X=@",
    "N7 R1=@",
    "REPEAT A_A P=@",
    "REPEAT A_A B_B",
    "REPEATB B_B P=@",
    "ENDLABEL:",
    "DEF REAL A_A=@, C_C",
    "DEF INT D_D=@",
    "C_C=@",
    "D_D=@ E_E=@",
    "TRANS X=@ Z=@",
    "ATRANS Y=@",
    "ROT X=@ Y=@ Z=@",
    "AROT RPL=@",
    "MIRROR X0",
    "AMIRROR Z0",
    "SCALE X=@ Y=@ Z=@",
    "ASCALE X=@",
    "G0 X=@ Y=@ Z=@",
    "G1 X=IC(@) Y=AC(@) F=@",
    "G2 X=@ Y=@ CR=@",
    "G3 I=@ J=AC(@) TURN=@",
    "G18 G91",
    "G17 G90 M3 S100",
    "T1 M6 G41 D1",
    "G40",
    "CYCLE83(@,@,@,@,@,@,@,@,@,@,@,@)",
    "MCALL CYCLE81(@,@,@,@)",
    "MCALL",
    "POCKET3(@,@,@,@,@,@,@,@,@,@,@,@,@,@,@,@,@,@)",
    "POCKET4(@,@,@,@,@,@,@,@,@,@,@,@,@,@)",
    "POCKET1(@,@,@,@,,@,@,@,@,@,@,@,@,@,@,@,@)",
    "POCKET2(@,@,@,,@,@,@,@,@,@,@,@,@,@)",
    "POCKET1(20,0,2,-@,,50,30,5,@,@,@,100,300,@,2,1,@)",
    "CYCLE71(@,@,@,@,@,@,@,@,@,@,@,@,@,@,@,@)",
    "CYCLE71(20,0,2,-@,@,@,50,30,@,@,4,@,@,300,31,@)",
    "CYCLE76(@,@,@,@,,@,@,@,@,@,@,@,@,@,@,@,@,@)",
    "CYCLE77(20,0,2,-@,,50,@,@,@,@,@,300,100,3,1,80)",
    "CYCLE84(@,@,@,@,,@,@,@,@,@,@,@,@,@,@,@,@,@)",
    "CYCLE840(@,@,@,@,,@,@,@,@,@,@,@,@,@)",
    "CYCLE95(\"L1\",@,@,@,@,@,@,@,@,,,@)",
    "CYCLE95(\"A_A:B_B\",@,,,,100,,50,@)",
    "CYCLE97(@,,@,@,@,@,@,@,@,@,@,@,@,@,@,@,@)",
    "CYCLE97(2,,0,-30,20,20,3,2,@,@,@,@,@,@,1,@)",
    "HOLES1(@,@,@,@,@,@)",
    "HOLES2(@,@,@,@,@,@)",
    "CYCLE801(@,@,@,@,@,@,@)",
    "DIAMON",
    "DIAMOF",
    "G1 AP=@ RP=@",
    "AP=@",
    "G111 X=@ Y=@",
    "G110 AP=@ RP=@",
    "G112 X=@",
    "G3 AP=@ RP=@",
    "G2 X=@ Y=@ AR=@",
    "G3 I=@ J=@ AR=@",
    "CIP X=@ Y=@ Z=@ I1=@ J1=@ K1=@",
    "CT X=@ Y=@",
    "G1 ANG=@",
    "G1 X=@ ANG=@",
    "X=@ Y=@ ANG=@",
    "G0 C=DC(@) A=ACP(@)",
    "C=ACN(@)",
    "G70",
    "G710",
    "DEF REAL F_F[3]=SET(@,@)",
    "F_F[@]=@",
    "F_F=REP(@)",
    "CASE(@) OF 1 GOTOF A_A 2 GOTOB B_B",
    "L1 P@",
    "%_N_L1_SPF",
    "M17",
    "TRAORI",
    "TRAFOOF",
    "G1 X=@ A3=@ B3=@ C3=@ F=@",
    "G1 A=@ C=@",
    "CYCLE800(0,\"\",0,57,@,@,@,@,@,@,@,@,@,-1)",
    "CYCLE800()",
    "CYCLE802(121,111,@,@,@,@)",
    "DEF STRING[9] S_S=\"A_\", T_T[2]",
    "S_S=S_S<<@ T_T[@]=S_S",
    "IF S_S==\"A_A\" GOTOF \"B_\"<<T_T[1]",
    "GOTOB S_S<<\"A\"",
    "$P_PFRAME=CTRANS(X,@):CROT(Z,@):CSCALE(Y,@)",
    "$P_PFRAME[X,TR]=$P_PFRAME[Z,RT]+@",
    "R1=@ B_AND @ R2=B_NOT R1",
    "G33 Z=@ X=@ K=@",
    "M3 S500 G97",
];

const FANUC: [&str; 61] = [
    "M3 S500 G97",
    "G33 Z@ X@ F@",
    "G28",
    "G0 X@ Y@ Z@",
    "G1 X@ Y@ F@",
    "G2 X@ Y@ R@",
    "G3 I@ J@ Z@ F@",
    "G1 A@ C@ F@",
    "G91",
    "G90",
    "G20",
    "G21",
    "G17",
    "G18",
    "G43 H1 Z@",
    "G44 H1",
    "G49",
    "G43.4 H1",
    "G234 H0",
    "G68 X@ Y@ R@",
    "G69",
    "G51 X@ Y@ P@",
    "G50",
    "G51.1 X@",
    "G50.1",
    "G16",
    "G15",
    "G68.2 X@ Y@ Z@ I@ J@ K@",
    "G53.1",
    "G254",
    "G255",
    "G53 G0 Z@",
    "G28 Z@",
    "G81 X@ Z@ R@ F@",
    "G83 Z@ R@ Q@ F@",
    "G80",
    "G98",
    "G99",
    "G41 D1",
    "G40",
    "G1 X@ ,R@",
    "G1 Y@ ,C@",
    "G1 X@ ,A@",
    "G1 ,A@",
    "X@ Y@ ,A@",
    "#1=@",
    "#100=@+#1",
    "IF[#1GT@]GOTO7",
    "N7 #1=#1+1.",
    "WHILE[#1LT@]DO1",
    "END1",
    "G65 P100 A@ B@",
    "M98 P100 L3",
    "O100",
    "M99",
    "G66 P100 A@",
    "G67",
    "G10 L2 P1 X@ Y@",
    "G54",
    "G52 X@ Y@",
    "G4 P@",
];

const MARLIN: [&str; 36] = [
    "G0 X@ Y@ Z@",
    "G1 X@ Y@ E@ F@",
    "G2 X@ Y@ I@ J@ E@",
    "G3 X@ Y@ R@",
    "G3 I@ J@ P@",
    "G5 X@ Y@ I@ J@ P@ Q@",
    "G90",
    "G91",
    "M82",
    "M83",
    "G92 E0",
    "G92 X@ Z@",
    "G28",
    "G28 X Y",
    "G4 P@",
    "G4 S@",
    "G20",
    "G21",
    "G60 S@",
    "G61 S@ F@",
    "G61 X@ Z",
    "G61 E",
    "SET_GCODE_OFFSET Z=@",
    "SET_GCODE_OFFSET X_ADJUST=@ MOVE=1",
    "SAVE_GCODE_STATE NAME=A",
    "RESTORE_GCODE_STATE NAME=A MOVE=1 MOVE_SPEED=@",
    "RESTORE_GCODE_STATE NAME=B",
    "M104 S@",
    "M107",
    "EXCLUDE_OBJECT_START NAME=a",
    "N1 G1 X@*5",
    "M117 text",
    "M220 S100",
    "G29",
    "M400",
    "START_PRINT",
];

const LINUXCNC: [&str; 30] = [
    "G0 X@ Y@ Z@",
    "G1 X@ Y@ F@",
    "G2 X@ Y@ R@",
    "G3 I@ J@ Z@ P@",
    "G1 A@ C@ F@",
    "G91",
    "G90",
    "G20",
    "G21",
    "G18",
    "G17",
    "G10 L2 P1 X@ R@",
    "G92 X@",
    "G52 X@",
    "G81 X@ Z@ R@",
    "G83 Z@ R@ Q@",
    "G80",
    "G5 X@ Y@ I@ J@ P@ Q@",
    "#1=@",
    "#<a>=@",
    "o1 while [#1 LT @]",
    "o1 endwhile",
    "o2 if [@ GT #1]",
    "o2 endif",
    "o3 sub",
    "o3 endsub",
    "o3 call [@]",
    "G61",
    "G64 P@",
    "G93",
];

const VALUES: [&str; 24] = [
    "0", "1", "-1", "2.5", "10", "-10", "20", "90", "45", "30", "11", "12", "0.001", "1000000",
    "-45.", "100", "5", "-0.5", "360", "270", "3", "7", "200", "1.",
];

const OF_SIEMENS: [&str; 12] = [
    "R1", "R2", "(R1+1)", "R[R1]", "A_A", "D_D", "(R1<3)", "SIN(R1)", "1/R1", "F_F[R1]", "IC(2)",
    "TRUE",
];

const OF_FANUC: [&str; 8] = [
    "#1", "#0", "#100", "[#1+1]", "-#1", "#5041", "[1/#1]", "#4003",
];

/// A program of a dialect: each byte is a statement, or a value in it.
pub(crate) fn program(dialect: Dialect, bytes: &[u8]) -> String {
    let (lines, own): (&[&str], &[&str]) = match dialect {
        Dialect::Siemens => (&SIEMENS, &OF_SIEMENS),
        Dialect::Fanuc => (&FANUC, &OF_FANUC),
        Dialect::Marlin => (&MARLIN, &[]),
        Dialect::LinuxCnc => (&LINUXCNC, &["#1", "[#1 + 1]", "#<a>", "[1 / #1]"]),
    };
    let mut text = String::new();
    let mut bytes = bytes.iter().copied();
    while let Some(line) = bytes.next() {
        for part in lines[usize::from(line) % lines.len()].split_inclusive('@') {
            let Some(before) = part.strip_suffix('@') else {
                text.push_str(part);
                continue;
            };
            let which = usize::from(bytes.next().unwrap_or(0)) % (VALUES.len() + own.len());
            let value = VALUES
                .get(which)
                .copied()
                .unwrap_or_else(|| own[which - VALUES.len()]);
            write!(text, "{before}{value}").expect("a string");
        }
        text.push('\n');
    }
    text
}

/// A machine with five axes and an extruder.
pub(crate) fn options(dialect: Dialect) -> Options {
    let mut tools = ToolTable::new();
    let mut tool = Tool {
        diameter_mm: 6.0,
        ..Tool::default()
    };
    tool.offset[2] = 12.5;
    tools.set(1, tool);
    Options {
        dialect,
        connections: Connections::Simulated,
        default_feed_mm_min: Some(1000.0),
        extruder: Some(Axis::U),
        five_axis: Some(FiveAxis {
            rotaries: Rotaries::TableTable {
                tilt_point: Vector3::new(1.0, 2.0, 3.0),
                rotary_point: Vector3::new(-4.0, 5.0, 0.0),
            },
            tilt: Tilt::A,
            tilt_reversed: false,
            rotary_reversed: true,
            tool_mm: 80.0,
        }),
        tools: Some(Arc::new(tools)),
        loops: LoopLimits {
            idle_lines: 500,
            checked_lines: 1_000,
            may_run_unchecked: false,
        },
        ..Options::default()
    }
}

/// Items of a program that are looked at. In an endless loop hundreds of lines may come before each.
const ITEMS: usize = 1_000;

/// What has to be true of a program: diagnostics are of its text, moves begin where the last one
/// ended, and what was checked to its end without a finding runs without one.
pub(crate) fn judge(dialect: Dialect, text: &str) {
    let options = options(dialect);
    let lines = text.lines().count();
    let report = check(text.as_bytes(), options.clone());
    for diagnostic in &report.diagnostics {
        let line = diagnostic.line as usize;
        assert!((1..=lines.max(1)).contains(&line), "{text}\n{diagnostic:?}");
        let length = text.lines().nth(line - 1).map_or(0, str::len);
        assert!(
            diagnostic.column as usize <= length + 1,
            "{text}\n{diagnostic:?}"
        );
        assert!(!diagnostic.message.is_empty());
    }
    let mut end = options.start;
    for item in Program::new(text.as_bytes(), options).take(ITEMS) {
        let Ok(item) = item else {
            // Loops that are too long are not checked to their end.
            let is_told = !report.diagnostics.is_empty() || report.given_up_at.is_some();
            assert!(is_told, "{text}\n{item:?}");
            return;
        };
        if let ItemKind::Move { segment, .. } = item.kind {
            assert_eq!(segment.start(), end, "{text}\nline {}", item.line);
            end = segment.end();
            assert!(end.iter().all(|p| p.is_finite()), "{text}");
            assert!(
                segment.length() > 0.0,
                "{text}\nline {}: {segment:?}",
                item.line
            );
        }
    }
}
