//! The comparison of benchmark programs with what is known of them: cycle times against bounds and
//! against another control.

mod anchors;
mod report;

pub use anchors::{Anchors, Catalogue, CatalogueEntry, CatalogueError, OtherControl};
pub use report::{BenchReport, BenchRow};
