//! The codes of the other dialects: G and M numbers, sorted into the groups of [`Codes`].

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::setup::m_codes::MCodes;
use crate::syntax::codes::{Coded, Codes, MOST_M, NO_SYSTEM, set};
use crate::syntax::dialect::Dialect;
use crate::syntax::dialect::marlin::{function_with_decimal, is_function};
use crate::syntax::dialect::words::fanuc_systems::{OtherSystem, SystemCode};
use crate::syntax::dialect::words::{Meaning, fanuc, fanuc_lathe, marlin, no_g, no_m, refused};
use crate::syntax::frame_codes::{FrameCode, TiltCode};
use crate::syntax::modes::{
    ArcFeed, CannedCycle, FeedMode, LatheCycle, Motion, NonModal, Pockets, PoleFrom, Probe,
    SpindleMode, Stop, ToolLength, Turning, Units,
};
use crate::syntax::number::code_number;
use glidepath_program::PathMode;

impl Codes {
    /// Adds a G word of a FANUC program.
    pub(crate) fn add_fanuc_g(
        &mut self,
        mut value: f64,
        is_lathe: bool,
        system: Option<OtherSystem>,
        span: SourceSpan,
    ) -> Outcome<()> {
        let code = code_number(value * 10.0);
        if let Some((system, code)) = system.zip(code) {
            match system.code(code) {
                SystemCode::OfA(code) => value = f64::from(code) / 10.0,
                SystemCode::Shared(code) => return self.add_g(f64::from(code) / 10.0, span),
                SystemCode::Absent => return Err(no_g(Dialect::Fanuc, value, span)),
            }
        }
        let table = if is_lathe { fanuc_lathe::g } else { fanuc::g };
        let tenths = code_number(value * 10.0);
        let found = tenths.and_then(|tenths| Some((tenths, table(tenths)?)));
        let Some((tenths, meaning)) = found else {
            return Err(no_g(Dialect::Fanuc, value, span));
        };
        let added = match meaning {
            Meaning::Shared => self.add_g(value, span),
            Meaning::Own if is_lathe => self.add_own_lathe_g(tenths, span),
            Meaning::Own => self.add_own_fanuc_g(tenths, span),
            Meaning::ReadOver => set(&mut self.read_over, tenths, span),
            Meaning::Refused(what, help) => Err(refused(&format!("G{value}"), what, help, span)),
        };
        added.or_else(|fault| {
            let mut alone = Self::default();
            let is_second = fault.code == DiagnosticCode::ModalGroupConflict;
            let replaces = is_second
                && match meaning {
                    Meaning::Shared => alone.add_g(value, span).is_ok(),
                    Meaning::Own if is_lathe => alone.add_own_lathe_g(tenths, span).is_ok(),
                    Meaning::Own => alone.add_own_fanuc_g(tenths, span).is_ok(),
                    _ => false,
                }
                && self.replace_mode(&alone);
            if replaces { Ok(()) } else { Err(fault) }
        })
    }

    /// G50 and G69 go beside a frame code of another group, which has the words of the block.
    fn add_frame(&mut self, code: FrameCode, span: SourceSpan) -> Outcome<()> {
        let Some(first) = self.frame else {
            return set(&mut self.frame, code, span);
        };
        let second = Coded { code, span };
        let (place, frame) = match (first.code.ends(), code.ends()) {
            (_, Some(place)) => (place, first),
            (Some(place), None) => (place, second),
            (None, None) => return set(&mut self.frame, code, span),
        };
        let end = FrameCode::ENDS.get(place);
        let is_of_group = end.is_some_and(|end| {
            core::mem::discriminant(end) == core::mem::discriminant(&frame.code)
        });
        match self.frame_ends.get_mut(place) {
            Some(is_ended) if !is_of_group && !*is_ended => {
                *is_ended = true;
                self.frame = Some(frame);
                Ok(())
            }
            _ => set(&mut self.frame, code, span),
        }
    }

