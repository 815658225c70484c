//! `[machine.five-axis]`.

use super::ranges::OFFSET;
use crate::config::judge::values::Judge;
use crate::config::raw::{Optional, RawFiveAxis};
use glidepath_kinematics::{FiveAxis, Mechanism, Rotaries, Tilt};
use toml::Spanned;

impl Judge {
    pub(super) fn five_axis(&mut self, raw: &Spanned<RawFiveAxis>) -> Mechanism {
        let raw = raw.as_ref();
        let key = |name: &str| format!("machine.five-axis.{name}");
        let mut point = |name: &str, value: &Optional<[f64; 3]>| {
            self.three(&key(name), value, &OFFSET, [0.0; 3]).into()
        };
        let tilt_point = point("tilt_point", &raw.tilt_point);
        let rotary_point = point("rotary_point", &raw.rotary_point);
        let rotary_to_tilt = point("rotary_to_tilt", &raw.rotary_to_tilt);
        let tilt_to_spindle = point("tilt_to_spindle", &raw.tilt_to_spindle);
        let layouts = [
            (
                "table-table",
                Rotaries::TableTable {
                    tilt_point,
                    rotary_point,
                },
            ),
            (
                "head-head",
                Rotaries::HeadHead {
                    rotary_to_tilt,
                    tilt_to_spindle,
                },
            ),
            ("table-head", Rotaries::TableHead { rotary_point }),
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
