//! What is in force where a program begins, on controls where that is other than on LinuxCNC.

use glidepath_geometry::Plane;

use crate::execute::interpreter::Interpreter;
use crate::execute::program::Program;
use crate::execute::state::program_state::State;
use crate::setup::fanuc::FeedAtStart;
use crate::setup::options::Options;
use crate::setup::siemens::LatheX;
use crate::syntax::dialect::Dialect;
use crate::syntax::modes::{ArcFeed, Distance, FeedMode, Motion};

/// The motion code in force where a program begins, on controls that have one.
pub(super) const fn motion_at_start(dialect: Dialect) -> Option<Motion> {
    match dialect {
        // MD 20150: G1.
        Dialect::Siemens => Some(Motion::Linear),
        // Parameter 3402#0: G0.
        Dialect::Fanuc => Some(Motion::Rapid),
        Dialect::LinuxCnc | Dialect::Marlin => None,
    }
}

/// What X words are where a program of a SINUMERIK's lathe begins.
pub(super) fn siemens_x_at_start(options: &Options, state: &mut State) {
    if options.is_siemens_lathe() {
        let x = options.siemens.lathe_x;
        state.modal.diameter = match x {
            LatheX::Diameter => true,
            LatheX::Unsaid | LatheX::Radius => false,
            LatheX::DiameterInG90 => state.modal.distance == Distance::Absolute,
        };
        state.diameter_by_distance = x == LatheX::DiameterInG90;
    }
}

impl<R> Program<R> {
    /// What F counts on arcs beside G41 and G42 where a program begins.
    pub(super) const fn arc_feed_at_start(&self) -> ArcFeed {
        match self.block.dialect {
            // MD 20150: CFC.
            Dialect::Siemens => ArcFeed::Contour,
            // Internal circular cutting, whatever G62 says.
            Dialect::Fanuc if !self.block.is_lathe => ArcFeed::Inside,
            Dialect::Fanuc | Dialect::LinuxCnc | Dialect::Marlin => ArcFeed::Center,
        }
    }

    /// What is in force when a control of the dialect is switched on, where that is other than LinuxCNC's.
    pub(super) fn power_on(&mut self, feed: FeedAtStart) {
        self.interpreter.state.arc_feed = self.arc_feed_at_start();
        let units = self.interpreter.options.fanuc.units_at_start;
        let units = units.filter(|_| self.block.dialect == Dialect::Fanuc);
        let state = &mut self.interpreter.state;
        let modal = &mut state.modal;
        modal.units = units.unwrap_or(modal.units);
        modal.motion = motion_at_start(self.block.dialect).or(modal.motion);
        if self.block.is_lathe {
            // X words are diameters, the plane is that of G18.
            (modal.diameter, modal.plane) = (true, Plane::Zx);
            let feed_mode = match feed {
                FeedAtStart::Unsaid => None,
                FeedAtStart::PerMinute => Some(FeedMode::PerMinute),
                FeedAtStart::PerRevolution => Some(FeedMode::PerRevolution),
            };
            modal.feed_mode = feed_mode.unwrap_or(modal.feed_mode);
            state.fanuc.is_feed_unsaid = modal.feed.is_none() && feed_mode.is_none();
        }
        self.siemens_power_on();
    }

    /// MD 20150 of a SINUMERIK's lathe: the plane is that of G18, and X what its parameters say.
    pub(super) fn siemens_power_on(&mut self) {
        let Interpreter { options, state, .. } = &mut self.interpreter;
        if options.is_siemens_lathe() {
            state.modal.plane = Plane::Zx;
            siemens_x_at_start(options, state);
        }
    }
}
