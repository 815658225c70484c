//! Whose configuration a text is, by what no other control writes.

use core::ops::Range;

/// A control whose configuration can be converted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Control {
    /// LinuxCNC: its machine configuration, an ini.
    LinuxCnc,
    /// grbl or grblHAL: its settings.
    Grbl,
    /// Klipper: its printer.cfg.
    Klipper,
}

impl Control {
    /// What the file is, in words.
    #[must_use]
    pub const fn file(self) -> &'static str {
        match self {
            Self::LinuxCnc => "LinuxCNC's machine configuration (an ini file)",
            Self::Grbl => "a list of grbl's settings, as `$$` prints them",
            Self::Klipper => "Klipper's printer.cfg",
        }
    }

    /// The command that converts it.
    #[must_use]
    pub const fn command(self) -> &'static str {
        match self {
            Self::LinuxCnc => "config from-linuxcnc",
            Self::Grbl => "config from-grbl",
            Self::Klipper => "config from-klipper",
        }
    }
}

/// What a text was recognised by.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Recognised {
    /// Whose configuration it is.
    pub control: Control,
    /// The bytes of the line that says so.
    pub line: Range<usize>,
}

/// Sections that only LinuxCNC has.
const LINUXCNC: [&str; 6] = ["EMC", "EMCMOT", "EMCIO", "KINS", "TRAJ", "RS274NGC"];

/// Sections that only Klipper has, besides those of its motors.
const KLIPPER: [&str; 2] = ["printer", "mcu"];

/// Whose configuration a text is; `None`: nobody's that is known, or one of ours.
#[must_use]
pub fn recognised(text: &str) -> Option<Recognised> {
    let mut found = None;
    let mut at = 0;
    for line in text.split_inclusive('\n') {
        let start = at + (line.len() - line.trim_start_matches('\u{feff}').trim_start().len());
        let bare = line.trim_start_matches('\u{feff}').trim();
        at += line.len();
        // Ours: a table of an axis.
        if bare.starts_with("[axis.") {
            return None;
        }
        if found.is_none() {
            found = control_of(bare).map(|control| Recognised {
                control,
                line: start..start + bare.len(),
            });
        }
    }
    found
}

/// The control that a line is of, where only one has such lines.
fn control_of(line: &str) -> Option<Control> {
    if is_setting(line) {
        return Some(Control::Grbl);
    }
    let name = line.strip_prefix('[')?.split(']').next()?.trim();
    let is_numbered = |begin: &str, last: fn(u8) -> bool| {
        name.strip_prefix(begin)
            .is_some_and(|rest| matches!(rest.as_bytes(), [only] if last(*only)))
    };
    let is_linuxcnc = LINUXCNC.contains(&name)
        || is_numbered("JOINT_", |last| last.is_ascii_digit())
        || is_numbered("AXIS_", |last| last.is_ascii_alphanumeric());
    let is_klipper =
        KLIPPER.contains(&name) || is_numbered("stepper_", |last| last.is_ascii_lowercase());
    match (is_linuxcnc, is_klipper) {
        (true, _) => Some(Control::LinuxCnc),
        (_, true) => Some(Control::Klipper),
        _ => None,
    }
}

/// A line such as `$110=5000.000`.
fn is_setting(line: &str) -> bool {
    let setting = line.trim_start_matches(['>', '<']).strip_prefix('$');
    setting
        .and_then(|rest| rest.split_once('='))
        .is_some_and(|(number, _)| {
            !number.is_empty() && number.bytes().all(|byte| byte.is_ascii_digit())
        })
}

#[cfg(test)]
mod tests {
    use super::{Control, recognised};

    #[test]
    fn a_file_is_known_by_what_only_its_control_writes() {
        for (text, control) in [
            (
                "# a mill\n[EMCMOT]\nEMCMOT = motmod\n",
                Some(Control::LinuxCnc),
            ),
            (
                "\u{feff}[AXIS_X]\r\nMAX_VELOCITY = 100\r\n",
                Some(Control::LinuxCnc),
            ),
            ("[JOINT_3]\n", Some(Control::LinuxCnc)),
            (
                "ok\n$0=10\n$110=5000.000 (x max rate)\n",
                Some(Control::Grbl),
            ),
            (
                "[include a.cfg]\n[stepper_x]\nstep_pin: PF0\n",
                Some(Control::Klipper),
            ),
            ("[mcu]\nserial: /dev/ttyUSB0\n", Some(Control::Klipper)),
            ("[axis.X]\nmax_velocity = 1\n[TRAJ]\n", None),
            ("[path]\ntolerance = 0.1\n", None),
            ("[axis_x]\n[joint_1]\n[printers]\n$x=1\n", None),
            ("", None),
        ] {
            let found = recognised(text);
            assert_eq!(found.as_ref().map(|it| it.control), control, "{text}");
            if let Some(found) = found {
                let line = text.get(found.line.clone());
                assert!(
                    line.is_some_and(|line| line.starts_with(['[', '$'])),
                    "{found:?}"
                );
            }
        }
    }
}
