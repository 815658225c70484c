//! The drive state that the ports thread keeps: joints, following errors, homing and what the
//! status tells of them.

use super::adaptive::{AdaptiveWatch, turned_round};
use super::demands::Demands;
use super::drive_search::DriveSearch;
use super::following::FollowingErrors;
use super::joint_ownership::{JointOwnership, Joints};
use super::probe::ProbeWatch;
use super::revolutions::RevolutionWatch;
use super::spindle::SpindleWatch;
use super::superposition::SuperpositionWatch;
use crate::ports::homing::{HomingSequencer, Pair};
use crate::shared::config::Config;
use crate::shared::config::feedback::FeedbackSettings;
use crate::shared::message::TickReport;
use crate::shared::message::observation::Observation;
use glidepath_geometry::AxisVector;
use glidepath_kinematics::{
    JOINTS, JointCompensation, JointVector, Kinematics as _, Mechanism, Trivial,
};
use glidepath_link::{ContactKind, EndOfEpoch, FaultCause, Feedback, Power, Status};

/// Slower than this a joint is at rest, mm/s or °/s: more than a count in a millisecond.
const REST_V: f64 = 1.0;
/// The drives as their feedback shows them.
#[derive(Debug)]
pub(crate) struct DriveMonitor {
    pub(super) settings: FeedbackSettings,
    pub(super) mechanism: Mechanism,
    /// Joints of the machine, one bit each, as all that follow.
    pub(super) all: u32,
    /// Those that have to find their home.
    pub(super) homes: u32,
    /// Second joints of an axis.
    pub(super) pairs: Vec<Pair>,
    pub(super) sequencer: HomingSequencer,
    /// Joints that found their home by the sequencer, and in which life of their stack.
    pub(super) found: u32,
    pub(super) found_in: [u64; JOINTS],
    pub(super) ownership: JointOwnership,
    pub(super) demands: Demands,
    pub(super) following: FollowingErrors,
    pub(super) probe: ProbeWatch,
    pub(super) spindle: SpindleWatch,
    pub(super) adaptive: AdaptiveWatch,
    pub(super) revolutions: RevolutionWatch,
    pub(super) superposition: SuperpositionWatch,
    /// What is added to the drives' count.
    pub(super) offset: JointVector,
    /// What is taken out of where joints are told to be.
    pub(super) compensation: [Option<&'static JointCompensation>; JOINTS],
    /// On which side of its play each joint is.
    pub(super) sides: JointVector,
    /// Joints whose drives say that they know where they are, and are not believed.
    pub(super) unhomed: u32,
    /// The way home that drives look for themselves.
    pub(super) search: DriveSearch,
    pub(super) handover: u64,
    /// Where the axes were last, to choose among positions that belong to the same joints.
    pub(super) near: AxisVector,
    /// Whether the mechanism can be where the drives say.
    pub(super) has_pose: bool,
    pub(super) was_on: bool,
    /// Why joints did not come home, until that is told with the fault.
    pub(super) why: Option<(FaultCause, String)>,
    /// Whether an error was ordered for and the thread has not yet latched it.
    pub(super) ordered: bool,
    /// The first setpoint of which no fault is latched any more, or not yet.
    pub(super) cleared_from: u64,
}

impl DriveMonitor {
    pub(crate) fn new(config: &Config, settings: FeedbackSettings) -> Self {
        let all = config.joints();
        let ns = |time: core::time::Duration| u64::try_from(time.as_nanos()).unwrap_or(u64::MAX);
        let homing = settings.joints.map(|joint| joint.homing);
        let pairs: Vec<Pair> = config
            .second_joints()
            .map(|(joint, gantry)| Pair {
                joints: (gantry.master, joint),
                difference: gantry.difference,
            })
            .collect();
        let sequencer = HomingSequencer::new(homing, pairs.clone());
        let homes = (0..JOINTS)
            .filter(|joint| settings.joints.get(*joint).is_some_and(|joint| joint.homes))
            .fold(sequencer.joints(), |mask, joint| mask | 1 << joint);
        Self {
            pairs,
            sequencer,
            found: 0,
            found_in: [0; JOINTS],
            settings,
            mechanism: config.mechanism,
            all,
            homes: homes & all,
            ownership: JointOwnership::new(all, ns(settings.off_after), ns(settings.stale_after)),
            demands: Demands::new(),
            following: FollowingErrors::default(),
            probe: ProbeWatch::new(settings.probe),
            spindle: SpindleWatch::default(),
            adaptive: AdaptiveWatch::new(settings.adaptive, ns(settings.stale_after)),
            revolutions: RevolutionWatch::new(ns(settings.stale_after)),
            superposition: SuperpositionWatch::new(config.superposition, ns(settings.stale_after)),
            offset: JointVector::zeros(),
            compensation: config.compensation,
            sides: JointVector::zeros(),
            unhomed: 0,
            search: DriveSearch::default(),
            handover: 0,
            near: config.start_position,
            has_pose: true,
            was_on: false,
            why: None,
            ordered: false,
            cleared_from: 0,
        }
    }

