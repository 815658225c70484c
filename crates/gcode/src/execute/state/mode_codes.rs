//! The codes of motion modes and planes, as numbers: for the words in force and the variables that show modes.

use glidepath_geometry::Plane;

use crate::syntax::modes::{CannedCycle, LatheCycle, Motion, Pockets, Probe, Spline};

/// Ten times the number of the code that a motion mode has.
pub(crate) const fn motion_tenths(motion: Motion) -> u16 {
    match motion {
        Motion::Rapid => 0,
        Motion::Linear => 10,
        Motion::ArcClockwise => 20,
        Motion::ArcCounterclockwise => 30,
        Motion::Thread => 330,
        Motion::RigidTap | Motion::TapIn | Motion::TapOut => 331,
        Motion::ArcThrough | Motion::ArcTangent => 20,
        Motion::ThreadCycle | Motion::Turning(_) | Motion::Groove(_) => 760,
        Motion::CirclePocket(true) => 120,
        Motion::CirclePocket(false) => 130,
        Motion::HolePattern(false) => 700,
        Motion::HolePattern(true) => 710,
        Motion::Spline(spline) => match spline {
            Spline::Cubic => 50,
            Spline::Quadratic => 51,
            Spline::Weighted => 52,
            Spline::EndWeighted => 53,
            Spline::Knotted => 62,
        },
        Motion::Probe(Probe { toward, must }) => match (toward, must) {
            (true, true) => 382,
            (true, false) => 383,
            (false, true) => 384,
            (false, false) => 385,
        },
        Motion::Cycle(cycle) => 10 * cycle_number(cycle),
        Motion::Lathe(cycle) => {
            let (code, pockets) = match cycle {
                LatheCycle::Finish => return 700,
                LatheCycle::Repeat => return 730,
                LatheCycle::Turn(pockets) => (710, pockets),
                LatheCycle::Face(pockets) => (720, pockets),
            };
            code + match pockets {
                Pockets::Cut => 0,
                Pockets::LeftOut => 1,
                Pockets::Only => 2,
            }
        }
    }
}

/// The number of a canned cycle's code.
pub(crate) const fn cycle_number(cycle: CannedCycle) -> u16 {
    match cycle {
        CannedCycle::ChipBreak => 73,
        CannedCycle::TapLeft => 74,
        CannedCycle::FineBore => 76,
        CannedCycle::Drill => 81,
        CannedCycle::DrillDwell => 82,
        CannedCycle::Peck => 83,
        CannedCycle::TapRight => 84,
        CannedCycle::Bore => 85,
        CannedCycle::BoreStop => 86,
        CannedCycle::BackBore => 87,
        CannedCycle::BoreDwell => 89,
    }
}

/// Ten times the number of a plane's code.
pub(crate) const fn plane_tenths(plane: Plane) -> u16 {
    match plane {
        Plane::Xy => 170,
        Plane::Uv => 171,
        Plane::Zx => 180,
        Plane::Wu => 181,
        Plane::Yz => 190,
        Plane::Vw => 191,
    }
}

/// A code by ten times its number, as a program writes it: `G1`, `G38.2`.
pub(crate) fn g_word(tenths: u16) -> String {
    match tenths % 10 {
        0 => format!("G{}", tenths / 10),
        tenth => format!("G{}.{tenth}", tenths / 10),
    }
}
