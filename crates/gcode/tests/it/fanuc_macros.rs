//! Tests of FANUC's macros: the local variables of G66, and conditions. Values are computed by hand.

use glidepath_gcode::check;

use crate::fanuc_calls::{ends, options};
use crate::support::listed;

fn last(text: &str) -> [f64; 3] {
    *ends(text).last().expect("a move")
}

#[test]
fn locals_of_g66_are_set_once_and_kept_from_call_to_call() {
    let counts = "\nM30\nO9\nG0 Y#1\n#1=#1+1\n#2=#2+10\nM99\nO8\nX5\nM99";
    let places = |text: &str| -> Vec<[f64; 2]> {
        let all = ends(&format!("{text}{counts}"));
        all.iter().map(|[x, y, _]| [*x, *y]).collect()
    };
    let twice = [[10.0, 0.0], [10.0, 1.0], [20.0, 1.0], [20.0, 2.0]];
    assert_eq!(places("G66 P9 A1.\nG0 X10.\nX20.\nG67"), twice);
    // A block of a subprogram calls it with them, too; another G66 sets them anew.
    let found = places("G66 P9 A1.\nG0 X10.\nM98 P8\nG67\nG66 P9 A7.\nX1.\nG67");
    let anew = [[5.0, 1.0], [5.0, 2.0], [1.0, 2.0], [1.0, 7.0]];
    assert_eq!(found[2..], anew);
    // They are not those of the program.
    assert_eq!(places("#1=3.\nG66 P9 A1.\nG0 X1.\nG67\nX#1")[2], [3.0, 1.0]);
    // L calls go on from each other as well.
    assert_eq!(places("G66 P9 L2 A1.\nG0 X1.\nX2.\nG67")[5], [2.0, 4.0]);
}

#[test]
fn comparisons_have_brackets_of_their_own_beside_and_and_or() {
    for text in [
        "IF[#1 EQ 5 AND 3 EQ 3]GOTO9\nN9",
        "#1=5\nIF[#1 EQ 5 OR #1 EQ 6]THEN #2=1",
        "#1=9\nWHILE[#1 LT 5 AND #1 GT 3]DO1\nEND1",
        "#1=[1 LT 2 LT 3]",
    ] {
        let report = check(text.as_bytes(), options());
        let found = listed(&report);
        assert!(
            found.iter().any(|one| one.ends_with(" expression")),
            "{text} {found:?}"
        );
    }
    assert_eq!(
        last("#1=5\nIF[[#1 EQ 5] AND [3 EQ 3]]GOTO9\nG0 X1\nN9 G0 X2")[0],
        2.0
    );
    // Of bits AND is done first: 5 AND 4 is 4.
    assert_eq!(
        last("#1=5\nIF[#1 AND 4 EQ 4]GOTO9\nG0 X1\nN9 G0 X2")[0],
        2.0
    );
    assert_eq!(
        last("#1=5\nIF[4 EQ #1 AND 4]GOTO9\nG0 X1\nN9 G0 X2")[0],
        2.0
    );
}
