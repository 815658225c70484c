//! The machines of this host whose pages are listed: each server keeps a file of its own, in a folder that only this user
//! reads, and tells its pages what stands in those of the others.

use glidepath_link::LinkConfig;
use glidepath_live::Role;
use glidepath_realtime::{Clock as _, Monotonic};
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::fs::{self, DirBuilder, File, OpenOptions};
use std::io::{self, Read as _, Write as _};
use std::os::unix::fs::{DirBuilderExt as _, OpenOptionsExt as _};
use std::path::{Path, PathBuf};

/// The folder, in that of all instances.
const FOLDER: &str = ".pages";
/// What is not told anew for so long is told no more of, ns.
const OLD_NS: u64 = 5_000_000_000;
/// Machines that are told of at most, and bytes of a file that are read.
const MOST: usize = 16;
const MOST_BYTES: u64 = 16_384;
/// How every address of a page begins.
const LOOPBACK: &str = "http://127.0.0.1:";

/// What a server tells of its machine.
#[derive(Debug, Clone, Serialize, Deserialize)]
struct Listed {
    instance: String,
    process: u32,
    /// Of `CLOCK_MONOTONIC`, when this was told.
    told_ns: u64,
    /// As the status names it.
    state: String,
    program: Option<String>,
    left_s: Option<f64>,
    /// The address for each role that the page has.
    urls: BTreeMap<String, String>,
}

/// The own machine, listed for as long as this lives.
pub(super) struct Listing {
    file: PathBuf,
    listed: Listed,
}

impl Listing {
    /// Lists a machine, with the addresses of its pages.
    ///
    /// # Errors
    /// The folder cannot be made.
    pub(super) fn begin(link: &LinkConfig, urls: &[(Role, String)]) -> io::Result<Self> {
        let folder = link.root.join(FOLDER);
        make(&folder)?;
        let urls = urls
            .iter()
            .map(|(role, url)| (role.name().to_owned(), url.clone()));
        Ok(Self {
            file: folder.join(format!("{}.json", link.instance)),
            listed: Listed {
                instance: link.instance.clone(),
                process: std::process::id(),
                told_ns: 0,
                state: String::new(),
                program: None,
                left_s: None,
                urls: urls.collect(),
            },
        })
    }

    /// Tells what the machine does, by its status as pages have it. What cannot be written is not listed: the machine does
    /// not depend on it.
    pub(super) fn tell(&mut self, status: &Value) {
        let text = |value: &Value| value.as_str().map(str::to_owned);
        self.listed.told_ns = Monotonic.now_ns();
        self.listed.state = text(&status["state"]).unwrap_or_default();
        self.listed.program = text(&status["active_program"]["name"]);
        let is_open = status["end_of_epoch"] == "open";
        self.listed.left_s = status["left_s"].as_f64().filter(|_| is_open);
        let _written = self.write();
    }

    /// Beside the file first, so that nobody reads a half of it. Another server may have taken the folder with it, before
    /// there was a file of this one.
    fn write(&self) -> io::Result<()> {
        self.file.parent().map_or(Ok(()), make)?;
        let fresh = self.file.with_extension("new");
        let mut options = OpenOptions::new();
        let mut file = options
            .create(true)
            .truncate(true)
            .write(true)
            .mode(0o600)
            .open(&fresh)?;
        file.write_all(&serde_json::to_vec(&self.listed)?)?;
        fs::rename(&fresh, &self.file)
    }
}

impl Drop for Listing {
    fn drop(&mut self) {
        // What stays is told no more of after some seconds.
        let _removed = fs::remove_file(&self.file);
        // The last one takes the folder with it.
        let _removed = self.file.parent().map(fs::remove_dir);
    }
}

fn make(folder: &Path) -> io::Result<()> {
    DirBuilder::new().recursive(true).mode(0o700).create(folder)
}

/// The other machines that are listed, by name, and the way to the page of each that may as much as the role, or the most
/// that there is below it.
pub(super) fn others(link: &LinkConfig, role: Role) -> Value {
    let folder = link.root.join(FOLDER);
    let mut found: Vec<Listed> = fs::read_dir(folder)
        .into_iter()
        .flatten()
        .filter_map(|entry| read(&entry.ok()?.path()))
        .filter(|listed| listed.instance != link.instance && is_current(listed))
        .collect();
    found.sort_by(|a, b| a.instance.cmp(&b.instance));
    found.truncate(MOST);
    let told = found.iter().map(|listed| {
        json!({
            "instance": listed.instance,
            "state": listed.state,
            "program": listed.program,
            "left_s": listed.left_s,
            "url": address(listed, role),
        })
    });
    json!({ "machines": told.collect::<Vec<_>>() })
}

fn is_current(listed: &Listed) -> bool {
    let age_ns = Monotonic.now_ns().saturating_sub(listed.told_ns);
    age_ns < OLD_NS && Path::new("/proc").join(listed.process.to_string()).exists()
}

