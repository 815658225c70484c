//! The totals of a program: counts and sums over its items.

use glidepath_geometry::{AxisVector, LINEAR_XYZ, Line, Segment, UVW};
use glidepath_program::{Item, ItemKind, Rate};

use crate::summary::extent::enclose;

/// Counts and sums over everything read so far.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Totals {
    /// Lines read, the empty ones included.
    pub lines: u32,
    /// Straight feed moves (G1), without those of zero length.
    pub straight_feeds: u32,
    /// Arcs (G2, G3).
    pub arcs: u32,
    /// Feed moves along pieces of other curves.
    pub curves: u32,
    /// Rapid moves (G0, G28, G30), without those of zero length.
    pub rapids: u32,
    /// Feed moves that go nowhere. They are left out of the motion.
    pub zero_length_feeds: u32,
    /// Rapid moves that go nowhere. They are left out of the motion.
    pub zero_length_rapids: u32,
    /// Dwells (G4).
    pub dwells: u32,
    /// Events.
    pub events: u32,
    /// Path of the feed moves with linear axes, mm.
    pub feed_length_mm: f64,
    /// Path of the rapid moves with linear axes, mm.
    pub rapid_length_mm: f64,
    /// Path of the feed moves of rotary axes alone, degrees.
    pub feed_rotary_deg: f64,
    /// Path of the rapid moves of rotary axes alone, degrees.
    pub rapid_rotary_deg: f64,
    /// Time of the feed moves at their feedrate, as if there were no acceleration, s.
    pub feed_time_s: f64,
    /// Time of the dwells, s.
    pub dwell_s: f64,
    /// Smallest and largest machine coordinates of all moves, from the start of the first; `None`
    /// without moves.
    pub bounding_box: Option<(AxisVector, AxisVector)>,
}

impl Totals {
    /// Adds an item.
    pub fn add(&mut self, item: &Item) {
        match &item.kind {
            ItemKind::Move { segment, rate, .. } => self.add_move(segment, *rate),
            ItemKind::Dwell(seconds) => {
                // One without a time is a rest between two moves, and no dwell.
                self.dwells += u32::from(*seconds > 0.0);
                self.dwell_s += seconds;
            }
            ItemKind::Event(_) => self.events += 1,
        }
    }

    /// Takes a segment into the bounding box.
    fn enclose(&mut self, segment: &Segment) {
        match &mut self.bounding_box {
            Some((low, high)) => enclose(segment, low, high),
            None => self.bounding_box = Some(segment.bounding_box()),
        }
    }

    fn add_move(&mut self, segment: &Segment, rate: Rate) {
        let length = segment.length();
        // An arc whose radius drifts is a little longer than its feed length, which leaves that
        // out.
        let path = match segment {
            Segment::Arc(arc) => length.hypot(arc.end_radius() - arc.start_radius()),
            _ => length,
        };
        let linear = match segment {
            Segment::Line(Line { start, end }) => LINEAR_XYZ
                .chain(UVW)
                .any(|axis| end[axis] - start[axis] != 0.0),
            Segment::Arc(_) | Segment::Curve(_) => true,
        };
        self.enclose(segment);
        match rate.feed_v() {
            None => {
                self.rapids += 1;
                *(if linear {
                    &mut self.rapid_length_mm
                } else {
                    &mut self.rapid_rotary_deg
                }) += path;
            }
            Some(feed_v) => {
                *(match segment {
                    Segment::Line(_) => &mut self.straight_feeds,
                    Segment::Arc(_) => &mut self.arcs,
                    Segment::Curve(_) => &mut self.curves,
                }) += 1;
                *(if linear {
                    &mut self.feed_length_mm
                } else {
                    &mut self.feed_rotary_deg
                }) += path;
                self.feed_time_s += length / feed_v;
            }
        }
    }
}
