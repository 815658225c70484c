//! `[machine.scara]`.

use super::ranges::{LENGTH, OFFSET};
use crate::config::judge::values::Judge;
use crate::config::raw::RawScara;
use glidepath_kinematics::{Elbow, Mechanism, Scara};
use toml::Spanned;

impl Judge {
    pub(super) fn scara(&mut self, raw: &Spanned<RawScara>) -> Mechanism {
        let raw = raw.as_ref();
        let key = |name: &str| format!("machine.scara.{name}");
        let elbows = [("positive", Elbow::Positive), ("negative", Elbow::Negative)];
        Mechanism::Scara(Scara {
            upper_arm_mm: self.number(&key("upper_arm"), &raw.upper_arm, &LENGTH),
            forearm_mm: self.number(&key("forearm"), &raw.forearm, &LENGTH),
            tool_mm: self.number_or(&key("tool"), &raw.tool, &OFFSET, 0.0),
            height_mm: self.number_or(&key("height"), &raw.height, &OFFSET, 0.0),
            elbow: self.choice(&key("elbow"), raw.elbow.clone(), &elbows),
        })
    }
}
