//! The progress bar: on standard error, and only if that is a terminal.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// A file shorter than this is read before anybody could look at a bar.
const LONG_BYTES: u64 = 1 << 20;

/// A bar, and what stands beside it.
#[derive(Debug)]
pub struct Progress(ProgressBar);

impl Progress {
    /// A bar that counts the lines of a program, with the time to go; none with `--json`.
    #[must_use]
    pub fn lines(total: u64, json: bool) -> Self {
        let style = "{msg:10} {wide_bar} line {human_pos} of {human_len}, {elapsed}, {eta} to go";
        Self::counting(total, style, json)
    }

    /// A bar that counts the bytes of a file being read, with the time to go; none with `--json`,
    /// and none for a file that is read at once.
    #[must_use]
    pub fn bytes(total: u64, json: bool) -> Self {
        let style = "{msg:10} {wide_bar} {bytes} of {total_bytes}, {elapsed}, {eta} to go";
        Self::counting(total, style, json || total < LONG_BYTES)
    }

    fn counting(total: u64, style: &str, is_hidden: bool) -> Self {
        let target = if is_hidden {
            ProgressDrawTarget::hidden()
        } else {
            // Hides itself where standard error is not a terminal.
            ProgressDrawTarget::stderr()
        };
        let bar = ProgressBar::with_draw_target(Some(total), target);
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

    /// The count and its time begin anew.
    pub fn start_again(&self) {
        self.0.reset();
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
            self.0.println(crate::output::shown(text));
        }
    }

    /// Takes the bar away.
    pub fn finish(&self) {
        self.0.finish_and_clear();
    }
}
