//! The language: from the text of a line to the words of a block.
//!
//! Nothing here knows a machine, a modal state, an offset or a tool. The same text always gives the
//! same block, but for the parameters its expressions read: those are asked of a
//! [`Scope`](expression::scope::Scope), which whoever executes the program provides.
//!
//! ```text
//! bytes ─ LineSource ─► line ─┬─ read_plain_line ───────────────► StraightLine or Block
//!                             ├─ Block::parse_any (expressions) ─► Block
//!                             └─ read_o_word ────────────────────► OWord
//! ```
//!
//! The lines of other dialects are made ready for that first: see [`dialect`].

pub(crate) mod bad_byte;
pub(crate) mod block;
mod block_reader;
pub(crate) mod block_reader_of_dialects;
pub(crate) mod codes;
pub(crate) mod cursor;
pub(crate) mod dialect;
pub(crate) mod duplicate_word;
pub(crate) mod expression;
mod foreign;
pub(crate) mod frame_codes;
pub(crate) mod least_increments;
pub(crate) mod letters;
pub(crate) mod line_source;
pub(crate) mod modes;
pub(crate) mod named_word;
pub(crate) mod number;
pub(crate) mod o_word;
pub(crate) mod plain_line;
pub(crate) mod refused;
pub(crate) mod straight_line;
pub(crate) mod word_check;
