//! The helper that the targets share: what stands behind the first null byte is the file that is
//! included, whatever its name.

use glidepath_migration::{Conversion, Include, ReadError};

pub fn convert(
    bytes: &[u8],
    from: impl FnOnce(&str, Include<'_>) -> Result<Conversion, ReadError>,
) {
    let Ok(text) = core::str::from_utf8(bytes) else {
        return;
    };
    let (text, included) = text.split_once('\0').unwrap_or((text, ""));
    match from(text, &|_| Ok(included.to_owned())) {
        Ok(conversion) => {
            toml::from_str::<toml::Table>(&conversion.configuration).expect("a table");
        }
        Err(error) => assert!(!error.place.is_empty() && !error.reason.is_empty()),
    }
}
