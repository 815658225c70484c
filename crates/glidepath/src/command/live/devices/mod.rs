//! Paired devices: tablets and phones that look and hold over TLS.
//!
//! ```text
//!   panel ── pair-device ──► Pairing: a code ──► QR and text on the panel
//!   device ── POST /api/pair, over TLS alone ──► Pairing ──► Book: the hash of a token of its own
//!   device ── its token ──► guard ──► Book: what it may, until it is revoked
//! ```
//!
//! * [`Book`] is the list, in a file that commands shorten beside this process.
//! * [`certificate`] is what devices see; the key stays here.
//! * [`listing`] is `glidepath live devices`.

mod book;
mod certificate;
mod folder;
pub(super) mod listing;
mod panel;

use crate::command::failure::Failure;
use crate::config::MachineConfig;
use crate::persistence::error::StateError;
use book::{Book, MOST};
use glidepath_live::{
    DeviceServer, Devices, MOST_TRIES, Pairing, PairingRefusal, Response, Role, Sha256, Status,
    Token,
};
use serde::Deserialize;
use serde_json::json;
use std::net::SocketAddr;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Instant;

use super::answers::{object, refusal};
use super::day::now_ms;

/// The clock of this host, s since 1970.
fn now_s() -> u64 {
    now_ms() / 1000
}

/// What a device sends to be paired.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Asked {
    code: String,
    name: String,
}

/// The devices of a machine that is served.
#[derive(Debug)]
pub(super) struct PairedDevices {
    book: Book,
    pairing: Mutex<Pairing>,
    /// What happened, for the log.
    told: Mutex<Vec<(&'static str, String)>>,
    /// The address that devices open.
    url: String,
    fingerprint: Sha256,
}

impl PairedDevices {
    /// Takes an address, with the certificate and the list that the machine keeps.
    pub(super) fn bind(
        address: SocketAddr,
        instance: &str,
        config: &MachineConfig,
    ) -> Result<(DeviceServer, Self), Failure> {
        let state = config.state_directory.as_deref();
        let book = Book::open(state.ok_or(StateError::NoFolder)?)?;
        let names = certificate::names(address);
        let identity = certificate::certificate(book.folder(), instance, &names, now_s())?;
        let server = DeviceServer::bind(address, &identity)?;
        let devices = Self {
            book,
            pairing: Mutex::default(),
            told: Mutex::default(),
            url: server.url(),
            fingerprint: identity.fingerprint(),
        };
        Ok((server, devices))
    }

    /// The address that devices open.
    pub(super) fn url(&self) -> &str {
        &self.url
    }

    /// The fingerprint of the certificate, as browsers show it.
    pub(super) fn fingerprint(&self) -> String {
        self.fingerprint.in_pairs()
    }

    /// What happened since this was asked last: kinds of the log, and texts.
    pub(super) fn told(&self) -> Vec<(&'static str, String)> {
        let mut told = self.told.lock().unwrap_or_else(PoisonError::into_inner);
        core::mem::take(&mut told)
    }

    fn tell(&self, kind: &'static str, text: String) {
        let mut told = self.told.lock().unwrap_or_else(PoisonError::into_inner);
        told.push((kind, text));
    }

    fn pairing(&self) -> MutexGuard<'_, Pairing> {
        // The code is whole, whoever panicked.
        self.pairing.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Takes a device out. Whether there was one of this name.
    pub(super) fn revoke(&self, name: &str) -> Result<bool, String> {
        let revoked = self.book.revoke(name).map_err(|error| error.to_string())?;
        if revoked {
            self.tell("info", format!("device revoked: {name}"));
        }
        Ok(revoked)
    }

    fn pair(&self, body: &[u8]) -> Result<serde_json::Value, (Status, String)> {
        let forbidden = |why: PairingRefusal| (Status::Forbidden, why.to_string());
        let unavailable = |why: String| (Status::Unavailable, why);
        let malformed = |_| (Status::BadRequest, "this is no code".to_owned());
        let asked: Asked = serde_json::from_slice(body).map_err(malformed)?;
        let (devices, trouble) = self.book.now();
        if let Some(trouble) = trouble {
            return Err(unavailable(trouble));
        }
        if devices.len() >= MOST {
            let text = format!("{MOST} devices are paired: revoke one of them");
            return Err((Status::Conflict, text));
        }
        let role = self.pairing().take(&asked.code, Instant::now());
        if role == Err(PairingRefusal::Wrong) {
            let text = format!("a device sent a wrong code; after {MOST_TRIES} it is void");
            self.tell("warn", text);
        }
        let role = role.map_err(forbidden)?;
        let token = Token::new().map_err(|error| unavailable(error.to_string()))?;
        let hash = Sha256::of(token.as_str().as_bytes());
        let name = self.book.add(&asked.name, role, &hash, now_s());
        let name = name.map_err(|error| unavailable(error.to_string()))?;
        let name = name.ok_or_else(|| unavailable("too many devices are paired".to_owned()))?;
        self.tell(
            "info",
            format!("device paired: {name}, which may {}", role.name()),
        );
        Ok(json!({ "token": token.as_str(), "name": name, "may": role.name() }))
    }
}

impl Devices for PairedDevices {
    fn role(&self, token: &Sha256) -> Option<Role> {
        self.book.role(token)
    }

    fn seen(&self, token: &Sha256) {
        self.book.heard(token, now_s());
    }

    fn pair(&self, body: &[u8]) -> Response {
        match self.pair(body) {
            Ok(told) => object(&told),
            Err(refused) => refusal(&refused),
        }
    }
}
