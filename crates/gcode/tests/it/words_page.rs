//! The manual's page of words, made from the tables of the code and held against the file.
//! `GLIDEPATH_BLESS=1 cargo test -p glidepath-gcode --test it words_page` writes it.

use std::fmt::Write as _;
use std::path::Path;

use glidepath_gcode::Dialect;
use glidepath_gcode::language::{Treatment, Word, lathe_words, words};

/// A table of words: those read as LinuxCNC reads them are in a line in front of it.
fn table(text: &mut String, title: &str, words: &[Word]) {
    let _ = write!(text, "\n## {title}\n");
    let shared: Vec<String> = words
        .iter()
        .filter(|word| word.treatment == Treatment::AsLinuxCnc)
        .map(|word| format!("`{}`", word.name))
        .collect();
    if !shared.is_empty() {
        let _ = write!(text, "\nAs LinuxCNC reads them: {}.\n", shared.join(" "));
    }
    text.push_str("\n| word | | |\n|---|---|---|\n");
    for word in words {
        let (what, why) = match word.treatment {
            Treatment::AsLinuxCnc => continue,
            Treatment::Own => ("read", String::new()),
            Treatment::ReadOver => ("read over", String::new()),
            Treatment::Event => ("an event", String::new()),
            Treatment::Refused(what, help) => ("refused", format!("{what}: {help}")),
        };
        let _ = writeln!(text, "| `{}` | {what} | {why} |", word.name);
    }
}

#[test]
fn the_manual_has_every_word() {
    let mut text = String::from(
        "# Words\n\nThis page is made from the code, and a test compares the two. It has every code and every \
         name in the tables of\nthe languages beside LinuxCNC's; what is in none of them is refused. What the \
         words do is in\n[languages](languages.md).\n",
    );
    table(&mut text, "FANUC and Haas", &words(Dialect::Fanuc));
    table(
        &mut text,
        "FANUC's and Haas' lathes, where they differ",
        &lathe_words(),
    );
    table(&mut text, "SINUMERIK", &words(Dialect::Siemens));
    table(&mut text, "Printers", &words(Dialect::Marlin));
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../glidepath/docs/words.md");
    if std::env::var_os("GLIDEPATH_BLESS").is_some() {
        std::fs::write(&path, &text).expect("a file that can be written");
    }
    let actual = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(
        actual == text,
        "words.md is not what the code says: write it with GLIDEPATH_BLESS=1 cargo test -p \
         glidepath-gcode --test it words_page"
    );
}