    /// Puts the one mode of `last` into the place of the one of its group: of two modal codes of a group
    /// FANUC takes the last. False where it is no mode.
    fn replace_mode(&mut self, last: &Self) -> bool {
        fn put<T: Copy>(slot: &mut Option<T>, last: Option<T>) -> bool {
            *slot = last.or(*slot);
            last.is_some()
        }
        if last.is_once || self.is_once || last.tip.is_some() || self.tip.is_some() {
            return false;
        }
        put(&mut self.motion, last.motion)
            || put(&mut self.plane, last.plane)
            || put(&mut self.distance, last.distance)
            || put(&mut self.feed_mode, last.feed_mode)
            || put(&mut self.units, last.units)
            || put(&mut self.cutter_radius, last.cutter_radius)
            || put(&mut self.tool_length, last.tool_length)
            || put(&mut self.system, last.system)
            || put(&mut self.retract, last.retract)
            || put(&mut self.spindle_mode, last.spindle_mode)
            || put(&mut self.path_mode, last.path_mode)
            || put(&mut self.polar_mode, last.polar_mode)
    }

    /// The codes of system A.
    fn add_own_lathe_g(&mut self, tenths: u32, span: SourceSpan) -> Outcome<()> {
        let lathe = match tenths {
            320 => Motion::Thread,
            700 => Motion::Lathe(LatheCycle::Finish),
            710 => Motion::Lathe(LatheCycle::Turn(Pockets::Cut)),
            720 => Motion::Lathe(LatheCycle::Face(Pockets::Cut)),
            730 => Motion::Lathe(LatheCycle::Repeat),
            740 | 750 => Motion::Groove(tenths == 750),
            900 => Motion::Turning(Turning::Turn),
            920 => Motion::Turning(Turning::Thread),
            940 => Motion::Turning(Turning::Face),
            760 => Motion::ThreadCycle,
            1840 => Motion::Cycle(CannedCycle::TapLeft),
            500 => return set(&mut self.non_modal, NonModal::LatheSetting, span),
            980 => return set(&mut self.feed_mode, FeedMode::PerMinute, span),
            990 => return set(&mut self.feed_mode, FeedMode::PerRevolution, span),
            _ => return self.add_own_fanuc_g(tenths, span),
        };
        self.is_once = matches!(
            lathe,
            Motion::Lathe(_) | Motion::Groove(_) | Motion::ThreadCycle
        );
        self.set_motion(Some(lathe), span)
    }

    /// G31 is a move that a contact ends, and no error without; like G60 it is of its block alone.
    fn add_own_fanuc_g(&mut self, tenths: u32, span: SourceSpan) -> Outcome<()> {
        let once = match tenths {
            310 => Motion::Probe(Probe {
                toward: true,
                must: false,
            }),
            600 => {
                set(&mut self.exact_stop, (), span)?;
                Motion::Rapid
            }
            120 | 130 => Motion::CirclePocket(tenths == 120),
            700 | 710 => Motion::HolePattern(tenths == 710),
            _ => return self.add_fanuc_mode(tenths, span),
        };
        self.is_once = true;
        self.set_motion(Some(once), span)
    }

    fn add_fanuc_mode(&mut self, tenths: u32, span: SourceSpan) -> Outcome<()> {
        match tenths {
            90 => set(&mut self.exact_stop, (), span),
            100 => set(&mut self.non_modal, NonModal::SetData, span),
            921 => set(&mut self.non_modal, NonModal::PresetSystem, span),
            760 => self.set_motion(Some(Motion::Cycle(CannedCycle::FineBore)), span),
            870 => self.set_motion(Some(Motion::Cycle(CannedCycle::BackBore)), span),
            150 | 160 => set(&mut self.polar_mode, tenths == 160, span),
            300 => set(&mut self.non_modal, NonModal::GoToReference(1), span),
            531 | 682 => {
                let code = if tenths == 682 {
                    TiltCode::Plane
                } else {
                    TiltCode::Align
                };
                set(&mut self.tilt, code, span)
            }
            2540 | 2550 => set(&mut self.dynamic, tenths == 2540, span),
            434 | 435 | 2340 => {
                self.tip_by_vector = tenths == 435;
                set(&mut self.tip, true, span)?;
                set(&mut self.tool_length, ToolLength::FromTable, span)
            }
            450 => set(&mut self.lengthening, 1, span),
            460 => set(&mut self.lengthening, -1, span),
            470 => set(&mut self.lengthening, 2, span),
            480 => set(&mut self.lengthening, -2, span),
            440 => set(&mut self.tool_length, ToolLength::Subtract, span),
            500 | 510 => self.add_frame(FrameCode::Scale(tenths == 510), span),
            501 | 511 => self.add_frame(FrameCode::Mirror(tenths == 511), span),
            1000 | 1010 => self.add_frame(FrameCode::Switch(tenths == 1010), span),
            680 | 690 => self.add_frame(FrameCode::Turn(tenths == 680), span),
            // Corners inside are slower, or the feed cannot be changed: the path is that of G64.
            620 | 630 => set(
                &mut self.path_mode,
                PathMode::Continuous { tolerance_mm: None },
                span,
            ),
            1100..=1290 => set(&mut self.extended_system, Some(tenths / 10 - 109), span),
            541 | 1540 => set(&mut self.extended_system, None, span),
            _ => Err(no_g(Dialect::Fanuc, f64::from(tenths) / 10.0, span)),
        }
    }

