//! The words for what a program should say and does not, the same wherever they are told.

use glidepath_gcode::Lacking;

const NO_END: &str =
    "the text ends without M2, M30 or a last %: make sure that nothing of it is missing";

const NO_UNITS: &str = "it moves before G20 or G21, and is read in millimetres: write one of them, or say with which the \
                        control begins: `units` of [program] in the configuration";

const NO_DIAMETER: &str = "it moves before DIAMON or DIAMOF, and X is read as a radius: write one of them, or say what X is \
                           where a program begins: `lathe_x` of [program] in the configuration";

const CROSSING: &str = "a cycle begins below its R plane: the tool goes across to its hole at that level, as a FANUC does: \
                        make sure that nothing stands there, or write a higher level before the cycle";

const NO_DWELL: &str =
    "Klipper reads over S of G4 and does not wait: write G4 P, in milliseconds, if it shall";

const SECONDS: &str = "P without a decimal point counts seconds here, and it waits for more than 10: on a FANUC, whose programs \
                       begin with %, too, it would be milliseconds: if it is one's, say --dialect fanuc, or set `dialect` of \
                       [program] in the configuration; if seconds are meant, write the point";

/// What stands in front of a warning in a text that says other things, too.
pub const WARNING: &str = "warning: ";

/// What is said of a program that is no mistake for certain.
pub fn warnings(lacks: Lacking) -> impl Iterator<Item = &'static str> {
    let all = [
        (lacks.end, NO_END),
        (lacks.units, NO_UNITS),
        (lacks.diameter, NO_DIAMETER),
        (lacks.crossing, CROSSING),
        (lacks.dwell, NO_DWELL),
        (lacks.seconds, SECONDS),
    ];
    all.into_iter()
        .filter_map(|(is_told, words)| is_told.then_some(words))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_is_told_where_it_is_lacking() {
        let all = Lacking {
            end: true,
            units: true,
            diameter: true,
            crossing: true,
            dwell: true,
            seconds: true,
        };
        assert_eq!(
            warnings(all).collect::<Vec<_>>(),
            [NO_END, NO_UNITS, NO_DIAMETER, CROSSING, NO_DWELL, SECONDS]
        );
        let units = Lacking {
            units: true,
            ..Lacking::default()
        };
        assert_eq!(warnings(units).collect::<Vec<_>>(), [NO_UNITS]);
        assert_eq!(warnings(Lacking::default()).count(), 0);
    }
}
