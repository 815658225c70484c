//! Calls of cycles: their arguments, and the lines they become.
//!
//! | cycle | arguments, in this order |
//! |---|---|
//! | `CYCLE81`, `CYCLE82` | RTP, RFP, SDIS, DP, DPR, DTB |
//! | `CYCLE83` | RTP, RFP, SDIS, DP, DPR, FDEP, FDPR, DAM, DTB, DTS, FRF, VARI |
//! | `CYCLE84` | RTP, RFP, SDIS, DP, DPR, DTB, SDAC, MPIT, PIT, POSS, SST, SST1, AXN, PITA, TECHNO, VARI, DAM, VRT |
//! | `CYCLE85` | RTP, RFP, SDIS, DP, DPR, DTB, FFR, RFF |
//! | `CYCLE86` | RTP, RFP, SDIS, DP, DPR, DTB, SDIR, RPA, RPO, RPAP, POSS |
//! | `CYCLE87` | RTP, RFP, SDIS, DP, DPR, SDIR |
//! | `CYCLE88` | RTP, RFP, SDIS, DP, DPR, DTB, SDIR |
//! | `CYCLE89` | RTP, RFP, SDIS, DP, DPR, DTB |
//! | `CYCLE840` | RTP, RFP, SDIS, DP, DPR, DTB, SDR, SDAC, ENC, MPIT, PIT, AXN, PITA, TECHNO |
//! | `CYCLE71` | RTP, RFP, SDIS, DP, PA, PO, LENG, WID, STA, MID, MIDA, FDP, FALD, FFP1, VARI, FDP1 |
//! | `CYCLE95` | NPP, MID, FALZ, FALX, FAL, FF1, FF2, FF3, VARI, DT, DAM, _VRT |
//! | `CYCLE97` | PIT, MPIT, SPL, FPL, DM1, DM2, APP, ROP, TDEP, FAL, IANG, NSP, NRC, NID, VARI, NUMT, _VRT |
//! | `CYCLE98` | PO1, DM1, PO2, DM2, PO3, DM3, PO4, DM4, APP, ROP, TDEP, FAL, IANG, NSP, NRC, NID, PP1, PP2, PP3, VARI, NUMT, _VRT |
//! | `CYCLE76` | RTP, RFP, SDIS, DP, DPR, LENG, WID, CRAD, PA, PO, STA, MID, FAL, FALD, FFP1, FFD, CDIR, VARI, AP1, AP2 |
//! | `CYCLE77` | RTP, RFP, SDIS, DP, DPR, PRAD, PA, PO, MID, FAL, FALD, FFP1, FFD, CDIR, VARI, AP1 |
//! | `POCKET1` | RTP, RFP, SDIS, DP, DPR, LENG, WID, CRAD, CPA, CPO, STA1, FFD, FFP1, MID, CDIR, FAL, VARI, MIDF, FFP2, SSF |
//! | `POCKET2` | RTP, RFP, SDIS, DP, DPR, PRAD, CPA, CPO, FFD, FFP1, MID, CDIR, FAL, VARI, MIDF, FFP2, SSF |
//! | `POCKET3` | RTP, RFP, SDIS, DP, LENG, WID, CRAD, PA, PO, STA, MID, FAL, FALD, FFP1, FFD, CDIR, VARI, MIDA, AP1, AP2, AD, RAD1, DP1 |
//! | `POCKET4` | RTP, RFP, SDIS, DP, PRAD, PA, PO, MID, FAL, FALD, FFP1, FFD, CDIR, VARI, MIDA, AP1, AD, RAD1, DP1 |
//!
//! RTP is the plane to retract to, RFP the surface, SDIS the clearance above it, DP the bottom, all
//! coordinates but SDIS, and DPR the depth below RFP. These cycles work along the axis normal to the
//! plane, downwards; those of lathes in Z and X.

use std::io::BufRead;

use glidepath_geometry::Axis;

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::execute::dialect::siemens::arguments::Arguments;
use crate::execute::dialect::siemens::lines::Lines;
use crate::execute::dialect::siemens::newer_arguments::Newer;
use crate::execute::dialect::siemens::steps::{Before, CycleCall, Step};
use crate::execute::interpreter::Interpreter;
use crate::execute::program::Program;
use crate::syntax::dialect::siemens::statement::name_at;
use crate::syntax::modes::FeedMode;

