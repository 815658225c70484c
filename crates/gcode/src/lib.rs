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
//! # The language
//!
//! RS274/NGC as LinuxCNC reads it. A program starts in G17 G21 G54 G64 G80 G90 G91.1 G94.
//!
//! | words | what they do |
//! |---|---|
//! | G0 G1 G2 G3 G80 | moves; arcs with I J K or R, P turns, helices, in every plane |
//! | G4 P | dwell, seconds |
//! | G10 L2, L20 (P, R); G54 … G59.3; G52; G92 … G92.3; G53 | coordinate systems |
//! | G17 G18 G19, G17.1 G18.1 G19.1 | plane of arcs |
//! | G20 G21 | inch, millimetre |
//! | G28 G30, G28.1 G30.1 | reference positions, machine zero until they are set |
//! | G61 G61.1 G64 P Q | path mode; Q is checked and not used |
//! | G90 G91, G90.1 G91.1 | absolute, incremental; of I J K |
//! | G93 G94 F | inverse time, per minute |
//! | S T M0 M1 M3–M9 M48 M49 M60 | events, in order with the motion |
//! | M2 M30, `%` | end of the program; the end of the input is one too |
//! | G8 G40 G49 G97 G98 G99 | accepted: they name what is the case anyway |
//! | N, `/`, `( )`, `;`, `O1234` alone | no effect (`/`: [`Options::block_delete`]) |
//! | `#1`, `#<name>`, `[ ]`, functions | parameters and expressions |
//! | O words | `sub` `call` `return`, `if`, `while`, `do`, `repeat`, `break`, `continue` |
//!
//! Not supported, and refused: canned cycles, splines, cutter radius compensation, tool lengths,
//! probing, threading, feed per revolution, polar words, subroutines in other files.
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
mod auxiliary;
mod axis_words;
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
mod once;
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
