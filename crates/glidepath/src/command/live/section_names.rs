//! The names of the sections of a program: comments that stand alone in front of a tool change or an operation, as posts
//! of CAM systems write them.

use crate::command::text_lines::TextLines;

/// Names that are remembered of one program.
const MOST_NAMES: usize = 2000;
/// The longest name, characters.
const MOST_CHARS: usize = 200;
/// Blocks that may lie between a comment and what it names: units, planes, offsets.
const MOST_BETWEEN: u32 = 10;
/// How comments begin that are read by a machine.
const MESSAGES: [&str; 9] = [
    "msg",
    "debug,",
    "print,",
    "log,",
    "logopen",
    "logappend",
    "logclose",
    "probeopen",
    "py,",
];
/// How comments begin that say where something ends.
const ENDS: [&str; 4] = ["finish operation", "end ", "end:", "end of "];
/// What some posts write in front of each name.
const BEFORE_NAMES: [&str; 3] = ["begin operation:", "operation:", "toolpath:-"];

/// What a line of a program is, for its sections.
#[derive(Debug, PartialEq, Eq)]
enum LineKind<'t> {
    Blank,
    /// A comment alone, with what it names.
    Comment(Option<&'t str>),
    /// An operation begins: a tool, a spindle, a rapid, a canned cycle.
    Begins,
    /// It cuts, or does what else is no beginning.
    Cuts,
    /// A block that leaves open what follows.
    Between,
}

/// The names of a program, each with the line behind its comment, in the order of the text.
pub(super) fn section_names(lines: &TextLines) -> Vec<(u32, String)> {
    let mut names = Vec::new();
    let (mut first, mut last) = (None, None);
    let (mut is_comments, mut is_head) = (false, true);
    let mut named: Option<(u32, &str)> = None;
    let mut between = 0;
    for (number, text) in (1..).zip(lines.from(0)) {
        let kind = kind(text);
        match kind {
            LineKind::Blank => continue,
            LineKind::Comment(name) => {
                if !is_comments {
                    (is_comments, first, last, named) = (true, None, None, None);
                }
                first = first.or(name);
                last = name.or(last);
                continue;
            }
            LineKind::Begins | LineKind::Cuts | LineKind::Between => {}
        }
        if is_comments {
            // At the head of a program stand its own name, tools, and the date: of these the last is nearest.
            let name = if is_head { last } else { first };
            (is_comments, between) = (false, 0);
            named = name.map(|name| (number, name));
        }
        is_head = false;
        match kind {
            LineKind::Begins => {
                if let Some((line, name)) = named.take() {
                    names.push((line, name.chars().take(MOST_CHARS).collect()));
                }
            }
            LineKind::Between if between < MOST_BETWEEN => between += 1,
            _ => named = None,
        }
        if names.len() == MOST_NAMES {
            break;
        }
    }
    names
}

fn kind(text: &str) -> LineKind<'_> {
    let line = behind_number(text.trim());
    if line.is_empty() || line == "%" {
        return LineKind::Blank;
    }
    if let Some(comment) = line.strip_prefix(';') {
        return LineKind::Comment(name_of(comment));
    }
    if let Some(rest) = line.strip_prefix('(') {
        let Some((comment, behind)) = rest.split_once(')') else {
            return LineKind::Comment(name_of(rest));
        };
        if kind(behind) == LineKind::Blank || matches!(kind(behind), LineKind::Comment(_)) {
            return LineKind::Comment(name_of(comment));
        }
    }
    block(line)
}

/// A line without its block number, and without the mark of one that may be skipped.
fn behind_number(line: &str) -> &str {
    let line = line.strip_prefix('/').unwrap_or(line);
    match line.strip_prefix(['N', 'n']) {
        Some(rest) if rest.starts_with(|c: char| c.is_ascii_digit()) => rest
            .trim_start_matches(|c: char| c.is_ascii_digit() || c == '.')
            .trim_start(),
        _ => line,
    }
}

/// What a comment names, without what decorates it.
fn name_of(comment: &str) -> Option<&str> {
    let is_decoration = |c: char| c.is_whitespace() || "-=*#_~+.:;()".contains(c);
    let name = comment.trim_matches(is_decoration);
    let lower = name.to_ascii_lowercase();
    let begins = |beginnings: &[&str]| beginnings.iter().any(|it| lower.starts_with(it));
    if !name.chars().any(char::is_alphabetic)
        || begins(&MESSAGES)
        || begins(&ENDS)
        || lower == "end"
    {
        return None;
    }
    let known = BEFORE_NAMES.iter().find(|it| lower.starts_with(**it));
    let name = name.get(known.map_or(0, |it| it.len())..)?;
    Some(name.trim_matches(is_decoration)).filter(|name| !name.is_empty())
}

