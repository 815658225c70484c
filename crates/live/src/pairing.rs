//! The pairing of a device: a code that the panel shows, and that a device sends.
//!
//! A code holds for [`VALID`], once, and only while the page that asked for it says that it shows it. It is two: a
//! long one for a picture, which nobody guesses, and a short one for fingers, which is void after
//! [`MOST_TRIES`] wrong ones. So whoever guesses wrongly on purpose keeps nobody from pairing by the picture.

use crate::role::Role;
use crate::token::Token;
use core::time::Duration;
use std::io;
use std::time::Instant;

/// How long a code holds.
pub const VALID: Duration = Duration::from_secs(120);
/// A page that has said for so long nothing of the code does not show it.
pub const SHOWN: Duration = Duration::from_secs(5);
/// Wrong tries after which the short code is void.
pub const MOST_TRIES: u32 = 5;

/// The digits of short codes: none that is taken for another.
const DIGITS: &[u8; 32] = b"0123456789ABCDEFGHJKMNPQRSTVWXYZ";
/// Digits of a short code: 40 bits.
const LENGTH: usize = 8;

/// The reason why a device is not paired.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum PairingRefusal {
    /// No code is shown.
    #[error("no code is shown: press Pair a device at the machine")]
    NotShown,
    /// It is another code.
    #[error("the code is wrong")]
    Wrong,
    /// The short code was tried too often.
    #[error("the code was tried too often; have another one shown at the machine")]
    TriedTooOften,
}

#[derive(Debug)]
struct Offer {
    page: u64,
    role: Role,
    long: Token,
    short: Token,
    tries: u32,
    until: Instant,
    shown: Instant,
}

/// What the panel shows of an offer.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Shown {
    /// The code of the picture.
    pub long: String,
    /// The code to type; `None` once it was tried too often.
    pub short: Option<String>,
    /// What the device may.
    pub role: Role,
    /// How long both hold yet.
    pub left: Duration,
}

/// The pairing: the code that holds, if there is one.
#[derive(Debug, Default)]
pub struct Pairing(Option<Offer>);

impl Pairing {
    /// Makes a new code, which a page shows, in place of any other.
    ///
    /// # Errors
    /// The system has no random numbers.
    pub fn offer(&mut self, page: u64, role: Role, now: Instant) -> io::Result<()> {
        self.0 = Some(Offer {
            page,
            role,
            long: Token::new()?,
            short: Token::of(DIGITS, LENGTH)?,
            tries: 0,
            until: now + VALID,
            shown: now,
        });
        Ok(())
    }

    /// A page says that it shows the code; `None` if there is none of it.
    pub fn shown(&mut self, page: u64, now: Instant) -> Option<Shown> {
        self.look(now);
        let offer = self.0.as_mut().filter(|offer| offer.page == page)?;
        offer.shown = now;
        let is_open = offer.tries < MOST_TRIES;
        Some(Shown {
            long: offer.long.as_str().to_owned(),
            short: is_open.then(|| offer.short.as_str().to_owned()),
            role: offer.role,
            left: offer.until.saturating_duration_since(now),
        })
    }

    /// A page shows the code no more.
    pub fn end(&mut self, page: u64) {
        self.0.take_if(|offer| offer.page == page);
    }

    /// Takes a code, as it was typed or read: what the device may. It holds no more then.
    ///
    /// # Errors
    /// It does not hold.
    pub fn take(&mut self, code: &str, now: Instant) -> Result<Role, PairingRefusal> {
        self.look(now);
        let offer = self.0.as_mut().ok_or(PairingRefusal::NotShown)?;
        // Both are compared, whichever it is.
        let (is_long, is_short) = (
            offer.long.is(code.as_bytes()),
            offer.short.is(typed(code).as_bytes()),
        );
        let is_open = offer.tries < MOST_TRIES;
        if is_long || (is_short && is_open) {
            let role = offer.role;
            self.0 = None;
            return Ok(role);
        }
        offer.tries = offer.tries.saturating_add(1);
        Err(if is_open {
            PairingRefusal::Wrong
        } else {
            PairingRefusal::TriedTooOften
        })
    }

