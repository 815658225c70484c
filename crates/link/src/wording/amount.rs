//! The numbers in texts, as people read them.

/// Fewest digits that are shown.
const FEW: i32 = 3;
/// Most: what is told apart only by more is the same to people.
const MOST: i32 = 12;

/// A number and the one that it is held against, rounded to as few digits as tell the two apart.
pub(super) fn apart(value: f64, limit: f64) -> (String, String) {
    let size = value.abs().max(limit.abs());
    #[allow(clippy::cast_possible_truncation, reason = "an exponent is small")]
    let magnitude = if size > 0.0 && size.is_finite() {
        size.log10().floor() as i32
    } else {
        0
    };
    let mut digits = FEW;
    loop {
        let decimals = usize::try_from(digits - 1 - magnitude).unwrap_or(0);
        let both = (rounded(value, decimals), rounded(limit, decimals));
        if both.0 != both.1 || digits >= MOST {
            return both;
        }
        digits += 1;
    }
}

/// With so many decimals, without zeros at the end.
fn rounded(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    let text = if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.')
    } else {
        &text
    };
    if text == "-0" { "0" } else { text }.to_owned()
}

#[cfg(test)]
mod tests {
    use super::apart;

    #[test]
    fn numbers_have_as_few_digits_as_tell_them_apart() {
        for (value, limit, told) in [
            (1.234_567_890_123_456, 0.5, ("1.23", "0.5")),
            (200.000_123_456, 200.0, ("200.0001", "200")),
            (41_234.567, 40_000.0, ("41235", "40000")),
            (-0.000_000_1, 3.0, ("0", "3")),
            (0.0, 0.0, ("0", "0")),
            (501.25, 500.0, ("501", "500")),
        ] {
            let (value, limit) = apart(value, limit);
            assert_eq!((value.as_str(), limit.as_str()), told);
        }
    }
}