    /// Adds an M word of a FANUC program: M29 taps rigidly, unless it is the machine's own; so are M23 and
    /// M24 of lathes.
    pub(crate) fn add_fanuc_m(
        &mut self,
        value: f64,
        is_lathe: bool,
        span: SourceSpan,
        declared: &MCodes,
    ) -> Outcome<()> {
        let number = code_number(value);
        self.last_m = number;
        if let Some(number) = number.filter(|number| declared.is_own(*number)) {
            return set(&mut self.user, number, span);
        }
        match number.filter(|number| is_lathe && fanuc_lathe::m(*number).is_some()) {
            Some(number @ (23 | 24)) => return set(&mut self.thread_end, number == 24, span),
            Some(_) => return Err(no_m(Dialect::Fanuc, value, span)),
            None => {}
        }
        match number.and_then(fanuc::m) {
            Some(Meaning::Own) if number == Some(29) => set(&mut self.rigid_tapping, 29, span),
            Some(Meaning::Refused(what, help)) => {
                Err(refused(&format!("M{value}"), what, help, span))
            }
            Some(Meaning::Shared) => self.add_m_beside(value, span, declared),
            Some(Meaning::Own | Meaning::ReadOver) | None => Err(no_m(Dialect::Fanuc, value, span)),
        }
    }

    /// Adds a G word of a SINUMERIK line that was rewritten: LinuxCNC's, and what has no number
    /// there.
    pub(crate) fn add_rewritten_g(&mut self, value: f64, span: SourceSpan) -> Outcome<()> {
        match code_number(value * 10.0) {
            Some(90) => set(&mut self.exact_stop, (), span),
            Some(72) => set(&mut self.diameter_by_distance, (), span),
            Some(161) => set(&mut self.arc_feed, ArcFeed::Contour, span),
            Some(162) => set(&mut self.arc_feed, ArcFeed::Center, span),
            Some(163) => set(&mut self.arc_feed, ArcFeed::Inside, span),
            Some(code @ (164 | 165)) => set(&mut self.turns_on_circles, code == 164, span),
            Some(971) => set(
                &mut self.spindle_mode,
                SpindleMode::UnlimitedRevolutions,
                span,
            ),
            Some(25) => self.set_motion(Some(Motion::ArcThrough), span),
            Some(26) => self.set_motion(Some(Motion::ArcTangent), span),
            Some(3310) => self.set_motion(Some(Motion::TapIn), span),
            Some(3320) => self.set_motion(Some(Motion::TapOut), span),
            Some(code @ (1100 | 1110 | 1120)) => {
                let from = match code {
                    1100 => PoleFrom::Place,
                    1110 => PoleFrom::Zero,
                    _ => PoleFrom::Pole,
                };
                set(&mut self.non_modal, NonModal::SetPole(from), span)
            }
            // Lengths are inches or millimetres, feeds stay millimetres.
            Some(code @ (700 | 710)) => {
                self.feeds_in_mm = true;
                let units = if code == 700 {
                    Units::Inch
                } else {
                    Units::Millimetre
                };
                set(&mut self.units, units, span)
            }
            Some(5000) => set(&mut self.system, NO_SYSTEM, span),
            // G54 to G57 are the first four of them.
            Some(code @ 5050..=5990) => set(
                &mut self.system,
                usize::try_from(code / 10 - 501).unwrap_or(NO_SYSTEM),
                span,
            ),
            Some(code @ (434 | 435)) => set(&mut self.tip, code == 434, span),
            _ => self.add_g(value, span),
        }
    }

