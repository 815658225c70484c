//! G76: a thread in passes along Z, each deeper in X than the one before (LinuxCNC's form).
//!
//! ```text
//!   x0 ●── drive line ────────────────────────●  where the cycle begins; it ends at the other end
//!         │ |I|: offset of the peak
//!   ──────┴───────── peak of the thread ──────
//!          ╲ J, then J·n^(1/R) after n passes
//!           ╲______ full depth |I| + K _______    P: way of a revolution along Z
//!   Z end ◄──────────────────────────────────
//! ```
//!
//! Each pass begins further along by what it is deeper times tan Q, so that it cuts with one flank
//! (the compound slide of a lathe at the angle Q). E is the length along Z of the ways in (L1), out
//! (L2) or both (L3), which rise from full depth to the peak.

use glidepath_geometry::AxisVector;
use glidepath_program::Item;

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::execute::interpreter::Interpreter;
use crate::execute::motion::speed::Pace;
use crate::execute::state::open_thread::Groove;
use crate::syntax::block::Block;
use crate::syntax::dialect::Dialect;
use crate::syntax::word_check::{missing, none_wrong, whole};

/// Most passes of a thread: more is a mistake in a word.
pub(super) const MAX_PASSES: u32 = 1000;
/// Most spring passes.
const MAX_SPRINGS: u32 = 100;
/// The steepest angle of the slide, degrees.
const MAX_SLIDE: f64 = 80.0;

/// What the words of a block say, in mm.
#[derive(Debug, Clone, Copy)]
struct ThreadCycle {
    /// Where it begins, in program coordinates.
    start: AxisVector,
    end_z: f64,
    pitch_mm: f64,
    /// 1 if the thread is inside and cut towards higher X, −1 if it is outside.
    inwards: f64,
    peak_mm: f64,
    first_mm: f64,
    height_mm: f64,
    degression: f64,
    /// Tangent of the slide's angle, with the sign of the direction of Z.
    slide: f64,
    springs: u32,
    /// Length of the ways in and out along Z, with the sign of its direction.
    taper_z: f64,
    has_entry: bool,
    has_exit: bool,
}

impl Interpreter {
    /// G76.
    pub(crate) fn thread_cycle(&mut self, block: &Block, out: &mut Vec<Item>) -> Outcome<()> {
        let cycle = self.read_thread_cycle(block)?;
        for depth_mm in cycle.depths(block.motion_span())? {
            self.thread_pass(block, &cycle, depth_mm, out)?;
        }
        let mut end = cycle.start;
        end[2] = cycle.end_z;
        self.rapid_to(block, end, out)?;
        // No axis word behind the cycle can be meant for it.
        self.state.modal.motion = None;
        Ok(())
    }

    /// Refuses a cycle that cannot be made here.
    fn check_thread_cycle(&self, block: &Block) -> Outcome<()> {
        let span = block.motion_span();
        if block.dialect != Dialect::LinuxCnc {
            let message = "G76 in this dialect is not supported";
            return Err(
                BlockDiagnostic::new(DiagnosticCode::NotSupported, span, message)
                    .because("its words mean something else than LinuxCNC's, or another cycle")
                    .help("write the passes out with G33"),
            );
        }
        let is_written = |letter: &u8| block.get(*letter).is_some();
        let Some(letter) = b"XYABCUVW".iter().copied().find(is_written) else {
            return Ok(());
        };
        let message = format!("G76 with {}", char::from(letter));
        Err(
            BlockDiagnostic::new(DiagnosticCode::UnusedWord, block.span(letter), message)
                .because("the thread begins at the X where the tool is, and ends at Z")
                .help("remove the word; go to the drive line before the cycle"),
        )
    }

