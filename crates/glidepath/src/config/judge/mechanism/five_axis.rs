//! `[machine.five-axis]`.

use super::ranges::OFFSET;
use crate::config::judge::values::Judge;
use crate::config::raw::RawFiveAxis;
use glidepath_kinematics::{FiveAxis, Mechanism, Rotaries, Tilt};
use toml::Spanned;

impl Judge {
    pub(super) fn five_axis(&mut self, raw: &Spanned<RawFiveAxis>) -> Mechanism {
        let raw = raw.as_ref();
        let key = |name: &str| format!("machine.five-axis.{name}");
        let layouts = [
            (
                "table-table",
                Rotaries::TableTable {
                    tilt_point: raw.tilt_point.into(),
                    rotary_point: raw.rotary_point.into(),
                },
            ),
            (
                "head-head",
                Rotaries::HeadHead {
                    rotary_to_tilt: raw.rotary_to_tilt.into(),
                    tilt_to_spindle: raw.tilt_to_spindle.into(),
                },
            ),
            (
                "table-head",
                Rotaries::TableHead {
                    rotary_point: raw.rotary_point.into(),
                },
            ),
        ];
        let rotaries = self.choice(&key("layout"), Some(raw.layout.clone()), &layouts);
        let tilts = [("A", Tilt::A), ("B", Tilt::B)];
        Mechanism::FiveAxis(FiveAxis {
            rotaries,
            tilt: self.choice(&key("tilt"), Some(raw.tilt.clone()), &tilts),
            tilt_reversed: raw.tilt_reversed,
            rotary_reversed: raw.rotary_reversed,
            tool_mm: self.number(&key("tool"), &raw.tool, &OFFSET),
        })
    }
}
