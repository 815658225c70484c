//! G70 to G73 of a lathe: along a profile that stands in blocks P to Q of the program.
//!
//! ```text
//! G71 U depth R back        G72 W depth R back        each of its own, and once
//! G71 P Q U W F S           the allowances: U a diameter, both with their sign
//! G71 P Q U W D F S         in one block: D is the depth; I and K are what the passes leave for one more
//!                           along the profile, I a radius
//! G73 U W R                 from where to the profile, U a radius, and the number of passes
//! G73 P Q U W F S           as G71; Haas: G73 P Q U W I K D F, with D passes from I and K
//! G70 P Q F S               the blocks of the profile as they stand, and back
//! ```
//!
//! Roughing passes are those of [`crate::execute::lathe_cycle`], of the profile shifted by the
//! allowances; the last one goes along it. Then the tool goes back to where it began, and the program
//! goes on behind block Q.

use std::io::BufRead;

use glidepath_geometry::Plane;

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::execute::interpreter::Interpreter;
use crate::execute::lathe_cycle::open::{LatheCycleWords, OpenLatheCycle};
use crate::execute::lathe_cycle::profile::LatheProfile;
use crate::execute::motion::speed::Pace;
use crate::execute::program::Program;
use crate::execute::scope::ProgramScope;
use crate::execute::state::fanuc_modal::Repeating;
use crate::setup::fanuc::PointInput;
use crate::syntax::block::Block;
use crate::syntax::block_reader_of_dialects::without_point;
use crate::syntax::codes::Codes;
use crate::syntax::dialect::fanuc::{Statement, statement};
use crate::syntax::letters::Letters;
use crate::syntax::modes::{LatheCycle, Motion, Units};
use crate::syntax::named_word::Named;
use crate::syntax::word_check::{missing, unused, whole, whole_count};

/// Largest block number.
const MOST_NUMBER: u32 = 99_999_999;
/// Most passes of G73.
const MOST_PASSES: u32 = 1000;
/// Depths as near to each other as this are one, mm.
const SAME_DEPTH_MM: f64 = 1e-9;
/// The deepest pass that a word without a decimal point is taken for, where nothing says what that is.
const MOST_WITHOUT_POINT_MM: f64 = 20.0;

impl<R: BufRead> Program<R> {
    /// Makes the cycle that the block asks for.
    pub(super) fn lathe_profile_cycle(&mut self, cycle: LatheCycle, line: u32) -> Outcome<bool> {
        let block = self.block.clone();
        self.begun = true;
        self.interpreter.begin(line);
        check_alone(&block)?;
        self.settle_corner_before_cycle(&block)?;
        let numbers = [b'P', b'Q'].map(|letter| whole(&block, letter, MOST_NUMBER));
        let [first, last] = numbers;
        match (first?, last?) {
            (Some(first), Some(last)) => {
                let lines = self.profile_lines(&block, cycle, [first, last])?;
                self.interpreter.check_profile(&block, cycle)?;
                let motion = Some(Motion::Lathe(cycle));
                self.interpreter.feed(&block, motion)?;
                let mut items = Vec::new();
                self.interpreter.spindle_speed(&block, &mut items)?;
                self.items = items;
                match cycle {
                    LatheCycle::Finish => self.finish_profile(&block, lines)?,
                    _ => {
                        self.rough_profile(&block, cycle, lines, line)?;
                    }
                }
                self.end_of_line();
            }
            (None, None) if cycle == LatheCycle::Repeat => {
                self.interpreter.repeating_words(&block)?;
            }
            (None, None) if cycle != LatheCycle::Finish => {
                self.interpreter.roughing_words(&block, cycle)?;
            }
            _ => {
                let meaning = "the first and the last block of the profile";
                return Err(missing(
                    block.motion_span(),
                    "the cycle",
                    "P and Q",
                    meaning,
                ));
            }
        }
        Ok(true)
    }

    /// A corner that is broken has its second move in front of the cycle.
    fn settle_corner_before_cycle(&mut self, block: &Block) -> Outcome<()> {
        let span = block.motion_span();
        self.interpreter
            .settle_corner_before(block, span, &mut self.items)
    }

