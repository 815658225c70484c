//! The planner as a library. One binary: it links once.

mod called_files;
mod chords;
mod curves;
mod curves_on_machines;
mod directions;
mod families;
mod from_line;
mod inner_side;
mod joints;
mod kept_feed;
mod listen;
mod nurbs;
mod nurbs_chords;
mod parallel;
mod parallel_threads;
mod pipeline;
mod programs;
mod publish;
mod resume;
mod slow_feed;
mod smooth;
mod support;
mod travel;
mod unanswered;
