//! The source of chance of the searches: SplitMix64.
//!
//! A counter in steps of an odd constant, its bits mixed by two multiplications: every seed gives
//! another sequence of period 2⁶⁴, the same on every machine and in every version. Source: Steele,
//! Lea, Flood, *Fast splittable pseudorandom number generators*, 2014.

#[derive(Debug, Clone)]
pub(crate) struct Random {
    state: u64,
}

impl Random {
    pub(crate) const fn new(seed: u64) -> Self {
        Self { state: seed }
    }

    fn next(&mut self) -> u64 {
        self.state = self.state.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.state;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    /// Evenly from 0 up to 1.
    pub(crate) fn unit(&mut self) -> f64 {
        // The upper 53 bits: as many as a double holds.
        (self.next() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// A direction of length 1 in as many dimensions as there are places: the corner-heavy choice
    /// of the foraging method, evenly from a cube and then normalised.
    pub(crate) fn direction(&mut self, places: &mut [f64]) {
        let mut square = 0.0;
        for place in places.iter_mut() {
            *place = 2.0 * self.unit() - 1.0;
            square += *place * *place;
        }
        let length = f64::sqrt(square).max(f64::MIN_POSITIVE);
        places.iter_mut().for_each(|place| *place /= length);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_published_sequence() {
        // First values of the reference implementation for the seed 1234567.
        let mut random = Random::new(1_234_567);
        let expected = [
            6_457_827_717_110_365_317,
            3_203_168_211_198_807_973,
            9_817_491_932_198_370_423,
        ];
        assert_eq!([(); 3].map(|()| random.next()), expected);
    }

    #[test]
    fn directions_have_length_one() {
        let mut random = Random::new(1);
        let mut direction = [0.0; 17];
        random.direction(&mut direction);
        let square: f64 = direction.iter().map(|x| x * x).sum();
        assert!((square - 1.0).abs() < 1e-15);
        assert!(direction.iter().any(|x| *x < 0.0) && direction.iter().any(|x| *x > 0.0));
    }
}
