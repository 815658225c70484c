//! The language: which words a program may have, and what they do.
//!
//! It is RS274/NGC as LinuxCNC reads it, and what other controls have in its place:
//! [`Dialect`](crate::Dialect) tells what differs. A program starts in
//! G8 G17 G21 G40 G49 G54 G64 G80 G90 G91.1 G94 G97 G98.
//!
//! | words | what they do |
//! |---|---|
//! | G0 G1 G2 G3 G80 | moves; arcs with I J K or R, P turns, helices, in every plane |
//! | G4 P | dwell, seconds |
//! | G5, G5.1, G5.2 … G5.3, G6.2 | splines: cubic, quadratic, NURBS with weights, with weights and knots |
//! | G7 G8 | X words are diameters, radii |
//! | G10 L2, L20 (P, R); G54 … G59.3; G52; G92 … G92.3; G53 | coordinate systems |
//! | G10 L1, L10, L11 (P, R, Q) | tool table, until the program ends |
//! | G17 G18 G19, G17.1 G18.1 G19.1 | plane of arcs and cycles |
//! | G20 G21 | inch, millimetre |
//! | G28 G30, G28.1 G30.1 | reference positions, machine zero until they are set |
//! | G33 K Q, G33.1 K, G76 | threads and rigid taps behind the spindle, whose angle has to be known |
//! | G38.2 … G38.5 | probing, with simulated or real connections |
//! | G40 G41 G42 D, G41.1 G42.1 D L | cutter radius compensation, in G17 and G18 |
//! | G43 H, G43.1, G43.2 H, G49 | tool length offsets, on every axis |
//! | G61 G61.1 G64 P Q | path mode; Q is checked and not used |
//! | G70, G71 G71.1 G71.2, G72 G72.1 G72.2 Q | lathe cycles along the profile in subroutine Q: finishing, turning, facing |
//! | G73 G74 G81 … G86 G89, G98 G99 | canned cycles, L holes each |
//! | G90 G91, G90.1 G91.1 | absolute, incremental; of I J K |
//! | G93 G94 G95 F | inverse time, per minute, per revolution |
//! | G96 S D, G97 S | cutting speed, revolutions |
//! | `@` `^` | polar words for X and Y |
//! | S T M0 M1 M3–M9 M48 M49 M60 M61 Q, `$0`, `$-1` | events, in order with the motion; the one spindle there is |
//! | M50 M51 P1, M53 P0 | no effect: so it is; what they would change is refused |
//! | M52 P | the feed follows an input, where there is one ([`Options::adaptive_feed`](crate::Options::adaptive_feed)) |
//! | M70 M71 M72 M73 | save and restore the modal state, by subroutine |
//! | M19, M62 … M68 | events, only with simulated connections |
//! | M2 M30, `%` | end of the program; the end of the input is one too |
//! | N, `/`, `( )`, `;`, `O1234` alone | no effect (`/`: [`Options::block_delete`](crate::Options::block_delete)) |
//! | `#1`, `#<name>`, `[ ]`, functions | parameters and expressions; `#<_x>`, `#<_plane>` … show the state |
//! | O words | `sub` `call` `return`, `if`, `while`, `do`, `repeat`, `break`, `continue` |
//! | `o<name> call`, `o100 call` of what the program does not define | the subroutine in `name.ngc`, `100.ngc` ([`Subroutines`](crate::Subroutines)) |
//!
//! Not supported, and refused by name: G87, G88, and to take overrides from the operator (M50, M51) and
//! feed stop (M53).
//!
//! # Order of execution
//!
//! Whatever stands where in a line, a block acts in this order: feed mode, F, S, T, tool change,
//! spindle, coolant, overrides, saved state, inputs and outputs, dwell, plane, units, diameter
//! mode, cutter radius, tool length, coordinate system, path mode, distance modes, retract mode,
//! then the codes that are not modal (G10, G28, G30, G52, G92), then the motion, and last the stop.
//!
//! # Where it differs from LinuxCNC
//!
//! LinuxCNC's own interpreter has judged a collection of programs; verdict, line of the first
//! error, counts, lengths, times, corners and end points agree in 99.01 % of 1310 figures. The
//! others, each on purpose:
//!
//! | what | LinuxCNC | here |
//! |---|---|---|
//! | G33, G76 | begin where the axes have come to the spindle's speed | begin at an angle that does not depend on the speed; without an encoder ([`Options::threading`](crate::Options::threading)) refused |
//! | G70, G71 beside G90.1 or G91.1 without words of a cycle | refused | Mach3's inches and millimetres, where these are in force |
//! | G95 behind M5 | the move waits for the spindle | refused |
//! | F beside G33 | the next feedrate | refused: the spindle gives the speed |
//! | G33.1 | told to turn back at the depth, runs on below | the same, or told before ([`Threading::spindle_a`](crate::Threading::spindle_a)), and the way of ten revolutions below has to be inside the travel ([`Threading::overtravel`](crate::Threading::overtravel)); planned, and with I, P, Q and R, where the spindle is an axis ([`SpindleAxis`](crate::SpindleAxis)) |
//! | G74, G84 | for a tap in a holder that gives way | the same, or rigid ([`Threading::rigid_tapping`](crate::Threading::rigid_tapping)) |
//! | a byte order mark; NUL bytes | refused; the block behind them is lost | no effect; refused |
//! | a coordinate of 1e24 | accepted | refused: above [`MAX_NUMBER`](crate::MAX_NUMBER) |
//! | moves of a picometre | executed | merged with the next |
//! | a weight of zero in G5.2 | accepted | refused: it has no meaning |
//! | G71, G72 beside arcs in each other's way; from the wrong side | come nearer to the profile than D; cut there | keep the distance; refused |
//! | recursion without end | blamed on the first call | on the call that is one too many |
//! | a corner that the tool's radius cannot reach | blamed on the move behind it | on the move that is too short |
//! | a loop without end and without motion | never ends | refused after [`LoopLimits`](crate::LoopLimits) |
//! | end point and corners after G92, G92.1 | shift with the offset | stay where the machine is |
//! | a file without M2, M30 or `%` | refused | the end of the file is the end |
//! | a subroutine behind its call in the same file | found there | refused, if no file has its name |
//! | the folder of subroutines in other files | of the configuration | the program's, then those of the search path; names with `/` are refused |
//! | M72, M73 with another G41 or G42 in force than was saved | begin it anew, with the tool's diameter | refused |
//! | M72, M73 with G43.1, G43.2 or G64 P saved | G43 of the tool in the spindle; P in the units in force | as they were |
//! | G98 or G99 where a program says neither | G99: to the R plane | G98, which goes higher |
//! | lines above 252 characters | refused | up to [`MAX_LINE_BYTES`](crate::MAX_LINE_BYTES) |

pub use crate::syntax::dialect::words::listing::{Treatment, Word, lathe_words, words};
