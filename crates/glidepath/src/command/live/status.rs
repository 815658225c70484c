//! The status as pages are told it: that of the machine, with what the server knows besides.

use super::pages::clock_ms;
use super::{Machine, OLD_NS};
use crate::command::failure::Failure;
use crate::output;
use crate::report::{AwaitedEvent, View, active_object, status_object, view_object};
use glidepath_link::{ActiveProgram, Auxiliary, Coolant, InterpolatorProcess, SpindleState};
use glidepath_realtime::{Clock as _, Monotonic};
use serde_json::{Value, json};
use std::sync::PoisonError;
use std::time::Instant;

use super::day::now_ms;

impl Machine<'_> {
    /// What the page is told; nothing while nobody knows what the machine does.
    pub(super) fn object(&mut self) -> Result<Option<Value>, Failure> {
        let now_ns = Monotonic.now_ns();
        let fresh = self
            .status
            .filter(|status| now_ns.saturating_sub(status.updated_ns) < OLD_NS);
        let Some(status) = fresh else {
            let lives = match InterpolatorProcess::find(&self.link)? {
                Some(process) => process.lives()?,
                None => false,
            };
            // One that lives and says nothing is told by the age of what it said last.
            return Ok((!lives).then(|| {
                self.log.ended();
                json!({
                    "state": "none",
                    "clock_ms": clock_ms(),
                    "version": self.shown.version(),
                    "place": Value::Null,
                    "log": self.log.object(),
                })
            }));
        };
        self.following.look(&status);
        let place = self.following.place(&status);
        let in_plan = place.as_ref().and_then(|place| place.elapsed_t);
        let planned = self.following.frames();
        let view = View {
            instance: &self.instance,
            status: &status,
            auxiliary: self.auxiliary.as_ref(),
            asked: AwaitedEvent::default(),
            axes: &self.config.axis_names(),
            not_homed: &self.config.axes_not_homed(&status),
            place,
            offsets: self.offsets.look(&status),
            events: Vec::new(),
        };
        let period_t = self.config.period_t();
        #[allow(clippy::cast_precision_loss, reason = "counts of frames are exact")]
        let planned_t = planned as f64 * period_t;
        let mut object = status_object(&self.instance, &status, &view.asked);
        if let Value::Object(object) = &mut object {
            object.extend(view_object(&view));
            object.remove("events");
            let boot = format!("{:016x}", status.boot_id);
            object.insert("boot".to_owned(), boot.into());
            object.insert("clock_ms".to_owned(), clock_ms().into());
            object.insert("seat".to_owned(), self.seat_object());
            object.insert("set_up".to_owned(), self.set_up.version().into());
            let jobs = self.jobs.as_ref().map(|jobs| jobs.object());
            object.insert("page_jobs".to_owned(), jobs.unwrap_or_default());
            let moves = self.moves.as_ref().map(|moves| moves.object());
            object.insert("shuttle".to_owned(), moves.unwrap_or_default());
            self.jobs.iter().for_each(|jobs| self.queue.look(jobs));
            object.insert("queue".to_owned(), self.queue.object());
            let steps = self.steps.as_ref().map(|steps| steps.object());
            object.insert("page_steps".to_owned(), steps.unwrap_or_default());
            let name = self.following.active().map(ActiveProgram::name);
            if let Some(ended) = self.day.take(&status, name.as_deref(), now_ms()) {
                let seen = self.witness.object(&ended.epochs);
                self.certificates
                    .certify(ended, seen, self.following.plan(&status));
            }
            object.insert("day".to_owned(), self.day.object());
            object.insert("version".to_owned(), self.shown.version().into());
            object.insert("generation".to_owned(), self.shown.generation().into());
            let place = in_plan.map(|elapsed_t| elapsed_t / period_t);
            object.insert("place".to_owned(), place.into());
            object.insert("planned_so_far_s".to_owned(), planned_t.into());
            let spindle = self.auxiliary.as_ref().map(spindle);
            object.insert("spindle".to_owned(), spindle.unwrap_or(Value::Null));
            object.insert("lateness_histogram".to_owned(), self.histogram.object());
            object.insert("receivers".to_owned(), self.receivers.clone());
            object.insert("log".to_owned(), self.log.object());
            let active = active_object(self.following.active());
            object.insert("active_program".to_owned(), active);
            let is_shown = self.following.is_of(&status);
            object.insert("program_is_shown".to_owned(), is_shown.into());
            object.insert("asked".to_owned(), self.asked.object(&status));
        }
        Ok(Some(object))
    }

    /// Takes what happened to devices into the log, and says so.
    pub(super) fn hear_of_devices(&mut self) {
        for (kind, text) in self.devices.iter().flat_map(|devices| devices.told()) {
            output::note(&format!("live: {text}"));
            self.log.add(kind, text);
        }
    }

    /// Whether a page operates, and whether another one wants to. Which ones is nobody else's business.
    fn seat_object(&self) -> Value {
        let mut seat = self.seat.lock().unwrap_or_else(PoisonError::into_inner);
        let [holder, asking] = seat.who(Instant::now());
        json!({ "is_taken": holder.is_some(), "is_asked_for": asking.is_some() })
    }
}

/// What spindle and coolant were told.
fn spindle(told: &Auxiliary) -> Value {
    let turns = match told.spindle() {
        Ok(SpindleState::Clockwise) => "clockwise",
        Ok(SpindleState::Counterclockwise) => "counterclockwise",
        Ok(SpindleState::Oriented) => "oriented",
        Ok(SpindleState::Stopped) | Err(_) => "off",
    };
    let (mist, flood) = (Coolant::MIST, Coolant::FLOOD);
    let coolant = match (
        told.coolant().contains(mist),
        told.coolant().contains(flood),
    ) {
        (false, false) => "",
        (true, false) => "mist",
        (false, true) => "flood",
        (true, true) => "mist and flood",
    };
    json!({
        "speed": told.spindle_rpm(),
        "programmed": told.spindle_speed,
        "turns": turns,
        "coolant": coolant,
        "override": told.spindle_override,
        "is_override_locked": told.is_spindle_override_locked(),
    })
}
