//! Tests of programs of other origin that are begun in their middle: what follows is the rest of
//! the program, bit for bit.
//!
//! Runs where the environment variable `GLIDEPATH_CORPUS` names the directory of the programs, and
//! says so where it does not. A few lines of every program that is not long are tried; all lines of
//! all programs, for hours, with:
//!
//! ```text
//! GLIDEPATH_FROM_LINES=1000000 cargo test --release -p glidepath-planner --test it from_line -- --nocapture
//! ```

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use glidepath_gcode::{Connections, Options, Tool, ToolTable};
use glidepath_geometry::{Axis, AxisVector};
use glidepath_link::Auxiliary;
use glidepath_planner::{
    Approach, ItemSource, LineStart, ProgramSource, StartLine, StartLineError, Supply,
};
use glidepath_program::{Item, ItemKind};

/// Lines of a program that are tried, unless the environment says otherwise.
const USUAL: usize = 5;
/// Items of a program that is tried then.
const MOST_ITEMS: usize = 4_000;

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

/// All items of a program, or as many as `most`; `None` if it is refused, or has none.
fn items(source: &mut impl ItemSource, most: usize) -> Option<Vec<Item>> {
    let mut items = Vec::new();
    while items.len() < most {
        match source.next_item() {
            Supply::Item(item) => items.push(item),
            Supply::End => return (!items.is_empty()).then_some(items),
            _ => return None,
        }
    }
    None
}

/// Where the program comes to a line from another one, and which time that is.
fn starts(items: &[Item]) -> Vec<(usize, StartLine)> {
    let mut passes: BTreeMap<u32, u32> = BTreeMap::new();
    let mut starts = Vec::new();
    for (index, item) in items.iter().enumerate() {
        if index > 0 && items[index - 1].line == item.line {
            continue;
        }
        let pass = passes.entry(item.line).or_default();
        *pass += 1;
        let (line, pass) = (item.line, *pass);
        starts.push((index, StartLine { line, pass }));
    }
    starts
}

/// Begins a program at so many of its lines. Returns at how many, and what is wrong.
fn begin(text: &[u8], most: usize, lines: usize) -> Option<(usize, Vec<String>)> {
    let source = || ProgramSource::new(text, options());
    let all = items(&mut source(), most)?;
    let starts = starts(&all);
    let (mut begun, mut wrong) = (0, Vec::new());
    for chosen in 0..lines.min(starts.len()) {
        let (index, start) = starts[chosen * starts.len() / lines.min(starts.len())];
        let approach = Approach {
            position: AxisVector::repeat(1.5),
            now: Auxiliary::default(),
            tool_axis: Axis::Z,
            top: Some(50.0),
        };
        let found = match LineStart::find(source(), start, &approach) {
            Ok(found) => found,
            Err(StartLineError::OnContour { .. }) => continue,
            Err(error) => {
                wrong.push(format!("{start:?}: {error}"));
                continue;
            }
        };
        let stands = found.begins_at();
        // Before the first move the machine is where it was.
        let is_move = |item: &Item| matches!(item.kind, ItemKind::Move { .. });
        if let ItemKind::Move { segment, .. } = all[index].kind
            && all[..index].iter().any(is_move)
            && stands != segment.start()
        {
            wrong.push(format!("{start:?}: begins at {stands:?}"));
        }
        let rest = items(&mut found.approached(&approach), usize::MAX).unwrap_or_default();
        let tail = &all[index..];
        begun += 1;
        if !rest.ends_with(tail) {
            wrong.push(format!(
                "{start:?}: {} items for {}",
                rest.len(),
                tail.len()
            ));
        }
    }
    Some((begun, wrong))
}

fn programs(directory: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(directory).into_iter().flatten().flatten() {
        let path = entry.path();
        if path.is_dir() {
            programs(&path, found);
        } else if path
            .extension()
            .is_some_and(|end| end == "ngc" || end == "nc")
        {
            found.push(path);
        }
    }
    found.sort();
}

#[test]
fn a_program_that_is_begun_in_its_middle_goes_on_as_the_whole_one() {
    let Some(corpus) = glidepath_testing::corpus() else {
        return;
    };
    let lines = std::env::var("GLIDEPATH_FROM_LINES").ok();
    let lines = lines.map(|lines| lines.parse::<usize>().unwrap());
    let most = lines.map_or(MOST_ITEMS, |_| usize::MAX);
    let mut paths = Vec::new();
    programs(&corpus, &mut paths);
    let (mut begun, mut read, mut all_wrong) = (0, 0, Vec::new());
    for path in paths {
        let text = fs::read(&path).unwrap();
        if let Some((count, wrong)) = begin(&text, most, lines.unwrap_or(USUAL)) {
            (begun, read) = (begun + count, read + 1);
            let named = |wrong: String| format!("{}: {wrong}", path.display());
            all_wrong.extend(wrong.into_iter().map(named));
        }
    }
    println!("{read} programs begun at {begun} lines");
    assert!(all_wrong.is_empty(), "{all_wrong:#?}");
    assert!(read > 30 && begun > 120, "{read} {begun}");
}
