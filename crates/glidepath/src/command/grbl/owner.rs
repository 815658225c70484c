//! The owner of a connection on this host: the user whose process is at its other end.
//!
//! A port of loopback is open to every user of the host, and the protocol knows no password. The system knows who
//! opened a connection, and tells it in `/proc/net/tcp`.

use std::net::{SocketAddr, SocketAddrV4, TcpStream};

/// The user whose process has opened a connection; `None` if that is not known any more.
pub(super) fn owner(stream: &TcpStream) -> Option<u32> {
    let (SocketAddr::V4(theirs), SocketAddr::V4(ours)) =
        (stream.peer_addr().ok()?, stream.local_addr().ok()?)
    else {
        return None;
    };
    let table = std::fs::read_to_string("/proc/net/tcp").ok()?;
    in_table(&table, theirs, ours)
}

/// The user of the row whose own end is `theirs`.
fn in_table(table: &str, theirs: SocketAddrV4, ours: SocketAddrV4) -> Option<u32> {
    let (theirs, ours) = (written(theirs), written(ours));
    table.lines().find_map(|row| {
        let mut fields = row.split_whitespace().skip(1);
        let is_it = fields.next()? == theirs && fields.next()? == ours;
        is_it.then(|| fields.nth(4)?.parse().ok()).flatten()
    })
}

/// An address as the table has it.
fn written(address: SocketAddrV4) -> String {
    let bytes = u32::from_ne_bytes(address.ip().octets());
    format!("{bytes:08X}:{:04X}", address.port())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::net::{Ipv4Addr, TcpListener};

    #[test]
    fn a_connection_of_this_process_is_its_users() {
        let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, 0)).unwrap();
        let _client = TcpStream::connect(listener.local_addr().unwrap()).unwrap();
        let (stream, _) = listener.accept().unwrap();
        assert_eq!(owner(&stream), Some(rustix::process::getuid().as_raw()));
    }

    #[test]
    fn the_row_of_the_other_end_counts() {
        let table = "  sl  local_address rem_address   st tx_queue rx_queue tr tm->when retrnsmt   uid  timeout inode\n\
                     0: 0100007F:0913 0100007F:A1B2 01 00000000:00000000 00:00000000 00000000     0        0 1 1\n\
                     1: 0100007F:A1B2 0100007F:0913 01 00000000:00000000 00:00000000 00000000  1000        0 2 1\n";
        let local = |port| SocketAddrV4::new(Ipv4Addr::LOCALHOST, port);
        assert_eq!(in_table(table, local(0xa1b2), local(0x913)), Some(1000));
        assert_eq!(in_table(table, local(0xa1b3), local(0x913)), None);
    }
}
