//! The reader of demands for jogs, which turns records into demands about axes: it knows the machine.

use crate::shared::config::Config;
use crate::shared::message::jog_demand::Demand;
use glidepath_geometry::{AXES, Axis, AxisVector};
use glidepath_link::{JogDemand, RecordError};
use glidepath_program::Limits;

/// Larger numbers are refused, so that no sum or product of them is infinite.
const LARGEST: f64 = 1e12;

/// Why a demand is not followed.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub(crate) enum DemandError {
    /// A field cannot be trusted.
    #[error(transparent)]
    Record(#[from] RecordError),
    /// The machine has no such axis.
    #[error("a jog of axis {0}, which the machine does not have")]
    NoAxis(Axis),
    /// The machine has no such joint.
    #[error("a jog of joint J{0}, which the machine does not have")]
    NoJoint(usize),
    /// A number so large that it cannot be meant.
    #[error("a jog by {0}, which is no velocity, distance or count of any machine")]
    TooLarge(f64),
    /// Joints are not axes.
    #[error("a jog by joint, but the joints of this machine are not its axes: jog by axis")]
    JointsMoveTogether,
}

/// What turns records into demands: it knows the machine.
#[derive(Debug, Clone, Copy)]
pub(crate) struct DemandReader {
    has_axis: [bool; AXES],
    /// The axis of each joint, where joints are axes.
    of_joint: Option<[Option<Axis>; AXES]>,
}

impl DemandReader {
    pub(crate) fn new(config: &Config) -> Self {
        let mut has_axis = [false; AXES];
        for (has, limit) in has_axis.iter_mut().zip(&config.limits.velocity) {
            *has = *limit < Limits::UNLIMITED;
        }
        let of_joint = config.axis_of_joint();
        Self { has_axis, of_joint }
    }

    /// The demand of a record.
    ///
    /// # Errors
    /// Why it is not followed.
    pub(crate) fn read(&self, record: &JogDemand) -> Result<Demand, DemandError> {
        use glidepath_link::Record as _;
        record.check()?;
        let mut value = AxisVector::zeros();
        for (bit, asked) in record.value.iter().enumerate() {
            if record.mask >> bit & 1 == 0 {
                continue;
            }
            let axis = self.axis(bit, record.by_joint == 1)?;
            if let Some(slot) = value.get_mut(axis.index()) {
                *slot = *asked;
            }
        }
        for number in [value.amax(), record.scale.abs()] {
            if number > LARGEST {
                return Err(DemandError::TooLarge(number));
            }
        }
        let most_v = if record.velocity_v > 0.0 {
            record.velocity_v
        } else {
            f64::INFINITY
        };
        Ok(Demand {
            client: record.client,
            number: record.number,
            sent_ns: record.sent_ns,
            is_outdated: false,
            behind_stops: 0,
            mode: record.mode()?,
            most_v,
            scale: record.scale,
            value,
        })
    }

    fn axis(&self, bit: usize, by_joint: bool) -> Result<Axis, DemandError> {
        let axis = if by_joint {
            let joints = self.of_joint.ok_or(DemandError::JointsMoveTogether)?;
            let of_joint = joints.get(bit).copied().flatten();
            of_joint.ok_or(DemandError::NoJoint(bit))?
        } else {
            *Axis::ALL.get(bit).ok_or(DemandError::NoJoint(bit))?
        };
        let is_there = self.has_axis.get(axis.index()) == Some(&true);
        is_there.then_some(axis).ok_or(DemandError::NoAxis(axis))
    }
}
