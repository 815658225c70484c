//! The answers of a set-up: a machine as its owner describes it.

use super::kind::{KINDS, Kind, UsualAxis};
use super::questions::Questions;
use crate::command::failure::Failure;

/// What moves the axes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Motors {
    Simulated,
    Ethercat,
    Hal,
}

/// How joints come home.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Home {
    Nothing,
    Drives,
    Switches,
}

#[derive(Debug, Clone, Copy)]
pub(super) struct AxisAnswer {
    pub(super) letter: char,
    pub(super) min: f64,
    pub(super) max: f64,
    pub(super) feed: f64,
    pub(super) acceleration: f64,
    /// A second motor moves it, too.
    pub(super) is_gantry: bool,
}

/// A delta's dimensions, mm.
#[derive(Debug, Clone, Copy)]
pub(super) struct DeltaAnswer {
    pub(super) rod_mm: f64,
    pub(super) radius_mm: f64,
    /// Radius and height of what it reaches.
    pub(super) reach_mm: f64,
    pub(super) height_mm: f64,
    /// Of its carriages: mm/min and mm/s².
    pub(super) feed: f64,
    pub(super) acceleration: f64,
}

/// All answers.
#[derive(Debug, Clone)]
pub(super) struct Answers {
    pub(super) kind: Kind,
    pub(super) motors: Motors,
    pub(super) home: Home,
    pub(super) axes: Vec<AxisAnswer>,
    pub(super) delta: Option<DeltaAnswer>,
    pub(super) tolerance_mm: f64,
    pub(super) has_encoder: bool,
    /// The voltage of the arc is an analog input.
    pub(super) has_torch_height: bool,
}

impl Answers {
    /// Asks for everything.
    ///
    /// # Errors
    /// The answers end before the questions do.
    pub(super) fn ask(questions: &Questions) -> Result<Self, Failure> {
        let kind = questions.choice("What is it?", &KINDS, "mill")?;
        let motors = [
            ("simulated", Motors::Simulated),
            ("ethercat", Motors::Ethercat),
            ("hal", Motors::Hal),
        ];
        questions.say(
            "Drives on EtherCAT, steppers and cards by LinuxCNC's HAL, or none yet: a simulated machine can be \
             changed later.",
        );
        let motors = questions.choice("What moves it?", &motors, "simulated")?;
        let home = if motors == Motors::Simulated || kind == Kind::Delta {
            Home::Nothing
        } else {
            let homes = [
                ("drives", Home::Drives),
                ("switches", Home::Switches),
                ("nothing", Home::Nothing),
            ];
            questions.say(
                "Drives that find their home by themselves or have absolute encoders, or switches that the controller \
                 looks for. An axis with two motors takes switches.",
            );
            questions.choice("How does it find its home?", &homes, "drives")?
        };
        let delta = (kind == Kind::Delta)
            .then(|| delta(questions))
            .transpose()?;
        let usual = kind.axes().iter();
        let axes = usual.map(|usual| axis(questions, (kind, home), usual));
        let axes = axes.collect::<Result<_, _>>()?;
        questions.say("How far the motion may be from the program: corners are rounded by that, and faster for it.");
        let tolerance_mm =
            questions.number("Tolerance", "mm", kind.tolerance_mm(), (0.0005, 5.0))?;
        let has_encoder = kind == Kind::Lathe
            && questions.yes("Has its spindle an encoder, for threads?", true)?;
        let has_torch_height = kind == Kind::Plasma
            && motors != Motors::Simulated
            && questions.yes("Is the voltage of the arc an analog input?", true)?;
        Ok(Self {
            kind,
            motors,
            home,
            axes,
            delta,
            tolerance_mm,
            has_encoder,
            has_torch_height,
        })
    }
}

fn axis(
    questions: &Questions,
    (kind, home): (Kind, Home),
    usual: &UsualAxis,
) -> Result<AxisAnswer, Failure> {
    let letter = usual.letter;
    questions.say(&format!("Axis {letter}"));
    let travel_mm = questions.number(
        &format!("Travel of {letter}"),
        "mm",
        usual.travel_mm,
        (1.0, 100_000.0),
    )?;
    let ends = [("low", false), ("high", true)];
    let suggested = if usual.zero_is_high { "high" } else { "low" };
    let zero_is_high = questions.choice(
        &format!("At which end is machine zero of {letter}?"),
        &ends,
        suggested,
    )?;
    let feed = questions.number(
        &format!("Fastest speed of {letter}"),
        "mm/min",
        usual.feed,
        (1.0, 1e6),
    )?;
    let acceleration = questions.number(
        &format!("Acceleration of {letter}"),
        "mm/s²",
        usual.acceleration,
        (1.0, 1e6),
    )?;
    let may_have_two = matches!(kind, Kind::Router | Kind::Plasma) && letter != 'Z';
    let is_gantry = may_have_two
        && home == Home::Switches
        && questions.yes(&format!("Do two motors move {letter}?"), false)?;
    let (min, max) = if zero_is_high {
        (-travel_mm, 0.0)
    } else {
        (0.0, travel_mm)
    };
    Ok(AxisAnswer {
        letter,
        min,
        max,
        feed,
        acceleration,
        is_gantry,
    })
}

fn delta(questions: &Questions) -> Result<DeltaAnswer, Failure> {
    let mm = |question, usual| questions.number(question, "mm", usual, (1.0, 10_000.0));
    Ok(DeltaAnswer {
        rod_mm: mm("Length of the rods, between their joints", 269.0)?,
        radius_mm: mm(
            "Radius of the towers, less that of the effector and of the carriages",
            130.25,
        )?,
        reach_mm: mm("Radius of what it is to reach", 80.0)?,
        height_mm: mm("Height of what it is to reach", 150.0)?,
        feed: questions.number(
            "Fastest speed of a carriage",
            "mm/min",
            18_000.0,
            (1.0, 1e6),
        )?,
        acceleration: questions.number(
            "Acceleration of a carriage",
            "mm/s²",
            3000.0,
            (1.0, 1e6),
        )?,
    })
}
