//! Tests of lines that are typed one by one: they come to what they come to in a file, and one with
//! a finding changes nothing.
//!
//! Runs where the environment variable `GLIDEPATH_CORPUS` names the directory of the programs, and
//! says so where it does not.

use std::fs;
use std::path::PathBuf;
use std::sync::Arc;

use glidepath_gcode::{
    Connections, Dialect, Modal, Options, Program, Tool, ToolTable, WorkOffsets,
};
use glidepath_geometry::AxisVector;
use glidepath_program::ItemKind;
use glidepath_testing::corpus;

/// Moves of a picometre are merged with those that follow: those of another line, in a file.
const MERGED: &str = "malformed/tiny-moves.nc";

/// Programs longer than this are left out.
const MOST_LINES: usize = 20_000;

fn options() -> Options {
    let mut tools = ToolTable::new();
    for number in 1..=99 {
        tools.set(number, Tool::default());
    }
    Options {
        tools: Some(Arc::new(tools)),
        connections: Connections::Simulated,
        ..Options::default()
    }
}

/// What is there behind a program.
#[derive(Debug, PartialEq)]
struct End {
    modal: Modal,
    position: AxisVector,
    offsets: WorkOffsets,
    tool: u32,
}

/// What a program comes to, up to its end or its first finding, whose line is told.
fn run(text: &str, options: Options) -> (Vec<ItemKind>, End, Option<u32>) {
    let mut program = Program::new(text.as_bytes(), options);
    let (mut kinds, mut found) = (Vec::new(), None);
    for item in &mut program {
        match item {
            Ok(item) => kinds.push(item.kind),
            Err(diagnostic) => found = Some(diagnostic.line),
        }
    }
    (kinds, end(&program), found)
}

fn end(program: &Program<&[u8]>) -> End {
    End {
        modal: *program.modal(),
        position: *program.position(),
        offsets: program.work_offsets(),
        tool: program.tool(),
    }
}

/// The same, line by line: each begins with what the one before has left.
fn typed(text: &str) -> Option<(Vec<ItemKind>, End)> {
    let (mut kinds, mut next, mut last) = (Vec::new(), options(), None);
    for line in text.lines() {
        let line = format!("{line}\n");
        let mut program = Program::new(line.as_bytes(), next);
        for item in &mut program {
            kinds.push(item.ok()?.kind);
        }
        let now = end(&program);
        next = Options {
            start: now.position,
            offsets: now.offsets.clone(),
            in_force: Some(program.in_force()),
            ..options()
        };
        last = Some(now);
    }
    Some((kinds, last?))
}

/// A line in upper case, without spaces.
fn without_comments(line: &str) -> String {
    let mut depth = 0_i32;
    let words = line.split(';').next().unwrap_or_default().chars();
    let kept = words.filter(|letter| {
        depth += i32::from(*letter == '(');
        let is_word = depth == 0 && !letter.is_whitespace();
        depth -= i32::from(*letter == ')');
        is_word
    });
    kept.collect::<String>().to_ascii_uppercase()
}

/// Lines up to the end of the program, if none of them goes on in another one: flow, compensation,
/// splines, saved states, profiles and local parameters end with a typed line.
fn independent_lines(text: &str) -> Option<String> {
    let mut kept = String::new();
    for (number, line) in text.lines().enumerate() {
        let words = without_comments(line);
        if number == 0 && words == "%" {
            continue;
        }
        if ["M2", "M02", "M30", "%"]
            .iter()
            .any(|end| words.contains(end))
        {
            break;
        }
        let goes_on = [
            "O", "G41", "G42", "G5.", "G6.", "G70", "G71", "G72", "M70", "M71", "M72", "M73",
        ];
        let has_local = words.replace("#<_", "").contains("#<");
        if has_local || goes_on.iter().any(|word| words.contains(word)) {
            return None;
        }
        kept.push_str(line);
        kept.push('\n');
    }
    (!kept.is_empty() && kept.lines().count() <= MOST_LINES).then_some(kept)
}

