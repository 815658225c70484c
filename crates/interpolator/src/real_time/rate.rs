//! The rate of program time: hold, resume and override without breaking a limit.
//!
//! Every tick, program time advances by the rate r, 0 ≤ r ≤ 1, in periods. With Q the planned
//! motion, the published one has
//!
//! ```text
//! q′ = Q′ r      q″ = Q″ r² + Q′ ṙ      q‴ = Q‴ r³ + 3 Q″ r ṙ + Q′ r̈
//! ```
//!
//! so a change of r costs acceleration and jerk on top of the plan's own, and the plan may be at
//! its limit, for a while or (time-optimal plans) most of the time. No bound on ṙ and r̈ that is
//! computed from the present alone is therefore safe: the rate may start to fall where there is
//! room, and then find that it cannot be released where there is none.
//!
//! The way out is that the future is known. A change of the rate is a [`Ramp`](crate::real_time::ramp::Ramp)
//! from the present rate and slope to another steady rate. Before a ramp is chosen it is *played
//! through* on the frames at hand: the positions it would publish are computed, tick by tick to
//! three ticks past its end, and their differences compared with the limits. Only a ramp that
//! passes is committed, and a committed ramp is followed until a better one passes. Hence the
//! invariant that makes this safe: **at every tick, following what is committed breaks no limit and
//! needs no frame that is not here.** A steady rate r ≤ 1 is inside the limits because the plan is.
//!
//! Nothing is minimised here: what is looked for is a change of the rate that is known to pass. What is
//! tried has an order, best first, and the first that passes is taken. Whether one passes depends on what
//! the plan leaves at the very ticks that the ramp goes through, here more, there less; that one fails says
//! little of the next. And a tick has to be over in time: all is counted in *samples*, positions of the plan
//! that are computed and compared with the limits, and a budget of them is what a tick may spend.
//!
//! | | in |
//! |---|---|
//! | rate r, its slope, its bend | periods of program time per tick; 1 per tick, 1 per tick² |
//! | limits | differences of published positions, mm: V·T, A·T², J·T³ ([`crate::real_time::differences`]) |
//! | pace of a ramp | 1 over its stretching in time: of acceleration it takes that, of jerk the square |
//!
//! What is tried, in this order, until one passes or the tick's budget of samples is used up (the
//! next tick then goes on from there):
//!
//! * ramps to the goal, fast to slow: the fastest bends to what the axes allow at the highest speed
//!   ahead, as if the plan itself took nothing; the others are the same stretched in time;
//! * ramps part of the way. At r < 1 the plan takes only r³ of the jerk it was given: once a little
//!   slower, there is room to go on. This is what gets away from a plan at its limits.
//!
//! While the rate is on its way by a slow or a partial ramp, faster ones are tried at every tick.
//! Most candidates fail in their first samples, so a tick rarely uses its budget. Where nothing
//! passes the rate stays and the next tick tries again from further on: a plan that brakes at its
//! limits cannot be made to brake harder, but it will be slow soon.
//!
//! That leaves the question whether there will be any stop before the frames run out. So motion
//! goes on only with a stop in reserve, played through beforehand ([`reserve_search`]; how it is
//! found: [`stop_search`]). To come to rest at the end of a block is a reserve, too, that ends at a
//! given frame and is taken on purpose: see [`arrival_search`].
//!
//! What happens where none is found: an earlier start and another way to search are tried; in the last ticks
//! before the reserve begins, a little slower; then the reserve is taken, which costs a stop and breaks
//! nothing. From rest the search goes on, at a lower rate, too ([`stop_choice`], [`reserve_search`]).
//!
//! A ramp to rate 1 is stretched so that it ends on the grid of the frames: from there on the
//! setpoints are the frames, bit for bit. Between its grid points a plan may exceed its jerk limit
//! by a little: where jerk steps by 2J in the middle of a period the quintic is off by J·T³/384 there, and
//! with two such steps three periods apart a third difference is off by .52 %. r³ makes up for that at
//! any lower steady rate, hence [`beside_full`].
//!
//! The files, each of which uses only those above it:
//!
//! | file | |
//! |---|---|
//! | [`progress`], [`situation`] | what a choice depends on: program time; frames and limits |
//! | [`play`] | a ramp is played through |
//! | [`steady_rate`], [`kept_stop`], [`reserve`] | where a stop sets out from; a stop as it is kept |
//! | [`greedy_slow_down`], [`stop_search`] | a stop is found |
//! | [`reserve_search`], [`arrival_search`] | when it begins: late, or to end at a frame |
//! | [`candidate`], [`ramp_trial`] | a ramp is shaped, and tried together with a stop after it |
//! | [`state`] | the states of the rate: **the diagram is there** |
//! | [`ramp_choice`], [`stop_choice`] | what a tick decides: which ramp, which stop |
//! | [`following`] | or a rate that is given from outside |

mod arrival_search;
mod candidate;
mod following;
mod greedy_slow_down;
mod kept_stop;
mod play;
mod progress;
mod ramp_choice;
mod ramp_trial;
mod reserve;
mod reserve_search;
mod situation;
mod state;
mod steady_rate;
mod stop_choice;
mod stop_search;

pub(crate) use candidate::{BESIDE_FULL, beside_full};
pub(crate) use progress::Progress;
pub(crate) use situation::Situation;
pub(crate) use state::Rate;

#[cfg(test)]
mod tests;
