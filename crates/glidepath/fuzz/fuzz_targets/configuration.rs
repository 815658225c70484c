//! The fuzz target: any text is a configuration or is refused with a place; what is accepted can be
//! planned with.
#![no_main]

use glidepath::config::parse;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let Ok(text) = core::str::from_utf8(bytes) else {
        return;
    };
    match parse("fuzzed", text) {
        Ok(config) => {
            assert!(!config.axes.is_empty() && config.period_t() > 0.0);
            let (low, high) = config.travel();
            assert!(low.iter().zip(high.iter()).all(|(low, high)| low < high));
            assert!(config.home().iter().all(|p| p.is_finite()));
        }
        Err(error) => assert!(!error.diagnostics().is_empty()),
    }
});
