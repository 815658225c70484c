//! The places where blocks of the program began, for a motion that comes back to them.

use std::collections::VecDeque;

/// The path positions at which the blocks began that the motion has passed, up to so many.
#[derive(Debug)]
pub(crate) struct BlockStarts {
    /// Block and path position, mm, with rising blocks.
    starts: VecDeque<(u32, f64)>,
    most: usize,
}

impl BlockStarts {
    pub(crate) fn new(most: usize) -> Self {
        Self {
            starts: VecDeque::with_capacity(most),
            most,
        }
    }

    /// Another program begins.
    pub(crate) fn forget(&mut self) {
        self.starts.clear();
    }

    /// The motion comes into a block at a path position. Returns where the block began: there, or
    /// where it was come into first.
    pub(crate) fn enter(&mut self, block: u32, path_s: f64) -> f64 {
        match self.starts.binary_search_by_key(&block, |start| start.0) {
            Ok(known) => self.starts.get(known).map_or(path_s, |start| start.1),
            Err(place) if place == self.starts.len() => {
                if self.starts.len() >= self.most {
                    self.starts.pop_front();
                }
                self.starts.push_back((block, path_s));
                path_s
            }
            // Shorter than a period when it was passed.
            Err(_) => path_s,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    #[allow(clippy::float_cmp, reason = "copies")]
    fn a_block_begins_where_it_was_entered_first() {
        let mut starts = BlockStarts::new(3);
        for block in [2, 3, 5] {
            let path_s = f64::from(block) * 10.0;
            assert_eq!(starts.enter(block, path_s), path_s);
        }
        assert_eq!(starts.enter(3, 49.0), 30.0);
        assert_eq!(starts.enter(4, 42.0), 42.0, "not seen before");
        assert_eq!(starts.enter(6, 60.0), 60.0);
        assert_eq!(starts.enter(2, 25.0), 25.0, "forgotten for the last");
        assert_eq!(starts.enter(5, 59.0), 50.0);
        starts.forget();
        assert_eq!(starts.enter(1, 7.0), 7.0);
    }
}
