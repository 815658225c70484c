//! The CSV file of setpoints: `tick,time_s,line,state,feed_mm_s,path_mm`, then position, velocity
//! and acceleration of every axis of the machine, then the position of every joint (`joint_0`, …)
//! where joints are not axes; one row for each tick.
//!
//! Numbers are decimal fractions without exponent, with as many significant digits (at most 17) as
//! it takes to read back exactly the same double.

use crate::sample::TickSample;
use glidepath_geometry::Axis;
use std::io::{self, Write};

/// Writes rows to `out`, which should be buffered.
#[derive(Debug)]
pub struct CsvWriter<W> {
    out: W,
    axes: Vec<Axis>,
    joints: usize,
}

impl<W: Write> CsvWriter<W> {
    /// Writes the header, with so many joints.
    ///
    /// # Errors
    /// `out` does not take it.
    pub fn new(mut out: W, axes: &[Axis], joints: usize) -> io::Result<Self> {
        out.write_all(b"tick,time_s,line,state,feed_mm_s,path_mm")?;
        for axis in axes {
            write!(out, ",pos_{axis},vel_{axis},acc_{axis}")?;
        }
        for joint in 0..joints {
            write!(out, ",joint_{joint}")?;
        }
        out.write_all(b"\n")?;
        Ok(Self {
            out,
            axes: axes.to_vec(),
            joints,
        })
    }

    /// Writes one row.
    ///
    /// # Errors
    /// The output does not take it.
    pub fn row(&mut self, sample: &TickSample) -> io::Result<()> {
        let TickSample {
            tick,
            time_t,
            line,
            state,
            feed_v,
            path_s,
            ..
        } = sample;
        write!(self.out, "{tick},{time_t},{line},{state},{feed_v},{path_s}")?;
        for axis in &self.axes {
            let i = axis.index();
            let (p, v, a) = (
                sample.position[i],
                sample.velocity[i],
                sample.acceleration[i],
            );
            write!(self.out, ",{p},{v},{a}")?;
        }
        for joint in sample.joints.iter().take(self.joints) {
            write!(self.out, ",{joint}")?;
        }
        self.out.write_all(b"\n")
    }

    /// Writes what is still buffered, and gives the output back.
    ///
    /// # Errors
    /// The output does not take it.
    pub fn finish(mut self) -> io::Result<W> {
        self.out.flush()?;
        Ok(self.out)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glidepath_geometry::AxisVector;
    use glidepath_kinematics::JointVector;
    use proptest::prelude::*;

    fn sample(value: f64) -> TickSample {
        TickSample {
            tick: 7,
            time_t: 0.028,
            line: 3,
            state: "running",
            rapid: false,
            binding: None,
            deviation: None,
            programmed_v: 0.0,
            feed_v: 25.0,
            path_s: 0.1 + 0.2,
            position: AxisVector::repeat(value),
            velocity: AxisVector::repeat(-value),
            acceleration: AxisVector::zeros(),
            joints: JointVector::repeat(2.0 * value),
        }
    }

    fn text(axes: &[Axis], joints: usize, sample: &TickSample) -> String {
        let mut bytes = Vec::new();
        let mut csv = CsvWriter::new(&mut bytes, axes, joints).unwrap();
        csv.row(sample).unwrap();
        csv.finish().unwrap();
        String::from_utf8(bytes).unwrap()
    }

    #[test]
    fn header_and_row_are_the_contract() {
        assert_eq!(
            text(&[Axis::X, Axis::C], 0, &sample(1.5)),
            "tick,time_s,line,state,feed_mm_s,path_mm,pos_X,vel_X,acc_X,pos_C,vel_C,acc_C\n\
             7,0.028,3,running,25,0.30000000000000004,1.5,-1.5,0,1.5,-1.5,0\n"
        );
        assert_eq!(
            text(&[Axis::X], 2, &sample(1.5)),
            "tick,time_s,line,state,feed_mm_s,path_mm,pos_X,vel_X,acc_X,joint_0,joint_1\n\
             7,0.028,3,running,25,0.30000000000000004,1.5,-1.5,0,3,3\n"
        );
    }

    proptest! {
        #[test]
        fn every_double_reads_back_bit_for_bit(bits: u64) {
            let value = f64::from_bits(bits);
            prop_assume!(value.is_finite());
            let text = text(&[Axis::X], 0, &sample(value));
            let row = text.lines().nth(1).unwrap();
            let position: f64 = row.split(',').nth(6).unwrap().parse().unwrap();
            prop_assert_eq!(position.to_bits(), bits);
            prop_assert!(!row.contains('e'));
        }
    }
}
