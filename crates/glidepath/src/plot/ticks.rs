//! The ticks of a scale: round numbers, and their labels.

/// Round values within `low…high`, about `wanted` of them, ascending.
pub(super) fn ticks(low: f64, high: f64, wanted: f64) -> Vec<f64> {
    let span = high - low;
    if !(span.is_finite() && span > 0.0) {
        return vec![low];
    }
    let rough = span / wanted.max(1.0);
    let power = 10.0_f64.powf(rough.log10().floor());
    let step = [1.0, 2.0, 5.0, 10.0]
        .into_iter()
        .map(|digit| digit * power)
        .find(|step| *step >= rough * 0.999)
        .unwrap_or(10.0 * power);
    let first = (low / step).ceil();
    let count = ((high / step).floor() - first).max(0.0);
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "at most ten times `wanted`"
    )]
    let count = count as u32;
    (0..=count).map(|i| (first + f64::from(i)) * step).collect()
}

/// A number for a label: as few digits as tell neighbouring ticks apart, thousands in groups.
pub(super) fn label(value: f64) -> String {
    let decimals = match value.abs() {
        v if v < 1e-9 => return "0".to_owned(),
        v if v >= 100.0 => 0,
        v if v >= 10.0 => 1,
        v if v >= 1.0 => 2,
        _ => 3,
    };
    let text = format!("{value:.decimals$}");
    let text = if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        text
    };
    let (sign, digits) = text
        .strip_prefix('-')
        .map_or(("", text.as_str()), |digits| ("−", digits));
    let whole = digits.split('.').next().unwrap_or_default().len();
    let mut grouped = String::from(sign);
    for (i, c) in digits.chars().enumerate() {
        if i > 0 && i < whole && (whole - i).is_multiple_of(3) {
            grouped.push('\u{202f}');
        }
        grouped.push(c);
    }
    grouped
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_and_inside() {
        assert_eq!(ticks(0.0, 10.0, 5.0), [0.0, 2.0, 4.0, 6.0, 8.0, 10.0]);
        assert_eq!(ticks(-3.2, 3.2, 6.0), [-2.0, 0.0, 2.0]);
        assert_eq!(ticks(5.0, 5.0, 6.0), [5.0]);
    }

    #[test]
    fn labels_are_short() {
        let labels = [0.0, 0.25, 1.5, -12.0, 200.0, 40000.0, -1e6].map(label);
        assert_eq!(
            labels,
            [
                "0",
                "0.25",
                "1.5",
                "−12",
                "200",
                "40\u{202f}000",
                "−1\u{202f}000\u{202f}000"
            ]
        );
    }
}
