//! Motion that nothing later changes: path with its speeds, and rests.

use crate::on_path::pieces::{Element, Piece};
use crate::on_path::speed::Leg;
use crate::on_path::topp::Parametrisation;
use crate::rest::Rest;

/// A part of the motion that nothing later changes.
#[derive(Debug, Clone)]
pub(crate) enum Settled {
    /// Drive these pieces with these S-curves.
    Motion { pieces: Vec<Piece>, legs: Vec<Leg> },
    /// Drive these pieces by this parametrisation.
    Parametrised {
        pieces: Vec<Piece>,
        parametrisation: Parametrisation,
    },
    /// Rest.
    Rest(Rest),
}

impl Settled {
    /// How long the motion takes, s.
    pub(crate) fn duration_t(&self) -> f64 {
        match self {
            Self::Motion { legs, .. } => legs.iter().map(|leg| leg.profile.duration_t()).sum(),
            Self::Parametrised {
                parametrisation, ..
            } => parametrisation.duration_t(),
            Self::Rest(_) => 0.0,
        }
    }

    /// What it was made of.
    pub(crate) fn elements(&self) -> Vec<Element> {
        match self {
            Self::Motion { pieces, .. } | Self::Parametrised { pieces, .. } => {
                pieces.iter().cloned().map(Element::Piece).collect()
            }
            Self::Rest(rest) => vec![Element::Rest(*rest)],
        }
    }
}
