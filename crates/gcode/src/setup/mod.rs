//! The set-up that a program is read for: the machine, its tools, and its work offsets.

pub(crate) mod fanuc;
pub(crate) mod firmware;
pub(crate) mod gears;
pub(crate) mod kept_variables;
pub(crate) mod m_codes;
pub(crate) mod machine;
pub(crate) mod options;
pub(crate) mod reading_watch;
pub(crate) mod siemens;
pub(crate) mod spindle_axis;
pub(crate) mod subroutine_file;
pub(crate) mod threading;
pub(crate) mod tool_table;
pub(crate) mod work_offsets;
