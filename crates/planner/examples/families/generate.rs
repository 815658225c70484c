//! The run over programs that are drawn: each is planned in all ways, and the results are told by
//! family.

use crate::arguments::{Arguments, Setup};
use crate::family::{Drawn, Family};
use crate::figures::FiguresByWay;
use crate::plan::Way;
use crate::statistics::{Figures, shown};
use crate::trial::Trial;
use crate::workers::in_order;
use glidepath_program::Corners;
use std::error::Error;

/// A program of a family, by its number.
struct Task {
    family: usize,
    seed: u64,
    setup: usize,
}

/// What is told of a family.
#[derive(Default)]
struct Sums {
    programs: u32,
    failed: u32,
    violations: [u32; 3],
    tremors: [u32; 3],
    slower: [u32; 2],
    fast_slower: u32,
    fast: Figures,
    stop: Figures,
    circle: [Figures; 2],
    jerk: [Figures; 2],
    ringing: [Figures; 2],
    load: [Figures; 2],
    longest_ms: Figures,
    figures: FiguresByWay,
    /// Programs with a plan that breaks a rule, a limit or a tolerance.
    not_kept: u32,
}

impl Sums {
    fn add(&mut self, drawn: &Drawn, setup: &Setup, trial: &Trial) {
        for (violations, way) in self.violations.iter_mut().zip(Way::ALL) {
            *violations += u32::from(trial.plan(way).violations() > 0);
        }
        for (tremors, way) in self.tremors.iter_mut().zip(Way::ALL) {
            *tremors += u32::from(trial.plan(way).tremors() > 0);
        }
        for (slower, rival) in self.slower.iter_mut().zip([Way::Fast, Way::Stop]) {
            *slower += u32::from(trial.is_slower(Way::Optimal, rival));
        }
        self.figures.add(trial);
        self.not_kept += u32::from(!trial.is_kept());
        self.fast_slower += u32::from(trial.is_slower(Way::Fast, Way::Stop));
        self.fast.add(trial.ratio(Way::Optimal, Way::Fast));
        self.stop.add(trial.ratio(Way::Optimal, Way::Stop));
        for (index, way) in [Way::Optimal, Way::Fast].into_iter().enumerate() {
            if let Some(circle_t) = circle_t(drawn, setup) {
                self.circle[index].add(trial.time_t(way) / circle_t);
            }
            // Only of programs in which the feed binds either way: others do not compare.
            let at_feed = [Way::Optimal, Way::Fast].map(|way| trial.at_feed(way));
            if let (Some(figures), [Some(_), Some(_)]) = (trial.at_feed(way), at_feed) {
                self.jerk[index].add(figures.jerk_j);
                self.ringing[index].add(figures.ringing_a);
            }
            self.load[index].add(100.0 * trial.plan(way).load_r());
        }
        let longest = trial.plan(Way::Optimal).longest;
        self.longest_ms.add(1e3 * longest.as_secs_f64());
    }

    fn row(&self, name: &str, machine: &str) -> String {
        let ratio = |figures: &Figures| {
            format!(
                "{} | {}",
                shown(figures.median(), 4),
                shown(figures.largest(), 4)
            )
        };
        let both = |figures: &[Figures; 2], decimals| {
            let [optimal, fast] = figures.each_ref().map(Figures::median);
            format!("{} | {}", shown(optimal, decimals), shown(fast, decimals))
        };
        let violations = self.violations.map(|count| count.to_string()).join("/");
        let tremors = self.tremors.map(|count| count.to_string()).join("/");
        format!(
            "| {name} | {machine} | {} | {} | {} | {violations} | {tremors} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} |",
            self.programs,
            self.failed,
            self.not_kept,
            self.slower[0],
            self.slower[1],
            self.fast_slower,
            ratio(&self.fast),
            ratio(&self.stop),
            ratio(&self.circle[0]),
            ratio(&self.circle[1]),
            both(&self.jerk, 0),
            both(&self.ringing, 1),
            both(&self.load, 2),
            shown(self.load[0].largest(), 1),
            shown(self.longest_ms.largest(), 0),
        )
    }
}

const HEAD: &str = "\
| family | machine | programs | not planned | not kept | with violations optimal/fast/stop | with tremors | slower than fast | than stop | fast slower than stop | optimal/fast median | worst | optimal/stop median | worst | optimal/circle median | worst | fast/circle median | worst | jerk at feed optimal | fast | ringing at feed optimal | fast | cpu % optimal | fast | worst optimal | longest call ms |
|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|";

