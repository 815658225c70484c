//! The rendering of the lists as text: for the header, the Python package, and the manual.

use super::abi::{ABI, LAYOUT, STRUCTURES};
use super::codes::{Codes, codes};
use super::structure::{Field, Structure};
use core::fmt::Write as _;

/// Columns of a comment.
const WIDTH: usize = 96;

/// Breaks a text into lines of so many columns.
fn wrapped(text: &str, width: usize) -> Vec<String> {
    let mut lines = vec![String::new()];
    for word in text.split_whitespace() {
        let last = lines.last().map_or(0, String::len);
        if last > 0 && last + 1 + word.len() > width {
            lines.push(String::new());
        }
        if let Some(line) = lines.last_mut() {
            if !line.is_empty() {
                line.push(' ');
            }
            line.push_str(word);
        }
    }
    lines
}

/// A comment of C on lines of its own.
fn comment(out: &mut String, indent: &str, text: &str) {
    let lines = wrapped(text, WIDTH - indent.len() - 6);
    let joined = lines.join(&format!("\n{indent}   "));
    let _ = writeln!(out, "{indent}/* {joined} */");
}

fn declaration(field: &Field) -> String {
    match field.count {
        0 => format!("{} {};", field.element, field.name),
        count => format!("{} {}[{count}];", field.element, field.name),
    }
}

fn codes_in_c(out: &mut String, codes: &Codes) {
    out.push('\n');
    comment(out, "", codes.about);
    out.push_str("enum {\n");
    let values: Vec<_> = codes
        .values
        .iter()
        .map(|(name, value)| {
            let value = match (codes.are_bits, *value >= 0x100) {
                (true, _) | (_, true) => format!("{value:#x}"),
                _ => value.to_string(),
            };
            format!("    GP_{}_{name} = {value}", codes.prefix)
        })
        .collect();
    out.push_str(&values.join(",\n"));
    out.push_str("\n};\n");
}

fn structure_in_c(out: &mut String, structure: &Structure) {
    out.push('\n');
    let record = match structure.record {
        "" => String::new(),
        record => format!(" The record {record}."),
    };
    comment(out, "", &format!("{}{record}", structure.about));
    let name = structure.name;
    let _ = writeln!(out, "typedef struct {name} {{");
    for field in structure.fields {
        comment(out, "    ", field.about);
        let _ = writeln!(out, "    {}", declaration(field));
    }
    let _ = writeln!(out, "}} {name};");
    let _ = writeln!(
        out,
        "GP_ASSERT(sizeof({name}) == {}, \"{name} has another size\");",
        structure.size
    );
    for field in structure.fields {
        let Field {
            name: field,
            offset,
            size,
            ..
        } = field;
        let _ = writeln!(out, "GP_FIELD({name}, {field}, {offset}, {size});");
    }
}

/// Constants and structures of the header.
pub(super) fn header() -> String {
    let mut out = String::new();
    out.push_str("/* The version of the ABI: functions and structures. */\n");
    let _ = writeln!(out, "#define GP_ABI {ABI}u");
    out.push_str("/* What the structures of this header are, as one number. */\n");
    let _ = writeln!(out, "#define GP_LAYOUT UINT64_C(0x{LAYOUT:016x})");
    out.push_str("/* Axes X Y Z A B C U V W, and joints J0 to J8. */\n");
    let _ = writeln!(out, "#define GP_AXES {}", glidepath_geometry::AXES);
    for codes in codes() {
        codes_in_c(&mut out, &codes);
    }
    for structure in STRUCTURES {
        structure_in_c(&mut out, structure);
    }
    out
}

/// `gp_servo_state` as `ServoState`.
fn class(name: &str) -> String {
    let words = name.trim_start_matches("gp_").split('_');
    words
        .map(|word| {
            let (first, rest) = word.split_at(1);
            first.to_uppercase() + rest
        })
        .collect()
}

fn in_ctypes(field: &Field) -> String {
    let element = match field.element {
        "uint32_t" => "ctypes.c_uint32".to_owned(),
        "uint64_t" => "ctypes.c_uint64".to_owned(),
        "double" => "ctypes.c_double".to_owned(),
        "char" => "ctypes.c_char".to_owned(),
        structure => class(structure),
    };
    match field.count {
        0 => element,
        count => format!("{element} * {count}"),
    }
}

