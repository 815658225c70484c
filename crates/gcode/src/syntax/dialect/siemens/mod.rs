//! SINUMERIK: a line is rewritten into RS274/NGC words, and every byte keeps its place.
//!
//! | SINUMERIK | becomes |
//! |---|---|
//! | `X=expression` | `X[value]` |
//! | `X=AC(…)`, `X=IC(…)`, `I=AC(…)`, `C=DC(…)`, `ACP`, `ACN` | the same place by `X`, `I` or `C` in the mode in force |
//! | `R5=expression`, `NAME=expression` | `#1005=[value]`, `#<def.name>=[value]` |
//! | `CR=`, `TURN=n` | `R`, `P` of n + 1 |
//! | `RND=`, `CHR=`, `CHF=`, `RNDM=` | `,R`, `,C`, `,L`, `,M` |
//! | `LIMS=`, `AP=`, `RP=`, `AR=`, `ANG=`, `I1=` …, `A3=` …, `SPOS=` | a letter behind a comma ([`Named`](crate::syntax::named_word::Named)) |
//! | `CIP`, `CT` | `G2.5`, `G2.6` |
//! | `TRAORI`, `TRAFOOF` | `G43.4`, `G43.5` |
//! | `CYCLE832(tolerance, …)` | `G64 P` of the tolerance |
//! | `G641 ADIS=d`, `G642` … `G645` | `G64 P` of d, `G64` |
//! | `G60` | `G61.1` |
//! | `G710`, `G700` | `G21`, `G20` |
//! | `G4 F` | `G4 P` |
//! | `M17`, `RET`, `ENDPROC` | `M2`; in a subprogram nothing, and so do `M2` and `M30` |
//! | `MSG( )`, `;`, `%_N_…`, `G601` … `G603`, `SOFT`, `FFWON` … | nothing |
//!
//! Structures, jumps, declarations, frames and cycles are [`statement`]s of their own.

pub(crate) mod arguments;
mod assignment;
pub(crate) mod callee;
mod codes_of_line;
mod computed_words;
pub(crate) mod coordinate;
pub(crate) mod expression;
pub(crate) mod frame_word;
mod function;
mod literal;
mod marks;
mod operator;
mod refused_word;
mod rewritten;
pub(crate) mod statement;
pub(crate) mod system_index;
pub(crate) mod system_variable;
#[cfg(test)]
mod tests;
mod text;
pub(crate) mod text_variables;
mod valued_word;
mod variable_word;
pub(crate) mod variables;
pub(crate) mod writer;

pub(crate) use marks::marks;
