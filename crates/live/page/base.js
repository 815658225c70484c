'use strict';
// What all parts share: the state of the page, numbers and times as text, icons, colours, canvases.

const $ = (selector, inside = document) => inside.querySelector(selector);
const $$ = (selector, inside = document) => [...inside.querySelectorAll(selector)];
const hash = new URLSearchParams(location.hash.slice(1));

/* The page: `file` if it is one of `plan --plot`. `hover` and `p` are places in the plan, in samples. */
const S = {
  file: !!window.GLIDEPATH_FILE, view: 'operate', state: 'stale', hover: null, p: 0,
  shows: true, follow: true, drags: false, span: 6, end: 0, status: null, heard: 0, refusal: '',
  axes: {}, parts: { p: true, v: true, a: true, j: true }, box: 'slow',
};
/* The machine and its program, as `/api/plan` tells. */
let INFO = { machine: { instance: '', axes: [], period_s: 0.004, tolerance_mm: 0.02 }, program: null, report: null };
const AXES = () => INFO.machine.axes;
const DT = () => INFO.machine.period_s;

/* ---- numbers */
const num = (x, digits) => { const text = Math.abs(x).toFixed(digits); return (x < 0 && +text !== 0 ? '−' : '') + text; };
const grouped = x => (x < -0.5 ? '−' : '') + String(Math.round(Math.abs(x))).replace(/\B(?=(\d{3})+$)/g, ' ');
/* A number as people write it, with a point or a comma; null if it is none. */
const numberOf = text => /^[+−-]?(\d+([.,]\d*)?|[.,]\d+)$/.test(text.trim()) ? +text.trim().replace('−', '-').replace(',', '.') : null;
const two = x => String(x).padStart(2, '0');
const clock = (ms, fine) => { const d = new Date(ms); return `${two(d.getHours())}:${two(d.getMinutes())}:${two(d.getSeconds())}` + (fine ? `.${String(d.getMilliseconds()).padStart(3, '0')}` : ''); };
const span = s => {
  s = Math.max(0, s);
  if (s >= 600) return `${Math.floor(s / 3600)}:${two(Math.floor(s / 60) % 60)}:${two(Math.floor(s % 60))}`;
  const t = Math.floor(s * 10 + 1e-6);
  return `${Math.floor(t / 600)}:${two(Math.floor(t / 10) % 60)}.${t % 10}`;
};
const micro = us => us >= 1000 ? `${(us / 1000).toFixed(1)} ms` : `${us.toFixed(us < 10 ? 1 : 0)} µs`;
const safe = text => String(text).replace(/[&<>"]/g, c => ({ '&': '&amp;', '<': '&lt;', '>': '&gt;', '"': '&quot;' })[c]);
const stem = path => String(path).split('/').pop();

/* Sets what changed only, so that nothing is laid out anew for nothing. */
function put(element, text) { if (element.textContent !== text) element.textContent = text; }
function fill(element, html) {
  if (element.kept === html) return;
  element.kept = html;
  const typed = typedIn(element);
  if (!fillAroundPressed(element, html)) element.innerHTML = html;
  for (const field of typed) keepTyped(element, field);
}
/* What somebody has typed stays where a field is written anew, unless it has another value then. */
const typedIn = element => [...element.querySelectorAll('input[id]')].filter(field => field.value !== field.defaultValue || field === document.activeElement)
  .map(field => ({ id: field.id, value: field.value, before: field.defaultValue, has: field === document.activeElement }));
function keepTyped(element, { id, value, before, has }) {
  const field = element.querySelector(`#${CSS.escape(id)}`);
  if (!field || field.defaultValue !== before) return;
  if (field.value !== value) field.value = value;
  if (has && field !== document.activeElement) field.focus({ preventScroll: true });
}

/* ---- icons, 24 × 24 */
const ICONS = {
  running: 'M6 3v18l15-9z', hold: 'M4 3h6v18H4zM14 3h6v18h-6z',
  await: 'M12 1.5a4 4 0 1 1 0 8 4 4 0 0 1 0-8zM3.5 22.5v-3a8.5 8.5 0 0 1 17 0v3z',
  fault: 'M7.4 1h9.2L23 7.4v9.2L16.6 23H7.4L1 16.6V7.4zM10.4 5l.5 9h2.2l.5-9zM10.5 16v3h3v-3z',
  idle: 'M3 3h18v18H3zM6 6v12h12V6z', ok: 'M9.5 20.5 1.8 12.8l2.7-2.7 5 5L19.5 4.4l2.7 2.7z',
  stale: 'M12 1a11 11 0 0 1 0 22A11 11 0 0 1 12 1zm0 3a8 8 0 1 0 0 16 8 8 0 0 0 0-16zM10.6 6.5h2.8v5.2l3.7 3.7-2 2-4.5-4.6z',
  step: 'M4 3v18l11-9zM17 3h4v18h-4z', abort: 'M3 3h18v18H3z',
  warn: 'M12 1.5 23.5 22H.5zM10.7 8.5l.4 7h1.8l.4-7zM10.7 17v2.6h2.6V17z',
  lock: 'M6 10V7a6 6 0 0 1 12 0v3h2v12H4V10zm3 0h6V7a3 3 0 0 0-6 0z',
  minus: 'M3 10.4h18v3.2H3z', plus: 'M10.4 3h3.2v7.4H21v3.2h-7.4V21h-3.2v-7.4H3v-3.2h7.4z',
  theme: 'M12 1a11 11 0 0 1 0 22zm0 0a11 11 0 0 0 0 22V20a8 8 0 0 1 0-16z', dot: 'M12 8a4 4 0 1 1 0 8 4 4 0 0 1 0-8z',
  back: 'M18 3v18L3 12z', home: 'M12 2 23 12h-3v9h-6v-6h-4v6H4v-9H1z', power: 'M10.4 1h3.2v11h-3.2zM7 4.2l1.6 2.7a7 7 0 1 0 6.8 0L17 4.2a10.2 10.2 0 1 1-10 0z',
  plot: 'M2 2h3v17h17v3H2zM7 16l4-8 4 4 4-9 2.7 1.2L16 17l-4-4-2.3 4.6z',
};
ICONS.bad = ICONS.fault;
const icon = (name, kind = '') => `<svg class="i ${kind}" viewBox="0 0 24 24" aria-hidden="true"><path fill-rule="evenodd" d="${ICONS[name]}"/></svg>`;

/* ---- what keeps the motion back, by the numbers of the columns */
const LIMITS = ['rest', 'feed', 'velocity', 'acceleration', 'jerk', 'tolerance', 'chord error', 'none'];
const LIMIT_WORDS = { rest: 'at rest', feed: 'as programmed', velocity: 'velocity', acceleration: 'acceleration', jerk: 'jerk', tolerance: 'tolerance', 'chord error': 'chord error', none: 'no single limit', rapid: 'rapid' };
const LIMIT_COLOURS = { rest: '--b-none', feed: '--b-feed', velocity: '--b-vel', acceleration: '--b-acc', jerk: '--b-jerk', tolerance: '--b-tol', 'chord error': '--b-chord', none: '--b-none', rapid: '--rapid' };
const limitOf = code => LIMITS[code & 7];
const limitText = code => {
  if (code & 128) return 'rapid';
  const kind = code & 7, axis = [...'XYZABCUVW', 'J0', 'J1', 'J2', 'J3', 'J4', 'J5', 'of a joint'][code >> 3 & 15];
  return kind >= 2 && kind <= 4 ? `${LIMITS[kind]} ${axis}` : LIMIT_WORDS[LIMITS[kind]];
};

/* ---- colours */
let T = { css: {}, limit: {} };
function theme(name) {
  document.documentElement.dataset.theme = name;
  try { localStorage.setItem('glidepath-theme', name); } catch { /* a file may have no storage */ }
  const style = getComputedStyle(document.documentElement), colour = key => style.getPropertyValue(key).trim();
  T = { css: {}, limit: {}, dark: name === 'dark' };
  for (const key of ['bg', 'panel', 'ink', 'quiet', 'line', 'faint', 'run', 'hold', 'wait', 'fault', 'on-wait', 'b-feed', 'b-vel', 'b-acc', 'b-jerk', 'b-tol', 'b-none', 'rapid']) T.css[key] = colour('--' + key);
  for (const kind in LIMIT_COLOURS) T.limit[kind] = colour(LIMIT_COLOURS[kind]);
}
const SHADES = { light: [[26, 18, 110], [93, 1, 166], [156, 23, 158], [204, 71, 120], [224, 104, 64], [222, 140, 10]], dark: [[112, 104, 226], [156, 92, 214], [206, 96, 178], [240, 116, 124], [250, 164, 84], [252, 218, 110]] };
function shade(part) {
  const steps = SHADES[T.dark ? 'dark' : 'light'], x = Math.max(0, Math.min(0.9999, part)) * 5, i = Math.floor(x), f = x - i;
  return `rgb(${steps[i].map((a, k) => Math.round(a + (steps[i + 1][k] - a) * f))})`;
}

/* ---- canvases */
function fit(canvas) {
  const w = canvas.clientWidth, h = canvas.clientHeight, scale = Math.min(2, devicePixelRatio || 1);
  if (canvas.width !== Math.round(w * scale) || canvas.height !== Math.round(h * scale)) { canvas.width = Math.round(w * scale); canvas.height = Math.round(h * scale); }
  const c = canvas.getContext('2d');
  c.setTransform(scale, 0, 0, scale, 0, 0);
  return [c, w, h];
}
const dirty = { path: true, strips: true, ribbon: true, health: true, tune: true };
const redraw = () => { for (const part in dirty) dirty[part] = true; };
const nice = (least, steps = [1, 2, 5]) => { const p = 10 ** Math.floor(Math.log10(least)); return (steps.find(s => s * p >= least) || 10) * p; };
