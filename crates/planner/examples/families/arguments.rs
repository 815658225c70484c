//! The arguments of the command line.

use crate::family::{FAMILIES, Family};
use crate::machine::{MACHINES, Machine};
use glidepath_program::Corners;
use std::path::PathBuf;

/// How the harness is called.
pub(crate) const USAGE: &str = "\
families bench [DIR] [--machine NAME]... [--tolerance MM]... [--period S]... [--json]
families generate COUNT [--seed N] [--family NAME]... [--machine NAME]... [--tolerance MM]...
                  [--period S]... [--write DIR] [--json]
Both: [--corners inner|either]... [--walls] [--threads N]. NAME of a machine: mill, seed, stiff.";

/// What is to be done.
#[derive(Debug)]
pub(crate) enum Task {
    /// The programs of a folder.
    Bench(PathBuf),
    /// This many programs that are drawn.
    Generate(u32),
}

/// Everything that was asked for.
#[derive(Debug)]
pub(crate) struct Arguments {
    pub(crate) task: Task,
    pub(crate) seed: u64,
    pub(crate) families: Vec<Family>,
    pub(crate) machines: Vec<Machine>,
    /// In place of those of the machine and the program, mm.
    pub(crate) tolerances_mm: Vec<f64>,
    pub(crate) periods_t: Vec<f64>,
    pub(crate) corners: Vec<Corners>,
    /// Whether travel ends where the program does.
    pub(crate) has_walls: bool,
    pub(crate) write: Option<PathBuf>,
    pub(crate) is_json: bool,
    pub(crate) threads: usize,
}

/// One way to plan: a machine, a tolerance in place of its own, a period.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Setup {
    pub(crate) machine: Machine,
    pub(crate) given_mm: Option<f64>,
    pub(crate) period_t: f64,
    pub(crate) corners: Corners,
    pub(crate) has_walls: bool,
}

impl Setup {
    /// The side of corners by its name.
    pub(crate) const fn corners_name(&self) -> &'static str {
        match self.corners {
            Corners::Inner => "inner",
            Corners::Either => "either",
        }
    }

    /// The tolerance where the program gives none, mm.
    pub(crate) fn tolerance_mm(&self) -> f64 {
        self.given_mm.unwrap_or(self.machine.tolerance_mm)
    }
}

impl Arguments {
    /// Reads the arguments of the process.
    pub(crate) fn read() -> Result<Self, String> {
        let mut words = std::env::args().skip(1).peekable();
        let task = match words.next().as_deref() {
            Some("bench") => {
                let shipped = concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/data/families");
                let folder = words.next_if(|word| !word.starts_with("--"));
                Task::Bench(PathBuf::from(folder.unwrap_or_else(|| shipped.to_owned())))
            }
            Some("generate") => Task::Generate(number(words.next(), "COUNT")?),
            _ => return Err(USAGE.to_owned()),
        };
        let cores = std::thread::available_parallelism().map_or(1, usize::from);
        let mut read = Self {
            task,
            seed: 1,
            families: Vec::new(),
            machines: Vec::new(),
            tolerances_mm: Vec::new(),
            periods_t: Vec::new(),
            corners: Vec::new(),
            has_walls: false,
            write: None,
            is_json: false,
            threads: cores,
        };
        while let Some(word) = words.next() {
            read.option(&word, &mut words)?;
        }
        if read.families.is_empty() {
            read.families = FAMILIES.to_vec();
        }
        if read.machines.is_empty() {
            read.machines = vec![MACHINES[0]];
        }
        if read.periods_t.is_empty() {
            read.periods_t = vec![0.004];
        }
        if read.corners.is_empty() {
            read.corners = vec![Corners::default()];
        }
        Ok(read)
    }

    fn option(
        &mut self,
        word: &str,
        words: &mut impl Iterator<Item = String>,
    ) -> Result<(), String> {
        match word {
            "--json" => self.is_json = true,
            "--walls" => self.has_walls = true,
            "--corners" => {
                let of = [Corners::Inner, Corners::Either];
                self.corners
                    .push(of[named(words.next(), word, &["inner", "either"])?]);
            }
            "--seed" => self.seed = number(words.next(), word)?,
            "--threads" => self.threads = number::<usize>(words.next(), word)?.max(1),
            "--tolerance" => self.tolerances_mm.push(positive(words.next(), word)?),
            "--period" => self.periods_t.push(positive(words.next(), word)?),
            "--write" => {
                self.write = Some(words.next().ok_or("--write wants a folder")?.into());
            }
            "--family" => {
                let names: Vec<_> = FAMILIES.iter().map(|family| family.name).collect();
                self.families
                    .push(FAMILIES[named(words.next(), word, &names)?]);
            }
            "--machine" => {
                let names: Vec<_> = MACHINES.iter().map(|machine| machine.name).collect();
                self.machines
                    .push(MACHINES[named(words.next(), word, &names)?]);
            }
            _ => return Err(format!("{word} is not known\n{USAGE}")),
        }
        Ok(())
    }

    /// Every machine with every tolerance and period.
    pub(crate) fn setups(&self) -> Vec<Setup> {
        let mut tolerances: Vec<_> = self.tolerances_mm.iter().copied().map(Some).collect();
        if tolerances.is_empty() {
            tolerances.push(None);
        }
        let mut setups = Vec::new();
        for &machine in &self.machines {
            for &given_mm in &tolerances {
                for &period_t in &self.periods_t {
                    for &corners in &self.corners {
                        setups.push(Setup {
                            machine,
                            given_mm,
                            period_t,
                            corners,
                            has_walls: self.has_walls,
                        });
                    }
                }
            }
        }
        setups
    }
}

fn number<T: std::str::FromStr>(word: Option<String>, what: &str) -> Result<T, String> {
    let read = word.as_deref().map(str::parse);
    match read {
        Some(Ok(number)) => Ok(number),
        _ => Err(format!("{what} wants a number\n{USAGE}")),
    }
}

fn positive(word: Option<String>, what: &str) -> Result<f64, String> {
    let value: f64 = number(word, what)?;
    if value.is_finite() && value > 0.0 {
        Ok(value)
    } else {
        Err(format!("{what} wants a number above 0"))
    }
}

fn named(word: Option<String>, what: &str, names: &[&str]) -> Result<usize, String> {
    let place = word.and_then(|word| names.iter().position(|name| *name == word));
    place.ok_or_else(|| format!("{what} wants one of {}", names.join(", ")))
}