/// Names of cycles, and how many arguments each takes.
const CYCLES: [(&str, usize); 19] = [
    ("CYCLE81", 6),
    ("CYCLE82", 6),
    ("CYCLE83", 12),
    ("CYCLE84", 18),
    ("CYCLE85", 8),
    ("CYCLE86", 11),
    ("CYCLE87", 6),
    ("CYCLE88", 7),
    ("CYCLE89", 6),
    ("CYCLE840", 14),
    ("CYCLE71", 16),
    ("CYCLE97", 17),
    ("CYCLE98", 22),
    ("CYCLE76", 20),
    ("CYCLE77", 16),
    ("POCKET1", 20),
    ("POCKET2", 17),
    ("POCKET3", 23),
    ("POCKET4", 19),
];

/// Whether the block is of the plane XY, ZX or YZ, and its axes.
pub(super) fn plane_axes(
    interpreter: &Interpreter,
    arguments: Arguments<'_>,
) -> Outcome<[Axis; 3]> {
    let plane = interpreter.state.modal.plane;
    let (first, second) = plane.axes();
    let axes = [first, second, plane.normal()];
    if axes.iter().any(|axis| axis.index() >= 3) {
        return Err(arguments
            .refused(
                "the plane is not of X, Y and Z",
                "cycles work along one of these axes",
            )
            .help("write G17, G18 or G19"));
    }
    let normal = plane.normal();
    if !interpreter.options.machine.has(normal) {
        return Err(arguments
            .refused(
                format!("it works along {normal}, and the machine has no such axis"),
                "cycles work along the axis that is normal to the plane in force",
            )
            .help(
                "write the plane before it: G17 for what is along Z, as on the face of a lathe",
            ));
    }
    Ok(axes)
}

/// The coordinate of the program on an axis, in the units in force.
pub(super) fn coordinate(interpreter: &Interpreter, axis: Axis) -> f64 {
    let program = interpreter
        .state
        .offsets
        .to_program(interpreter.state.position);
    program[axis.index()] / interpreter.state.modal.units.mm()
}

#[cold]
pub(super) fn diameters(arguments: Arguments<'_>, what: &str) -> Box<BlockDiagnostic> {
    arguments
        .refused(
            format!("{what}, where X counts diameters"),
            "whether X is a diameter among the arguments, too, depends on the control",
        )
        .help("write DIAMOF before it, and radii")
}

impl Interpreter {
    /// True where X words are diameters, or those with G90 (DIAM90).
    pub(super) const fn counts_diameters(&self) -> bool {
        self.state.modal.diameter || self.state.diameter_by_distance
    }
}

impl<R: BufRead> Program<R> {
    /// A call of a cycle in a line of its own.
    pub(super) fn siemens_cycle(&mut self, text: &[u8], at: usize) -> Outcome<()> {
        if name_at(text, at).eq_ignore_ascii_case(b"CYCLE95") {
            return self.siemens_stock_removal(text, at);
        }
        let (call, span) = self.siemens_call(text, at)?;
        self.siemens_begin(&call, span)
    }

    /// The name of a cycle and the values of its arguments.
    pub(super) fn siemens_call(&self, text: &[u8], at: usize) -> Outcome<(CycleCall, SourceSpan)> {
        let scope = self.scope();
        let mut input = self.evaluator(&scope, text, at);
        let name = input.name_ahead();
        input.at += name.len();
        let known = CYCLES
            .into_iter()
            .find(|(known, _)| known.as_bytes() == name);
        let Some((name, most)) = known else {
            let span = SourceSpan::new(at, input.at);
            let message = format!(
                "MCALL of {} is not supported",
                String::from_utf8_lossy(&name)
            );
            return Err(
                BlockDiagnostic::new(DiagnosticCode::NotSupported, span, message)
                    .because("this cycle works along a contour, at one place")
                    .help("write it without MCALL"),
            );
        };
        let mut arguments = input.arguments()?;
        let span = SourceSpan::new(at, input.at);
        Newer {
            name,
            most,
            plane: self.interpreter.state.modal.plane,
            span,
        }
        .settle(&mut arguments)?;
        if !input.is_at_end() {
            let span = SourceSpan::new(input.at, text.len());
            return Err(BlockDiagnostic::new(
                DiagnosticCode::UnusedWord,
                span,
                "text behind a cycle",
            )
            .because("a cycle has a line of its own")
            .help("write it into a line of its own"));
        }
        Ok((CycleCall { name, arguments }, span))
    }

