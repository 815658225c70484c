//! The host as its kernel tells of itself in `/proc`, `/sys` and `/dev`.

use core::ops::RangeInclusive;
use std::fs;
use std::path::{Path, PathBuf};

/// A tree with the files of `/proc`, `/sys` and `/dev`: that of the host, or one made up for a
/// test.
#[derive(Debug, Clone)]
pub struct Host {
    root: PathBuf,
}

impl Host {
    /// The host this process runs on.
    #[must_use]
    pub fn here() -> Self {
        Self::at("/")
    }

    /// The tree below `root`.
    #[must_use]
    pub fn at(root: impl AsRef<Path>) -> Self {
        Self {
            root: root.as_ref().to_owned(),
        }
    }

    /// Where a file of the host is; `path` without a leading slash.
    #[must_use]
    pub fn path(&self, path: &str) -> PathBuf {
        self.root.join(path)
    }

    /// A whole file; `None` if it cannot be read.
    #[must_use]
    pub fn text(&self, path: &str) -> Option<String> {
        fs::read_to_string(self.path(path)).ok()
    }

    /// A file of one line, without the space around it; `None` if it cannot be read or is empty.
    #[must_use]
    pub fn line(&self, path: &str) -> Option<String> {
        let text = self.text(path)?;
        let line = text.trim();
        (!line.is_empty()).then(|| line.to_owned())
    }

    /// A file of one number.
    #[must_use]
    pub fn number(&self, path: &str) -> Option<i64> {
        self.line(path)?.parse().ok()
    }
}

/// A set of processors as the kernel writes it: `0-3,6`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct CpuList(Vec<RangeInclusive<usize>>);

impl CpuList {
    /// Reads a list; what is no number or range, such as `(null)`, is left out.
    pub(crate) fn parse(text: &str) -> Self {
        let range = |part: &str| {
            let (first, last) = part.split_once('-').unwrap_or((part, part));
            Some(first.trim().parse().ok()?..=last.trim().parse().ok()?)
        };
        Self(text.split(',').filter_map(range).collect())
    }

    pub(crate) fn contains(&self, cpu: usize) -> bool {
        self.0.iter().any(|range| range.contains(&cpu))
    }
}

/// The rest of the line of a file like `/proc/self/status` that begins with `name`.
pub(crate) fn field<'a>(status: &'a str, name: &str) -> Option<&'a str> {
    let rest = status.lines().find_map(|line| line.strip_prefix(name))?;
    Some(rest.trim())
}

/// A value in KiB of a file like `/proc/self/status`.
pub(crate) fn field_kib(status: &str, name: &str) -> Option<u64> {
    field(status, name)?.split_whitespace().next()?.parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fields_of_status_are_found() {
        let status = "VmPeak:\t  9000 kB\nVmLck:\t   120 kB\n";
        assert_eq!(field_kib(status, "VmLck:"), Some(120));
        assert_eq!(field_kib(status, "VmPin:"), None);
    }

    #[test]
    fn every_linux_tells_its_release() {
        let release = Host::here().line("proc/sys/kernel/osrelease");
        assert!(release.is_some_and(|release| release.contains('.')));
    }

    #[test]
    fn lists_of_processors_are_read() {
        let list = CpuList::parse("0-2,6\n");
        let held: Vec<_> = (0..8).filter(|&cpu| list.contains(cpu)).collect();
        assert_eq!(held, [0, 1, 2, 6]);
        for nothing in ["", "\n", "(null)", "a-b", "3-1"] {
            assert!((0..8).all(|cpu| !CpuList::parse(nothing).contains(cpu)));
        }
    }
}
