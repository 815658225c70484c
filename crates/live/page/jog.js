'use strict';
// Moving axes by hand: as long as a finger is down. Every 50 ms the server is told that it still is; whatever
// dies in between, the axes come to rest.

const SIGN = 50, STALL = 150;
// How near to the end of its travel an axis is at it, mm or degrees.
const END_MM = 0.01;
const JOG = { gesture: null, step: 0, part: 0.2, timer: 0, mine: null };
const jogVelocity = name => (SETUP.jog && SETUP.jog.velocity[name] || 0) * JOG.part;
const canJog = () => ['idle', 'held', 'program-stop', 'jogging', 'not-homed'].includes(S.state);
function whyNoJog() { return notOperating() || (canJog() ? '' : 'not now'); }

/* `ways` is how each axis goes: −1 or 1. */
function beginJog(ways, button) {
  if (JOG.gesture || whyNoJog()) return;
  const names = Object.keys(ways), slower = Math.sqrt(names.length);
  if (JOG.step) {
    const axes = {};
    // A step is what it is of the numbers that are shown: of the diameter, where that is.
    for (const name of names) axes[name] = ways[name] * JOG.step * scaleOf(axisOf(name));
    takeStep(axes, Math.max(1, Math.min(...names.map(jogVelocity))), `${names.map(name => `${nameOf(name)}${ways[name] < 0 ? '−' : '+'}`).join(' ')} ${JOG.step}`);
    return;
  }
  const axes = {};
  for (const name of names) axes[name] = ways[name] * jogVelocity(name) / slower;
  beginGesture(axes, { button });
  if (button) button.classList.add('down');
}
/* `axes` is how fast each axis goes; `by` is what says that the finger is still there. */
function beginGesture(axes, by) {
  JOG.gesture = { id: Math.floor(Math.random() * 2 ** 48), number: 0, axes, told: performance.now(), under_way: 0, ...by };
  tellJog();
  JOG.timer = setInterval(tellJog, SIGN);
}
/* A step is known by the number that it is given: what the machine does may be another client's doing. */
async function takeStep(axes, feed, label) {
  const mine = JOG.mine = { number: 0, label, state: 'asked', text: '' }, said = await order('jog-step', { axes, feed });
  if (said.accepted) mine.number = said.number; else { mine.state = 'not'; mine.text = buttonWords(said.reason); }
  if (JOG.mine === mine) paintStep();
}
/* How the last step from here stands, by its own result. */
function paintStep() {
  const mine = JOG.mine, told = mine && S.status && (S.status.page_steps || []).find(step => step.number === mine.number);
  if (told && mine.state !== told.state) {
    mine.state = told.state; mine.text = buttonWords(told.text);
    if (told.state === 'not') refuse(`${mine.label}: ${mine.text}`);
  }
  const words = mine && { asked: 'is asked for', 'under-way': 'under way', done: 'done', not: `not done, or not to its end: ${mine.text}` }[mine.state];
  const dead = SETUP.jog ? SETUP.jog.dead_man_ms : 150, v = AXES().length ? jogVelocity(AXES()[0].name) : 0;
  const slip = `Contact lost: the axes begin to stop within ${lengthText(v / 60 * dead / 1000, 1)} ${lengthUnit()}.`;
  put($('#jogslip'), atEnd() || (JOG.step ? mine ? `${mine.label}: ${words}.` : 'One step for each press.' : slip));
}
/* The axes that a finger wants to move on beyond the end of their travel. */
function atEnd() {
  if (!JOG.gesture) return '';
  const machine = machineNow(), ended = AXES().filter((a, k) => a.travel && JOG.gesture.axes[a.name] && Math.abs(machine[k] - a.travel[JOG.gesture.axes[a.name] < 0 ? 0 : 1]) < END_MM);
  return ended.length ? `${ended.map(a => nameOf(a.name)).join(' ')} ${ended.length > 1 ? 'are' : 'is'} at the end of ${ended.length > 1 ? 'their' : 'its'} travel.` : '';
}
async function tellJog() {
  const gesture = JOG.gesture;
  if (!gesture) return;
  const now = performance.now();
  // A page that did not run for a while does not know whether the finger is still down.
  // Neither does a finger that is down move anything behind a fault, or where nobody sees what moves.
  if (now - gesture.told > STALL || whyNoJog()) { endJog(); return; }
  gesture.told = now;
  // A browser has six connections to a server: hold needs one.
  if (gesture.under_way > 1) return;
  gesture.under_way++;
  const said = await order('jog', { gesture: gesture.id, number: ++gesture.number, at_ms: now, axes: gesture.axes }, true);
  gesture.under_way--;
  if (!said.accepted && JOG.gesture === gesture) { endJog(); refuse(buttonWords(said.reason)); }
}
function endJog() {
  const gesture = JOG.gesture;
  if (!gesture) return;
  JOG.gesture = null;
  clearInterval(JOG.timer);
  if (gesture.button) gesture.button.classList.remove('down');
  order('jog-end', { gesture: gesture.id }, true);
}
for (const end of ['pointerup', 'pointercancel', 'blur', 'pagehide']) addEventListener(end, endJog);
document.addEventListener('visibilitychange', endJog);
addEventListener('lostpointercapture', e => { if (JOG.gesture && e.target === JOG.gesture.button) endJog(); });
addEventListener('pointerdown', e => {
  const button = e.target.closest('.jog');
  if (!button || e.button || button.getAttribute('aria-disabled') === 'true') return;
  e.preventDefault();
  // Also when the finger leaves the button.
  try { button.setPointerCapture(e.pointerId); } catch { /* a pointer that is gone */ }
  beginJog(JSON.parse(button.dataset.ways), button);
});
const LATHE_ARROWS = { ArrowLeft: { Z: -1 }, ArrowRight: { Z: 1 }, ArrowDown: { X: -1 }, ArrowUp: { X: 1 } };
const ARROWS = { ArrowLeft: { X: -1 }, ArrowRight: { X: 1 }, ArrowDown: { Y: -1 }, ArrowUp: { Y: 1 }, PageDown: { Z: -1 }, PageUp: { Z: 1 } };
addEventListener('keydown', e => {
  const ways = (isLathe() ? LATHE_ARROWS : ARROWS)[e.key];
  if (!ways || S.view !== 'setup' || e.ctrlKey || e.altKey || e.metaKey || e.target.closest('input,select,[role=tab],[role=radio]') || !AXES().some(a => a.name in ways)) return;
  e.preventDefault();
  if (!e.repeat) { beginJog(ways, null); if (JOG.gesture) JOG.gesture.key = e.key; }
});
addEventListener('keyup', e => { if (JOG.gesture && JOG.gesture.key === e.key) endJog(); });

