//! The identity of a server of paired devices: its certificate, which it has signed itself, and the key of it.

use crate::sha256::Sha256;
use core::fmt;
use rcgen::{
    CertificateParams, DistinguishedName, DnType, ExtendedKeyUsagePurpose, KeyPair,
    KeyUsagePurpose, SerialNumber, date_time_ymd,
};
use rustls::ServerConfig;
use rustls::crypto::ring::default_provider;
use rustls::pki_types::{CertificateDer, PrivateKeyDer, PrivatePkcs8KeyDer};
use rustls::version::TLS13;
use std::sync::Arc;
use std::time::Duration;

/// The length of its validity, s: devices of Apple take no certificate of more than 825 days.
const VALID_S: u64 = 820 * DAY_S;
/// A certificate that ends within this is made anew, s.
const RENEWED_S: u64 = 30 * DAY_S;
const DAY_S: u64 = 24 * 3600;

/// The reason why there is no certificate.
#[derive(Debug, thiserror::Error)]
pub enum IdentityError {
    /// It cannot be made.
    #[error("no certificate can be made: {0}")]
    Made(rcgen::Error),
    /// The system has no random numbers.
    #[error("no certificate can be made: {0}")]
    Random(std::io::Error),
    /// It cannot be used.
    #[error("the certificate cannot be used: {0}")]
    Used(rustls::Error),
}

/// A certificate with its key, for the names by which a server is opened.
#[derive(Clone, PartialEq, Eq)]
pub struct Identity {
    /// Names and addresses, without ports.
    pub names: Vec<String>,
    /// When it begins to be valid, s since 1970.
    pub from_s: u64,
    /// When it ends, s since 1970.
    pub until_s: u64,
    /// The certificate, DER.
    pub certificate: Vec<u8>,
    /// The key, PKCS #8, DER.
    pub key: Vec<u8>,
}

// The key is nobody's business.
impl fmt::Debug for Identity {
    fn fmt(&self, to: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut to = to.debug_struct("Identity");
        to.field("names", &self.names).finish_non_exhaustive()
    }
}

impl Identity {
    /// A new one for names and addresses of a server, with a title for people, from now on, s since 1970.
    ///
    /// # Errors
    /// It cannot be made: a name is none, or the system has no random numbers.
    pub fn new(title: &str, names: &[String], now_s: u64) -> Result<Self, IdentityError> {
        let mut params = CertificateParams::new(names).map_err(IdentityError::Made)?;
        let mut subject = DistinguishedName::new();
        subject.push(DnType::CommonName, title);
        params.distinguished_name = subject;
        params.key_usages = vec![KeyUsagePurpose::DigitalSignature];
        params.extended_key_usages = vec![ExtendedKeyUsagePurpose::ServerAuth];
        // The clocks of devices are not all right to the minute.
        let (from_s, until_s) = (now_s.saturating_sub(DAY_S), now_s + VALID_S - DAY_S);
        let at = |s| date_time_ymd(1970, 1, 1) + Duration::from_secs(s);
        (params.not_before, params.not_after) = (at(from_s), at(until_s));
        let mut serial = [0; 16];
        let got = rustix::rand::getrandom(&mut serial, rustix::rand::GetRandomFlags::empty());
        let _length = got.map_err(|error| IdentityError::Random(error.into()))?;
        // A browser does not take two certificates of one name with the same number. It is positive, and not 0.
        serial[0] = serial[0] & 0x3f | 0x40;
        params.serial_number = Some(SerialNumber::from_slice(&serial));
        let key = KeyPair::generate().map_err(IdentityError::Made)?;
        let certificate = params.self_signed(&key).map_err(IdentityError::Made)?;
        Ok(Self {
            names: names.to_vec(),
            from_s,
            until_s,
            certificate: certificate.der().to_vec(),
            key: key.serialize_der(),
        })
    }

    /// Whether it is for these names, and valid for some time yet.
    #[must_use]
    pub fn serves(&self, names: &[String], now_s: u64) -> bool {
        let is_valid = self.from_s <= now_s && now_s + RENEWED_S < self.until_s;
        is_valid && names.iter().all(|name| self.names.contains(name))
    }

    /// What browsers show of it to be compared.
    #[must_use]
    pub fn fingerprint(&self) -> Sha256 {
        Sha256::of(&self.certificate)
    }

    /// How a server speaks TLS with it: 1.3 alone.
    ///
    /// # Errors
    /// Certificate and key are none, or do not belong together.
    pub(crate) fn tls(&self) -> Result<Arc<ServerConfig>, IdentityError> {
        let key = PrivateKeyDer::Pkcs8(PrivatePkcs8KeyDer::from(self.key.clone()));
        let chain = vec![CertificateDer::from(self.certificate.clone())];
        let mut config = ServerConfig::builder_with_provider(Arc::new(default_provider()))
            .with_protocol_versions(&[&TLS13])
            .map_err(IdentityError::Used)?
            .with_no_client_auth()
            .with_single_cert(chain, key)
            .map_err(IdentityError::Used)?;
        config.alpn_protocols = vec![b"http/1.1".to_vec()];
        Ok(Arc::new(config))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const NOW_S: u64 = 1_800_000_000;

    #[test]
    fn it_serves_its_names_while_it_is_valid() {
        let names = |of: &[&str]| of.iter().map(|of| (*of).to_owned()).collect::<Vec<_>>();
        let own = names(&["192.168.1.20", "mill-1", "::1"]);
        let identity = Identity::new("Glidepath mill-1", &own, NOW_S).unwrap();
        assert!(identity.serves(&own, NOW_S) && identity.serves(&own[..1], NOW_S));
        assert!(!identity.serves(&names(&["mill-2"]), NOW_S));
        for (days, is_valid) in [(-2, false), (0, true), (780, true), (795, false)] {
            let at = NOW_S.checked_add_signed(days * 86_400).unwrap();
            assert_eq!(identity.serves(&own, at), is_valid, "{days}");
        }
        assert!(identity.tls().is_ok());
        assert!(identity.until_s - identity.from_s <= 825 * DAY_S);
    }

    #[test]
    fn no_two_are_alike_and_their_keys_do_not_go_together() {
        let names = ["localhost".to_owned()];
        let new = || Identity::new("x", &names, NOW_S).unwrap();
        let (one, other) = (new(), new());
        assert_ne!(one.fingerprint(), other.fingerprint());
        let mixed = Identity {
            key: other.key.clone(),
            ..one.clone()
        };
        assert!(mixed.tls().is_err());
        let broken = Identity {
            key: Vec::new(),
            ..one.clone()
        };
        assert!(broken.tls().is_err());
        // Whoever prints it does not print the key.
        let printed = format!("{one:?}");
        assert!(printed.len() < 60 && printed.contains("localhost"));
    }
}