    /// G71, G72 and G73.
    fn rough_profile(
        &mut self,
        block: &Block,
        cycle: LatheCycle,
        [first, last]: [usize; 2],
        line: u32,
    ) -> Outcome<()> {
        let used = match cycle {
            LatheCycle::Repeat => Letters::of(b"PQUWFSDIK"),
            _ => Letters::of(b"PQUWFSDIK"),
        };
        if let Some((letter, span)) = block.unused(used) {
            return Err(unused(letter, span));
        }
        let words = self.interpreter.fanuc_roughing(block, cycle)?;
        let source = self.here();
        let start = self.interpreter.state.position;
        let mut profile = LatheProfile::new(self.interpreter.lathe_point());
        for index in first..=last {
            let Some((number, text)) = self.tape.get(index).cloned() else {
                break;
            };
            // What is wrong with a block of the profile is wrong there.
            self.set_tape_origin(number, &text);
            self.draw_fanuc_block(&text, &mut profile)?;
        }
        self.set_tape_origin(source.number, &source.text);
        self.block.clone_from(block);
        let mm = self.interpreter.state.modal.units.mm();
        let allowance = [
            block.get(b'W').unwrap_or(0.0) * mm,
            0.5 * block.get(b'U').unwrap_or(0.0) * mm,
        ];
        profile.shift_by(allowance);
        let last_cut = match cycle {
            LatheCycle::Repeat => None,
            _ => last_cut(block, mm)?,
        };
        let along = last_cut.map(|cut| {
            let along = profile.clone();
            profile.shift_by(cut);
            (LatheCycleWords::along_profile(), along)
        });
        let state = self.interpreter.state.clone();
        let mut items = core::mem::take(&mut self.items);
        for (words, profile) in core::iter::once((words, profile)).chain(along) {
            let source = source.clone();
            let own = block.clone();
            let open = OpenLatheCycle::of_fanuc(source, line, own, words, profile, state.clone());
            self.interpreter.make_lathe_cycle(&open, &mut items)?;
            self.interpreter
                .straight(block, start, Pace::Rapid, &mut items)?;
        }
        self.items = items;
        self.tape.next = last + 1;
        Ok(())
    }

    /// Takes a block into the profile.
    fn draw_fanuc_block(&mut self, text: &[u8], profile: &mut LatheProfile) -> Outcome<()> {
        if statement(text).0 != Statement::Block {
            return Err(statement_in_profile(SourceSpan::new(0, text.len())));
        }
        let scope = ProgramScope {
            parameters: &self.parameters,
            interpreter: &self.interpreter,
        };
        self.block.parse(text, &scope)?;
        // Roughing would draw with the values from before it.
        if let Some(assignment) = self.block.assignments.first() {
            return Err(statement_in_profile(assignment.span));
        }
        // Roughing goes along the profile with the tip; the radius counts in G70.
        self.block.codes.cutter_radius = None;
        let motion = self.block.codes.motion.and_then(|coded| coded.code);
        let motion = motion.or(profile.motion);
        self.block
            .take_words_of_lathes(motion, self.interpreter.options.machine)?;
        let own = [b'A', b'C']
            .into_iter()
            .find(|letter| self.block.get(*letter).is_some());
        let angle = self.block.named.find(Named::LineAngle);
        let span = own
            .map(|letter| self.block.span(letter))
            .or_else(|| angle.map(|angle| angle.span));
        if let Some(span) = span {
            let message = "an angle, or an axis of rotation, in the profile of a cycle";
            return Err(
                BlockDiagnostic::new(DiagnosticCode::NotSupported, span, message)
                    .because("a profile is drawn by ends and arcs, chamfers and rounded corners")
                    .help("write the coordinates of the end"),
            );
        }
        profile.add(&self.block, &self.interpreter)
    }
}

