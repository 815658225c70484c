//! Sampling: settled motion to frames on the period grid.
//!
//! The grid runs on through every phase, piece and run: each stretch of motion starts a fraction of
//! a period before its first frame, and that fraction is carried, never rounded. Times and
//! positions are kept relative to the stretch, so a long program loses no digits.

use super::look_ahead::Settled;
use super::pieces::{Piece, Shape};
use super::speed::Leg;
use super::topp::Parametrisation;
use crate::grid::{FrameGrid, Moving, Passing};
use crate::scurve::PathState;
use glidepath_geometry::{AxisVector, Prepared};
use glidepath_program::Frame;
use std::collections::VecDeque;

/// Makes frames of settled motion, one at a time.
#[derive(Debug, Clone)]
pub(crate) struct Sampler {
    grid: FrameGrid,
    period_t: f64,
    /// Time from the start of the motion at hand to its first frame, 0 < t ≤ period.
    first_frame_t: f64,
    motion: Option<CurrentMotion>,
    /// Path position at the start of the piece at hand.
    path_s: f64,
    /// Speed at the end of the last motion.
    speed_v: f64,
    /// That motion was driven by a time parametrisation.
    was_parametrised: bool,
}

/// What comes next.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum NextFrame {
    /// A frame was made.
    Frame,
    /// The end of a motion; only if asked to stop there.
    Junction,
    /// Nothing more is settled.
    End,
    /// The motion settled for the path that begins at a line does not lead to its end.
    Broken { line: u32 },
}

/// The motion that frames are made of at present.
#[derive(Debug, Clone)]
struct CurrentMotion {
    pieces: Vec<Piece>,
    /// How it is driven: by a time parametrisation, or else by S-curves.
    parametrisation: Option<Parametrisation>,
    legs: Vec<Leg>,
    leg: usize,
    piece: usize,
    /// Where the piece at hand starts.
    piece_s: f64,
    /// The segment of the piece at hand, from its first frame on.
    prepared: Option<Prepared>,
    /// Frames made since the leg at hand started.
    frames: u32,
}

impl CurrentMotion {
    /// Position and speed of the last frame, if it is in the cruise of a motion of one piece.
    fn cruise(&self, first_frame_t: f64, period_t: f64) -> Option<(f64, f64)> {
        let ([_], [leg]) = (self.pieces.as_slice(), self.legs.as_slice()) else {
            return None;
        };
        let t = first_frame_t + f64::from(self.frames.checked_sub(1)?) * period_t;
        let is_cruise = leg.profile.cruise_t().contains(&t);
        is_cruise.then(|| (leg.profile.at(t).position_s, leg.profile.peak_v()))
    }
}

impl Sampler {
    pub(crate) fn new(period_t: f64, start: AxisVector) -> Self {
        Self {
            grid: FrameGrid::new(period_t, start),
            period_t,
            first_frame_t: period_t,
            motion: None,
            path_s: 0.0,
            speed_v: 0.0,
            was_parametrised: false,
        }
    }

    /// The next frame, in `frame`, as far as the motion is settled. With `pause`, stops at the next
    /// junction.
    pub(crate) fn next_frame(
        &mut self,
        settled: &mut VecDeque<Settled>,
        pause: bool,
        frame: &mut Frame,
    ) -> NextFrame {
        loop {
            if let Some(at_rest) = self.grid.rest_frame() {
                *frame = at_rest;
                return NextFrame::Frame;
            }
            if self.motion.is_some() {
                if self.motion_frame(frame).is_some() {
                    return NextFrame::Frame;
                }
                self.motion = None;
                if pause {
                    return NextFrame::Junction;
                }
            }
            match settled.pop_front() {
                Some(Settled::Motion { pieces, legs }) => {
                    if !leads_to_the_end(&pieces, &legs) {
                        let line = pieces.first().map_or(0, |piece| piece.line.number);
                        return NextFrame::Broken { line };
                    }
                    self.enter_motion(pieces, legs, None);
                }
                Some(Settled::Parametrised {
                    pieces,
                    parametrisation,
                }) => {
                    if !is_whole(&pieces, parametrisation.length_s()) {
                        let line = pieces.first().map_or(0, |piece| piece.line.number);
                        return NextFrame::Broken { line };
                    }
                    self.enter_motion(pieces, Vec::new(), Some(parametrisation));
                }
                Some(Settled::Rest(rest)) => {
                    self.speed_v = 0.0;
                    if self.grid.enter_rest(rest) {
                        self.first_frame_t = self.period_t;
                    }
                }
                None => return NextFrame::End,
            }
        }
    }

