'use strict';
// Plots against time, one below the other, with one cursor through all. Every pixel column shows the
// least and the largest of what is in it.

/* Where the past and the plan have a quantity: least and largest of each place. */
const UNITS = { v: ['mm/s', '°/s'], a: ['mm/s²', '°/s²'], j: ['mm/s³', '°/s³'] };
const RANGES = { v: 0, a: 1, j: 2 };
const KINDS = { v: 'velocity', a: 'acceleration', j: 'jerk' };

function stripList() {
  const strips = [];
  const feed = Math.max(1, PLAN ? PLAN.mostFeed : 0, ...(RINGED ? [RINGED.mostFeed] : []));
  strips.push({ name: 'feed', unit: 'mm/s', from: 0, to: nice(feed * 1.02, [1, 1.5, 2, 3, 5, 7]), kind: 'feed', digits: 1, programmed: true,
    past: r => [r.feed, r.feed], plan: p => [p.feed.lo, p.feed.hi, 1, 1] });
  AXES().forEach((axis, k) => {
    if (!S.axes[axis.name]) return;
    const rotary = axis.unit === '°' ? 1 : 0;
    let gap = true;
    if (S.parts.p) {
      const [low, high] = extent(k, axis);
      strips.push({ name: `${axis.name} position`, unit: axis.unit, from: low, to: high, travel: axis.travel, kind: 'ink', digits: 3, gap,
        past: r => [r.axes[k].position, r.axes[k].position], plan: p => [p.axes[k].position, p.axes[k].position, 1, 0] });
      gap = false;
    }
    for (const part of ['v', 'a', 'j']) {
      if (!S.parts[part]) continue;
      const n = RANGES[part], scale = axis.limits[n] * 1.25 / 32767, limit = axis.has_limit[n] ? axis.limits[n] : 0;
      const most = limit ? limit * 1.1 : reach(k, n, scale);
      strips.push({ name: `${axis.name} ${KINDS[part]}`, unit: UNITS[part][rotary], from: -most, to: most, limit, signed: true, kind: KINDS[part], digits: part === 'v' ? 1 : 0, gap,
        past: r => [r.axes[k].ranges[n], r.axes[k].ranges[n]], plan: p => [p.axes[k].ranges[n].lo, p.axes[k].ranges[n].hi, scale, n + 1] });
      gap = false;
    }
  });
  if (PLAN) {
    const limit = INFO.report ? INFO.report.tolerance_mm : INFO.machine.tolerance_mm;
    strips.push({ name: 'deviation', note: S.file ? '' : 'in plan', unit: 'µm', from: 0, to: limit * 1150, limit: limit * 1000, kind: 'tolerance', digits: 2, gap: true, band: true, planned: true,
      plan: p => [p.deviation, p.deviation, 1000, 0] });
  }
  if (!S.file && S.status && S.status.power !== 'simulated') {
    const limit = INFO.machine.following_error_mm * 1000;
    strips.push({ name: 'following error', unit: 'µm', from: 0, to: limit * 1.15, limit, kind: 'ink', digits: 1, gap: true, past: r => [r.error, r.error] });
  }
  return strips;
}

/* Least and largest position that a strip shows: they do not jump. */
const extents = [];
function extent(k, axis) {
  let low = Infinity, high = -Infinity;
  if (MOTION && k < 3 && 'XYZ'[k] === axis.name) { low = MOTION.low[k]; high = MOTION.high[k]; } else if (PLAN) for (const x of PLAN.axes[k].position) { if (x < low) low = x; if (x > high) high = x; }
  if (RINGED && RINGED.count) { const x = RINGED.last_position(k); low = Math.min(low, x); high = Math.max(high, x); }
  const kept = extents[k] || (extents[k] = [Infinity, -Infinity]);
  kept[0] = Math.min(kept[0], low); kept[1] = Math.max(kept[1], high);
  if (!(kept[1] > kept[0])) return [kept[0] - 1 || -1, kept[0] + 1 || 1];
  const margin = (kept[1] - kept[0]) * 0.08;
  return [kept[0] - margin, kept[1] + margin];
}

/* Up to what a strip of an axis shows whose joints limit it: what the plan and the machine have had. */
const reaches = [];
function reach(k, n, scale) {
  const kept = reaches[3 * k + n] || (reaches[3 * k + n] = { most: 0, plan: null });
  if (PLAN && kept.plan !== PLAN) {
    const { lo, hi } = PLAN.axes[k].ranges[n];
    for (let i = 0; i < hi.length; i++) kept.most = Math.max(kept.most, hi[i] * scale, -lo[i] * scale);
    kept.plan = PLAN;
  }
  if (RINGED && RINGED.count) kept.most = Math.max(kept.most, Math.abs(RINGED.last_range(k, n)));
  return nice(Math.max(1, kept.most * 1.05), [1, 1.5, 2, 3, 5, 7]);
}

