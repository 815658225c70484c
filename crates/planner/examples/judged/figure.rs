//! What the auditor says of a motion beside its limits and its tolerance: whether it stays inside the travel,
//! whether straight is straight and smooth, whether events are where they belong, and what the tolerance was
//! used for.

#![allow(dead_code, reason = "each harness uses a part of it")]

use glidepath_audit::AuditReport;
use glidepath_audit::shape::{Border, Met, ShapeReport};
use glidepath_geometry::Axis;
use glidepath_program::{Item, ItemKind, tolerance_norm};
use serde_json::{Value, json};

/// What an event may be off beyond that, mm.
const BESIDE_MM: f64 = 1e-3;

/// What is said of one motion.
#[derive(Debug, Clone)]
pub(crate) struct Figure {
    shape: ShapeReport,
    beyond_travel_mm: f64,
    /// Motion that the program does not ask for, and the first of it.
    tremors: u64,
    first_tremor: Option<String>,
    events: Events,
}

/// The events that do not stop a motion.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Events {
    programmed: u64,
    happened: u64,
    /// How far off their places they happened at most, mm, and the line.
    off_mm: f64,
    off_line: u32,
    /// How far off the motion may be at all, and what lies between it and the chord of a period, which the auditor
    /// takes for the way.
    allowed_mm: f64,
}

/// Events of a program that do not stop it, from its first move on.
fn programmed(items: &[Item]) -> u64 {
    let moves = |item: &&Item| !matches!(item.kind, ItemKind::Move { .. });
    let behind = items.iter().skip_while(moves);
    let events = behind.filter(|item| match &item.kind {
        ItemKind::Event(event) => !event.is_at_rest(),
        ItemKind::Move { .. } | ItemKind::Dwell(_) => false,
    });
    events.count() as u64
}

impl Figure {
    /// Of a motion that items were planned as.
    pub(crate) fn new(
        items: &[Item],
        period_t: f64,
        report: &AuditReport,
        shape: ShapeReport,
    ) -> Self {
        let most_a = tolerance_norm(&report.max_acceleration, 1.0);
        let chord_mm = most_a * period_t * period_t / 8.0;
        Self {
            shape,
            beyond_travel_mm: report.max_beyond_travel_mm,
            tremors: report.tremor_count,
            first_tremor: report.tremors.first().map(ToString::to_string),
            events: Events {
                programmed: programmed(items),
                happened: report.events,
                off_mm: report.max_event_off_mm,
                off_line: report.max_event_off_line,
                allowed_mm: report.tolerance_mm + chord_mm + BESIDE_MM,
            },
        }
    }

    /// Rules that the motion breaks, in words: travel, straightness, smoothness, places of events.
    pub(crate) fn broken(&self) -> Vec<String> {
        let mut broken = Vec::new();
        if self.beyond_travel_mm > 0.0 {
            let beyond_um = 1e3 * self.beyond_travel_mm;
            broken.push(format!("{beyond_um:.3} µm beyond the travel"));
        }
        if self.shape.beside_count > 0 {
            let mut findings = self.shape.findings.iter().flatten();
            let first = findings.find(|finding| finding.border == Border::Straight);
            let first = first.map_or_else(String::new, |finding| format!(", {finding}"));
            let count = self.shape.beside_count;
            broken.push(format!("{count} straight moves not straight{first}"));
        }
        if let Some(first) = &self.first_tremor {
            broken.push(format!("{} tremors, {first}", self.tremors));
        }
        broken.extend(self.events.broken());
        broken
    }

    /// Places where the motion is on the outer side: beyond a stop of an axis or outside of a corner.
    pub(crate) const fn outer_count(&self) -> u64 {
        self.shape.finding_count - self.shape.beside_count
    }

    /// The first of them.
    pub(crate) fn first_outer(&self) -> Option<String> {
        let mut findings = self.shape.findings.iter().flatten();
        let first = findings.find(|finding| finding.border != Border::Straight);
        first.map(ToString::to_string)
    }

    /// How far Z is below its depth, any axis beyond what is asked of it, the motion outside of a corner and
    /// beside a straight move, at most, µm.
    pub(crate) fn distances_um(&self) -> [f64; 4] {
        let most = |sides: &[Met]| {
            sides
                .iter()
                .fold(0.0, |most: f64, met| most.max(met.distance_mm))
        };
        let shape = &self.shape;
        let overshoot_mm = most(&shape.below).max(most(&shape.above));
        let depth_mm = shape.below[Axis::Z.index()].distance_mm;
        [
            depth_mm,
            overshoot_mm,
            shape.outside.distance_mm,
            shape.beside.distance_mm,
        ]
        .map(|mm| 1e3 * mm)
    }