/// I and K of G71 and G72 in one block, Z and X: what the passes leave for one more along the profile.
fn last_cut(block: &Block, mm: f64) -> Outcome<Option<[f64; 2]>> {
    let words = [b'K', b'I'];
    let Some(first) = words
        .into_iter()
        .find(|letter| block.get(*letter).is_some())
    else {
        return Ok(None);
    };
    if block.get(b'D').is_none() {
        return Err(unused(char::from(first), block.span(first)));
    }
    let cut = words.map(|letter| block.get(letter).unwrap_or(0.0) * mm);
    Ok(cut.iter().any(|cut| *cut != 0.0).then_some(cut))
}

/// Refuses what the block of a cycle would leave undone: it has the words of the cycle, F, S, and the codes
/// that say how these two count.
fn check_alone(block: &Block) -> Outcome<()> {
    let refuse = |span: SourceSpan, message: &str, reason: &str| {
        Err(
            BlockDiagnostic::new(DiagnosticCode::NotSupported, span, message)
                .because(reason)
                .help("write it into a block before the cycle"),
        )
    };
    if block.get(b'T').is_some() {
        return refuse(
            block.span(b'T'),
            "T in the block of a cycle along a profile",
            "with which offset its first way would be made depends on the control",
        );
    }
    let others = Codes {
        motion: None,
        feed_mode: None,
        spindle_mode: None,
        ..block.codes
    };
    if others.any() {
        return refuse(
            block.motion_span(),
            "another code beside a cycle along a profile",
            "the block of the cycle has its words alone, F and S",
        );
    }
    Ok(())
}

#[cold]
fn two_depths(block: &Block, [own, before]: [f64; 2]) -> Box<BlockDiagnostic> {
    let message = format!("two depths of a pass: {own} mm by D, {before} mm by the block before");
    BlockDiagnostic::new(DiagnosticCode::AmbiguousWord, block.span(b'D'), message)
        .because("a control has one of both forms: the depth in a block of its own, or D")
        .help("leave D out, or the block with the depth")
}

#[cold]
fn statement_in_profile(span: SourceSpan) -> Box<BlockDiagnostic> {
    let message = "a statement in the profile of a cycle";
    BlockDiagnostic::new(DiagnosticCode::NotSupported, span, message)
        .because("a profile is drawn by G0, G1, G2 and G3 alone")
        .help("write its blocks out")
}

impl Interpreter {
    /// The first block of G71 or G72: U or W is the depth, R the way back.
    fn roughing_words(&mut self, block: &Block, cycle: LatheCycle) -> Outcome<()> {
        let letter = match cycle {
            LatheCycle::Face(_) => b'W',
            _ => b'U',
        };
        if let Some((other, span)) = block.unused(Letters::one(letter).and(Letters::of(b"R"))) {
            return Err(unused(other, span));
        }
        let mm = self.state.modal.units.mm();
        check_points(block, &[letter, b'R'], mm)?;
        let depth = block
            .get(letter)
            .filter(|depth| *depth > 0.0)
            .ok_or_else(|| {
                let name = char::from(letter).to_string();
                missing(
                    block.motion_span(),
                    "the cycle",
                    &name,
                    "the depth of a pass, above zero",
                )
            })?;
        self.state.fanuc.depth_mm = Some(depth * mm);
        if let Some(back) = block.get(b'R').filter(|back| *back >= 0.0) {
            self.state.fanuc.retract_mm = back * mm;
        }
        Ok(())
    }

    /// The first block of G73: U and W are the way from the first pass to the last, R the passes.
    fn repeating_words(&mut self, block: &Block) -> Outcome<()> {
        if let Some((other, span)) = block.unused(Letters::of(b"UWR")) {
            return Err(unused(other, span));
        }
        let relief = [block.get(b'W'), block.get(b'U')];
        self.state.fanuc.repeating = Some(self.repeating(block, b'R', relief)?);
        Ok(())
    }