/// The time that a program of nothing but a circle takes, by the closed form, s.
fn circle_t(drawn: &Drawn, setup: &Setup) -> Option<f64> {
    let circle = drawn.circle?;
    let machine = &setup.machine;
    Some(machine.circle_t(circle.radius_mm, circle.length_mm, circle.feed_v))
}

/// The programs: the families in turn, each with seeds in a row, in every setup.
fn tasks(count: u32, families: &[Family], setups: usize, seed: u64) -> Vec<Task> {
    let mut tasks = Vec::new();
    for setup in 0..setups {
        let turns = (0_u64..).flat_map(|turn| (0..families.len()).map(move |at| (turn, at)));
        for (turn, family) in turns.take(count as usize) {
            tasks.push(Task {
                family,
                seed: seed.wrapping_add(turn),
                setup,
            });
        }
    }
    tasks
}

/// The command that plans a program again.
fn again(family: &str, task: &Task, setup: &Setup) -> String {
    let mut words = format!(
        "generate 1 --family {family} --seed {} --machine {} --period {}",
        task.seed, setup.machine.name, setup.period_t
    );
    if setup.corners != Corners::default() {
        words.push_str(&format!(" --corners {}", setup.corners_name()));
    }
    if setup.has_walls {
        words.push_str(" --walls");
    }
    if let Some(given_mm) = setup.given_mm {
        words.push_str(&format!(" --tolerance {given_mm}"));
    }
    words
}

/// Draws programs and plans them; prints those that are slower than a rival or in violation, and a
/// table of the families.
pub(crate) fn run(count: u32, arguments: &Arguments) -> Result<bool, Box<dyn Error>> {
    let (families, setups) = (&arguments.families, arguments.setups());
    let tasks = tasks(count, families, setups.len(), arguments.seed);
    if let Some(folder) = &arguments.write {
        std::fs::create_dir_all(folder)?;
        for task in tasks.iter().filter(|task| task.setup == 0) {
            let family = &families[task.family];
            let path = folder.join(format!("{}-{}.ngc", family.name, task.seed));
            std::fs::write(path, family.program(task.seed).text)?;
        }
    }
    let mut sums: Vec<Vec<Sums>> = Vec::new();
    for _ in &setups {
        sums.push(families.iter().map(|_| Sums::default()).collect());
    }
    let work = |index: usize| {
        let task = &tasks[index];
        let drawn = families[task.family].program(task.seed);
        let trial = Trial::run(drawn.text.as_bytes(), &setups[task.setup]);
        (drawn, trial)
    };
    in_order(
        arguments.threads,
        tasks.len(),
        work,
        |index, (drawn, trial)| {
            let task = &tasks[index];
            let (setup, family) = (&setups[task.setup], &families[task.family]);
            let sums = &mut sums[task.setup][task.family];
            sums.programs += 1;
            match trial {
                Ok(trial) => {
                    sums.add(&drawn, setup, &trial);
                    if arguments.is_json {
                        let mut value = trial.json();
                        value["family"] = family.name.into();
                        value["seed"] = task.seed.into();
                        value["machine"] = setup.machine.name.into();
                        value["tolerance_mm"] = setup.tolerance_mm().into();
                        value["period_s"] = setup.period_t.into();
                        value["circle_s"] = circle_t(&drawn, setup).into();
                        value["corners"] = setup.corners_name().into();
                        value["problems"] = trial.problems().into();
                        println!("{value}");
                    } else {
                        for problem in trial.problems() {
                            println!("{problem}: {}", again(family.name, task, setup));
                        }
                    }
                }
                Err(reason) => {
                    sums.failed += 1;
                    eprintln!("not planned, {reason}: {}", again(family.name, task, setup));
                }
            }
        },
    );
    if !arguments.is_json {
        println!("\n{HEAD}");
        for (setup, sums) in setups.iter().zip(&sums) {
            for (family, sums) in families.iter().zip(sums) {
                println!("{}", sums.row(family.name, setup.machine.name));
            }
        }
    }
    if !arguments.is_json {
        println!();
        for (setup, sums) in setups.iter().zip(&sums) {
            let mut all = FiguresByWay::default();
            sums.iter().for_each(|sums| all.join(&sums.figures));
            all.print(&format!(
                "{}, {}, ",
                setup.machine.name,
                setup.corners_name()
            ));
        }
    }
    let is_clean =
        |sums: &Sums| sums.failed == 0 && sums.violations == [0; 3] && sums.figures.is_kept();
    Ok(sums.iter().flatten().all(is_clean))
}
