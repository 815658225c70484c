//! `glidepath config`: the configuration itself.

use crate::cli::{ConfigAction, ConfigArgs, ConfigSource, ScrewArgs, ScrewUnit, Values};
use crate::command::failure::Failure;
use crate::command::named_files;
use crate::config::{self, ConfigDiagnostic, ConfigError, keys};
use crate::exit::Exit;
use crate::file_error::FileError;
use crate::output;
use crate::text_file;
use glidepath_migration::{ScrewValues, from_grbl, from_klipper, from_linuxcnc, from_screw};
use serde_json::{Value, json};
use std::path::Path;

/// Prints, explains or checks a configuration.
///
/// # Errors
/// The configuration is refused, or a key does not exist.
pub(super) fn configuration(args: &ConfigArgs) -> Result<Exit, Failure> {
    if let Some(from) = &args.from {
        return converted(from, args.json);
    }
    let ConfigAction {
        explain,
        check: file,
        ..
    } = &args.action;
    match (explain, file) {
        (Some(key), _) => explained(key.as_deref(), args.json),
        (_, Some(file)) => checked(file, args.json),
        // The arguments ask for exactly one of the three.
        (None, None) => {
            let text = config::EMBEDDED;
            if args.json {
                output::object(&json!({ "configuration": text }));
            } else {
                output::result(text);
            }
            Ok(Exit::Done)
        }
    }
}

/// Explains the keys that a name asks for, or all of them.
fn explained(name: Option<&str>, as_json: bool) -> Result<Exit, Failure> {
    let found = match name {
        Some(name) => keys::asked(name),
        None => keys::all().collect(),
    };
    if found.is_empty() {
        let key = name.unwrap_or_default();
        return Err(Failure::UnknownKey {
            key: key.to_owned(),
            nearest: keys::nearest(key),
        });
    }
    if as_json {
        let keys: Vec<Value> = found
            .iter()
            .map(|key| {
                json!({
                    "key": key.name,
                    "meaning": key.meaning,
                    "unit": key.takes.unit(),
                    "takes": key.takes,
                    "left_out": key.left_out,
                })
            })
            .collect();
        output::object(&json!({ "keys": keys }));
        return Ok(Exit::Done);
    }
    let mut text = String::new();
    for key in found {
        text.push_str(&format!(
            "{}\n  {}\n  {}; {}\n",
            key.name,
            key.meaning,
            key.takes.words(),
            key.left_out.words()
        ));
    }
    if text.contains("axis.X") || text.contains("joint.J0") {
        text.push_str(
            "\naxis.X stands for each axis (X Y Z A B C U V W), joint.J0 for each joint.\n",
        );
    }
    output::result(&text);
    Ok(Exit::Done)
}

/// Lists everything that has to be mended in a configuration, and in the files that it names.
fn checked(file: &Path, as_json: bool) -> Result<Exit, Failure> {
    let machine = config::load(Some(file))?;
    let found = named_files::findings(&machine);
    if !found.is_empty() {
        // What came through a pipe is gone: then nothing can be pointed at.
        let text = text_file::read(file, config::MOST_BYTES).unwrap_or_default();
        let found = found.into_iter().map(|finding| ConfigDiagnostic {
            span: config::place(&text, finding.key),
            key: finding.key.to_owned(),
            message: finding.message,
            help: Some(finding.help),
        });
        let diagnostics = found.collect();
        return Err(Failure::Configuration(ConfigError::Refused {
            path: file.display().to_string(),
            text,
            diagnostics,
        }));
    }
    let axes: Vec<String> = machine
        .axis_names()
        .iter()
        .map(ToString::to_string)
        .collect();
    let name = file.display();
    if as_json {
        output::object(&json!({
            "configuration": name.to_string(),
            "axes": axes,
            "findings": [],
        }));
    } else {
        output::result(&format!(
            "{name}: no findings; a machine with the axes {}\n",
            axes.join(" ")
        ));
    }
    Ok(Exit::Done)
}

/// Largest file of another control, bytes.
const MOST_BYTES: u64 = 4 << 20;

/// Converts the configuration of another control.
fn converted(from: &ConfigSource, as_json: bool) -> Result<Exit, Failure> {
    let args = match from {
        ConfigSource::FromScrew(args) => return screw(args, as_json),
        ConfigSource::FromLinuxcnc(args)
        | ConfigSource::FromGrbl(args)
        | ConfigSource::FromKlipper(args) => args,
    };
    let text = text_file::read(&args.file, MOST_BYTES).map_err(FileError::open(&args.file))?;
    // Included files are named from where the first one is.
    let folder = args.file.parent().unwrap_or(Path::new(""));
    let include = |name: &str| {
        let path = folder.join(name);
        // The name is what a file says: it must not keep the command waiting at a pipe.
        if path.metadata().is_ok_and(|there| !there.is_file()) {
            return Err("it is no ordinary file".to_owned());
        }
        text_file::read(&path, MOST_BYTES).map_err(|error| error.to_string())
    };
    let converted = match from {
        ConfigSource::FromGrbl(_) => from_grbl(&text),
        ConfigSource::FromKlipper(_) => from_klipper(&text, &include),
        ConfigSource::FromLinuxcnc(_) | ConfigSource::FromScrew(_) => {
            from_linuxcnc(&text, &include)
        }
    };
    let conversion = converted.map_err(|error| Failure::Foreign {
        file: args.file.display().to_string(),
        error,
    })?;
    if as_json {
        output::object(&conversion);
    } else {
        output::result(&conversion.configuration);
        output::note(&format!(
            "{} keys converted, {} changed in meaning, {} without a counterpart; {} to be written \
             before it loads",
            conversion.converted.len(),
            conversion.changed.len(),
            conversion.no_counterpart.len(),
            conversion.asked.len()
        ));
    }
    Ok(Exit::Done)
}

/// Makes the compensation of a joint from a measured screw.
fn screw(args: &ScrewArgs, as_json: bool) -> Result<Exit, Failure> {
    let text = text_file::read(&args.file, MOST_BYTES).map_err(FileError::open(&args.file))?;
    let values = match args.values {
        Values::Measured => ScrewValues::Measured,
        Values::Errors => ScrewValues::Errors,
        Values::Trims => ScrewValues::Trims,
    };
    let mm_per_unit = match args.unit {
        ScrewUnit::Mm => 1.0,
        ScrewUnit::Inch => 25.4,
    };
    let table = from_screw(&text, args.joint, values, mm_per_unit);
    let table = table.map_err(|error| Failure::Foreign {
        file: args.file.display().to_string(),
        error,
    })?;
    if as_json {
        output::object(&json!({ "configuration": table }));
    } else {
        output::result(&table);
    }
    Ok(Exit::Done)
}
