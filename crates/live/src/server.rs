//! The servers of the page: one thread for each request, on loopback alone, and over TLS for paired devices.

use crate::answer::{Site, Work, answer};
use crate::devices::Devices;
use crate::feed::Feed;
use crate::guard::Guard;
use crate::identity::{Identity, IdentityError};
use crate::places::Places;
use crate::role::Role;
use crate::token::Token;
use core::time::Duration;
use rustls::ServerConfig;
use std::io;
use std::net::{Ipv4Addr, SocketAddr, TcpListener, TcpStream};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::JoinHandle;

/// How long to wait where the system has nothing left for a connection.
const BREATH: Duration = Duration::from_millis(20);
/// How long a connection to the server itself may take.
const WAKE: Duration = Duration::from_secs(5);
/// By how much the threads of devices stand behind those of the pages of this host, as `nice` counts.
const BEHIND: i32 = 5;

/// The reason why there is no server.
#[derive(Debug, thiserror::Error)]
pub enum ServerError {
    /// The port cannot be had.
    #[error("port {port} of 127.0.0.1 cannot be had: {cause}; give another one with --port")]
    Port {
        /// Which.
        port: u16,
        /// Why.
        cause: io::Error,
    },
    /// The address for devices cannot be had.
    #[error(
        "{address} cannot be had: {cause}; give an address of this host, with a port that is free, with --devices"
    )]
    Address {
        /// Which.
        address: SocketAddr,
        /// Why.
        cause: io::Error,
    },
    /// There is no certificate.
    #[error(transparent)]
    Identity(#[from] IdentityError),
    /// The system has no random numbers.
    #[error("no token: {0}")]
    Token(io::Error),
    /// A thread cannot be started.
    #[error("no thread for the server: {0}")]
    Thread(io::Error),
}

/// A server that does not answer yet.
#[derive(Debug)]
pub struct Server {
    listener: TcpListener,
    address: SocketAddr,
    tokens: Vec<(Role, Token)>,
}

impl Server {
    /// Takes a port of 127.0.0.1, any free one for 0, and makes a token for each role up to `most`.
    ///
    /// # Errors
    ///
    /// The port cannot be had, or the system has no random numbers.
    pub fn bind(port: u16, most: Role) -> Result<Self, ServerError> {
        let failed = |cause| ServerError::Port { port, cause };
        let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, port)).map_err(failed)?;
        let address = listener.local_addr().map_err(failed)?;
        let roles = Role::ALL.into_iter().filter(|role| *role <= most);
        let tokens = roles.map(|role| Token::new().map(|token| (role, token)));
        let tokens: io::Result<_> = tokens.collect();
        Ok(Self {
            listener,
            address,
            tokens: tokens.map_err(ServerError::Token)?,
        })
    }

    /// The address to open for each role, the least first, with the token behind `#`, which browsers do
    /// not send.
    pub fn urls(&self) -> impl Iterator<Item = (Role, String)> {
        let address = self.address;
        let tokens = self.tokens.iter();
        tokens.map(move |(role, token)| {
            (*role, format!("http://{address}/#token={}", token.as_str()))
        })
    }

    /// The port.
    #[must_use]
    pub const fn port(&self) -> u16 {
        self.address.port()
    }

    /// Answers from now on.
    ///
    /// # Errors
    ///
    /// There is no thread for it.
    pub fn start(self, site: Arc<dyn Site>, feed: &Feed) -> Result<Running, ServerError> {
        let work = Work {
            guard: Guard::new(self.address.port(), self.tokens),
            site,
            feed: feed.clone(),
            over: Arc::default(),
            places: Places::on_host(),
            devices: None,
        };
        Running::start(self.listener, self.address, work)
    }
}

/// A server of paired devices that does not answer yet.
#[derive(Debug)]
pub struct DeviceServer {
    listener: TcpListener,
    address: SocketAddr,
    tls: Arc<ServerConfig>,
    names: Vec<String>,
}

impl DeviceServer {
    /// Takes an address of this host, with any free port for 0.
    ///
    /// # Errors
    ///
    /// It cannot be had, or the certificate cannot be used.
    pub fn bind(address: SocketAddr, identity: &Identity) -> Result<Self, ServerError> {
        let failed = |cause| ServerError::Address { address, cause };
        let tls = identity.tls()?;
        let listener = TcpListener::bind(address).map_err(failed)?;
        Ok(Self {
            address: listener.local_addr().map_err(failed)?,
            listener,
            tls,
            names: identity.names.clone(),
        })
    }

    /// The address to open.
    #[must_use]
    pub fn url(&self) -> String {
        format!("https://{}/", self.address)
    }

    /// The port.
    #[must_use]
    pub const fn port(&self) -> u16 {
        self.address.port()
    }

    /// Answers devices from now on. They may no more than `most`, and never operate.
    ///
    /// # Errors
    ///
    /// There is no thread for it.
    pub fn start(
        self,
        site: Arc<dyn Site>,
        feed: &Feed,
        devices: Arc<dyn Devices>,
        most: Role,
    ) -> Result<Running, ServerError> {
        let shared = Arc::clone(&devices);
        let work = Work {
            guard: Guard::of_devices(&self.names, self.address.port(), shared, most),
            site,
            feed: feed.clone(),
            over: Arc::default(),
            places: Places::on_network(),
            devices: Some((self.tls, devices)),
        };
        Running::start(self.listener, self.address, work)
    }
}

/// A server that answers, until it is dropped.
#[derive(Debug)]
pub struct Running {
    address: SocketAddr,
    over: Arc<AtomicBool>,
    feed: Feed,
    accepting: Option<JoinHandle<()>>,
}

impl Running {
    fn start(listener: TcpListener, address: SocketAddr, work: Work) -> Result<Self, ServerError> {
        let (over, feed) = (Arc::clone(&work.over), work.feed.clone());
        let accepting = std::thread::Builder::new()
            .name("live-accept".to_owned())
            .spawn(move || accept(&listener, &Arc::new(work)))
            .map_err(ServerError::Thread)?;
        Ok(Self {
            address,
            over,
            feed,
            accepting: Some(accepting),
        })
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        self.over.store(true, Ordering::Relaxed);
        self.feed.end();
        let Some(accepting) = self.accepting.take() else {
            return;
        };
        // The thread waits for a connection, and the system may have none to give just now.
        while !accepting.is_finished() {
            let _woken = TcpStream::connect_timeout(&self.address, WAKE);
            std::thread::sleep(Duration::from_millis(1));
        }
        let _ended = accepting.join();
    }
}

fn accept(listener: &TcpListener, work: &Arc<Work>) {
    if work.devices.is_some() {
        // Threads that this one starts stand where it stands. Where the system refuses, they are equal.
        let _behind = rustix::process::nice(BEHIND);
    }
    while !work.over.load(Ordering::Relaxed) {
        let Ok((stream, _)) = listener.accept() else {
            // The connection has gone, or there is no descriptor for it yet.
            std::thread::sleep(BREATH);
            continue;
        };
        let stream = Arc::new(stream);
        work.places.enter(&stream);
        let (shared, own) = (Arc::clone(work), Arc::clone(&stream));
        let thread = std::thread::Builder::new().name("live-request".to_owned());
        let started = thread.spawn(move || {
            // A browser that goes away is its own business.
            let _answered = answer(&own, &shared);
            shared.places.leave(&own);
        });
        if started.is_err() {
            work.places.leave(&stream);
        }
    }
}