/// A file that is none of a server is passed over.
fn read(path: &Path) -> Option<Listed> {
    if path.extension()? != "json" {
        return None;
    }
    let mut text = Vec::new();
    File::open(path)
        .ok()?
        .take(MOST_BYTES)
        .read_to_end(&mut text)
        .ok()?;
    serde_json::from_slice(&text).ok()
}

fn address(listed: &Listed, role: Role) -> Option<&str> {
    let roles = Role::ALL.into_iter().rev().filter(|of| *of <= role);
    let urls = roles.filter_map(|of| listed.urls.get(of.name()));
    urls.map(String::as_str)
        .find(|url| url.starts_with(LOOPBACK))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::os::unix::fs::PermissionsExt as _;

    fn link(root: &Path, instance: &str) -> LinkConfig {
        let mut link = LinkConfig::new(instance);
        link.root = root.to_owned();
        link
    }

    fn listing(link: &LinkConfig, roles: &[Role]) -> Listing {
        let url = |role: &Role| (*role, format!("{LOOPBACK}1/#token={}", role.name()));
        let urls: Vec<_> = roles.iter().map(url).collect();
        Listing::begin(link, &urls).unwrap()
    }

    fn status() -> Value {
        json!({
            "state": "running", "active_program": { "name": "a.ngc" }, "end_of_epoch": "open", "left_s": 12.5,
        })
    }

    #[test]
    fn a_machine_is_told_of_to_others_while_it_is_listed_and_never_with_more_than_a_page_may() {
        let root = tempfile::tempdir().unwrap();
        let (own, other) = (link(root.path(), "mill"), link(root.path(), "lathe"));
        assert_eq!(others(&own, Role::Operate), json!({ "machines": [] }));
        let mut listed = listing(&other, &Role::ALL);
        listed.tell(&status());
        for role in Role::ALL {
            let told = others(&own, role);
            let url = format!("{LOOPBACK}1/#token={}", role.name());
            let expected = json!({
                "instance": "lathe", "state": "running", "program": "a.ngc", "left_s": 12.5, "url": url,
            });
            assert_eq!(told, json!({ "machines": [expected] }));
        }
        assert_eq!(others(&other, Role::Operate), json!({ "machines": [] }));
        let mode = |path: &Path| path.metadata().unwrap().permissions().mode() & 0o777;
        let folder = root.path().join(FOLDER);
        assert_eq!((mode(&folder), mode(&listed.file)), (0o700, 0o600));
        drop(listed);
        assert_eq!(others(&own, Role::Operate), json!({ "machines": [] }));
        assert!(!folder.exists());
    }

    #[test]
    fn a_server_that_ends_takes_no_place_from_one_that_begins() {
        let root = tempfile::tempdir().unwrap();
        let (own, other) = (link(root.path(), "mill"), link(root.path(), "lathe"));
        let ends = listing(&own, &[Role::Look]);
        let mut begins = listing(&other, &[Role::Look]);
        drop(ends);
        begins.tell(&status());
        let told = others(&own, Role::Look);
        assert_eq!(told["machines"].as_array().unwrap().len(), 1);
    }

    #[test]
    fn a_page_that_may_less_is_led_to_as_what_it_may() {
        let root = tempfile::tempdir().unwrap();
        let own = link(root.path(), "mill");
        let mut listed = listing(&link(root.path(), "lathe"), &[Role::Look]);
        listed.tell(&status());
        let told = others(&own, Role::Operate);
        assert_eq!(
            told["machines"][0]["url"],
            format!("{LOOPBACK}1/#token=look")
        );
    }

    #[test]
    fn what_is_old_or_dead_or_no_listing_is_passed_over() {
        let root = tempfile::tempdir().unwrap();
        let own = link(root.path(), "mill");
        let mut listed = listing(&link(root.path(), "lathe"), &Role::ALL);
        listed.tell(&status());
        let folder = root.path().join(FOLDER);
        fs::write(folder.join("torn.json"), "{\"instance\":").unwrap();
        fs::write(folder.join("other.txt"), "x").unwrap();
        fs::create_dir(folder.join("folder.json")).unwrap();
        let count = |role| others(&own, role)["machines"].as_array().unwrap().len();
        assert_eq!(count(Role::Look), 1);
        listed.listed.urls = [("look".to_owned(), "https://evil.example/".to_owned())].into();
        listed.write().unwrap();
        assert_eq!(others(&own, Role::Look)["machines"][0]["url"], Value::Null);
        listed.listed.process = u32::MAX;
        listed.write().unwrap();
        assert_eq!(count(Role::Look), 0);
        listed.listed.process = std::process::id();
        listed.listed.told_ns = Monotonic.now_ns().saturating_sub(OLD_NS);
        listed.write().unwrap();
        assert_eq!(count(Role::Look), 0);
    }
}
