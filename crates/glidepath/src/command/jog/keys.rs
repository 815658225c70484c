//! The jog by the keys of a terminal.
//!
//! A terminal tells when a key is pressed, and again while it is held down, but not that it is
//! released. So every press, and every repetition, moves for [`PRESS`] only: longer than a terminal
//! takes between two repetitions, and much shorter than anybody needs to be surprised. A key that is
//! held down moves a moment, rests until its repetition begins, and moves as long as that goes on.
//!
//! Whatever is lost, the motion stops: the key, the terminal (it hangs up), this process (the
//! interpolator hears of nobody for its jog time-out). A process that was stopped and goes on forgets
//! what was pressed meanwhile.

use super::arrival::is_at_end;
use super::panel::Panel;
use super::terminal::{Heard, Key, Terminal};
use crate::cli::JogArgs;
use crate::command::failure::Failure;
use crate::config::MachineConfig;
use crate::exit::Exit;
use crate::interrupt::Interrupt;
use crate::output;
use crate::report::decimals;
use core::time::Duration;
use glidepath_geometry::{AXES, Axis};
use glidepath_link::{JogMode, MachineState};
use glidepath_realtime::{Clock as _, Monotonic};
use std::io::{IsTerminal as _, Write as _};
use std::time::Instant;

/// How long a press moves. Terminals repeat keys every 20 to 50 ms.
const PRESS: Duration = Duration::from_millis(120);
/// Between two signs of life.
const REPEAT: Duration = Duration::from_millis(30);
/// Between two lines of what the machine does.
const SHOW: Duration = Duration::from_millis(100);
/// A turn that takes longer than this means that the process did not run.
const STALL: Duration = Duration::from_millis(200);
/// Factor from one speed to the next.
const FASTER: f64 = 1.25;

const HELP: &str = "arrows X Y · page up/down Z · X…W then + - another axis · i step or as long as held · \
                    f s faster, slower · space stop · q end\n";

/// What a press does.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Action {
    Move(Axis, f64),
    Select(Selected),
    NextStep,
    Faster(f64),
    Stop,
    Quit,
    Nothing,
}

/// What + and - move.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Selected {
    Axis(Axis),
    /// Nothing: the machine has no such axis, and whoever asked for it does not mean another one.
    Missing(Axis),
}

/// What the operator has chosen, and presses.
struct Hand<'m> {
    config: &'m MachineConfig,
    by_joint: bool,
    /// Part of the jog's speed.
    part: f64,
    /// The step in use; none as long as a key is held.
    step: Option<usize>,
    selected: Selected,
    /// What is moved, and until when.
    pressed: Option<(Axis, f64, Instant)>,
    sent: Instant,
}

/// Moves the axes by keys until that is ended.
///
/// # Errors
/// No terminal, or no interpolator.
pub(super) fn jog(
    args: &JogArgs,
    config: &MachineConfig,
    instance: &str,
    mut panel: Panel,
) -> Result<Exit, Failure> {
    if !std::io::stdin().is_terminal() || args.operator.basic.json {
        return Err(Failure::CommandRefused {
            command: "jog",
            state: panel.state()?.name(),
            reason: "keys need a terminal; without one give steps, such as `glidepath jog X10`"
                .to_owned(),
        });
    }
    let interrupt = Interrupt::install().map_err(Failure::Signals)?;
    let terminal = Terminal::open().map_err(Failure::Terminal)?;
    output::note(&format!("jogging {instance} by keys: {}", HELP.trim_end()));
    let mut hand = Hand::new(args, config);
    let ended = follow_keys(&mut hand, &terminal, &mut panel, &interrupt);
    // Whatever ended it.
    let released = panel.demands.let_go();
    drop(terminal);
    let _ = writeln!(std::io::stderr());
    ended?;
    released?;
    Ok(Exit::Done)
}

