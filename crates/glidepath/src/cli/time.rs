//! The readers of times on the command line.

use std::time::Duration;

/// The longest, s: a century.
const MOST_S: f64 = 3.2e9;

/// Seconds.
pub(super) fn seconds(text: &str) -> Result<f64, &'static str> {
    let number: f64 = text.parse().map_err(|_| "give a number")?;
    if number > 0.0 && number <= 1e7 {
        Ok(number)
    } else {
        Err("give seconds above 0")
    }
}

/// A time with its unit.
pub(super) fn time(text: &str) -> Result<Duration, &'static str> {
    const HOW: &str = "give a time, such as 10min, 90s, 1h or 2d";
    let end = text
        .find(|c: char| !(c.is_ascii_digit() || c == '.'))
        .unwrap_or(text.len());
    let (number, unit) = text.split_at(end);
    let factor = match unit.trim() {
        "s" | "" => 1.0,
        "min" => 60.0,
        "h" => 3600.0,
        "d" => 86_400.0,
        _ => return Err(HOW),
    };
    let number: f64 = number.parse().map_err(|_| HOW)?;
    let time_s = number * factor;
    if time_s > 0.0 && time_s <= MOST_S {
        Ok(Duration::from_secs_f64(time_s))
    } else {
        Err(HOW)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_have_units() {
        for (text, s) in [
            ("90", 90.0),
            ("1.5 h", 5400.0),
            ("7d", 604_800.0),
            ("0.5min", 30.0),
        ] {
            assert_eq!(time(text), Ok(Duration::from_secs_f64(s)), "{text}");
        }
        for text in ["", "h", "0s", "-1h", "5w", "1e3s", "99999999d", "."] {
            assert!(time(text).is_err(), "{text}");
        }
    }
}