    /// Takes what a stack sends. Gives what there is to log of it; as a rule an empty text.
    ///
    /// # Errors
    /// Why it is not used, for the log; an empty text if that was said before, or is not certain yet.
    pub(crate) fn take(&mut self, feedback: &Feedback, now_ns: u64) -> Result<String, String> {
        let news = self.ownership.take(feedback, now_ns)?;
        self.spindle.take(feedback);
        self.adaptive.look(feedback);
        self.superposition.look(feedback);
        self.probe
            .watch_out(feedback.sample_ns, &self.ownership.joints());
        if self.probe.is_searching() {
            self.probe.look(feedback, &self.ownership.joints());
        }
        Ok(news)
    }

    /// Takes note of a setpoint that was published.
    pub(crate) fn note(&mut self, report: &TickReport) {
        let is_on = report.power == Power::On;
        if is_on && !self.was_on {
            self.following.begin();
        }
        if self.was_on && !is_on {
            self.found &= !self.sequencer.mask(|joint| joint.is_volatile);
        }
        self.was_on = is_on;
        self.unhomed &= !self.search.note(report);
        self.ordered &= report.fault.is_none() && is_on;
        self.note_fault(report);
        self.demands.push(&report.setpoint);
        self.sides = report.sides;
        self.probe.note(report);
        self.adaptive.note(report);
        self.revolutions.note(report);
    }

    /// What the real-time thread is to know now.
    pub(crate) fn observe(&mut self, report: &TickReport, now_ns: u64) -> Observation {
        let joints = self.ownership.joints();
        self.forget_lost_homes(&joints);
        self.search.watch(now_ns);
        let setpoint = &report.setpoint;
        let follows = if report.power == Power::On {
            setpoint.home
        } else {
            self.all
        };
        if follows == self.all {
            self.forget_leaning_homes(&joints);
        }
        let mut position = JointVector::zeros();
        for joint in (0..JOINTS).filter(|joint| self.all & (1 << joint) != 0) {
            let counted = if follows & (1 << joint) == 0 {
                setpoint.joint_position[joint]
            } else {
                joints.position[joint]
            };
            position[joint] = self.nominal(joint, counted);
        }
        let age_ns = self.age_ns(&joints, now_ns);
        let axes = self.mechanism.forward(&position, &self.near);
        self.has_pose = axes.is_ok();
        if let Ok(axes) = axes {
            self.near = axes;
        }
        let turn = self.spindle.turn();
        let input_r = self.adaptive.factor(now_ns);
        let is_back = report.feed_override.is_sign_negative() != (input_r < 0.0);
        let by_spindle_r = self.revolutions.factor(&turn, is_back, now_ns);
        let lowest_fault = joints.fault.trailing_zeros() as usize;
        Observation {
            age_ns,
            is_known: age_ns != u64::MAX && axes.is_ok(),
            rests: joints.velocity.iter().all(|v| v.abs() < REST_V),
            joints: position,
            axes: self.near,
            offset: self.offset,
            enabled: joints.enabled,
            homed: self.homed(&joints) | self.found_by_drives(&joints),
            homing: joints.homing,
            faults: joints.fault | self.lost(&joints, report),
            limits: joints.limits & !self.sequencer.ignores_limits(),
            fault_code: joints.fault_code.get(lowest_fault).copied().unwrap_or(0),
            handover: self.handover,
            digital_in: joints.digital_in,
            spindle: joints.spindle,
            turn,
            played: joints.played,
            contact_in: self.probe.found_in(),
            adaptive_r: input_r * by_spindle_r,
            superposition: self.superposition.demand(joints.digital_in, now_ns),
        }
    }

    /// What the motion waits for besides, once.
    pub(crate) const fn take_news(&mut self) -> Option<&'static str> {
        self.revolutions.take_news()
    }

    /// How old the oldest sample of a joint is.
    pub(super) fn age_ns(&self, joints: &Joints, now_ns: u64) -> u64 {
        if joints.claimed != self.all {
            return u64::MAX;
        }
        let samples = joints.sample_ns.iter().enumerate();
        samples
            .filter(|(joint, _)| self.all & (1 << joint) != 0)
            .map(|(_, sample_ns)| now_ns.saturating_sub(*sample_ns))
            .max()
            .unwrap_or(0)
    }

