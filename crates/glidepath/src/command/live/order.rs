//! The orders that a page may send: commands of the interpolator, jobs of the planner's service,
//! jogs, and the seat. Every one of them is what a command of the command line does.

use glidepath_geometry::{AXES, Axis};
use glidepath_link::{Command, EventId};
use glidepath_live::Role;
use serde::Deserialize;
use std::collections::BTreeMap;

/// An order as a page sends it.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case", deny_unknown_fields)]
pub(super) enum Order {
    Hold {},
    Abort {},
    Resume {},
    Step {},
    Return {},
    Reset {},
    Reverse {},
    Forward {},
    Enable {},
    Disable {},
    /// Bring joints home: all of the machine, if none is named.
    Home {
        #[serde(default)]
        joints: Vec<u32>,
    },
    SingleBlock {
        on: bool,
    },
    FeedOverride {
        value: f64,
    },
    RapidOverride {
        value: f64,
    },
    JogOverride {
        value: f64,
    },
    SpindleOverride {
        value: f64,
    },
    /// What an event asked for is done, or cannot be done. It names the event, so that no answer is
    /// taken for another one.
    Acknowledge {
        boot: String,
        epoch: u64,
        sequence: u64,
        fail: Option<String>,
    },
    /// Moves axes for as long as it is sent again and again: see [`super::gesture`].
    Jog {
        gesture: u64,
        number: u64,
        /// The clock of the page, ms.
        at_ms: f64,
        /// mm/min or °/min.
        axes: BTreeMap<String, f64>,
    },
    /// The finger is up.
    JogEnd {
        gesture: u64,
    },
    /// Moves axes once, by mm or degrees, at most so many mm/min.
    JogStep {
        axes: BTreeMap<String, f64>,
        feed: f64,
    },
    /// A line for the planner's service.
    Mdi {
        line: String,
    },
    /// Lines that belong together, for the planner's service.
    Sequence {
        /// For people.
        name: String,
        lines: Vec<String>,
    },
    /// A program of the folder, for the planner's service.
    Run {
        name: String,
        /// The fingerprint of the program that was looked at, sixteen digits.
        program: String,
        /// How many times its tolerance it may use.
        tolerance_ratio: Option<f64>,
        from_line: Option<u32>,
        pass: Option<u32>,
        #[serde(default)]
        agreed: bool,
        #[serde(default)]
        resume: bool,
        /// Which of the queue it is.
        queued: Option<u64>,
    },
    /// A program of the folder, at the end of the queue.
    QueueAdd {
        name: String,
        /// How many times its tolerance it may use.
        tolerance_ratio: Option<f64>,
    },
    /// One of the queue is the one behind so many.
    QueueMove {
        entry: u64,
        to: usize,
    },
    QueueRemove {
        entry: u64,
    },
    /// Moves along the path that is held, for as long as it is sent again and again: see [`super::shuttle`].
    Shuttle {
        gesture: u64,
        number: u64,
        /// The clock of the page, ms.
        at_ms: f64,
        /// Part of the speed of the plan, negative to go back.
        speed: f64,
    },
    /// The finger is up.
    ShuttleEnd {
        gesture: u64,
    },
    /// The page is there.
    Here {},
    /// It wants to operate.
    AskSeat {},
    /// It answers the page that wants to.
    AnswerSeat {
        give: bool,
    },
    /// It operates no more.
    LeaveSeat {},
    /// A code is shown by which a device is paired that may look, or hold.
    PairDevice {
        may: String,
    },
    /// The code is shown no more.
    EndPairing {},
    /// A device is paired no more.
    RevokeDevice {
        name: String,
    },
}

impl Order {
    /// What a page has to be allowed for it.
    pub(super) const fn role(&self) -> Role {
        match self {
            Self::Hold {} | Self::Abort {} => Role::Hold,
            _ => Role::Operate,
        }
    }

    /// Whether it is given from the operator's seat alone.
    pub(super) const fn takes_the_seat(&self) -> bool {
        !matches!(
            self,
            Self::Hold {}
                | Self::Abort {}
                // Whoever lets go is always heard.
                | Self::JogEnd { .. }
                | Self::ShuttleEnd { .. }
                | Self::Here {}
                | Self::AskSeat {}
                | Self::AnswerSeat { .. }
                | Self::LeaveSeat {}
                | Self::EndPairing {}
        )
    }

    /// Whether it may set something in motion, so that it must not be done late.
    pub(super) const fn counts_at_once_or_never(&self) -> bool {
        self.takes_the_seat()
            && !matches!(
                self,
                Self::Disable {}
                    | Self::Jog { .. }
                    | Self::Shuttle { .. }
                    | Self::QueueAdd { .. }
                    | Self::QueueMove { .. }
                    | Self::QueueRemove { .. }
                    | Self::PairDevice { .. }
                    | Self::RevokeDevice { .. }
            )
    }

    /// How old what its page has heard may be, ns: as old as what a page shows before it says that it is old. A
    /// step is not asked for by name, as a job is, and no stop is looked for that came meanwhile: it is quicker.
    pub(super) const fn longest_way_ns(&self) -> u64 {
        if matches!(self, Self::JogStep { .. }) {
            500_000_000
        } else {
            1_500_000_000
        }
    }

