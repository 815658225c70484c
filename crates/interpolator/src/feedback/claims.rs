//! Which servo stack drives which joints, and what they say of them.
//!
//! A joint belongs to the stack that claimed it first, until that one has been silent for so long
//! that the drives are off anyway. What another says of it meanwhile is refused, as a whole: a stack
//! that takes itself to drive somebody else's joint is set up wrongly.

use glidepath_kinematics::JOINTS;
use glidepath_link::{Feedback, Record as _};

/// What the stacks say of the joints together.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Joints {
    /// The joints that a stack has claimed, one bit each, as all that follow.
    pub(super) claimed: u32,
    pub(super) enabled: u32,
    pub(super) homed: u32,
    pub(super) homing: u32,
    pub(super) fault: u32,
    pub(super) limits: u32,
    /// As the drives count.
    pub(super) position: [f64; JOINTS],
    pub(super) velocity: [f64; JOINTS],
    pub(super) sample_ns: [u64; JOINTS],
    pub(super) fault_code: [u32; JOINTS],
}

impl Joints {
    const NONE: Self = Self {
        claimed: 0,
        enabled: 0,
        homed: 0,
        homing: 0,
        fault: 0,
        limits: 0,
        position: [0.0; JOINTS],
        velocity: [0.0; JOINTS],
        sample_ns: [0; JOINTS],
        fault_code: [0; JOINTS],
    };
}

#[derive(Debug)]
struct Stack {
    last: Feedback,
    heard_ns: u64,
    /// Whether it was told that it claims what is not its own.
    is_refused: bool,
}

/// The stacks that are heard.
#[derive(Debug)]
pub(super) struct Claims {
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

/// Stacks that are kept: one for each joint, and as many that are refused.
const STACKS: usize = 2 * JOINTS;

impl Claims {
    pub(super) const fn new(all: u32, lasts_ns: u64, ahead_ns: u64) -> Self {
        Self {
            stacks: Vec::new(),
            all,
            lasts_ns,
            ahead_ns,
            has_told: false,
        }
    }

    /// Takes what a stack sends.
    ///
    /// # Errors
    /// Why it is not used, for the log; an empty text if that was said before.
    pub(super) fn take(&mut self, feedback: &Feedback, now_ns: u64) -> Result<(), String> {
        if let Some(why) = self.unusable(feedback, now_ns) {
            // Once: such records come a thousand times a second.
            let is_new = !core::mem::replace(&mut self.has_told, true);
            return Err(if is_new { why } else { String::new() });
        }
        let lasts_ns = self.lasts_ns;
        self.stacks
            .retain(|stack| now_ns.saturating_sub(stack.heard_ns) <= lasts_ns);
        let claimed = feedback.joints & self.all;
        let others = self
            .stacks
            .iter()
            .filter(|stack| stack.last.boot_id != feedback.boot_id && !stack.is_refused);
        let taken = others.fold(0, |all, stack| all | stack.last.joints);
        let is_refused = claimed & taken != 0;
        let known = self
            .stacks
            .iter()
            .position(|stack| stack.last.boot_id == feedback.boot_id);
        let was_refused = known
            .and_then(|index| self.stacks.get(index))
            .is_some_and(|stack| stack.is_refused);
        if let Some(stack) = known.and_then(|index| self.stacks.get_mut(index)) {
            // Records overtake each other nowhere; an older one is a stack that is confused.
            if feedback.sample_ns >= stack.last.sample_ns {
                stack.last = *feedback;
                stack.heard_ns = now_ns;
                stack.is_refused = is_refused;
            }
        } else if self.stacks.len() < STACKS {
            self.stacks.push(Stack {
                last: *feedback,
                heard_ns: now_ns,
                is_refused,
            });
        }
        match (is_refused, was_refused) {
            (false, _) => Ok(()),
            (true, true) => Err(String::new()),
            (true, false) => Err(format!(
                "the servo stack {:#x} says that it drives joints {:#x}, which another drives \
                 already: what it sends is not used",
                feedback.boot_id,
                claimed & taken
            )),
        }
    }

    /// Why a record cannot be used whoever sent it, if it cannot.
    fn unusable(&self, feedback: &Feedback, now_ns: u64) -> Option<String> {
        if let Err(error) = feedback.check() {
            return Some(error.to_string());
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
        for stack in self.stacks.iter().filter(|stack| !stack.is_refused) {
            let said = &stack.last;
            let claimed = said.joints & self.all;
            joints.claimed |= claimed;
            joints.enabled |= said.enabled & claimed;
            joints.homed |= said.homed & claimed;
            joints.homing |= said.homing & claimed;
            joints.fault |= said.fault & claimed;
            joints.limits |= (said.limit_low | said.limit_high) & claimed;
            for joint in (0..JOINTS).filter(|joint| claimed & (1 << joint) != 0) {
                joints.position[joint] = said.position[joint];
                joints.velocity[joint] = said.velocity[joint];
                joints.fault_code[joint] = said.fault_code[joint];
                joints.sample_ns[joint] = said.sample_ns;
            }
        }
        joints
    }
}
