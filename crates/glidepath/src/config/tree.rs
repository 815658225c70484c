//! The tree of a configuration's text, and how something wrong is put aside in it, so that the rest
//! can be judged: an unknown key is taken out, and a value of the wrong type, or one that is
//! missing, is replaced.

use core::ops::Range;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// The tree of a text.
#[derive(Clone)]
pub(super) struct Tree<'t> {
    pub(super) root: Spanned<DeTable<'t>>,
    /// Where what is replaced stands: behind the text, where nothing does.
    nowhere: usize,
}

/// The kind of a list that `[[name]]` begins.
pub(super) const TABLES: &str = "a list of tables";

/// What has the bytes of an error.
enum Found<'a, 't> {
    Key(String, &'a mut DeTable<'t>),
    Value(&'a mut Spanned<DeValue<'t>>),
}

impl<'t> Tree<'t> {
    /// Reads the syntax alone.
    ///
    /// # Errors
    /// The text is not TOML.
    pub(super) fn parse(text: &'t str) -> Result<Self, toml::de::Error> {
        Ok(Self {
            root: DeTable::parse(text)?,
            nowhere: text.len() + 1,
        })
    }

    /// Where the value of a dotted name stands.
    pub(super) fn place(&self, name: &str) -> Option<Range<usize>> {
        let (path, last) = name.rsplit_once('.')?;
        let table = path.split('.').try_fold(self.root.as_ref(), |table, part| {
            table.get(part)?.as_ref().as_table()
        });
        Some(table?.get(last)?.span())
    }

    /// True for a place of something that was put in place of what is wrong.
    pub(super) fn is_replaced(text: &str, span: &Range<usize>) -> bool {
        span.start > text.len()
    }

    /// The dotted name and the kind of what stands at some bytes; empty if nothing does.
    pub(super) fn described(&self, at: &Range<usize>) -> (String, &'static str) {
        describe(self.root.as_ref(), "", at).unwrap_or_default()
    }

    /// The dotted name of the table at some bytes.
    pub(super) fn table(&self, at: &Range<usize>) -> String {
        self.described(at).0
    }

    /// Takes out the key at some bytes; false if there is none.
    pub(super) fn take_out(&mut self, at: &Range<usize>) -> bool {
        match find(self.root.as_mut(), at) {
            Some(Found::Key(name, table)) => table.remove(name.as_str()).is_some(),
            _ => false,
        }
    }

    /// Puts another value, given as TOML, in the place of the one at some bytes; false if there is
    /// none.
    pub(super) fn replace(&mut self, at: &Range<usize>, value: &'static str) -> bool {
        let value = self.value(value);
        match (find(self.root.as_mut(), at), value) {
            (Some(Found::Value(place)), Some(value)) => {
                *place = value;
                true
            }
            _ => false,
        }
    }

    /// Adds a key, with a value given as TOML, to the table at some bytes; false if there is none.
    pub(super) fn add(&mut self, at: &Range<usize>, key: &str, value: &'static str) -> bool {
        let nowhere = self.nowhere..self.nowhere;
        let Some(value) = self.value(value) else {
            return false;
        };
        let key = Spanned::new(nowhere, key.to_owned().into());
        if self.root.span() == *at {
            return self.root.as_mut().insert(key, value).is_none();
        }
        match find(self.root.as_mut(), at) {
            Some(Found::Value(place)) => match place.as_mut() {
                DeValue::Table(table) => table.insert(key, value).is_none(),
                _ => false,
            },
            _ => false,
        }
    }

    /// A value that stands nowhere in the text.
    fn value(&mut self, text: &'static str) -> Option<Spanned<DeValue<'t>>> {
        self.nowhere += 1;
        let value = DeValue::parse(text).ok()?;
        Some(Spanned::new(self.nowhere..self.nowhere, value.into_inner()))
    }
}

fn find<'a, 't>(table: &'a mut DeTable<'t>, at: &Range<usize>) -> Option<Found<'a, 't>> {
    let key = table.keys().find(|key| key.span() == *at);
    if let Some(key) = key.map(|key| key.as_ref().to_string()) {
        return Some(Found::Key(key, table));
    }
    table
        .iter_mut()
        .find_map(|(_, value)| find_value(value, at))
}

fn find_value<'a, 't>(
    value: &'a mut Spanned<DeValue<'t>>,
    at: &Range<usize>,
) -> Option<Found<'a, 't>> {
    if value.span() == *at {
        return Some(Found::Value(value));
    }
    match value.as_mut() {
        DeValue::Table(table) => find(table, at),
        DeValue::Array(list) => list.iter_mut().find_map(|value| find_value(value, at)),
        _ => None,
    }
}

fn describe(table: &DeTable<'_>, path: &str, at: &Range<usize>) -> Option<(String, &'static str)> {
    table.iter().find_map(|(key, value)| {
        let name = if path.is_empty() {
            key.as_ref().to_string()
        } else {
            format!("{path}.{}", key.as_ref())
        };
        if key.span() == *at || value.span() == *at {
            return Some((name, kind(value.as_ref())));
        }
        match value.as_ref() {
            DeValue::Table(table) => describe(table, &name, at),
            DeValue::Array(list) => list.iter().find_map(|value| {
                if value.span() == *at {
                    return Some((name.clone(), kind(value.as_ref())));
                }
                match value.as_ref() {
                    DeValue::Table(table) => describe(table, &name, at),
                    _ => None,
                }
            }),
            _ => None,
        }
    })
}

/// What a value is, in words.
fn kind(value: &DeValue<'_>) -> &'static str {
    match value {
        DeValue::String(_) => "text",
        DeValue::Integer(_) => "a whole number",
        DeValue::Float(_) => "a number with a decimal point",
        DeValue::Boolean(_) => "true or false",
        DeValue::Datetime(_) => "a date",
        DeValue::Array(list) if list.iter().any(|value| value.as_ref().is_table()) => TABLES,
        DeValue::Array(_) => "a list",
        DeValue::Table(_) => "a table",
    }
}
