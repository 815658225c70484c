//! The judgement of a curve file: every value in its range, every key with its kind, all
//! diagnostics at once.

use super::curve_file::{CurveFile, Shape};
use super::diagnostic::FileDiagnostic;
use super::raw::{Key, Number, Raw, RawEnd};
use crate::implicit::End;
use crate::range::{CHORD_MM, FEED_MM_MIN, Range as NumberRange, TOLERANCE_MM};
use crate::{Expression, ExpressionError, ImplicitCurve, ParametricCurve};
use core::ops::Range;
use nalgebra::Vector3;
use toml::Spanned;

/// How far the ends of a curve that is run for several laps may be apart, mm.
const CLOSED_MM: f64 = 1e-6;

/// Diagnostics so far, and where the file says what it is, for what is missing.
struct Judge {
    diagnostics: Vec<FileDiagnostic>,
    kind_at: Range<usize>,
}

pub(super) fn judge(raw: Raw) -> Result<CurveFile, Vec<FileDiagnostic>> {
    let mut judge = Judge {
        diagnostics: Vec::new(),
        kind_at: raw.kind.span(),
    };
    let within = |judge: &mut Judge, key: &str, value: &Key<f64>, range: &NumberRange| {
        let value = value.as_ref()?;
        let number = *value.as_ref();
        if let Some((message, help)) = range.refusal(key, number) {
            judge.find(value.span(), message, &help);
        }
        Some(number)
    };
    let feed_mm_min = within(&mut judge, "feed", &raw.feed, &FEED_MM_MIN);
    let tolerance_mm = within(&mut judge, "tolerance", &raw.tolerance, &TOLERANCE_MM);
    let chord_mm = within(&mut judge, "chord", &raw.chord, &CHORD_MM);
    let laps = judge.laps(raw.laps.as_ref());
    let name = raw.name.clone();
    let laps_at = raw.laps.as_ref().map(Spanned::span);
    let shape = match raw.kind.as_ref().as_str() {
        "parametric" => judge.parametric(&raw),
        "implicit" => judge.implicit(&raw),
        other => {
            let message = format!("the kind \"{other}\" of curve is not known");
            judge.find(
                raw.kind.span(),
                message,
                "give \"parametric\" or \"implicit\"",
            );
            None
        }
    };
    if let (Some((shape, _)), Some(at)) = (&shape, laps_at.filter(|_| laps > 1)) {
        judge.closed(shape, at);
    }
    match shape {
        Some((shape, keys)) if judge.diagnostics.is_empty() => Ok(CurveFile {
            name,
            feed_mm_min,
            tolerance_mm,
            chord_mm,
            laps,
            shape,
            keys,
        }),
        _ => Err(judge.diagnostics),
    }
}

type Placed = Option<(Shape, [Range<usize>; 3])>;

impl Judge {
    fn find(&mut self, at: Range<usize>, message: String, help: &str) {
        self.diagnostics.push(FileDiagnostic {
            message,
            help: help.to_owned(),
            at,
        });
    }

    fn laps(&mut self, laps: Option<&Spanned<i64>>) -> u32 {
        let Some(laps) = laps else { return 1 };
        let number = *laps.as_ref();
        u32::try_from(number)
            .ok()
            .filter(|n| (1..=1_000_000).contains(n))
            .unwrap_or_else(|| {
                self.find(
                    laps.span(),
                    format!("laps = {number} is out of range"),
                    "give 1 to 1000000",
                );
                1
            })
    }