    fn look(&mut self, now: Instant) {
        let is_over = |offer: &Offer| {
            offer.until <= now || now.saturating_duration_since(offer.shown) >= SHOWN
        };
        self.0.take_if(|offer| is_over(offer));
    }
}

/// A short code as it was meant by whoever typed it.
fn typed(code: &str) -> String {
    let digits = code.chars().filter(|c| !c.is_whitespace() && *c != '-');
    let meant = |c: char| match c.to_ascii_uppercase() {
        'O' => '0',
        'I' | 'L' => '1',
        c => c,
    };
    digits.map(meant).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn offered(now: Instant) -> (Pairing, Shown) {
        let mut pairing = Pairing::default();
        pairing.offer(1, Role::Hold, now).unwrap();
        let shown = pairing.shown(1, now).unwrap();
        (pairing, shown)
    }

    #[test]
    fn a_code_pairs_one_device() {
        let now = Instant::now();
        for is_typed in [false, true] {
            let (mut pairing, shown) = offered(now);
            let short = shown.short.unwrap();
            assert_eq!((short.len(), shown.long.len()), (8, 32));
            let lazy = format!(" {}-{}", &short[..4].to_lowercase(), &short[4..]);
            let code = if is_typed { lazy } else { shown.long };
            assert_eq!(pairing.take(&code, now), Ok(Role::Hold));
            assert_eq!(pairing.take(&code, now), Err(PairingRefusal::NotShown));
            assert_eq!(pairing.shown(1, now), None);
        }
    }

    #[test]
    fn a_code_holds_while_it_is_shown_and_not_for_long() {
        let start = Instant::now();
        let (mut pairing, shown) = offered(start);
        // Another page does not show it, and cannot end it.
        let at = start + SHOWN / 2;
        assert_eq!(pairing.shown(2, at), None);
        pairing.end(2);
        assert!(pairing.shown(1, at).is_some());
        let late = at + SHOWN;
        assert_eq!(
            pairing.take(&shown.long, late),
            Err(PairingRefusal::NotShown)
        );
        let (mut pairing, shown) = offered(start);
        for second in 1..120 {
            let now = start + Duration::from_secs(second);
            let left = pairing.shown(1, now).unwrap().left;
            assert_eq!(left, Duration::from_secs(120 - second));
        }
        let late = start + VALID;
        assert_eq!(
            pairing.take(&shown.long, late),
            Err(PairingRefusal::NotShown)
        );
        let (mut pairing, shown) = offered(start);
        pairing.end(1);
        assert_eq!(
            pairing.take(&shown.long, start),
            Err(PairingRefusal::NotShown)
        );
    }

    #[test]
    fn who_guesses_ends_the_short_code_and_not_the_long_one() {
        let now = Instant::now();
        let (mut pairing, shown) = offered(now);
        let short = shown.short.unwrap();
        for _ in 0..MOST_TRIES {
            assert_eq!(pairing.take("00000000", now), Err(PairingRefusal::Wrong));
        }
        let too_often = Err(PairingRefusal::TriedTooOften);
        assert_eq!(pairing.take(&short, now), too_often);
        assert_eq!(pairing.shown(1, now).unwrap().short, None);
        assert_eq!(pairing.take(&shown.long, now), Ok(Role::Hold));
    }

    #[test]
    fn a_new_code_ends_the_one_before() {
        let now = Instant::now();
        let (mut pairing, before) = offered(now);
        pairing.offer(2, Role::Look, now).unwrap();
        assert_eq!(pairing.take(&before.long, now), Err(PairingRefusal::Wrong));
        assert_eq!(pairing.shown(1, now), None);
        let shown = pairing.shown(2, now).unwrap();
        assert_eq!(pairing.take(&shown.long, now), Ok(Role::Look));
    }

    #[test]
    fn what_is_typed_is_taken_as_it_was_meant() {
        assert_eq!(typed("o1il-\u{a0}k7"), "0111K7");
        for digit in "ILOU".bytes() {
            assert!(!DIGITS.contains(&digit));
        }
    }
}
