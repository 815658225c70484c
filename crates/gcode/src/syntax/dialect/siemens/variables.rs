//! Variables of a program: R parameters, those it declares, and arrays of them.

use std::collections::BTreeMap;

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::syntax::dialect::siemens::text_variables::{MAX_TEXT, TextAssignment, TextVariable};
use crate::syntax::expression::scope::Parameter;

/// Where R parameters begin.
const R_BASE: u32 = 1000;
/// R parameters there are.
const R_COUNT: u32 = 1000;
/// Most variables a program declares; every element of an array is one.
const MAX_VARIABLES: usize = 10_000;
/// Longest name, bytes.
const MAX_NAME: usize = 31;
/// Most dimensions of an array.
pub(crate) const MAX_DIMENSIONS: usize = 3;

/// What a variable holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Kind {
    Real,
    /// Whole numbers: what is assigned is rounded.
    Integer,
    /// 0 or 1.
    Truth,
}

impl Kind {
    /// The kind of that name, in capitals.
    pub(crate) fn named(name: &[u8]) -> Option<Self> {
        Some(match name {
            b"REAL" => Self::Real,
            b"INT" => Self::Integer,
            b"BOOL" => Self::Truth,
            _ => return None,
        })
    }

    /// What a variable of the kind holds when the value is assigned.
    pub(crate) fn of(self, value: f64) -> f64 {
        match self {
            Self::Real => value,
            Self::Integer => value.round(),
            Self::Truth => f64::from(u8::from(value != 0.0)),
        }
    }
}

/// A variable, or an array of them.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Declared {
    pub(crate) kind: Kind,
    /// How many elements along each dimension; none: it is no array.
    pub(crate) sizes: Vec<usize>,
    place: Place,
}

/// Where the values are kept.
#[derive(Debug, Clone, PartialEq, Eq)]
enum Place {
    /// Under names that begin like that.
    Named(String),
    /// The one value in a place of its own: an R parameter, or an element of an array.
    Single(Parameter),
}

impl Declared {
    /// The one variable that is kept there.
    pub(crate) const fn single(kind: Kind, parameter: Parameter) -> Self {
        Self {
            kind,
            sizes: Vec::new(),
            place: Place::Single(parameter),
        }
    }

    /// Elements of the array; 1 of a variable.
    pub(crate) fn count(&self) -> usize {
        self.sizes.iter().product()
    }

    /// Where an element is kept, counted with the last index fastest; a variable has one.
    pub(crate) fn element(&self, index: usize) -> Parameter {
        match &self.place {
            Place::Single(parameter) => parameter.clone(),
            Place::Named(name) if self.sizes.is_empty() => Parameter::Named(name.clone()),
            Place::Named(name) => Parameter::Named(format!("{name}.{index}")),
        }
    }
}

/// The variables a program, or a subprogram, has declared, by name in capitals.
#[derive(Debug, Clone, Default)]
pub(crate) struct Variables {
    by_name: BTreeMap<Vec<u8>, Declared>,
    texts: BTreeMap<Vec<u8>, TextVariable>,
    count: usize,
    /// How deep in calls the subprogram is whose variables they are.
    level: usize,
}

impl Variables {
    /// Those of a subprogram that is that deep in calls.
    pub(crate) fn at_level(level: usize) -> Self {
        Self {
            level,
            ..Self::default()
        }
    }

    /// Declares a variable, or an array of that size.
    pub(crate) fn declare(
        &mut self,
        name: &[u8],
        kind: Kind,
        sizes: Vec<usize>,
        span: SourceSpan,
    ) -> Outcome<Declared> {
        check_name(name, span)?;
        let shown = String::from_utf8_lossy(name).into_owned();
        let place = match self.level {
            0 => format!("def.{}", shown.to_ascii_lowercase()),
            level => format!("def.{level}.{}", shown.to_ascii_lowercase()),
        };
        let place = Place::Named(place);
        let declared = Declared { kind, sizes, place };
        self.make_room(name, declared.count(), span)?;
        self.by_name.insert(name.to_vec(), declared.clone());
        Ok(declared)
    }

    /// Gives a variable of the caller a name here, too (VAR).
    pub(crate) fn refer(&mut self, name: &[u8], of: Declared, span: SourceSpan) -> Outcome<()> {
        check_name(name, span)?;
        self.make_room(name, of.count(), span)?;
        self.by_name.insert(name.to_vec(), of);
        Ok(())
    }

    /// Declares a variable of texts of at most so many bytes, or an array of that size.
    pub(crate) fn declare_text(
        &mut self,
        name: &[u8],
        most: usize,
        sizes: Vec<usize>,
        span: SourceSpan,
    ) -> Outcome<()> {
        check_name(name, span)?;
        let text = TextVariable::new(most.min(MAX_TEXT), sizes);
        self.make_room(name, text.count(), span)?;
        self.texts.insert(name.to_vec(), text);
        Ok(())
    }

