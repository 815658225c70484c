//! Arguments of the commands that plan motion: how the path is followed.

use crate::config;
use clap::Args;
use glidepath_program::Effort;

/// How the path is followed; each overrides the configuration.
#[derive(Debug, Clone, Copy, Default, Args)]
pub struct PathArgs {
    /// Effort of planning: optimal or fast; overrides `path.effort` of the configuration
    #[arg(long, value_name = "NAME", value_parser = config::effort)]
    pub effort: Option<Effort>,
    /// How far the motion may leave the programmed path, mm; overrides `path.tolerance` of the
    /// configuration. G64 P of the program overrides both
    #[arg(long, value_name = "MM", value_parser = config::tolerance)]
    pub tolerance: Option<f64>,
}
