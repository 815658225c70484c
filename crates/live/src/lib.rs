//! The page that shows a machine, in a browser or as a file.
//!
//! * [`Server`] gives the page out on loopback, and nothing that is not asked for with the token:
//!   what may be asked is [`guard`]'s to judge, before anybody else sees the request. What there is
//!   to show and to command is the [`Site`]'s, which its user writes.
//! * There is a token for each [`Role`]; of the pages that may operate one has the [`Seat`].
//! * [`DeviceServer`] gives the same page to paired [`Devices`] over TLS, which may look and hold. The server's
//!   [`Identity`] is a certificate that it has signed itself; a device is paired by a code ([`Pairing`]).
//! * A line that somebody types is a [`TypedLine`]: of bounded length, with nothing in it that no key types. A page has one
//!   question answered at a time, and few pages have one ([`Turns`]).
//! * [`Feed`] hands what happens to every page that is open. A page that is too slow loses the
//!   oldest; nobody waits for it.
//! * [`Motion`] collects a motion of any length in bounded memory, as the page wants it: columns
//!   against time, with the least and the largest of every stretch, and the path in space.
//! * [`file::page`] makes one file of page and motion, which needs neither server nor network.
//!
//! The crate knows neither processes nor programs: it is told numbers and texts. The page itself is
//! in `page/`, in plain HTML, CSS and JavaScript; its typeface, B612, in `fonts/` with its licence,
//! the SIL Open Font License 1.1.

pub mod file;
pub mod guard;
pub mod query;

mod answer;
mod asset;
mod connection;
mod devices;
mod feed;
mod identity;
mod motion;
mod pairing;
mod places;
mod request;
mod response;
mod role;
mod seat;
mod server;
mod sha256;
mod token;
mod turns;
mod typed_line;

pub use answer::Site;
pub use devices::Devices;
pub use feed::{Feed, Message};
pub use identity::{Identity, IdentityError};
pub use motion::{AxisScale, LimitKind, Motion, MotionSample};
pub use pairing::{MOST_TRIES, Pairing, PairingRefusal, SHOWN, Shown, VALID};
pub use request::{Head, MOST_PIECE, Request};
pub use response::{ContentType, Response, Status};
pub use role::{Caller, Role};
pub use seat::{SILENCE, Seat};
pub use server::{DeviceServer, Running, Server, ServerError};
pub use sha256::Sha256;
pub use token::Token;
pub use turns::{Turn, Turns};
pub use typed_line::{MOST_TYPED, TypedLine, TypedLineError};
