//! What came of all programs of the corpus.

use crate::Ways;
use crate::figure::Together;

/// What came of all programs.
#[derive(Default)]
pub(super) struct Sums {
    count: u32,
    refused: u32,
    slower: Vec<(String, f64)>,
    broken: Vec<(String, Vec<String>)>,
    figures: [Together; 2],
}

impl Sums {
    pub(super) fn add(&mut self, name: &str, ways: &Result<Ways, String>) {
        match ways {
            Ok(ways) => {
                println!("{}", ways.row(name));
                self.count += 1;
                self.slower
                    .extend(ways.lost_t().map(|lost_t| (name.to_owned(), lost_t)));
                self.broken.push((name.to_owned(), ways.broken()));
                for (sum, plan) in self.figures.iter_mut().zip([&ways.optimal, &ways.fast]) {
                    sum.add(&plan.figure);
                }
            }
            Err(error) => {
                println!("| {name} | refused: {error} ||||||||||||||");
                self.refused += 1;
            }
        }
    }

    pub(super) fn print(&self) {
        println!(
            "\nSlower with optimal than with fast: {} of {}",
            self.slower.len(),
            self.count
        );
        for (name, lost_t) in &self.slower {
            println!("* {name}: {lost_t:.3} s");
        }
        println!("\nBroken, and in brackets on the outer side of the program:");
        for (name, broken) in &self.broken {
            for what in broken {
                println!("* {name}: {what}");
            }
        }
        println!("\nPlanned {}, refused {}", self.count, self.refused);
        for (figures, name) in self.figures.iter().zip(["optimal", "fast"]) {
            println!("{}", figures.line(name));
        }
    }

    /// True if nothing that is handed out is broken.
    pub(super) fn is_kept(&self) -> bool {
        let all = self.broken.iter().flat_map(|(_, broken)| broken);
        all.filter(|what| !what.contains("(outer side")).count() == 0
    }
}
