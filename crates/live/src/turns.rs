//! The turns of pages: a page has one question answered at a time, and so many pages have one.

use std::sync::{Mutex, MutexGuard, PoisonError};

/// Pages that may have a question answered at the same time.
const MOST_PAGES: usize = 4;

/// Whose questions are being answered.
#[derive(Debug, Default)]
pub struct Turns {
    pages: Mutex<Vec<u64>>,
}

/// The turn of a page, until dropped.
#[derive(Debug)]
pub struct Turn<'t> {
    turns: &'t Turns,
    page: u64,
}

impl Turns {
    /// The turn of a page; `None` while another question of it is being answered, or those of too many others.
    #[must_use]
    pub fn take(&self, page: u64) -> Option<Turn<'_>> {
        let mut pages = self.pages();
        if pages.len() >= MOST_PAGES || pages.contains(&page) {
            return None;
        }
        pages.push(page);
        Some(Turn { turns: self, page })
    }

    fn pages(&self) -> MutexGuard<'_, Vec<u64>> {
        self.pages.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Drop for Turn<'_> {
    fn drop(&mut self) {
        self.turns.pages().retain(|page| *page != self.page);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_page_has_one_turn_at_a_time_and_few_pages_have_one() {
        let turns = Turns::default();
        let first = turns.take(1).unwrap();
        assert!(turns.take(1).is_none());
        let others = [2, 3, 4].map(|page| turns.take(page).unwrap());
        assert!(turns.take(5).is_none());
        drop(first);
        assert!(turns.take(2).is_none() && turns.take(1).is_some());
        drop(others);
        assert!(turns.take(5).is_some());
    }
}
