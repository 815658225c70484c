//! `[machine.five-axis]`.

use super::ranges::{OFFSET, PART};
use crate::config::diagnostic::ConfigDiagnostic;
use crate::config::judge::values::Judge;
use crate::config::raw::{Optional, RawFiveAxis};
use glidepath_geometry::Axis;
use glidepath_kinematics::{FiveAxis, Mechanism, Rotaries, SkewedTilt, Tilt};
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
        let tilt = self.choice(&key("tilt"), Some(raw.tilt.clone()), &tilts);
        Mechanism::FiveAxis(FiveAxis {
            rotaries,
            tilt: self.direction_of_tilt(tilt, &raw.tilt_direction),
            tilt_reversed: raw.tilt_reversed,
            rotary_reversed: raw.rotary_reversed,
            tool_mm: self.number(&key("tool"), &raw.tool, &OFFSET),
        })
    }

    /// The tilt about the direction that the file gives, if it gives one.
    fn direction_of_tilt(&mut self, tilt: Tilt, value: &Optional<[f64; 3]>) -> Tilt {
        const KEY: &str = "machine.five-axis.tilt_direction";
        let Some(given) = value else {
            return tilt;
        };
        let before = self.diagnostics.len();
        let direction = self.three(KEY, value, &PART, [0.0; 3]);
        if self.diagnostics.len() > before {
            return tilt;
        }
        // Along x or y it is no other machine than without the key.
        let [x, y, z] = direction;
        let is_plain = match tilt.axis() {
            Axis::A => x > 0.0 && y.hypot(z) <= 0.0,
            _ => y > 0.0 && x.hypot(z) <= 0.0,
        };
        if is_plain {
            return tilt;
        }
        match SkewedTilt::new(tilt.axis(), &direction.into()) {
            Some(skewed) => Tilt::Skewed(skewed),
            None => {
                self.diagnostics.push(ConfigDiagnostic {
                    key: KEY.to_owned(),
                    message: format!("{KEY} = [{x}, {y}, {z}] tilts nothing"),
                    help: Some(
                        "give a direction that is at least 5° from Z, the axis of C; [0, 1, 1] is 45° between Y and Z"
                            .to_owned(),
                    ),
                    span: Some(given.span()),
                });
                tilt
            }
        }
    }
}
