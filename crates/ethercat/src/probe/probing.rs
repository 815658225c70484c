//! Searches for a contact, as drives with touch probes see them: units that are armed, the edge in the
//! inputs, and the places that all drives have kept of it.

use super::plausible::{Span, samples_before};
use super::unit::{FALLING, ProbeInputs, RISING, Unit};
use crate::event::Event;
use crate::probe_trouble::ProbeTrouble;
use crate::settings::{DriveSettings, Settings};
use glidepath_geometry::AXES;
use glidepath_link::{Feedback, Latch, LatchKind, Setpoint};
use glidepath_program::Event as ProgramEvent;

/// How long drives may take to tell what they have kept, ns: those that are asked by their mailbox take
/// some tenths of a second.
const PATIENCE_NS: u64 = 2_000_000_000;

/// For how many samples behind an edge, and behind the beginning of a search, units are asked what they keep.
const STIRRED: u32 = 200;

/// A drive in one cycle.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Seen<'a> {
    pub(crate) settings: &'a DriveSettings,
    pub(crate) inputs: ProbeInputs,
    pub(crate) is_present: bool,
    /// How far the joint is from where the counts of its drive say, mm or degrees: by its encoder at a terminal.
    pub(crate) added: f64,
    /// Its last places, mm or degrees, in a ring, and which one is the newest.
    pub(crate) places: &'a [f64],
    pub(crate) newest: usize,
}

impl Seen<'_> {
    /// The place so many samples ago.
    fn place(&self, before: usize) -> f64 {
        let count = self.places.len().max(1);
        let nth = (self.newest + count - before % count) % count;
        self.places.get(nth).copied().unwrap_or(0.0)
    }

    /// Where the joint was at the edge that the unit keeps there.
    pub(super) fn latched(&self, nth: usize) -> f64 {
        self.settings.place(self.inputs.places[nth]) + self.added
    }

    /// What its unit keeps of an edge of the input.
    fn kept(&self, rises: bool) -> Option<f64> {
        let probe = self.settings.probe?;
        let (mask, nth) = if rises == probe.is_inverted {
            (FALLING, 1)
        } else {
            (RISING, 0)
        };
        let is_there = self.is_present && self.inputs.has(mask);
        is_there.then(|| self.latched(nth))
    }
}

/// An edge in the inputs, whose place the drives are to tell.
#[derive(Debug, Clone, Copy)]
struct Edge {
    rises: bool,
    /// When it was in the inputs, ns.
    sample_ns: u64,
    /// Samples since.
    samples: u32,
}

/// The touch probes of all drives.
#[derive(Debug)]
pub(crate) struct Probing {
    number: u8,
    units: Vec<Unit>,
    /// Where each joint was around the edge.
    spans: Vec<Span>,
    level: Option<bool>,
    /// Samples by which an edge can be older than the one beside it.
    before: usize,
    /// Samples since all are armed, and since one keeps something that nobody waits for.
    armed: usize,
    kept: usize,
    /// Samples for which units are asked although nobody waits: something may have come to them.
    stirred: u32,
    /// The epoch that looks for a contact.
    search: Option<u64>,
    edge: Option<Edge>,
    /// The last rising edge, and the last falling one.
    latches: [Latch; 2],
    told: Option<Event>,
}

impl Probing {
    /// What the drives of a machine do together; `None` if they have no touch probes. `most` is how many of
    /// its last places a drive remembers.
    pub(crate) fn new(settings: &Settings, most: usize) -> Option<Self> {
        let first = settings.drives.first()?.probe?;
        let latch = |rising| Latch {
            input: first.number.into(),
            rising,
            ..Latch::default()
        };
        Some(Self {
            number: first.number,
            units: vec![Unit::default(); settings.drives.len()],
            spans: vec![Span::default(); settings.drives.len()],
            level: None,
            before: samples_before(settings.bus.period_ns, most.saturating_sub(1)),
            armed: 0,
            kept: 0,
            stirred: 0,
            search: None,
            edge: None,
            latches: [latch(1), latch(0)],
            told: None,
        })
    }

    /// The bus has come up: drives begin anew.
    pub(crate) fn begin(&mut self) {
        self.clear();
        (self.level, self.edge) = (None, None);
    }

    fn clear(&mut self) {
        self.units.iter_mut().for_each(Unit::clear);
        (self.armed, self.kept) = (0, 0);
    }

    /// A setpoint has come, which is played later.
    pub(crate) fn note(&mut self, setpoint: &Setpoint) {
        if matches!(setpoint.event(), Ok(Some(ProgramEvent::Probe { .. }))) {
            (self.search, self.stirred) = (Some(setpoint.epoch), STIRRED);
        } else if self.search != Some(setpoint.epoch) {
            self.search = None;
        }
    }

