//! The plan with a stop at the end of every block: the other way to drive a stretch between two
//! rests, exactly along the program.
//!
//! Curves and transitions nearly always win, and by far. But on a path that turns sharply at nearly
//! every short block, stopping can be faster: the limits of jerk let a machine turn around in no
//! length at all. Whether it is cannot be told corner by corner. So for stretches of few blocks
//! both ways are planned, and the faster is taken; of longer ones, the blocks are not kept.

use crate::on_path::pieces::Piece;
use crate::on_path::speed::Leg;
use crate::scurve::Profile;

/// S-curves from rest to rest along each of some pieces; `None` if there is none for one of them.
pub(crate) fn drive_each(pieces: &[Piece]) -> Option<Vec<Leg>> {
    let leg = |piece: &Piece| {
        let limit = &piece.limit;
        let profile = Profile::new(0.0, 0.0, piece.length_s, limit.top_v, limit.change)?;
        let from_s = 0.0;
        Some(Leg { from_s, profile })
    };
    pieces.iter().map(leg).collect()
}
