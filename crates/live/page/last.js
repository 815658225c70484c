'use strict';
// The last two seconds before a fault: kept as long as the fault stands, whatever the machine does meanwhile.

const LAST_S = 2, BEHIND_S = 0.4, LAST = { at: null, taken: null, whole: false, key: '' };
/* States of setpoints in which a fault ends the motion, and stands. */
const STOPPING = 8, FAULTED = 9;

/* When the fault began, as far as it is known: the index of its first sample. */
function faultBegan(ring) {
  const first = ring.count - ring.length, state = i => ring.state[i & (RING - 1)];
  let i = ring.count;
  while (i > first && state(i - 1) === FAULTED) i--;
  if (i === ring.count) return null;
  while (i > first && state(i - 1) === STOPPING) i--;
  return i;
}
/* A copy of what was before it, and of how the axes came to rest. */
function copyLast(ring, began) {
  const m = RING - 1, at = ring.tick[began & m] * ring.dt, from = Math.max(ring.count - ring.length, ring.at(at - LAST_S)), to = Math.min(ring.count, ring.at(at + BEHIND_S));
  const copy = column => Float64Array.from({ length: to - from }, (_, k) => column[(from + k) & m]);
  return { at, t: copy(ring.tick).map(tick => tick * ring.dt - at), axes: ring.axes.map(axis => ({ p: copy(axis.position), v: copy(axis.ranges[0]), a: copy(axis.ranges[1]), j: copy(axis.ranges[2]) })) };
}
/* With every batch: takes them once they are there, and lets them go behind a reset. */
function keepLast() {
  const stands = S.status && S.status.state === 'faulted';
  if (!stands) { if (S.state !== 'stale' && LAST.taken) { Object.assign(LAST, { taken: null, whole: false, key: '' }); } return; }
  if (LAST.whole || !RINGED || !RINGED.count) return;
  const began = faultBegan(RINGED);
  if (began === null) return;
  LAST.taken = copyLast(RINGED, began);
  LAST.whole = RINGED.now - LAST.taken.at > BEHIND_S;
}
/* What was sampled before the fault itself. */
const hasLast = () => !!LAST.taken && LAST.taken.t.length > 1 && LAST.taken.t[0] < 0;

/* ---- the picture: p, v, a and j one below the other, the axes side by side */
const LAST_PARTS = [['p', '', ''], ['v', '/s', 'velocity'], ['a', '/s²', 'acceleration'], ['j', '/s³', 'jerk']];
/* The axes that moved, or all of them. */
function lastAxes() {
  const moved = AXES().map((_, k) => k).filter(k => { const p = LAST.taken.axes[k].p; return p.some(x => x !== p[0]); });
  return (moved.length ? moved : AXES().map((_, k) => k)).slice(0, 6);
}
function paintLast() {
  const shows = S.view === 'operate' && S.state === 'faulted', has = hasLast();
  $('#app').dataset.last = shows && has ? 1 : 0;
  put($('#lastof'), !shows || !has ? '' : `The last ${num(Math.min(LAST_S, -LAST.taken.t[0]), 1)} s before the fault, and the way to rest`);
  if (shows && has) drawLast();
}
function drawLast() {
  const [c, w, h] = fit($('#last canvas')), key = [w, h, LAST.taken.at, LAST.taken.t.length, T.dark, lengthUnit(), document.fonts.status].join();
  if (!w || key === LAST.key) return;
  LAST.key = key;
  c.clearRect(0, 0, w, h);
  const axes = lastAxes(), gap = 10, wide = (w - gap * (axes.length - 1)) / axes.length, high = h / LAST_PARTS.length;
  axes.forEach((axis, column) => LAST_PARTS.forEach((part, row) => drawLastCell(c, axis, part, { x: column * (wide + gap), y: row * high, wide, high })));
  // Who does not see the picture is told where each axis was.
  $('#last canvas').setAttribute('aria-label', axes.map(k => `${AXES()[k].name}: ${atFault(k, 'p')}, ${atFault(k, 'v')}`).join('; '));
}
/* The value at the fault, with its unit. */
function atFault(k, name) {
  const axis = AXES()[k], { t, axes } = LAST.taken, at = Math.max(0, t.findIndex(x => x >= 0) - 1), value = axes[k][name][at];
  const unit = LAST_PARTS.find(([part]) => part === name)[1];
  return name === 'p' ? `${place(axis, value)} ${unitOf(axis)}` : `${name === 'v' ? num(value, 1) : grouped(value)} ${axis.unit}${unit}`;
}
function drawLastCell(c, k, [name, , kind], { x, y, wide, high }) {
  const axis = AXES()[k], values = LAST.taken.axes[k][name], t = LAST.taken.t, n = 'vaj'.indexOf(name), limit = n >= 0 && axis.has_limit[n] ? axis.limits[n] : 0;
  const label = 15, a = y + label + 2, b = y + high - 3, X = s => x + (s + LAST_S) / (LAST_S + BEHIND_S) * wide;
  let low = Infinity, most = -Infinity;
  for (const value of values) { low = Math.min(low, value); most = Math.max(most, value); }
  if (limit) { most = Math.max(limit, -low, most) * 1.05; low = -most; } else if (most - low < 1e-6) { low -= 1; most += 1; }
  const Y = value => b - (value - low) / (most - low) * (b - a);
  c.fillStyle = T.css.line; c.fillRect(x, limit ? Y(0) : b, wide, 1);
  c.fillStyle = T.css.fault; c.fillRect(X(0) - 0.75, a - 1, 1.5, b - a + 2);
  if (limit) { c.strokeStyle = T.limit[kind]; c.lineWidth = 1; c.setLineDash([5, 4]); c.beginPath(); for (const of of [limit, -limit]) { c.moveTo(x, Y(of)); c.lineTo(x + wide, Y(of)); } c.stroke(); c.setLineDash([]); }
  c.strokeStyle = T.css.ink; c.lineWidth = 1.4; c.beginPath();
  values.forEach((value, i) => { if (i) c.lineTo(X(t[i]), Y(value)); else c.moveTo(X(t[i]), Y(value)); });
  c.stroke();
  c.textBaseline = 'middle'; c.textAlign = 'left'; c.fillStyle = T.css.ink; c.font = 'bold 12px B612';
  const title = `${nameOf(axis.name)} ${name}`;
  c.fillText(title, x, y + label / 2 + 1);
  const room = wide - c.measureText(title).width - 8;
  c.textAlign = 'right'; c.font = '12px B612';
  // Where there is no room for its unit and all of its places, it is told without.
  const whole = atFault(k, name), [number] = whole.split(' '), fits = [whole, number, number.replace(/(\.\d)\d+$/, '$1')].find(text => c.measureText(text).width <= room);
  c.fillText(fits || cutText(c, number, room), x + wide, y + label / 2 + 1);
}
