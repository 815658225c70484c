//! FANUC's G76: a thread in passes along Z, in two blocks or in one.
//!
//! ```text
//! G76 P m r a  Q least  R finish        m finishing passes, r: way out in tenths of a lead,
//!                                       a: angle of the tool, each of two digits
//! G76 X Z  P height  Q first  R taper  F lead
//!
//! G76 X Z  I taper  K height  D first  A angle  F lead  [P 1 or 3] [Q start]
//! ```
//!
//! X and Z are the bottom of the thread at its end; the tool stands at the side from which it cuts,
//! and it ends there. Pass n is √n times as deep as the first one (P3: n times), so that all take
//! as much material, and is shifted along Z so that one flank of the tool cuts. The taper is the
//! radius at the beginning less that at the end. P and Q of the two blocks, R of the first one, and D count
//! thousandths of a millimetre, or ten-thousandths of an inch, where they have no point.
//!
//! ```text
//!   ●━━━━━━━━━━━━━━━━━━━━━━━━━━━━━┓   where the tool stands
//!   ┃      ──── peak ─────        ┃
//!   ┗━━━━━━━━━━━━━━━━━━━━╱━━ ━ ━ ━┛   way out: r
//!   (X, Z) ends it here
//! ```

use glidepath_geometry::AxisVector;
use glidepath_program::Item;

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::execute::interpreter::Interpreter;
use crate::execute::state::open_thread::Groove;
use crate::execute::state::thread_setup::ThreadSetup;
use crate::execute::thread_cycle::MAX_PASSES;
use crate::setup::fanuc::PointInput;
use crate::syntax::block::Block;
use crate::syntax::modes::{Distance, Units};
use crate::syntax::word_check::{missing, none_wrong, whole};

/// Angles that a tool may have, degrees: 0 cuts with both flanks.
const MOST_ANGLE: f64 = 120.0;
/// Passes as near to the full depth as this are at it, mm.
const SAME_DEPTH_MM: f64 = 1e-9;

/// A thread, in mm and program coordinates.
#[derive(Debug, Clone, Copy)]
struct FanucThread {
    /// Where the tool stands.
    start: AxisVector,
    /// X and Z of the bottom at the end.
    end: [f64; 2],
    /// 1 if it is cut from higher X (outside), −1 if from lower.
    side: f64,
    height_mm: f64,
    first_mm: f64,
    /// Radius at the beginning less that at the end.
    taper_mm: f64,
    lead_mm: f64,
    phase: u32,
    /// All passes are as much deeper than the one before.
    is_even: bool,
    setup: ThreadSetup,
}

impl Interpreter {
    /// G76 of FANUC.
    pub(crate) fn fanuc_thread(&mut self, block: &Block, out: &mut Vec<Item>) -> Outcome<()> {
        let is_setup = !block.has_axes();
        if is_setup {
            self.state.thread_setup = Some(self.thread_setup(block)?);
            return Ok(());
        }
        let thread = self.read_fanuc_thread(block)?;
        for depth_mm in thread.depths(block.motion_span())? {
            self.fanuc_pass(block, &thread, depth_mm, out)?;
        }
        self.rapid_to(block, thread.start, out)
    }

    /// The first block: how the threads behind it are cut.
    fn thread_setup(&self, block: &Block) -> Outcome<ThreadSetup> {
        let span = block.motion_span();
        let digits = whole(block, b'P', 999_999)?
            .ok_or_else(|| missing(span, "G76", "P", "passes, way out and angle"))?;
        let angle = f64::from(digits % 100);
        Ok(ThreadSetup {
            finishes: (digits / 10_000).max(1),
            exit_leads: 0.1 * f64::from(digits / 100 % 100),
            tangent: tangent(block, b'P', angle)?,
            least_mm: self.increments(block, b'Q')?.unwrap_or(0.0),
            finish_mm: self.finish_allowance(block).abs(),
        })
    }

    /// R of the first block, mm: as P and Q it counts increments where it has no point.
    fn finish_allowance(&self, block: &Block) -> f64 {
        let mm = self.state.modal.units.mm();
        let value = block.get(b'R').unwrap_or(0.0);
        let is_count = block.has_no_point(b'R') && block.point == PointInput::Unsaid;
        let unit = match self.state.modal.units {
            _ if !is_count => 1.0,
            Units::Inch => 1e-4,
            Units::Millimetre => 1e-3,
        };
        value * unit * mm
    }

