//! The feedback of drives: taken, judged, and told to the real-time thread.

use super::Ports;
use glidepath_link::LinkError;

/// Records of feedback taken in one turn: those of nine stacks at 2 kHz and 4 ms.
const FEEDBACK_PER_TURN: usize = 72;

impl Ports<'_> {
    pub(super) fn take_feedback(&mut self, now_ns: u64) -> Result<(), LinkError> {
        for _ in 0..FEEDBACK_PER_TURN {
            let (Some(source), Some(drives)) = (&mut self.links.feedback, &mut self.drives) else {
                return Ok(());
            };
            let Some(feedback) = source.take()? else {
                return Ok(());
            };
            let (Ok(told) | Err(told)) = drives.take(&feedback, now_ns);
            if !told.is_empty() {
                self.tell(&told);
            }
        }
        Ok(())
    }

    /// Tells the real-time thread what the drives say, and judges how they follow.
    pub(super) fn observe(&mut self, now_ns: u64) -> Result<(), LinkError> {
        let (Some(drives), Some(report)) = (&mut self.drives, &self.report) else {
            return Ok(());
        };
        let observation = drives.observe(report, now_ns);
        // A full ring says that the real-time thread does not run; there is nobody to be told.
        self.ends.observations.enqueue(observation).ok();
        let news = drives.take_news();
        let (order, told) = drives.judge(report);
        for order in [order, drives.advance_homing(report, now_ns)]
            .into_iter()
            .flatten()
        {
            self.ends.order(order);
        }
        if let Some(told) = told {
            self.tell(&told);
        }
        if let Some(news) = news {
            self.tell(news);
        }
        Ok(())
    }
}
