//! Where the feed moves of a program go, in the coordinates of the part.

use glidepath_geometry::{AxisVector, Segment};
use glidepath_program::{Item, ItemKind};

use crate::execute::interpreter::Interpreter;

/// Pieces of a curve whose ends are looked at where the axes of the program are not those of the machine.
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
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct PartBoxes {
    boxes: Vec<PartBox>,
    /// Which of them grew last: index of the system, and of an extended one.
    last: Option<((usize, Option<u32>), usize)>,
}

impl PartBoxes {
    /// Adds an item, with what is in force for it.
    pub(crate) fn add(&mut self, interpreter: &Interpreter, item: &Item) {
        let ItemKind::Move { segment, rate, .. } = &item.kind else {
            return;
        };
        if rate.is_rapid() {
            return;
        }
        let offsets = &interpreter.state.offsets;
        let map = interpreter.tip_map();
        let place = |axes: &AxisVector| {
            let place = map.map_or(*axes, |map| map.place(axes));
            offsets.to_program(place)
        };
        let (mut low, mut high);
        if let Segment::Line(line) = segment {
            let (from, to) = (place(&line.start), place(&line.end));
            (low, high) = (from.inf(&to), from.sup(&to));
        } else if map.is_none() && !offsets.is_turned() {
            let (least, most) = segment.bounding_box();
            (low, high) = (place(&least), place(&most));
        } else {
            let length = segment.length();
            (low, high) = (place(&segment.start()), place(&segment.start()));
            for piece in 1..=PIECES {
                let s = length * f64::from(piece) / f64::from(PIECES);
                let at = place(&segment.jet(s).position);
                (low, high) = (low.inf(&at), high.sup(&at));
            }
        }
        self.grow(
            offsets.system_in_use(),
            || offsets.system_name(),
            (low, high),
        );
    }

    fn grow(
        &mut self,
        system: (usize, Option<u32>),
        name: impl FnOnce() -> String,
        (low, high): (AxisVector, AxisVector),
    ) {
        let known = self.last.filter(|(last, _)| *last == system);
        let at = known.map_or_else(
            || {
                let name = name();
                let of_name = self.boxes.iter().position(|known| known.system == name);
                of_name.unwrap_or_else(|| {
                    self.boxes.push(PartBox {
                        system: name,
                        low,
                        high,
                    });
                    self.boxes.len() - 1
                })
            },
            |(_, at)| at,
        );
        self.last = Some((system, at));
        if let Some(grown) = self.boxes.get_mut(at) {
            (grown.low, grown.high) = (grown.low.inf(&low), grown.high.sup(&high));
        }
    }

    pub(crate) fn into_boxes(self) -> Vec<PartBox> {
        self.boxes
    }
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
        // Two systems, one of them turned.
        let text = "G21 G90 G54 F600\nG1 X1\nG55\nG0 X0 Y0 Z0\nG1 X10\nG2 X10 Y-8 J-4\nM2\n";
        let parts = boxes(text);
        assert_eq!(parts.len(), 2);
        near(&parts[1], "G55", [0.0, -8.0, 0.0], [14.0, 0.0, 0.0]);
        assert!(boxes("G0 X5\nM2\n").is_empty());
    }
}