    fn read_thread_cycle(&self, block: &Block) -> Outcome<ThreadCycle> {
        self.check_thread_cycle(block)?;
        let span = block.motion_span();
        let number = |letter: u8, meaning: &str| {
            let name = char::from(letter).to_string();
            block
                .get(letter)
                .ok_or_else(|| missing(span, "G76", &name, meaning))
        };
        let scale = self.state.modal.units.mm();
        // G7: what is measured across is a diameter.
        let across = if self.state.modal.diameter {
            0.5 * scale
        } else {
            scale
        };
        let pitch_mm = number(b'P', "the way of a revolution")? * scale;
        let peak = number(
            b'I',
            "how far the peak is from where the tool is; below 0: outside",
        )?;
        let first_mm = number(b'J', "the depth of the first pass")? * across;
        let height_mm = number(b'K', "the full depth of the thread")? * across;
        number(b'Z', "where the thread ends")?;
        let start = self.state.offsets.to_program(self.state.position);
        let end_z = self.state.offsets.to_program(self.target(block)?)[2];
        let degrees = block.get(b'Q').unwrap_or(0.0);
        let ways = whole(block, b'L', 3)?.unwrap_or(0);
        let taper_mm = block.get(b'E').unwrap_or(0.0) * scale;
        let direction = 1.0_f64.copysign(start[2] - end_z);
        let cycle = ThreadCycle {
            start,
            end_z,
            pitch_mm,
            inwards: 1.0_f64.copysign(peak),
            peak_mm: peak.abs() * across,
            first_mm,
            height_mm,
            degression: block.get(b'R').unwrap_or(1.0),
            slide: direction * degrees.to_radians().tan(),
            springs: whole(block, b'H', MAX_SPRINGS)?.unwrap_or(0),
            taper_z: direction * taper_mm,
            has_entry: taper_mm > 0.0 && ways & 1 != 0,
            has_exit: taper_mm > 0.0 && ways & 2 != 0,
        };
        let half_mm = 0.5 * (end_z - start[2]).abs();
        let wrong = [
            (b'P', pitch_mm <= 0.0, "a pitch above zero"),
            (b'I', cycle.peak_mm <= 0.0, "an offset above or below zero"),
            (b'J', first_mm <= 0.0, "a depth above zero"),
            (b'K', height_mm <= first_mm, "a depth greater than J"),
            (b'R', cycle.degression < 1.0, "1 or more"),
            (
                b'Q',
                !(0.0..=MAX_SLIDE).contains(&degrees),
                "0 to 80 degrees",
            ),
            (
                b'E',
                !(0.0..=half_mm).contains(&taper_mm),
                "0 to half of the length of the thread",
            ),
        ];
        none_wrong(block, "G76", wrong)?;
        Ok(cycle)
    }

    /// A pass at a depth below the drive line, and out of the groove: the last one to the drive line,
    /// those before as far out of theirs.
    fn thread_pass(
        &mut self,
        block: &Block,
        cycle: &ThreadCycle,
        depth_mm: f64,
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        let at = |x: f64, z: f64| {
            let mut point = cycle.start;
            (point[0], point[2]) = (x, z);
            point
        };
        let [start_x, start_z] = [cycle.start[0], cycle.start[2]];
        let shift_z = (depth_mm - cycle.peak_mm) * cycle.slide;
        let deep_x = start_x + cycle.inwards * depth_mm;
        let out_x = start_x + cycle.inwards * (depth_mm - cycle.peak_mm - cycle.height_mm);
        let high_x = start_x + cycle.inwards * (depth_mm - cycle.height_mm);
        let begin_z = start_z - shift_z;
        let end_z = cycle.end_z + cycle.height_mm * cycle.slide - shift_z;
        let along = cycle.taper_z.hypot(cycle.height_mm) / cycle.taper_z.abs();
        self.rapid_to(block, at(out_x, begin_z), out)?;
        let mut grooves = Vec::with_capacity(3);
        let mut groove = |point, pitch_mm| grooves.push((point, pitch_mm));
        if cycle.has_entry {
            self.rapid_to(block, at(high_x, begin_z), out)?;
            groove(at(deep_x, begin_z - cycle.taper_z), cycle.pitch_mm * along);
        } else {
            self.rapid_to(block, at(deep_x, begin_z), out)?;
        }
        if cycle.has_exit {
            groove(at(deep_x, end_z + cycle.taper_z), cycle.pitch_mm);
            groove(at(high_x, end_z), cycle.pitch_mm * along);
        } else {
            groove(at(deep_x, end_z), cycle.pitch_mm);
        }
        let corner_mm = 0.25 * cycle.taper_z.abs().min(cycle.height_mm);
        let grooves: Vec<Groove> = grooves
            .into_iter()
            .map(|(point, pitch_mm)| Groove {
                end: self.state.offsets.to_machine(point),
                pitch_mm,
                corner_mm,
                line: self.line,
            })
            .collect();
        self.pass(block, &grooves, 0, out)?;
        self.rapid_to(block, at(out_x, end_z), out)
    }

    /// Goes to program coordinates at rapid.
    pub(crate) fn rapid_to(
        &mut self,
        block: &Block,
        program: AxisVector,
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        let target = self.state.offsets.to_machine(program);
        self.straight(block, target, Pace::Rapid, out)
    }
}

impl ThreadCycle {
    /// The depths of the passes below the drive line, one after the other.
    fn depths(&self, span: SourceSpan) -> Outcome<Vec<f64>> {
        let full_mm = self.peak_mm + self.height_mm;
        let mut depths = Vec::new();
        for pass in 1..=MAX_PASSES {
            let depth_mm =
                self.peak_mm + self.first_mm * f64::from(pass).powf(1.0 / self.degression);
            if depth_mm >= full_mm {
                depths.extend((0..=self.springs).map(|_| full_mm));
                return Ok(depths);
            }
            depths.push(depth_mm);
        }
        let message = format!("a thread of more than {MAX_PASSES} passes");
        Err(
            BlockDiagnostic::new(DiagnosticCode::CannedCycle, span, message)
                .because("the first pass (J) is small beside the depth (K), or R is high")
                .help("write a greater J or a smaller R"),
        )
    }
}
