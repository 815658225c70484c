//! The page as one file, with all that it shows: it needs neither server nor network.

use crate::asset::{FONT_LICENCE, FONTS, INDEX, STYLE, scripts_of_file};
use crate::motion::Motion;
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use core::fmt::Write as _;

/// How files made by [`page`] begin, after the document type: what tells them from other pages.
pub const GENERATOR: &str = "<meta name=\"generator\" content=\"Glidepath plot\">";

/// What the page may do as a file: what stands in it, and nothing else.
const POLICY: &str = "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; \
                      script-src 'unsafe-inline'; style-src 'unsafe-inline'; font-src data:; \
                      img-src data:; connect-src data:\">";

/// A page that shows a motion.
///
/// `plan` is what the page knows about it, a JSON object as `/api/plan` of the server has it, and
/// `lines` the text of the program, empty if it is not to be part of the file.
#[must_use]
pub fn page(plan: &str, lines: &str, motion: &Motion) -> String {
    let (head, body) = INDEX.split_once("<!--files-->").unwrap_or((INDEX, ""));
    let (_, body) = body.split_once("<!--end of files-->").unwrap_or(("", body));
    let (body, end) = body.split_once("<!--scripts-->").unwrap_or((body, ""));
    let (_, end) = end.split_once("<!--end of scripts-->").unwrap_or(("", end));
    // There is no machine to be operated.
    let (before, hands) = body.split_once("<!--hands-->").unwrap_or((body, ""));
    let (_, behind) = hands
        .split_once("<!--end of hands-->")
        .unwrap_or(("", hands));
    let (first, head) = head.split_once("<head>").unwrap_or(("", head));
    let mut page = format!("{first}<head>{GENERATOR}{POLICY}{head}");
    // Writing to a String does not fail.
    let _ = write!(page, "<!--\n{}\n-->\n<style>", without_dashes(FONT_LICENCE));
    page.push_str(&style());
    let _ = write!(page, "</style>{before}{behind}");
    let parts = [
        ("columns", motion.columns()),
        ("path", motion.path()),
        ("program", motion.programmed_path()),
    ];
    page.push_str("<script>window.GLIDEPATH_FILE={");
    for (name, bytes) in parts {
        let _ = write!(page, "{name}:\"{}\",", STANDARD.encode(bytes));
    }
    let _ = write!(page, "lines:\"{}\",", STANDARD.encode(lines));
    // As a text in base 64, nothing in it can end the script.
    let _ = write!(page, "plan:\"{}\"}};</script>", STANDARD.encode(plan));
    for script in scripts_of_file() {
        let _ = write!(page, "<script>{script}</script>");
    }
    page.push_str(end);
    page
}

/// The style sheet with its typeface in it.
fn style() -> String {
    FONTS.iter().fold(STYLE.to_owned(), |style, (path, font)| {
        let name = path.trim_start_matches('/');
        let data = format!("data:font/woff2;base64,{}", STANDARD.encode(font));
        style.replace(name, &data)
    })
}

/// A text that does not end a comment.
fn without_dashes(text: &str) -> String {
    text.replace("--", "- -").replace("--", "- -")
}
