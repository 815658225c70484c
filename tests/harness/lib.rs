//! Harness of the end-to-end tests: starts the real binary and reads what it wrote.
