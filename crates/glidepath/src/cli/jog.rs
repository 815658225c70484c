//! Arguments of `jog`.

use super::operator::OperatorArgs;
use clap::Args;
use glidepath_geometry::Axis;

/// Arguments of `jog`.
#[derive(Debug, Args)]
pub struct JogArgs {
    /// How far to move each axis: X10 or Y-2.5, in mm or degrees. Without a step, the keys of the
    /// terminal move the axes
    #[arg(value_name = "STEP", value_parser = step)]
    pub steps: Vec<JogStep>,
    /// Speed along the move, in mm/min or °/min; limited by the jog speed of each axis
    #[arg(long, value_name = "MM_MIN", value_parser = feed)]
    pub feed: Option<f64>,
    /// The letters mean the joints of these axes; only on a machine whose joints are its axes
    #[arg(long)]
    pub by_joint: bool,
    /// The interpolator that is meant.
    #[command(flatten)]
    pub operator: OperatorArgs,
}

/// How far an axis is to go.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JogStep {
    /// Which.
    pub axis: Axis,
    /// mm or degrees.
    pub distance: f64,
}

fn step(text: &str) -> Result<JogStep, &'static str> {
    const HELP: &str = "give an axis and how far it is to go, such as X10 or Y-2.5";
    let mut letters = text.chars();
    let axis = letters
        .next()
        .map(|letter| letter.to_ascii_uppercase())
        .and_then(Axis::from_letter)
        .ok_or(HELP)?;
    let distance: f64 = letters.as_str().parse().map_err(|_| HELP)?;
    if distance.is_finite() && distance != 0.0 && distance.abs() <= 1e6 {
        Ok(JogStep { axis, distance })
    } else {
        Err("give a distance of up to 1000000 that is not 0")
    }
}

fn feed(text: &str) -> Result<f64, &'static str> {
    let feed: Option<f64> = text.parse().ok();
    feed.filter(|feed| (1e-3..=1e7).contains(feed))
        .ok_or("give a speed from 0.001 to 10000000")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_name_an_axis_and_a_distance() {
        let of = |axis, distance| Ok(JogStep { axis, distance });
        assert_eq!(step("X10"), of(Axis::X, 10.0));
        assert_eq!(step("y-2.5"), of(Axis::Y, -2.5));
        for wrong in ["", "X", "10", "X0", "XY1", "Q1", "Xnan", "X1e9"] {
            assert!(step(wrong).is_err(), "{wrong}");
        }
    }
}
