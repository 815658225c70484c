//! The homing sequencer: the joints of the machine on their way home, group after group.
//!
//! A group that fails stops the others: what comes later may rely on it.

use super::search::{HomeSearch, SearchFailure, Seen, Step};
use crate::shared::config::homing::JointHoming;
use crate::shared::message::joints_order::{JointsOrder, Moved};
use glidepath_kinematics::JOINTS;

/// How long the real-time thread may take to begin, ns.
const BEGIN_NS: u64 = 100_000_000;
/// At the end of the way home, joints are given so long to come to rest, ns.
const PAUSE_NS: u64 = 100_000_000;

/// Two joints that move one axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Pair {
    pub(crate) joints: (usize, usize),
    /// By how much they may differ, mm or degrees.
    pub(crate) difference: f64,
}

/// What is known of the machine in a turn.
#[derive(Debug, Clone, Copy)]
pub(crate) struct HomingInputs<'a> {
    pub(crate) now_ns: u64,
    pub(crate) moved: Moved,
    pub(crate) seen: &'a [Seen; JOINTS],
}

/// The outcome of a turn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Outcome {
    /// Nothing yet.
    Pending,
    /// These joints are at home: what is to be added to their drives' counts.
    Home { joints: u32, offset: [f64; JOINTS] },
    /// A joint did not find its home.
    Failed { joint: usize, why: SearchFailure },
    /// The two joints of an axis went apart, by so much where so much is allowed.
    Apart {
        joint: usize,
        difference: f64,
        allowed: f64,
    },
}

#[derive(Debug, Clone, Copy)]
enum Task {
    Search(HomeSearch),
    /// The offset is known, the joint waits for the others of its group.
    Found(f64),
    /// It goes home.
    Goes(f64),
    /// It is there.
    There(f64),
}

/// A group under way.
#[derive(Debug, Clone)]
struct Group {
    tasks: [Option<Task>; JOINTS],
    /// All go home together.
    together: bool,
    /// Since when all are there.
    since_ns: Option<u64>,
}

/// What goes on.
#[derive(Debug, Clone)]
struct Job {
    /// The groups that are left, the next one last.
    left: Vec<u32>,
    group: Option<Group>,
    began_ns: u64,
    /// Whether the real-time thread was asked to begin: once, so that nothing begins late.
    has_asked: bool,
    /// Whether it has begun.
    has_begun: bool,
    began_at: [f64; JOINTS],
    /// The joints whose drives were told to keep their index pulse.
    index: u32,
    /// Nothing is done before.
    goes_on_ns: u64,
}

/// The homing sequencer.
#[derive(Debug)]
pub(crate) struct HomingSequencer {
    settings: [Option<JointHoming>; JOINTS],
    pairs: Vec<Pair>,
    job: Option<Job>,
    number: u64,
    /// The joints whose edges are to be forgotten before the next turn.
    forget: u32,
}

impl HomingSequencer {
    pub(crate) const fn new(settings: [Option<JointHoming>; JOINTS], pairs: Vec<Pair>) -> Self {
        Self {
            settings,
            pairs,
            job: None,
            number: 0,
            forget: 0,
        }
    }

    /// The joints that are homed in this way, one bit each.
    pub(crate) fn joints(&self) -> u32 {
        self.mask(|_| true)
    }

    /// Those of which something is true.
    pub(crate) fn mask(&self, is: impl Fn(&JointHoming) -> bool) -> u32 {
        let all = self.settings.iter().enumerate();
        all.filter(|(_, joint)| joint.as_ref().is_some_and(&is))
            .fold(0, |mask, (joint, _)| mask | 1 << joint)
    }

    /// Whether joints are on their way.
    pub(crate) const fn is_busy(&self) -> bool {
        self.job.is_some()
    }

    /// The joints whose limit switches do not count now.
    pub(crate) fn ignores_limits(&self) -> u32 {
        let under_way = self.under_way();
        self.mask(|joint| joint.ignores_limits) & under_way
    }

    fn under_way(&self) -> u32 {
        let group = self.job.as_ref().and_then(|job| job.group.as_ref());
        group.map_or(0, |group| {
            let tasks = group.tasks.iter().enumerate();
            tasks
                .filter(|(_, task)| task.is_some())
                .fold(0, |mask, (joint, _)| mask | 1 << joint)
        })
    }

    /// The joints whose edges are to be forgotten.
    pub(crate) const fn take_forgotten(&mut self) -> u32 {
        core::mem::replace(&mut self.forget, 0)
    }

