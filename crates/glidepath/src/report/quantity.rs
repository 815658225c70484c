//! The numbers and times of reports, written for people.

/// Digits in groups of three.
#[must_use]
pub fn grouped(number: u64) -> String {
    let digits = number.to_string();
    let mut text = String::new();
    for (i, c) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            text.push(' ');
        }
        text.push(c);
    }
    text
}

/// So many of something: `1 line`, `1 200 lines`.
#[must_use]
pub fn counted(number: u64, one: &str) -> String {
    let ending = if number == 1 { "" } else { "s" };
    format!("{} {one}{ending}", grouped(number))
}

/// How many segments were driven, for people.
pub fn driven(segments: u64) -> String {
    match segments {
        0 => "no motion".to_owned(),
        count => counted(count, "segment"),
    }
}

/// A number with so many decimals. What is rounded to nothing has no sign.
#[must_use]
pub fn decimals(value: f64, count: usize) -> String {
    let text = format!("{value:.count$}");
    match text.strip_prefix('-') {
        Some(rest) if rest.chars().all(|c| matches!(c, '0' | '.')) => rest.to_owned(),
        _ => text,
    }
}

/// A duration: milliseconds below a second, minutes from two minutes on.
#[must_use]
pub fn seconds(t: f64) -> String {
    match t {
        t if t < 1.0 => format!("{:.1} ms", t * 1e3),
        t if t < 120.0 => format!("{t:.3} s"),
        t => {
            let minutes = (t / 60.0).floor();
            format!("{minutes:.0} min {:.1} s", minutes.mul_add(-60.0, t))
        }
    }
}

/// How long something takes, for people: in the unit that suits it, to a tenth.
#[must_use]
pub fn rough_time(t: f64) -> String {
    let units = [(86_400.0, "days"), (3600.0, "h"), (60.0, "min")];
    let suits = |(length, _): &(f64, &str)| t >= 2.0 * length;
    let (length, unit) = units.into_iter().find(suits).unwrap_or((1.0, "s"));
    format!("{:.1} {unit}", t / length)
}

/// A time in µs.
#[allow(clippy::cast_precision_loss, reason = "for display")]
pub(super) fn microseconds(ns: u64) -> f64 {
    ns as f64 / 1e3
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_have_the_unit_that_suits_them() {
        let texts = [7.0, 150.0, 12_960.0, 24e6].map(rough_time);
        assert_eq!(texts, ["7.0 s", "2.5 min", "3.6 h", "277.8 days"]);
    }

    #[test]
    fn nothing_has_no_sign() {
        let texts = [-0.0, -0.000_04, -0.000_06, 1.5, -20.0].map(|value| decimals(value, 4));
        assert_eq!(texts, ["0.0000", "0.0000", "-0.0001", "1.5000", "-20.0000"]);
        assert_eq!(decimals(-0.4, 0), "0");
    }

    #[test]
    fn numbers_read_well() {
        let texts = [0, 999, 1000, 1_234_567].map(grouped);
        assert_eq!(texts, ["0", "999", "1 000", "1 234 567"]);
        let texts = [0, 1, 1200].map(|count| counted(count, "line"));
        assert_eq!(texts, ["0 lines", "1 line", "1 200 lines"]);
        let texts = [0.0, 0.0314, 12.0, 3725.25].map(seconds);
        assert_eq!(texts, ["0.0 ms", "31.4 ms", "12.000 s", "62 min 5.2 s"]);
    }
}