    /// Adds an M word of a SINUMERIK line: what the builder declared comes first.
    pub(crate) fn add_rewritten_m(
        &mut self,
        value: f64,
        span: SourceSpan,
        declared: &MCodes,
    ) -> Outcome<()> {
        self.m_words += 1;
        if self.m_words > MOST_M {
            let message = format!("more than {MOST_M} M codes in a block");
            return Err(
                BlockDiagnostic::new(DiagnosticCode::ModalGroupConflict, span, message)
                    .because("this control takes no more")
                    .help("write two blocks"),
            );
        }
        match code_number(value).filter(|number| declared.is_own(*number)) {
            Some(number) => self.add_user_m(number, span),
            None => self.add_m_beside(value, span, declared),
        }
    }

    /// Adds a code of the machine's builder beside others of them; those that switch the kinematics stay alone.
    fn add_user_m(&mut self, number: u32, span: SourceSpan) -> Outcome<()> {
        let stays_alone = |number: u32| matches!(number, 428..=430);
        let is_second = self.user.is_some_and(|first| {
            first.code == number || stays_alone(first.code) || stays_alone(number)
        });
        let free = self.more_of_user.iter().position(|code| *code == 0);
        match (u16::try_from(number), free) {
            (Ok(code), Some(free))
                if self.user.is_some() && !is_second && !self.more_of_user.contains(&code) =>
            {
                self.more_of_user[free] = code;
                Ok(())
            }
            _ => set(&mut self.user, number, span),
        }
    }

    /// Adds an M word that may stand beside another one of its group: M7 and M8 switch on a coolant each.
    fn add_m_beside(&mut self, value: f64, span: SourceSpan, declared: &MCodes) -> Outcome<()> {
        let pair = self.coolant.map(|first| (first.code, code_number(value)));
        if !self.both_coolants && matches!(pair, Some((7, Some(8)) | (8, Some(7)))) {
            self.both_coolants = true;
            return Ok(());
        }
        self.add_m(value, span, declared)
    }

    /// Adds a G word of a printer's program.
    pub(crate) fn add_printer_g(&mut self, value: f64, span: SourceSpan) -> Outcome<()> {
        match code_number(value * 10.0).and_then(marlin::g) {
            Some(Meaning::Refused(what, help)) => {
                Err(refused(&format!("G{value}"), what, help, span))
            }
            Some(Meaning::Own) if matches!(code_number(value), Some(60 | 61)) => {
                set(&mut self.kept_place, code_number(value) == Some(60), span)
            }
            Some(Meaning::Own) if matches!(code_number(value), Some(28)) => self.add_g(value, span),
            Some(Meaning::Shared) => self.add_g(value, span),
            Some(Meaning::Own | Meaning::ReadOver) | None => {
                Err(no_g(Dialect::Marlin, value, span))
            }
        }
    }

    /// Adds an M word of a printer's program.
    pub(crate) fn add_printer_m(
        &mut self,
        value: f64,
        span: SourceSpan,
        declared: &MCodes,
    ) -> Outcome<()> {
        let number = code_number(value).or_else(|| function_with_decimal(value));
        match number {
            // The printer stops until somebody has it go on.
            Some(25) => return set(&mut self.stop, Stop::Program(0), span),
            Some(number @ (82 | 83)) => return set(&mut self.extruder, number == 83, span),
            Some(number) if is_function(number) => {
                return set(&mut self.function, number, span);
            }
            Some(number) if declared.is_own(number) => return set(&mut self.user, number, span),
            _ => {}
        }
        match number.and_then(marlin::m) {
            Some(Meaning::Refused(what, help)) => {
                Err(refused(&format!("M{value}"), what, help, span))
            }
            Some(Meaning::Shared) => self.add_m(value, span, declared),
            Some(Meaning::Own | Meaning::ReadOver) | None => {
                Err(no_m(Dialect::Marlin, value, span))
            }
        }
    }
}
