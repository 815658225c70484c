//! The world of a case: an interpolator that ticks, and a case that looks at it, at every period of the wire.

use super::case::{Case, Hands, Wants};
use super::life::{Life, Queue, plan};
use super::setup::PERIOD_NS;
use crate::wire::{Fate, World};
use core::cell::{Cell, RefCell};
use core::sync::atomic::{AtomicBool, Ordering};
use glidepath_emulator::Segment;
use glidepath_ethercat::Event;
use glidepath_geometry::AxisVector;
use glidepath_link::{Auxiliary, CommandRequest, Feedback, Setpoint, SetpointFrame, Status};
use std::collections::VecDeque;
use std::rc::Rc;

/// The most frames that are offered ahead of what is executed.
const HORIZON: u64 = 150;

pub(super) struct Reality<'c, 's> {
    pub(super) lives: [Option<Life<'s>>; 2],
    pub(super) lives_now: bool,
    pub(super) case: &'c mut dyn Case,
    pub(super) queue: Queue,
    pub(super) auxiliary: rtrb::Producer<Auxiliary>,
    pub(super) records: rtrb::Consumer<Feedback>,
    pub(super) happened: rtrb::Consumer<Event>,
    pub(super) events: Rc<RefCell<Vec<Event>>>,
    pub(super) stop: Rc<AtomicBool>,
    pub(super) killed: Rc<Cell<bool>>,
    pub(super) start_ns: u64,
    pub(super) feed: VecDeque<SetpointFrame>,
    pub(super) epoch: u64,
    pub(super) sent: u64,
    pub(super) tick: u64,
    pub(super) last: Option<Setpoint>,
    pub(super) status: Option<Status>,
    pub(super) feedback: Option<Feedback>,
    pub(super) said: Option<Auxiliary>,
    pub(super) paused: u64,
    pub(super) setpoints: Rc<RefCell<Vec<Setpoint>>>,
}

impl World for Reality<'_, '_> {
    fn pass(&mut self, now_ns: u64, segment: &mut Segment) -> u64 {
        self.tick += 1;
        while let Ok(event) = self.happened.pop() {
            self.events.borrow_mut().push(event);
        }
        let current = if self.lives_now {
            self.lives[0].as_mut()
        } else {
            None
        };
        let mut newest = None;
        while let Ok(feedback) = self.records.pop() {
            newest = Some(feedback);
        }
        if let (Some(life), Some(feedback)) = (current, newest) {
            life.feedback.publish(&feedback).unwrap();
        }
        self.feedback = newest.or(self.feedback);
        let events = self.events.borrow().clone();
        let mut hands = Hands {
            now_ns,
            tick: self.tick,
            last: self.last,
            status: self.status,
            events: &events,
            feedback: self.feedback,
            auxiliary: self.said,
            wants: Wants::default(),
        };
        self.case.tick(&mut hands, segment);
        let wants = hands.wants;
        self.obey(wants);
        if self.paused > 0 {
            self.paused -= 1;
        } else {
            self.interpolate(now_ns);
        }
        self.start_ns + self.tick * PERIOD_NS
    }

    fn fate(&mut self, now_ns: u64) -> Fate {
        if self.killed.get() {
            return Fate::LostOnTheWay;
        }
        self.case.fate(now_ns)
    }

    fn counts(&self) -> bool {
        // Cycles run, and not the bringing up of the bus.
        self.feedback.is_some() && self.case.counts()
    }
}

impl Reality<'_, '_> {
    fn obey(&mut self, wants: Wants) {
        if wants.end {
            self.stop.store(true, Ordering::Relaxed);
        }
        if wants.killed {
            self.killed.set(true);
            self.stop.store(true, Ordering::Relaxed);
        }
        self.paused += wants.pause.unwrap_or(0);
        match wants.interpolator {
            Some(false) => self.lives_now = false,
            Some(true) => {
                // The one before is dead; another one takes its place.
                self.lives.swap(0, 1);
                self.lives_now = true;
                self.feed.clear();
                self.last = None;
                self.epoch = 0;
            }
            None => {}
        }
        if let Some(text) = wants.program {
            let start = self
                .last
                .map_or_else(AxisVector::zeros, |s| s.position.into());
            self.epoch += 1;
            self.feed = plan(text, start, self.epoch).into();
            self.sent = 0;
        }
        if let (Some(command), Some(life)) = (wants.command, &mut self.lives[0]) {
            life.client
                .ask(&CommandRequest::new(1, 1, command))
                .unwrap();
        }
    }

    fn interpolate(&mut self, now_ns: u64) {
        let Some(life) = self.lives[0].as_mut().filter(|_| self.lives_now) else {
            return;
        };
        let executed = self
            .last
            .filter(|s| s.epoch == self.epoch)
            .map_or(0, |s| s.sequence);
        while self.sent < executed + HORIZON
            && let Some(frame) = self.feed.front()
        {
            life.frames.offer(frame).unwrap();
            self.feed.pop_front();
            self.sent += 1;
        }
        let setpoint = (life.tick)(now_ns);
        while life.client.reply().unwrap().is_some() {}
        while let Some(status) = life.statuses.take().unwrap() {
            self.status = Some(status);
        }
        while let Some(record) = life.auxiliary.take().unwrap() {
            // Who has no terminals does not listen.
            let _ = self.auxiliary.push(record);
            self.said = Some(record);
        }
        while let Some(setpoint) = life.setpoints.take().unwrap() {
            self.queue.borrow_mut().push_back(setpoint);
        }
        self.last = Some(setpoint);
        self.setpoints.borrow_mut().push(setpoint);
    }
}
