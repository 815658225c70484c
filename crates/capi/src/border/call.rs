//! The frame around every function: no panic leaves it, and a failure is kept as text.

use crate::failure::{Code, Failure, remember};
use std::panic::{AssertUnwindSafe, catch_unwind};

/// Returned where there is something, or it was done.
pub(super) const GOT: i32 = 1;
/// Returned where there is nothing.
pub(super) const NONE: i32 = 0;

/// Does what a function is for. Returns what it gives, or the code of its failure.
pub(super) fn call(body: impl FnOnce() -> Result<i32, Failure>) -> i32 {
    // What a panic leaves half done is a handle, which says so from then on.
    match catch_unwind(AssertUnwindSafe(body)) {
        Ok(Ok(value)) => value,
        Ok(Err(failure)) => {
            remember(format_args!("{failure}"));
            failure.code() as i32
        }
        Err(panic) => {
            let text = panic.downcast_ref::<&str>().copied();
            let text = text.or_else(|| panic.downcast_ref::<String>().map(String::as_str));
            remember(format_args!(
                "an error inside the library: {}; please report it",
                text.unwrap_or("no text")
            ));
            // Its destructor may panic, too.
            core::mem::forget(panic);
            Code::Panic as i32
        }
    }
}

/// The code of something that is there or not.
pub(super) const fn code_of(is_there: bool) -> i32 {
    if is_there { GOT } else { NONE }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::failure::with_last_error;

    #[test]
    #[allow(clippy::panic, reason = "that is what is tested")]
    fn a_panic_becomes_a_code_and_a_text() {
        assert_eq!(call(|| panic!("on purpose: {}", 7)), Code::Panic as i32);
        let text = with_last_error(|text| String::from_utf8_lossy(text).into_owned());
        assert!(text.contains("on purpose: 7"), "{text}");
        assert_eq!(call(|| panic!("plainly")), Code::Panic as i32);
        let text = with_last_error(|text| String::from_utf8_lossy(text).into_owned());
        assert!(text.contains("plainly"), "{text}");
    }

    #[test]
    fn a_failure_becomes_its_code_and_a_value_stays() {
        assert_eq!(call(|| Ok(GOT)), 1);
        let failed = call(|| Err(Failure::Argument("no such thing")));
        assert_eq!(failed, Code::Argument as i32);
        assert_eq!(with_last_error(<[u8]>::to_vec), b"no such thing");
    }

    #[test]
    fn a_text_that_is_too_long_is_cut_at_a_character() {
        remember(format_args!("{}", "ä".repeat(400)));
        assert_eq!(with_last_error(<[u8]>::to_vec), "ä".repeat(256).as_bytes());
        remember(format_args!("short"));
        assert_eq!(with_last_error(<[u8]>::to_vec), b"short");
    }
}
