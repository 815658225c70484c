//! The place of a key, or of one of its elements, in the text of a curve file.
//!
//! The reader of values does not tell places in JSON, so they are looked up when something is wrong
//! with a value: the key, then the element of its list, by counting brackets and commas.

use core::ops::Range;

/// Bytes of element `index` of the list of a key; of the key's name if there is no such element;
/// empty if there is no such key.
pub(super) fn place(text: &str, key: &str, index: Option<usize>) -> Range<usize> {
    let Some(name) = key_range(text, key) else {
        return 0..0;
    };
    index
        .and_then(|index| element(text, name.end, index))
        .unwrap_or(name)
}

/// The first place where the key stands as a key: followed by `=` or `:`.
fn key_range(text: &str, key: &str) -> Option<Range<usize>> {
    text.match_indices(key).find_map(|(start, _)| {
        let end = start + key.len();
        let before = text[..start].chars().next_back();
        let whole = before.is_none_or(|c| c.is_whitespace() || c == '"' || c == ',' || c == '{');
        let after = text[end..].trim_start_matches(['"', ' ', '\t']);
        (whole && after.starts_with(['=', ':'])).then_some(start..end)
    })
}

fn element(text: &str, from: usize, index: usize) -> Option<Range<usize>> {
    let open = from + text[from..].find('[')? + 1;
    let (mut depth, mut seen, mut start) = (0_usize, 0, open);
    let mut comment = false;
    for (at, c) in text[open..].char_indices() {
        let at = open + at;
        match c {
            '\n' => comment = false,
            '#' => comment = true,
            _ if comment => {}
            '[' => depth += 1,
            ']' | ',' if depth == 0 => {
                if seen == index {
                    let element = &text[start..at];
                    let lead = element.len() - element.trim_start().len();
                    return Some(start + lead..start + element.trim_end().len());
                }
                if c == ']' {
                    return None;
                }
                seen += 1;
                start = at + 1;
            }
            ']' => depth -= 1,
            _ => {}
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_and_elements_are_found_in_both_formats() {
        let toml = "name = \"knots\"\nknots = [0.0, # first\n  [1, 2], 3.5]\n";
        assert_eq!(&toml[place(toml, "knots", None)], "knots");
        assert_eq!(place(toml, "knots", None).start, 15);
        assert_eq!(&toml[place(toml, "knots", Some(2))], "3.5");
        assert_eq!(&toml[place(toml, "knots", Some(3))], "knots");
        let json = "{\"knots\": [\n 0,\n [1, 2]\n]}";
        assert_eq!(&json[place(json, "knots", Some(1))], "[1, 2]");
        assert_eq!(place(json, "weights", Some(0)), 0..0);
    }
}
