//! The checks of records that another process wrote, and their errors.

use super::{OVERRIDE_MAX, Record, code::Code};

/// The reason why a record is not to be used. `record` is its name with version.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum RecordError {
    /// The bytes are of another length: another version, or cut short.
    #[error("{record}: {actual} bytes, expected {expected}")]
    Size {
        /// The record.
        record: &'static str,
        /// Its size.
        expected: usize,
        /// What was found.
        actual: usize,
    },
    /// A number is infinite or not a number.
    #[error("{record}: {field}[{index}] is not finite")]
    NotFinite {
        /// The record.
        record: &'static str,
        /// The field.
        field: &'static str,
        /// Element of an array field, 0 for a single number.
        index: usize,
    },
    /// A number is outside its range.
    #[error("{record}: {field} is {value}, allowed are {low} to {high}")]
    OutOfRange {
        /// The record.
        record: &'static str,
        /// The field.
        field: &'static str,
        /// What was found.
        value: f64,
        /// Smallest allowed value.
        low: f64,
        /// Largest allowed value.
        high: f64,
    },
    /// A code this version does not know.
    #[error("{record}: {field} has the unknown code {code}")]
    UnknownCode {
        /// The record.
        record: &'static str,
        /// The field.
        field: &'static str,
        /// What was found.
        code: u32,
    },
    /// Flag bits this version does not know.
    #[error("{record}: {field} has the unknown bits {bits:#x}")]
    UnknownFlags {
        /// The record.
        record: &'static str,
        /// The field.
        field: &'static str,
        /// The unknown bits alone.
        bits: u32,
    },
    /// A text is not UTF-8.
    #[error("{record}: {field} is not UTF-8")]
    NotText {
        /// The record.
        record: &'static str,
        /// The field.
        field: &'static str,
    },
    /// A field that must be zero in this version is not.
    #[error("{record}: {field} must be zero")]
    NotZero {
        /// The record.
        record: &'static str,
        /// The field.
        field: &'static str,
    },
}

/// Reads a record from foreign bytes, of any alignment.
///
/// # Errors
///
/// [`RecordError::Size`] if the length is not that of the record, else what [`Record::check`]
/// finds.
pub fn decode<R: Record>(bytes: &[u8]) -> Result<R, RecordError> {
    let record: R = bytemuck::try_pod_read_unaligned(bytes).map_err(|_| RecordError::Size {
        record: R::NAME,
        expected: size_of::<R>(),
        actual: bytes.len(),
    })?;
    record.check()?;
    Ok(record)
}

/// Checks of single fields, with the name of the record for the errors.
#[derive(Clone, Copy)]
pub(crate) struct Fields(pub(crate) &'static str);

impl Fields {
    pub(crate) fn finite(self, field: &'static str, value: f64) -> Result<(), RecordError> {
        self.all_finite(field, &[value])
    }

    pub(crate) fn all_finite(self, field: &'static str, values: &[f64]) -> Result<(), RecordError> {
        match values.iter().position(|value| !value.is_finite()) {
            Some(index) => Err(RecordError::NotFinite {
                record: self.0,
                field,
                index,
            }),
            None => Ok(()),
        }
    }

    pub(crate) fn range(
        self,
        field: &'static str,
        value: f64,
        low: f64,
        high: f64,
    ) -> Result<(), RecordError> {
        self.finite(field, value)?;
        if (low..=high).contains(&value) {
            Ok(())
        } else {
            Err(RecordError::OutOfRange {
                record: self.0,
                field,
                value,
                low,
                high,
            })
        }
    }

    /// An override as commanded, 0 included.
    pub(crate) fn override_ratio(self, field: &'static str, value: f64) -> Result<(), RecordError> {
        self.range(field, value, 0.0, OVERRIDE_MAX)
    }

    /// An override as commanded, below 0 for the way back.
    pub(crate) fn signed_override(
        self,
        field: &'static str,
        value: f64,
    ) -> Result<(), RecordError> {
        self.range(field, value, -OVERRIDE_MAX, OVERRIDE_MAX)
    }

    pub(crate) fn code<C: Code>(self, field: &'static str, code: u32) -> Result<C, RecordError> {
        C::known(code).ok_or(RecordError::UnknownCode {
            record: self.0,
            field,
            code,
        })
    }

    pub(crate) fn flags(
        self,
        field: &'static str,
        bits: u32,
        known: u32,
    ) -> Result<(), RecordError> {
        match bits & !known {
            0 => Ok(()),
            bits => Err(RecordError::UnknownFlags {
                record: self.0,
                field,
                bits,
            }),
        }
    }

    pub(crate) fn zero(self, field: &'static str, value: u32) -> Result<(), RecordError> {
        if value == 0 {
            Ok(())
        } else {
            Err(RecordError::NotZero {
                record: self.0,
                field,
            })
        }
    }

    /// A whole number carried as `f64`, in the range of `u32`.
    pub(crate) fn whole(self, field: &'static str, value: f64) -> Result<u32, RecordError> {
        let high = f64::from(u32::MAX);
        self.range(field, value, 0.0, high)?;
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "the range was checked, the fraction is checked next"
        )]
        let whole = value as u32;
        if f64::from(whole).to_bits() == (value + 0.0).to_bits() {
            Ok(whole)
        } else {
            Err(RecordError::OutOfRange {
                record: self.0,
                field,
                value,
                low: 0.0,
                high,
            })
        }
    }
}
