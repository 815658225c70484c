//! The gears of a spindle: M41 to M45, M40 of SINUMERIK, and S.

use std::sync::Arc;

use glidepath_gcode::{Dialect, GearSpeeds, Gears, MCodes, Options, Program};
use glidepath_program::{Event, ItemKind};

/// Gears of 20 to 800, 200 to 2000 and 1500 to 6000 rev/min.
fn options(dialect: Dialect, is_by_speed: bool) -> Options {
    let speeds = [(20.0, 800.0), (200.0, 2000.0), (1500.0, 6000.0)];
    let speeds = speeds.map(|(least, most)| GearSpeeds { least, most });
    let gears = Gears::new(speeds.to_vec(), is_by_speed).unwrap();
    let mut m_codes = MCodes::default();
    gears.declare(dialect, &mut m_codes);
    Options {
        dialect,
        gears: Arc::new(gears),
        m_codes: Arc::new(m_codes),
        waits_for_speed: true,
        ..Options::default()
    }
}

fn told(text: &str, options: &Options) -> Result<Vec<Event>, String> {
    let mut events = Vec::new();
    for item in Program::new(text.as_bytes(), options.clone()) {
        match item {
            Ok(item) => {
                if let ItemKind::Event(event) = item.kind {
                    events.extend((event != m(2)).then_some(event));
                }
            }
            Err(diagnostic) => return Err(diagnostic.to_string()),
        }
    }
    Ok(events)
}

#[test]
fn a_gear_does_not_start_the_spindle() {
    let text = "M41 S300 M3\nG95 F.2 G1 X1\nM5\nM42\nG1 X2\nM2\n";
    let refused = told(text, &options(Dialect::LinuxCnc, false)).unwrap_err();
    assert!(refused.contains("a spindle that stands"), "{refused}");
}

const fn m(code: u32) -> Event {
    Event::MCode(code)
}

const fn s(rpm: f64) -> Event {
    Event::SpindleSpeed(rpm)
}

const fn gear(number: u32) -> [Event; 2] {
    [Event::SpindleGear(number), Event::MCode(40 + number)]
}

#[test]
fn a_gear_comes_in_front_of_the_speed_and_the_direction_of_its_block() {
    for dialect in [Dialect::LinuxCnc, Dialect::Fanuc, Dialect::Siemens] {
        let text = "M3 S300 M42\nG1 X1 F100\nM43 S3000\nM5\nM41\nM2\n";
        let [two, three, one] = [gear(2), gear(3), gear(1)];
        // Turning, the speed in another gear is waited for.
        let expected = [
            &two[..],
            &[s(300.0), m(3)],
            &three,
            &[s(3000.0), m(3), m(5)],
            &one,
        ]
        .concat();
        assert_eq!(
            told(text, &options(dialect, false)),
            Ok(expected),
            "{dialect:?}"
        );
    }
}

#[test]
fn a_speed_that_the_gear_does_not_have_is_refused() {
    let of = options(Dialect::LinuxCnc, false);
    let above = told("M41\nM3 S801\n", &of).unwrap_err();
    assert!(
        above.contains("S801 is not from 20 to 800 rev/min, as gear 1 (M41) turns"),
        "{above}"
    );
    assert!(told("M43\nM3 S1499\n", &of).is_err());
    // The gear of a spindle that turns at a speed of its old one.
    assert!(told("M41 S100 M3\nM43\n", &of).is_err());
    assert!(told("M41 S100 M3\nM43 S1500\n", &of).is_ok());
    // One that stands has no speed; and where no gear was named, nobody knows it.
    assert!(told("M41 S5000\nM43\nM3\n", &of).is_ok());
    assert!(told("S9000 M3\n", &of).is_ok());
    let unknown = told("M44\n", &of).unwrap_err();
    assert!(
        unknown.contains("M44 is a gear that the spindle does not have"),
        "{unknown}"
    );
    assert!(told("M41 M42\n", &of).is_err());
}

#[test]
fn the_revolutions_of_a_cutting_speed_stay_in_the_gear() {
    let of = options(Dialect::LinuxCnc, false);
    let events = told("G18 M42 G0 X50\nG96 S200 M3\nG1 X5 F100\nM2\n", &of).unwrap();
    let speeds = events.iter().filter_map(|event| match event {
        Event::SpindleSpeed(rpm) => Some(*rpm),
        _ => None,
    });
    let speeds: Vec<f64> = speeds.collect();
    // 1000 · 200 / (2 π · 50) at first; 6366 at the end, of which there are 2000.
    assert!((speeds[0] - 636.6).abs() < 0.1, "{speeds:?}");
    // The last step is worth telling where it is more than 1 %.
    let most = speeds.iter().copied().fold(0.0, f64::max);
    assert!((1980.0..=2000.0).contains(&most), "{most}");
}

#[test]
fn s_chooses_the_gear_under_m40_and_where_the_machine_does() {
    let [one, two, three] = [gear(1), gear(2), gear(3)];
    // 500 stays in the second gear, which has it, too; 1800 stays there; 100 and 3000 are of others.
    let body = "S1000 M3\nS500\nS1800\nS3000\nS100\nM2\n";
    let expected = [
        &two[..],
        &[s(1000.0), m(3), s(500.0), m(3), s(1800.0), m(3)],
        &three,
        &[s(3000.0), m(3)],
        &one,
        &[s(100.0), m(3), m(5)],
    ]
    .concat();
    let siemens = options(Dialect::Siemens, false);
    assert_eq!(told(&format!("M40\n{body}"), &siemens).unwrap(), expected);
    let fanuc = options(Dialect::Fanuc, true);
    assert_eq!(told(body, &fanuc).unwrap(), expected);
    // A word ends that; M40 begins it anew, with the speed that there is.
    let ended = told("M40 S1000 M3\nM41 S300\nS400\nM40\nS900\n", &siemens).unwrap();
    let words: Vec<Event> = ended
        .into_iter()
        .filter(|event| matches!(event, Event::SpindleGear(_)))
        .collect();
    assert_eq!(words, [2, 1, 2].map(Event::SpindleGear));
    let beyond = told("M40\nS7000 M3\n", &siemens).unwrap_err();
    assert!(beyond.contains("S7000 is a speed of no gear"), "{beyond}");
    // On other controls M40 is the builder's.
    assert!(told("M40\n", &fanuc).is_err());
}

#[test]
fn without_gears_their_words_are_what_they_were() {
    let none = |dialect| Options {
        dialect,
        ..Options::default()
    };
    assert!(told("M41\n", &none(Dialect::LinuxCnc)).is_err());
    assert!(told("M41\n", &none(Dialect::Fanuc)).is_err());
    assert_eq!(
        told("M41 S300 M3\nM5\n", &none(Dialect::Siemens)),
        Ok(vec![s(300.0), m(3), m(5)])
    );
}
