//! `glidepath offsets`: shows and changes, by hand, what a machine keeps over a restart.

use crate::cli::{AngularUnits, LinearUnits, OffsetsCommand, SetArgs, UnitArgs};
use crate::command::failure::Failure;
use crate::config::MachineConfig;
use crate::exit::Exit;
use crate::file_error::FileError;
use crate::output;
use crate::persistence::convert::{axis_words, system_name};
use crate::persistence::error::StateError;
use crate::persistence::machine::fingerprint;
use crate::persistence::read::of_machine;
use crate::text_file;
use glidepath_persistence::var::{self, Units};
use glidepath_persistence::{AXES, Directory, Offsets, PersistentState, Store, StoreError};
use serde_json::{Value, json};
use std::path::Path;

/// Largest parameter file, bytes.
const MOST_BYTES: u64 = 1 << 20;

/// Shows or changes what is kept.
///
/// # Errors
/// Nothing can be kept, what is kept cannot be used, or another process writes it.
pub(super) fn offsets(command: &OffsetsCommand, config: &MachineConfig) -> Result<Exit, Failure> {
    let folder = config
        .state_directory
        .as_deref()
        .ok_or(StateError::NoFolder)?;
    let as_json = command.basic().json;
    match command {
        OffsetsCommand::Show(_) => {
            let read = Store::new(Directory::at(folder))
                .read()
                .map_err(StateError::from)?;
            let (generation, kept) = read.unwrap_or_default();
            show(folder, generation, &kept, as_json);
        }
        OffsetsCommand::Export(args) => {
            let kept = kept_for(config, folder)?;
            let text = var::export(&kept.offsets, units(args.units));
            if as_json {
                output::object(&json!({ "parameters": text }));
            } else {
                output::result(&text);
            }
        }
        OffsetsCommand::Set(args) => change(config, folder, as_json, |kept| set(kept, args))?,
        OffsetsCommand::Use(args) => change(config, folder, as_json, |kept| {
            kept.offsets.active = system_number(&args.system).ok_or_else(|| {
                Failure::Word(args.system.clone(), "give G54 to G59 or G59.1 to G59.3")
            })?;
            Ok(())
        })?,
        OffsetsCommand::Import(args) => {
            let text =
                text_file::read(&args.file, MOST_BYTES).map_err(FileError::open(&args.file))?;
            let imported = var::import(&text, units(args.units)).map_err(|error| Failure::Var {
                file: args.file.display().to_string(),
                error,
            })?;
            change(config, folder, as_json, |kept| {
                kept.offsets = imported.offsets.clone();
                Ok(())
            })?;
            if imported.g92_was_in_force {
                output::note("offsets: the offset of G92 was in force; it is kept and is not");
            }
            for (number, value) in &imported.others {
                output::note(&format!(
                    "offsets: parameter {number} = {value} is not kept here"
                ));
            }
        }
        OffsetsCommand::Adopt(_) => {
            let (mut store, _lock) = locked(folder)?;
            let (_, mut kept) = store.read().map_err(StateError::from)?.unwrap_or_default();
            kept.configuration = fingerprint(config);
            let generation = store.write(&kept).map_err(StateError::from)?;
            show(folder, generation, &kept, as_json);
        }
        OffsetsCommand::Recover(_) => {
            let (mut store, _lock) = locked(folder)?;
            let (generation, kept) = store.recover().map_err(|error| match error {
                source @ StoreError::Damaged { .. } => StateError::Lost {
                    folder: folder.display().to_string(),
                    source,
                },
                error => error.into(),
            })?;
            show(folder, generation, &kept, as_json);
        }
    }
    Ok(Exit::Done)
}

/// A folder that nobody else writes in.
fn locked(
    folder: &Path,
) -> Result<(Store<Directory>, glidepath_persistence::DirectoryLock), StateError> {
    let directory = Directory::open(folder)?;
    let lock = directory.lock()?;
    Ok((Store::new(directory), lock))
}

fn kept_for(config: &MachineConfig, folder: &Path) -> Result<PersistentState, StateError> {
    match Store::new(Directory::at(folder)).read()? {
        Some((_, kept)) => {
            of_machine(config, folder, &kept)?;
            Ok(kept)
        }
        None => Ok(PersistentState::default()),
    }
}

/// Changes what is kept, and shows it once it is written.
fn change(
    config: &MachineConfig,
    folder: &Path,
    as_json: bool,
    change: impl FnOnce(&mut PersistentState) -> Result<(), Failure>,
) -> Result<(), Failure> {
    let (mut store, _lock) = locked(folder)?;
    let mut kept = match store.read().map_err(StateError::from)? {
        Some((_, kept)) => {
            of_machine(config, folder, &kept)?;
            kept
        }
        None => PersistentState {
            configuration: fingerprint(config),
            ..PersistentState::default()
        },
    };
    change(&mut kept)?;
    let generation = store.write(&kept).map_err(StateError::from)?;
    show(folder, generation, &kept, as_json);
    Ok(())
}

