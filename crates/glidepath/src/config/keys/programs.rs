//! The keys of the tables about what is executed, and by whom.

use super::key::{Key, LeftOut, Takes, key, number};

pub(super) const LINK: &[Key] = &[key(
    "link.instance",
    Takes::Text {
        rule: "1 to 32 letters a-z, digits, `-` or `_`",
    },
    LeftOut::Means("\"default\"; `run` takes a name of its own"),
    "names the shared memory of this machine",
)];

pub(super) const PROGRAM: &[Key] = &[
    key(
        "program.dialect",
        Takes::Choice {
            of: &["auto", "linuxcnc", "marlin", "fanuc", "siemens"],
        },
        LeftOut::Value("\"auto\""),
        "the language of programs; \"auto\": told by a program's beginning",
    ),
    key(
        "program.fanuc",
        Takes::Choice {
            of: &["auto", "mill", "lathe-a", "lathe-b", "lathe-c"],
        },
        LeftOut::Value("\"auto\""),
        "what a FANUC or Haas control is made for; \"auto\": a lathe (system A) on a machine with X and Z \
         and without Y, else a mill; \"lathe-b\" and \"lathe-c\" have the codes of these systems \
         (parameters 3401#6, #7)",
    ),
    key(
        "program.lathe_feed",
        Takes::Choice {
            of: &["unsaid", "minute", "revolution"],
        },
        LeftOut::Value("\"unsaid\""),
        "what F is on a FANUC lathe before G98 or G99 (parameter 3402#4); \"unsaid\": such an F is \
         refused",
    ),
    key(
        "program.units",
        Takes::Choice {
            of: &["unsaid", "mm", "inch"],
        },
        LeftOut::Value("\"unsaid\""),
        "the units of a FANUC program before its first G20 or G21, with which the control was switched off (Haas: \
         setting 9); \"unsaid\": mm, with a warning",
    ),
    key(
        "program.point",
        Takes::Choice {
            of: &["unsaid", "calculator", "increment"],
        },
        LeftOut::Value("\"unsaid\""),
        "what a coordinate without a decimal point is on a FANUC control (parameter 3401#0): \
         \"calculator\": X1000 is 1000 mm; \"increment\": it is 1 mm, A1000 1 degree, G4 X1000 1 s, and F is mm/min or \
         refused; \"unsaid\": up to 999 it is \
         read as mm, above it is refused",
    ),
    key(
        "program.offset_memory",
        Takes::Choice {
            of: &["unsaid", "A", "C", "haas"],
        },
        LeftOut::Value("\"unsaid\""),
        "how a FANUC control divides the memory of tool offsets (parameter 6000#3), which says what \
         #2001 to #2800 are; \"unsaid\": they are refused; \"haas\": the control is a Haas in the rest, \
         too (F, chamfers, G92, M98, K and R of cycles, G85 …)",
    ),
    key(
        "program.arctangent",
        Takes::Choice {
            of: &["0-360", "signed"],
        },
        LeftOut::Value("\"0-360\""),
        "the range of ATAN[a]/[b] and ASIN[a] on a FANUC control (parameter 6004#0): 0 to 360 degrees, \
         and 270 to 90; or -180 to 180, and -90 to 90",
    ),
    key(
        "program.bore_shift",
        Takes::Choice {
            of: &["unsaid", "+X", "-X", "+Y", "-Y"],
        },
        LeftOut::Value("\"unsaid\""),
        "which way Q of G76 takes the tip off the wall on a FANUC or Haas mill (parameter 5101#4, #5; \
         setting 27); \"unsaid\": such a Q is refused",
    ),
    key(
        "program.outer_corners",
        Takes::Choice {
            of: &["unsaid", "lines", "arcs"],
        },
        LeftOut::Value("\"unsaid\""),
        "how the tool goes round outer corners with G41 and G42 on a FANUC (parameter 19607#2); \"unsaid\": \
         in lines, but on arcs with offset_memory = \"haas\"",
    ),
    key(
        "program.roll_over",
        Takes::Choice {
            of: &["off", "shorter-way"],
        },
        LeftOut::Value("\"off\""),
        "whether A, B and C of a FANUC roll over (parameter 1008): \"shorter-way\": to an angle in G90 they turn the \
         shorter way (ROAx 1, RABx 0); \"off\": they go to the angle that is written (ROAx 0)",
    ),
    key(
        "program.rotation",
        Takes::Choice {
            of: &["by-distance-mode", "absolute"],
        },
        LeftOut::Value("\"by-distance-mode\""),
        "what R of G68 is in G91 on a FANUC or Haas mill (parameter 5400#0, RIN; setting 73): \"by-distance-mode\": it \
         is added to the angle in force; \"absolute\": the angle",
    ),
    key(
        "program.rotation_start",
        Takes::Choice {
            of: &["unsaid", "as-before", "as-rotated"],
        },
        LeftOut::Value("\"unsaid\""),
        "where the coordinate of the plane is that the first move behind G68 of a FANUC does not name (parameter 11600#5, \
         AX1): \"as-before\": what it was before the rotation, and it is rotated (0); \"as-rotated\": where the tool is in \
         the rotated coordinates (1, and series 0i-C); \"unsaid\": such a move is refused where that differs",
    ),
    key(
        "program.unwind",
        Takes::Choice {
            of: &["never", "rapids"],
        },
        LeftOut::Value("\"never\""),
        "whether C of a five-axis machine is turned back where it has wound up to the end of its travel: \"rapids\": by \
         rapid moves to a direction of the tool; \"never\": such a move is refused, as one at feed is in any case",
    ),
    key(
        "program.tool_change",
        Takes::Choice {
            of: &["auto", "T", "M6"],
        },
        LeftOut::Value("\"auto\""),
        "which word changes the tool on a SINUMERIK (MD 22550); \"auto\": T on a machine with X and Z \
         and without Y, else M6",
    ),
    key(
        "program.edge_after_change",
        Takes::Choice {
            of: &["D1", "none"],
        },
        LeftOut::Value("\"D1\""),
        "the edge that is in force behind a tool change of a SINUMERIK that names none (MD 20270): \
         \"none\": the tool has no length until D is written",
    ),
    key(
        "program.d_numbers",
        Takes::Choice {
            of: &["edges", "flat"],
        },
        LeftOut::Value("\"edges\""),
        "what D numbers on a SINUMERIK (MD 18102): \"edges\": those of the tool in the spindle; \"flat\": \
         the lines of the tool table, by their T, whatever the tool",
    ),
    key(
        "program.lathe_x",
        Takes::Choice {
            of: &["unsaid", "diameter", "radius", "diameter-in-G90"],
        },
        LeftOut::Value("\"unsaid\""),
        "what X words are on a SINUMERIK lathe (X and Z, without Y) before DIAMON, DIAMOF or DIAM90 \
         (MD 20150, group 29); \"unsaid\": radii, with a warning",
    ),
    key(
        "program.increment_after_frame",
        Takes::Choice {
            of: &["shifted", "alone"],
        },
        LeftOut::Value("\"shifted\""),
        "what an axis goes in its first increment (G91, IC) behind a new frame or work offset on a \
         SINUMERIK (SD 42440): \"shifted\": the increment and the shift of the zero; \"alone\": the \
         increment",
    ),
    key(
        "program.increment_after_length",
        Takes::Choice {
            of: &["shifted", "alone"],
        },
        LeftOut::Value("\"shifted\""),
        "the same behind a new length of the tool (SD 42442)",
    ),
    key(
        "program.h_words",
        Takes::Choice {
            of: &["refused", "read-over"],
        },
        LeftOut::Value("\"refused\""),
        "H words of a SINUMERIK, functions of the machine's PLC: \"read-over\": they do nothing here",
    ),
    key(
        "program.swivel_z",
        number(-1e6, 1e6, "mm"),
        LeftOut::Means("CYCLE800 with FR 1 or 2 is refused"),
        "where the machine's Z goes up to before CYCLE800 of a SINUMERIK turns the rotary axes, where its \
         program asks for it (FR 1 and 2)",
    ),
    key(
        "program.swivel_x",
        number(-1e6, 1e6, "mm"),
        LeftOut::Means("CYCLE800 with FR 2 is refused"),
        "where the machine's X goes, together with Y, once Z is up, with FR 2",
    ),
    key(
        "program.swivel_y",
        number(-1e6, 1e6, "mm"),
        LeftOut::Means("CYCLE800 with FR 2 is refused"),
        "where the machine's Y goes, together with X, once Z is up, with FR 2",
    ),
    key(
        "program.tool_table",
        Takes::Text {
            rule: "a file, beside the configuration or with its full path",
        },
        LeftOut::Means("blocks that need a tool's length or diameter are refused"),
        "lengths and diameters of the tools, in LinuxCNC's format",
    ),
    key(
        "program.subroutine_path",
        Takes::Texts {
            rule: "a folder, beside the configuration or with its full path",
        },
        LeftOut::Value("[]"),
        "folders of subroutines in files of their own, behind the folder of the program",
    ),
    key(
        "program.inputs_outputs",
        Takes::Choice {
            of: &["none", "simulated", "feedback"],
        },
        LeftOut::Value("\"none\""),
        "\"simulated\": M62 to M68, M19 and probing are accepted, and simulated; \"feedback\": M66 \
         reads the inputs of feedback, outputs are those of the auxiliary record, and the probe is \
         that of [probe]",
    ),
    key(
        "program.extruder",
        Takes::Choice {
            of: &["none", "U", "V", "W"],
        },
        LeftOut::Value("\"none\""),
        "the axis that E words of printers move",
    ),
    key(
        "program.firmware",
        Takes::Choice {
            of: &["auto", "marlin", "klipper"],
        },
        LeftOut::Value("\"auto\""),
        "the firmware of the printer: whether G90 makes E absolute behind M83 (Marlin) or not (Klipper); \
         \"auto\": Klipper where a program has commands with names, else E is refused there",
    ),
];

