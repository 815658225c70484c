//! The records that cross processes, and their transports.
