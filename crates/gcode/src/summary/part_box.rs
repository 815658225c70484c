//! Where the feed moves of a program go, in the coordinates of the part.

use glidepath_geometry::{AxisVector, Segment};
use glidepath_program::{Item, ItemKind};

use crate::execute::interpreter::Interpreter;
use crate::execute::motion::tip_map::TipMap;
use crate::execute::state::offsets::Offsets;
use crate::execute::state::shared::Shared;
use crate::summary::extent::enclose;

/// Most pieces of a curve whose ends are looked at where the axes of the program are not those of the machine.
const PIECES: u32 = 512;

/// Where the feed moves in one coordinate system go, in its coordinates as the program writes them: with the
/// lengths of tools, G92 and whatever else is in force.
#[derive(Debug, Clone, PartialEq)]
pub struct PartBox {
    /// The name of the coordinate system, as G54.
    pub system: String,
    /// The smallest coordinates, mm or degrees.
    pub low: AxisVector,
    /// The largest.
    pub high: AxisVector,
}

/// The boxes of the coordinate systems in which a program has cut, in the order of their first use.
#[derive(Debug, Clone, Default)]
pub(crate) struct PartBoxes {
    boxes: Vec<PartBox>,
    /// The moves that came last, as long as nothing changes.
    run: Option<Run>,
}

/// Moves one after the other with the same offsets, where the axes of the program are those of the machine.
#[derive(Debug, Clone)]
struct Run {
    offsets: Shared<Offsets>,
    /// Where they go, machine coordinates.
    low: AxisVector,
    high: AxisVector,
}

impl PartBoxes {
    /// Adds an item, with what is in force for it.
    #[inline]
    pub(crate) fn add(&mut self, interpreter: &Interpreter, item: &Item) {
        let ItemKind::Move { segment, rate, .. } = &item.kind else {
            return;
        };
        if rate.is_rapid() {
            return;
        }
        let offsets = &interpreter.state.offsets;
        let map = interpreter.tip_map();
        match &mut self.run {
            Some(run) if map.is_none() && run.offsets.is_same(offsets) => {
                enclose(segment, &mut run.low, &mut run.high);
            }
            _ => self.add_other(offsets, map.as_ref(), segment),
        }
    }

    /// Adds a move with other offsets than the one before, or one of turned axes.
    fn add_other(&mut self, offsets: &Shared<Offsets>, map: Option<&TipMap>, segment: &Segment) {
        self.end_run();
        if map.is_none() && !offsets.is_turned() {
            let (low, high) = segment.bounding_box();
            let offsets = offsets.clone();
            self.run = Some(Run { offsets, low, high });
            return;
        }
        let place = |axes: &AxisVector| {
            let place = map.map_or(*axes, |map| map.place(axes));
            offsets.to_program(place)
        };
        let length = segment.length();
        // How much larger the coordinates of the part are than those of the machine.
        let stretch = 1.0 / offsets.frame.least_scale();
        let pieces = match segment {
            Segment::Line(_) => 1,
            Segment::Arc(arc) => pieces_of(length * stretch, 1.0 / (arc.end_radius() * stretch)),
            Segment::Curve(curve) => {
                let bends = curve.bends.iter().map(|bend| bend.norm());
                pieces_of(length * stretch, bends.fold(0.0, f64::max) / stretch)
            }
        };
        let (start, end) = (place(&segment.start()), place(&segment.end()));
        let (mut low, mut high) = (start.inf(&end), start.sup(&end));
        let segment = segment.prepared();
        for piece in 1..pieces {
            let s = length * f64::from(piece) / f64::from(pieces);
            let at = place(&segment.position(s));
            (low, high) = (low.inf(&at), high.sup(&at));
        }
        self.grow(offsets, low, high);
    }

    /// Takes the run into the box of its coordinate system.
    fn end_run(&mut self) {
        if let Some(Run { offsets, low, high }) = self.run.take() {
            self.grow(&offsets, offsets.to_program(low), offsets.to_program(high));
        }
    }

    fn grow(&mut self, offsets: &Offsets, low: AxisVector, high: AxisVector) {
        let system = offsets.system_name();
        match self.boxes.iter_mut().find(|known| known.system == system) {
            Some(grown) => (grown.low, grown.high) = (grown.low.inf(&low), grown.high.sup(&high)),
            None => self.boxes.push(PartBox { system, low, high }),
        }
    }

    pub(crate) fn into_boxes(mut self) -> Vec<PartBox> {
        self.end_run();
        self.boxes
    }
}

/// How many pieces of a curve are as near to it as a box is told. Most of the curves that a turned arc or a
/// spline comes in hardly bend: a chord ℓ is ℓ²/8 times the bend from its arc.
fn pieces_of(length: f64, bend: f64) -> u32 {
    /// mm.
    const NEAR_MM: f64 = 5e-4;
    let wanted = length * (bend / (8.0 * NEAR_MM)).sqrt();
    // Between the ends a curve may bend more: no fewer than four.
    let mut pieces = 4;
    while pieces < PIECES && f64::from(pieces) < wanted {
        pieces *= 2;
    }
    pieces
}

#[cfg(test)]
mod tests {
    use crate::{CoordinateSystem, Options, PartBox, WorkOffsets, check};

    fn boxes(text: &str) -> Vec<PartBox> {
        let mut offsets = WorkOffsets::default();
        offsets.systems[0].origin[0] = 100.0;
        offsets.systems[0].origin[2] = -50.0;
        let turned = CoordinateSystem {
            rotation_deg: 90.0,
            ..offsets.systems[0]
        };
        offsets.systems[1] = turned;
        let options = Options {
            offsets,
            ..Options::default()
        };
        check(text.as_bytes(), options).part
    }

    fn near(part: &PartBox, system: &str, low: [f64; 3], high: [f64; 3]) {
        assert_eq!(part.system, system);
        for axis in 0..3 {
            let (off_low, off_high) = (part.low[axis] - low[axis], part.high[axis] - high[axis]);
            assert!(off_low.abs() < 1e-3 && off_high.abs() < 1e-3, "{part:?}");
        }
    }

    #[test]
    fn a_part_is_where_it_is_cut_in_the_coordinates_of_its_program() {
        // Neither the start nor a rapid is the part's, and the length of the tool changes nothing of it.
        let text = "G21 G90 G54 F600\nG43.1 Z30\nG0 X-20 Y0 Z5\nG1 X0 Z-2\nX40\nG3 X40 Y20 J10\nG0 Z50\nM2\n";
        let parts = boxes(text);
        assert_eq!(parts.len(), 1);
        near(&parts[0], "G54", [-20.0, 0.0, -2.0], [50.0, 20.0, 5.0]);
        // What changes the zero in between changes the coordinates of what comes then, and of nothing before.
        let text =
            "G21 G90 G54 F600\nG0 X0 Y0 Z0\nG1 X10\nG92 X0\nG1 X-4 Y2\nG92.1\nG3 X6 Y14 J6\nM2\n";
        let parts = boxes(text);
        assert_eq!(parts.len(), 1);
        near(&parts[0], "G54", [-4.0, 0.0, 0.0], [12.0, 14.0, 0.0]);
        // Two systems, one of them turned.
        let text = "G21 G90 G54 F600\nG1 X1\nG55\nG0 X0 Y0 Z0\nG1 X10\nG2 X10 Y-8 J-4\nM2\n";
        let parts = boxes(text);
        assert_eq!(parts.len(), 2);
        near(&parts[1], "G55", [0.0, -8.0, 0.0], [14.0, 0.0, 0.0]);
        assert!(boxes("G0 X5\nM2\n").is_empty());
    }
}
