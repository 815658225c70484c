//! The output of every tick: its setpoint, held against the limits of the axes.

use crate::real_time::differences::{Allowed, Differences, MachinePosition};
use crate::real_time::frame_summary::FrameSummary;
use crate::real_time::jog::AxesMotion;
use crate::real_time::joints::Joints;
use crate::real_time::limited_joints::LimitedJoints;
use crate::real_time::rate::Progress;
use crate::real_time::resting_travel::RestingTravel;
use crate::real_time::setpoint::SetpointWriter;
use crate::real_time::superposition::SuperposedAxis;
use crate::real_time::track::Track;
use crate::shared::config::Config;
use crate::shared::message::observation::Observation;
use crate::shared::tracker::Motion;
use glidepath_geometry::{Axis, AxisVector};
use glidepath_kinematics::{JointMotion, JointVector, KinematicsError};
use glidepath_link::Setpoint;

/// The outcome of writing the setpoint of a motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Written {
    /// It is within the limits.
    Inside,
    /// It exceeds a limit by this share of it; not a number if the position is none.
    Excess(f64),
    /// Program time is outside the track: nothing was written.
    Nothing,
}

/// Writes setpoints, and knows how the published positions move.
#[derive(Debug)]
pub(crate) struct Output {
    published: Differences,
    allowed: Allowed,
    setpoints: SetpointWriter,
    joints: Joints,
    /// Joints that are not the axes, with limits of their own.
    limited: Option<LimitedJoints>,
    resting: RestingTravel,
}

impl Output {
    pub(crate) fn new(config: &Config, boot_id: u64) -> Self {
        let period_t = config.period_t();
        let limited = LimitedJoints::of(config);
        let of_joints = limited.as_ref().map(|joints| &joints.limits);
        Self {
            published: at_rest(limited.as_ref(), &config.start_position),
            allowed: Allowed::new(&config.limits, of_joints, period_t),
            setpoints: SetpointWriter::new(period_t, boot_id, config.joints()),
            joints: Joints::new(config),
            limited,
            resting: RestingTravel::of(config),
        }
    }

    /// The last published position and its differences.
    pub(crate) const fn published(&self) -> &Differences {
        &self.published
    }

    /// Whether no play of a joint is being taken up.
    pub(crate) fn joints_rest(&self) -> bool {
        self.joints.rest()
    }

    /// Writes on which side of its play each joint is.
    pub(crate) fn write_sides(&self, sides: &mut JointVector) {
        self.joints.write_sides(sides);
    }

    /// The limits on the differences.
    pub(crate) const fn allowed(&self) -> &Allowed {
        &self.allowed
    }

    /// An epoch begins: its frames are others, so their events are new.
    pub(crate) const fn begin_epoch(&mut self) {
        self.setpoints.begin_epoch();
    }

    /// The machine stays where it is.
    pub(crate) fn rest(&mut self) {
        self.published = Differences::at_rest(&self.published.place());
    }

    /// Writes the setpoint at the present program time, and compares its position with the limits. Where the path
    /// is `dropped` there, at rest, that is inside the travel.
    pub(crate) fn write_moving(
        &mut self,
        epoch: u64,
        now: &Progress,
        track: &Track,
        dropped: bool,
        setpoint: &mut Setpoint,
    ) -> Written {
        let writer = &mut self.setpoints;
        if writer.write_moving(epoch, now, track, setpoint).is_none() {
            return Written::Nothing;
        }
        if dropped {
            setpoint.position = self.resting.nearest(&setpoint.position.into()).into();
        }
        self.joints.look_ahead(track, now.time.sequence, setpoint);
        self.go_to(&setpoint.position.into())
    }

    /// Writes the setpoint of axes that are moved by hand, so far away from the path, and compares
    /// its position with the limits.
    pub(crate) fn write_by_hand(
        &mut self,
        epoch: u64,
        passed: &FrameSummary,
        motion: &AxesMotion,
        away: &AxisVector,
        setpoint: &mut Setpoint,
    ) -> Written {
        self.setpoints
            .write_by_hand(epoch, passed, motion, away, setpoint);
        self.go_to(&motion.position)
    }

    /// Joints that were moved each for itself stay where they are.
    pub(crate) fn keep_joints(&mut self) {
        self.joints.stand_there();
    }

    /// Where the joints were told to be last, as the drives count.
    pub(crate) const fn joints(&self) -> &JointVector {
        self.joints.last()
    }

    /// Writes the setpoint of joints that are moved each for itself, and compares the position of
    /// their axes with the limits.
    pub(crate) fn write_by_joints(
        &mut self,
        epoch: u64,
        passed: &FrameSummary,
        motion: &JointMotion,
        setpoint: &mut Setpoint,
    ) -> Written {
        let standing: AxisVector = self.published.position();
        setpoint.position = standing.into();
        let Ok([position, velocity, acceleration]) = self.joints.write(motion, setpoint) else {
            return Written::Nothing;
        };
        let axes = AxesMotion {
            position,
            velocity,
            acceleration,
        };
        let away = AxisVector::zeros();
        self.setpoints
            .write_by_hand(epoch, passed, &axes, &away, setpoint);
        self.go_to(&position)
    }

