//! The certificates of the jobs that are over: figures of each, for a page to keep.

use super::day::Ended;
use serde_json::Value;
use std::collections::VecDeque;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Certificates that are remembered: of as many jobs as pages are told.
const KEPT: usize = 100;

/// Certificates by the numbers of their jobs.
#[derive(Debug, Default)]
pub(super) struct Certificates(Mutex<VecDeque<(u64, Value)>>);

impl Certificates {
    fn all(&self) -> MutexGuard<'_, VecDeque<(u64, Value)>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Keeps that of a job that has just ended: what its status told, what its setpoints were, and what is known of its
    /// plan. Without setpoints there is none.
    pub(super) fn certify(&self, ended: Ended, seen: Option<Value>, plan: Value) {
        let Some(seen) = seen else {
            return;
        };
        let mut certificate = ended.certificate;
        certificate["seen"] = seen;
        certificate["plan"] = plan;
        let mut all = self.all();
        all.push_front((ended.number, certificate));
        all.truncate(KEPT);
    }

    /// That of a job; `None` if there is none, or none any more.
    pub(super) fn of(&self, job: u64) -> Option<Value> {
        let all = self.all();
        let found = all.iter().find(|(number, _)| *number == job);
        found.map(|(_, certificate)| certificate.clone())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn the_last_ones_are_remembered() {
        let certificates = Certificates::default();
        let ended = |number| Ended {
            number,
            epochs: 1..=1,
            certificate: json!({ "name": "part.ngc" }),
        };
        certificates.certify(ended(999), None, Value::Null);
        assert_eq!(certificates.of(999), None, "nothing was seen of it");
        for job in 0..=KEPT as u64 {
            certificates.certify(ended(job), Some(job.into()), Value::Null);
        }
        assert_eq!(certificates.of(0), None);
        for job in [1, KEPT as u64] {
            let told = certificates.of(job).unwrap();
            assert_eq!(
                (&told["seen"], &told["name"]),
                (&job.into(), &"part.ngc".into())
            );
        }
    }
}
