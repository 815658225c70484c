//! `[machine]`: how axes and joints belong together.

mod deltas;
mod five_axis;
mod five_bar;
mod hexapods;
mod ranges;
mod scara;

use super::values::Judge;
use crate::config::diagnostic::ConfigDiagnostic;
use crate::config::raw::{Optional, RawMachine};
use core::ops::Range as Bytes;
use glidepath_geometry::Axis;
use glidepath_kinematics::{AxisList, CoreXy, Mechanism, Trivial};
use toml::Spanned;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    Trivial,
    CoreXy,
    LinearDelta,
    RotaryDelta,
    Scara,
    FiveBar,
    FiveAxis,
    Hexapod,
    Translational,
}

const KINDS: [(&str, Kind); 9] = [
    ("trivial", Kind::Trivial),
    ("corexy", Kind::CoreXy),
    ("linear-delta", Kind::LinearDelta),
    ("rotary-delta", Kind::RotaryDelta),
    ("scara", Kind::Scara),
    ("five-bar", Kind::FiveBar),
    ("five-axis", Kind::FiveAxis),
    ("hexapod", Kind::Hexapod),
    ("translational-hexapod", Kind::Translational),
];

/// The table of a mechanism in a file.
enum Table {
    Given(Bytes<usize>),
    LeftOut,
    /// The mechanism has no dimensions.
    NotNeeded,
}

impl Kind {
    fn table(self, raw: &RawMachine) -> Table {
        fn of<T>(table: &Optional<T>) -> Table {
            let span = table.as_ref().map(Spanned::span);
            span.map_or(Table::LeftOut, Table::Given)
        }
        match self {
            Self::Trivial | Self::CoreXy => Table::NotNeeded,
            Self::LinearDelta => of(&raw.linear_delta),
            Self::RotaryDelta => of(&raw.rotary_delta),
            Self::Scara => of(&raw.scara),
            Self::FiveBar => of(&raw.five_bar),
            Self::FiveAxis => of(&raw.five_axis),
            Self::Hexapod => of(&raw.hexapod),
            Self::Translational => of(&raw.translational_hexapod),
        }
    }
}

impl Judge {
    /// The mechanism; one of its own choice, with a diagnostic, if the file describes none.
    pub(super) fn mechanism(&mut self, raw: &RawMachine, axes: &[Axis]) -> Mechanism {
        let at = raw.kinematics.as_ref().map(Spanned::span);
        let kind = self.choice("machine.kinematics", raw.kinematics.clone(), &KINDS);
        self.tables_of(raw, kind, at.clone());
        let found = match kind {
            Kind::Trivial => None,
            Kind::CoreXy => Some(Mechanism::CoreXy(CoreXy::new(axes))),
            Kind::LinearDelta => raw
                .linear_delta
                .as_ref()
                .map(|raw| self.linear_delta(raw, axes)),
            Kind::RotaryDelta => raw.rotary_delta.as_ref().map(|raw| self.rotary_delta(raw)),
            Kind::Scara => raw.scara.as_ref().map(|raw| self.scara(raw)),
            Kind::FiveBar => raw.five_bar.as_ref().map(|raw| self.five_bar(raw, axes)),
            Kind::FiveAxis => raw.five_axis.as_ref().map(|raw| self.five_axis(raw)),
            Kind::Hexapod => raw.hexapod.as_ref().map(|raw| self.hexapod(raw)),
            Kind::Translational => raw
                .translational_hexapod
                .as_ref()
                .map(|raw| self.translational(raw)),
        };
        let mechanism = found.unwrap_or(Mechanism::Trivial(Trivial::new(AxisList::new(axes))));
        self.axes_of(&mechanism, axes, at);
        mechanism
    }

    /// Whether the file has the table of its mechanism, and none of another.
    fn tables_of(&mut self, raw: &RawMachine, kind: Kind, at: Option<Bytes<usize>>) {
        for (name, of) in KINDS {
            match of.table(raw) {
                Table::Given(span) if of != kind => self.diagnostics.push(ConfigDiagnostic {
                    key: format!("machine.{name}"),
                    message: format!("[machine.{name}] describes another machine"),
                    help: Some(format!("remove it, or choose it: kinematics = \"{name}\"")),
                    span: Some(span),
                }),
                Table::LeftOut if of == kind => self.diagnostics.push(ConfigDiagnostic {
                    key: format!("machine.{name}"),
                    message: format!("the table [machine.{name}] is missing"),
                    help: Some("add it with the lengths of the mechanism".to_owned()),
                    span: at.clone(),
                }),
                Table::Given(_) | Table::LeftOut | Table::NotNeeded => {}
            }
        }
    }

    /// Whether the machine has the axes its mechanism moves, and no others.
    fn axes_of(&mut self, mechanism: &Mechanism, axes: &[Axis], at: Option<Bytes<usize>>) {
        use Axis::{A, B, C, X, Y, Z};
        let (wanted, may_have_more): (&[Axis], bool) = match mechanism {
            Mechanism::Trivial(_) => return,
            Mechanism::CoreXy(_) | Mechanism::FiveBar(_) => (&[X, Y], true),
            Mechanism::LinearDelta(_) => (&[X, Y, Z], true),
            Mechanism::FiveAxis(machine) if machine.tilt_axis() == A => (&[X, Y, Z, A, C], false),
            Mechanism::FiveAxis(_) => (&[X, Y, Z, B, C], false),
            Mechanism::Scara(_) => (&[X, Y, Z, C], false),
            Mechanism::Hexapod(_) => (&[X, Y, Z, A, B, C], false),
            Mechanism::RotaryDelta(_) | Mechanism::Translational(_) => (&[X, Y, Z], false),
        };
        let missing = wanted.iter().find(|axis| !axes.contains(axis));
        let foreign = axes.iter().find(|axis| !wanted.contains(axis));
        let message = match (missing, foreign.filter(|_| !may_have_more)) {
            (Some(axis), _) => format!("the axis {axis} of this mechanism is missing"),
            (None, Some(axis)) => format!("the mechanism does not move the axis {axis}"),
            (None, None) => return,
        };
        let list: Vec<String> = wanted.iter().map(ToString::to_string).collect();
        self.diagnostics.push(ConfigDiagnostic {
            key: "axis".to_owned(),
            message,
            help: Some(format!("give the axes {}", list.join(" "))),
            span: at,
        });
    }
}
