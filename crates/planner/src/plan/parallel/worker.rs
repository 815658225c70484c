//! A worker thread, which plans parts one after the other.

use std::sync::mpsc::{Receiver, Sender};
use std::sync::{Mutex, PoisonError};

use glidepath_kinematics::LimitedMechanism;
use glidepath_motion::parts::PartPlanner;
use glidepath_program::Settings;

use super::bounds::Bounds;
use super::message::{Batch, Gone, Part, PlanPiece, PlanStep};
use crate::plan::joint_bounds::JointBounds;

/// What parts are planned for: settings, and joints that are not the axes.
type PartSetUp = (Settings, Option<LimitedMechanism>);

/// Bytes of a plan that are handed over together.
const CHUNK: usize = 64 << 10;

/// Plans parts as they come, until there are no more or nobody wants them.
pub(super) fn work(parts: &Mutex<Receiver<Part>>, machine: PartSetUp, bounds: &Bounds) {
    loop {
        let part = parts.lock().unwrap_or_else(PoisonError::into_inner).recv();
        let Ok(part) = part else { return };
        if plan(part, machine, bounds).is_err() {
            return;
        }
    }
}

/// The plan of a part on its way to the caller.
struct Outlet<'a> {
    part: u64,
    plan: Sender<PlanPiece>,
    bounds: &'a Bounds,
    steps: Vec<PlanStep>,
    /// Memory that the steps keep beside their own, bytes.
    heap_bytes: usize,
    lines: u64,
}

impl Outlet<'_> {
    fn put(&mut self, step: PlanStep) -> Result<(), Gone> {
        self.heap_bytes += match &step {
            PlanStep::Item(_) => 0,
            PlanStep::Motion(motion) => motion.heap_bytes(),
        };
        self.steps.push(step);
        if self.bytes() >= CHUNK {
            self.hand_over()?;
        }
        Ok(())
    }

    fn bytes(&self) -> usize {
        self.steps.len() * size_of::<PlanStep>() + self.heap_bytes
    }

    fn hand_over(&mut self) -> Result<(), Gone> {
        if self.steps.is_empty() {
            return Ok(());
        }
        // A few large steps fill a chunk as well as many small ones: room for more of them is not kept.
        self.steps.shrink_to_fit();
        let weight = self.bytes();
        self.heap_bytes = 0;
        if !self.bounds.plans.add(self.part, weight) {
            return Err(Gone);
        }
        let steps = std::mem::take(&mut self.steps);
        let lines = self.lines;
        self.send(PlanPiece::Steps {
            steps,
            weight,
            lines,
        })
    }

    fn send(&self, planned: PlanPiece) -> Result<(), Gone> {
        self.plan.send(planned).map_err(|_| Gone)
    }
}

fn plan(part: Part, (settings, joints): PartSetUp, bounds: &Bounds) -> Result<(), Gone> {
    let mut planner = PartPlanner::new(settings, part.start, part.number == 0);
    if let Some(caps) = joints {
        planner = planner.with_joints(JointBounds::shared(caps));
    }
    let mut outlet = Outlet {
        part: part.number,
        plan: part.plan,
        bounds,
        steps: Vec::new(),
        heap_bytes: 0,
        lines: 0,
    };
    put_motion(&mut planner, &mut outlet)?;
    loop {
        match part.items.recv() {
            Ok(Batch::Items { items, lines }) => {
                bounds.take_items(items.len());
                outlet.lines = lines;
                for item in items {
                    planner.push(&item);
                    outlet.put(PlanStep::Item(item))?;
                    put_motion(&mut planner, &mut outlet)?;
                }
            }
            Ok(Batch::End { is_last }) => {
                if is_last {
                    planner.finish();
                    put_motion(&mut planner, &mut outlet)?;
                }
                outlet.hand_over()?;
                return outlet.send(PlanPiece::End);
            }
            Err(_) => return Err(Gone),
        }
    }
}

/// Hands on all that the planner has to give at present.
fn put_motion(planner: &mut PartPlanner, outlet: &mut Outlet<'_>) -> Result<(), Gone> {
    while let Some(step) = planner.step() {
        outlet.put(PlanStep::Motion(step))?;
    }
    Ok(())
}
