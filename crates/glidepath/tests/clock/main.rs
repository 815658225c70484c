//! The command where it moves a machine, at the speed of the clock.

mod host;
mod hostile_jobs;
mod joints_under_way;
mod last_resort;
mod manners;
mod running;
mod service;
#[path = "../support/mod.rs"]
mod support;
mod thinking;