fn follow_keys(
    hand: &mut Hand<'_>,
    terminal: &Terminal,
    panel: &mut Panel,
    interrupt: &Interrupt,
) -> Result<(), Failure> {
    let (mut turned, mut shown) = (Instant::now(), None::<Instant>);
    while !interrupt.is_set() {
        let Heard::Keys(keys) = terminal
            .keys(Duration::from_millis(10))
            .map_err(Failure::Terminal)?
        else {
            return Ok(());
        };
        if turned.elapsed() > STALL {
            terminal.forget();
            hand.release(panel)?;
        } else {
            for key in keys {
                if !hand.press(hand.action(key), panel)? {
                    return Ok(());
                }
            }
        }
        turned = Instant::now();
        hand.keep_alive(panel)?;
        let state = panel.state()?;
        if shown.is_none_or(|shown| shown.elapsed() >= SHOW) {
            shown = Some(Instant::now());
            hand.show(panel, state);
        }
    }
    Ok(())
}

impl<'m> Hand<'m> {
    fn new(args: &JogArgs, config: &'m MachineConfig) -> Self {
        let selected = config.axis_names().first().copied().unwrap_or(Axis::X);
        let fastest = config.jog.velocity.get(selected.index());
        let asked = args.feed.zip(fastest).map(|(feed, v)| feed / 60.0 / v);
        Self {
            config,
            by_joint: args.by_joint,
            part: asked.unwrap_or(0.25).clamp(1e-3, 1.0),
            step: None,
            selected: Selected::Axis(selected),
            pressed: None,
            sent: Instant::now(),
        }
    }

    fn action(&self, key: Key) -> Action {
        let moves = |axis, side| {
            if self.config.axis_names().contains(&axis) {
                Action::Move(axis, side)
            } else {
                Action::Nothing
            }
        };
        match key {
            Key::Left => moves(Axis::X, -1.0),
            Key::Right => moves(Axis::X, 1.0),
            Key::Down => moves(Axis::Y, -1.0),
            Key::Up => moves(Axis::Y, 1.0),
            Key::PageDown => moves(Axis::Z, -1.0),
            Key::PageUp => moves(Axis::Z, 1.0),
            Key::Character('+') => self.moves_selected(1.0),
            Key::Character('-') => self.moves_selected(-1.0),
            Key::Character(' ') => Action::Stop,
            Key::Character('q') => Action::Quit,
            Key::Character('i') => Action::NextStep,
            Key::Character('f') => Action::Faster(FASTER),
            Key::Character('s') => Action::Faster(1.0 / FASTER),
            // Capitals: small letters are commands.
            Key::Character(letter) => match Axis::from_letter(letter) {
                Some(axis) if self.config.axis_names().contains(&axis) => {
                    Action::Select(Selected::Axis(axis))
                }
                Some(axis) => Action::Select(Selected::Missing(axis)),
                None => Action::Nothing,
            },
        }
    }

    const fn moves_selected(&self, side: f64) -> Action {
        match self.selected {
            Selected::Axis(axis) => Action::Move(axis, side),
            Selected::Missing(_) => Action::Nothing,
        }
    }

    /// Does what a key says. Returns whether to go on.
    fn press(&mut self, action: Action, panel: &mut Panel) -> Result<bool, Failure> {
        match action {
            Action::Nothing => {}
            Action::Quit => return Ok(false),
            Action::Stop => self.release(panel)?,
            Action::Select(selected) => {
                // What is still held down belongs to the axis before.
                self.release(panel)?;
                self.selected = selected;
            }
            Action::Faster(factor) => {
                self.part = (self.part * factor).clamp(1e-3, 1.0);
                self.pressed = None;
            }
            Action::NextStep => {
                self.release(panel)?;
                let next = self.step.map_or(0, |step| step + 1);
                self.step = (next < self.config.jog.increments.len()).then_some(next);
            }
            Action::Move(axis, side) => self.press_axis(axis, side, panel)?,
        }
        Ok(true)
    }

