'use strict';
// The spindle: its digits, what the operator makes of its speed, and the keys of Set up.

/* A program has the spindle at 100 %, whatever the operator sets (M49). */
const isLocked = () => !!S.status && !!S.status.spindle && S.status.spindle.is_override_locked;
const COOLANTS = { mist: 'M7', flood: 'M8', 'mist and flood': 'M7 M8' };
/* The spindle: how fast it turns, where somebody measures it, else how fast it is told to; what it is to have, in the words of programs; its load, and coolant. */
function spindleDigits() {
  const s = S.status, told = s.spindle, isMeasured = typeof s.spindle_rpm === 'number', locked = isLocked(), tile = $('[data-ov=spindle-override]');
  const code = told && { clockwise: 'M3', counterclockwise: 'M4', oriented: 'M19' }[told.turns], turns = code && code !== 'M19', isSilent = drivesAreSilent();
  // Drives that say nothing any more leave nobody who knows whether it turns.
  const speed = isMeasured ? Math.abs(s.spindle_rpm) : !told || isSilent ? null : turns ? told.speed : 0;
  const load = typeof s.spindle_load === 'number' ? `load ${Math.round(s.spindle_load * 100)} %` : '';
  const wanted = !told ? 'not known here' : isSilent ? `told: ${code || 'off'}` : !code ? 'off' : !turns ? code : isMeasured ? `of ${grouped(told.speed)}, ${code}` : `told, ${code}`;
  put($('#spin'), speed === null ? '–' : grouped(speed)); put($('#g-spin'), $('#spin').textContent);
  put($('#spinof'), [wanted, [load, told ? COOLANTS[told.coolant] : ''].filter(Boolean).join(', ')].filter(Boolean).join('\n'));
  put($('#g-spinof'), !told ? '' : [`at ${Math.round(told.override * 100)} %`, load].filter(Boolean).join('\n'));
  put($('.by', tile), locked ? 'by M49' : '');
  if (tile.classList.toggle('locked', locked) !== !!tile.was) { tile.was = locked; paintOverrides(); }
}

/* ---- by hand. The speed is the one of a program: the override is put to it. */
const overrideWords = () => {
  const s = S.status;
  if (!s || !s.spindle || s.spindle.override === 1) return '';
  return `<p class="lab-text">It turns at ${Math.round(s.spindle.override * 100)} % of that: the spindle override.</p>`;
};
function spindleKeys() {
  const why = whyNoLine(), told = S.status && S.status.spindle;
  return `<div class="spindle"><label class="field"><span class="lab">Speed, rev/min</span><input id="speed" inputmode="numeric" value="${told && told.programmed ? +told.programmed.toFixed(3) : 1000}"></label>${overrideWords()}<div class="row">${key('spindle-cw', 'Clockwise', { press: SHORT, why, sub: 'M3: press ½ s' })}${key('spindle-ccw', 'Counterclockwise', { press: SHORT, why, sub: 'M4: press ½ s' })}${key('line', 'Stop', { why, sub: 'M5', data: 'data-line="M5"' })}</div><div class="row">${key('line', 'Mist', { press: SHORT, why, sub: 'M7: press ½ s', data: 'data-line="M7"' })}${key('line', 'Flood', { press: SHORT, why, sub: 'M8: press ½ s', data: 'data-line="M8"' })}${key('line', 'Coolant off', { why, sub: 'M9', data: 'data-line="M9"' })}</div></div>`;
}
const turn = code => { const speed = numberOf($('#speed').value); if (speed > 0) own(`S${speed} ${code}`, [`S${speed} ${code}`]); else $('#speed').focus(); };
DEEDS['spindle-cw'] = () => turn('M3');
DEEDS['spindle-ccw'] = () => turn('M4');
