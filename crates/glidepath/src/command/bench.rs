//! `glidepath bench`: the benchmark programs beside what is known of them.

use super::check;
use super::plan::{Pass, title};
use crate::bench::{BenchReport, BenchRow, Catalogue, CatalogueEntry};
use crate::cli::BenchArgs;
use crate::command::failure::Failure;
use crate::config::{self, MachineConfig};
use crate::exit::Exit;
use crate::interrupt::Interrupt;
use crate::output;
use crate::output_file::OverwriteGuard;
use crate::program_file::ProgramFile;
use crate::progress::ProgressDisplay;
use crate::recording::Recording;

/// Plans every program of a catalogue, each for its machine, and prints the table.
///
/// # Errors
/// The catalogue, a program or a configuration cannot be read, or the user interrupted.
pub(super) fn bench(args: &BenchArgs, given: &MachineConfig) -> Result<Exit, Failure> {
    let catalogue = Catalogue::read(&args.folder)?;
    let interrupt = Interrupt::install().map_err(Failure::Signals)?;
    let progress = ProgressDisplay::lines(catalogue.bench.len() as u64, args.basic.json);
    let mut report = BenchReport::default();
    for (done, entry) in (0..).zip(&catalogue.bench) {
        progress.at(done);
        progress.doing("planning");
        report.rows.push(row(args, entry, given, &interrupt)?);
    }
    progress.finish();
    if args.basic.json {
        output::object(&report.object());
    } else {
        output::result(&report.text());
    }
    Ok(report.exit())
}

fn row(
    args: &BenchArgs,
    entry: &CatalogueEntry,
    given: &MachineConfig,
    interrupt: &Interrupt,
) -> Result<BenchRow, Failure> {
    let of_profile;
    let config = if args.basic.config.is_some() {
        given
    } else {
        of_profile = machine(args, &entry.profile)?;
        &of_profile
    };
    let path = args.folder.join(&entry.file);
    check::accepted(&ProgramFile::named(&path), config, true)?;
    let mut recording = Recording::create(config, None, None, &OverwriteGuard::default())?;
    let mut pass = Pass::on_one_core(&path, config)?;
    while pass.turn(&mut recording)? {
        if interrupt.is_set() {
            return Err(Failure::Interrupted);
        }
    }
    let jerk_j = config.axes.first().map_or(0.0, |axis| axis.max_jerk);
    Ok(BenchRow {
        program: title(&entry.file).trim_end_matches(".ngc").to_owned(),
        profile: entry.profile.clone(),
        anchors: entry.anchors(jerk_j, config.path.tolerance_mm),
        motion: pass.report(config),
    })
}

/// The machine of a profile: a file of the folder given, or built in.
fn machine(args: &BenchArgs, profile: &str) -> Result<MachineConfig, Failure> {
    let built_in = match profile {
        "mill" => Some(config::EMBEDDED),
        "seed" => Some(config::EMBEDDED_SEED),
        _ => None,
    };
    let name = format!("{profile}.toml");
    let config = match (&args.config_dir, built_in) {
        (None, Some(text)) => config::parse(&format!("built-in {name}"), text),
        (folder, _) => {
            let folder = folder.as_deref().unwrap_or(&args.folder);
            config::load(Some(&folder.join(name)))
        }
    };
    Ok(config?)
}
