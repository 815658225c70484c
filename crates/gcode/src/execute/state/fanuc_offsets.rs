//! The offsets that FANUC's and Haas' controls have beside G54 to G59 and the tool table.

use std::collections::BTreeMap;

use glidepath_geometry::{Axis, AxisVector, Plane};
use serde::{Deserialize, Serialize};

use crate::execute::state::frame::Frame;
use crate::setup::work_offsets::CoordinateSystem;

/// Wear of a tool: what is added to the offsets of the table, mm.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub(crate) struct Wear {
    pub(crate) length_mm: f64,
    pub(crate) radius_mm: f64,
    /// Along X of a lathe, as a radius.
    #[serde(default)]
    pub(crate) x_mm: f64,
}

/// Offsets beside those of every control.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub(crate) struct FanucOffsets {
    /// Added to the origin of every coordinate system (G10 L2 P0, `#5201`).
    pub(crate) external: AxisVector,
    /// The local offset (G52), beside that of G92.
    #[serde(default = "AxisVector::zeros")]
    pub(crate) local: AxisVector,
    /// G54.1 P1 and on, those that were set.
    pub(crate) extended: BTreeMap<u32, CoordinateSystem>,
    /// The one of them in force.
    pub(crate) active: Option<u32>,
    pub(crate) wear: BTreeMap<u32, Wear>,
    /// Where the table has taken the zero of the program from (G254 of Haas).
    pub(crate) dynamic: Option<AxisVector>,
    /// Coordinate systems of SINUMERIK that change with their next code.
    #[serde(skip)]
    pub(crate) pending: BTreeMap<usize, CoordinateSystem>,
    /// What G51, G51.1 and G68 have begun.
    #[serde(skip)]
    pub(crate) frames: FanucFrames,
    /// Where the tool was when G68 began.
    #[serde(skip)]
    pub(crate) before_turn: Option<BeforeTurn>,
}

/// Where the tool was when the program's coordinates were turned, mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct BeforeTurn {
    pub(crate) plane: Plane,
    pub(crate) machine: AxisVector,
    /// In the coordinates before.
    pub(crate) program: AxisVector,
}

impl FanucOffsets {
    /// The system in force that is none of G54 to G59. What was not set is the machine's own.
    pub(crate) fn system(&self) -> Option<&CoordinateSystem> {
        self.extended.get(&self.active?)
    }

    /// What is added to the origin of every coordinate system.
    pub(crate) fn added(&self) -> AxisVector {
        let dynamic = self.dynamic.unwrap_or_else(AxisVector::zeros);
        self.external + self.local + dynamic
    }

    pub(crate) fn wear(&self, number: u32) -> Wear {
        self.wear.get(&number).copied().unwrap_or_default()
    }
}

/// Where a coordinate system is kept that the machine does not keep, by its index: behind those of
/// G54.1.
pub(crate) fn system_key(index: usize) -> u32 {
    u32::try_from(index).unwrap_or(u32::MAX - FIRST_KEY) + FIRST_KEY
}

/// Numbers from here on are those of systems that the machine does not keep.
pub(crate) const FIRST_KEY: u32 = 1000;

/// A scale about a point, mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Scale {
    pub(crate) about: [f64; 3],
    pub(crate) factors: [f64; 3],
}

/// A turn in a plane about a point, mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Turn {
    pub(crate) plane: Plane,
    pub(crate) about: [f64; 3],
    pub(crate) degrees: f64,
}

/// Scale, mirror image and turn, each as long as it is in force.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct FanucFrames {
    pub(crate) scale: Option<Scale>,
    /// At which coordinate each axis is mirrored.
    pub(crate) mirror: [Option<f64>; 3],
    pub(crate) turn: Option<Turn>,
}

/// A frame about a point.
fn about(point: [f64; 3], frame: &Frame) -> Frame {
    let shift = |sign: f64| {
        let mut way = AxisVector::zeros();
        for (axis, place) in point.into_iter().enumerate() {
            way[axis] = sign * place;
        }
        Frame::shifted(way)
    };
    shift(1.0).with(frame).with(&shift(-1.0))
}

