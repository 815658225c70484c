//! The ownership of joints: which servo stack drives which of them, and what the stacks say of
//! them.
//!
//! A joint belongs to the stack that claimed it first, until that one has been silent for so long
//! that the drives are off anyway. What another says of it meanwhile is refused, as a whole: a stack
//! that takes itself to drive somebody else's joint is set up wrongly.

use crate::ports::homing::Kept;
use glidepath_kinematics::JOINTS;
use glidepath_link::{FaultCause, Feedback, Latch, Loss, Record as _, SpindleFlags};

/// The joints as all stacks together report them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Joints {
    /// The joints that a stack has claimed, one bit each, as all that follow.
    pub(super) claimed: u32,
    pub(super) enabled: u32,
    pub(super) homed: u32,
    pub(super) homing: u32,
    pub(super) fault: u32,
    pub(super) limits: u32,
    pub(super) home_switch: u32,
    /// As the drives count.
    pub(super) position: [f64; JOINTS],
    pub(super) velocity: [f64; JOINTS],
    pub(super) sample_ns: [u64; JOINTS],
    pub(super) fault_code: [u32; JOINTS],
    /// The life of the stack that drives the joint.
    pub(super) boot_id: [u64; JOINTS],
    pub(super) edges: [Edges; JOINTS],
    /// Digital inputs and spindle, of all stacks together.
    pub(super) digital_in: u64,
    pub(super) spindle: SpindleFlags,
    /// Speed of the spindle, of a stack that measures it, rev/s.
    pub(super) spindle_v: f64,
    /// Its load, of a stack that measures it, as a part of its rated torque.
    pub(super) spindle_load: f64,
    /// Number of the last setpoint that every stack has played.
    pub(super) played: u64,
    /// What a stack has lost.
    pub(super) loss: Option<LossTold>,
}

/// Where the home switch of a joint first closed and opened since that was forgotten last, as the
/// drive counts: in the middle between the samples before and after, so that it is off by half of
/// the way between them at most.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Edges {
    pub(super) rising: Option<f64>,
    pub(super) falling: Option<f64>,
}

impl Joints {
    const NONE: Self = Self {
        claimed: 0,
        enabled: 0,
        homed: 0,
        homing: 0,
        fault: 0,
        limits: 0,
        home_switch: 0,
        position: [0.0; JOINTS],
        velocity: [0.0; JOINTS],
        sample_ns: [0; JOINTS],
        fault_code: [0; JOINTS],
        boot_id: [0; JOINTS],
        edges: [Edges {
            rising: None,
            falling: None,
        }; JOINTS],
        digital_in: 0,
        spindle: SpindleFlags(0),
        spindle_v: 0.0,
        spindle_load: 0.0,
        played: 0,
        loss: None,
    };
}

/// What a stack has lost.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct LossTold {
    pub(super) cause: FaultCause,
    /// See [`Feedback::loss_value`].
    pub(super) value: f64,
    /// The number of the setpoint that the stack had heard last when it told that.
    pub(super) heard: u64,
}

impl LossTold {
    /// The loss that a record tells of, if it does.
    fn of(said: &Feedback) -> Option<Self> {
        let loss = Loss::from_code(said.loss)?;
        Some(Self {
            cause: FaultCause::of_loss(loss)?,
            value: said.loss_value,
            heard: said.setpoint_number,
        })
    }
}

#[derive(Debug)]
struct Stack {
    last: Feedback,
    heard_ns: u64,
    /// Since when it claims what is another's, if it does.
    refused_ns: Option<u64>,
    /// Whether that was told.
    is_told: bool,
    edges: [Edges; JOINTS],
}

/// The stacks that are heard.
#[derive(Debug)]
pub(super) struct JointOwnership {
    stacks: Vec<Stack>,
    /// Joints of the machine.
    all: u32,
    /// How long a claim outlives its stack, ns.
    lasts_ns: u64,
    /// How far ahead of the clock a sample may be, ns.
    ahead_ns: u64,
    /// Whether it was said that a record cannot be used.
    has_told: bool,
}

impl Stack {
    const fn is_refused(&self) -> bool {
        self.refused_ns.is_some()
    }

