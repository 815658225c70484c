//! The probe watch: where the axes are when a probe makes contact.
//!
//! The real-time thread says in a setpoint that a search begins, and stops when it is told of the
//! contact. Where that was is kept here, from the records of the drives themselves: what was
//! latched by hardware if there is such, else the middle between the samples before and after, so
//! that it is off by half of the way between them at most. Hardware may tell its place later than the
//! contact: the end of the epoch is told when it is known. What follows the first contact, bounces
//! above all, changes nothing.

use super::joint_ownership::Joints;
use crate::shared::config::feedback::ProbeInput;
use crate::shared::message::TickReport;
use glidepath_kinematics::{JOINTS, JointVector};
use glidepath_link::{ContactKind, EndOfEpoch, Feedback, LatchKind};
use glidepath_program::Event;

/// The contact that a search has found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Contact {
    pub(crate) kind: ContactKind,
    /// Where the joints were, as the drives count.
    pub(crate) joints: JointVector,
}

#[derive(Debug, Clone, Copy)]
struct ContactSearch {
    epoch: u64,
    release: bool,
    /// When it began, ns.
    since_ns: u64,
    /// The sample before the contact.
    before: Option<[f64; JOINTS]>,
    found: Option<Contact>,
    /// Hardware is to tell where that was.
    awaits_latch: bool,
}

/// What hardware tells of the edge that is looked for.
enum Latched {
    /// It has none, or not of that edge.
    No,
    /// It will tell.
    Awaited,
    At(JointVector),
}

/// Looks at the probe.
#[derive(Debug)]
pub(super) struct ProbeWatch {
    input: Option<ProbeInput>,
    search: Option<ContactSearch>,
    is_open: bool,
    guard: Guard,
}

/// How long a probe has to be free before a contact is one: behind a search it bounces.
const FREE_NS: u64 = 100_000_000;

/// What is looked for outside of searches.
#[derive(Debug, Default)]
struct Guard {
    /// Since when the probe is free.
    free_since_ns: Option<u64>,
    /// Something moves.
    moves: bool,
    /// It was touched, and nobody was told so far.
    is_touched: bool,
}

impl ProbeWatch {
    pub(super) fn new(input: Option<ProbeInput>) -> Self {
        Self {
            input,
            search: None,
            is_open: false,
            guard: Guard::default(),
        }
    }

    /// Takes note of a setpoint: it may begin a search, or belong to an epoch after it.
    pub(super) fn note(&mut self, report: &TickReport) {
        let setpoint = &report.setpoint;
        self.guard.moves = setpoint.velocity.iter().any(|v| v.abs() > 0.0);
        self.is_open = report.end_of_epoch == EndOfEpoch::Open;
        if let Ok(Some(Event::Probe { release })) = setpoint.event()
            && self.is_open
        {
            self.search = Some(ContactSearch {
                epoch: setpoint.epoch,
                release,
                since_ns: setpoint.scheduled_ns,
                before: None,
                found: None,
                awaits_latch: false,
            });
        } else if self
            .search
            .is_some_and(|search| search.epoch != setpoint.epoch)
        {
            self.search = None;
        }
    }

    /// Looks whether there is a contact that nobody looks for.
    pub(super) fn watch_out(&mut self, sample_ns: u64, joints: &Joints) {
        let Some(input) = self.input.filter(|input| input.protects) else {
            return;
        };
        let guard = &mut self.guard;
        if !touches(input, joints) {
            guard.free_since_ns.get_or_insert(sample_ns);
        } else if let Some(since_ns) = guard.free_since_ns.take() {
            let is_news = sample_ns.saturating_sub(since_ns) >= FREE_NS;
            guard.is_touched |= is_news && guard.moves && self.search.is_none();
        }
    }

    /// Whether something was touched that nobody looked for, since this was asked last.
    pub(super) const fn take_touched(&mut self) -> bool {
        core::mem::replace(&mut self.guard.is_touched, false)
    }

    /// Whether there is anything to look for.
    pub(super) fn is_searching(&self) -> bool {
        let is_open = |search: ContactSearch| search.found.is_none() && self.is_open;
        let looks = |search: ContactSearch| is_open(search) || search.awaits_latch;
        self.input.is_some() && self.search.is_some_and(looks)
    }

    /// Looks at what a stack sends, after it was taken into the `joints`.
    pub(super) fn look(&mut self, feedback: &Feedback, joints: &Joints) {
        let (Some(input), Some(search)) = (self.input, &mut self.search) else {
            return;
        };
        if let Some(found) = &mut search.found {
            let latched = latched(feedback, input, (search.release, search.since_ns), joints);
            search.awaits_latch = matches!(latched, Latched::Awaited);
            if let Latched::At(place) = latched {
                found.joints = place;
            }
            return;
        }
        if touches(input, joints) == search.release {
            search.before = Some(joints.position);
            return;
        }
        let middle = |before: [f64; JOINTS]| {
            let places = before.iter().zip(&joints.position);
            JointVector::from_iterator(places.map(|(from, to)| from.midpoint(*to)))
        };
        let sampled = search
            .before
            .map_or_else(|| JointVector::from(joints.position), middle);
        let latched = latched(feedback, input, (search.release, search.since_ns), joints);
        search.awaits_latch = matches!(latched, Latched::Awaited);
        search.found = Some(Contact {
            kind: if search.before.is_some() {
                ContactKind::Made
            } else {
                ContactKind::AlreadySo
            },
            joints: match latched {
                Latched::At(place) => place,
                Latched::No | Latched::Awaited => sampled,
            },
        });
    }

    /// The epoch whose end is not to be told yet, because where its contact was is not known.
    pub(super) fn keeps_open(&self) -> Option<u64> {
        let search = self.search.filter(|search| search.awaits_latch);
        search.map(|search| search.epoch)
    }

    /// What the search of this or the last epoch has found.
    pub(super) fn found(&self) -> Option<Contact> {
        self.search?.found
    }

    /// The epoch in which a search has found something, 0 if none has.
    pub(super) fn found_in(&self) -> u64 {
        let search = self.search.filter(|search| search.found.is_some());
        search.map_or(0, |search| search.epoch)
    }
}

fn touches(input: ProbeInput, joints: &Joints) -> bool {
    (joints.digital_in >> (input.number & 63) & 1 == 1) == input.high
}

/// What the hardware of a stack with all joints has latched since the search began.
fn latched(
    feedback: &Feedback,
    input: ProbeInput,
    (release, since_ns): (bool, u64),
    joints: &Joints,
) -> Latched {
    let is_it = |latch: &&glidepath_link::Latch| {
        let rising = (latch.rising == 1) == (input.high != release);
        latch.input == u32::from(input.number) && rising
    };
    let has_all = joints.claimed & !feedback.joints == 0;
    let mut latches = feedback.latch.iter().filter(is_it).filter(|_| has_all);
    let told = latches.find_map(|latch| {
        if latch.kind == LatchKind::Awaited.code() {
            return Some(Latched::Awaited);
        }
        let is_new = latch.count > 0 && latch.latch_ns >= since_ns;
        is_new.then(|| Latched::At(JointVector::from(latch.position)))
    });
    told.unwrap_or(Latched::No)
}