/// Programs of the corpus, or of one of its folders; none where there is no corpus.
fn programs(folder: Option<&str>) -> Vec<(PathBuf, String)> {
    let Some(corpus) = corpus() else {
        return Vec::new();
    };
    let folders: Vec<PathBuf> = match folder {
        Some(folder) => vec![corpus.join(folder)],
        None => fs::read_dir(corpus)
            .unwrap()
            .flatten()
            .map(|entry| entry.path())
            .filter(|path| path.is_dir())
            .collect(),
    };
    let files = folders.iter().flat_map(fs::read_dir);
    let mut programs: Vec<_> = files
        .flatten()
        .flatten()
        .filter_map(|entry| {
            let text = fs::read_to_string(entry.path()).ok()?;
            Some((entry.path(), text))
        })
        .collect();
    programs.sort();
    programs
}

#[test]
fn what_is_typed_line_by_line_is_what_it_is_in_a_file() {
    let (mut lines, mut read) = (0, 0);
    let programs = programs(None);
    for (path, text) in &programs {
        let Some(text) = independent_lines(text).filter(|_| !path.ends_with(MERGED)) else {
            continue;
        };
        let (kinds, end, found) = run(&text, options());
        if found.is_some() {
            continue;
        }
        let (typed, typed_end) = typed(&text).unwrap_or_else(|| panic!("refused: {path:?}"));
        let first = kinds.iter().zip(&typed).position(|(a, b)| a != b);
        assert_eq!((first, kinds.len()), (None, typed.len()), "{path:?}");
        assert_eq!(end, typed_end, "{path:?}");
        (lines, read) = (lines + text.lines().count(), read + 1);
    }
    eprintln!("{lines} lines of {read} programs");
    assert!(programs.is_empty() || (read > 15 && lines > 1_000));
}

#[test]
fn a_line_with_a_finding_changes_nothing() {
    let mut seen = 0;
    let programs = programs(Some("malformed"));
    for (path, text) in &programs {
        let (_, end, found) = run(text, options());
        let Some(line) = found else {
            continue;
        };
        let before: Vec<&str> = text.lines().take(line as usize - 1).collect();
        let (_, before, is_cut) = run(&(before.join("\n") + "\n"), options());
        if is_cut.is_some() {
            continue;
        }
        assert_eq!(end, before, "{path:?}, line {line}");
        seen += 1;
    }
    eprintln!("{seen} findings");
    assert!(programs.is_empty() || seen > 15);
}

/// The ends of moves in X and Z, of lines that are typed.
fn ways_typed(dialect: Dialect, text: &str) -> Vec<[f64; 2]> {
    let of_dialect = Options {
        dialect,
        default_feed_mm_min: Some(600.0),
        ..options()
    };
    Program::new(text.as_bytes(), of_dialect)
        .typed()
        .filter_map(|item| match item.unwrap().kind {
            ItemKind::Move { segment, .. } => Some([segment.end()[0], segment.end()[2]]),
            _ => None,
        })
        .collect()
}

#[test]
fn what_was_read_ahead_waits_for_no_other_line() {
    let jump = "GOTO 20\nG0 X5\nN20 G0 X7\nX9\n";
    assert_eq!(ways_typed(Dialect::Fanuc, jump), [[7.0, 0.0], [9.0, 0.0]]);
    let jump = "GOTOF END\nG0 X5\nEND: G0 X7\nX9\n";
    assert_eq!(ways_typed(Dialect::Siemens, jump), [[7.0, 0.0], [9.0, 0.0]]);
    let hole = [[0.0, 10.0], [0.0, 2.0], [0.0, -5.0], [0.0, 10.0]];
    let cycle = "G0 Z10\nCYCLE81(10,0,2,-5)\n";
    assert_eq!(ways_typed(Dialect::Siemens, cycle), hole);
    let pattern = "G0 Z10\nMCALL CYCLE81(10,0,2,-5)\nHOLES1(0,0,0,0,5,2)\n";
    assert_eq!(ways_typed(Dialect::Siemens, pattern).len(), 8);
}
