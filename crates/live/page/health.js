'use strict';
// Is it well: ticks, motion ahead, drives, receivers, grants, and what happened.

function histogram() {
  const [c, w, h] = fit($('#c-hist')), s = S.status;
  if (!w || !s) return;
  c.clearRect(0, 0, w, h);
  const { from_us: low, per_decade: per, counts } = s.lateness_histogram, period = s.period_us, q = s.lateness_us;
  const left = 68, bottom = 40, top = 40, x0 = Math.log10(low), x1 = Math.log10(Math.max(period * 2.2, 10 * low));
  const most = Math.max(1, ...counts), X = us => left + Math.max(0, Math.min(1, (Math.log10(Math.max(us, low)) - x0) / (x1 - x0))) * (w - left - 14);
  const decades = Math.ceil(Math.log10(most) + 0.05), Y = n => h - bottom - (n <= 0 ? 0 : (Math.log10(n) + 0.35) / (decades + 0.35)) * (h - bottom - top);
  c.font = '12px B612'; c.textBaseline = 'middle'; c.lineWidth = 1;
  // Where the decades are nearer to each other than their numbers are high, every second one is told, or every third.
  const every = Math.ceil(14 / Math.max(1, Y(1) - Y(10)));
  for (let n = 1, k = 0; n <= 10 ** decades; n *= 10, k++) { const y = Math.round(Y(n)) + 0.5; c.strokeStyle = T.css.faint; c.beginPath(); c.moveTo(left, y); c.lineTo(w - 14, y); c.stroke(); if (k % every) continue; c.fillStyle = T.css.quiet; c.textAlign = 'right'; c.fillText(grouped(n), left - 8, y); }
  c.fillStyle = T.css.faint; c.fillRect(X(period), top, w - 14 - X(period), h - bottom - top);
  counts.forEach((n, k) => {
    if (!n) return;
    const a = X(low * 10 ** (k / per)), b = X(low * 10 ** ((k + 1) / per)), late = low * 10 ** (k / per) >= period;
    c.fillStyle = late ? T.css.fault : T.css.ink; c.globalAlpha = late ? 1 : 0.82; c.fillRect(a + 0.5, Y(n), Math.max(2, b - a - 1), h - bottom - Y(n));
  });
  c.globalAlpha = 1; c.fillStyle = T.css.line; c.fillRect(left, h - bottom, w - left - 14, 1);
  c.fillStyle = T.css.quiet; c.textAlign = 'center';
  for (let us = 10 ** Math.ceil(x0 - 1e-9); us < 10 ** x1; us *= 10) c.fillText(us >= 1000 ? `${us / 1000} ms` : `${us >= 1 ? us : us.toFixed(1)} µs`, Math.max(left + 14, X(us)), h - bottom + 12);
  c.fillStyle = T.css.ink; c.fillRect(X(period) - 1, top - 20, 2, h - bottom - top + 20);
  let right = -99;
  for (const [name, us] of [['half', q.p50], ['99 %', q.p99], ['99.9 %', q.p999]]) {
    const x = X(us);
    c.strokeStyle = T.css.ink; c.setLineDash([2, 3]); c.beginPath(); c.moveTo(x, top - 20); c.lineTo(x, h - bottom); c.stroke(); c.setLineDash([]);
    const wide = c.measureText(name).width, at = Math.max(x, right + wide / 2 + 8);
    c.fillStyle = T.css.ink; c.textAlign = 'center'; c.fillText(name, at, top - 28); right = at + wide / 2;
  }
  // Not struck through by a line.
  const limit = `period ${micro(period).replace('.0', '')}`, wide = c.measureText(limit).width;
  c.fillStyle = T.css.panel; c.fillRect(X(period) - 9 - wide, top - 18, wide + 4, 16);
  c.fillStyle = T.css.ink; c.textAlign = 'right'; c.fillText(limit, X(period) - 7, top - 10);
  c.fillStyle = T.css.quiet; c.textAlign = 'left'; c.fillText('how late a tick began; both axes logarithmic', left, h - 10);
}

/* The last 20 s of something. */
function series(id, of, most, limit, text, words) {
  const [c, w, h] = fit($(id));
  if (!w) return;
  c.clearRect(0, 0, w, h);
  c.font = '12px B612';
  // Where the words have no place between the ends of the axis, they have a line of their own.
  const left = 60, right = 14, n = w - left - right, row = c.measureText(words).width > n - 110 ? 16 : 0, bottom = 20 + row, top = 10;
  const Y = v => h - bottom - Math.min(1, v / most) * (h - bottom - top), ring = RINGED, m = RING - 1;
  c.textBaseline = 'middle'; c.textAlign = 'right'; c.fillStyle = T.css.quiet;
  // A limit that is far above all that was measured is told in words.
  const isNear = limit <= most;
  for (const v of [0, isNear ? limit : most]) c.fillText(text(v), left - 8, Y(v));
  c.fillStyle = T.css.line; c.fillRect(left, Y(0), n, 1);
  if (isNear) { c.strokeStyle = T.css.quiet; c.setLineDash([5, 4]); c.beginPath(); c.moveTo(left, Math.round(Y(limit)) + 0.5); c.lineTo(w - right, Math.round(Y(limit)) + 0.5); c.stroke(); c.setLineDash([]); }
  if (ring && ring.count) {
    const now = ring.now, first = ring.at(now - 20);
    c.strokeStyle = T.css.ink; c.lineWidth = 1.3; c.beginPath();
    for (let k = first; k < ring.count; k += 4) { const x = left + n - (now - ring.tick[k & m] * ring.dt) / 20 * n, y = Y(of(ring, k & m)); k === first ? c.moveTo(x, y) : c.lineTo(x, y); }
    c.stroke(); c.lineWidth = 1;
  }
  c.fillStyle = T.css.quiet; c.textAlign = 'left'; c.fillText('20 s ago', left, h - 8 - row); c.textAlign = 'right'; c.fillText('now', w - right, h - 8 - row); c.textAlign = 'center'; c.fillText(words, left + n / 2, h - 8);
}

