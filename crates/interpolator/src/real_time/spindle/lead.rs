//! The lead of a thread pass: what its frames say about it, before it begins.

use crate::real_time::track::Track;
use crate::shared::rest::is_at_rest;
use glidepath_link::SetpointFrame;
use glidepath_program::FrameFlags;

/// A speed that changes by no more than this part of it in a period is the one that the axes keep.
const STEADY_R: f64 = 1e-9;

/// How a pass sets out.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Lead {
    /// The frame at rest that the motion sets out from.
    pub(crate) start: u64,
    /// The speed of the spindle at which program time passes at rate 1, rev/s.
    pub(crate) rate_v: f64,
    /// Revolutions that the axes are late when they have their speed, against axes that had it at
    /// once.
    pub(crate) lag: f64,
}

/// The outcome of looking at the frames.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum LeadOutcome {
    /// More frames have to come.
    Open,
    Found(Lead),
    /// The motion ends before it is at a steady speed, or does not follow the spindle.
    None,
}

impl Lead {
    /// Looks for the run-in behind the frame `event`, of a pass that goes on by `pitch_mm` for each
    /// revolution.
    ///
    /// At a frame of the steady speed v, τ after the start and s along the path, the lag is
    /// n τ − s / K revolutions, with n = v / K.
    pub(crate) fn find(track: &Track, event: u64, pitch_mm: f64) -> LeadOutcome {
        let rests = |sequence: u64| track.frame(sequence).map(is_at_rest);
        let mut start = event;
        loop {
            match rests(start + 1) {
                None => return LeadOutcome::Open,
                Some(true) => start += 1,
                Some(false) => break,
            }
        }
        let Some(begins) = track.frame(start) else {
            return LeadOutcome::None;
        };
        let follows = |frame: &SetpointFrame| frame.has(FrameFlags::SYNC) && !is_at_rest(frame);
        let mut sequence = start + 1;
        while let Some(frame) = track.frame(sequence) {
            if !follows(frame) {
                return LeadOutcome::None;
            }
            let Some(next) = track.frame(sequence + 1) else {
                return LeadOutcome::Open;
            };
            let change_v = (next.path_v - frame.path_v).abs();
            if change_v <= STEADY_R * frame.path_v && follows(next) {
                #[allow(clippy::cast_precision_loss, reason = "frames at hand")]
                let run_in_t = (sequence - start) as f64 * track.period_t();
                let rate_v = frame.path_v / pitch_mm;
                let lag = rate_v * run_in_t - (frame.path_s - begins.path_s) / pitch_mm;
                return LeadOutcome::Found(Self { start, rate_v, lag });
            }
            sequence += 1;
        }
        LeadOutcome::Open
    }
}