    /// The command of the interpolator that it is, with a word for people. `None` if it is none, or a
    /// value is out of range. `joints` are those of the machine, one bit each.
    pub(super) fn command(&self, joints: u32) -> Option<(Command, &str)> {
        let command = match self {
            Self::Hold {} => Command::Hold,
            Self::Abort {} => Command::Abort,
            Self::Resume {} => Command::Resume,
            Self::Step {} => Command::Step,
            Self::Return {} => Command::Return,
            Self::Reset {} => Command::Reset,
            Self::Reverse {} => Command::Reverse,
            Self::Forward {} => Command::Forward,
            Self::Enable {} => Command::Enable,
            Self::Disable {} => Command::Disable,
            Self::Home { joints: given } => Command::Home(mask(given, joints)?),
            Self::SingleBlock { on } => Command::SingleBlock(*on),
            Self::FeedOverride { value } if (-2.0..=2.0).contains(value) => {
                Command::FeedOverride(*value)
            }
            Self::RapidOverride { value } if (0.0..=1.0).contains(value) => {
                Command::RapidOverride(*value)
            }
            Self::JogOverride { value } if (0.0..=1.0).contains(value) => {
                Command::JogOverride(*value)
            }
            Self::SpindleOverride { value } if (0.0..=2.0).contains(value) => {
                Command::SpindleOverride(*value)
            }
            Self::Acknowledge {
                boot,
                epoch,
                sequence,
                fail,
            } => {
                let event = EventId {
                    // In a text: numbers of pages are exact up to 2⁵³ only.
                    boot_id: u64::from_str_radix(boot, 16).ok()?,
                    epoch: *epoch,
                    sequence: *sequence,
                };
                let done = fail.is_none();
                let command = Command::Acknowledge { event, done };
                return Some((command, fail.as_deref().unwrap_or_default()));
            }
            _ => return None,
        };
        Some((command, ""))
    }
}

/// The joints given, or all of the machine, one bit each; `None` if it has not all of them.
fn mask(given: &[u32], all: u32) -> Option<u32> {
    let bit = |joint: &u32| 1_u32.checked_shl(*joint);
    let given = given
        .iter()
        .try_fold(0, |mask, joint| Some(mask | bit(joint)?))?;
    let mask = if given == 0 { all } else { given };
    (mask & !all == 0).then_some(mask)
}

/// Values by axis, for axes that the machine has; `None` if one is not finite, or of another axis.
pub(super) fn by_axis(values: &BTreeMap<String, f64>, axes: &[Axis]) -> Option<[f64; AXES]> {
    let mut by_axis = [0.0; AXES];
    for (name, value) in values {
        let axis = axes.iter().find(|axis| axis.to_string() == *name)?;
        *by_axis.get_mut(axis.index())? = Some(*value).filter(|value| value.is_finite())?;
    }
    Some(by_axis)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::command::live::given::Given;

    #[test]
    fn an_order_is_known_to_its_last_field_or_not_at_all() {
        let of = |body: &str| Given::of(body.as_bytes()).map(|given| given.order);
        assert_eq!(of("{\"kind\":\"hold\"}"), Some(Order::Hold {}));
        for body in [
            "hold",
            "{\"kind\":\"hold\",\"joint\":1}",
            "{\"kind\":\"feed-override\"}",
            "{\"kind\":\"set-position\",\"joint\":0,\"position\":0}",
            "{\"kind\":\"jog\",\"axes\":{\"X\":1}}",
            "{\"kind\":\"run\"}",
            "{\"kind\":\"run\",\"name\":\"a.ngc\"}",
            "{\"kind\":\"home\",\"joints\":[-1]}",
        ] {
            assert_eq!(of(body), None, "{body}");
        }
        for body in [
            "{\"kind\":\"feed-override\",\"value\":3}",
            "{\"kind\":\"feed-override\",\"value\":-3}",
            "{\"kind\":\"rapid-override\",\"value\":1.1}",
            "{\"kind\":\"jog-override\",\"value\":-0.1}",
            "{\"kind\":\"spindle-override\",\"value\":2.1}",
            "{\"kind\":\"home\",\"joints\":[3]}",
            "{\"kind\":\"home\",\"joints\":[99]}",
            "{\"kind\":\"acknowledge\",\"boot\":\"x\",\"epoch\":1,\"sequence\":1}",
        ] {
            assert_eq!(of(body).unwrap().command(0b111), None, "{body}");
        }
        let home = of("{\"kind\":\"home\",\"joints\":[2]}").unwrap();
        assert_eq!(home.command(0b111), Some((Command::Home(0b100), "")));
        let home = of("{\"kind\":\"home\"}").unwrap();
        assert_eq!(home.command(0b111), Some((Command::Home(0b111), "")));
    }

    #[test]
    fn hold_and_abort_take_neither_the_seat_nor_more_than_leave_to_hold() {
        for order in [Order::Hold {}, Order::Abort {}] {
            assert_eq!((order.role(), order.takes_the_seat()), (Role::Hold, false));
        }
        for order in [
            Order::Resume {},
            Order::Enable {},
            Order::Home { joints: vec![] },
            Order::Mdi {
                line: String::new(),
            },
            Order::Sequence {
                name: String::new(),
                lines: vec![],
            },
            Order::FeedOverride { value: 1.0 },
        ] {
            assert_eq!(
                (order.role(), order.takes_the_seat()),
                (Role::Operate, true)
            );
        }
        for let_go in [
            Order::JogEnd { gesture: 1 },
            Order::ShuttleEnd { gesture: 1 },
        ] {
            assert!(!let_go.takes_the_seat());
        }
    }

    #[test]
    fn axes_are_those_of_the_machine() {
        let axes = [Axis::X, Axis::Z];
        let values = |text: &str| by_axis(&serde_json::from_str(text).unwrap(), &axes);
        let two = values("{\"X\":1,\"Z\":-2}").unwrap();
        assert!((two[0] - 1.0).abs() < 1e-12 && (two[2] + 2.0).abs() < 1e-12);
        assert_eq!(values("{\"Y\":1}"), None);
        assert_eq!(values("{\"x\":1}"), None);
    }
}