    fn homed(&self, joints: &Joints) -> u32 {
        let of_drives = self.homes & !self.sequencer.joints();
        (self.all & !self.homes) | (joints.homed & !self.unhomed & of_drives) | self.found
    }

    /// The joints on their way home whose drives say that they are there: what ends that way, and is
    /// believed once it has ended well.
    const fn found_by_drives(&self, joints: &Joints) -> u32 {
        joints.homed & self.search.joints()
    }

    /// A stack that was started again counts anew: what was found does not hold any more.
    fn forget_lost_homes(&mut self, joints: &Joints) {
        let lives = joints.boot_id.iter().zip(&self.found_in).enumerate();
        let lost = lives
            .filter(|(joint, (now, then))| joints.claimed & (1 << joint) != 0 && now != then)
            .fold(0, |mask, (joint, _)| mask | 1 << joint);
        self.found &= !lost;
    }

    /// Two joints of an axis that gave way without power have to find their home again, if they are
    /// too far apart. Nearer, they stay as they are: nothing moves by a hand-over.
    fn forget_leaning_homes(&mut self, joints: &Joints) {
        for pair in &self.pairs {
            let (first, second) = pair.joints;
            if self
                .apart(joints, pair)
                .is_some_and(|apart| apart > pair.difference)
            {
                self.found &= !(1 << first | 1 << second);
            }
        }
    }

    /// Where a joint is when its drive counts so much, in the machine's count.
    pub(super) fn nominal(&self, joint: usize, counted: f64) -> f64 {
        let place = counted + self.offset[joint];
        self.compensation[joint].map_or(place, |by| by.nominal(place, self.sides[joint]))
    }

    /// Where a joint is when its axis is at a place, and the others are where they are.
    pub(super) fn place_of(&self, joint: usize, place: f64) -> f64 {
        let Mechanism::Trivial(Trivial {
            axes,
            cross: Some(_),
        }) = &self.mechanism
        else {
            return place;
        };
        let mut position = self.near;
        if let Some(axis) = axes.iter().nth(joint) {
            position[axis.index()] = place;
        }
        let joints = self.mechanism.inverse(&position);
        joints.map_or(place, |joints| joints[joint])
    }

    /// What is added for a place of a joint, in the middle of its play.
    pub(super) fn added(&self, joint: usize, place: f64) -> f64 {
        self.compensation[joint].map_or(0.0, |by| by.compensated(place, 0.0) - place)
    }

    fn all_nominal(&self, counted: &JointVector) -> JointVector {
        let mut places = counted + self.offset;
        for joint in (0..JOINTS).filter(|joint| self.compensation[*joint].is_some()) {
            places[joint] = self.nominal(joint, counted[joint]);
        }
        places
    }

    /// How far the joints of a pair are apart, if both have found their home.
    pub(super) fn apart(&self, joints: &Joints, pair: &Pair) -> Option<f64> {
        let (first, second) = pair.joints;
        let bits = 1 << first | 1 << second;
        let are_known = self.found & joints.claimed & bits == bits;
        let place = |joint: usize| self.nominal(joint, joints.position[joint]);
        are_known.then(|| (place(second) - place(first)).abs())
    }

    /// Writes what is known of the drives.
    pub(crate) fn write(&self, status: &mut Status, now_ns: u64) {
        let joints = self.ownership.joints();
        status.enabled = joints.enabled;
        status.homed = self.homed(&joints);
        status.drive_faults = joints.fault;
        (status.spindle_flags, status.spindle_v) = (joints.spindle.0, joints.spindle_v);
        status.spindle_load = joints.spindle_load;
        status.feedback_age_ns = self.age_ns(&joints, now_ns);
        status.joint_actual = self.all_nominal(&joints.position.into()).into();
        status.following_error = self.following.errors();
        status.following_peak = self.following.peaks();
        status.adaptive_feed = self.adaptive.told() * self.revolutions.told();
        if status.adaptive_feed < 0.0 {
            status.mode = turned_round(status.mode);
        }
        let ends = [EndOfEpoch::Tripped, EndOfEpoch::Completed].map(EndOfEpoch::code);
        if self.probe.keeps_open() == Some(status.epoch) && ends.contains(&status.end_of_epoch) {
            status.end_of_epoch = EndOfEpoch::Open.code();
        }
        let contact = self.probe.found();
        status.contact_kind = contact
            .map_or(ContactKind::None, |contact| contact.kind)
            .code();
        let joints = contact.map(|contact| self.all_nominal(&contact.joints));
        if let Some(Ok(axes)) = joints.map(|joints| self.mechanism.forward(&joints, &self.near)) {
            status.contact = axes.into();
        }
    }
}
