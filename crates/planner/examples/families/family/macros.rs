//! Programs that compute: loops in loops, subroutines, drilling cycles. The feed binds in most of
//! their time.

use crate::random::Random;
use crate::text::Text;
use std::fmt::Write as _;

/// A nested program: holes in a grid, pockets by a subroutine, or engraved rows.
pub(super) fn nested(random: &mut Random) -> String {
    let feed_mm_min = random.log_between(200.0, 2000.0);
    let mut text = Text::new([0.0; 3], feed_mm_min);
    let lines = match random.whole(0, 2) {
        0 => holes(random),
        1 => bores(random),
        _ => rows(random),
    };
    text.raw(lines.trim_end());
    text.finish()
}

/// Holes, drilled by a cycle or by hand.
fn holes(random: &mut Random) -> String {
    let (columns, rows) = (random.whole(2, 5), random.whole(1, 3));
    let pitch_mm = random.between(2.0, 15.0);
    let depth_mm = random.between(0.5, 3.0);
    let peck_mm = depth_mm / random.between(1.0, 4.0);
    let mut lines = format!("G0 Z2\n#2=0\nO100 repeat [{rows}]\n#1=0\nO110 repeat [{columns}]\n");
    let place = format!("X[#1*{pitch_mm:.4}] Y[#2*{pitch_mm:.4}]");
    let _ = match random.whole(0, 2) {
        0 => writeln!(lines, "G81 {place} Z-{depth_mm:.4} R0.5"),
        1 => writeln!(lines, "G83 {place} Z-{depth_mm:.4} R0.5 Q{peck_mm:.4}"),
        _ => writeln!(
            lines,
            "G0 {place}\nG0 Z0.2\nG1 Z-{depth_mm:.4}\nG4 P0.05\nG0 Z2"
        ),
    };
    lines.push_str("#1=[#1+1]\nO110 endrepeat\n#2=[#2+1]\nO100 endrepeat\nG80\nG0 Z5\n");
    lines
}

/// Bores, by helices of a subroutine.
fn bores(random: &mut Random) -> String {
    let radius_mm = random.log_between(0.5, 5.0);
    let pitch_mm = random.between(0.1, 0.5);
    let turns = random.whole(2, 4);
    let mut lines = format!(
        "O200 sub\nG0 X[#1+{radius_mm:.4}] Y#2\nG0 Z0.2\n#9=0.2\nO210 repeat [{turns}]\n\
         #9=[#9-{pitch_mm:.4}]\nG2 X[#1+{radius_mm:.4}] Y#2 Z#9 I-{radius_mm:.4} J0\n\
         O210 endrepeat\nG2 X[#1+{radius_mm:.4}] Y#2 I-{radius_mm:.4} J0\nG0 Z2\nO200 endsub\n"
    );
    for _ in 0..random.whole(1, 4) {
        let (x, y) = (random.between(-20.0, 20.0), random.between(-20.0, 20.0));
        let _ = writeln!(lines, "O200 call [{x:.4}] [{y:.4}]");
    }
    lines
}

/// Engraved rows: a wave that is computed, row by row.
fn rows(random: &mut Random) -> String {
    let (rows, steps) = (random.whole(1, 4), random.whole(10, 60));
    let step_mm = random.log_between(0.05, 1.0);
    let height_mm = random.log_between(0.1, 2.0);
    let wave_deg = random.between(5.0, 40.0);
    format!(
        "#2=0\nO300 repeat [{rows}]\n#1=0\nG0 X0 Y[#2*3]\nG1 Z-0.2\nO310 repeat [{steps}]\n\
         #1=[#1+1]\nG1 X[#1*{step_mm:.5}] Y[#2*3+{height_mm:.5}*SIN[#1*{wave_deg:.4}]]\n\
         O310 endrepeat\nG0 Z1\n#2=[#2+1]\nO300 endrepeat\n"
    )
}
