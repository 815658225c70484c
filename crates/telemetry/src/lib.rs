//! Messages to an MQTT broker that nobody waits for.
//!
//! [`Broker`] keeps a connection in a thread of its own, says who it is whenever the broker takes it
//! (again), and takes messages at any time: what there is no way for now is left out and counted,
//! never kept, because old telemetry that comes late is worse than none. If the process dies, the
//! broker tells everybody by the connection's last will.
//!
//! ```no_run
//! use glidepath_telemetry::{Broker, BrokerSettings, Quality};
//!
//! let broker = Broker::connect(&BrokerSettings {
//!     host: "localhost".to_owned(),
//!     port: 1883,
//!     client_id: "glidepath-mill".to_owned(),
//!     credentials: None,
//!     topic: "glidepath/mill".to_owned(),
//!     info: "{}".to_owned(),
//! });
//! broker.publish("status", Quality::AtMostOnce, "{\"state\":\"idle\"}".to_owned());
//! broker.close();
//! ```

mod broker;

pub use broker::{Broker, BrokerCounts, BrokerSettings, Quality};
