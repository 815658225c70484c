//! `[link]`: the name of the machine's shared memory.

use super::values::Judge;
use crate::config::diagnostic::ConfigDiagnostic;
use crate::config::instance::{INSTANCE_RULE, is_instance_name};
use crate::config::raw::RawLink;

impl Judge {
    pub(super) fn instance(&mut self, raw: RawLink) -> Option<String> {
        let instance = raw.instance?;
        let span = instance.span();
        let name = instance.into_inner();
        if !is_instance_name(&name) {
            self.diagnostics.push(ConfigDiagnostic {
                key: "link.instance".to_owned(),
                message: format!("link.instance = \"{name}\" cannot name a machine"),
                help: Some(INSTANCE_RULE.to_owned()),
                span: Some(span),
            });
        }
        Some(name)
    }
}
