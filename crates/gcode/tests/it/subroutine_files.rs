//! Tests of subroutines in files of their own.

#![expect(
    clippy::panic,
    clippy::unwrap_used,
    reason = "a wrong program fails the test"
)]

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use glidepath_gcode::{
    Dialect, MAX_SUBROUTINE_BYTES, NoSubroutineFile, Options, Program, SubroutineFile, Subroutines,
    check,
};
use glidepath_program::ItemKind;

/// Options with these files in a folder called `lib`.
fn options(files: &[(&str, &str)]) -> Options {
    let files: Vec<(String, String)> = files
        .iter()
        .map(|(name, text)| ((*name).to_owned(), (*text).to_owned()))
        .collect();
    let subroutines = Subroutines::new(move |wanted| {
        let file = files.iter().find(|(name, _)| name == wanted);
        let (name, text) = file.ok_or(NoSubroutineFile::Missing {
            looked_in: vec!["here".to_owned(), "lib".to_owned()],
        })?;
        Ok(SubroutineFile {
            name: format!("lib/{name}").into(),
            text: text.as_bytes().into(),
        })
    });
    Options {
        subroutines: Some(subroutines),
        ..Options::default()
    }
}

/// Line and X of the end of every move.
fn path(text: &str, options: Options) -> Vec<(u32, f64)> {
    let program = Program::new(text.as_bytes(), options);
    let items =
        program.map(|item| item.unwrap_or_else(|diagnostic| panic!("{text}\n{diagnostic}")));
    let end = |item: glidepath_program::Item| match item.kind {
        ItemKind::Move { segment, .. } => Some((item.line, segment.end()[0])),
        _ => None,
    };
    items.filter_map(end).collect()
}

#[track_caller]
fn finds(text: &str, options: Options, expected: &str) -> glidepath_gcode::Diagnostic {
    let report = check(text.as_bytes(), options);
    let found: Vec<String> = report
        .diagnostics
        .iter()
        .map(|d| {
            let file = d.file.as_deref().unwrap_or("-");
            format!("{file}:{}:{} {}", d.line, d.column, d.code)
        })
        .collect();
    assert_eq!(found, [expected], "{text}");
    report.diagnostics.into_iter().next().unwrap()
}

#[test]
fn a_call_reads_the_file_of_that_name() {
    let options = options(&[
        (
            "step.ngc",
            "%\no<step> sub\nG0 X[#1+#<_more>]\no<step> endsub [7]\nM2\n%",
        ),
        ("100.ngc", "(holes)\nO100 sub\nX#1\no100 endsub"),
    ]);
    let text = "#<_more>=1\no<Step> call [2]\nG0 X#<_value>\nO100 call [9]\no[99+1] call [3]";
    let expected = [(2, 3.0), (3, 7.0), (4, 9.0), (5, 3.0)];
    assert_eq!(path(text, options), expected);
}

#[test]
fn moves_of_a_file_have_the_line_of_the_program_that_calls_it() {
    let options = options(&[
        (
            "a.ngc",
            "o<a> sub\n\n\n\n\n\nG0 X1\no<b> call\no<own> call\nX4\no<a> endsub",
        ),
        ("b.ngc", "o<b> sub\n\n\n\n\n\n\n\n\nX2\no<b> endsub"),
    ]);
    let text = "o<own> sub\nX3\no<own> endsub\no<a> call";
    let expected = [(4, 1.0), (4, 2.0), (2, 3.0), (4, 4.0)];
    assert_eq!(path(text, options), expected);
}

#[test]
fn what_the_program_defines_comes_first() {
    let options = options(&[("a.ngc", "o<a> sub\nG0 X9\no<a> endsub")]);
    let text = "o<a> sub\nG0 X1\no<a> endsub\no<a> call";
    assert_eq!(path(text, options), [(2, 1.0)]);
}

#[test]
fn only_the_subroutine_of_that_name_is_read() {
    let files = [(
        "a.ngc",
        "this is no program\no<help> sub\nG0 X5\no<help> endsub\no<a> sub\nG0 X1\no<help> call\n\
         o<a> endsub\nneither is this",
    )];
    let text = "o<a> call";
    finds(text, options(&files), "lib/a.ngc:7:1 unknown-subroutine");
    let both = [files[0], ("help.ngc", "o<help> sub\nX2\no<help> endsub")];
    assert_eq!(path(text, options(&both)), [(1, 1.0), (1, 2.0)]);
}

