//! The text of a G-code program, made of items: millimetres, absolute machine coordinates, numbers
//! that read back bit for bit.

use core::f64::consts::TAU;
use core::fmt::Write as _;
use glidepath_geometry::{Arc, Axis, AxisVector, Nurbs, Plane, Quintic, Segment};
use glidepath_program::{Event, Item, ItemKind, PathMode, Rate};

/// How far the chords of a curve that was read may be away from it, mm.
const CHORD_MM: f64 = 1e-3;

/// A program as it grows.
#[derive(Debug)]
pub struct ProgramText {
    text: String,
    position: AxisVector,
    mode: Option<PathMode>,
    feed_v: f64,
}

/// An event that cannot be written: its words are not known any more.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct UnknownEvent {
    /// Source line of the event.
    pub line: u32,
}

// Writing to a String does not fail, so the results of `write!` carry nothing.
impl ProgramText {
    /// A program of a machine that stands at `start`.
    #[must_use]
    pub fn new(start: AxisVector) -> Self {
        let text = "(machine coordinates: run it with work offsets of zero)\n\
                    G21 G17 G40 G49 G54 G80 G90 G91.1 G94\n";
        Self {
            text: text.to_owned(),
            position: start,
            mode: None,
            feed_v: 0.0,
        }
    }

    /// Appends an item.
    ///
    /// # Errors
    /// An event whose words the item does not have.
    pub fn item(&mut self, item: &Item) -> Result<(), UnknownEvent> {
        match &item.kind {
            ItemKind::Move {
                segment,
                rate,
                mode,
            } => {
                self.path_mode(*mode);
                self.segment(segment, *rate);
                Ok(())
            }
            ItemKind::Dwell(seconds) => {
                let _ = writeln!(self.text, "G4 P{seconds}");
                Ok(())
            }
            ItemKind::Event(event) => self.event(*event, item.line),
        }
    }

    /// Appends a curve that starts where the program is.
    pub fn curve(&mut self, curve: &Nurbs, feed_v: f64, mode: PathMode) {
        self.path_mode(mode);
        let (points, knots) = (curve.control_points(), curve.knots());
        let mut last = self.position;
        for (i, knot) in knots.iter().enumerate() {
            if i == 0 {
                let _ = write!(
                    self.text,
                    "G6.2 P{} F{} ",
                    curve.degree() + 1,
                    feed_v * 60.0
                );
            }
            let _ = write!(self.text, "K{knot}");
            if let (Some(point), Some(weight)) = (points.get(i), curve.weights().get(i)) {
                // Of each point the axes that differ from the one before; the first names its
                // place.
                for axis in Axis::ALL {
                    let value = point[axis.index()];
                    if value.to_bits() != last[axis.index()].to_bits()
                        || (i == 0 && axis == Axis::X)
                    {
                        let _ = write!(self.text, " {axis}{value}");
                    }
                }
                let same = (point - last).amax() <= 0.0 && i > 0;
                if same {
                    let _ = write!(self.text, " X{}", point[0]);
                }
                let _ = write!(self.text, " R{weight}");
                last = *point;
            }
            self.text.push('\n');
        }
        self.position = last;
        self.feed_v = 0.0;
    }

    /// The whole program.
    #[must_use]
    pub fn finish(mut self) -> String {
        self.text.push_str("M2\n");
        self.text
    }

    fn path_mode(&mut self, mode: PathMode) {
        if self.mode == Some(mode) {
            return;
        }
        self.mode = Some(mode);
        let _ = match mode {
            PathMode::ExactStop => writeln!(self.text, "G61.1"),
            PathMode::ExactPath => writeln!(self.text, "G61"),
            PathMode::Continuous { tolerance_mm: None } => writeln!(self.text, "G64"),
            PathMode::Continuous {
                tolerance_mm: Some(tolerance_mm),
            } => writeln!(self.text, "G64 P{tolerance_mm}"),
        };
    }

    fn segment(&mut self, segment: &Segment, rate: Rate) {
        match (segment, rate.feed_v()) {
            (Segment::Arc(arc), _) => self.arc(arc),
            (Segment::Curve(curve), _) => self.chords(segment, curve),
            (_, None) => self.text.push_str("G0"),
            (_, Some(_)) => self.text.push_str("G1"),
        }
        let end = segment.end();
        for axis in Axis::ALL {
            let value = end[axis.index()];
            if value.to_bits() != self.position[axis.index()].to_bits() {
                let _ = write!(self.text, " {axis}{value}");
            }
        }
        if let Some(feed_v) = rate.feed_v()
            && feed_v.to_bits() != self.feed_v.to_bits()
        {
            let _ = write!(self.text, " F{}", feed_v * 60.0);
            self.feed_v = feed_v;
        }
        self.text.push('\n');
        self.position = end;
    }

    /// The inner points of a piece of a curve, and the code of the move to its end.
    fn chords(&mut self, segment: &Segment, curve: &Quintic) {
        let bend_k = curve.bounds().d2.norm();
        let count = (curve.length * (bend_k / (8.0 * CHORD_MM)).sqrt()).ceil();
        let mut k = 1.0;
        while k < count {
            let point = segment.jet(curve.length * k / count).position;
            let _ = writeln!(self.text, "G1 X{} Y{} Z{}", point[0], point[1], point[2]);
            k += 1.0;
        }
        self.text.push_str("G1");
    }

    fn arc(&mut self, arc: &Arc) {
        let plane = match arc.plane {
            Plane::Xy => "G17",
            Plane::Zx => "G18",
            Plane::Yz => "G19",
            Plane::Uv => "G17.1",
            Plane::Wu => "G18.1",
            Plane::Vw => "G19.1",
        };
        let code = if arc.sweep_rad > 0.0 { 3 } else { 2 };
        let _ = write!(self.text, "{plane} G{code}");
        let (first, second) = arc.plane.axes();
        for (axis, center) in [first, second].into_iter().zip(arc.center) {
            let letter = match axis {
                Axis::Y | Axis::V => 'J',
                Axis::Z | Axis::W => 'K',
                _ => 'I',
            };
            let _ = write!(self.text, " {letter}{}", center - arc.start[axis.index()]);
        }
        let turns = (arc.sweep_rad.abs() / TAU - 1e-9).ceil();
        if turns > 1.0 {
            let _ = write!(self.text, " P{turns}");
        }
    }

    fn event(&mut self, event: Event, line: u32) -> Result<(), UnknownEvent> {
        let _ = match event {
            Event::SpindleSpeed(speed) => writeln!(self.text, "S{speed}"),
            Event::SelectTool(tool) => writeln!(self.text, "T{tool}"),
            // The code that comes next says it.
            Event::SpindleGear(_) => Ok(()),
            // Their further words are not part of the event.
            Event::MCode(19 | 61 | 66)
            | Event::SpindleAngle { .. }
            | Event::Probe { .. }
            | Event::Synchronise { .. }
            | Event::CodeWord { .. }
            | Event::Tap { .. } => {
                return Err(UnknownEvent { line });
            }
            Event::MCode(number) | Event::PassingCode(number) | Event::ProgramStop(number) => {
                writeln!(self.text, "M{number}")
            }
            // The configuration says so again.
            Event::Await(_) => Ok(()),
            Event::OptionalStop => writeln!(self.text, "M1"),
            Event::DigitalOutput { number, on } => {
                writeln!(self.text, "M{} P{number}", if on { 62 } else { 63 })
            }
            Event::AnalogOutput { number, value } => {
                writeln!(self.text, "M67 E{number} Q{value}")
            }
        };
        Ok(())
    }
}