/* The stretch of time that is shown. */
function windowOf() {
  if (S.file) return [S.end - S.span, S.end];
  const now = RINGED ? RINGED.now : 0, ahead = Math.min(2, 0.6 + S.span * 0.04);
  return S.follow ? [now + ahead - S.span, now + ahead] : [S.end - S.span, S.end];
}
function lookAt(t, width) {
  S.follow = false;
  if (width) S.span = width;
  S.end = t + S.span / 2;
  paintTools(); redraw();
}
/* Where the plan is at a time, and a time of a place in it. */
function placeOf(t) {
  if (!PLAN) return null;
  if (S.file) { const p = t / PLAN.dt; return p >= 0 && p < PLAN.samples ? p : null; }
  if (!RINGED || !RINGED.count) return null;
  if (t > RINGED.now) { const p = S.p + (t - RINGED.now) / DT() * (S.rate || 1); return p < PLAN.samples ? p : null; }
  const k = RINGED.at(t);
  return RINGED.p[k & (RING - 1)];
}
function timeOf(p) {
  if (S.file) return p * PLAN.dt;
  if (p > S.p) return RINGED ? RINGED.now + (p - S.p) * DT() / Math.max(0.01, S.rate || 1) : null;
  return RINGED ? RINGED.when(p) : null;
}

let AREA = { left: 0, width: 1, from: 0, to: 1 };

/* The least and largest of every pixel column: of the past, of the plan, NaN where there is nothing. */
function columns(strip, cols, from, to) {
  const low = new Float32Array(cols).fill(NaN), high = new Float32Array(cols).fill(NaN), m = RING - 1;
  const step = (to - from) / cols, ring = S.file ? null : RINGED, now = ring ? ring.now : S.file ? -Infinity : 0;
  if (ring && ring.count && strip.past) {
    const [lo, hi] = strip.past(ring), end = ring.count;
    let k = ring.at(from), before = -1;
    for (let x = 0; x < cols && k < end; x++) {
      const until = (from + (x + 1) * step) / ring.dt;
      let a = Infinity, b = -Infinity;
      while (k < end && ring.tick[k & m] < until) { const l = lo[k & m], h = hi[k & m]; if (l < a) a = l; if (h > b) b = h; before = k; k++; }
      // Between two ticks the last one holds.
      if (a === Infinity && before >= 0 && until - ring.tick[before & m] < 3) { a = lo[before & m]; b = hi[before & m]; }
      if (a !== Infinity) { low[x] = a; high[x] = b; }
    }
  }
  if (PLAN && strip.plan && (S.file || ring)) {
    const [lo, hi, scale, power] = strip.plan(PLAN), rate = S.file ? 1 : S.rate || 1, factor = scale * (power ? rate ** power : 1);
    for (let x = 0; x < cols; x++) {
      const t = from + x * step;
      let p, q, f = factor;
      if (S.file || t > now) { p = placeOf(t); q = placeOf(t + step); } else if (strip.planned) { p = placeOf(t); q = placeOf(t + step); f = scale; }
      if (p === null || p === undefined) continue;
      if (q === null || q === undefined) q = PLAN.samples;
      let i = Math.max(0, Math.floor(p / PLAN.per));
      const end = Math.max(i + 1, Math.min(PLAN.bins, Math.floor(q / PLAN.per)));
      let a = Infinity, b = -Infinity;
      for (; i < end; i++) { if (lo[i] < a) a = lo[i]; if (hi[i] > b) b = hi[i]; }
      if (a !== Infinity) { low[x] = a * f; high[x] = b * f; }
    }
  }
  return [low, high];
}