fn set(kept: &mut PersistentState, args: &SetArgs) -> Result<(), Failure> {
    let offsets = &mut kept.offsets;
    let mut rotation_deg = None;
    let vector = match args.what.to_ascii_uppercase().as_str() {
        "G28" => &mut offsets.g28,
        "G30" => &mut offsets.g30,
        "G92" => &mut offsets.g92,
        name => {
            let number = system_number(name).ok_or_else(|| {
                let help = "give G54 to G59, G59.1 to G59.3, G28, G30 or G92";
                Failure::Word(args.what.clone(), help)
            })?;
            let system = &mut offsets.systems[usize::from(number - 1)];
            rotation_deg = Some(&mut system.rotation_deg);
            &mut system.origin
        }
    };
    let mut given = Vec::new();
    for word in &args.words {
        let refuse = || {
            let help = "give an axis and a number, such as X12.5, or R and an angle";
            Failure::Word(word.clone(), help)
        };
        let (letter, number) = word.split_at_checked(1).ok_or_else(refuse)?;
        let letter = letter.to_ascii_uppercase();
        if given.contains(&letter) {
            let help = "that axis was given before, and only one number can be meant";
            return Err(Failure::Word(word.clone(), help));
        }
        let value: f64 = number
            .parse()
            .ok()
            .filter(|v: &f64| v.abs() <= 1e9)
            .ok_or_else(refuse)?;
        match ("XYZABCUVW".find(&letter), &mut rotation_deg) {
            (Some(axis), _) => vector[axis] = value,
            (None, Some(rotation_deg)) if letter == "R" => {
                **rotation_deg = value;
            }
            _ => return Err(refuse()),
        }
        given.push(letter);
    }
    Ok(())
}

/// The number of a coordinate system, from 1.
fn system_number(name: &str) -> Option<u8> {
    (1..=9).find(|number| system_name(*number).eq_ignore_ascii_case(name))
}

fn units(args: UnitArgs) -> Units {
    Units {
        linear_mm: match args.linear_units {
            LinearUnits::Mm => 1.0,
            LinearUnits::Inch => 25.4,
        },
        angular_deg: match args.angular_units {
            AngularUnits::Degree => 1.0,
            AngularUnits::Radian => 180.0 / core::f64::consts::PI,
            AngularUnits::Grad => 0.9,
        },
    }
}

fn show(folder: &Path, generation: u64, kept: &PersistentState, as_json: bool) {
    if as_json {
        output::object(&object(folder, generation, kept));
    } else {
        output::result(&text(folder, generation, kept));
    }
}

/// Every vector that is kept, with its name and its rotation.
fn vectors(offsets: &Offsets) -> Vec<(String, [f64; AXES], f64)> {
    let systems = (1..).zip(&offsets.systems);
    let systems = systems.map(|(number, s)| (system_name(number), s.origin, s.rotation_deg));
    let others = [
        ("G28", offsets.g28),
        ("G30", offsets.g30),
        ("G92", offsets.g92),
    ];
    let others = others.map(|(name, vector)| (name.to_owned(), vector, 0.0));
    systems.chain(others).collect()
}

fn text(folder: &Path, generation: u64, kept: &PersistentState) -> String {
    let mut text = match generation {
        0 => format!("{}: nothing is kept yet\n", folder.display()),
        _ => format!(
            "{}: generation {generation}; mm, degrees, machine coordinates\n",
            folder.display()
        ),
    };
    for (name, vector, rotation_deg) in vectors(&kept.offsets) {
        let mut words = axis_words(&vector);
        if rotation_deg != 0.0 {
            words.push_str(&format!(" R{rotation_deg}"));
        }
        let words = if words.is_empty() {
            "0"
        } else {
            words.trim_start()
        };
        let is_active = name == system_name(kept.offsets.active);
        let remark = match name.as_str() {
            "G92" if words != "0" => {
                "   kept; `glidepath status` shows whether it is in force, and G92.3 puts it in force"
            }
            _ if is_active => "   programs begin here",
            _ => "",
        };
        text.push_str(&format!("  {name:<6}{words}{remark}\n"));
    }
    for tool in &kept.tools {
        let offset = axis_words(&tool.offset);
        let which = match tool.edge {
            1 => format!("T{} changed by G10", tool.number),
            edge => format!("T{} E{edge} changed by a program", tool.number),
        };
        text.push_str(&format!("  {which}: {offset} D{}\n", tool.diameter_mm));
    }
    if kept.spindle_tool != 0 {
        text.push_str(&format!(
            "  tool in the spindle, when last heard of: {}\n",
            kept.spindle_tool
        ));
    }
    if let Some(rest) = &kept.rest {
        let position = axis_words(&rest.position.map(|at| (at * 1e6).round() / 1e6));
        let position = if position.is_empty() { "0" } else { &position };
        let state = if rest.clean {
            "rested at"
        } else {
            "was moving; it set out from"
        };
        text.push_str(&format!(
            "  the machine {state} {position}, when last heard of\n"
        ));
    }
    if kept.under_way.is_some() {
        text.push_str("  a program has begun and has not come to its end\n");
    }
    text
}

fn object(folder: &Path, generation: u64, kept: &PersistentState) -> Value {
    let mut named = serde_json::Map::new();
    for (name, vector, rotation_deg) in vectors(&kept.offsets) {
        named.insert(
            name,
            json!({ "axes": vector, "rotation_deg": rotation_deg }),
        );
    }
    json!({
        "directory": folder.display().to_string(),
        "generation": generation,
        "active": system_name(kept.offsets.active),
        "offsets": named,
        "tools_changed": kept.tools.iter().map(|tool| json!({
            "number": tool.number,
            "edge": tool.edge,
            "offset": tool.offset,
            "diameter_mm": tool.diameter_mm,
            "orientation": tool.orientation,
        })).collect::<Vec<_>>(),
        "spindle_tool": kept.spindle_tool,
        "rest": kept.rest.map(|rest| json!({ "position": rest.position, "clean": rest.clean })),
        "program_under_way": kept.under_way.is_some(),
    })
}
