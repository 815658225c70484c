//! What the machine data of a SINUMERIK decide about its programs.

/// Which word changes the tool (MD 22550).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ToolChangeBy {
    /// T itself, as on the turret of a lathe.
    T,
    /// M6, for the tool that T has chosen.
    M6,
}

/// What X words are where a program of a lathe begins (MD 20150, group 29).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LatheX {
    /// Not said: a radius, which is told where a program moves before it says what X is.
    Unsaid,
    /// Diameters (DIAMON).
    Diameter,
    /// Radii (DIAMOF).
    Radius,
    /// Diameters with G90, radii with G91 (DIAM90).
    DiameterInG90,
}

/// What the machine data of a SINUMERIK say.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SiemensParameters {
    /// Which word changes the tool; `None`: T on a machine with X and Z and without Y, else M6.
    pub tool_change: Option<ToolChangeBy>,
    /// Edge D1 is in force behind a tool change that names no edge (MD 20270); else the tool has no
    /// length until D is written.
    pub edge_after_change: bool,
    /// D numbers the offsets of all tools, the lines of the tool table, whatever tool is in the spindle ("flat" D
    /// numbers, MD 18102); else the edges of the tool in the spindle.
    pub flat_d_numbers: bool,
    /// What X words are where a program begins, on a machine with X and Z and without Y.
    pub lathe_x: LatheX,
    /// The first increment of an axis behind a new frame or work offset goes the shift of its zero, too
    /// (SD 42440); else its own way alone.
    pub frame_goes_with_increments: bool,
    /// The first increment of an axis behind a new tool length goes the difference, too (SD 42442); else
    /// its own way alone.
    pub length_goes_with_increments: bool,
    /// H words, which are functions of the machine's PLC, are read over; else they are refused.
    pub reads_over_h: bool,
    /// Where the machine's Z goes up to before CYCLE800 turns the rotary axes, mm; `None`: that it shall
    /// go there (FR 1 and 2) is refused.
    pub swivel_z_mm: Option<f64>,
    /// Where the machine's X and Y go behind that (FR 2), mm; `None`: FR 2 is refused.
    pub swivel_xy_mm: [Option<f64>; 2],
}

impl Default for SiemensParameters {
    /// By the machine, and D1, which is an edge of the tool; X of a lathe is not said; increments go the shifts before them; H is refused.
    fn default() -> Self {
        Self {
            tool_change: None,
            edge_after_change: true,
            flat_d_numbers: false,
            lathe_x: LatheX::Unsaid,
            frame_goes_with_increments: true,
            length_goes_with_increments: true,
            reads_over_h: false,
            swivel_z_mm: None,
            swivel_xy_mm: [None; 2],
        }
    }
}