impl FanucFrames {
    /// What they make of the program's coordinates: they are scaled first, then turned about a centre that is
    /// scaled too. What a mirror image makes of it goes the other way round, its turn included.
    pub(crate) fn frame(&self) -> Frame {
        let mut frame = Frame::default();
        if let Some(scale) = self.scale {
            frame = about(scale.about, &Frame::scaled(scale.factors));
        }
        if let Some(turn) = self.turn {
            let mut point = AxisVector::zeros();
            for (axis, place) in turn.about.into_iter().enumerate() {
                point[axis] = place;
            }
            let point = frame.apply(point);
            let mut degrees = [0.0; 3];
            let normal: Axis = turn.plane.normal();
            if let Some(slot) = degrees.get_mut(normal.index()) {
                *slot = turn.degrees * self.sense(turn.plane);
            }
            frame = about([point[0], point[1], point[2]], &Frame::turned(degrees)).with(&frame);
        }
        for (axis, at) in self.mirror.into_iter().enumerate() {
            if let Some(at) = at {
                let (mut point, mut factors) = ([0.0; 3], [1.0; 3]);
                (point[axis], factors[axis]) = (at, -1.0);
                frame = about(point, &Frame::scaled(factors)).with(&frame);
            }
        }
        frame
    }

    /// Below zero where a scale below zero mirrors one axis of a plane.
    fn sense(&self, plane: Plane) -> f64 {
        let factor = |axis: Axis| {
            let factors = self.scale.map(|scale| scale.factors);
            let factor = factors.and_then(|factors| factors.get(axis.index()).copied());
            factor.unwrap_or(1.0).signum()
        };
        let (first, second) = plane.axes();
        factor(first) * factor(second)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn point(x: f64, y: f64) -> AxisVector {
        let mut point = AxisVector::zeros();
        (point[0], point[1]) = (x, y);
        point
    }

    #[test]
    fn scale_comes_before_turn_and_its_centre_is_scaled_too() {
        let frames = FanucFrames {
            scale: Some(Scale {
                about: [10.0, 0.0, 0.0],
                factors: [2.0; 3],
            }),
            mirror: [None; 3],
            turn: Some(Turn {
                plane: Plane::Xy,
                about: [20.0, 0.0, 0.0],
                degrees: 90.0,
            }),
        };
        // (25, 0) becomes (40, 0), turned about (30, 0): (30, 10).
        let made = frames.frame().apply(point(25.0, 0.0));
        assert!((made - point(30.0, 10.0)).norm() < 1e-12, "{made}");
    }

    #[test]
    fn a_mirror_image_is_about_its_coordinate() {
        let frames = FanucFrames {
            mirror: [Some(20.0), None, None],
            ..FanucFrames::default()
        };
        assert_eq!(frames.frame().apply(point(5.0, 3.0)), point(35.0, 3.0));
    }

    #[test]
    fn a_mirror_image_turns_the_other_way_round() {
        let turn = Some(Turn {
            plane: Plane::Xy,
            about: [10.0, 0.0, 0.0],
            degrees: 90.0,
        });
        let mirrored = FanucFrames {
            mirror: [Some(20.0), None, None],
            turn,
            ..FanucFrames::default()
        };
        // (15, 1) is mirrored to (25, 1), and turned by −90° about (30, 0), the image of the centre.
        let made = mirrored.frame().apply(point(15.0, 1.0));
        assert!((made - point(31.0, 5.0)).norm() < 1e-12, "{made}");
        // The same by a scale below zero.
        let scaled = FanucFrames {
            scale: Some(Scale {
                about: [20.0, 0.0, 0.0],
                factors: [-1.0, 1.0, 1.0],
            }),
            turn,
            ..FanucFrames::default()
        };
        let made = scaled.frame().apply(point(15.0, 1.0));
        assert!((made - point(31.0, 5.0)).norm() < 1e-12, "{made}");
    }
}