pub(super) const M_CODES: &[Key] = &[
    key(
        "m_codes.M6.done",
        Takes::Text {
            rule: "\"acknowledge\", \"spindle-at-speed\", \"spindle-stopped\", \
                   \"spindle-oriented\", \"spindle-in-gear\", \"input 3 high\", \"input 3 low\" or \"nothing\"",
        },
        LeftOut::Means("\"acknowledge\""),
        "the motion does not pass the code before this; a code or a range that programs do not \
         have by themselves (M428, M100-M199) is declared by its table",
    ),
    key(
        "m_codes.M6.at",
        Takes::Choice {
            of: &["code", "next-feed", "block-end"],
        },
        LeftOut::Value("\"code\""),
        "where the motion waits: at the code, in front of the next feed or probing move, or at the \
         end of the code's block",
    ),
    key(
        "m_codes.M6.timeout_s",
        number(0.1, 86_400.0, "s"),
        LeftOut::Means("it is waited for ever"),
        "waiting for longer is a fault",
    ),
];

pub(super) const STATE: &[Key] = &[key(
    "state.directory",
    Takes::Text {
        rule: "a folder, beside the configuration or with its full path",
    },
    LeftOut::Means("nothing is kept: every program begins in G54 with all offsets zero"),
    "folder of what is kept over a restart: work offsets, G28, G30, G92, what G10 made of tools, parameters #500 to #999",
)];

pub(super) const PREVIEW: &[Key] = &[
    key(
        "preview.growth",
        number(1.01, 100.0, ""),
        LeftOut::Value("2"),
        "`preview --method advance-retreat`: factor of a step that went well",
    ),
    key(
        "preview.max_growth",
        number(1.0, 1e6, ""),
        LeftOut::Value("8"),
        "its longest step, in first steps; longer ones pass over regions",
    ),
];
