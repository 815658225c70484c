//! The writer of a first `drives.toml`, from the devices found on the wire.

use super::found::Found;
use super::tables::Tables;
use super::written_probe::ProbeLines;
use core::fmt::Write as _;

/// The file: what was found as comments, a table for each drive, and one as a comment for each other device. What nobody but the builder of
/// the machine knows is left for them to fill in, in a way that is refused as it stands.
#[must_use]
pub fn written(interface: &str, found: &[Found]) -> String {
    let mut text = String::from(
        "# What hangs on the bus, and which joint each drive moves: see docs/drives.md.\n",
    );
    for item in found {
        let device = &item.device;
        let id = device.identity;
        let _ = writeln!(
            text,
            "#   {}  {:24} vendor {:#x}, product {:#x}, revision {:#x}, alias {}: {}",
            device.position,
            device.name,
            id.vendor,
            id.product,
            id.revision,
            device.alias,
            item.verdict()
        );
    }
    let _ = write!(
        text,
        "\n[bus]\ninterface = \"{interface}\"\nperiod_us = 2000      # between two frames; 1000, 2000 or 4000\n\
         shift_us = 1000       # from a frame to the SYNC0 at which it takes effect\n\
         delay_us = 3000       # how much later than they say setpoints are played; more than the shift\n\
         lost_frames = 3       # in a row, then every drive stops by itself\n\
         watchdog_ms = 10      # without frames, then every drive stops by itself\n"
    );
    let drives = found.iter().filter(|item| item.is_drive());
    let drives = drives.flat_map(|item| (0..item.axes).map(move |axis| (axis, item)));
    let probes = ProbeLines::of(found);
    for (joint, (axis, item)) in drives.enumerate() {
        let (device, id) = (&item.device, item.device.identity);
        let _ = write!(
            text,
            "\n[[drive]]                       # {}\njoint = {joint}\nposition = {}\nvendor = {:#x}\nproduct = {:#x}\n",
            device.name, device.position, id.vendor, id.product
        );
        if item.axes > 1 {
            let _ = writeln!(text, "axis = {axis}");
        }
        if device.alias != 0 {
            let _ = writeln!(text, "alias = {}", device.alias);
        }
        if device.process.is_none() {
            text.push_str(
                "# Its EEPROM does not say where its process data is: the start addresses of its sync managers\n\
                 # 2 and 3 by the manufacturer's ESI file.\n\
                 outputs_at = 0x0\n\
                 inputs_at = 0x0\n",
            );
        }
        let counts = item.counts_per_revolution.map_or_else(
            || "the counts of a revolution".to_owned(),
            |counts| format!("{counts} counts of a revolution, as it says"),
        );
        let _ = write!(
            text,
            "counts_per_mm = 0.0             # {counts}, over the mm of a revolution; or counts_per_deg\n\
             invert = false\n\
             home_offset = 0.0               # mm, where the joint is when the drive counts zero\n\
             following_error = 1.0           # mm, watched by the drive\n\
             following_ms = 10               # how long it may be further away\n\
             enable_window = 0.05            # mm, between where it stands and where it is to begin\n\
             quick_stop = 2000.0             # mm/s², the drive's own stop\n\
             # Without an absolute encoder:\n\
             # homing = {{ method = 17, fast = 20.0, slow = 2.0, acceleration = 500.0, sequence = 0 }}\n"
        );
        let probe = item.probes.get(usize::from(axis)).copied();
        probes.write(&mut text, joint, probe.unwrap_or_default());
    }
    let mut tables = Tables::default();
    for item in found.iter().filter(|item| !item.is_drive()) {
        tables.write(&mut text, &item.device, &item.windows, item.watchdog);
    }
    text
}
