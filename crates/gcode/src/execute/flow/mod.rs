//! Subroutines and loops: lines that are kept, and run again.
//!
//! A program is a stream, so a line is gone once it is read. What may run more than once is kept:
//! a subroutine from its `sub` to its `endsub`, and a structure (`if`, `while`, `do`, `repeat`) of
//! the main program from its first O word to its last. While such a part is read nothing of it is
//! executed; its O words are checked and linked to each other. Then a subroutine waits for its
//! calls, and a structure is executed at once.
//!
//! ```text
//!            stream ──────────► executed at once
//!              │ O.. sub / if / while / do / repeat
//!              ▼
//!        Recorder (links) ── KeptLines ──► Activation (next line) ──► executed line by line
//!                              ▲               │ call
//!                        subroutines ◄─────────┘
//!                              ▲ first call of one that is in a file of its own
//! ```
//!
//! Memory is bounded: all kept text together by [`MAX_KEPT_BYTES`], calls by [`MAX_CALLS`].
//!
//! [`MAX_KEPT_BYTES`]: crate::setup::subroutine_file::MAX_KEPT_BYTES
//! [`MAX_CALLS`]: activation::MAX_CALLS

pub(crate) mod activation;
pub(crate) mod kept_lines;
pub(crate) mod load;
mod o_words;
pub(crate) mod recorder;
