//! The exchange with other processes: what is asked of them, and what they ask.
//!
//! * The interpolator: `machine` is its status, and commands to it; `inputs` is the feedback of its drives, by which the
//!   input arbiter is answered.
//! * Clients: `stream` are the rules of a stream of segments, `line_server` is where lines are handed in, `client_watch`
//!   looks whether a client lives, and `attend` is how whoever publishes has clients attended to meanwhile.
//! * `feed` is the other end of a stream: this process is the client there.
//!
//! It may know `source` and `run`. What is asked for is given to whoever executes it; how, it does not know.

pub(crate) mod attend;
pub(crate) mod client_watch;
pub(crate) mod feed;
pub(crate) mod inputs;
pub(crate) mod line_server;
pub(crate) mod machine;
pub(crate) mod stream;