    /// Begins with these joints, and those that go home together with one of them. Returns which.
    pub(crate) fn begin(&mut self, joints: u32, now_ns: u64) -> u32 {
        let mut groups: Vec<(u32, u32)> = Vec::new();
        let mut all = 0;
        for (joint, settings) in self.settings.iter().enumerate() {
            let Some(settings) = settings.filter(|_| joints & (1 << joint) != 0) else {
                continue;
            };
            let second = self.pairs.iter().filter(|pair| {
                let (one, other) = pair.joints;
                one == joint || other == joint
            });
            let second = second.fold(0, |mask, pair| {
                mask | 1 << pair.joints.0 | 1 << pair.joints.1
            });
            let partners = second
                | if settings.sequence < 0 {
                    self.mask(|other| other.sequence == settings.sequence)
                } else {
                    1 << joint
                };
            all |= partners;
            let rank = settings.sequence.unsigned_abs();
            match groups.iter_mut().find(|(known, _)| *known == rank) {
                Some((_, mask)) => *mask |= partners,
                None => groups.push((rank, partners)),
            }
        }
        groups.sort_by_key(|(rank, _)| core::cmp::Reverse(*rank));
        self.job = Some(Job {
            left: groups.into_iter().map(|(_, mask)| mask).collect(),
            group: None,
            began_ns: now_ns,
            has_asked: false,
            has_begun: false,
            began_at: [0.0; JOINTS],
            index: 0,
            goes_on_ns: 0,
        });
        all
    }

    /// Nobody looks for home any more.
    pub(crate) fn drop_job(&mut self) {
        self.job = None;
    }

    /// One turn: what is ordered, and what came of it.
    pub(crate) fn turn(&mut self, around: &HomingInputs<'_>) -> (Option<JointsOrder>, Outcome) {
        let Some(job) = &mut self.job else {
            return (None, Outcome::Pending);
        };
        let mut order = JointsOrder::none(self.number + 1);
        if !around.moved.is_active {
            // The motion ended from elsewhere, or does not begin.
            let is_late = around.now_ns > job.began_ns + BEGIN_NS;
            if job.has_begun || is_late {
                self.job = None;
                return (None, Outcome::Pending);
            }
            if core::mem::replace(&mut job.has_asked, true) {
                return (None, Outcome::Pending);
            }
            order.begins = true;
            self.number = order.number;
            return (Some(order), Outcome::Pending);
        }
        if !job.has_begun {
            job.has_begun = true;
            job.began_at = around.seen.map(|seen| seen.actual);
        }
        let mut seen = *around.seen;
        for (joint, seen) in seen.iter_mut().enumerate() {
            seen.rests =
                around.moved.number >= self.number && around.moved.rests & (1 << joint) != 0;
        }
        if let Some(apart) = apart(&self.pairs, job, around) {
            self.job = None;
            return (None, apart);
        }
        if around.now_ns < job.goes_on_ns {
            return (None, Outcome::Pending);
        }
        if job.group.is_none() {
            let Some(mask) = job.left.pop() else {
                order.ends = true;
                self.job = None;
                return (Some(order), Outcome::Pending);
            };
            job.group = Some(Group::new(mask, &self.settings));
        }
        let mut outcome = Outcome::Pending;
        if let Some(group) = &mut job.group {
            let held = group.held(&self.pairs, &seen);
            outcome = group.turn(
                (around.now_ns, &seen, held),
                &self.settings,
                &mut order,
                &mut self.forget,
            );
        }
        match outcome {
            Outcome::Pending => {}
            Outcome::Home { .. } => {
                job.group = None;
                // The servos take up the new position at rest.
                job.goes_on_ns = around.now_ns + PAUSE_NS;
            }
            Outcome::Failed { .. } | Outcome::Apart { .. } => self.job = None,
        }
        // What was asked for before holds until the next order.
        let asked = self.job.as_mut().map(|job| {
            let group = job.group.as_ref();
            order.index = group.map_or(0, Group::asks_index);
            core::mem::replace(&mut job.index, order.index)
        });
        if order.is_empty() && asked.is_none_or(|asked| asked == order.index) {
            return (None, outcome);
        }
        self.number = order.number;
        (Some(order), outcome)
    }
}

/// Whether the joints of a pair went apart since they set out.
fn apart(pairs: &[Pair], job: &Job, around: &HomingInputs<'_>) -> Option<Outcome> {
    let way = |joint: usize| {
        let now = around.seen.get(joint).map_or(0.0, |seen| seen.actual);
        now - job.began_at.get(joint).copied().unwrap_or(0.0)
    };
    pairs.iter().find_map(|pair| {
        let difference = (way(pair.joints.0) - way(pair.joints.1)).abs();
        (difference > pair.difference).then_some(Outcome::Apart {
            joint: pair.joints.1,
            difference,
            allowed: pair.difference,
        })
    })
}