/// The module of the Python package that has constants and structures.
pub(super) fn python() -> String {
    let mut out = String::from(
        "\"\"\"Constants and structures of libglidepath.\n\nWritten by a test of the library: do not \
         change it here.\n\"\"\"\n\nimport ctypes\nimport enum\n",
    );
    let _ = writeln!(out, "\nABI = {ABI}\nLAYOUT = 0x{LAYOUT:016x}");
    let _ = writeln!(out, "AXES = {}", glidepath_geometry::AXES);
    for codes in codes() {
        let kind = if codes.are_bits { "IntFlag" } else { "IntEnum" };
        let name = match codes.prefix {
            "E" => "ErrorCode".to_owned(),
            prefix => class(&prefix.to_lowercase()),
        };
        let _ = writeln!(out, "\n\nclass {name}(enum.{kind}):");
        let _ = writeln!(out, "    \"\"\"{}\"\"\"\n", codes.about.trim());
        for (name, value) in &codes.values {
            let _ = writeln!(out, "    {name} = {value}");
        }
    }
    for structure in STRUCTURES {
        let _ = writeln!(
            out,
            "\n\nclass {}Record(ctypes.Structure):",
            class(structure.name)
        );
        let about = wrapped(structure.about, 88).join("\n    ");
        let _ = writeln!(out, "    \"\"\"{about}\"\"\"\n\n    _fields_ = [");
        for field in structure.fields {
            let ty = in_ctypes(field);
            let ty = if field.element.starts_with("gp_") {
                ty.replacen(
                    &class(field.element),
                    &format!("{}Record", class(field.element)),
                    1,
                )
            } else {
                ty
            };
            let _ = writeln!(out, "        (\"{}\", {ty}),", field.name);
        }
        out.push_str("    ]\n");
    }
    out.push_str("\n\n# Size, and where every field is: held against the structures above when this is loaded.\nPLACES = {\n");
    for structure in STRUCTURES {
        let _ = writeln!(
            out,
            "    {}Record: ({}, {{",
            class(structure.name),
            structure.size
        );
        for field in structure.fields {
            let _ = writeln!(out, "        \"{}\": {},", field.name, field.offset);
        }
        out.push_str("    }),\n");
    }
    out.push_str("}\n");
    out
}

/// The manual's page of offsets.
pub(super) fn page() -> String {
    let mut out = String::from(
        "# The ABI of libglidepath\n\n<!-- Written by a test: GLIDEPATH_BLESS=1 cargo test -p \
         glidepath-capi --lib -->\n\n",
    );
    let _ = writeln!(
        out,
        "Version {ABI}, layout `{LAYOUT:016x}`. For programs that cannot read\n\
         [`glidepath.h`](../../capi/include/glidepath.h); how the library is used is in \
         [consumers](consumers.md).\n\nAll numbers are little-endian; `double` is IEEE 754 of 64 \
         bits. Every structure is aligned to 8 bytes,\nand no byte is unused. A byte that moves \
         is a new version, and `gp_open` refuses a program of another one.\n"
    );
    let _ = writeln!(out, "## Structures");
    for structure in STRUCTURES {
        let _ = writeln!(out, "\n### `{}`\n", structure.name);
        let record = match structure.record {
            "" => String::new(),
            record => format!(" The record `{record}`."),
        };
        let about = wrapped(&format!("{}{record}", structure.about), 110).join("\n");
        let _ = writeln!(out, "{about} {} bytes.\n", structure.size);
        let _ = writeln!(out, "| offset | type | field | |\n|---|---|---|---|");
        for field in structure.fields {
            let ty = match field.count {
                0 => field.element.to_owned(),
                count => format!("{}[{count}]", field.element),
            };
            let about = wrapped(field.about, usize::MAX).join(" ");
            let _ = writeln!(
                out,
                "| {} | `{ty}` | `{}` | {about} |",
                field.offset, field.name
            );
        }
    }
    let _ = writeln!(out, "\n## Numbers");
    for codes in codes() {
        let _ = writeln!(out, "\n### `GP_{}_…`\n\n{}\n", codes.prefix, codes.about);
        let _ = writeln!(out, "| | |\n|---|---|");
        for (name, value) in &codes.values {
            let _ = writeln!(out, "| {value} | `GP_{}_{name}` |", codes.prefix);
        }
    }
    out
}