    fn read_fanuc_thread(&self, block: &Block) -> Outcome<FanucThread> {
        let span = block.motion_span();
        let is_one_block = block.get(b'D').is_some() || block.get(b'K').is_some();
        let need = |value: Option<f64>, word: &str, meaning: &str| {
            value.ok_or_else(|| missing(span, "G76", word, meaning))
        };
        let scale = self.state.modal.units.mm();
        let (setup, height_mm, first_mm, taper, phase) = if is_one_block {
            let angle = block.get(b'A').unwrap_or(0.0);
            let setup = ThreadSetup {
                finishes: 0,
                exit_leads: 0.0,
                tangent: tangent(block, b'A', angle)?,
                least_mm: 0.0,
                finish_mm: 0.0,
            };
            let height = block.get(b'K').map(|height| height * scale);
            let first = match block.get(b'D') {
                Some(first) if first.fract() != 0.0 => Some(first * scale),
                _ => self.increments(block, b'D')?,
            };
            (setup, height, first, b'I', self.phase(block)?)
        } else {
            let Some(setup) = self.state.thread_setup else {
                return Err(no_setup(span));
            };
            let [height, first] = [self.increments(block, b'P')?, self.increments(block, b'Q')?];
            (setup, height, first, b'R', 0)
        };
        check_others(block, is_one_block)?;
        let [height, first] = if is_one_block { ["K", "D"] } else { ["P", "Q"] };
        let height_mm = need(height_mm, height, "the height of the thread")?;
        let first_mm = need(first_mm, first, "the depth of the first pass")?;
        let lead_mm = self.fanuc_lead_mm(block, "G76")?;
        let start = self.state.offsets.to_program(self.state.position);
        let across = if self.state.modal.diameter {
            0.5 * scale
        } else {
            scale
        };
        let is_incremental = self.state.modal.distance == Distance::Incremental;
        let end = |[letter, increment]: [u8; 2], index: usize, scale: f64| {
            let from = if is_incremental { start[index] } else { 0.0 };
            let by = block.get(increment).filter(|_| block.has_increments());
            let by = by.map(|by| start[index] + by * scale);
            let to = block.get(letter).map(|value| from + value * scale);
            to.or(by)
        };
        let end_x = need(end(*b"XU", 0, across), "X", "the bottom of the thread")?;
        let end_z = need(end(*b"ZW", 2, scale), "Z", "where the thread ends")?;
        let thread = FanucThread {
            start,
            end: [end_x, end_z],
            side: 1.0_f64.copysign(start[0] - end_x),
            height_mm,
            first_mm,
            taper_mm: block.get(taper).unwrap_or(0.0) * scale,
            lead_mm,
            phase,
            is_even: is_one_block && whole(block, b'P', 4)? == Some(3),
            setup,
        };
        thread.check(block, is_one_block)?;
        Ok(thread)
    }

    /// A word that counts the least increments of the control, in mm.
    fn increments(&self, block: &Block, letter: u8) -> Outcome<Option<f64>> {
        let Some(count) = block.get(letter) else {
            return Ok(None);
        };
        let (of_one, name) = match self.state.modal.units {
            Units::Inch => (25.4e-4, "ten-thousandths of an inch"),
            Units::Millimetre => (1e-3, "thousandths of a millimetre"),
        };
        let letter_name = char::from(letter);
        if count.fract() != 0.0 || count < 0.0 {
            let message = format!("{letter_name}{count} in G76 is no whole number");
            return Err(BlockDiagnostic::new(
                DiagnosticCode::NotAnInteger,
                block.span(letter),
                message,
            )
            .because(format!(
                "{letter_name} counts {name} there, without a point"
            ))
            .help(format!("write 200 for {}", 200.0 * of_one)));
        }
        Ok(Some(count * of_one))
    }

    /// A pass so far below the peak, from where the tool stands, and out to its X.
    fn fanuc_pass(
        &mut self,
        block: &Block,
        thread: &FanucThread,
        depth_mm: f64,
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        let at = |x: f64, z: f64| {
            let mut point = thread.start;
            (point[0], point[2]) = (x, z);
            point
        };
        let [start_x, start_z] = [thread.start[0], thread.start[2]];
        let way_z = thread.end[1] - start_z;
        // Shallow passes begin and end further back: only the last one ends at Z.
        let back_z = -(thread.height_mm - depth_mm) * thread.setup.tangent * way_z.signum();
        let [begin_z, end_z] = [start_z + back_z, thread.end[1] + back_z];
        let end_x = thread.end[0] + thread.side * (thread.height_mm - depth_mm);
        let begin_x = end_x + thread.taper_mm;
        let exit_mm = thread.setup.exit_leads * thread.lead_mm;
        let slope = thread.taper_mm / way_z.abs();
        self.rapid_to(block, at(start_x, begin_z), out)?;
        self.rapid_to(block, at(begin_x, begin_z), out)?;
        let mut points = Vec::with_capacity(2);
        if exit_mm > 0.0 {
            let exit_z = end_z - exit_mm * way_z.signum();
            points.push(at(end_x + slope * exit_mm, exit_z));
            points.push(at(end_x + thread.side * thread.height_mm, end_z));
        } else {
            points.push(at(end_x, end_z));
        }
        let mut from = at(begin_x, begin_z);
        let grooves: Vec<Groove> = points
            .into_iter()
            .map(|point| {
                let way = point - from;
                from = point;
                // The lead is along Z, or along X where the thread goes that way rather.
                let along = way[0].hypot(way[2]) / way[0].abs().max(way[2].abs());
                Groove {
                    end: self.state.offsets.to_machine(point),
                    pitch_mm: thread.lead_mm * along,
                    corner_mm: 0.25 * exit_mm.min(thread.height_mm),
                    line: self.line,
                }
            })
            .collect();
        self.pass(block, &grooves, thread.phase, out)?;
        self.rapid_to(block, at(start_x, end_z), out)
    }
}