    fn press_axis(&mut self, axis: Axis, side: f64, panel: &mut Panel) -> Result<(), Failure> {
        let velocity = self.config.jog.velocity.get(axis.index());
        let v = self.part * velocity.copied().unwrap_or(0.0);
        let along = |amount: f64| {
            let mut value = [0.0; AXES];
            if let Some(slot) = value.get_mut(axis.index()) {
                *slot = side * amount;
            }
            value
        };
        let step = self
            .step
            .and_then(|step| self.config.jog.increments.get(step));
        if let Some(step) = step {
            // One after the other: a key that repeats makes no queue.
            let is_over =
                self.sent.elapsed() > PRESS && Panel::precondition(panel.state()?).is_none();
            if is_over {
                let demands = &mut panel.demands;
                let (mode, value) = (JogMode::Incremental, along(*step));
                demands.ask(Monotonic.now_ns(), mode, value, v, self.by_joint)?;
                self.sent = Instant::now();
            }
            return Ok(());
        }
        let until = Instant::now() + PRESS;
        let is_same = self
            .pressed
            .is_some_and(|(pressed, to, _)| pressed == axis && to.total_cmp(&side).is_eq());
        self.pressed = Some((axis, side, until));
        if !is_same {
            let demands = &mut panel.demands;
            let (mode, value) = (JogMode::Continuous, along(v));
            demands.ask(Monotonic.now_ns(), mode, value, 0.0, self.by_joint)?;
            self.sent = Instant::now();
        }
        Ok(())
    }

    /// Says that the key is held down, or lets go where it is not any more.
    fn keep_alive(&mut self, panel: &mut Panel) -> Result<(), Failure> {
        let now = Instant::now();
        match self.pressed {
            Some((_, _, until)) if now >= until => self.release(panel)?,
            Some(_) if now - self.sent >= REPEAT => {
                panel.demands.again()?;
                self.sent = now;
            }
            _ => {}
        }
        Ok(())
    }

    fn release(&mut self, panel: &mut Panel) -> Result<(), Failure> {
        self.pressed = None;
        self.sent = Instant::now();
        Ok(panel.demands.let_go()?)
    }

    fn show(&self, panel: &Panel, state: MachineState) {
        let position = panel.position();
        let position: Vec<String> = position
            .iter()
            .map(|(axis, value)| {
                let is_at_end = is_at_end(self.config, *axis, *value);
                let end = if is_at_end { " (end)" } else { "" };
                format!("{axis} {}{end}", decimals(*value, 3))
            })
            .collect();
        let step = self
            .step
            .and_then(|step| self.config.jog.increments.get(step));
        let step = step.map_or("as long as held".to_owned(), |step| format!("step {step}"));
        let selected = match self.selected {
            Selected::Axis(axis) => format!("(+ - {axis})"),
            Selected::Missing(axis) => format!("(no axis {axis}: + - move nothing)"),
        };
        let part = self.part * 100.0;
        let line = format!(
            "{}  {}  {part:.0} %  {step}  {selected}",
            state.name(),
            position.join("  ")
        );
        // Over the line before, to its end.
        let _ = write!(std::io::stderr(), "\r{line}\x1b[K");
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_axis_that_is_not_there_is_not_another_one() {
        let config = crate::config::load(None).unwrap();
        let mut hand = Hand {
            config: &config,
            by_joint: false,
            part: 0.25,
            step: None,
            selected: Selected::Axis(Axis::X),
            pressed: None,
            sent: Instant::now(),
        };
        assert_eq!(hand.action(Key::Character('+')), Action::Move(Axis::X, 1.0));
        let missing = Selected::Missing(Axis::B);
        assert_eq!(hand.action(Key::Character('B')), Action::Select(missing));
        hand.selected = missing;
        assert_eq!(hand.action(Key::Character('+')), Action::Nothing);
        assert_eq!(hand.action(Key::Character('-')), Action::Nothing);
        let there = Selected::Axis(Axis::Z);
        assert_eq!(hand.action(Key::Character('Z')), Action::Select(there));
    }
}