    /// Reversals of all axes, in the motion and in the program.
    pub(crate) fn reversals(&self) -> [u64; 2] {
        [&self.shape.reversals, &self.shape.programmed_reversals].map(|of| of.iter().sum())
    }

    /// Events and how far the worst is off its place, µm.
    pub(crate) fn events(&self) -> (u64, f64) {
        (self.events.programmed, 1e3 * self.events.off_mm)
    }

    /// Straight moves that were judged.
    pub(crate) const fn straight_moves(&self) -> u64 {
        self.shape.straight_moves
    }

    /// Everything, for a program that reads it.
    pub(crate) fn json(&self) -> Value {
        let [depth_um, overshoot_um, outside_um, beside_um] = self.distances_um();
        let [reversals, programmed_reversals] = self.reversals();
        json!({
            "broken": self.broken(),
            "outer_findings": self.outer_count(),
            "first_outer": self.first_outer(),
            "below_depth_um": depth_um,
            "overshoot_um": overshoot_um,
            "outside_um": outside_um,
            "beside_um": beside_um,
            "reversals": reversals,
            "programmed_reversals": programmed_reversals,
            "straight_moves": self.straight_moves(),
            "events": self.events.programmed,
            "event_off_um": 1e3 * self.events.off_mm,
        })
    }
}

impl Events {
    fn broken(&self) -> Vec<String> {
        let mut broken = Vec::new();
        if self.happened != self.programmed {
            broken.push(format!(
                "{} of {} events happened",
                self.happened, self.programmed
            ));
        }
        // All that the motion may be off the path is in it, too.
        if self.off_mm > self.allowed_mm {
            broken.push(format!(
                "an event {:.4} mm off its place, line {}",
                self.off_mm, self.off_line
            ));
        }
        broken
    }
}

/// The figures of several motions.
#[derive(Debug, Default, Clone)]
pub(crate) struct Together {
    /// Motions that break a rule.
    pub(crate) broken: u64,
    /// Motions with something on the outer side, and such places.
    outer: [u64; 2],
    distances_um: [f64; 4],
    reversals: [u64; 2],
    events: u64,
    event_off_um: f64,
    straight_moves: u64,
}

impl Together {
    /// One motion more.
    pub(crate) fn add(&mut self, figure: &Figure) {
        self.broken += u64::from(!figure.broken().is_empty());
        let outer = figure.outer_count();
        self.outer[0] += u64::from(outer > 0);
        self.outer[1] += outer;
        for (most, um) in self.distances_um.iter_mut().zip(figure.distances_um()) {
            *most = most.max(um);
        }
        for (sum, count) in self.reversals.iter_mut().zip(figure.reversals()) {
            *sum += count;
        }
        let (events, off_um) = figure.events();
        self.events += events;
        self.event_off_um = self.event_off_um.max(off_um);
        self.straight_moves += figure.straight_moves();
    }

    /// All of another.
    pub(crate) fn join(&mut self, other: &Self) {
        self.broken += other.broken;
        self.events += other.events;
        self.straight_moves += other.straight_moves;
        self.event_off_um = self.event_off_um.max(other.event_off_um);
        for (most, um) in self.distances_um.iter_mut().zip(other.distances_um) {
            *most = most.max(um);
        }
        for (sums, counts) in [
            (&mut self.outer, other.outer),
            (&mut self.reversals, other.reversals),
        ] {
            for (sum, count) in sums.iter_mut().zip(counts) {
                *sum += count;
            }
        }
    }

    /// All of them, in one line.
    pub(crate) fn line(&self, name: &str) -> String {
        let [depth, overshoot, outside, beside] = self.distances_um;
        let [reversals, programmed] = self.reversals;
        format!(
            "{name}: rules broken by {}; {} straight moves, {beside:.3} µm beside at most; {} events, {:.3} µm off at \
             most; on the outer side {} places of {} programs; below depth {depth:.3}, overshoot {overshoot:.3}, \
             outside {outside:.3} µm; reversals {reversals} of {programmed} programmed ({:.3})",
            self.broken,
            self.straight_moves,
            self.events,
            self.event_off_um,
            self.outer[1],
            self.outer[0],
            ratio(reversals, programmed)
        )
    }
}

#[allow(clippy::cast_precision_loss, reason = "counts")]
fn ratio(reversals: u64, programmed: u64) -> f64 {
    reversals as f64 / programmed.max(1) as f64
}