    /// The speed at which the motion can be planned anew from where the last frame is, if it has no
    /// acceleration along the path there: at a junction, at rest, or cruising along a single piece.
    pub(crate) fn steady_v(&self) -> Option<f64> {
        match &self.motion {
            None => Some(self.speed_v),
            Some(motion) => motion
                .cruise(self.first_frame_t, self.period_t)
                .map(|(_, v)| v),
        }
    }

    /// True between two motions if the last one was driven by a time parametrisation.
    pub(crate) const fn is_after_parametrisation(&self) -> bool {
        self.motion.is_none() && self.was_parametrised
    }

    /// What is left of the motion at hand after the last frame, where it is cruising.
    pub(crate) fn remaining_piece(&self) -> Option<Piece> {
        let motion = self.motion.as_ref()?;
        let (s, _) = motion.cruise(self.first_frame_t, self.period_t)?;
        Some(motion.pieces.first()?.clone().after(s))
    }

    /// Gives up what [`Sampler::remaining_piece`] returned: it was planned anew.
    pub(crate) fn drop_motion(&mut self) {
        if let Some(motion) = self.motion.take()
            && let Some((s, _)) = motion.cruise(self.first_frame_t, self.period_t)
        {
            self.path_s += s;
            self.first_frame_t = self.period_t;
        }
    }

    fn enter_motion(
        &mut self,
        pieces: Vec<Piece>,
        legs: Vec<Leg>,
        parametrisation: Option<Parametrisation>,
    ) {
        self.motion = Some(CurrentMotion {
            pieces,
            parametrisation,
            legs,
            leg: 0,
            piece: 0,
            piece_s: 0.0,
            prepared: None,
            frames: 0,
        });
        self.enter_piece();
    }

    /// The next frame of the motion, or `None` after setting up for the next one.
    fn motion_frame(&mut self, frame: &mut Frame) -> Option<()> {
        loop {
            let motion = self.motion.as_ref()?;
            let t = self.first_frame_t + f64::from(motion.frames) * self.period_t;
            let duration_t = match (&motion.parametrisation, motion.legs.get(motion.leg)) {
                (Some(parametrisation), _) if motion.leg == 0 => {
                    if t < parametrisation.duration_t() {
                        let state = parametrisation.at(t);
                        return self.frame_at(state, frame);
                    }
                    parametrisation.duration_t()
                }
                (None, Some(leg)) => {
                    if t < leg.profile.duration_t() {
                        let mut state = leg.profile.at(t);
                        state.position_s += leg.from_s;
                        return self.frame_at(state, frame);
                    }
                    leg.profile.duration_t()
                }
                _ => {
                    self.leave_motion();
                    return None;
                }
            };
            self.first_frame_t = (t - duration_t).min(self.period_t);
            if let Some(motion) = &mut self.motion {
                motion.leg += 1;
                motion.frames = 0;
            }
        }
    }

    fn frame_at(&mut self, state: PathState, frame: &mut Frame) -> Option<()> {
        let s = state.position_s;
        loop {
            let motion = self.motion.as_ref()?;
            let piece = motion.pieces.get(motion.piece)?;
            let last = motion.piece + 1 == motion.pieces.len();
            if last || s < motion.piece_s + piece.length_s {
                break;
            }
            self.leave_piece();
        }
        let motion = self.motion.as_mut()?;
        motion.frames += 1;
        let piece = motion.pieces.get(motion.piece)?;
        let piece_s = s - motion.piece_s;
        let jet = match (&piece.shape, &mut motion.prepared) {
            (Shape::Segment(_), Some(prepared)) => prepared.jet(piece.from_s + piece_s),
            (Shape::Segment(segment), none) => {
                none.insert(segment.prepared()).jet(piece.from_s + piece_s)
            }
            (Shape::Spline(span), _) => span.state(piece.from_s + piece_s),
            (Shape::Transition(_), _) => piece.jet(piece_s),
        };
        let (v, a) = (state.speed_v, state.accel_a);
        self.grid.pass(Passing {
            line: piece.line_at(piece_s),
            rapid: piece.rapid,
            synchronised: piece.synchronised,
            per_revolution: piece.per_revolution,
            programmed_v: piece.rule.programmed_v(),
            planned_override: piece.planned_override(),
        });
        *frame = self.grid.motion_frame(&Moving {
            path_v: v,
            path_s: self.path_s + piece_s,
            position: jet.position,
            velocity: jet.d1 * v,
            acceleration: jet.d2 * (v * v) + jet.d1 * a,
        });
        Some(())
    }

