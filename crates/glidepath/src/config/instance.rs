//! The names of instances: what a name of a machine in shared memory may be.

/// What [`is_instance_name`] accepts, in words.
pub const INSTANCE_RULE: &str =
    "give 1 to 32 letters a-z, digits, `-` or `_`, for example \"mill-1\"";

/// True for a name that can become part of file names in shared memory.
#[must_use]
pub fn is_instance_name(name: &str) -> bool {
    (1..=32).contains(&name.len())
        && name
            .bytes()
            .all(|b| b.is_ascii_lowercase() || b.is_ascii_digit() || b"-_".contains(&b))
}