function strips() {
  const [c, w, h] = fit($('#strips canvas'));
  if (!w) return;
  c.clearRect(0, 0, w, h);
  const list = stripList(), left = w < 760 ? 112 : 132, right = w < 760 ? 84 : 104, width = w - left - right, foot = 24;
  const gaps = list.filter(s => s.gap).length * 7, each = (h - foot - gaps - 4) / list.length, [from, to] = windowOf();
  AREA = { left, width, from, to };
  const X = t => left + (t - from) / (to - from) * width, now = S.file || !RINGED ? null : RINGED.now, bottom = h - foot;
  const step = nice((to - from) * 70 / width);
  c.textBaseline = 'middle'; c.lineWidth = 1; c.strokeStyle = T.css.faint; c.beginPath();
  for (let t = Math.ceil(from / step) * step; t <= to; t += step) { if (t < -1e-9) continue; c.moveTo(Math.round(X(t)) + 0.5, 4); c.lineTo(Math.round(X(t)) + 0.5, bottom); }
  c.stroke();
  const cut = now === null ? width : Math.max(0, Math.min(width, X(now) - left));
  if (now !== null && cut < width) { c.fillStyle = T.css.ink; c.globalAlpha = 0.05; c.fillRect(left + cut, 0, width - cut, bottom); c.globalAlpha = 1; }
  let y = 4;
  for (const strip of list) { if (strip.gap) y += 7; drawStrip(c, strip, { left, width, y, each, cut, from, to, w }); y += each; c.fillStyle = T.css.faint; c.fillRect(0, Math.round(y), w, 1); }
  c.font = '12px B612'; c.fillStyle = T.css.quiet; c.textAlign = 'center';
  for (let t = Math.ceil(from / step) * step; t <= to; t += step) {
    const x = X(t);
    if (t < -1e-9 || x < left + 14 || x > left + width - 14 || (now !== null && (Math.abs(x - X(now)) < 40 || t > now))) continue;
    const shown = S.file ? t : t - now;
    c.fillText(step >= 1 ? (Math.abs(shown) >= 600 ? span(shown) : num(shown, 0)) : num(shown, step < 0.01 ? 3 : step < 0.1 ? 2 : 1), x, h - 11);
  }
  c.textAlign = 'left'; c.fillText('seconds', 12, h - 11);
  if (now !== null && now >= from && now <= to) {
    c.fillStyle = T.css.ink; c.fillRect(Math.round(X(now)) - 0.75, 0, 1.5, bottom + 2);
    c.textAlign = 'center'; c.font = 'bold 12px B612'; c.fillText('now', X(now), h - 11);
    if (left + width - X(now) > 90) { c.font = '12px B612'; c.fillStyle = T.css.quiet; c.textAlign = 'left'; c.fillText('planned', X(now) + 22, h - 11); }
  }
  const t = S.hover === null ? null : timeOf(S.hover);
  if (t !== null && t >= from && t <= to) { c.strokeStyle = T.css.ink; c.setLineDash([3, 3]); c.lineWidth = 1; c.beginPath(); c.moveTo(X(t), 0); c.lineTo(X(t), bottom); c.stroke(); c.setLineDash([]); }
}

function drawStrip(c, strip, { left, width, y, each, cut, from, to, w }) {
  const a = y + 4, b = y + each - 4, Y = v => b - (Math.max(strip.from, Math.min(strip.to, v)) - strip.from) / (strip.to - strip.from) * (b - a);
  const colour = strip.kind === 'ink' ? T.css.quiet : T.limit[strip.kind], cols = Math.max(1, Math.floor(width)), [low, high] = columns(strip, cols, from, to);
  const across = v => { c.moveTo(left, Math.round(Y(v)) + 0.5); c.lineTo(left + width, Math.round(Y(v)) + 0.5); };
  if (strip.band) { c.fillStyle = colour; c.globalAlpha = 0.1; c.fillRect(left, Y(strip.limit), width, Y(0) - Y(strip.limit)); c.globalAlpha = 1; }
  if (strip.from <= 0 && strip.to >= 0) { c.strokeStyle = T.css.line; c.lineWidth = 1; c.beginPath(); across(0); c.stroke(); }
  c.setLineDash([5, 4]); c.strokeStyle = colour; c.lineWidth = 1; c.beginPath();
  if (strip.limit) { across(strip.limit); if (strip.signed) across(-strip.limit); }
  for (const end of strip.travel || []) if (end > strip.from && end < strip.to) across(end);
  c.stroke();
  if (strip.programmed && PLAN) programmed(c, Y, { left, cols, from, to });
  c.setLineDash([]);
  curve(c, low, high, Y, left, 0, Math.round(cut), 0.94);
  curve(c, low, high, Y, left, Math.round(cut), cols, 0.4);
  if (strip.limit && strip.kind !== 'ink') {
    const near = strip.limit * 0.985;
    c.fillStyle = colour;
    for (let x = 0; x < cols; x++) {
      c.globalAlpha = x > cut ? 0.45 : 1;
      if (high[x] > near) c.fillRect(left + x - 0.5, Y(high[x]) - 1.5, 2, 4);
      if (strip.signed && low[x] < -near) c.fillRect(left + x - 0.5, Y(low[x]) - 2.5, 2, 4);
    }
    c.globalAlpha = 1;
  }
  label(c, strip, { a, b, each, w, cols, low, high, from, to });
}

function programmed(c, Y, { left, cols, from, to }) {
  c.strokeStyle = T.limit.feed; c.beginPath();
  let on = false;
  for (let x = 0; x < cols; x++) {
    const p = placeOf(from + (to - from) * x / cols), v = p === null ? 0 : PLAN.programmed[PLAN.bin(p)];
    const shown = v > 0 && v < 1e9;
    if (shown) { on ? c.lineTo(left + x, Y(v)) : c.moveTo(left + x, Y(v)); }
    on = shown;
  }
  c.stroke();
}