/* ---- the pad */
const ways = of => safe(JSON.stringify(of));
const jogKey = (of, sign, label, place = '', name = label) => `<button class="jog ${place}" data-ways="${ways(of)}" aria-label="move ${name}"><b>${sign}</b><span>${label}</span></button>`;
function layPad() {
  const names = AXES().map(a => a.name), has = name => names.includes(name);
  let html = '';
  if (has('X') && has('Y')) {
    const d = (x, y, sign) => jogKey({ X: x, Y: y }, sign, '', 'diagonal', `X${x < 0 ? '−' : '+'} Y${y < 0 ? '−' : '+'}`);
    html += `<div class="cross">${d(-1, 1, '◤')}${jogKey({ Y: 1 }, '▲', 'Y+')}${d(1, 1, '◥')}${jogKey({ X: -1 }, '◀', 'X−')}<span class="hint">press and keep pressed</span>${jogKey({ X: 1 }, '▶', 'X+')}${d(-1, -1, '◣')}${jogKey({ Y: -1 }, '▼', 'Y−')}${d(1, -1, '◢')}</div>`;
  }
  // As the path is drawn: Z along, X across.
  if (isLathe()) html += `<div class="cross"><i></i>${jogKey({ X: 1 }, '▲', 'X+')}<i></i>${jogKey({ Z: -1 }, '◀', 'Z−')}<span class="hint">press and keep pressed</span>${jogKey({ Z: 1 }, '▶', 'Z+')}<i></i>${jogKey({ X: -1 }, '▼', 'X−')}<i></i></div>`;
  const inCross = has('X') && has('Y') ? 'XY' : isLathe() ? 'XZ' : '', rest = names.filter(name => !inCross.includes(name));
  html += `<div class="columns">${rest.map(name => `<div>${jogKey({ [name]: 1 }, '▲', `${name}+`)}${jogKey({ [name]: -1 }, '▼', `${name}−`)}</div>`).join('')}</div>`;
  html += `<div class="speed"><label><span class="lab">Jog speed</span><b id="jogpart"></b><input type="range" id="jogspeed" min="1" max="100" aria-label="jog speed, percent"></label><span id="jogmm"></span><p id="jogslip" class="lab-text" role="status"></p><p id="padwords" class="lab-text"></p></div>`;
  html += '<div class="steps" id="steps" role="radiogroup" aria-label="how far"></div>';
  fill($('#pad'), html);
  const slider = $('#jogspeed');
  slider.value = JOG.part * 100;
  slider.oninput = () => { endJog(); JOG.part = slider.value / 100; paintPad(); };
  paintPad();
}
const steps = () => stepsOf(SETUP.jog ? SETUP.jog.increments : []);
function paintPad() {
  if (!$('#steps')) return;
  fill($('#steps'), [0, ...steps()].map(step => `<button role="radio" aria-checked="${JOG.step === step}" data-step="${step}">${step || 'while pressed'}</button>`).join(''));
  $$('#steps button').forEach(b => { b.onclick = () => { JOG.step = +b.dataset.step; paintPad(); }; });
  const v = AXES().length ? jogVelocity(AXES()[0].name) : 0;
  put($('#jogpart'), `${Math.round(JOG.part * 100)} %`); put($('#jogmm'), `${feedText(v)} ${feedUnit()}`);
  paintStep();
  put($('#padwords'), padWords());
  const why = whyNoJog();
  $$('.jog').forEach(b => { if (why) b.setAttribute('aria-disabled', 'true'); else b.removeAttribute('aria-disabled'); });
}
