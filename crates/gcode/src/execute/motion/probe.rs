//! Probing: G38.2 to G38.5.
//!
//! Where things are simulated ([`Connections::Simulated`]), and where a program is only looked at,
//! the probe finds what it looks for exactly at the end of its move. Where they are the machine's
//! ([`Connections::Real`]) the move may end anywhere on its way: whoever executes the program says
//! where ([`crate::Program::answer_probe`]) before more of it is read.

use glidepath_geometry::AXES;
use glidepath_program::{Event, Item, ItemKind, PathMode};

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::execute::interpreter::Interpreter;
use crate::execute::motion::settled::MIN_MOVE;
use crate::execute::motion::speed::Pace;
use crate::execute::state::probe_result::{ProbeResult, Probed, Search};
use crate::setup::options::Connections;
use crate::syntax::block::Block;
use crate::syntax::modes::{FeedMode, Probe};

impl Interpreter {
    pub(crate) fn probe(
        &mut self,
        probe: Probe,
        block: &Block,
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        let span = block.motion_span();
        self.require_connection(span, "probe")?;
        let is_real = self.options.connections == Connections::Real;
        if self.state.modal.feed_mode != FeedMode::PerMinute {
            let message = "probing needs a feedrate per minute";
            return Err(
                BlockDiagnostic::new(DiagnosticCode::MissingFeed, span, message)
                    .because("the move ends where contact is made, so its time is not known")
                    .help("write G94"),
            );
        }
        if is_real {
            self.check_probing_feed(span)?;
        }
        let target = self.target(block)?;
        let far = (0..AXES).any(|axis| (target[axis] - self.state.position[axis]).abs() > MIN_MOVE);
        if !far {
            let message = "the probe would not move";
            return Err(
                BlockDiagnostic::new(DiagnosticCode::InvalidValue, span, message)
                    .because("the end of the move is where the machine stands")
                    .help("write an end in the direction of the part"),
            );
        }
        let first = out.len();
        let mode = core::mem::replace(&mut self.state.modal.path_mode, PathMode::ExactStop);
        let moved = self.straight(block, target, Pace::Feed, out);
        self.state.modal.path_mode = mode;
        moved?;
        self.state.probe = ProbeResult {
            contact: self.state.offsets.to_program(target),
            made: true,
        };
        if is_real {
            let release = !probe.toward;
            let event = Item {
                block: 0,
                line: self.line,
                kind: ItemKind::Event(Event::Probe { release }),
            };
            out.insert(first, event);
            self.state.search = Some(Search { probe, span });
        }
        Ok(())
    }

    /// Refuses what no machine could stop from in time.
    fn check_probing_feed(&self, span: SourceSpan) -> Outcome<()> {
        let Some(most_v) = self.options.probing_v else {
            return Err(BlockDiagnostic::new(
                DiagnosticCode::NotConnected,
                span,
                "no probe is connected",
            )
            .because("the machine's configuration does not say which input it is")
            .help("remove the block, or write the table [probe] into the configuration"));
        };
        let feed = self.state.modal.feed;
        let feed_v = feed.map_or(0.0, |feed| feed.linear_v.max(feed.rotary_v));
        if feed_v <= most_v {
            return Ok(());
        }
        let (feed, most) = (feed_v * 60.0, most_v * 60.0);
        let message = format!("F{feed:.0} is too fast for the probe");
        Err(
            BlockDiagnostic::new(DiagnosticCode::InvalidValue, span, message)
                .because("it could not stop within the overtravel that the configuration allows it")
                .help(format!("write F{most:.0} or less")),
        )
    }

    /// Goes on from where a search has ended.
    pub(crate) fn end_search(&mut self, search: Search, probed: &Probed) -> Outcome<()> {
        let contact = probed.contact.unwrap_or(self.state.position);
        self.state.probe = ProbeResult {
            contact: self.state.offsets.to_program(contact),
            made: probed.contact.is_some(),
        };
        (self.state.position, self.state.path_end) = (probed.stands, probed.stands);
        let Search { probe, span } = search;
        let what = if probe.toward {
            "a contact"
        } else {
            "the end of a contact"
        };
        let (message, reason) = match probed.contact {
            None => (
                format!("the probe did not find {what}"),
                "its move came to its end without",
            ),
            Some(_) if probed.was_so => (
                format!("the probe found {what} before it moved"),
                "it has to find it on its way",
            ),
            Some(_) => return Ok(()),
        };
        if !probe.must {
            return Ok(());
        }
        Err(BlockDiagnostic::new(DiagnosticCode::Probe, span, message)
            .because(reason)
            .help("look at the probe and its cable; G38.3 and G38.5 go on in any case"))
    }
}