#[test]
fn a_file_is_read_once() {
    let asked = Arc::new(AtomicUsize::new(0));
    let counter = Arc::clone(&asked);
    let subroutines = Subroutines::new(move |_| {
        counter.fetch_add(1, Ordering::Relaxed);
        Ok(SubroutineFile {
            name: "a.ngc".into(),
            text: b"o<a> sub\nG0 X#1\no<a> endsub".as_slice().into(),
        })
    });
    let options = Options {
        subroutines: Some(subroutines.clone()),
        ..Options::default()
    };
    let text = "o1 repeat [1000]\n#2=[#2+1]\no<a> call [#2]\no1 endrepeat";
    assert!(check(text.as_bytes(), options.clone()).is_accepted());
    assert_eq!(path(text, options).len(), 1000);
    assert_eq!(asked.load(Ordering::Relaxed), 1);
    let read: Vec<String> = subroutines
        .read()
        .into_iter()
        .map(|(name, _)| name)
        .collect();
    assert_eq!(read, ["a.ngc"]);
}

#[test]
fn diagnostics_name_the_file_they_are_in() {
    let with = |text| options(&[("a.ngc", text)]);
    let block = "G21\no<a> sub\nG0 X1.2.3\no<a> endsub";
    let diagnostic = finds("\no<a> call", with(block), "lib/a.ngc:3:5 malformed-number");
    assert!(diagnostic.to_string().starts_with("lib/a.ngc:3:5: error["));
    let cycle = "o<a> sub\no5 sub\no<a> endsub";
    finds("o<a> call", with(cycle), "lib/a.ngc:2:1 flow-structure");
    let open = "o<a> sub\no2 if [1]\no<a> endsub";
    finds("o<a> call", with(open), "lib/a.ngc:3:1 flow-structure");
    let endless = "\no<a> sub\nG0 X1\n%\no<a> endsub";
    finds("o<a> call", with(endless), "lib/a.ngc:2:1 flow-structure");
    let lathe = "o<a> sub\nG18 F9\nG71 Q7 X9 Z2\no<a> endsub";
    let text = "o7 sub\nG0 X1 Z0\no7 endsub\no<a> call";
    finds(text, with(lathe), "lib/a.ngc:3:5 canned-cycle");
    finds(
        "o<a> call",
        with("o<a> sub\nG0 X1\0\no<a> endsub"),
        "lib/a.ngc:2:6 nul-byte",
    );
    finds(
        "o<a> call",
        with("\u{feff}o<a> sub x"),
        "lib/a.ngc:1:10 flow-structure",
    );
}

#[test]
fn what_cannot_be_called_is_refused_at_the_call() {
    let none = options(&[]);
    let missing = finds(
        "G0 X1\n o<drill> call",
        none.clone(),
        "-:2:2 unknown-subroutine",
    );
    assert!(
        missing.reason.contains("no drill.ngc in here, lib"),
        "{}",
        missing.reason
    );
    assert!(missing.help.contains("--subroutine-path"));
    let other = options(&[("a.ngc", "o<b> sub\no<b> endsub")]);
    finds("o<a> call", other, "-:1:1 unknown-subroutine");
    for name in ["../a", "sub/a", "/etc/a", "..", ".a", "a\\b", ""] {
        let climbing = options(&[("../a.ngc", "o<../a> sub\no<../a> endsub")]);
        let text = format!("o<{name}> call");
        let diagnostic = finds(&text, climbing, "-:1:1 unknown-subroutine");
        assert!(
            diagnostic.message.contains("file's name"),
            "{}",
            diagnostic.message
        );
    }
    let huge = "\n".repeat(MAX_SUBROUTINE_BYTES + 1);
    finds(
        "o<a> call",
        options(&[("a.ngc", &huge)]),
        "-:1:1 flow-too-long",
    );
    finds("o<a> call", Options::default(), "-:1:1 unknown-subroutine");
    let unreadable = Subroutines::new(|name| {
        Err(NoSubroutineFile::Unreadable {
            path: name.to_owned(),
            reason: "no".to_owned(),
        })
    });
    let unreadable = Options {
        subroutines: Some(unreadable),
        ..Options::default()
    };
    finds("o<a> call", unreadable, "-:1:1 read-failed");
}

#[test]
fn the_depth_of_calls_and_the_length_of_loops_are_bounded() {
    let recursive = [
        ("a.ngc", "o<a> sub\no<b> call\no<a> endsub"),
        ("b.ngc", "o<b> sub\no<a> call\no<b> endsub"),
    ];
    finds("o<a> call", options(&recursive), "lib/b.ngc:2:1 call-depth");
    let mut endless = options(&[(
        "a.ngc",
        "o<a> sub\no1 while [1]\n\no1 endwhile\no<a> endsub",
    )]);
    endless.loops.idle_lines = 1000;
    let report = check("o<a> call".as_bytes(), endless);
    let diagnostic = report.diagnostics.first().unwrap();
    assert_eq!(diagnostic.code.as_str(), "endless-loop");
    assert_eq!(diagnostic.file.as_deref(), Some("lib/a.ngc"));
}

