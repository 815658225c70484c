//! Tests of parameters, expressions in blocks, subroutines, branches and loops.

#![expect(clippy::panic, reason = "a wrong program fails the test")]

use crate::support::listed;
use glidepath_gcode::{Options, Program, check};
use glidepath_program::ItemKind;

/// X of the end of every move.
fn path(text: &str) -> Vec<f64> {
    let program = Program::new(text.as_bytes(), Options::default());
    let items =
        program.map(|item| item.unwrap_or_else(|diagnostic| panic!("{text}\n{diagnostic}")));
    let end = |kind: ItemKind| match kind {
        ItemKind::Move { segment, .. } => Some((segment.end()[0] * 1e9).round() / 1e9),
        _ => None,
    };
    items.filter_map(|item| end(item.kind)).collect()
}

#[track_caller]
fn goes(text: &str, expected: &[f64]) {
    assert_eq!(path(text), expected, "{text}");
}

#[track_caller]
fn refuses(text: &str, expected: &str) {
    let report = check(text.as_bytes(), Options::default());
    assert_eq!(listed(&report), [expected], "{text}");
}

#[test]
fn parameters_take_effect_after_their_block() {
    goes("#1=3\n#1=5 G0 X#1\nX#1", &[3.0, 5.0]);
    goes("#1=1 #2=[#1+1]\nG0 X#2", &[1.0]);
    goes("#<Size A>=4\nG0 X[#<sizea>*2]", &[8.0]);
    goes("#2=3\n#[1+1]=5\nG0 X##2", &[]);
    goes("#5=7\n#2=5\nG0 X##2", &[7.0]);
    goes("G[0] X[1]\nG#5000 X2", &[1.0, 2.0]);
}

#[test]
fn the_state_can_be_read() {
    goes("G20\nG0 X1\nG21\nX[#5420+1]", &[25.4, 26.4]);
    goes("G0 X1\nG28.1\nG0 X2\nX#5161", &[1.0, 2.0, 1.0]);
    goes("G10 L2 P3 X5 R0\nG0 X#5261", &[5.0]);
    goes("G0 X2\nG92 X1\nG0 X[#5211*10]", &[2.0, 11.0]);
    goes("G0 X[#<_metric> + 2*#<_absolute> + 4*#<_imperial>]", &[3.0]);
    goes("G55 G0 X#5220\nX[#5220+1]", &[1.0, 3.0]);
}

#[test]
fn subroutines_have_parameters_of_their_own() {
    let text = "#1=9 #31=1 #<a>=2\no1 sub\n#31=[#31+#1] #1=0 #<a>=7\nG0 X#31\no1 endsub\n\
                o1 call [4]\no1 call [5]\nG0 X[#1+#<a>]";
    goes(text, &[5.0, 10.0, 11.0]);
    let text = "o<twice> sub\no<twice> return [#1*2]\nG0 X99\no<twice> endsub\n\
                o<TWICE> call [21]\nG0 X#<_value>";
    goes(text, &[42.0]);
    let text = "o7 sub\nG0 X#1\no7 endsub\n#1=3\no#[1] call [1]\no[#1+4] call [2]";
    refuses(text, "5:1 unknown-subroutine");
    goes(
        "o7 sub\nG0 X#1\no7 endsub\n#3=7\no#3 call [1]\no[#3] call [2]",
        &[1.0, 2.0],
    );
    // A subroutine may call one that is defined later, once it is.
    goes(
        "o1 sub\no2 call\no1 endsub\no2 sub\nG0 X1\no2 endsub\no1 call",
        &[1.0],
    );
}

#[test]
fn recursion_computes() {
    let text = "o1 sub\no2 if [#1 GT 1]\no1 call [#1-1]\n#2=[#1*#<_value>]\no2 else\n#2=1\n\
                o2 endif\no1 endsub [#2]\no1 call [6]\nG0 X#<_value>";
    goes(text, &[720.0]);
}

#[test]
fn branches() {
    for (value, expected) in [(1, 10.0), (2, 20.0), (3, 30.0), (4, 40.0)] {
        let text = format!(
            "#1={value}\nN5 o1 if [#1 EQ 1] (c)\nG0 X10\no1 elseif [#1 EQ 2]\nG0 X20\n\
             O 1 ELSEIF [#1 EQ 3]\nG0 X30\no1 else\nG0 X40\no1 endif ; d\n"
        );
        goes(&text, &[expected]);
    }
    goes("o1 if [0]\nG0 X1\no1 endif\nG0 X2", &[2.0]);
    goes(
        "o1 if [1]\no2 if [0]\nG0 X1\no2 endif\nG0 X2\no1 endif",
        &[2.0],
    );
    // The branch that is not taken is not computed.
    goes("o1 if [1]\nG0 X1\no1 elseif [1/0]\no1 endif", &[1.0]);
}

#[test]
fn loops() {
    goes(
        "o1 while [#1 LT 3]\n#1=[#1+1]\nG0 X#1\no1 endwhile\nG0 X9",
        &[1.0, 2.0, 3.0, 9.0],
    );
    goes(
        "o1 do\n#1=[#1+1]\nG0 X#1\no1 while [#1 LT 3]\nG0 X9",
        &[1.0, 2.0, 3.0, 9.0],
    );
    goes(
        "o1 repeat [2]\nG91 G0 X1\no1 endrepeat\nX5",
        &[1.0, 2.0, 7.0],
    );
    goes("o1 repeat [0]\nG0 X1\no1 endrepeat\nG0 X2", &[2.0]);
    goes(
        "G91\no1 repeat [2]\no2 repeat [3]\nG0 X1\no2 endrepeat\no1 endrepeat\nX10",
        &[1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 16.0],
    );
}