/* The largest value of the last 20 s. */
function peakOf(of) {
  const ring = RINGED, m = RING - 1;
  let peak = 0;
  if (ring && ring.count) for (let k = ring.at(ring.now - 20); k < ring.count; k++) peak = Math.max(peak, of(ring, k & m));
  return peak;
}
function health() {
  if (!S.status || !S.status.lateness_histogram) return;
  histogram();
  const horizon = INFO.machine.horizon_s || 0.6, trip = INFO.machine.following_error_mm * 1000 || 50;
  series('#c-buf', (r, i) => r.ahead[i], horizon * 1.2, horizon, v => v ? `${v} s` : '0', 'motion ahead of the machine; dashed: horizon');
  const following = v => v >= 1000 ? `${v / 1000} mm` : v ? `${+v.toPrecision(3)} µm` : '0', scale = nice(Math.max(1, peakOf((r, i) => r.error[i]) * 1.1));
  if (S.status.power !== 'simulated') series('#c-fol', (r, i) => r.error[i], scale > 0.5 * trip ? trip * 1.12 : scale, trip, following, `distance of drives from setpoint; the machine stops at ${following(trip)}`);
  else { const [c, w, h] = fit($('#c-fol')); c.clearRect(0, 0, w, h); }
  healthWords();
}

/* Drives that are to say where they are have not, for half a second, so that nobody knows. */
const drivesAreSilent = () => { const s = S.status; return s.power !== 'simulated' && (s.feedback_age_ms === null || s.feedback_age_ms > 500); };
function healthWords() {
  const s = S.status, say = (kind, text) => `${icon(kind, kind)}<span>${text}</span>`;
  fill($('#a-tick'), s.missed_ticks ? say('warn', `No: ${grouped(s.missed_ticks)} of ${grouped(s.ticks)} missed. At ${INFO.machine.max_missed_ticks} within a second the machine stops.`)
    : say('ok', `Yes, all ${grouped(s.ticks)}. 99.9 % began within ${micro(s.lateness_us.p999)}, the latest after ${micro(s.lateness_us.max)}.`));
  const ahead = s.queue_depth * s.period_us / 1e6, moving = s.state === 'running';
  fill($('#a-buf'), s.state === 'starved' || s.state === 'starving' ? say('bad', 'No. The planner is too slow, or sends nothing.')
    : moving ? say('ok', `Yes, ${num(ahead, 2)} s.${s.starved_ticks ? ` It had to wait for ${grouped(s.starved_ticks)} ticks so far.` : ''}`) : say('dot', `No motion is under way; ${num(ahead, 2)} s lie ready.`));
  const peak = Math.max(0, ...Object.values(s.following_error || {}).map(v => Math.abs(v || 0))) * 1000;
  fill($('#a-fol'), s.power === 'simulated' ? say('dot', 'Nobody says: no feedback is configured.') : drivesAreSilent() ? say('bad', `Not known: the drives have said nothing${s.feedback_age_ms === null ? ' yet' : ` for ${num(s.feedback_age_ms / 1000, 1)} s`}.`) : say('ok', `Within ${num(peak, 1)} µm just now.`));
  const list = s.receivers || [];
  fill($('#a-sub'), list.length > 1 ? say('ok', `${list.length} programs, this page among them.`) : say('warn', 'Only this page: no servo stack is connected.'));
  fill($('#subs'), '<tr><th>program</th><th>process</th><th class="l">what it does</th></tr>' + list.map(r => `<tr><td>${safe(r.name)}</td><td class="n">${r.pid}</td><td class="l">${safe(r.role)}</td></tr>`).join(''));
  const lost = RINGED && RINGED.lost ? `; this page lost ${grouped(RINGED.lost)}` : '';
  const grants = Object.entries(s.realtime).filter(([key]) => key !== 'best_effort'), missing = grants.filter(([, on]) => !on);
  const names = { fifo: 'SCHED_FIFO', pinned: 'a CPU of its own', memory_locked: 'memory locked', prefaulted: 'stack touched', cpu_awake: 'CPUs kept awake' };
  fill($('#a-grant'), missing.length ? say('warn', `Not everything${s.realtime.best_effort ? ': it runs as well as it can' : ''}.`) : say('ok', 'Everything it asked for.'));
  fill($('#grants'), grants.map(([key, on]) => `<span>${icon(on ? 'ok' : 'minus', on ? 'ok' : '')} ${names[key] || key}</span>`).join('') + `<span>${grouped(s.setpoints_lost)} setpoints lost inside${lost}</span>`);
  eventLog();
}

function eventLog() {
  const list = S.status ? S.status.log || [] : [], kinds = { state: 'running', warn: 'warn', bad: 'fault', info: 'dot' };
  fill($('#log'), list.map(e => `<div class="${e.kind === 'bad' ? 'hot' : ''}"><span class="n">${clock(e.at_ms, true)}</span><span>${icon(kinds[e.kind] || 'dot', e.kind === 'bad' ? 'bad' : e.kind === 'warn' ? 'warn' : '')}</span><span>${safe(told(e.text))}${e.since_ms ? `, since ${clock(e.since_ms)}` : ''}</span></div>`).join(''));
  fill($('#g-log'), list.slice(0, 5).map(e => `<div><span class="n lab">${clock(e.at_ms).slice(0, 5)}</span><span>${safe(told(e.text))}</span></div>`).join(''));
}