    /// Looks whether home switches have changed with a newer record.
    fn find_edges(&mut self, newer: &Feedback) {
        let (before, after) = (self.last.home_switch, newer.home_switch);
        let positions = self.last.position.iter().zip(&newer.position);
        for (joint, (edges, (from, to))) in self.edges.iter_mut().zip(positions).enumerate() {
            let bit = 1 << joint;
            let middle = from.midpoint(*to);
            if after & !before & bit != 0 {
                edges.rising.get_or_insert(middle);
            }
            if before & !after & bit != 0 {
                edges.falling.get_or_insert(middle);
            }
        }
    }
}

/// How far a joint may be from zero, mm or degrees: beyond any axis, and millions of turns. What is
/// added to such a number and taken from it again still leaves a tenth of a micrometre.
pub(super) const FARTHEST: f64 = 1e9;

/// Stacks that are kept: one for each joint, and as many that are refused.
const STACKS: usize = 2 * JOINTS;

/// Joints, one bit each, as people name them.
fn names(joints: u32) -> String {
    let all = (0..JOINTS).filter(|joint| joints & (1 << joint) != 0);
    let names: Vec<String> = all.map(|joint| format!("J{joint}")).collect();
    names.join(" ")
}

impl JointOwnership {
    pub(super) const fn new(all: u32, lasts_ns: u64, ahead_ns: u64) -> Self {
        Self {
            stacks: Vec::new(),
            all,
            lasts_ns,
            ahead_ns,
            has_told: false,
        }
    }

    /// Takes what a stack sends. Gives what there is to log of it; as a rule an empty text.
    ///
    /// # Errors
    /// Why it is not used, for the log; an empty text if that was said before, or is not certain yet.
    pub(super) fn take(&mut self, feedback: &Feedback, now_ns: u64) -> Result<String, String> {
        if let Some(why) = self.unusable(feedback, now_ns) {
            // Once: such records come a thousand times a second.
            let is_new = !core::mem::replace(&mut self.has_told, true);
            return Err(if is_new { why } else { String::new() });
        }
        let lasts_ns = self.lasts_ns;
        self.stacks
            .retain(|stack| now_ns.saturating_sub(stack.heard_ns) <= lasts_ns);
        let claimed = feedback.joints & self.all;
        let others = |stack: &&Stack| {
            let is_other = stack.last.boot_id != feedback.boot_id && !stack.is_refused();
            is_other && stack.last.joints & claimed != 0
        };
        let owners = self.stacks.iter().filter(others);
        let (taken, heard_ns) = owners.fold((0, 0), |(taken, heard_ns), owner| {
            (
                taken | owner.last.joints & claimed,
                owner.heard_ns.max(heard_ns),
            )
        });
        let is_refused = taken != 0;
        let Some(stack) = self.stack(feedback, now_ns) else {
            return Err(String::new());
        };
        // Records overtake each other nowhere; an older one is a stack that is confused.
        if feedback.sample_ns >= stack.last.sample_ns {
            stack.find_edges(feedback);
            stack.last = *feedback;
            stack.heard_ns = now_ns;
            stack.refused_ns = is_refused.then(|| stack.refused_ns.unwrap_or(now_ns));
        }
        if !is_refused {
            let was_told = core::mem::take(&mut stack.is_told);
            if !was_told {
                return Ok(String::new());
            }
            let names = names(claimed);
            return Ok(format!(
                "nobody else drives {names} any more: the servo stack that was refused does now"
            ));
        }
        // A stack that has died is silent for a while before the joints are free for the one that was
        // started again; only one that goes on to send is another.
        let lives = stack.refused_ns.is_some_and(|since_ns| heard_ns > since_ns);
        if !lives || core::mem::replace(&mut stack.is_told, true) {
            return Err(String::new());
        }
        Err(format!(
            "a servo stack says that it drives {}, which another drives already: what it sends is not used",
            names(taken)
        ))
    }

    /// What is kept of the stack that has sent a record; `None` if there are too many.
    fn stack(&mut self, feedback: &Feedback, now_ns: u64) -> Option<&mut Stack> {
        let mut stacks = self.stacks.iter();
        let known = stacks.position(|stack| stack.last.boot_id == feedback.boot_id);
        let place = known.unwrap_or(self.stacks.len());
        if place == self.stacks.len() && place < STACKS {
            self.stacks.push(Stack {
                last: *feedback,
                heard_ns: now_ns,
                refused_ns: None,
                is_told: false,
                edges: [Edges::default(); JOINTS],
            });
        }
        self.stacks.get_mut(place)
    }