impl Group {
    fn new(mask: u32, settings: &[Option<JointHoming>; JOINTS]) -> Self {
        let mut tasks = [None; JOINTS];
        let mut together = false;
        for (joint, (task, settings)) in tasks.iter_mut().zip(settings).enumerate() {
            if let Some(settings) = settings.as_ref().filter(|_| mask & (1 << joint) != 0) {
                *task = HomeSearch::new(settings).map(Task::Search);
                together |= settings.sequence < 0;
            }
        }
        Self {
            tasks,
            together,
            since_ns: None,
        }
    }

    /// The joints that do not set out yet for their index pulse, one bit each: two that move one axis set out together.
    fn held(&self, pairs: &[Pair], all_seen: &[Seen; JOINTS]) -> u32 {
        let waits = |joint: usize| {
            let (task, seen) = (self.tasks.get(joint), all_seen.get(joint));
            let (Some(Some(Task::Search(search))), Some(seen)) = (task, seen) else {
                return false;
            };
            search.waits_for_drive(seen)
        };
        let pairs = pairs.iter().map(|pair| pair.joints);
        let held = pairs.filter(|(one, other)| waits(*one) || waits(*other));
        held.fold(0, |mask, (one, other)| mask | 1 << one | 1 << other)
    }

    fn turn(
        &mut self,
        (now_ns, all_seen, held): (u64, &[Seen; JOINTS], u32),
        settings: &[Option<JointHoming>; JOINTS],
        order: &mut JointsOrder,
        forget: &mut u32,
    ) -> Outcome {
        let waits = self.together
            && self
                .tasks
                .iter()
                .any(|task| matches!(task, Some(Task::Search(_))));
        for (joint, (task, settings)) in self.tasks.iter_mut().zip(settings).enumerate() {
            let (Some(task), Some(settings)) = (task, settings) else {
                continue;
            };
            let Some(seen) = all_seen.get(joint) else {
                continue;
            };
            match task {
                Task::Search(search) => match search.step(seen, held & (1 << joint) == 0) {
                    Step::Wait => {}
                    Step::Stop => order.stop |= 1 << joint,
                    Step::Go { place, v } => {
                        go(order, joint, place, v);
                        *forget |= 1 << joint;
                    }
                    Step::Found { offset } => *task = Task::Found(offset),
                    Step::Failed(why) => return Outcome::Failed { joint, why },
                },
                Task::Found(offset) if !waits => {
                    let offset = *offset;
                    *task = if settings.absolute == Some(false) {
                        Task::There(offset)
                    } else {
                        go(order, joint, settings.home - offset, settings.final_v);
                        Task::Goes(offset)
                    };
                }
                Task::Goes(offset) if seen.rests => *task = Task::There(*offset),
                Task::Found(_) | Task::Goes(_) | Task::There(_) => {}
            }
        }
        self.end(now_ns)
    }

    /// The joints whose drives are to keep where their index pulse is, one bit each.
    fn asks_index(&self) -> u32 {
        let tasks = self.tasks.iter().enumerate();
        let asks = tasks
            .filter(|(_, task)| matches!(task, Some(Task::Search(search)) if search.asks_index()));
        asks.fold(0, |mask, (joint, _)| mask | 1 << joint)
    }

    /// Whether all are there, and have been for long enough.
    fn end(&mut self, now_ns: u64) -> Outcome {
        let (mut joints, mut offset) = (0, [0.0; JOINTS]);
        for (joint, (task, slot)) in self.tasks.iter().zip(&mut offset).enumerate() {
            match task {
                None => {}
                Some(Task::There(found)) => {
                    joints |= 1 << joint;
                    *slot = *found;
                }
                Some(_) => return Outcome::Pending,
            }
        }
        let since_ns = *self.since_ns.get_or_insert(now_ns);
        if now_ns < since_ns + PAUSE_NS {
            return Outcome::Pending;
        }
        Outcome::Home { joints, offset }
    }
}

fn go(order: &mut JointsOrder, joint: usize, place: f64, v: f64) {
    order.go |= 1 << joint;
    if let (Some(to), Some(most)) = (order.place.get_mut(joint), order.v.get_mut(joint)) {
        (*to, *most) = (place, v);
    }
}
