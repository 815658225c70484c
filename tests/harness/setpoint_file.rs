//! The reader of setpoints as CSV.

use std::path::Path;

use glidepath_geometry::AxisVector;
use glidepath_link::servo::JointState;

/// The rows of a file, without what tells when: two executions of the same plan have the same, if
/// rows at rest are counted once.
#[derive(Debug, PartialEq, Eq)]
pub struct SetpointFile {
    rows: Vec<String>,
}

impl SetpointFile {
    /// Reads the columns from the path position on, which are all that is common to a plan and to a
    /// run of it: position, velocity and acceleration of every axis, with every digit.
    #[must_use]
    pub fn read(path: &Path) -> Self {
        let text = std::fs::read_to_string(path).unwrap();
        let mut lines = text.lines();
        let header = "tick,time_s,line,state,feed_mm_s,path_mm,";
        assert!(
            lines.next().unwrap().starts_with(header),
            "{}: header",
            path.display()
        );
        let state = |line: &str| line.splitn(7, ',').nth(6).unwrap().to_owned();
        Self {
            rows: lines.map(state).collect(),
        }
    }

    /// The rows with repetitions left out: before the motion, after it, and where it rests.
    #[must_use]
    pub fn moving(&self) -> Vec<&str> {
        let mut rows: Vec<_> = self.rows.iter().map(String::as_str).collect();
        rows.dedup();
        rows
    }

    /// The states of X, Y and Z in every row.
    #[must_use]
    pub fn states(&self) -> Vec<[JointState; 3]> {
        let states = |row: &String| {
            let numbers: Vec<f64> = row.split(',').map(|text| text.parse().unwrap()).collect();
            // Position, velocity and acceleration of one axis after the other.
            std::array::from_fn(|axis| JointState {
                position: numbers[3 * axis],
                velocity: numbers[3 * axis + 1],
                acceleration: numbers[3 * axis + 2],
            })
        };
        self.rows.iter().map(states).collect()
    }

    /// The positions of X, Y and Z in every row.
    #[must_use]
    pub fn positions(&self) -> Vec<AxisVector> {
        let position = |states: [JointState; 3]| {
            let mut position = AxisVector::zeros();
            for (axis, state) in states.iter().enumerate() {
                position[axis] = state.position;
            }
            position
        };
        self.states().into_iter().map(position).collect()
    }

    /// Whether nothing ever moved.
    #[must_use]
    pub fn is_still(&self) -> bool {
        self.moving().len() <= 1
    }
}
