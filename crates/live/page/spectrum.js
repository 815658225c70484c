'use strict';
// How smooth the motion is: what frequencies the acceleration of each axis has, in the stretch of time that
// is shown. A machine rings at those it has a resonance at, so what stands above some 30 Hz is heard and seen.

const RINGS_AT = 30;

/* The Fourier transform of as many numbers as a power of two, in place. */
function transform(re, im) {
  const n = re.length;
  for (let i = 1, j = 0; i < n; i++) {
    let bit = n >> 1;
    for (; j & bit; bit >>= 1) j ^= bit;
    j ^= bit;
    if (i < j) { [re[i], re[j]] = [re[j], re[i]]; [im[i], im[j]] = [im[j], im[i]]; }
  }
  for (let half = 1; half < n; half *= 2) {
    for (let k = 0; k < half; k++) {
      const c = Math.cos(Math.PI * k / half), s = -Math.sin(Math.PI * k / half);
      for (let i = k; i < n; i += 2 * half) {
        const j = i + half, x = re[j] * c - im[j] * s, y = re[j] * s + im[j] * c;
        re[j] = re[i] - x; im[j] = im[i] - y; re[i] += x; im[i] += y;
      }
    }
  }
}

/* Power per Hz of frequencies from 0 to half the rate, after Welch: the mean over segments that overlap by half,
   each with its mean taken away and under Hann's window. Null if there is too little. */
function power(value, count, dt) {
  let n = 512;
  while (n > count) n /= 2;
  if (n < 64) return null;
  const window = Float64Array.from({ length: n }, (_, i) => 0.5 - 0.5 * Math.cos(2 * Math.PI * i / n));
  const sum = window.reduce((all, w) => all + w * w, 0), out = new Float64Array(n / 2 + 1);
  let segments = 0;
  for (let first = 0; first + n <= count; first += n / 2, segments++) {
    const re = Float64Array.from({ length: n }, (_, i) => value(first + i)), im = new Float64Array(n);
    const mean = re.reduce((all, x) => all + x, 0) / n;
    for (let i = 0; i < n; i++) re[i] = (re[i] - mean) * window[i];
    transform(re, im);
    for (let i = 0; i <= n / 2; i++) out[i] += (i % (n / 2) ? 2 : 1) * (re[i] ** 2 + im[i] ** 2) * dt / sum;
  }
  return out.map(x => x / segments);
}

/* The accelerations that are shown: how many, and the one of an axis at a place. */
function shownAccelerations() {
  const [from, to] = windowOf();
  if (!S.file) {
    if (!RINGED || !RINGED.count) return null;
    const first = RINGED.at(from), m = RING - 1;
    return { count: Math.max(0, RINGED.at(to) - first), of: axis => i => RINGED.axes[axis].ranges[1][(first + i) & m] };
  }
  if (PLAN.per !== 1) return null;
  const first = Math.max(0, Math.floor(from / PLAN.dt)), end = Math.min(PLAN.bins, Math.ceil(to / PLAN.dt));
  const of = axis => { const scale = AXES()[axis].limits[1] * 1.25 / 32767; return i => PLAN.axes[axis].ranges[1].hi[first + i] * scale; };
  return { count: Math.max(0, end - first), of };
}

const DASHES = [[], [7, 4], [2, 3], [7, 3, 2, 3]];

function spectrum() {
  const [c, w, h] = fit($('#specbox canvas')), shown = shownAccelerations(), dt = DT();
  if (!w) return;
  c.clearRect(0, 0, w, h);
  const axes = AXES().map((axis, k) => ({ axis, k })).filter(({ axis }) => S.axes[axis.name]);
  const curves = shown ? axes.map(({ axis, k }) => ({ axis, k, of: power(shown.of(k), shown.count, dt) })) : [];
  if (!curves.length || !curves[0].of) {
    fill($('#specof'), S.file && PLAN.per !== 1 ? 'A motion as long as this is not kept period by period.' : shown ? 'A quarter of a second at least has to be shown.' : 'Nothing has been received yet.');
    return;
  }
  const n = curves[0].of.length - 1, step = 0.5 / dt / n, left = 52, right = 12, top = 8, bottom = 34;
  const most = Math.max(1, ...curves.map(({ of }) => Math.sqrt(Math.max(...of.slice(1))))), high = Math.ceil(Math.log10(most) + 0.05), low = high - 5;
  const X = f => left + f / (n * step) * (w - left - right), Y = v => h - bottom - Math.max(0, (Math.log10(Math.max(v, 1e-9)) - low) / (high - low)) * (h - bottom - top);
  c.font = '11.5px B612'; c.textBaseline = 'middle'; c.lineWidth = 1;
  c.fillStyle = T.css.faint; c.fillRect(X(RINGS_AT), top, w - right - X(RINGS_AT), h - bottom - top);
  for (let e = low; e <= high; e++) { const y = Math.round(Y(10 ** e)) + 0.5; c.strokeStyle = T.css.line; c.beginPath(); c.moveTo(left, y); c.lineTo(w - right, y); c.stroke(); c.fillStyle = T.css.quiet; c.textAlign = 'right'; c.fillText(e < 0 ? (10 ** e).toFixed(-e) : grouped(10 ** e), left - 7, y); }
  c.fillStyle = T.css.quiet; c.textAlign = 'center';
  for (const f of [10, 30, 60, 90, 120].filter(f => f < n * step)) c.fillText(String(f), X(f), h - bottom + 10);
  c.textAlign = 'left'; c.fillText('Hz; acceleration, mm/s² per √Hz (° of rotary axes)', left, h - 7);
  c.strokeStyle = T.css.ink; c.lineWidth = 1.3;
  for (const { k, of } of curves) {
    c.setLineDash(DASHES[k % DASHES.length]); c.beginPath();
    for (let i = 1; i <= n; i++) i === 1 ? c.moveTo(X(i * step), Y(Math.sqrt(of[i]))) : c.lineTo(X(i * step), Y(Math.sqrt(of[i])));
    c.stroke();
  }
  c.setLineDash([]);
  const above = of => Math.sqrt(of.reduce((all, x, i) => all + (i * step >= RINGS_AT ? x * step : 0), 0));
  const dash = k => `<svg width="26" height="8"><path d="M0 4H26" fill="none" stroke="currentColor" stroke-width="1.5" stroke-dasharray="${DASHES[k % DASHES.length].join(' ')}"/></svg>`;
  fill($('#specof'), curves.map(({ axis, k, of }) => `<span>${dash(k)} ${axis.name} <b class="n">${num(above(of), 1)}</b></span>`).join('') + `<span>${AXES().some(a => a.unit === '°') ? 'mm/s² or °/s²' : 'mm/s²'} rms above ${RINGS_AT} Hz</span>`);
}
