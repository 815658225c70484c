//! The search for the end of the present block, or of the last block before a rapid, in the frames at
//! hand.
//!
//! A block is known by the number its frames carry (by the line, if a planner does not number
//! them). Its end is its last frame: the last point of the path that is a setpoint of its own, less
//! than a period of motion before the next block begins. A block without a frame, shorter than a
//! period of motion, is passed together with the one before it.
//!
//! ```text
//! frames     ─●──────●──────●──────●──────●─
//! block       7      7      7      9      9
//!                           └ the end of 7, and of 8
//! ```

use crate::real_time::program_time::ProgramTime;
use crate::real_time::track::Track;
use crate::shared::rest::is_at_rest;
use glidepath_link::SetpointFrame;
use glidepath_program::FrameFlags;

/// The blocks at whose end the motion is to rest.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Ends {
    /// Every block.
    Every,
    /// Those that a rapid follows, and that are none themselves.
    BeforeRapids,
}

impl Ends {
    /// Whether a block ends at a frame, by the one behind it.
    fn has(self, frame: &SetpointFrame, next: &SetpointFrame) -> bool {
        match self {
            Self::Every => block(frame) != 0 && block(frame) != block(next),
            Self::BeforeRapids => begins_rapid(frame, next),
        }
    }
}

/// The number of a frame's block; of its line, where blocks have none.
const fn block(frame: &SetpointFrame) -> u32 {
    if frame.block > 0 {
        frame.block
    } else {
        frame.line
    }
}

/// Whether a rapid begins behind a frame, before the next one.
pub(crate) fn begins_rapid(frame: &SetpointFrame, next: &SetpointFrame) -> bool {
    next.has(FrameFlags::RAPID) && !frame.has(FrameFlags::RAPID)
}

/// Frames looked at in one tick.
const FRAMES_PER_TICK: u64 = 64;

/// The search for the end of a block.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) enum BlockEnd {
    /// Nobody wants to know.
    #[default]
    Unwanted,
    /// At or after a frame; the frames before it are of the same block.
    Sought {
        /// That frame.
        from: u64,
    },
    /// At a frame.
    Found {
        /// That frame.
        frame: u64,
        /// Whether the plan rests there, so that motion can be held as it is.
        rests: bool,
    },
}

impl BlockEnd {
    /// Begins to look, or looks on; not for an end that the motion has passed.
    pub(crate) fn look(&mut self, ends: Ends, now: ProgramTime, track: &Track) {
        // Past a frame, but for rounding, the motion is on its way to the next.
        let now = now.snapped();
        let ahead = now.sequence + u64::from(now.fraction > 0.0);
        let mut from = match *self {
            Self::Found { frame, .. } if ahead <= frame => return,
            Self::Sought { from } => from.max(ahead),
            Self::Found { .. } | Self::Unwanted => ahead,
        };
        for _ in 0..FRAMES_PER_TICK {
            let (Some(frame), Some(next)) = (track.frame(from), track.frame(from + 1)) else {
                break;
            };
            if ends.has(frame, next) {
                let rests = is_at_rest(frame);
                *self = Self::Found { frame: from, rests };
                return;
            }
            from += 1;
        }
        *self = Self::Sought { from };
    }

    /// Looks for the next one.
    pub(crate) const fn skip(&mut self) {
        if let Self::Found { frame, .. } = *self {
            *self = Self::Sought { from: frame + 1 };
        }
    }

    /// The frame, if it is known.
    pub(crate) const fn frame(self) -> Option<u64> {
        match self {
            Self::Found { frame, .. } => Some(frame),
            Self::Unwanted | Self::Sought { .. } => None,
        }
    }

    /// The frame, if motion rests there by itself.
    pub(crate) const fn at_rest(self) -> Option<u64> {
        match self {
            Self::Found { frame, rests: true } => Some(frame),
            _ => None,
        }
    }

    /// The frame, if the motion has to be brought to rest there.
    pub(crate) const fn in_motion(self) -> Option<u64> {
        match self {
            Self::Found {
                frame,
                rests: false,
            } => Some(frame),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{frame_of, mill};

    fn track(blocks: &[(u32, u32)]) -> Track {
        let mut track = Track::new(
            0.004,
            (&mill(), None),
            crate::shared::m_code_waits::MCodeWaits::NONE,
            crate::shared::track_capacity::TRACK_CAPACITY,
        );
        for (sequence, &(block, line)) in (0..).zip(blocks) {
            let velocity = if block == 4 { 0.0 } else { 1.0 };
            track.push(&SetpointFrame {
                block,
                line,
                ..frame_of(sequence, [0.1], [velocity], [0.0])
            });
        }
        track
    }

    fn look(end: &mut BlockEnd, sequence: u64, track: &Track) -> Option<u64> {
        end.look(Ends::Every, ProgramTime::at(sequence), track);
        end.frame()
    }

    #[test]
    fn the_last_frame_of_a_block_is_its_end() {
        // The line repeats, as in a loop; the block does not.
        let track = track(&[(0, 0), (1, 5), (1, 5), (2, 5), (4, 5), (5, 6)]);
        let mut end = BlockEnd::default();
        assert_eq!(look(&mut end, 0, &track), Some(2));
        assert_eq!((end.in_motion(), end.at_rest()), (Some(2), None));
        assert_eq!(look(&mut end, 2, &track), Some(2), "it is there");
        end.skip();
        assert_eq!(look(&mut end, 2, &track), Some(3));
        assert_eq!(
            look(&mut end, 4, &track),
            Some(4),
            "the motion has passed 3"
        );
        assert_eq!((end.in_motion(), end.at_rest()), (None, Some(4)));
        end.skip();
        assert_eq!(look(&mut end, 4, &track), None, "not known yet");
        assert_eq!(end, BlockEnd::Sought { from: 5 });
    }

    #[test]
    fn an_end_is_passed_as_soon_as_the_motion_is_beyond_it() {
        let track = track(&[(1, 5), (2, 5), (2, 5), (3, 5)]);
        let mut end = BlockEnd::default();
        assert_eq!(look(&mut end, 0, &track), Some(0));
        end.look(
            Ends::Every,
            ProgramTime {
                sequence: 0,
                fraction: 0.1,
            },
            &track,
        );
        assert_eq!(end.frame(), Some(2));
    }

    #[test]
    fn frames_without_blocks_are_told_apart_by_their_lines() {
        let track = track(&[(0, 0), (0, 3), (0, 3), (0, 7)]);
        assert_eq!(look(&mut BlockEnd::default(), 0, &track), Some(2));
    }
}
