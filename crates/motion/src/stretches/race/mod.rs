//! A long stretch, planned both ways as it comes: from meeting to meeting the faster way is driven.
//!
//! ```text
//!   in_tube  ──────┬──────────────────┬─────────      A place that both ways pass alike is one to
//!                  │╲                 │╲              leave one for the other, by a joint. What
//!   on_path  ──────┴─────────────────▶┴────────▶      lies between two such places is a section.
//!               meeting            meeting
//! ```
//!
//! In the tube a stretch is driven from meeting to meeting as long as the way along the path could
//! still be taken up there, not later than if it had been driven from the beginning (`LATE`). If
//! that does not hold at the next meeting, or at one of those that follow soon, the section is driven
//! along the path. So the stretch is not slower than along the path: not because it was tried, but
//! because every frame that is given out has a way to go on that is not.
//!
//! Where no joint is found for `MOST_T`, the motion goes on in the tube as long as that is further
//! than the way along the path would be; there is no more to go by.

mod deciding;
mod driving;
mod meeting;
mod state;
#[cfg(test)]
mod tests;
mod unmet;

pub(super) use state::Race;