    /// The passes of G73, whose number is the word of a letter.
    fn repeating(&self, block: &Block, letter: u8, relief: [Option<f64>; 2]) -> Outcome<Repeating> {
        let name = char::from(letter).to_string();
        let passes = whole_count(block, letter, MOST_PASSES)?
            .filter(|passes| *passes > 0)
            .ok_or_else(|| missing(block.motion_span(), "G73", &name, "the number of passes"))?;
        let mm = self.state.modal.units.mm();
        Ok(Repeating {
            relief_mm: relief.map(|way| way.unwrap_or(0.0) * mm),
            passes,
        })
    }

    /// The passes of G73: of its block, as Haas has them, or of the one before.
    fn fanuc_repeating(&self, block: &Block) -> Outcome<LatheCycleWords> {
        let own = Letters::of(b"IKD");
        let repeating = if block.has_any(own) {
            let relief = [block.get(b'K'), block.get(b'I')];
            Some(self.repeating(block, b'D', relief)?)
        } else {
            self.state.fanuc.repeating
        };
        let repeating = repeating.ok_or_else(|| {
            let meaning = "the number of passes, in a block of its own: G73 U5. W0 R3";
            missing(block.motion_span(), "the cycle", "R", meaning)
        })?;
        let retract_mm = self.state.fanuc.retract_mm;
        let cycle = LatheCycle::Repeat;
        Ok(LatheCycleWords::of_fanuc(
            cycle,
            1.0,
            retract_mm,
            Some(repeating),
        ))
    }

    /// Depth and way back of a cycle, of its block or of the one before.
    fn fanuc_roughing(&self, block: &Block, cycle: LatheCycle) -> Outcome<LatheCycleWords> {
        if cycle == LatheCycle::Repeat {
            return self.fanuc_repeating(block);
        }
        let mm = self.state.modal.units.mm();
        let unit = match (block.has_no_point(b'D'), self.state.modal.units) {
            (false, _) => 1.0,
            (true, Units::Millimetre) => 1e-3,
            (true, Units::Inch) => 1e-4,
        };
        let own = block.get(b'D').map(|depth| depth * unit * mm);
        if let (Some(own), Some(before)) = (own, self.state.fanuc.depth_mm)
            && (own - before).abs() > SAME_DEPTH_MM
        {
            return Err(two_depths(block, [own, before]));
        }
        let depth_mm = own
            .or(self.state.fanuc.depth_mm)
            .filter(|depth| *depth > 0.0)
            .ok_or_else(|| {
                let (word, meaning) = if self.options.fanuc.is_haas() {
                    (
                        "D",
                        "the depth of a pass, D2.; a setting of the control has it otherwise",
                    )
                } else {
                    (
                        "U",
                        "the depth of a pass, in a block of its own: G71 U2. R1.",
                    )
                };
                missing(block.motion_span(), "the cycle", word, meaning)
            })?;
        Ok(LatheCycleWords::of_fanuc(
            cycle,
            depth_mm,
            self.state.fanuc.retract_mm,
            None,
        ))
    }

    fn check_profile(&self, block: &Block, cycle: LatheCycle) -> Outcome<()> {
        let is_here = self.state.modal.plane == Plane::Zx
            && !self.state.offsets.is_turned()
            && (!self.state.on_contour || cycle == LatheCycle::Finish);
        if is_here {
            return Ok(());
        }
        let message =
            "a cycle along a profile outside the ZX plane, or roughing with G41 or G42 on";
        Err(
            BlockDiagnostic::new(DiagnosticCode::CannedCycle, block.motion_span(), message)
                .because("its profile is drawn in Z and X, for the tip of the tool")
                .help("write G18 and G40 before it"),
        )
    }
}

/// Refuses what a pass cannot be, in words without a decimal point: `U400` is .4 mm on a control that counts least
/// increments.
fn check_points(block: &Block, letters: &[u8], mm: f64) -> Outcome<()> {
    for letter in letters {
        let value = block.get(*letter).unwrap_or(0.0);
        let is_in_doubt = block.point == PointInput::Unsaid && block.has_no_point(*letter);
        if is_in_doubt && value.abs() * mm > MOST_WITHOUT_POINT_MM {
            return Err(without_point(
                char::from(*letter),
                value,
                block.span(*letter),
            ));
        }
    }
    Ok(())
}
