//! G-code text to canonical machining moves, with diagnostics.
