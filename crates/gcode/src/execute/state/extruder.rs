//! The mode of a printer's E words: absolute or relative.
//!
//! | | Marlin | Klipper |
//! |---|---|---|
//! | `G91` | relative | relative |
//! | `G90` | absolute | as `M82` or `M83` said |
//! | `M82`, `M83` | absolute, relative | absolute, relative, unless G91 is in force |

use serde::{Deserialize, Serialize};

use crate::setup::firmware::Firmware;

/// What a printer's program has said of its E words.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub(crate) struct ExtruderMode {
    /// By the last of G90, G91, M82 and M83.
    by_last: bool,
    /// By the last of M82 and M83.
    by_code: bool,
    /// G91 is in force.
    incremental: bool,
}

impl ExtruderMode {
    /// G90 or G91.
    pub(crate) const fn distance(&mut self, incremental: bool) {
        self.by_last = incremental;
        self.incremental = incremental;
    }

    /// M82 or M83.
    pub(crate) const fn code(&mut self, relative: bool) {
        self.by_last = relative;
        self.by_code = relative;
    }

    /// Whether E words are relative; `None` where that depends on a firmware that is not known.
    pub(crate) const fn is_relative(self, firmware: Option<Firmware>) -> Option<bool> {
        let klipper = self.incremental || self.by_code;
        match firmware {
            Some(Firmware::Marlin) => Some(self.by_last),
            Some(Firmware::Klipper) => Some(klipper),
            None if self.by_last == klipper => Some(klipper),
            None => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn g90_behind_m83_depends_on_the_firmware() {
        let mut mode = ExtruderMode::default();
        assert_eq!(mode.is_relative(None), Some(false));
        mode.code(true);
        assert_eq!(mode.is_relative(None), Some(true));
        mode.distance(true);
        assert_eq!(mode.is_relative(None), Some(true));
        mode.distance(false);
        assert_eq!(mode.is_relative(None), None);
        assert_eq!(mode.is_relative(Some(Firmware::Marlin)), Some(false));
        assert_eq!(mode.is_relative(Some(Firmware::Klipper)), Some(true));
        mode.code(true);
        assert_eq!(mode.is_relative(None), Some(true));
        // M82 within G91.
        mode.distance(true);
        mode.code(false);
        assert_eq!(mode.is_relative(None), None);
    }
}
