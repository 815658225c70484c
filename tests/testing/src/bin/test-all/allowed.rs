//! The list of skips that a machine may have, and why: a line for each, `what | where | why`.

/// Where a skip is allowed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Where {
    Everywhere,
    /// Where tests do not run as root.
    WithoutRoot,
}

/// The list.
#[derive(Debug)]
pub(crate) struct Allowed(Vec<(String, Where)>);

impl Allowed {
    /// Reads a list. A line that cannot be read is an error.
    pub(crate) fn parse(text: &str) -> Result<Self, String> {
        let lines = text
            .lines()
            .map(str::trim)
            .filter(|line| !line.is_empty() && !line.starts_with('#'));
        let rules = lines.map(|line| {
            let cells: Vec<&str> = line.split('|').map(str::trim).collect();
            let [what, place, why] = cells[..] else {
                return Err(format!("{line}: not `what | where | why`"));
            };
            let place = match place {
                "everywhere" => Where::Everywhere,
                "without root" => Where::WithoutRoot,
                _ => return Err(format!("{line}: neither `everywhere` nor `without root`")),
            };
            if why.is_empty() {
                return Err(format!("{line}: no reason"));
            }
            Ok((what.to_owned(), place))
        });
        rules.collect::<Result<_, _>>().map(Self)
    }

    /// Whether a skip, told as `what: why`, is one of them.
    pub(crate) fn has(&self, skip: &str, is_root: bool) -> bool {
        let what = skip.split(": ").next().unwrap_or_default();
        let mut rules = self.0.iter();
        rules.any(|(allowed, place)| allowed == what && (*place == Where::Everywhere || !is_root))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_skip_is_allowed_by_what_it_is_of() {
        let text =
            "# Why.\n\nHAL | everywhere | not on every host\nuser | without root | root alone\n";
        let allowed = Allowed::parse(text).unwrap();
        assert!(allowed.has("HAL: no halrun: install it", true));
        assert!(allowed.has("user: no root", false));
        assert!(!allowed.has("user: no root", true));
        assert!(!allowed.has("HALs: no halrun", true));
        for bad in [
            "HAL",
            "HAL | everywhere",
            "HAL | here | x",
            "HAL | everywhere |",
        ] {
            assert!(Allowed::parse(bad).is_err(), "{bad}");
        }
    }
}
