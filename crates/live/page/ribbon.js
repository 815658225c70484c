'use strict';
// The whole program by time, always at the same place: speed, what binds, how far it is.

const RIBBON = { key: '', columns: [], left: 18, width: 1 };

/* The highest speed and the kind of limit of every pixel column. */
function ribbonColumns(width) {
  const key = `${width} ${PLAN.samples} ${PLAN.bins}`;
  if (RIBBON.key === key) return RIBBON.columns;
  RIBBON.key = key; RIBBON.columns = [];
  for (let x = 0; x < width; x++) {
    const a = Math.floor(x / width * PLAN.bins), b = Math.max(a + 1, Math.floor((x + 1) / width * PLAN.bins));
    const counts = new Map();
    let most = 0, best = 0, kind = 'none';
    for (let i = a; i < b && i < PLAN.bins; i++) {
      if (PLAN.feed.hi[i] > most) most = PLAN.feed.hi[i];
      const of = PLAN.code[i] & 128 ? 'rapid' : limitOf(PLAN.code[i]), n = (counts.get(of) || 0) + 1;
      counts.set(of, n);
      if (n > best) { best = n; kind = of; }
    }
    RIBBON.columns.push([most, kind]);
  }
  return RIBBON.columns;
}

function ribbon() {
  const [c, w, h] = fit($('#ribbon canvas'));
  if (!w) return;
  c.clearRect(0, 0, w, h);
  const hasNames = h >= LOW && courseNow().sections.length > 0, em = S.view === 'operate' ? Math.max(13, h / (hasNames ? 106 : 88) * 15) : 13, strip = stripHigh(em, h);
  c.textBaseline = 'middle'; c.font = `${em}px B612`;
  if (!PLAN) { c.fillStyle = T.css.quiet; c.textAlign = 'left'; wrapped(c, emptyRibbon(), 18, h / 2, w - 36, em * 1.35); return; }
  const left = 18, width = w - 36, top = 14 + strip, bottom = h - em - 13, tall = bottom - top, X = p => left + p / Math.max(1, PLAN.samples - 1) * width;
  RIBBON.left = left; RIBBON.width = width;
  const isDone = S.status && S.status.end_of_epoch === 'completed', p = S.file ? -1 : isDone ? PLAN.samples - 1 : S.p, list = ribbonColumns(Math.floor(width));
  list.forEach(([most, kind], x) => {
    const high = Math.max(1, Math.sqrt(most / PLAN.mostFeed) * tall);
    // To come: an outline over pale ground. Rapids have gaps.
    const isDone = S.file || x / width * PLAN.samples <= p, isGap = kind === 'rapid' && x % 6 < 2;
    c.fillStyle = T.limit[kind];
    if (isDone) { if (!isGap) c.fillRect(left + x, bottom - high, 1, high); return; }
    c.globalAlpha = 0.22; c.fillRect(left + x, bottom - high, 1, high); c.globalAlpha = 1;
    if (!isGap) c.fillRect(left + x, bottom - high, 1, Math.min(2, high));
  });
  c.globalAlpha = 1; c.fillStyle = T.css.line; c.fillRect(left, bottom, width, 1);
  drawSections(c, X, { em, end: left + width, p, strip, bottom }); drawMoments(c, X, { em, top, bottom });
  let says = '';
  if (!S.file) {
    if (S.may === 'operate') says = drawShuttle(c, X, { top, bottom, p });
    const x = X(p);
    c.fillStyle = T.css.ink; c.fillRect(left, bottom, x - left, 3); c.fillRect(x - 1, top - 5, 2, bottom - top + 8);
    c.beginPath(); c.moveTo(x, top + 1); c.lineTo(x - 7, top - 9); c.lineTo(x + 7, top - 9); c.fill();
  }
  if (S.view === 'tune') {
    const [from, to] = windowOf(), a = placeOf(Math.max(0, from)), b = placeOf(to);
    const x0 = X(a === null ? 0 : a), x1 = X(b === null ? PLAN.samples - 1 : b);
    c.strokeStyle = T.css.ink; c.lineWidth = 1.5; c.strokeRect(x0, top - 6, Math.max(3, x1 - x0), bottom - top + 11);
    c.fillStyle = T.css.ink;
    for (const place of INFO.report ? INFO.report.slowest : []) { const x = X((place.start_s + place.duration_s / 2) / PLAN.dt); c.beginPath(); c.moveTo(x, bottom + 4); c.lineTo(x - 4, bottom + 10); c.lineTo(x + 4, bottom + 10); c.fill(); }
  }
  if (S.hover !== null) { c.setLineDash([3, 3]); c.strokeStyle = T.css.ink; c.lineWidth = 1; c.beginPath(); c.moveTo(X(S.hover), top - 8); c.lineTo(X(S.hover), bottom + 4); c.stroke(); c.setLineDash([]); }
  const y = h - em * 0.5 - 3, name = INFO.program ? stem(INFO.program.name) : '', way = PLAN.way[PLAN.bins - 1];
  c.textAlign = 'left'; c.fillStyle = T.css.ink; c.font = `bold ${em}px B612`; c.fillText(name, left, y);
  const wide = c.measureText(name).width;
  c.font = `${em}px B612`; c.fillStyle = T.css.quiet;
  const whole = `${span(PLAN.seconds)} at 100 %`, section = S.file ? undefined : sectionAt(p), room = width - wide - c.measureText(whole).width - em;
  const part = S.file ? wayText(way) : `${Math.floor(p / Math.max(1, PLAN.samples - 1) * 100)} % of the time, ${wayText(PLAN.way[PLAN.bin(p)], way)}${section ? `, ${sectionWords(section)}` : ''}`;
  if (says) c.fillText(`   ${says}`, left + wide, y);
  else if (S.view !== 'glance') c.fillText(cutText(c, `   ${part}`, room), left + wide, y);
  c.textAlign = 'right'; c.fillText(whole, w - left, y);
}
/* Writes a text about a height, in as many lines as it takes. */
function wrapped(c, text, x, y, width, line) {
  const lines = [''];
  for (const part of text.split(' ')) {
    const last = lines[lines.length - 1], longer = last ? `${last} ${part}` : part;
    if (last && c.measureText(longer).width > width) lines.push(part); else lines[lines.length - 1] = longer;
  }
  lines.forEach((text, k) => c.fillText(text, x, y + (k - (lines.length - 1) / 2) * line));
}
/* Why there is no plan to be seen. */
function emptyRibbon() {
  const s = S.status, runs = programName();
  if (s && !S.shows) {
    if (!s.active_program) return `${runs ? sentence(runs) : 'A stream'} runs. It is no file, so there is neither its text nor its path.`;
    if (INFO.failed) return `${runs} runs. Its path cannot be shown: ${INFO.failed}`;
    return `${runs} runs. Its text is read, or has been changed since it began: no other is shown in its place.`;
  }
  if (!INFO.program) return 'No program has run yet. The one that runs will be shown here, whoever begins it.';
  if (INFO.failed) return `${stem(INFO.program.name)} cannot be planned here: ${INFO.failed}`;
  if (INFO.report) return `${stem(INFO.program.name)} is planned; its path is on its way to this page.`;
  return `${stem(INFO.program.name)} is being planned: ${span(s ? s.planned_so_far_s || 0 : 0)} of motion so far. The machine does not wait for this.`;
}
function ribbonHands(onhover) {
  const element = $('#ribbon'), place = e => { const f = (e.offsetX - RIBBON.left) / RIBBON.width; return PLAN && f >= 0 && f <= 1 ? f * (PLAN.samples - 1) : null; };
  element.addEventListener('pointermove', e => { element.title = titleOf(place(e)); });
  element.addEventListener('pointermove', e => { if (S.view !== 'operate') onhover(place(e)); });
  element.addEventListener('pointerleave', () => onhover(null));
  element.addEventListener('pointerdown', e => { const p = place(e); if (p === null || S.view !== 'tune') return; const t = timeOf(p); if (t !== null) lookAt(t); showWhy(p); });
}
