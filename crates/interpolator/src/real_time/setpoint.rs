//! The writer of setpoints: what is published in a tick, apart from the joints, the time and the
//! state.

use crate::real_time::events_told::EventsTold;
use crate::real_time::frame_summary::FrameSummary;
use crate::real_time::jog::AxesMotion;
use crate::real_time::rate::Progress;
use crate::real_time::track::Track;
use glidepath_geometry::{AXES, AxisVector};
use glidepath_link::{OVERRIDE_MAX, Setpoint, SetpointFrame};

/// Writes setpoints, and counts them.
#[derive(Debug)]
pub(crate) struct SetpointWriter {
    period_t: f64,
    boot_id: u64,
    /// The number of the next setpoint.
    number: u64,
    reference: u64,
    /// The joints that are to have power.
    enable: u32,
    /// The joints that are to find their home by themselves.
    home: u32,
    told: EventsTold,
}

impl SetpointWriter {
    pub(crate) fn new(period_t: f64, boot_id: u64, enable: u32) -> Self {
        Self {
            period_t,
            boot_id,
            number: 0,
            reference: 1,
            enable,
            home: 0,
            told: EventsTold::new(period_t),
        }
    }

    /// An epoch begins: its frames are others, so their events are new.
    pub(crate) const fn begin_epoch(&mut self) {
        self.told.begin_epoch();
    }

    /// The next setpoints do not continue those before.
    pub(crate) const fn begin_reference(&mut self) {
        self.reference += 1;
    }

    /// Which joints are to have power, and which are to find their home by themselves.
    pub(crate) const fn command_drives(&mut self, enable: u32, home: u32) {
        (self.enable, self.home) = (enable, home);
    }

    /// Writes the setpoint of an open epoch at the present program time. `None`, with nothing
    /// written, if that is outside the track.
    pub(crate) fn write_moving(
        &mut self,
        epoch: u64,
        now: &Progress,
        track: &Track,
        setpoint: &mut Setpoint,
    ) -> Option<()> {
        let frame = track.frame(now.time.sequence)?;
        let summary = FrameSummary::of(frame);
        write_motion(self.period_t, now, frame, track, setpoint)?;
        self.identify(epoch, &summary, setpoint);
        setpoint.fraction = now.time.fraction;
        setpoint.effective_override = (summary.planned_override * now.rate).min(OVERRIDE_MAX);
        setpoint.silence();
        self.told.go_on(now.time, track, setpoint);
        Some(())
    }

    /// Writes the setpoint of a machine at rest at a position, without an open epoch.
    pub(crate) fn write_standing(
        &mut self,
        epoch: u64,
        passed: &FrameSummary,
        position: &AxisVector,
        setpoint: &mut Setpoint,
    ) {
        self.identify(epoch, passed, setpoint);
        (setpoint.position, setpoint.path_s) = ((*position).into(), passed.path_s);
        (setpoint.velocity, setpoint.acceleration) = ([0.0; AXES], [0.0; AXES]);
        (
            setpoint.feed_v,
            setpoint.fraction,
            setpoint.effective_override,
        ) = (0.0, 0.0, 0.0);
        setpoint.silence();
    }

    /// Writes the setpoint of axes that are moved by hand, so far away from the path.
    pub(crate) fn write_by_hand(
        &mut self,
        epoch: u64,
        passed: &FrameSummary,
        motion: &AxesMotion,
        away: &AxisVector,
        setpoint: &mut Setpoint,
    ) {
        self.write_standing(epoch, passed, &motion.position, setpoint);
        setpoint.velocity = motion.velocity.into();
        setpoint.acceleration = motion.acceleration.into();
        setpoint.away = (*away).into();
    }

    /// Writes which setpoint it is, and where in the program.
    const fn identify(&mut self, epoch: u64, summary: &FrameSummary, setpoint: &mut Setpoint) {
        setpoint.boot_id = self.boot_id;
        setpoint.reference = self.reference;
        (setpoint.enable, setpoint.home) = (self.enable, self.home);
        setpoint.index = 0;
        setpoint.number = self.number;
        self.number += 1;
        setpoint.epoch = epoch;
        setpoint.sequence = summary.sequence;
        setpoint.line = summary.line;
        setpoint.block = summary.block;
        setpoint.flags = summary.flags;
        setpoint.away = [0.0; AXES];
    }
}

/// Writes where the axes and the path are and how they move. On the grid of the frames, at rate 1,
/// that is the frame.
fn write_motion(
    period_t: f64,
    now: &Progress,
    frame: &SetpointFrame,
    track: &Track,
    setpoint: &mut Setpoint,
) -> Option<()> {
    if now.rate >= 1.0 && now.slope == 0.0 && now.time.fraction <= 0.0 {
        setpoint.position = frame.position;
        setpoint.velocity = frame.velocity;
        setpoint.acceleration = frame.acceleration;
        (setpoint.path_s, setpoint.feed_v) = (frame.path_s, frame.path_v);
        return Some(());
    }
    let motion = track.kinematic(now.time)?;
    let path = track.path(now.time)?;
    let per_s = period_t.recip();
    let velocity = motion.velocity * (now.rate * per_s);
    let acceleration = (motion.acceleration * (now.rate * now.rate) + motion.velocity * now.slope)
        * (per_s * per_s);
    setpoint.position = motion.position.into();
    setpoint.velocity = velocity.into();
    setpoint.acceleration = acceleration.into();
    (setpoint.path_s, setpoint.feed_v) = (path.path_s, path.path_v * now.rate * per_s);
    Some(())
}
