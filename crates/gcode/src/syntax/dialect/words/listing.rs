//! Every code and name in the tables of a dialect, for the manual and for tests.

use crate::syntax::dialect::Dialect;
use crate::syntax::dialect::marlin::is_function;
use crate::syntax::dialect::words::{Meaning, fanuc, fanuc_lathe, marlin, siemens, siemens_names};

/// The treatment of a word: what is made of it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Treatment {
    /// It means what it means to LinuxCNC.
    AsLinuxCnc,
    /// It has a meaning of its own, which is made.
    Own,
    /// It moves nothing and gives no place another name.
    ReadOver,
    /// It is told as an event.
    Event,
    /// It is refused: what it is, and what to do instead.
    Refused(&'static str, &'static str),
}

/// A word of a dialect.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Word {
    /// As it stands in a program: `G43.4`, `M29`, `CYCLE800`.
    pub name: String,
    /// What is made of it.
    pub treatment: Treatment,
}

/// Most of a G number, and of an M number.
const MOST: u32 = 999;

fn word(name: String, meaning: Meaning) -> Word {
    let treatment = match meaning {
        Meaning::Shared => Treatment::AsLinuxCnc,
        Meaning::Own => Treatment::Own,
        Meaning::ReadOver => Treatment::ReadOver,
        Meaning::Refused(what, help) => Treatment::Refused(what, help),
    };
    Word { name, treatment }
}

/// The name of a G code whose number comes times ten.
fn g_name(tenths: u32) -> String {
    match (tenths / 10, tenths % 10) {
        (whole, 0) => format!("G{whole}"),
        (whole, tenth) => format!("G{whole}.{tenth}"),
    }
}

/// The words in the tables of a dialect; what is in none is refused. Of LinuxCNC's language there is no
/// table: see [`language`](crate::language).
#[must_use]
pub fn words(dialect: Dialect) -> Vec<Word> {
    let in_tenths = |table: fn(u32) -> Option<Meaning>| {
        let all = 0..=10 * MOST + 9;
        let known = all.filter_map(move |tenths| Some((tenths, table(tenths)?)));
        known.map(|(tenths, meaning)| word(g_name(tenths), meaning))
    };
    let m_codes = |table: fn(u32) -> Option<Meaning>| {
        let known = (0..=MOST).filter_map(move |number| Some((number, table(number)?)));
        known.map(|(number, meaning)| word(format!("M{number}"), meaning))
    };
    match dialect {
        Dialect::LinuxCnc => Vec::new(),
        Dialect::Fanuc => in_tenths(fanuc::g).chain(m_codes(fanuc::m)).collect(),
        Dialect::Marlin => {
            let events = (0..=MOST).filter(|number| is_function(*number));
            let events = events.map(|number| Word {
                name: format!("M{number}"),
                treatment: Treatment::Event,
            });
            in_tenths(marlin::g)
                .chain(m_codes(marlin::m))
                .chain(events)
                .collect()
        }
        Dialect::Siemens => {
            let codes = (0..=MOST).filter_map(|number| Some((number, siemens::g(number)?)));
            codes
                .map(|(number, meaning)| word(format!("G{number}"), meaning))
                .chain(m_codes(siemens::m))
                .chain(siemens_names::names().map(|(name, meaning)| word(name.to_owned(), meaning)))
                .collect()
        }
    }
}

/// The codes that FANUC's lathes (system A) have with another meaning than its mills.
#[must_use]
pub fn lathe_words() -> Vec<Word> {
    let all = 0..=10 * MOST + 9;
    let g_codes = all.filter_map(|tenths| {
        let meaning = fanuc_lathe::g(tenths)?;
        let is_other = fanuc::g(tenths) != Some(meaning);
        is_other.then(|| word(g_name(tenths), meaning))
    });
    let m_codes = (0..=MOST).filter_map(|number| Some((number, fanuc_lathe::m(number)?)));
    g_codes
        .chain(m_codes.map(|(number, meaning)| word(format!("M{number}"), meaning)))
        .collect()
}