impl FanucThread {
    fn check(&self, block: &Block, is_one_block: bool) -> Outcome<()> {
        let [height, first, taper] = if is_one_block { *b"KDI" } else { *b"PQR" };
        let peak_mm = self.height_mm + (self.side * self.taper_mm).max(0.0);
        let stands_mm = self.side * (self.start[0] - self.end[0]);
        let way_mm = (self.end[1] - self.start[2]).abs();
        let exit_mm = self.setup.exit_leads * self.lead_mm;
        let wrong = [
            (b'F', self.lead_mm <= 0.0, "a lead above zero"),
            (height, self.height_mm <= 0.0, "a height above zero"),
            (
                first,
                self.first_mm <= 0.0 || self.first_mm > self.height_mm,
                "a depth above zero, of the height at most",
            ),
            (
                height,
                self.setup.finish_mm >= self.height_mm,
                "a height above what is left to finish (R of the first block)",
            ),
            (b'Z', way_mm <= exit_mm, "an end that is further away"),
            (
                taper,
                self.taper_mm.abs() > way_mm,
                "a taper of 45 degrees at most",
            ),
            (
                b'X',
                stands_mm < peak_mm,
                "an X from which the tool stands outside the peak of the thread",
            ),
        ];
        none_wrong(block, "G76", wrong)
    }

    /// How far the passes are below the peak, one after the other.
    fn depths(&self, span: SourceSpan) -> Outcome<Vec<f64>> {
        let rough_mm = self.height_mm - self.setup.finish_mm;
        let (mut depths, mut depth_mm) = (Vec::new(), 0.0_f64);
        for pass in 1..=MAX_PASSES {
            let passes = f64::from(pass);
            let passes = if self.is_even { passes } else { passes.sqrt() };
            depth_mm = (self.first_mm * passes).max(depth_mm + self.setup.least_mm);
            if depth_mm >= rough_mm - SAME_DEPTH_MM {
                depths.push(rough_mm);
                depths.extend((0..self.setup.finishes).map(|_| self.height_mm));
                return Ok(depths);
            }
            depths.push(depth_mm);
        }
        let message = format!("a thread of more than {MAX_PASSES} passes");
        Err(
            BlockDiagnostic::new(DiagnosticCode::CannedCycle, span, message)
                .because("the first pass is small beside the height")
                .help("write a deeper first pass, or a least depth (Q of the first block)"),
        )
    }
}

/// The tangent of half the angle of a tool.
fn tangent(block: &Block, letter: u8, angle: f64) -> Outcome<f64> {
    if (0.0..=MOST_ANGLE).contains(&angle) {
        return Ok((0.5 * angle).to_radians().tan());
    }
    let message = format!("a tool with an angle of {angle} degrees");
    Err(
        BlockDiagnostic::new(DiagnosticCode::InvalidValue, block.span(letter), message)
            .help("write 0 to 120 degrees"),
    )
}

/// Refuses words of the other form, and ways of cutting that are not made.
fn check_others(block: &Block, is_one_block: bool) -> Outcome<()> {
    let others = if is_one_block {
        &b"RYBCV"[..]
    } else {
        b"IAYBCV"
    };
    let is_written = |letter: &u8| block.get(*letter).is_some();
    let twice = [*b"XU", *b"ZW"]
        .into_iter()
        .find_map(|[letter, increment]| {
            let is_other = !block.has_increments() || is_written(&letter);
            (is_written(&increment) && is_other).then_some(increment)
        });
    if let Some(letter) = others.iter().copied().find(is_written).or(twice) {
        let message = format!("G76 with {}", char::from(letter));
        return Err(
            BlockDiagnostic::new(DiagnosticCode::UnusedWord, block.span(letter), message)
                .because("a thread is given by X, Z, F and the words of one of its two forms")
                .help("remove the word; U and W stand for X and Z"),
        );
    }
    match block.get(b'P').filter(|_| is_one_block) {
        None => Ok(()),
        Some(way) if way.total_cmp(&1.0).is_eq() || way.total_cmp(&3.0).is_eq() => Ok(()),
        Some(way) => {
            let message = format!("G76 with P{way}: flanks in turn");
            Err(
                BlockDiagnostic::new(DiagnosticCode::NotSupported, block.span(b'P'), message)
                    .because("passes are shifted to one side")
                    .help("write P1 (areas alike) or P3 (depths alike)"),
            )
        }
    }
}

fn no_setup(span: SourceSpan) -> Box<BlockDiagnostic> {
    let message = "G76 without the block that belongs before it";
    BlockDiagnostic::new(DiagnosticCode::NotSupported, span, message)
        .because(
            "a thread in two blocks needs the first one, `G76 P Q R`; fine boring is G76 of mills",
        )
        .help("write G76 P020060 Q100 R0.05 before it; for a mill set `fanuc = \"mill\"`")
}
