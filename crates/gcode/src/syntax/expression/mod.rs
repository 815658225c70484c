//! Expressions: values of words as numbers, parameters and brackets.
//!
//! ```text
//! value     = [sign] ( number | parameter | "[" expression "]" | function )
//! parameter = "#" ( value | "<" name ">" )
//! function  = NAME "[" expression "]" | "ATAN[" expression "]/[" expression "]"
//!           | "EXISTS[#<" name ">]"
//! ```
//!
//! Operators, strongest first, each level from the left: `**`; `*` `/` `MOD`; `+` `-`; `EQ` `NE`
//! `GT` `GE` `LT` `LE`; `AND` `OR` `XOR`. Angles are in degrees. A comparison gives 1 or 0, and
//! two values are equal if they differ by less than 1e-6. A result that is no finite number is an
//! error at the operator that made it.
//!
//! FANUC has other operators, functions and strengths, and a value that is none ([`vacant`]).

mod finite;
mod function;
pub(crate) mod name;
mod operator;
mod reader;
pub(crate) mod scope;
#[cfg(test)]
mod tests;
pub(crate) mod vacant;
pub(crate) mod value;