#[test]
fn block_delete_holds_in_files_too() {
    let text = "o<a> sub\nG0 X1\n/X2\no<a> endsub";
    let read = |block_delete| {
        let options = Options {
            block_delete,
            ..options(&[("a.ngc", text)])
        };
        path("o<a> call", options).len()
    };
    assert_eq!((read(false), read(true)), (2, 1));
}

fn fanuc(files: &[(&str, &str)]) -> Options {
    Options {
        dialect: Dialect::Fanuc,
        ..options(files)
    }
}

#[test]
fn a_fanuc_subprogram_is_in_a_file_of_its_number() {
    for name in ["O0020", "O20", "O00020.nc", "o0020.NC", "20.nc", "0020"] {
        let files = [(name, "%\nO0020 (STEP)\nG91 G0 X1\nG90\nM99\n%\nX7")];
        let text = "O1\nG0 X5\nM98 P20 L2\nX0\nM30";
        let expected = [(2, 5.0), (3, 6.0), (3, 7.0), (4, 0.0)];
        assert_eq!(path(text, fanuc(&files)), expected, "{name}");
    }
    // The first of the order in which they are looked for.
    let files = [
        ("20", "G0 X1\nM99"),
        ("O0020.nc", "G0 X2\nM99"),
        ("O0020", "G0 X3\nM99"),
    ];
    assert_eq!(path("M98 P20\nM30", fanuc(&files)), [(1, 3.0)]);
}

#[test]
fn a_fanuc_macro_in_a_file_has_its_arguments_loops_and_jumps() {
    let files = [
        (
            "O9010.nc",
            "O9010\nWHILE [#1 GT 0] DO 1\nG0 X[#24+#1]\n#1=#1-1\nEND 1\nIF [#1 EQ 0] GOTO 5\nX99\n\
             N5 M98 P11\nM99\nO11\nX-1\nM99",
        ),
        ("O0012", "G65 P13 X#1\nM99"),
        ("O0013", "G0 X#24\nM99"),
    ];
    let text = "O1\n#1=8\nG65 P9010 A2 X10\nM98 P12\nM98 P11\nM30\nO11\nX-2\nM99";
    // O11 is in the text of each caller.
    let expected = [(3, 12.0), (3, 11.0), (3, -1.0), (4, 8.0), (8, -2.0)];
    assert_eq!(path(text, fanuc(&files)), expected);
}

#[test]
fn what_the_program_has_comes_before_files_for_a_fanuc_too() {
    let files = [("O0011", "G0 X1\nM99"), ("O0012", "M98 P11\nM99")];
    let text = "M98 P11\nM98 P12\nM30\nO11\nG91 G0 X5\nG90\nM99";
    assert_eq!(path(text, fanuc(&files)), [(5, 5.0), (5, 10.0)]);
}

#[test]
fn fanuc_files_that_are_wrong_are_refused_where_they_are() {
    let files = [
        ("O0001", "O1\n\nG0 X1 X2\nM99"),
        ("O0002", "O7\nG0 X1\nM99"),
        ("O0003", "G0 X1\n\n(no return)"),
        ("O0004", "O4\nG0 X1\nO5\nX2\nM99"),
        ("O0006", "M98 P6\nM99"),
        ("O0008", "G0 X1\nGOTO 3\nM99"),
    ];
    let found = |program: u32| {
        let text = format!("N10 M98 P{program}\nN3 M30");
        let report = check(text.as_bytes(), fanuc(&files));
        let d = report.diagnostics.first().expect("a diagnostic");
        assert!(!d.reason.is_empty() || !d.help.is_empty(), "{d}");
        format!(
            "{}:{}:{} {}",
            d.file.as_deref().unwrap_or("-"),
            d.line,
            d.column,
            d.code
        )
    };
    assert_eq!(found(1), "lib/O0001:3:7 duplicate-word");
    assert_eq!(found(2), "-:1:5 unknown-subroutine");
    assert_eq!(found(3), "lib/O0003:3:1 flow-structure");
    assert_eq!(found(4), "lib/O0004:3:1 flow-structure");
    assert_eq!(found(6), "lib/O0006:1:1 call-depth");
    assert_eq!(found(8), "lib/O0008:2:5 flow-structure");
    assert_eq!(found(9), "-:1:5 unknown-subroutine");
    let text = "M98 P51001";
    let refused = finds(text, fanuc(&files), "-:1:1 unknown-subroutine");
    assert!(refused.help.contains("M98 P1001 L5"), "{refused}");
    assert!(refused.reason.contains("here, lib"), "{refused}");
}
