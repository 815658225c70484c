//! The chords of a curve, over one lap or several.

use crate::implicit::ImplicitChords;
use crate::parametric::ParametricChords;
use crate::{Chord, CurveError};
use nalgebra::Vector3;

#[derive(Debug, Clone)]
enum Lap {
    Parametric(ParametricChords),
    Implicit(ImplicitChords),
}

/// Chords along a curve over a number of laps. Each lap starts at the curve's own start and takes
/// the same chords: nothing can drift.
#[derive(Debug, Clone)]
pub struct Chords {
    first: Lap,
    lap: Lap,
    laps_left: u32,
}

impl Lap {
    const fn point(&self) -> &Vector3<f64> {
        match self {
            Self::Parametric(chords) => chords.point(),
            Self::Implicit(chords) => chords.point(),
        }
    }

    fn next_chord(&mut self) -> Result<Option<Chord>, CurveError> {
        match self {
            Self::Parametric(chords) => chords.next_chord(),
            Self::Implicit(chords) => chords.next_chord(),
        }
    }
}

impl From<ParametricChords> for Chords {
    fn from(chords: ParametricChords) -> Self {
        Self::once(Lap::Parametric(chords))
    }
}

impl From<ImplicitChords> for Chords {
    fn from(chords: ImplicitChords) -> Self {
        Self::once(Lap::Implicit(chords))
    }
}

impl Chords {
    fn once(lap: Lap) -> Self {
        Self {
            first: lap.clone(),
            lap,
            laps_left: 0,
        }
    }

    /// The same over several laps of a closed curve, at least one.
    #[must_use]
    pub fn with_laps(self, laps: u32) -> Self {
        Self {
            laps_left: laps.saturating_sub(1),
            ..self
        }
    }

    /// Where the next chord starts.
    #[must_use]
    pub const fn point(&self) -> &Vector3<f64> {
        self.lap.point()
    }

    /// The next chord; `None` after the last.
    ///
    /// # Errors
    /// The error of no chord can be bounded, or the end does not come.
    pub fn next_chord(&mut self) -> Result<Option<Chord>, CurveError> {
        let chord = self.lap.next_chord()?;
        if chord.is_some() || self.laps_left == 0 {
            return Ok(chord);
        }
        self.laps_left -= 1;
        self.lap = self.first.clone();
        self.lap.next_chord()
    }
}
