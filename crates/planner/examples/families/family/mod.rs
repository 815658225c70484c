//! Families of programs that are drawn at random: one number, one program.

mod arcs;
mod curves;
mod dense;
mod events;
mod macros;
mod pockets;
mod polylines;
mod teeth;

use crate::random::Random;

pub(crate) use dense::Circle;

/// A program that was drawn.
#[derive(Debug, Clone)]
pub(crate) struct Drawn {
    pub(crate) text: String,
    /// What it is, if it is nothing but a circle: there is a time to compare with.
    pub(crate) circle: Option<Circle>,
}

impl From<String> for Drawn {
    fn from(text: String) -> Self {
        Self { text, circle: None }
    }
}

/// A family: its name and how a program of it is drawn.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Family {
    pub(crate) name: &'static str,
    draw: fn(&mut Random) -> Drawn,
}

impl Family {
    /// The program of a seed.
    pub(crate) fn program(&self, seed: u64) -> Drawn {
        (self.draw)(&mut Random::new(self.name, seed))
    }
}

/// All families.
pub(crate) const FAMILIES: [Family; 15] = [
    Family {
        name: "polylines",
        draw: |random| polylines::polyline(random).into(),
    },
    Family {
        name: "arcs",
        draw: |random| arcs::chain(random).into(),
    },
    Family {
        name: "circles",
        draw: dense::circle,
    },
    Family {
        name: "spirals",
        draw: |random| curves::spiral(random).into(),
    },
    Family {
        name: "clothoids",
        draw: |random| curves::clothoid(random).into(),
    },
    Family {
        name: "teeth",
        draw: |random| teeth::flanks(random).into(),
    },
    Family {
        name: "lettering",
        draw: |random| polylines::lettering(random).into(),
    },
    Family {
        name: "pockets",
        draw: |random| pockets::pocket(random).into(),
    },
    Family {
        name: "cam",
        draw: |random| dense::noisy(random).into(),
    },
    Family {
        name: "relief",
        draw: |random| dense::relief(random).into(),
    },
    Family {
        name: "rotary",
        draw: |random| curves::rotary(random).into(),
    },
    Family {
        name: "helices",
        draw: |random| arcs::helix(random).into(),
    },
    Family {
        name: "sawteeth",
        draw: |random| arcs::sawtooth(random).into(),
    },
    Family {
        name: "macros",
        draw: |random| macros::nested(random).into(),
    },
    Family {
        name: "events",
        draw: |random| events::engraved(random).into(),
    },
];