    /// Whether the unit of a drive is to be on.
    pub(crate) fn is_on(&self, nth: usize) -> bool {
        self.units.get(nth).is_some_and(|unit| unit.is_on())
    }

    /// Whether what it keeps is to be asked.
    pub(crate) fn asks(&self, nth: usize) -> bool {
        let is_armed = self.units.get(nth).is_some_and(|unit| unit.is_armed());
        !is_armed || self.edge.is_some() || self.stirred > 0
    }

    /// What there is to tell.
    pub(crate) const fn take_event(&mut self) -> Option<Event> {
        self.told.take()
    }

    /// A sample of all drives, with the inputs beside it. Adds what was latched.
    pub(crate) fn sample<'a>(
        &mut self,
        feedback: &mut Feedback,
        drives: impl Iterator<Item = Seen<'a>> + Clone,
    ) {
        let level = feedback.digital_in >> (self.number & 63) & 1 == 1;
        let before = self.level.replace(level);
        self.stirred = if before == Some(level) {
            self.stirred.saturating_sub(1)
        } else {
            STIRRED
        };
        if let Some(edge) = self.edge {
            self.wait_for(edge, feedback.sample_ns, drives);
        } else if before.is_some_and(|before| before != level) && self.search.is_some() {
            self.begin_edge(level, feedback.sample_ns, drives);
        } else {
            self.keep_armed(drives);
        }
        for (place, latch) in feedback.latch.iter_mut().zip(&self.latches) {
            *place = *latch;
        }
        if let Some(edge) = self.edge {
            let nth = usize::from(!edge.rises);
            feedback.latch[nth].kind = LatchKind::Awaited.code();
        }
    }

    /// Nothing is looked for: units that keep an edge are to be free for the next one.
    fn keep_armed<'a>(&mut self, drives: impl Iterator<Item = Seen<'a>>) {
        let (mut are_armed, mut keep) = (true, false);
        for (unit, drive) in self.units.iter_mut().zip(drives) {
            unit.hear(&drive.inputs);
            are_armed &= unit.is_armed() && drive.is_present;
            keep |= unit.is_armed() && drive.inputs.has(RISING | FALLING);
        }
        self.armed = if are_armed { self.armed + 1 } else { 0 };
        self.kept = if keep { self.kept + 1 } else { 0 };
        // The input may show what they keep later than they do.
        if self.kept > self.before + 2 {
            self.clear();
        }
    }

    /// The input has changed in a search.
    fn begin_edge<'a>(
        &mut self,
        rises: bool,
        sample_ns: u64,
        drives: impl Iterator<Item = Seen<'a>>,
    ) {
        // One that can be older than the arming may not be the one that they keep.
        if self.armed <= self.before {
            self.told = Some(Event::Probe(ProbeTrouble::Unarmed));
            self.clear();
            return;
        }
        for (span, drive) in self.spans.iter_mut().zip(drives) {
            *span = Span::new(drive.place(self.before));
            (0..self.before)
                .rev()
                .for_each(|nth| span.add(drive.place(nth)));
        }
        self.edge = Some(Edge {
            rises,
            sample_ns,
            samples: 0,
        });
    }

    /// Waits for what all drives have kept, and judges it.
    fn wait_for<'a>(
        &mut self,
        edge: Edge,
        now_ns: u64,
        drives: impl Iterator<Item = Seen<'a>> + Clone,
    ) {
        if edge.samples == 0 {
            for (span, drive) in self.spans.iter_mut().zip(drives.clone()) {
                span.add(drive.place(0));
            }
        }
        self.edge = Some(Edge {
            samples: edge.samples.saturating_add(1),
            ..edge
        });
        let lacks = drives
            .clone()
            .find(|drive| drive.kept(edge.rises).is_none());
        if let Some(drive) = lacks {
            if now_ns.saturating_sub(edge.sample_ns) > PATIENCE_NS {
                self.end_edge(Some(Event::Probe(ProbeTrouble::Missed(
                    drive.settings.joint,
                ))));
            }
            return;
        }
        let mut position = [0.0; AXES];
        for (span, drive) in self.spans.iter().zip(drives) {
            let joint = drive.settings.joint;
            let place = drive.kept(edge.rises).unwrap_or(f64::NAN);
            if !span.contains(place) {
                let trouble = ProbeTrouble::Elsewhere(joint, place, span.ends());
                self.end_edge(Some(Event::Probe(trouble)));
                return;
            }
            position[joint.min(AXES - 1)] = place;
        }
        let latch = &mut self.latches[usize::from(!edge.rises)];
        latch.count += 1;
        (latch.latch_ns, latch.position) = (edge.sample_ns, position);
        latch.kind = LatchKind::Drive.code();
        self.end_edge(None);
    }

    /// Nobody waits for it any more, with what there is to tell.
    fn end_edge(&mut self, told: Option<Event>) {
        (self.edge, self.told) = (None, told);
        self.clear();
    }
}