    pub(super) fn siemens_begin(&mut self, call: &CycleCall, span: SourceSpan) -> Outcome<()> {
        let lines = self.cycle_lines(Arguments { call, span })?;
        self.siemens_give(lines)
    }

    /// The lines come next, and behind them what is in force now.
    pub(super) fn siemens_give(&mut self, lines: Lines) -> Outcome<()> {
        let state = &self.interpreter.state;
        let before = Before {
            modal: state.modal,
            rounds_mm: state.rounds_mm,
            diameter_by_distance: state.diameter_by_distance,
        };
        self.siemens.steps.extend(lines.steps);
        self.siemens
            .steps
            .push_back(Step::Restore(Box::new(before)));
        self.siemens_make_typed()
    }

    /// Of a line that was typed the steps are made at once, since it has its whole effect or none. In a program they
    /// come one after the other: there may be very many.
    pub(super) fn siemens_make_typed(&mut self) -> Outcome<()> {
        let mut items = core::mem::take(&mut self.items);
        while self.is_typed
            && let Some(step) = self.siemens.steps.pop_front()
        {
            self.siemens_step(step)?;
            items.append(&mut self.items);
        }
        self.items = items;
        Ok(())
    }

    /// Refuses a cycle where its moves would not be what they are meant to be.
    pub(super) fn check_cycle(&self, arguments: Arguments<'_>) -> Outcome<()> {
        let state = &self.interpreter.state;
        if state.on_contour || state.leaving_contour {
            return Err(arguments
                .refused(
                    "cutter radius compensation is on",
                    "the tool stands beside the programmed point, at a place that depends on the next move",
                )
                .help("write G40 and a move before it"));
        }
        if state.modal.feed_mode == FeedMode::InverseTime {
            return Err(arguments
                .refused(
                    "a feed that is a time (G93)",
                    "the moves of a cycle have feeds per minute or per revolution",
                )
                .help("write G94 or G95 before it"));
        }
        Ok(())
    }

    pub(super) fn cycle_lines(&self, arguments: Arguments<'_>) -> Outcome<Lines> {
        self.check_cycle(arguments)?;
        let interpreter = &self.interpreter;
        let state = &interpreter.state;
        if interpreter.counts_diameters() && state.modal.plane.normal() == Axis::X {
            return Err(diameters(arguments, "along X"));
        }
        match arguments.call.name {
            "CYCLE81" | "CYCLE82" => interpreter.drill(arguments),
            "CYCLE83" => interpreter.deep_drill(arguments),
            "CYCLE84" => interpreter.tap_hole(arguments),
            "CYCLE85" => interpreter.ream(arguments),
            "CYCLE86" => interpreter.bore(arguments),
            "CYCLE87" => interpreter.bore_to_stop(arguments, 5, None),
            "CYCLE88" => interpreter.bore_to_stop(arguments, 6, Some(5)),
            "CYCLE89" => interpreter.bore_both_ways(arguments),
            "CYCLE840" => interpreter.tap_with_chuck(arguments),
            "CYCLE71" => interpreter.mill_face(arguments),
            "CYCLE97" => interpreter.cut_thread(arguments),
            "CYCLE98" => interpreter.cut_thread_chain(arguments),
            "CYCLE76" => interpreter.rectangular_spigot(arguments),
            "CYCLE77" => interpreter.circular_spigot(arguments),
            "POCKET1" => interpreter.older_rectangular_pocket(arguments),
            "POCKET2" => interpreter.older_circular_pocket(arguments),
            "POCKET3" => interpreter.rectangular_pocket(arguments),
            _ => interpreter.circular_pocket(arguments),
        }
    }
}
