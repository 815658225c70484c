//! The check that every motion passes before it is handed out: limits, travel, tolerance, order and
//! feed.

mod beside;
mod between_periods;
mod follow;
mod history;
mod near_pieces;
mod parameter_range;
mod travel;

#[cfg(test)]
pub(crate) use between_periods::BetweenPeriods;
pub(crate) use follow::{Follower, Reachable};
pub(crate) use history::{FEED_SLACK, History};
pub(crate) use near_pieces::{FEED_CHANGE_MM, NearPieces};