function curve(c, low, high, Y, left, from, to, alpha) {
  c.globalAlpha = alpha; c.strokeStyle = T.css.ink; c.lineWidth = 1.3; c.lineJoin = 'round'; c.beginPath();
  let last = null;
  for (let x = Math.max(0, from); x < Math.min(low.length, to); x++) {
    if (Number.isNaN(low[x])) { last = null; continue; }
    const a = Y(low[x]), b = Y(high[x]);
    if (last === null) c.moveTo(left + x, a);
    const [first, second] = last !== null && Math.abs(last - a) > Math.abs(last - b) ? [b, a] : [a, b];
    c.lineTo(left + x, first);
    if (Math.abs(first - second) > 0.3) c.lineTo(left + x, second);
    last = second;
  }
  c.stroke(); c.globalAlpha = 1;
}

/* Left the name and what is allowed, right the value at the cursor. */
function label(c, strip, { a, b, each, w, cols, low, high, from, to }) {
  const m = (a + b) / 2, tall = each > 33, t = S.hover !== null ? timeOf(S.hover) : S.file ? null : RINGED && RINGED.now;
  c.textAlign = 'left'; c.fillStyle = T.css.ink; c.font = '13px B612'; c.fillText(strip.name, 12, tall ? m - 8 : m);
  const allowed = strip.programmed ? 'dashed: program' : strip.limit ? `${strip.signed ? '±' : ''}${grouped(strip.limit)} ${strip.unit}${strip.note ? ' ' + strip.note : ''}` : strip.travel ? `${num(strip.travel[0], 0)} … ${num(strip.travel[1], 0)}` : strip.unit;
  if (tall) { c.fillStyle = T.css.quiet; c.font = '11.5px B612'; c.fillText(allowed, 12, m + 8); }
  if (t === null || t === undefined) return;
  const x = Math.max(0, Math.min(cols - 1, Math.floor((t - from) / (to - from) * cols) - (S.hover === null ? 1 : 0)));
  const value = Math.abs(high[x]) >= Math.abs(low[x]) ? high[x] : low[x];
  if (t < from || t > to || Number.isNaN(value)) return;
  c.textAlign = 'right'; c.fillStyle = T.css.ink; c.font = '13px B612';
  c.fillText(strip.digits ? num(value, strip.digits) : grouped(value), w - 12, tall ? m - 8 : m);
  if (tall) { c.fillStyle = T.css.quiet; c.font = '11.5px B612'; c.fillText(strip.limit ? `${Math.round(Math.abs(value) / strip.limit * 100)} %` : strip.unit, w - 12, m + 8); }
}

/* ---- hands */
function stripHands(onhover) {
  const element = $('#strips'), fingers = new Map();
  let drag = null;
  const time = x => AREA.from + (x - AREA.left) / AREA.width * (AREA.to - AREA.from);
  const zoom = (x, factor) => {
    const f = Math.max(0, Math.min(1, (x - AREA.left) / AREA.width)), t = time(x), most = S.file ? PLAN.seconds * 1.1 : 600;
    S.span = Math.max(0.05, Math.min(most, S.span * factor));
    if (!S.follow || S.file) S.end = t + (1 - f) * S.span;
    paintTools(); redraw();
  };
  element.addEventListener('pointerdown', e => { fingers.set(e.pointerId, e.offsetX); element.setPointerCapture(e.pointerId); drag = [e.clientX, windowOf()[1]]; });
  element.addEventListener('pointermove', e => {
    if (!fingers.has(e.pointerId)) {
      const inside = e.offsetX >= AREA.left && e.offsetX <= AREA.left + AREA.width;
      onhover(inside ? placeOf(time(e.offsetX)) : null);
      return;
    }
    const before = [...fingers.values()];
    fingers.set(e.pointerId, e.offsetX);
    if (fingers.size === 2) { const now = [...fingers.values()], wide = v => Math.abs(v[0] - v[1]) || 1; zoom((now[0] + now[1]) / 2, wide(before) / wide(now)); drag = null; return; }
    if (!drag || Math.abs(e.clientX - drag[0]) < 3) return;
    S.follow = false; S.end = drag[1] - (e.clientX - drag[0]) / AREA.width * S.span;
    paintTools(); redraw();
  });
  const up = e => { fingers.delete(e.pointerId); drag = null; };
  element.addEventListener('pointerup', up); element.addEventListener('pointercancel', up);
  element.addEventListener('pointerleave', () => onhover(null));
  element.addEventListener('wheel', e => { e.preventDefault(); if (PLAN || !S.file) zoom(e.offsetX, Math.exp(e.deltaY * 0.0016)); }, { passive: false });
  element.addEventListener('dblclick', () => { if (S.file) showAll(); else S.follow = true; paintTools(); redraw(); });
}
function showAll() { S.span = PLAN.seconds * 1.02; S.end = PLAN.seconds * 1.01; }
