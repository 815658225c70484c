//! The lines that store something which outlasts programs.

/// Whether a line stores coordinate systems, tools or reference positions: G10, G28.1, G30.1. grbl answers such a line
/// when it has come to rest and they are stored.
pub(super) fn stores(line: &[u8]) -> bool {
    const CODES: [f64; 3] = [10.0, 28.1, 30.1];
    let mut is_comment = false;
    let mut words = line.iter().enumerate().filter(|(_, byte)| {
        is_comment = match byte {
            b'(' => true,
            b')' => false,
            b';' => true,
            _ => is_comment,
        };
        !is_comment && byte.eq_ignore_ascii_case(&b'G')
    });
    words.any(|(at, _)| {
        let number = line.iter().skip(at + 1).filter(|byte| **byte != b' ');
        let number: String = number
            .take_while(|byte| byte.is_ascii_digit() || **byte == b'.')
            .map(|byte| char::from(*byte))
            .collect();
        let is_it = |code: f64| CODES.iter().any(|it| (it - code).abs() < 1e-9);
        number.parse().is_ok_and(is_it)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_that_store_are_told_by_their_codes() {
        for line in ["G10 L20 P1 X0", "n5 g 28.1", "X1 G30.1", "(a)G10L2P1Z0"] {
            assert!(stores(line.as_bytes()), "{line}");
        }
        for line in [
            "G1 X10", "G28", "G30 Z0", "(G10 L2)", "X1 ; G10", "G100", "G92 X0",
        ] {
            assert!(!stores(line.as_bytes()), "{line}");
        }
    }
}
