//! Programs at random: long moves and short ones, arcs and helices, corners of all angles, to the ends of travel and
//! to where the mechanism can go no further.

use super::machines::Machine;
use crate::support::random::Random;
use core::f64::consts::TAU;
use glidepath_geometry::{Axis, AxisVector};
use std::fmt::Write as _;

/// The longest that a move takes at its feedrate, s: slower feedrates are raised to that.
const LONGEST_T: f64 = 1.5;

/// The least that an axis moves, mm or degrees.
const LEAST_MM: f64 = 1e-4;

/// Writes one program, and knows where it has come to.
struct Author<'a> {
    machine: &'a Machine,
    random: Random,
    place: AxisVector,
    before: AxisVector,
    feed: f64,
    text: String,
}

/// A program of a machine, with the tolerance in it or not.
pub(crate) fn program(machine: &Machine, random: Random, tolerance: &str) -> String {
    let mut author = Author {
        machine,
        random,
        place: machine.home,
        before: machine.home,
        feed: 6000.0,
        text: format!("G21 G90 G94 G17 {tolerance} F6000\n"),
    };
    let parts = author.random.of(&[1, 2, 3, 4]);
    for _ in 0..parts {
        match author
            .random
            .of(&[0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5, 6, 7])
        {
            0 => author.lines(),
            1 => author.short_lines(),
            2 => author.zigzag(),
            3 => author.arc(),
            4 => author.chords(),
            5 => author.go_near_rim(),
            6 => author.turns(),
            _ => author.there_and_back(),
        }
    }
    author.text + "M2\n"
}