    /// Makes room for the elements of a variable, in the place of one of the same name.
    fn make_room(&mut self, name: &[u8], elements: usize, span: SourceSpan) -> Outcome<()> {
        let numbers = self.by_name.get(name).map_or(0, Declared::count);
        let texts = self.texts.get(name).map_or(0, TextVariable::count);
        let count = (self.count - numbers - texts).saturating_add(elements);
        if count > MAX_VARIABLES {
            let message = format!("more than {MAX_VARIABLES} variables");
            return Err(
                BlockDiagnostic::new(DiagnosticCode::Parameter, span, message)
                    .because("the memory of a program is bounded; every element of an array counts")
                    .help("use R parameters, or a smaller array"),
            );
        }
        self.count = count;
        self.by_name.remove(name);
        self.texts.remove(name);
        Ok(())
    }

    /// A variable of texts by its name in capitals.
    pub(crate) fn text(&self, name: &[u8]) -> Option<&TextVariable> {
        self.texts.get(name)
    }

    /// Refuses a text that a variable has no room for.
    pub(crate) fn check_text(&self, name: &[u8], value: &[u8], span: SourceSpan) -> Outcome<()> {
        let text = self.texts.get(name);
        text.map_or(Ok(()), |text| text.check(value, span))
    }

    /// Assigns a text.
    pub(crate) fn set_text(&mut self, assignment: TextAssignment) {
        if let Some(text) = self.texts.get_mut(&assignment.name) {
            text.set(assignment.element, assignment.value);
        }
    }

    /// A variable by its name in capitals.
    pub(crate) fn get(&self, name: &[u8]) -> Option<&Declared> {
        self.by_name.get(name)
    }
}

/// Refuses what is no name of a variable.
fn check_name(name: &[u8], span: SourceSpan) -> Outcome<()> {
    let letter = |byte: Option<&u8>| byte.is_some_and(|b| b.is_ascii_alphabetic() || *b == b'_');
    if letter(name.first()) && letter(name.get(1)) && name.len() <= MAX_NAME {
        return Ok(());
    }
    let shown = String::from_utf8_lossy(name).into_owned();
    let message = format!("`{shown}` is no name of a variable");
    Err(BlockDiagnostic::new(DiagnosticCode::Parameter, span, message)
        .because(format!(
            "a name has two letters or `_` at its beginning and {MAX_NAME} bytes at most; others are \
             addresses"
        ))
        .help("use another name"))
}

/// Which element the indices of an array name, the last one fastest.
pub(crate) fn element_at(sizes: &[usize], indices: &[f64], span: SourceSpan) -> Outcome<usize> {
    let refuse = |message: String, help: &str| {
        Err(
            BlockDiagnostic::new(DiagnosticCode::Parameter, span, message)
                .because("an index counts from 0, one for each dimension of DEF")
                .help(help),
        )
    };
    if indices.is_empty() {
        return Err(BlockDiagnostic::new(
            DiagnosticCode::Parameter,
            span,
            "an array without an index is not supported",
        )
        .because("a value is one element; as a whole an array is an argument of a subprogram whose PROC says VAR")
        .help("write the index of an element"));
    }
    if sizes.len() != indices.len() {
        let (given, wanted) = (indices.len(), sizes.len());
        let message = format!("{given} indices of an array that has {wanted}");
        return refuse(
            message,
            "write one for each dimension, with commas between them",
        );
    }
    let mut element = 0;
    for (size, index) in sizes.iter().zip(indices) {
        let nearest = index.round();
        let last = size.saturating_sub(1);
        let most = f64::from(u32::try_from(last).unwrap_or(u32::MAX));
        if (index - nearest).abs() > 1e-4 || !(0.0..=most).contains(&nearest) {
            let message = format!("the index {index} is not one of 0 to {last}");
            return refuse(
                message,
                "check how the index is computed, or make the array larger",
            );
        }
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "range checked"
        )]
        let index = nearest as usize;
        element = element * size + index;
    }
    Ok(element)
}

/// Where the R parameter of that number is kept.
pub(crate) fn r_parameter(number: f64, span: SourceSpan) -> Outcome<Parameter> {
    let nearest = number.round();
    if (number - nearest).abs() > 1e-4 || !(0.0..f64::from(R_COUNT)).contains(&nearest) {
        let last = R_COUNT - 1;
        return Err(BlockDiagnostic::new(
            DiagnosticCode::Parameter,
            span,
            "there is no such R parameter",
        )
        .because(format!("R parameters have the numbers from 0 to {last}"))
        .help("use another one"));
    }
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "range checked"
    )]
    Ok(Parameter::Numbered(R_BASE + nearest as u32))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn elements_count_with_the_last_index_fastest() {
        let span = SourceSpan::default();
        let at = |indices: &[f64]| element_at(&[2, 3], indices, span).ok();
        assert_eq!(at(&[0.0, 0.0]), Some(0));
        assert_eq!(at(&[0.0, 2.0]), Some(2));
        assert_eq!(at(&[1.0, 0.0]), Some(3));
        assert_eq!(at(&[2.0, 0.0]), None);
        assert_eq!(at(&[0.5, 0.0]), None);
        assert_eq!(at(&[-1.0, 0.0]), None);
        assert_eq!(at(&[1.0]), None);
    }
}
