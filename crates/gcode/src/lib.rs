//! RS274/NGC text to canonical machining moves, with diagnostics.
//!
//! ```text
//! bytes ─ LineSource ─► line ─ Block::parse ─► block ─ Interpreter ─► items (lines, arcs, events)
//!                        ▲          ▲ parameters         │ modal state, offsets
//!                  Flow (O words)   └────────────────────┘
//! ```
//!
//! A program is read line by line in constant memory; subroutines and loops are kept, to a bound. Everything given out is in machine
//! coordinates, in mm, degrees and mm/s, whatever the program's units and offsets. What is not
//! understood is never skipped: it is a [`Diagnostic`] with line, column, reason and remedy.
//!
//! [`Program`] gives the items of a program for motion, and ends at the first finding. [`check`]
//! reads a program to its end and lists all findings.
//!
//! ```
//! use glidepath_gcode::{Options, Program, check};
//!
//! let text = "G21 G90\nG0 X10\nG1 Y5 F600\nM2\n";
//! let items: Result<Vec<_>, _> = Program::new(text.as_bytes(), Options::default()).collect();
//! assert_eq!(items?.len(), 2);
//!
//! let report = check("G1 X1.2.3 F100\n".as_bytes(), Options::default());
//! let finding = &report.diagnostics[0];
//! assert_eq!((finding.line, finding.column, finding.code.as_str()), (1, 5, "malformed-number"));
//! # Ok::<(), glidepath_gcode::Diagnostic>(())
//! ```

mod arc;
mod bad_byte;
mod block;
mod check;
mod codes;
mod cursor;
mod diagnostic;
mod expression;
mod flow;
mod flow_run;
mod flow_word;
mod interpreter;
mod modal;
mod moves;
mod offsets;
mod operation;
mod options;
mod parameters;
mod program;
mod source;
mod totals;
mod words;

pub use check::{MAX_CHECKED_LINES, MAX_FINDINGS, Report, check};
pub use codes::{Distance, FeedMode, Motion, Units};
pub use cursor::MAX_NUMBER;
pub use diagnostic::{Code, Diagnostic, Excerpt};
pub use modal::{Feed, Modal};
pub use options::{Machine, Options, Travel};
pub use program::Program;
pub use source::MAX_LINE_BYTES;
pub use totals::Totals;
