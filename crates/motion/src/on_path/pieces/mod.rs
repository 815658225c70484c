//! The elements of a path: smooth pieces, each with one speed limit, and the rests between them.

mod element;
mod joint_rule;
mod piece;
mod speed_limit;

pub(crate) use element::Element;
pub(crate) use joint_rule::JointRule;
pub(crate) use piece::{Piece, Shape};
pub(crate) use speed_limit::{CurveRule, SpeedLimit, SpeedRule, straight_limit};
