//! SINUMERIK: structures and jumps, variables, frames, cycles.
//!
//! ```text
//! IF … ELSE … ENDIF · IF … GOTOF A · WHILE … ENDWHILE · FOR R1=1 TO 5 … ENDFOR · LOOP … ENDLOOP
//! REPEAT … UNTIL · REPEAT A P=3 · REPEAT A B · REPEATB A · GOTO, GOTOF, GOTOB, GOTOC A · A: · N100
//! CASE … OF … · L1 P2 · NAME(5) · CALL, PCALL, EXTCALL · PROC, EXTERN, RET, M17
//! DEF REAL, INT, BOOL, arrays · TRANS, ROT, MIRROR, SCALE · ATRANS, AROT, AMIRROR, ASCALE
//! G58, G59 · $P_UIFR[n]=CTRANS(X,10) · $P_PFRAME=… · $TC_DP3[t,1]=50
//! CYCLE81 to 89 · CYCLE840 · CYCLE71, CYCLE76, CYCLE77, CYCLE95, CYCLE97, CYCLE98 · POCKET1 to POCKET4 · MCALL · HOLES1, HOLES2, CYCLE801, CYCLE802 · CYCLE800
//! ```
//!
//! A line of a cycle becomes several ones in RS274/NGC's words, which are executed one after the
//! other ([`steps`]), so that a long cycle takes no more memory at a time than its words.

mod arguments;
mod axis_offset;
mod boring;
mod case;
mod circular_pocket;
mod contour;
mod cycle;
mod define;
mod drilling;
mod edge;
mod face_milling;
mod flow;
mod frames;
mod lines;
mod modal_call;
mod named_call;
mod newer_arguments;
mod older_pocket;
mod pocket;
mod positions;
mod procedure;
mod program_frame;
mod read_line;
mod rectangle;
mod rectangular_pocket;
mod repetition;
mod single_positions;
mod spigot;
pub(crate) mod steps;
mod stock_removal;
pub(crate) mod subprogram;
mod swivel;
mod system_data;
mod system_values;
mod tapping;
mod thread_chain;
mod thread_cutting;
pub(crate) mod untraversed;