impl Author<'_> {
    /// A place somewhere in the travel, now and then at an end of it. Some axes stay where they are.
    fn somewhere(&mut self) -> AxisVector {
        let mut place = self.place;
        let moves_all = self.random.share() < 0.5;
        for (axis, low, high) in &self.machine.travel {
            if moves_all || self.random.share() < 0.5 {
                let inside = self.random.between(*low, *high);
                place[axis.index()] = self
                    .random
                    .of(&[inside, inside, inside, inside, *low, *high]);
            }
        }
        place
    }

    /// A place at most so far from here along every axis.
    fn nearby(&mut self, far: f64) -> AxisVector {
        let mut place = self.place;
        for (axis, ..) in &self.machine.travel {
            if self.random.share() < 0.7 {
                place[axis.index()] += self.random.between(-far, far);
            }
        }
        place
    }

    /// A word of feed for a move of so many mm or degrees, if it changes.
    fn feed_word(&mut self, length: f64) -> String {
        let drawn = self.random.of(&[
            self.feed, self.feed, self.feed, 300.0, 1500.0, 6000.0, 30_000.0, 2e5, 2e5, 2e5,
        ]);
        let feed = drawn.max(60.0 * length / LONGEST_T).ceil();
        if feed.to_bits() == self.feed.to_bits() {
            return String::new();
        }
        self.feed = feed;
        format!(" F{feed}")
    }

    /// Words for the axes that move.
    fn words(&self, to: &AxisVector) -> String {
        let mut words = String::new();
        for (axis, ..) in &self.machine.travel {
            let k = axis.index();
            if to[k].to_bits() != self.place[k].to_bits() {
                let _ = write!(words, " {axis}{}", to[k]);
            }
        }
        words
    }

    fn arrive(&mut self, to: AxisVector) {
        (self.before, self.place) = (self.place, to);
    }

    /// Goes straight to a place, if the machine may.
    fn line(&mut self, to: AxisVector, is_rapid: bool) -> bool {
        // An axis that moves by less than is programmed stays.
        let to = AxisVector::from_fn(|k, _| {
            let is_moved = (to[k] - self.place[k]).abs() > LEAST_MM;
            if is_moved {
                (to[k] * 1e5).round() / 1e5
            } else {
                self.place[k]
            }
        });
        let (from, way) = (self.place, to - self.place);
        let length = way.amax();
        if length <= 0.0 || !self.machine.may_go(length, |share| from + way * share) {
            return false;
        }
        let words = self.words(&to);
        let _ = if is_rapid {
            writeln!(self.text, "G0{words}")
        } else {
            let feed = self.feed_word(way.norm());
            writeln!(self.text, "G1{words}{feed}")
        };
        self.arrive(to);
        true
    }

    fn lines(&mut self) {
        for _ in 0..self.random.of(&[1, 2, 4]) {
            let is_rapid = self.random.share() < 0.3;
            for _ in 0..10 {
                let to = self.somewhere();
                if self.line(to, is_rapid) {
                    break;
                }
            }
        }
    }

    fn short_lines(&mut self) {
        let far = self.random.of(&[0.02, 0.3, 2.0, 8.0]);
        for _ in 0..self.random.of(&[3, 8]) {
            let to = self.nearby(far);
            let is_rapid = self.random.share() < 0.1;
            self.line(to, is_rapid);
        }
    }

    fn zigzag(&mut self) {
        let (step, tooth) = (
            self.random.of(&[0.2, 1.0, 4.0]),
            self.random.of(&[0.5, 4.0, 15.0]),
        );
        let angle = self.random.between(0.0, TAU);
        let along = Vec2::at(angle) * step;
        let across = Vec2::at(angle + 0.25 * TAU) * tooth;
        for k in 0..self.random.of(&[4, 8]) {
            let side = if k % 2 == 0 { across } else { across * -1.0 };
            let mut to = self.place;
            (to[0], to[1]) = (to[0] + along.0 + side.0, to[1] + along.1 + side.1);
            self.line(to, false);
        }
    }

    /// A circle drawn at random through the place: its centre from here, and how far round it, radians.
    fn circle(&mut self) -> (Vec2, f64) {
        let radius = self.random.of(&[0.05, 0.5, 3.0, 10.0, 40.0]) * self.random.between(0.7, 1.3);
        let angle = self.random.between(0.0, TAU);
        let turn = self.random.between(0.05, 0.98) * TAU;
        (Vec2::at(angle) * radius, self.random.of(&[turn, -turn]))
    }

    /// An arc, or a helix, with a rotary axis that may turn beside it.
    fn arc(&mut self) {
        for _ in 0..8 {
            let (centre, turn) = self.circle();
            let mut more = AxisVector::zeros();
            if self.random.share() < 0.4 {
                more[2] = self.random.between(-10.0, 10.0);
            }
            let is_turning = self.random.share() < 0.3;
            for (axis, ..) in &self.machine.travel {
                if axis.is_rotary() && is_turning {
                    more[axis.index()] = self.random.between(-20.0, 20.0);
                }
            }
            let more = more.map(|value| (value * 1e5).round() / 1e5);
            let from = self.place;
            let centre = Vec2(
                (centre.0 * 1e6).round() / 1e6,
                (centre.1 * 1e6).round() / 1e6,
            );
            let way = |share: f64| {
                let mut place = from + more * share;
                let out = centre.turned(share * turn) * -1.0;
                (place[0], place[1]) = (from[0] + centre.0 + out.0, from[1] + centre.1 + out.1);
                place
            };
            let length = turn.abs() * centre.0.hypot(centre.1);
            if !self.machine.may_go(length.max(more.amax()), way) {
                continue;
            }
            let to = way(1.0).map(|value| (value * 1e7).round() / 1e7);
            let code = if turn > 0.0 { "G3" } else { "G2" };
            let mut words = self.words(&to);
            // Both, so that the arc is no full circle where one of them stays.
            if to[0].to_bits() == from[0].to_bits() {
                let _ = write!(words, " X{}", to[0]);
            }
            let feed = self.feed_word(length);
            let _ = writeln!(self.text, "{code}{words} I{} J{}{feed}", centre.0, centre.1);
            self.arrive(to);
            break;
        }
    }

    /// An arc in chords.
    fn chords(&mut self) {
        let (centre, turn) = self.circle();
        let chord = self.random.of(&[0.05, 0.3, 1.0, 3.0]);
        let length = turn.abs() * centre.0.hypot(centre.1);
        let chords = (length / chord).ceil().clamp(2.0, 40.0);
        let from = self.place;
        let mut k = 1.0;
        while k <= chords {
            let out = centre.turned(turn * k / chords) * -1.0;
            let mut to = self.place;
            (to[0], to[1]) = (from[0] + centre.0 + out.0, from[1] + centre.1 + out.1);
            if !self.line(to, false) {
                break;
            }
            k += 1.0;
        }
    }

    /// Towards where the mechanism, or the travel, ends: nearly to it, along it a little, and away again.
    fn go_near_rim(&mut self) {
        let from = self.place;
        let mut aim = self.somewhere() - from;
        let far = aim.amax();
        if far <= 0.0 {
            return;
        }
        aim *= 1000.0 / far;
        let (mut inside, mut outside) = (0.0, 1.0);
        for step in 1..=2000 {
            let share = f64::from(step) / 2000.0;
            if self.machine.may_stand(&(from + aim * share)) {
                inside = share;
            } else {
                outside = share;
                break;
            }
        }
        for _ in 0..40 {
            let middle = 0.5 * (inside + outside);
            if self.machine.may_stand(&(from + aim * middle)) {
                inside = middle;
            } else {
                outside = middle;
            }
        }
        let left_mm = self.random.of(&[0.001, 0.05, 1.0, 10.0]);
        let is_rapid = self.random.share() < 0.3;
        let is_there = self.line(from + aim * (inside - left_mm / 1000.0).max(0.0), is_rapid);
        if is_there && self.random.share() < 0.6 {
            let to = self.nearby(5.0);
            self.line(to, false);
        }
    }

    /// Rotary axes alone, if there are some.
    fn turns(&mut self) {
        for _ in 0..self.random.of(&[1, 3]) {
            let mut to = self.place;
            let far = self.random.of(&[0.5, 5.0, 60.0]);
            for (axis, ..) in &self.machine.travel {
                if axis.is_rotary() {
                    to[axis.index()] += self.random.between(-far, far);
                }
            }
            let is_rapid = self.random.share() < 0.2;
            self.line(to, is_rapid);
        }
    }

    fn there_and_back(&mut self) {
        let to = self.somewhere();
        if self.line(to, false) {
            let back = self.before;
            self.line(back, false);
        }
    }
}

/// A vector in the plane.
#[derive(Clone, Copy)]
struct Vec2(f64, f64);

impl Vec2 {
    fn at(angle: f64) -> Self {
        let (sin, cos) = angle.sin_cos();
        Self(cos, sin)
    }

    fn turned(self, angle: f64) -> Self {
        let (sin, cos) = angle.sin_cos();
        Self(cos * self.0 - sin * self.1, sin * self.0 + cos * self.1)
    }
}

impl core::ops::Mul<f64> for Vec2 {
    type Output = Self;

    fn mul(self, factor: f64) -> Self {
        Self(self.0 * factor, self.1 * factor)
    }
}

/// The axes of a machine.
pub(crate) fn axes(machine: &Machine) -> Vec<Axis> {
    machine.travel.iter().map(|(axis, ..)| *axis).collect()
}