    /// A key that a kind must have.
    fn wanted<'a, T>(&mut self, key: &str, value: &'a Key<T>) -> Option<&'a Spanned<T>> {
        if value.is_none() {
            let message = format!("the key `{key}` is missing");
            self.find(self.kind_at.clone(), message, "add it");
        }
        value.as_ref()
    }

    /// A key that belongs to the other kind.
    fn foreign<T>(&mut self, key: &str, value: &Key<T>) {
        if let Some(value) = value {
            self.find(
                value.span(),
                format!("the key `{key}` does not belong to this kind of curve"),
                "remove it, or change the kind",
            );
        }
    }

    fn formula_error(&mut self, value: &Spanned<String>, error: &ExpressionError) {
        // The text begins after the quote; in a string with escapes the place is a little off.
        let (start, end) = (value.span().start + 1, value.span().end - 1);
        let at = |byte: usize| (start + byte).min(end);
        self.find(
            at(error.at.start)..at(error.at.end),
            error.message.clone(),
            &error.help,
        );
    }

    fn formulas<const N: usize, C>(
        &mut self,
        keys: [(&str, &Key<String>); N],
        parse: impl Fn([&str; N]) -> Result<C, (usize, ExpressionError)>,
        variables: &[&str],
    ) -> Option<C> {
        let given = keys.map(|(key, value)| self.wanted(key, value));
        let mut texts = [""; N];
        for (text, value) in texts.iter_mut().zip(given) {
            let value = value?;
            if let Err(error) = Expression::parse(value.as_ref(), variables) {
                self.formula_error(value, &error);
            }
            *text = value.as_ref();
        }
        // Each was judged above, so that all are told and not the first alone.
        parse(texts).ok()
    }

    fn number(&mut self, key: &str, value: &Key<Number>) -> Option<f64> {
        let value = self.wanted(key, value)?;
        let number = match value.as_ref() {
            Number::Value(number) => *number,
            Number::Formula(text) => match Expression::parse(text, &[]) {
                Ok(formula) => formula.eval::<f64>(&[]),
                Err(error) => {
                    let text = Spanned::new(value.span(), text.clone());
                    self.formula_error(&text, &error);
                    return None;
                }
            },
        };
        if !number.is_finite() {
            self.find(
                value.span(),
                format!("{key} has no finite value"),
                "give a number or a formula such as \"4*pi\"",
            );
            return None;
        }
        Some(number)
    }

    fn parametric(&mut self, raw: &Raw) -> Placed {
        self.foreign("f", &raw.f);
        self.foreign("g", &raw.g);
        self.foreign("start", &raw.start);
        self.foreign("direction", &raw.direction);
        self.foreign("end", &raw.end);
        let keys = [("x", &raw.x), ("y", &raw.y), ("z", &raw.z)];
        let curve = self.formulas(keys, ParametricCurve::parse, &["t"]);
        let (from, to) = (self.number("from", &raw.from), self.number("to", &raw.to));
        let (curve, from, to) = (curve?, from?, to?);
        let place = |key: &Key<Number>| key.as_ref().map_or(0..0, Spanned::span);
        if from >= to {
            self.find(
                place(&raw.to),
                format!("from = {from} is not below to = {to}"),
                "let t grow; to go the other way, put -t for t in the formulas",
            );
        }
        let formula = raw.x.as_ref().map_or(0..0, Spanned::span);
        let shape = Shape::Parametric {
            curve,
            domain: (from, to),
        };
        Some((shape, [formula, place(&raw.from), place(&raw.to)]))
    }

    fn implicit(&mut self, raw: &Raw) -> Placed {
        for (key, value) in [("x", &raw.x), ("y", &raw.y), ("z", &raw.z)] {
            self.foreign(key, value);
        }
        self.foreign("from", &raw.from);
        self.foreign("to", &raw.to);
        let keys = [("f", &raw.f), ("g", &raw.g)];
        let curve = self.formulas(keys, ImplicitCurve::parse, &["x", "y", "z"]);
        let start = self.vector("start", &raw.start);
        let direction = self.vector("direction", &raw.direction);
        let end = self.end(&raw.end);
        let (curve, start, direction, end) = (curve?, start?, direction?, end?);
        let place = |key: &Key<[f64; 3]>| key.as_ref().map_or(0..0, Spanned::span);
        let formula = raw.f.as_ref().map_or(0..0, Spanned::span);
        let end_at = raw.end.as_ref().map_or(0..0, Spanned::span);
        let shape = Shape::Implicit {
            curve,
            start,
            direction,
            end,
        };
        Some((shape, [formula, place(&raw.start), end_at]))
    }

    fn vector(&mut self, key: &str, value: &Key<[f64; 3]>) -> Option<Vector3<f64>> {
        let value = self.wanted(key, value)?;
        let vector = Vector3::from(*value.as_ref());
        if !vector.iter().all(|c| c.is_finite()) {
            self.find(
                value.span(),
                format!("{key} is not finite"),
                "give three numbers",
            );
            return None;
        }
        Some(vector)
    }

    fn end(&mut self, value: &Key<RawEnd>) -> Option<End> {
        let value = self.wanted("end", value)?;
        let end = match value.as_ref() {
            RawEnd::Word(word) if word == "closed" => Some(End::Closed),
            RawEnd::Point(point) if point.iter().all(|c| c.is_finite()) => {
                Some(End::At(Vector3::from(*point)))
            }
            RawEnd::Length(mm) if *mm > 0.0 && mm.is_finite() => Some(End::Length(*mm)),
            _ => None,
        };
        if end.is_none() {
            self.find(
                value.span(),
                "the end is not understood".to_owned(),
                "give \"closed\", a point [x, y, z], or a length in mm",
            );
        }
        end
    }

    fn closed(&mut self, shape: &Shape, laps_at: Range<usize>) {
        let gap = match shape {
            Shape::Parametric { curve, domain } => {
                (curve.point(domain.1) - curve.point(domain.0)).norm()
            }
            Shape::Implicit {
                end: End::Closed, ..
            } => 0.0,
            Shape::Implicit { .. } => f64::INFINITY,
        };
        let is_closed = gap <= CLOSED_MM;
        if !is_closed {
            self.find(
                laps_at,
                "only a closed curve can be run for several laps".to_owned(),
                "let the curve end where it starts, or remove laps",
            );
        }
    }
}