    /// Why a record cannot be used whoever sent it, if it cannot.
    fn unusable(&self, feedback: &Feedback, now_ns: u64) -> Option<String> {
        if let Err(error) = feedback.check() {
            return Some(error.to_string());
        }
        let claimed = feedback.joints & self.all;
        let mut positions = feedback.position.iter().enumerate();
        let far = positions.find(|(joint, p)| claimed & (1 << joint) != 0 && p.abs() > FARTHEST);
        if let Some((joint, position)) = far {
            return Some(format!(
                "the servo stack {:#x} has J{joint} at {position:e}, which is no position of a joint",
                feedback.boot_id
            ));
        }
        let ahead_ns = feedback.sample_ns.saturating_sub(now_ns);
        (ahead_ns > self.ahead_ns).then(|| {
            format!(
                "feedback of the servo stack {:#x} is of the future, by {} ms: it is not stamped \
                 with this host's CLOCK_MONOTONIC",
                feedback.boot_id,
                ahead_ns / 1_000_000
            )
        })
    }

    /// What is known of the joints.
    pub(super) fn joints(&self) -> Joints {
        let mut joints = Joints::NONE;
        let heard = self.stacks.iter().filter(|stack| !stack.is_refused());
        joints.played = heard
            .map(|stack| stack.last.setpoint_number)
            .min()
            .unwrap_or(0);
        for stack in self.stacks.iter().filter(|stack| !stack.is_refused()) {
            let said = &stack.last;
            let claimed = said.joints & self.all;
            joints.claimed |= claimed;
            joints.enabled |= said.enabled & claimed;
            joints.homed |= said.homed & claimed;
            joints.homing |= said.homing & claimed;
            joints.fault |= said.fault & claimed;
            joints.home_switch |= said.home_switch & claimed;
            joints.digital_in |= said.digital_in;
            joints.loss = joints.loss.or_else(|| LossTold::of(said));
            joints.spindle = SpindleFlags(joints.spindle.0 | said.spindle_flags);
            if said.spindle().contains(SpindleFlags::SPEED) {
                joints.spindle_v = said.spindle_v;
            }
            if said.spindle().contains(SpindleFlags::LOAD) {
                joints.spindle_load = said.spindle_load;
            }
            joints.limits |= (said.limit_low | said.limit_high) & claimed;
            for joint in (0..JOINTS).filter(|joint| claimed & (1 << joint) != 0) {
                joints.position[joint] = said.position[joint];
                joints.velocity[joint] = said.velocity[joint];
                joints.fault_code[joint] = said.fault_code[joint];
                joints.sample_ns[joint] = said.sample_ns;
                joints.boot_id[joint] = said.boot_id;
                joints.edges[joint] = stack.edges[joint];
            }
        }
        joints
    }

    /// Forgets the edges of these joints, one bit each.
    pub(super) fn forget_edges(&mut self, joints: u32) {
        for stack in &mut self.stacks {
            for (joint, edges) in stack.edges.iter_mut().enumerate() {
                if joints & (1 << joint) != 0 {
                    *edges = Edges::default();
                }
            }
        }
    }

    /// What the drive of a joint keeps of its index pulse, by what its stack says.
    pub(super) fn index_kept(&self, joint: usize) -> Kept {
        let Some(said) = self.driven_by(joint) else {
            return Kept::No;
        };
        let bit = 1 << joint;
        match said.index_position.get(joint) {
            Some(place) if said.index_kept & bit != 0 => Kept::At(*place),
            _ if said.index_armed & bit != 0 => Kept::Armed,
            _ => Kept::No,
        }
    }

    /// What the stack that drives a joint has said last.
    fn driven_by(&self, joint: usize) -> Option<&Feedback> {
        let mine = |stack: &&Stack| !stack.is_refused() && stack.last.joints & (1 << joint) != 0;
        Some(&self.stacks.iter().find(mine)?.last)
    }

    /// How often an input was latched by the stack that drives a joint, and where the joint was
    /// then; `None` if it latches no such input.
    pub(super) fn latched(&self, joint: usize, input: u32) -> Option<(u64, f64)> {
        let said = self.driven_by(joint)?;
        let is_asked = |latch: &&Latch| latch.input == input && latch.rising == 1;
        let latch = said.latch.iter().find(is_asked)?;
        // One that was never latched has no kind yet.
        Some((latch.count, *latch.position.get(joint)?))
    }
}