    fn go_to(&mut self, position: &AxisVector) -> Written {
        let written = if self.published.allows(position, &self.allowed) {
            Written::Inside
        } else {
            Written::Excess(self.published.ratio(position, &self.allowed) - 1.0)
        };
        self.published.go_to(position);
        written
    }

    /// Writes the setpoint of a machine that stays where it is.
    pub(crate) fn write_standing(
        &mut self,
        epoch: u64,
        passed: &FrameSummary,
        setpoint: &mut Setpoint,
    ) {
        let position: AxisVector = self.published.position();
        self.published.go_to(&position);
        self.setpoints
            .write_standing(epoch, passed, &position, setpoint);
    }

    /// The next setpoints do not continue those before.
    pub(crate) const fn begin_reference(&mut self) {
        self.setpoints.begin_reference();
    }

    /// Which joints are to have power, and which are to find their home by themselves.
    pub(crate) const fn command_drives(&mut self, enable: u32, home: u32) {
        self.setpoints.command_drives(enable, home);
    }

    /// Takes the position over from the drives.
    pub(crate) fn hand_over(&mut self, seen: &Observation) {
        let (mut joints, mut axes) = (seen.joints, seen.axes);
        self.joints.take_over(&mut joints, &mut axes);
        self.published = at_rest(self.limited.as_ref(), &axes);
        self.joints.count_from(&seen.offset);
        self.joints.stand(&joints);
        self.setpoints.begin_reference();
    }

    /// What was superposed to an axis is part of its position from now on. Nothing moves.
    pub(crate) fn take_superposed(&mut self, axis: Axis, offset: f64) {
        let mut axes: AxisVector = self.published.position();
        if let Some(place) = axes.get_mut(axis.index()) {
            *place += offset;
        }
        self.published = at_rest(self.limited.as_ref(), &axes);
        self.setpoints.begin_reference();
    }

    /// Writes the setpoint of a machine whose joints, those in `follows` or all, are where their
    /// drives say.
    pub(crate) fn write_following(
        &mut self,
        epoch: u64,
        passed: &FrameSummary,
        seen: &Observation,
        follows: u32,
        setpoint: &mut Setpoint,
    ) {
        self.published = at_rest(self.limited.as_ref(), &seen.axes);
        self.joints.count_from(&seen.offset);
        self.setpoints
            .write_standing(epoch, passed, &seen.axes, setpoint);
        self.joints.repeat(&seen.joints, follows, setpoint);
    }

    /// Writes into the setpoint what the joints are to do for its axes, and compares that with their
    /// limits, where they are not the axes.
    ///
    /// # Errors
    /// The mechanism cannot be there. The joints are told to stay where they were.
    pub(crate) fn write_joints(
        &mut self,
        setpoint: &mut Setpoint,
    ) -> Result<Written, KinematicsError> {
        let joints = self.joints.follow(setpoint)?;
        if self.limited.is_none() {
            return Ok(Written::Inside);
        }
        let written = if self.published.allows_joints(&joints, &self.allowed) {
            Written::Inside
        } else {
            Written::Excess(self.published.joint_ratio(&joints, &self.allowed) - 1.0)
        };
        self.published.joints_go_to(&joints);
        Ok(written)
    }

    /// The same for the motion of the axes and of what is superposed together. The axes' own stays in the setpoint.
    ///
    /// # Errors
    /// As [`Output::write_joints`].
    pub(crate) fn write_superposed(
        &mut self,
        setpoint: &mut Setpoint,
        superposed: &SuperposedAxis,
    ) -> Result<Written, KinematicsError> {
        let (axis, Motion { x, v, a }) = (superposed.axis().index(), superposed.now());
        let own = (setpoint.position, setpoint.velocity, setpoint.acceleration);
        let rates = [
            (&mut setpoint.position, x),
            (&mut setpoint.velocity, v),
            (&mut setpoint.acceleration, a),
        ];
        for (rates, by) in rates {
            if let Some(rate) = rates.get_mut(axis) {
                *rate += by;
            }
        }
        let written = self.write_joints(setpoint);
        (setpoint.position, setpoint.velocity, setpoint.acceleration) = own;
        written
    }
}

/// Axes at rest for ever, and the joints that are not these.
fn at_rest(limited: Option<&LimitedJoints>, axes: &AxisVector) -> Differences {
    Differences::at_rest(&MachinePosition {
        axes: *axes,
        joints: limited.map_or_else(JointVector::zeros, |joints| joints.at(axes)),
    })
}
