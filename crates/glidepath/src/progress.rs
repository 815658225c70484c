//! The progress bar: on standard error, and only if that is a terminal.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// A bar that counts the lines of a program.
#[derive(Debug)]
pub struct Progress(ProgressBar);

impl Progress {
    /// A bar for `total` lines.
    #[must_use]
    pub fn lines(total: u64) -> Self {
        // Hides itself where standard error is not a terminal.
        let bar = ProgressBar::with_draw_target(Some(total), ProgressDrawTarget::stderr());
        let style = "{msg:10} {wide_bar} line {human_pos} of {human_len}, {elapsed}";
        if let Ok(style) = ProgressStyle::with_template(style) {
            bar.set_style(style);
        }
        Self(bar)
    }

    /// A bar that counts the seconds of a measurement.
    #[must_use]
    pub fn seconds(total: u64) -> Self {
        let bar = ProgressBar::with_draw_target(Some(total), ProgressDrawTarget::stderr());
        if let Ok(style) = ProgressStyle::with_template("{msg:10} {wide_bar} {pos} of {len} s") {
            bar.set_style(style);
        }
        Self(bar)
    }

    /// A bar of so many steps that tells nothing but their share.
    #[must_use]
    pub fn share(total: u64) -> Self {
        let bar = ProgressBar::with_draw_target(Some(total), ProgressDrawTarget::stderr());
        if let Ok(style) =
            ProgressStyle::with_template("{msg:10} {wide_bar} {percent} %, {elapsed}")
        {
            bar.set_style(style);
        }
        Self(bar)
    }

    /// What is being done.
    pub fn doing(&self, what: &'static str) {
        self.0.set_message(what);
    }

    /// The line or second reached.
    pub fn at(&self, position: u64) {
        self.0.set_position(position);
    }

    /// Prints a line above the bar, or to standard error where there is no bar.
    pub fn note(&self, text: &str) {
        if self.0.is_hidden() {
            crate::output::note(text);
        } else {
            self.0.println(text);
        }
    }

    /// Takes the bar away.
    pub fn finish(&self) {
        self.0.finish_and_clear();
    }
}