    /// Goes on to the next piece of the motion.
    fn leave_piece(&mut self) {
        if let Some(motion) = &mut self.motion
            && let Some(piece) = motion.pieces.get(motion.piece)
        {
            motion.piece_s += piece.length_s;
            motion.piece += 1;
            motion.prepared = None;
            self.path_s += piece.length_s;
        }
        self.enter_piece();
    }

    fn enter_piece(&mut self) {
        if let Some(motion) = &self.motion
            && let Some(piece) = motion.pieces.get(motion.piece)
        {
            self.grid.enter(
                Passing {
                    line: piece.line,
                    rapid: piece.rapid,
                    synchronised: piece.synchronised,
                    per_revolution: piece.per_revolution,
                    programmed_v: piece.rule.programmed_v(),
                    planned_override: piece.planned_override(),
                },
                &piece.events,
                self.path_s + piece.events_s,
            );
        }
    }

    /// Passes the pieces that no frame fell on, and notes where the motion ends.
    fn leave_motion(&mut self) {
        while let Some(motion) = &self.motion
            && motion.piece + 1 < motion.pieces.len()
        {
            self.leave_piece();
        }
        if let Some(motion) = &self.motion
            && let Some(piece) = motion.pieces.last()
        {
            let by_legs_v = motion.legs.last().map_or(0.0, |leg| leg.profile.exit_v());
            self.speed_v = motion
                .parametrisation
                .as_ref()
                .map_or(by_legs_v, Parametrisation::exit_v);
            self.was_parametrised = motion.parametrisation.is_some();
            self.path_s += piece.length_s;
            self.grid
                .leave(piece.jet(piece.length_s).position, self.path_s);
        }
    }
}

/// True if the S-curves of a stretch follow each other from its start to its end.
fn leads_to_the_end(pieces: &[Piece], legs: &[Leg]) -> bool {
    let mut driven_s = 0.0;
    for leg in legs {
        if (leg.from_s - driven_s).abs() > 1e-9 * leg.from_s.max(1.0) {
            return false;
        }
        driven_s = leg.from_s + leg.profile.at(leg.profile.duration_t()).position_s;
    }
    is_whole(pieces, driven_s)
}

/// True if a length driven is that of some pieces.
fn is_whole(pieces: &[Piece], driven_s: f64) -> bool {
    let length_s: f64 = pieces.iter().map(|piece| piece.length_s).sum();
    (driven_s - length_s).abs() <= 1e-9 * length_s.max(1.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::on_path::pieces::SpeedRule;
    use crate::programmed_rate::ProgrammedRate;
    use glidepath_geometry::Segment;
    use glidepath_program::{Limits, Override, ProgramLine, Rate};

    #[test]
    fn a_stretch_without_a_motion_to_its_end_is_never_jumped_over() {
        let (start, mut end) = (AxisVector::zeros(), AxisVector::zeros());
        end[0] = 3.0;
        let segment = Segment::line(start, end);
        let rule = SpeedRule::Straight {
            d1: segment.jet(0.0).d1,
            rate: ProgrammedRate {
                rate: Rate::Feed(10.0),
                axes_v: 200.0,
            },
        };
        let piece = Piece {
            shape: Shape::Segment(segment),
            from_s: 0.0,
            length_s: 3.0,
            limit: rule.limit(Override::NONE, &Limits::uniform(200.0, 2000.0, 40_000.0)),
            rule,
            joints: None,
            planned: Override::NONE,
            line: ProgramLine {
                number: 17,
                block: 3,
            },
            lines: Vec::new(),
            rapid: false,
            synchronised: false,
            per_revolution: false,
            events: Vec::new(),
            events_s: 0.0,
        };
        let mut settled = VecDeque::from([Settled::Motion {
            pieces: vec![piece],
            legs: Vec::new(),
        }]);
        let (mut sampler, mut frame) = (Sampler::new(0.004, start), Frame::blank(start));
        let mut next = || sampler.next_frame(&mut settled, false, &mut frame);
        assert_eq!(next(), NextFrame::Frame);
        assert_eq!(next(), NextFrame::Broken { line: 17 });
    }
}
