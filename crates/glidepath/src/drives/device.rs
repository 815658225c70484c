//! The judgement of devices that are no drives: what their inputs are, and what their outputs obey.

mod inputs;
mod joint_encoders;
mod outputs;

use super::encoder::encoder;
use super::raw_device::{RawDevice, RawEncoder, RawInput, RawParameter, RawSpindle};
use super::source::Place;
use super::spindle::spindle;
use super::words::{OBJECT, object};
use crate::config::{ConfigDiagnostic, Judge};
use core::ops::Range as Span;
use glidepath_ethercat::{
    At, DigitalInput, DriveSettings, EncoderSettings, Parameter, RefusedPart, SpindleSettings,
    TerminalSettings,
};
use toml::Spanned;

/// Maps that can be assigned.
const MAPS: usize = 16;
/// Bits of process data that a frame could have.
const BITS: i64 = 8 * 1486 - 1;

/// The claims of devices so far: no two may have the same.
#[derive(Debug, Default)]
struct Claims(Vec<(&'static str, usize)>);

impl Claims {
    /// Whether this one is new.
    fn take(&mut self, what: &'static str, number: usize) -> bool {
        let claim = (what, number);
        let is_new = !self.0.contains(&claim);
        self.0.push(claim);
        is_new
    }
}

/// The judge of devices.
struct Devices<'j> {
    judge: &'j mut Judge,
    /// Joints of the machine.
    joints: usize,
    /// Joints whose drives look for their home by themselves.
    homes_itself: Vec<usize>,
    /// Joints that turn on and on.
    turns_on: Vec<usize>,
    claims: Claims,
    /// Where each of them is in the file, and its inputs and outputs.
    places: Vec<Place>,
}

/// Inputs of drives, by the number of the drive.
type DriveInputs = Vec<(usize, DigitalInput)>;

/// Judges inputs of drives, a list for each, and all devices that are no drives.
pub(super) fn devices(
    judge: &mut Judge,
    (inputs, raw): (Vec<Vec<Spanned<RawInput>>>, Vec<Spanned<RawDevice>>),
    drives: &[(DriveSettings, Span<usize>)],
    joints: usize,
) -> (DriveInputs, Vec<TerminalSettings>, Vec<Place>) {
    let mut devices = Devices {
        judge,
        joints,
        homes_itself: (drives.iter())
            .filter(|(drive, _)| drive.homing.is_some())
            .map(|(drive, _)| drive.joint)
            .collect(),
        turns_on: (drives.iter())
            .filter(|(drive, _)| drive.is_modulo)
            .map(|(drive, _)| drive.joint)
            .collect(),
        claims: Claims::default(),
        places: Vec::new(),
    };
    for (drive, _) in drives {
        // Those of one device are at the same.
        devices.claims.take("position", drive.position);
    }
    let mut drive_inputs = Vec::new();
    for (nth, inputs) in inputs.into_iter().enumerate() {
        let judged = inputs
            .into_iter()
            .filter_map(|raw| devices.input(raw, true));
        drive_inputs.extend(judged.map(|input| (nth, input)));
    }
    let each = raw.into_iter().map(|raw| devices.device(raw)).collect();
    (drive_inputs, each, devices.places)
}

impl Devices<'_> {
    fn tell(&mut self, key: &str, message: String, help: &str, span: Span<usize>) {
        self.judge.diagnostics.push(ConfigDiagnostic {
            key: key.to_owned(),
            message,
            help: Some(help.to_owned()),
            span: Some(span),
        });
    }

    /// Keeps where something is in the file.
    fn note(&mut self, position: usize, at: Option<(At, bool)>, span: Span<usize>) {
        let part = RefusedPart { position, at };
        self.places.push(Place { part, span });
    }

    fn device(&mut self, raw: Spanned<RawDevice>) -> TerminalSettings {
        let span = raw.span();
        let raw = raw.into_inner();
        let help = "counted from the master on, from 0";
        let position = self
            .judge
            .whole("device.position", &raw.position, (0, 63), help);
        // One that is out of range is told as that, and takes no place.
        if let Some(position) = position
            && !self.claims.take("position", position)
        {
            let message = format!("two devices are at position {position}");
            let help = "every table has a place of its own in the line";
            self.tell("device.position", message, help, span.clone());
        }
        let position: usize = position.unwrap_or(0);
        self.note(position, None, span);
        let mut id = |key, value: &Option<Spanned<i64>>, most| {
            let help = "as `glidepath ethercat scan INTERFACE` shows it; 0 compares nothing";
            let value = value.as_ref()?;
            self.judge.whole(key, value, (0, most), help)
        };
        let vendor = id("device.vendor", &raw.vendor, u32::MAX.into());
        let product = id("device.product", &raw.product, u32::MAX.into());
        let alias: Option<u32> = id("device.alias", &raw.alias, u16::MAX.into());
        let assign_outputs = self.maps("device.assign_outputs", raw.assign_outputs, 0x1600);
        let assign_inputs = self.maps("device.assign_inputs", raw.assign_inputs, 0x1a00);
        let mut terminal = TerminalSettings {
            position,
            vendor: vendor.unwrap_or(0),
            product: product.unwrap_or(0),
            alias: alias
                .and_then(|alias| u16::try_from(alias).ok())
                .unwrap_or(0),
            assign_outputs,
            assign_inputs,
            ..TerminalSettings::default()
        };
        let parameters = raw.parameters.iter().filter_map(|p| self.parameter(p));
        terminal.parameters = parameters.collect();
        for raw in raw.inputs {
            let span = raw.span();
            if let Some(input) = self.input(raw, false) {
                self.note(position, Some((input.at, false)), span);
                terminal.inputs.push(input);
            }
        }
        for raw in &raw.analog_inputs {
            if let Some(input) = self.analog_input(raw) {
                self.note(position, Some((input.at, false)), raw.at.span());
                terminal.analog_inputs.push(input);
            }
        }
        self.outputs(&mut terminal, raw.outputs, &raw.analog_outputs);
        terminal.spindle = raw.spindle.and_then(|raw| self.spindle(&raw));
        terminal.encoder = raw.encoder.and_then(|raw| self.encoder(&raw));
        let of_joints = raw.joint_encoders.iter();
        let of_joints = of_joints.filter_map(|raw| self.joint_encoder(position, raw));
        terminal.joint_encoders = of_joints.collect();
        terminal
    }

    /// The drive of the spindle, which one device is.
    fn spindle(&mut self, raw: &Spanned<RawSpindle>) -> Option<SpindleSettings> {
        if !self.claims.take("spindle", 0) {
            let message = "two devices are the drive of the spindle".to_owned();
            self.tell(
                "device.spindle",
                message,
                "programs have one spindle",
                raw.span(),
            );
        }
        spindle(self.judge, raw.as_ref())
    }

    /// The encoder of the spindle, which one device has.
    fn encoder(&mut self, raw: &Spanned<RawEncoder>) -> Option<EncoderSettings> {
        if !self.claims.take("encoder", 0) {
            let message = "two devices have the encoder of the spindle".to_owned();
            let help = "programs have one spindle, and it has one angle";
            self.tell("device.encoder", message, help, raw.span());
        }
        encoder(self.judge, raw.as_ref())
    }

    fn maps(&mut self, key: &str, raw: Option<Vec<Spanned<i64>>>, first: i64) -> Option<Vec<u16>> {
        let raw = raw?;
        if raw.len() > MAPS {
            let message = format!("{key} has {} maps", raw.len());
            let span = raw[MAPS].span();
            self.tell(key, message, "no device takes more than 16", span);
        }
        let help =
            "the maps that the manufacturer's manual has for it, in the order to be assigned";
        let maps = raw
            .iter()
            .filter_map(|map| self.judge.whole(key, map, (first, first + 0x1ff), help));
        Some(maps.collect())
    }

    fn object(&mut self, key: &str, text: &Spanned<String>) -> Option<(u16, u8)> {
        let found = object(text.as_ref());
        if found.is_none() {
            let message = format!("{key} = \"{}\" is no object", text.as_ref());
            self.tell(key, message, OBJECT, text.span());
        }
        found
    }

    fn parameter(&mut self, raw: &RawParameter) -> Option<Parameter> {
        let (index, sub) = self.object("device.parameters.object", &raw.object)?;
        let bytes = *raw.bytes.as_ref();
        let size = match bytes {
            1 | 2 | 4 | 8 => u8::try_from(bytes).unwrap_or(1),
            _ => {
                let message = format!("device.parameters.bytes = {bytes} is not known");
                let help = "give 1, 2, 4 or 8";
                self.tell("device.parameters.bytes", message, help, raw.bytes.span());
                return None;
            }
        };
        // TOML has no larger numbers than those of eight bytes with a sign.
        let range = match size {
            8 => (i64::MIN, i64::MAX),
            size => (-(1 << (8 * size - 1)), (1 << (8 * size)) - 1),
        };
        let help = "as many bytes as the object has";
        let key = "device.parameters.value";
        let value: i64 = self.judge.whole(key, &raw.value, range, help)?;
        #[allow(
            clippy::cast_sign_loss,
            reason = "a negative number is written as its bits"
        )]
        let value = value as u64;
        Some(Parameter {
            index,
            sub,
            size,
            value,
        })
    }

    /// Where a digital input or output is: an object, or a bit.
    fn at(
        &mut self,
        key: &str,
        (at, bit): (Option<&Spanned<String>>, Option<&Spanned<i64>>),
        span: Span<usize>,
    ) -> Option<At> {
        match (at, bit) {
            (Some(at), None) => {
                let (index, sub) = self.object(&format!("{key}.at"), at)?;
                Some(At::Object { index, sub })
            }
            (None, Some(bit)) => {
                let help = "counted from the first of its inputs or outputs, from 0";
                let key = format!("{key}.bit");
                let bit = self.judge.whole(&key, bit, (0, BITS), help)?;
                Some(At::Bit(bit))
            }
            _ => {
                let message = "it has `at`, or `bit`".to_owned();
                self.tell(key, message, OBJECT, span);
                None
            }
        }
    }
}
