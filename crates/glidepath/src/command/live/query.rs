//! Fingerprints as pages write them into their questions.

/// A fingerprint as pages are told it; `None` if it is none.
pub(super) fn fingerprint(text: &str) -> Option<u64> {
    let fingerprint = u64::from_str_radix(text, 16).ok();
    fingerprint.filter(|fingerprint| text.len() == 16 && *fingerprint != 0)
}
