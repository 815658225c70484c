//! The connection to an MQTT broker.

use rumqttc::{Client, Connection, Event, LastWill, MqttOptions, Outgoing, Packet, QoS};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

/// How often the broker hears of a connection that has nothing to say. A host that vanishes is told
/// by the last will after one and a half times this.
const KEEP_ALIVE: Duration = Duration::from_secs(5);
/// Messages on their way to the connection.
const QUEUE: usize = 16;
/// The longest that the end is waited for.
const END_WITHIN: Duration = Duration::from_secs(1);
/// Between two attempts to reach a broker.
const RETRY: Duration = Duration::from_secs(1);

const ONLINE: &str = "{\"online\":true}";
const OFFLINE: &str = "{\"online\":false}";

/// The quality of service of a message.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quality {
    /// Sent once, and forgotten.
    AtMostOnce,
    /// Sent until the broker has acknowledged it.
    AtLeastOnce,
}

impl Quality {
    const fn qos(self) -> QoS {
        match self {
            Self::AtMostOnce => QoS::AtMostOnce,
            Self::AtLeastOnce => QoS::AtLeastOnce,
        }
    }
}

/// The settings of a connection: which broker, and who speaks.
#[derive(Debug, Clone)]
pub struct BrokerSettings {
    /// Its host name or address.
    pub host: String,
    /// Its port, 1883 by convention.
    pub port: u16,
    /// No two clients of a broker have the same: it ends the older one.
    pub client_id: String,
    /// User and password, which go over the network as they are.
    pub credentials: Option<(String, String)>,
    /// What all topics begin with, without a slash at its end.
    pub topic: String,
    /// What is told at every connection, under `info`.
    pub info: String,
}

/// The counts of what went through so far.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct BrokerCounts {
    /// Messages handed to the connection.
    pub published: u64,
    /// Messages left out: the broker was not there, or slower than they came.
    pub left_out: u64,
    /// Times that the broker took the connection.
    pub connections: u64,
}

/// What both threads know.
#[derive(Debug, Default)]
struct Shared {
    is_connected: AtomicBool,
    ends: AtomicBool,
    published: AtomicU64,
    left_out: AtomicU64,
    connections: AtomicU64,
    trouble: Mutex<Option<String>>,
}

/// A connection to a broker, made and made again by a thread of its own.
pub struct Broker {
    client: Client,
    topic: String,
    shared: Arc<Shared>,
    thread: JoinHandle<()>,
}

impl core::fmt::Debug for Broker {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("Broker")
            .field("topic", &self.topic)
            .field("shared", &self.shared)
            .finish_non_exhaustive()
    }
}

impl Broker {
    /// Begins to connect, and goes on until [`Broker::close`]. A broker that is not there yet is no
    /// error.
    #[must_use]
    pub fn connect(settings: &BrokerSettings) -> Self {
        let mut options = MqttOptions::new(&settings.client_id, &settings.host, settings.port);
        let online = format!("{}/online", settings.topic);
        options.set_keep_alive(KEEP_ALIVE);
        options.set_last_will(LastWill::new(&online, OFFLINE, QoS::AtLeastOnce, true));
        if let Some((user, password)) = &settings.credentials {
            options.set_credentials(user, password);
        }
        let (client, connection) = Client::new(options, QUEUE);
        let shared = Arc::new(Shared::default());
        let greetings = [
            (online, ONLINE.to_owned()),
            (format!("{}/info", settings.topic), settings.info.clone()),
        ];
        let connection_thread = ConnectionThread {
            client: client.clone(),
            shared: Arc::clone(&shared),
            greetings,
            greeted: 2,
        };
        Self {
            client,
            topic: settings.topic.clone(),
            shared,
            thread: std::thread::spawn(move || connection_thread.keep(connection)),
        }
    }

    /// Sends a message under `topic/name`, if there is a way for it now; says whether there was.
    /// Never waits.
    pub fn publish(&self, name: &str, quality: Quality, text: String) -> bool {
        let topic = format!("{}/{name}", self.topic);
        let sent = self.shared.is_connected.load(Ordering::Relaxed)
            && self
                .client
                .try_publish(topic, quality.qos(), false, text)
                .is_ok();
        let count = if sent {
            &self.shared.published
        } else {
            &self.shared.left_out
        };
        count.fetch_add(1, Ordering::Relaxed);
        sent
    }

    /// Whether the broker is there.
    #[must_use]
    pub fn is_connected(&self) -> bool {
        self.shared.is_connected.load(Ordering::Relaxed)
    }

    /// Why there is no connection, if that is new.
    #[must_use]
    pub fn trouble(&self) -> Option<String> {
        let trouble = self.shared.trouble.lock();
        trouble.unwrap_or_else(PoisonError::into_inner).take()
    }

    /// What went through so far.
    #[must_use]
    pub fn counts(&self) -> BrokerCounts {
        let count = |of: &AtomicU64| of.load(Ordering::Relaxed);
        BrokerCounts {
            published: count(&self.shared.published),
            left_out: count(&self.shared.left_out),
            connections: count(&self.shared.connections),
        }
    }

    /// Says good-bye, and ends. A second at most.
    pub fn close(self) {
        self.shared.ends.store(true, Ordering::Relaxed);
        if self.is_connected() {
            let online = format!("{}/online", self.topic);
            // A queue that is full is that of a broker that does not answer: its will says it.
            let _ = self
                .client
                .try_publish(online, QoS::AtLeastOnce, true, OFFLINE);
            let _ = self.client.try_disconnect();
        }
        let begun = Instant::now();
        while self.is_connected() && begun.elapsed() < END_WITHIN {
            std::thread::sleep(Duration::from_millis(5));
        }
        // One that still looks for its broker ends with the process.
        if self.thread.is_finished() {
            let _ = self.thread.join();
        }
    }
}

/// The thread that keeps the connection.
struct ConnectionThread {
    client: Client,
    shared: Arc<Shared>,
    greetings: [(String, String); 2],
    /// Greetings that were sent since the broker took the connection.
    greeted: usize,
}

impl ConnectionThread {
    fn keep(mut self, mut connection: Connection) {
        for event in connection.iter() {
            match event {
                Ok(Event::Incoming(Packet::ConnAck(_))) => {
                    self.shared.connections.fetch_add(1, Ordering::Relaxed);
                    self.greeted = 0;
                }
                Ok(Event::Outgoing(Outgoing::Disconnect)) => break,
                Ok(_) => {}
                Err(error) => {
                    self.shared.is_connected.store(false, Ordering::Relaxed);
                    if self.shared.ends.load(Ordering::Relaxed) {
                        break;
                    }
                    let trouble = self.shared.trouble.lock();
                    *trouble.unwrap_or_else(PoisonError::into_inner) = Some(error.to_string());
                    std::thread::sleep(RETRY);
                }
            }
            self.greet();
        }
        self.shared.is_connected.store(false, Ordering::Relaxed);
    }

    /// Says who speaks, before anything else is said.
    fn greet(&mut self) {
        while let Some((topic, text)) = self.greetings.get(self.greeted) {
            let sent = self
                .client
                .try_publish(topic, QoS::AtLeastOnce, true, text.clone());
            if sent.is_err() {
                return;
            }
            self.greeted += 1;
            if self.greeted == self.greetings.len() {
                self.shared.is_connected.store(true, Ordering::Relaxed);
            }
        }
    }
}