#[test]
fn loops_are_left_and_continued() {
    let text = "o1 while [1]\n#1=[#1+1]\no2 if [#1 EQ 2]\no1 continue\no2 elseif [#1 EQ 4]\n\
                o1 break\no2 endif\nG0 X#1\no1 endwhile\nG0 X9";
    goes(text, &[1.0, 3.0, 9.0]);
    let text = "o1 do\n#1=[#1+1]\no2 if [#1 EQ 2]\no1 continue\no2 endif\nG0 X#1\n\
                o1 while [#1 LT 3]\n";
    goes(text, &[1.0, 3.0]);
    // Out of two loops at once: the counter of the inner one is forgotten.
    let text = "G91\no1 repeat [3]\no2 repeat [5]\nG0 X1\no1 continue\no2 endrepeat\n\
                o1 endrepeat\nX10";
    goes(text, &[1.0, 2.0, 3.0, 13.0]);
    let text =
        "G91\no1 repeat [3]\no2 repeat [5]\nG0 X1\no1 break\no2 endrepeat\no1 endrepeat\nX10";
    goes(text, &[1.0, 11.0]);
    // Out of a subroutine from within a loop.
    let text = "o1 sub\no2 repeat [5]\nG91 G0 X1\no1 return\no2 endrepeat\no1 endsub\n\
                o3 repeat [2]\no1 call\no3 endrepeat\nX10";
    goes(text, &[1.0, 2.0, 12.0]);
}

#[test]
fn the_program_may_end_inside_a_part() {
    goes("o1 sub\nG0 X1\nM2\no1 endsub\no1 call\nG0 X2", &[1.0]);
    goes("o1 if [1]\nG0 X1\nM30\no1 endif\nG0 X2", &[1.0]);
}

#[test]
fn what_does_not_fit_together_is_refused() {
    refuses("o1 sub\nG0 X1\n", "1:1 flow-structure");
    refuses("o1 while [1]\nG0 X1\n%\n", "1:1 flow-structure");
    refuses("o1 sub\no2 sub\n", "2:1 flow-structure");
    refuses("o1 if [1]\no1 endwhile", "2:1 flow-structure");
    refuses("o1 if [1]\no2 endif", "2:1 flow-structure");
    refuses(
        "o1 if [1]\no1 else\no1 elseif [1]\no1 endif",
        "3:1 flow-structure",
    );
    refuses("o1 endif", "1:1 flow-structure");
    refuses("o1 return", "1:1 flow-structure");
    refuses("o1 break", "1:1 flow-structure");
    refuses("o1 while [1]\no2 break\no1 endwhile", "2:1 flow-structure");
    refuses("o1 if [1]\no1 break\no1 endif", "2:1 flow-structure");
    refuses("o1 sub\no1 endsub\no1 sub\no1 endsub", "3:1 flow-structure");
    refuses("o1 if\no1 endif", "1:1 flow-structure");
    refuses("o1 if [1] G0 X1\no1 endif", "1:11 flow-structure");
    refuses("o1 frobnicate", "1:4 flow-structure");
    refuses("G0 X1 o1 call", "1:7 flow-structure");
    refuses("o1.5 call", "1:1 flow-structure");
    refuses("o#1 sub\n", "1:1 flow-structure");
    refuses("o1 call", "1:1 unknown-subroutine");
    refuses("o1 sub\no1 call\no1 endsub\no1 call", "2:1 call-depth");
    refuses("o1 while [1]\no1 endwhile", "1:1 endless-loop");
    refuses("o1 while [1/0]\no1 endwhile\nG0 X--1", "1:12 arithmetic");
    refuses("o1 repeat [2]\nG0 X[1/0]\no1 endrepeat\n", "2:7 arithmetic");
    refuses("#<_x>=1", "1:1 parameter");
    refuses("#5220=1", "1:1 parameter");
    refuses("#6000=1", "1:1 parameter");
    refuses("G0 X#<nothing>", "1:5 parameter");
    refuses("#1 G0", "1:1 expression");
}

#[test]
fn memory_of_kept_lines_is_bounded() {
    let line = format!("({})\n", "x".repeat(60_000));
    let text = format!("o1 sub\n{}o1 endsub\n", line.repeat(600));
    let report = check(text.as_bytes(), Options::default());
    assert_eq!(report.diagnostics[0].code.as_str(), "flow-too-long");
}

#[test]
fn an_endless_program_with_motion_is_checked_in_part() {
    let text = "G91 F1000\no1 while [1]\nG1 X1\nX-1\no1 endwhile\n";
    let report = check(text.as_bytes(), Options::default());
    assert!(report.is_accepted() && !report.is_complete());
    assert_eq!(
        Program::new(text.as_bytes(), Options::default())
            .take(1000)
            .count(),
        1000
    );
}

#[test]
fn deleted_lines_are_not_kept() {
    let text = "o1 repeat [2]\n/G0 X1\n/o1 break\nG91 G0 X3\no1 endrepeat\n";
    let options = Options {
        block_delete: true,
        ..Options::default()
    };
    assert_eq!(Program::new(text.as_bytes(), options).count(), 2);
    goes(text, &[1.0]);
}

#[test]
fn values_as_near_as_a_ten_thousandth_are_equal() {
    // As LinuxCNC has it.
    let report = check(
        "G0 X[1 EQ 1.00009] Y[1 NE 1.00009] Z[1 EQ 1.0002]".as_bytes(),
        Options::default(),
    );
    assert_eq!(report.final_position.as_slice()[..3], [1.0, 0.0, 0.0]);
}
