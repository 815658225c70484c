//! Settled motion, which nothing later changes: path with its speeds, and rests.

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

    /// Memory that it keeps beside its own, bytes.
    pub(crate) fn heap_bytes(&self) -> usize {
        let of_pieces = |pieces: &Vec<Piece>| {
            let beside: usize = pieces.iter().map(Piece::heap_bytes).sum();
            pieces.capacity() * size_of::<Piece>() + beside
        };
        match self {
            Self::Motion { pieces, legs } => of_pieces(pieces) + legs.capacity() * size_of::<Leg>(),
            Self::Parametrised {
                pieces,
                parametrisation,
            } => of_pieces(pieces) + parametrisation.heap_bytes(),
            Self::Rest(_) => 0,
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
