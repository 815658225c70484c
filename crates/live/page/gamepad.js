'use strict';
// Moving axes by the sticks of a gamepad, while a button at its shoulder is pressed; and hold, at once. Nothing else is
// ordered by it.
//
// A browser tells of a pad without power, or out of reach, only after seconds, and tells its last sticks until then. A
// stick in a hand is never quite still: one that tells nothing new for a second is taken for a pad that is gone.

const READ = 25, SILENT = 1000, MIDDLE = 0.25;
const HOLDS = 1, SHOULDERS = [4, 5];
const PAD = { timer: 0, stamp: 0, changed: 0, armed: false, holds: false };
const pads = () => [...(navigator.getGamepads ? navigator.getGamepads() : [])].filter(pad => pad && pad.connected);
const knownPad = () => pads().find(pad => pad.mapping === 'standard');

/* How far a stick is out of its middle, −1 to 1, finer near to it. */
function deflection(value) {
  const out = Math.max(0, Math.abs(value) - MIDDLE) / (1 - MIDDLE);
  return Math.sign(value) * out * out;
}
/* How each axis is to go, −1 to 1. Up on the stick is where the arrow key goes. */
function wantedOf(pad) {
  const [across, down, , lift] = pad.axes.map(deflection);
  const all = isLathe() ? { Z: across, X: -down } : { X: across, Y: -down, Z: -lift };
  return Object.fromEntries(Object.entries(all).filter(([name, part]) => part && AXES().some(axis => axis.name === name)));
}
function readPad() {
  const pad = knownPad(), now = performance.now(), mine = JOG.gesture && JOG.gesture.pad;
  if (!pad) { if (mine) endJog(); return; }
  if (pad.timestamp !== PAD.stamp) { PAD.stamp = pad.timestamp; PAD.changed = now; }
  const isDown = button => Boolean(pad.buttons[button] && pad.buttons[button].pressed);
  if (isDown(HOLDS) && !PAD.holds) { endJog(); DEEDS.hold(BAR.hold); }
  PAD.holds = isDown(HOLDS);
  const wanted = wantedOf(pad), names = Object.keys(wanted);
  const may = SHOULDERS.some(isDown) && !PAD.holds && S.view === 'setup' && document.hasFocus() && now - PAD.changed < SILENT;
  if (!names.length || !may) {
    if (mine) endJog();
    // Whatever ended a motion, a stick goes through its middle before it begins another.
    PAD.armed = !names.length;
    return;
  }
  if (mine) { JOG.gesture.axes = velocitiesOf(wanted); return; }
  if (!PAD.armed) return;
  PAD.armed = false;
  if (JOG.step) {
    const most = names.reduce((a, b) => Math.abs(wanted[b]) > Math.abs(wanted[a]) ? b : a);
    beginJog({ [most]: Math.sign(wanted[most]) }, null);
  } else if (!JOG.gesture && !whyNoJog()) beginGesture(velocitiesOf(wanted), { pad: true });
}
const velocitiesOf = wanted => Object.fromEntries(Object.entries(wanted).map(([name, part]) => [name, part * jogVelocity(name)]));
/* What the pad does, where one is. */
function padWords() {
  if (knownPad()) return `Gamepad: a shoulder button pressed, ${isLathe() ? 'the left stick moves X and Z' : 'the left stick moves X and Y, the right one Z'}; B or ○ holds.`;
  return pads().length ? 'This gamepad is not used: the browser does not know its buttons.' : '';
}
function lookForPads() {
  if (pads().length && !PAD.timer) PAD.timer = setInterval(readPad, READ);
  if (!pads().length) { clearInterval(PAD.timer); PAD.timer = 0; if (JOG.gesture && JOG.gesture.pad) endJog(); }
  paintPad();
}
for (const event of ['gamepadconnected', 'gamepaddisconnected']) addEventListener(event, lookForPads);