/// What a block does, by its words. What is no block with words leaves it open.
fn block(line: &str) -> LineKind<'static> {
    let bytes = line.as_bytes();
    if matches!(bytes.first(), Some(b'o' | b'O' | b'#' | b'<')) {
        return LineKind::Between;
    }
    let mut kind = LineKind::Between;
    let (mut at, mut depth) = (0, 0_u32);
    while let Some(byte) = bytes.get(at) {
        at += 1;
        match byte {
            b'(' => depth += 1,
            b')' => depth = depth.saturating_sub(1),
            b';' if depth == 0 => break,
            b'G' | b'g' | b'M' | b'm' | b'T' | b't' if depth == 0 => {
                let digits = bytes.get(at..).unwrap_or_default();
                let count = digits.iter().take_while(|it| it.is_ascii_digit()).count();
                let number = str::from_utf8(digits.get(..count).unwrap_or_default());
                let number = number.ok().and_then(|text| text.parse::<u32>().ok());
                match (byte.to_ascii_uppercase(), number) {
                    (b'T', Some(_)) | (b'M', Some(3 | 4 | 6)) | (b'G', Some(0 | 73..=89)) => {
                        return LineKind::Begins;
                    }
                    (b'G', Some(1..=3)) | (b'M', Some(2 | 30)) => kind = LineKind::Cuts,
                    _ => {}
                }
            }
            _ => {}
        }
    }
    kind
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(text: &str) -> Vec<(u32, String)> {
        section_names(&TextLines::of(text.as_bytes().to_vec()))
    }

    fn only(text: &str) -> Vec<String> {
        names(text).into_iter().map(|(_, name)| name).collect()
    }

    #[test]
    fn comments_in_front_of_tools_and_operations_are_names() {
        let text = "%\nO1001 (PART 7)\n(T1 D=6 flat)\n(T2 D=3 drill)\nN10 G21 G90 G17\n\n(POCKET ROUGH)\n\
                    N20 T1 M6\nG0 X1\nG1 Z-1 F100\n(lead out)\nG1 X5\n(--- CONTOUR ---)\nG54\nG0 X0\nG1 X1\n\
                    N90 (DRILL 4 HOLES)\n(tool 2)\nN95 T2 M6\nG81 X1 Z-3\n(END)\nM30\n";
        let found = names(text);
        let expected = [(8, "POCKET ROUGH"), (14, "CONTOUR"), (19, "DRILL 4 HOLES")];
        assert_eq!(found, expected.map(|(line, name)| (line, name.to_owned())));
    }

    #[test]
    fn other_posts_name_in_their_own_way() {
        // FreeCAD.
        let text = "(Exported by FreeCAD)\n(Begin preamble)\nG17 G90\nG21\n(Begin operation: Fixture)\nG54\n\
                    (Finish operation: Fixture)\n(Begin operation: Profile)\n(Path: Profile)\nG0 Z5\nG1 Z0 F9\n\
                    (Finish operation: Profile)\nM5\n";
        assert_eq!(only(text), ["Profile"]);
        // A SINUMERIK and a printer comment with semicolons.
        assert_eq!(only("; ROUGH\nT1\nM6\nG0 X1\n;LAYER:1\nG1 X2\n"), ["ROUGH"]);
    }

    #[test]
    fn what_is_no_name_is_none() {
        for text in [
            "(MSG, look)\nG0 X1\n",
            "(-----)\nG0 X1\n",
            "(POCKET) G0 X1\n",
            "G1 X1 (a comment)\nG0 X2\n",
            "(only said)\nG1 X1\nG0 X2\n",
            "(a note)\nM30\n",
            "(6 * 4)\nG0 X1\n",
            "",
        ] {
            assert_eq!(only(text), [""; 0], "{text}");
        }
        let far = format!("(FAR)\n{}G0 X1\n", "G90\n".repeat(11));
        assert_eq!(only(&far), [""; 0]);
    }

    #[test]
    fn names_are_bounded_in_number_and_length() {
        let long = format!("({})\nG0 X1\n", "é".repeat(900));
        assert_eq!(only(&long)[0].chars().count(), MOST_CHARS);
        let many = "(A)\nG0 X1\n".repeat(MOST_NAMES + 50);
        assert_eq!(only(&many).len(), MOST_NAMES);
    }
}
