//! Variables in a line: R parameters, declared ones, elements of arrays, and what fills them.

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::syntax::dialect::siemens::expression::{Evaluator, unclosed};
use crate::syntax::dialect::siemens::variables::{
    Declared, Kind, MAX_DIMENSIONS, element_at, r_parameter,
};
use crate::syntax::expression::scope::Parameter;

impl<'a> Evaluator<'a> {
    /// A variable that can be assigned, and what it holds.
    pub(crate) fn assignable(&mut self) -> Outcome<Option<(Kind, Parameter)>> {
        let start = self.at;
        let name = self.name_ahead();
        if let [b'R', digits @ ..] = name.as_slice()
            && digits.iter().all(u8::is_ascii_digit)
        {
            self.at += name.len();
            let number = match (digits.is_empty(), self.peek(0)) {
                (true, Some(b'[')) => self.index()?,
                (true, _) => {
                    self.at = start;
                    return Ok(None);
                }
                _ => parsed(digits),
            };
            let parameter = r_parameter(number, SourceSpan::new(start, self.at))?;
            return Ok(Some((Kind::Real, parameter)));
        }
        let Some(declared) = self.names.variables.get(&name) else {
            return Ok(None);
        };
        self.at += name.len();
        if declared.sizes.is_empty() {
            return Ok(Some((declared.kind, declared.element(0))));
        }
        let (kind, sizes) = (declared.kind, declared.sizes.clone());
        let indices = match self.next_visible() {
            Some(b'[') => self.indices()?,
            _ => Vec::new(),
        };
        let element = element_at(&sizes, &indices, SourceSpan::new(start, self.at))?;
        Ok(Some((kind, declared.element(element))))
    }

    /// A variable that is an argument by itself, an array without an index among them.
    pub(super) fn whole_variable(&mut self) -> Outcome<Option<Declared>> {
        let start = self.at;
        let name = self.name_ahead();
        let array = self.names.variables.get(&name);
        let array = array.filter(|declared| !declared.sizes.is_empty());
        self.at += name.len();
        let is_whole = array.is_some() && matches!(self.next_visible(), Some(b',' | b')'));
        let found = if is_whole {
            array.cloned()
        } else {
            self.at = start;
            let single = self.assignable()?;
            single.map(|(kind, parameter)| Declared::single(kind, parameter))
        };
        if matches!(self.next_visible(), Some(b',' | b')')) {
            return Ok(found);
        }
        self.at = start;
        Ok(None)
    }

    /// An array without an index, which SET or REP fill from its first element on; with one, from
    /// there on. What is to be filled, and from which element.
    pub(crate) fn array_to_fill(&mut self) -> Outcome<Option<(&'a Declared, usize)>> {
        let start = self.at;
        let name = self.name_ahead();
        let Some(declared) = self.names.variables.get(&name) else {
            return Ok(None);
        };
        if declared.sizes.is_empty() {
            return Ok(None);
        }
        self.at += name.len();
        let first = match self.next_visible() {
            Some(b'[') => {
                let indices = self.indices()?;
                element_at(&declared.sizes, &indices, SourceSpan::new(start, self.at))?
            }
            _ => 0,
        };
        let is_filled = self.eat(b'=') && {
            self.next_visible();
            matches!(self.name_ahead().as_slice(), b"SET" | b"REP")
        };
        if is_filled {
            return Ok(Some((declared, first)));
        }
        self.at = start;
        Ok(None)
    }

    /// The values behind `SET` and `REP`: of `room` elements at most, from the first one on.
    pub(crate) fn filling(&mut self, room: usize) -> Outcome<Vec<f64>> {
        let start = self.at;
        let is_set = self.name_ahead() == b"SET";
        self.at += 3;
        let arguments = self.arguments()?;
        let span = SourceSpan::new(start, self.at);
        let values: Vec<f64> = arguments.iter().flatten().copied().collect();
        let is_complete = values.len() == arguments.len() && !values.is_empty();
        let refuse = |message: &str, help: &str| {
            Err(BlockDiagnostic::new(DiagnosticCode::Parameter, span, message)
                .because(
                    "SET(a, b, …) gives each element a value, REP(a, n) gives n elements the same",
                )
                .help(help))
        };
        match (is_set, values.as_slice()) {
            _ if !is_complete => refuse("a value is missing", "write all values"),
            (true, values) if values.len() <= room => Ok(values.to_vec()),
            (false, [value]) => Ok(vec![*value; room]),
            (false, [value, count]) if (0.0..=room_of(room)).contains(count) => {
                #[expect(
                    clippy::cast_possible_truncation,
                    clippy::cast_sign_loss,
                    reason = "range checked"
                )]
                let count = count.round() as usize;
                Ok(vec![*value; count])
            }
            _ => refuse(
                "more values than the array has elements from there on",
                "write fewer, or make the array larger",
            ),
        }
    }

    /// `[value]` or `[value, value]`, whose bracket comes next.
    pub(super) fn indices(&mut self) -> Outcome<Vec<f64>> {
        let start = self.at;
        self.at += 1;
        let mut indices = Vec::new();
        loop {
            indices.push(self.comparison()?);
            if self.eat(b']') {
                return Ok(indices);
            }
            if indices.len() >= MAX_DIMENSIONS || !self.eat(b',') {
                return Err(unclosed(
                    SourceSpan::new(start, self.at.max(start + 1)),
                    "]",
                ));
            }
        }
    }

    /// `[value]` behind R.
    fn index(&mut self) -> Outcome<f64> {
        let start = self.at;
        self.at += 1;
        let value = self.comparison()?;
        if self.eat(b']') {
            return Ok(value);
        }
        Err(unclosed(
            SourceSpan::new(start, self.at.max(start + 1)),
            "]",
        ))
    }
}

/// The elements that are left, as a number.
fn room_of(room: usize) -> f64 {
    f64::from(u32::try_from(room).unwrap_or(u32::MAX))
}

fn parsed(digits: &[u8]) -> f64 {
    let text = core::str::from_utf8(digits).unwrap_or_default();
    text.parse().unwrap_or(f64::MAX)
}
