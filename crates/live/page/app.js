'use strict';
// The page as a whole: views, digits, commands, what comes from the server, and the loop that draws.

const SPACE = new Path3D();
let TOKEN = '';

/* ---- the server */
async function api(path, kind) {
  try {
    const answer = await fetch(path, { headers: { 'X-Glidepath-Token': TOKEN, 'X-Glidepath-Page': PAGE } });
    if (!answer.ok) { if (answer.status === 403) S.refused = true; return null; }
    return kind === 'json' ? await answer.json() : await answer.arrayBuffer();
  } catch { return null; }
}
/* What came of a program. It is used as long as the machine executes that program, or none. */
let version = -1, fetching = false, COME = { plan: null, motion: null, program: null };
async function fetchPlan() {
  if (fetching) return;
  fetching = true;
  try { await takePlan(); S.unpainted.plan = ''; } catch (error) { failed('plan', error); }
  fetching = false;
}
async function takePlan() {
  const info = await api('/api/plan', 'json');
  if (!info) return;
  const of = `?of=${info.generation}`, get = async (is, path) => is ? api(path + of) : null;
  // One behind the other: a browser has six connections to a server, and hold needs one.
  const program = await get(info.program_path, '/api/program.bin'), columns = await get(info.report, '/api/columns.bin'), path = await get(info.report, '/api/path.bin');
  const whole = columns && path, isAll = !program === !info.program_path && !whole === !info.report;
  // What did not come is asked for again.
  version = isAll ? info.version : -1;
  COME = { plan: whole ? new Plan(columns) : null, motion: whole ? new Track(path) : null, program: program ? new Track(program) : null };
  if (info.generation !== INFO.generation) { LINES.forget(); forgetWhy(); }
  setInfo(info); usePlan();
  if (!isAll) await new Promise(done => setTimeout(done, 300));
}
function usePlan() {
  // Before a program runs, the one that was chosen is looked at.
  const from = S.view === 'programs' ? LOOK : S.shows ? COME : {};
  PLAN = from.plan || null; MOTION = from.motion || null; PROGRAM = from.program || null;
  RIBBON.key = ''; SPACE.stale = true; S.hover = null;
  $('#app').dataset.sections = courseNow().sections.length ? 1 : 0;
  paintLegend(); paintTune(); redraw();
}
/* Messages: four bytes of length, one of kind, payload. */
async function listen() {
  let held = new Uint8Array(0);
  for (;;) {
    // The server tells every second that nothing happens: one that is silent for longer is asked anew.
    const way = new AbortController(), lost = () => setTimeout(() => way.abort(), 5000);
    let late = lost();
    try {
      const answer = await fetch('/api/stream', { headers: { 'X-Glidepath-Token': TOKEN }, signal: way.signal });
      S.refused = answer.status === 403; judgeRefused();
      if (!answer.ok) throw new Error('refused');
      const reader = answer.body.getReader();
      held = new Uint8Array(0);
      for (;;) {
        const { done, value } = await reader.read();
        clearTimeout(late); late = lost();
        if (done) break;
        const bytes = new Uint8Array(held.length + value.length);
        bytes.set(held); bytes.set(value, held.length);
        let at = 0;
        while (bytes.length - at >= 5) {
          const length = new DataView(bytes.buffer, at).getUint32(0, true);
          if (bytes.length - at < 4 + length) break;
          const kind = bytes[at + 4], payload = bytes.slice(at + 5, at + 4 + length).buffer;
          paintPart(kind === 1 ? 'status' : 'setpoints', () => heard(kind, payload));
          at += 4 + length;
        }
        held = bytes.slice(at);
      }
    } catch { /* told by the age of what is shown */ }
    clearTimeout(late);
    await new Promise(done => setTimeout(done, isDevice() && S.refused ? 3000 : 500));
  }
}
S.ahead = -Infinity; S.came = 0; S.boot = '';
function heard(kind, payload) {
  if (kind === 1) {
    const status = JSON.parse(new TextDecoder().decode(payload)), now = performance.now(), ahead = (status.updated_ns ? status.updated_ns / 1e6 : status.clock_ms) - now;
    // What was kept back on its way, or is told again, is as old as it is: by the clock of the host, which goes ahead of that
    // of the page by what it did for the quickest status. The clocks drift apart by less than 1 ms a second.
    S.ahead = Math.max(ahead, S.ahead - (now - S.came) * 1e-3); S.came = now;
    S.status = status; S.heard = now - (S.ahead - ahead); S.clock_ms = status.clock_ms;
    S.state = isOld() ? 'stale' : status.state; S.rate = status.effective_override || 1;
    // Another life of the interpolator counts its setpoints anew.
    if (RINGED && status.boot && status.boot !== S.boot) { S.boot = status.boot; RINGED.reset(); }
    S.p = status.place === null ? 0 : status.place;
    // Nothing of another program is shown while one runs.
    const shows = status.end_of_epoch !== 'open' || (status.program_is_shown && status.generation === INFO.generation);
    if (shows !== S.shows) { S.shows = shows; usePlan(); }
    if (status.version !== version) fetchPlan();
    if (S.may === 'operate' && status.set_up !== undefined) { fetchSetUp(status.set_up); loadNext(); judgeShuttle(); }
    const seen = [S.state, status.mode, status.end_of_epoch, S.rate].join();
    if (seen !== FRAMES.seen) { FRAMES.seen = seen; dirty.path = dirty.ribbon = true; }
    keepLast();
    // A browser lets the timers of a page that nobody sees come late, by up to a minute.
    if (document.hidden) callPerson();
  } else if (kind === 2 && RINGED && S.status) {
    const errors = Object.values(S.status.following_error || {}).map(v => Math.abs(v || 0));
    RINGED.take(payload, S.p, Math.max(0, ...errors) * 1000, (S.status.queue_depth || 0) * DT());
    S.arrived = performance.now();
    keepLast();
    dirty.strips = dirty.health = dirty.tune = true;
    if (isMoving()) dirty.path = dirty.ribbon = true;
  }
}
/* Something moves, or its tail on the path still does. */
const isMoving = () => !!RINGED && !RINGED.rests(TAIL_S + 0.5);

/* ---- layout */
function setInfo(info) {
  const same = JSON.stringify(info.machine.axes) === JSON.stringify(INFO.machine.axes);
  INFO = info;
  document.title = info.machine.instance ? `${info.machine.instance} · Glidepath` : `${stem(info.program ? info.program.name : '')} · Glidepath`;
  if (same) return;
  S.axes = {};
  info.machine.axes.forEach((axis, k) => { S.axes[axis.name] = k < 3; });
  if (!S.file) RINGED = new Ring(info.machine.axes.length, info.machine.period_s);
  overView.hidden = isLathe();
  layDigits(); paintTools();
  if (!S.file) laySetUp();
  paintUnits();
}
/* The key that changes the unit; a page that is a file has mm. */
const unitKey = () => S.file ? '' : '<button class="unit-key" data-do="unit"></button>';
const axisName = axis => isDiameter(axis.name) ? `${axis.name}<i class="dia">Ø</i>` : axis.name;
function paintUnits() {
  $$('[data-unit=feed]').forEach(e => put(e, feedUnit()));
  $$('[data-do=unit]').forEach(b => { put(b, lengthUnit()); b.title = UNIT.inch ? 'show lengths in mm' : 'show lengths in inches'; b.setAttribute('aria-label', `lengths are in ${UNIT.inch ? 'inches' : 'mm'}: ${b.title}`); });
}
const SHOWN_ON_PHONES = 6;
function layDigits() {
  const axes = AXES();
  $('#app').dataset.axes = axes.length > 6 ? 'many' : axes.length > 4 ? 'some' : axes.length > 3 ? 'four' : 'few';
  fill($('#dro'), `<div class="top"><b id="system"></b><span><span id="dro-of"></span>${unitKey()}</span><span id="dro-machine"></span></div>` + axes.map(a => `<div class="ax"><b>${axisName(a)}</b><div class="w n" id="w${a.name}"></div><div class="m"><div class="n" id="m${a.name}"></div><div class="travel" title="between the ends of its travel"><i id="t${a.name}"></i></div></div></div>`).join(''));
  // A telephone has room for six, in rows of two or three.
  const shown = axes.slice(0, SHOWN_ON_PHONES), columns = [2, 4].includes(shown.length) ? 2 : Math.min(3, shown.length);
  $('#g-axes').className = `g-row live of-${columns}${shown.length > 3 ? ' more-axes' : ''}`;
  fill($('#g-axes'), shown.map(a => `<div><span class="lab">${nameOf(a.name)}</span><span class="n" id="g${a.name}"></span></div>`).join('') + '<div></div>'.repeat((columns - shown.length % columns) % columns));
}
function setView(view) {
  // Who operates sees all of the path, whatever somebody looked at before.
  if (view === 'operate' && S.view !== view) { SPACE.view('iso'); S.hover = null; }
  const other = S.view !== view;
  S.view = view; $('#app').dataset.view = view;
  if (!S.file && other) { endJog(); usePlan(); if (view === 'programs') { fetchPrograms(); lookAtChosen(); } if (view === 'setup') paintTables(); }
  markTab();
  const box = $(`#${view} [data-path]`);
  if (box) box.append(SPACE.box, overMode, overView, legend);
  paintLegend(); paintTools(); paintTune(); paintState(); redraw();
  if (!S.file) { paintSetUp(); paintPrograms(); }
}
const made = (name, html) => { const e = document.createElement('div'); e.className = name; e.innerHTML = html; return e; };
const overMode = made('over chips at-left', '<button data-m="limit">limit</button><button data-m="feed">feed</button><button data-prog>program</button>');
const overView = made('over chips at-right', '<button data-c="iso">3D</button><button data-c="top">top</button><button data-c="front">front</button>');
const legend = made('legend', '');

function paintLegend() {
  $$('[data-m]', overMode).forEach(b => b.setAttribute('aria-pressed', b.dataset.m === SPACE.mode));
  $('[data-prog]', overMode).setAttribute('aria-pressed', SPACE.showProgram);
  const item = (name, text) => `<span><i class="k-${name}"></i>${text}</span>`;
  if (!MOTION) { fill(legend, PROGRAM ? '<span>as programmed; not planned yet</span>' : ''); return; }
  if (SPACE.mode === 'limit') {
    const seen = new Set(MOTION.code.map(code => code & 128 ? 255 : code & 7));
    fill(legend, LIMITS.filter((kind, k) => kind !== 'rest' && seen.has(k)).map(kind => item(kind.replace(' ', '-'), LIMIT_WORDS[kind])).join('') + (seen.has(255) ? item('dashed', 'rapid') : ''));
  } else {
    fill(legend, `<span>0 <canvas class="scale" width="90" height="8"></canvas> ${feedText(MOTION.most * 60)} ${feedUnit()}</span>${item('dashed', 'rapid')}`);
    const c = $('canvas', legend).getContext('2d');
    for (let x = 0; x < 90; x++) { c.fillStyle = shade(x / 90); c.fillRect(x, 0, 1, 8); }
  }
}
function paintTools() {
  const chip = (data, on, text) => `<button ${data} aria-pressed="${on}">${text}</button>`;
  const spans = S.file ? [] : [[1, '1 s'], [6, '6 s'], [30, '30 s'], [300, '5 min']];
  fill($('#tools'), `<div class="chips">${AXES().map(a => chip(`data-a="${a.name}"`, !!S.axes[a.name], a.name)).join('')}</div><div class="chips">${['p', 'v', 'a', 'j'].map(k => chip(`data-k="${k}" title="${{ p: 'position', ...KINDS }[k]}"`, S.parts[k], k)).join('')}</div>`
    + `<span>${S.file ? 'Wheel or pinch: closer. Drag: along. Hover: the place and its line.' : S.follow ? 'Following. Drag or wheel to look closer.' : 'Looking back. The machine goes on.'}</span><div class="chips">`
    + spans.map(([s, text]) => chip(`data-w="${s}"`, Math.abs(S.span - s) < 0.01, text)).join('') + (S.file ? chip('data-all', false, 'all') : chip('data-f', S.follow, S.follow ? 'live' : 'back to live')) + '</div>');
}
$('#tools').addEventListener('click', e => {
  const b = e.target.closest('button');
  if (!b) return;
  const d = b.dataset;
  if (d.a) S.axes[d.a] = !S.axes[d.a];
  if (d.k) S.parts[d.k] = !S.parts[d.k];
  if (d.w) { const [from, to] = windowOf(), mid = (from + to) / 2; S.span = +d.w; if (!S.follow) S.end = mid + S.span / 2; }
  if ('f' in d) { S.follow = !S.follow; if (!S.follow) S.end = windowOf()[1]; }
  if ('all' in d) showAll();
  paintTools(); redraw();
});

/* ---- what held the motion back, and where */
function paintTune() {
  const report = INFO.report;
  $('#tune').dataset.why = report && WHY.place && PLAN && S.box !== 'spec' ? 1 : 0;
  if (!report) { fill($('#bindbox'), ''); fill($('#slowbox'), `<div class="h"><b>No plan yet</b><button data-box="spec">frequencies</button></div><p class="lab-text">${safe(emptyRibbon())}</p>`); return; }
  const sum = kind => Object.entries(report.binding).filter(([name]) => name.startsWith(kind)).reduce((all, [, part]) => all + part, 0);
  const parts = LIMITS.filter(kind => kind !== 'rest' && kind !== 'none').concat(['none', 'rest']).map(kind => [kind, sum(kind)]).filter(([kind, part]) => part > 0 || kind === 'feed');
  fill($('#bindbox'), `<div class="h"><b>What held the motion back</b><span>% of the time</span></div><div class="stack">${parts.map(([kind]) => `<i class="k-${kind.replace(' ', '-')}"></i>`).join('')}</div><div class="keys">${parts.map(([kind, part]) => `<div><i class="k-${kind.replace(' ', '-')}"></i>${LIMIT_WORDS[kind]}<span class="n">${(part * 100).toFixed(1)}</span></div>`).join('')}</div>`);
  $$('#bindbox .stack i').forEach((element, k) => { element.style.flex = `${parts[k][1]} 0 2px`; });
  if (WHY.place && PLAN) { fill($('#slowbox'), whyBox()); return; }
  const rows = innerHeight < 820 ? 4 : 6;
  fill($('#slowbox'), `<div class="h"><b>Where most time is lost</b><button data-box="spec">frequencies</button></div><table class="slow"><tr><th>line</th><th>lost, s</th><th>slowest, mm/s</th><th>of</th><th>limit</th></tr>${report.slowest.slice(0, rows).map((place, n) => `<tr tabindex="0" data-n="${n}"><td class="n">${place.line}</td><td class="n">${num(place.lost_s, 3)}</td><td class="n">${num(place.speed_mm_s, 1)}</td><td class="n">${num(place.feed_mm_s, 0)}</td><td><i class="dot k-${/^(velocity|acceleration|jerk)/.test(place.limit) ? place.limit.split(' ')[0] : place.limit.replace(' ', '-')}"></i>${safe(place.limit)}</td></tr>`).join('')}</table>`);
}
$('#tune .l').addEventListener('click', e => {
  const b = e.target.closest('[data-box]');
  if (!b) return;
  if (b.dataset.box === 'plan-again') { planAgain(); return; }
  WHY.place = null;
  S.box = $('#tune').dataset.box = b.dataset.box; paintTune(); SPACE.stale = true; redraw();
});
const placeOfRow = row => { const place = INFO.report.slowest[row.dataset.n]; return { p: (place.start_s + place.duration_s / 2) / DT(), width: Math.max(0.4, place.duration_s * 6) }; };
$('#slowbox').addEventListener('click', e => {
  const row = e.target.closest('tr[data-n]');
  if (!row || !PLAN) return;
  const { p, width } = placeOfRow(row), t = timeOf(p);
  if (t !== null) lookAt(t, width);
  hover(p); SPACE.lookAt(p); showWhy(p);
});
$('#slowbox').addEventListener('pointerover', e => { const row = e.target.closest('tr[data-n]'); if (row && PLAN) hover(placeOfRow(row).p); });
$('#slowbox').addEventListener('pointerleave', () => hover(null));

function hover(p) {
  const at = p === null || !PLAN ? null : Math.max(0, Math.min(PLAN.samples - 1, Math.round(p)));
  if (at === S.hover) return;
  S.hover = at;
  dirty.path = dirty.strips = dirty.ribbon = true;
}

/* ---- digits */
/* A position of the machine, from part zero: of the tip of the tool in force, as programs have it. */
function work(position) {
  const offset = S.status && S.status.offset;
  if (!offset) return position;
  // What the rotary axes make of it, the page leaves to who knows the machine.
  if (offset.turns_with_rotary_axes) return AXES().map(axis => S.status.work_position[axis.name]);
  const out = position.map((x, k) => x - (offset.origin[AXES()[k].name] || 0) - (offset.tool_length[AXES()[k].name] || 0)), turn = offset.rotation_deg * Math.PI / 180;
  if (turn && out.length > 1) [out[0], out[1]] = [out[0] * Math.cos(turn) + out[1] * Math.sin(turn), out[1] * Math.cos(turn) - out[0] * Math.sin(turn)];
  // What G92 or G52 has shifted.
  return out.map((x, k) => x - (offset.shift[AXES()[k].name] || 0));
}
/* The coordinate system in force, and that it is shifted. */
const systemOf = s => !s.offset ? '' : Object.values(s.offset.shift).some(by => Math.abs(by) > 5e-5) ? `${s.offset.system} + G92` : s.offset.system;
function digits() {
  const s = S.status;
  if (S.file) { put($('#left'), span(PLAN ? PLAN.seconds : 0)); return; }
  if (!s || S.state === 'none' || !s.position) { put($('#left'), '–:––.–'); put($('#ends'), ''); paintWhy(); return; }
  const ring = RINGED, fresh = ring && ring.count, axes = AXES(), speed = Math.abs(fresh ? ring.feed[(ring.count - 1) & (RING - 1)] : s.feed_mm_s);
  const machine = axes.map((a, k) => fresh ? ring.last_position(k) : s.position[a.name]), shown = work(machine), moving = speed > 1e-6 && S.state !== 'stale';
  $('#app').classList.toggle('moving', moving);
  put($('#system'), systemOf(s)); put($('#dro-of'), s.offset ? 'from part zero' : 'from machine zero'); put($('#dro-machine'), s.offset ? 'machine' : 'travel');
  axes.forEach((axis, k) => {
    const text = place(axis, shown[k]);
    fill($(`#w${axis.name}`), `${text.slice(0, -2)}<i>${text.slice(-2)}</i>`);
    const lost = (s.axes_not_homed || []).includes(axis.name);
    $(`#w${axis.name}`).parentElement.classList.toggle('lost', lost);
    // What an input adds to the axis is in none of the positions.
    const added = (s.superposed || {})[axis.name] || 0, below = $(`#m${axis.name}`);
    const under = lost ? 'not homed' : added ? `Δ ${added < 0 ? '' : '+'}${place(axis, added)}` : s.offset ? place(axis, machine[k]) : axis.travel ? axis.travel.map(end => place(axis, end, 3)).join(' … ') : 'turns';
    put(below, under);
    // The ends of a long axis are as wide as the place for them.
    below.style.fontSize = `${Math.min(1.2, 13.2 / under.length).toFixed(2)}em`;
    below.title = added ? `in addition to the program: ${s.superposition_text}` : '';
    const rail = $(`#t${axis.name}`);
    rail.parentElement.hidden = !axis.travel;
    if (axis.travel) rail.style.left = `${Math.max(0, Math.min(100, (machine[k] - axis.travel[0]) / (axis.travel[1] - axis.travel[0]) * 100)).toFixed(2)}%`;
    if (k < SHOWN_ON_PHONES) put($(`#g${axis.name}`), place(axis, shown[k], 1));
  });
  feedDigits(speed * 60, moving);
  if (s.mode === 'backwards') put($('#feedof'), moving ? 'back along the path' : 'backwards');
  for (const [key, ratio] of [['feed-override', s.feed_override], ['rapid-override', s.rapid_override], ['spindle-override', isLocked() ? 1 : s.spindle_override]]) {
    const tile = $(`[data-ov=${key}]`);
    fill($('[data-v]', tile), `${Math.round(ratio * 100)}<span class="unit">%</span>`);
    $('.bar i', tile).style.width = `${Math.min(100, Math.abs(ratio) * 50)}%`; $('.bar u', tile).style.left = '50%';
  }
  spindleDigits();
  // While a tool is asked for, the one that is told is not in the spindle yet.
  const asked = s.asked && s.asked.tools, now = asked ? asked.before && asked.before.number : s.tool;
  put($('#tool'), now ? `T${now}` : '–'); put($('#toolof'), asked ? `T${asked.wanted ? asked.wanted.number : 0} is wanted` : now ? 'told to be in' : 'none told');
  // Of a program that is over nothing is left.
  const left = secondsTo(), known = left !== null, ends = known && S.state === 'running' ? clock(Date.now() + left * 1000) : null;
  put($('#left'), S.state === 'stale' || !known ? '–:––.–' : span(left)); put($('#g-left'), $('#left').textContent);
  put($('#ends'), S.state === 'stale' ? 'not known' : ends ? `ends ${ends}` : known ? 'when it goes on' : ''); put($('#g-end'), ends || '––:––:––');
  paintNeeds();
  put($('#g-line'), String(s.line)); put($('#g-ov'), `at ${Math.round(s.feed_override * 100)} %`); put($('#g-feed'), feedText(speed * 60));
  paintWhy();
  blocks(s.line);
}
function feedDigits(v, moving) {
  // What an axis does by hand, or on its way home, is in no plan.
  const plan = S.status.end_of_epoch === 'open' && S.status.place !== null && !['jogging', 'homing'].includes(S.state) ? PLAN : null;
  const bin = plan ? plan.bin(S.p) : 0, code = plan ? plan.code[bin] : 0, rapid = !!(code & 128), programmed = plan ? plan.programmed[bin] * 60 : 0;
  const full = PLAN ? Math.max(PLAN.mostFeed * 60, 1) : Math.max(v, 6000), part = x => `${Math.min(100, x / full * 100)}%`;
  put($('#feed'), feedText(v));
  $('#feedbar').style.width = part(v); $('#feedmark').style.left = part(rapid || programmed > 1e9 ? full : programmed); $('#feedmark').hidden = !plan;
  put($('#feedof'), !plan ? '' : rapid ? (moving ? 'rapid' : 'a rapid comes') : !moving ? (programmed > 1e9 ? '' : `programmed ${feedText(programmed)}`) : `of ${feedText(programmed)}${['feed', 'none', 'rest'].includes(limitOf(code)) ? '' : `, ${limitText(code)}`}`);
}
function blocks(line) {
  if (!INFO.program || !line || !S.status.program_is_shown || !S.shows) { fill($('#blocks'), ''); return; }
  $('#blocks').style.setProperty('--digits', Math.max(3, String(line + 2).length));
  fill($('#blocks'), [-2, -1, 0, 1, 2].map(k => { const text = LINES.get(line + k); return `<div class="${k ? '' : 'cur'}"><span class="k">${text === undefined ? '' : line + k}</span><span>${text ? safe(text.trim()) : ' '}</span></div>`; }).join(''));
}

/* What was heard is old after a while. */
const isOld = () => performance.now() - S.heard > 1500;
function growOld() {
  if (S.heard && isOld() && S.state !== 'stale') { S.state = 'stale'; paintState(); redraw(); }
}
/* ---- the loop */
let lastDigits = 0, lastHealth = 0, lastSpectrum = 0, lastWhole = 0;
const FRAMES = { count: 0, since: 0, rate: 0, hand: -Infinity, seen: '', due: 0, late: 0 };
/* What moves is painted 30 times a second, and what is at rest 15 times, for a panel may have no graphics card, and the interpolator
   on the processor beside. Under a hand it is painted as often as the screen takes it. Where frames come late, the page waits for
   longer between them, so that it hears what is pressed. */
function nextFrame() {
  const rests = isMoving() ? 22 : 60, wait = S.file || performance.now() - FRAMES.hand < 1000 ? 0 : Math.min(250, rests + 3 * FRAMES.late);
  const ask = () => { FRAMES.due = performance.now() + 20; requestAnimationFrame(frame); };
  if (wait) setTimeout(ask, wait); else ask();
}
for (const kind of ['pointerdown', 'pointermove', 'wheel', 'keydown']) addEventListener(kind, () => { FRAMES.hand = performance.now(); }, { capture: true, passive: true });
/* What could not be painted, by part, and the last such failures. The other parts go on, and the band tells of it: a page that
   stands still would show what was. */
S.unpainted = {}; S.failures = [];
function paintPart(part, paint) {
  try { paint(); S.unpainted[part] = ''; } catch (error) { failed(part, error); }
}
function failed(part, error) {
  S.unpainted[part] = String(error);
  S.failures = [...S.failures, `${part}: ${error.stack || error}`].slice(-9);
  console.error(error);
}
function frame(t) {
  FRAMES.late += 0.2 * (Math.max(0, Math.min(300, performance.now() - FRAMES.due)) - FRAMES.late);
  nextFrame();
  FRAMES.count++;
  if (t - FRAMES.since > 1000) { FRAMES.rate = FRAMES.count * 1000 / (t - FRAMES.since); FRAMES.count = 0; FRAMES.since = t; }
  if (!S.file) growOld();
  if (t - lastDigits > 66) {
    lastDigits = t;
    paintPart('state', paintState);
    if (S.unpainted.state) { put($('#word'), 'Not shown'); put($('#why'), unpainted()); }
    paintPart('digits', digits);
    if (!S.file) paintPart('last', paintLast);
    if (S.view === 'setup') paintPart('set-up', () => { setUpDigits(); paintSetUp(); });
    if (S.view === 'programs') paintPart('programs', () => { paintChosen(); paintDay(); });
  }
  // Whatever else they are drawn from is new on them within a second.
  if (t - lastWhole > 1000) { lastWhole = t; dirty.path = dirty.ribbon = true; }
  if (dirty.path && $(`#${S.view} [data-path]`)) { dirty.path = false; paintPart('path', () => SPACE.draw(S.p)); }
  if (dirty.strips && S.view === 'tune') { dirty.strips = false; paintPart('strips', strips); }
  if (dirty.ribbon) { dirty.ribbon = false; paintPart('ribbon', ribbon); }
  if (dirty.tune && S.view === 'tune' && S.box === 'spec' && t - lastSpectrum > 250) { lastSpectrum = t; dirty.tune = false; paintPart('spectrum', spectrum); }
  if (dirty.health && S.view === 'health' && t - lastHealth > 200) { lastHealth = t; dirty.health = false; paintPart('health', health); }
  if (S.view === 'glance') paintPart('events', eventLog);
}
/* A telephone, upright or on its side, has a view of its own: in the others Hold would not be on its screen. */
const isPhone = () => innerWidth < 600 || innerHeight < 420;
function fitView() {
  if (S.file || isPhone() === S.phone) return;
  S.phone = !S.phone;
  if (S.phone) S.wide = S.view;
  setView(S.phone ? 'glance' : S.wide || 'operate');
}
const VIEWS = { setup: 'Set up', programs: 'Programs', operate: 'Run', tune: 'Tune', health: 'Health' };
const markTab = () => $$('#tabs button').forEach(b => { b.setAttribute('aria-current', b.dataset.v === S.view); b.setAttribute('aria-selected', b.dataset.v === S.view); });
function paintTabs() {
  const views = S.file ? ['tune'] : S.may === 'operate' ? Object.keys(VIEWS) : ['operate', 'tune', 'health'];
  $('#tabs').setAttribute('role', 'tablist');
  fill($('#tabs'), views.map(v => `<button role="tab" data-v="${v}">${S.file ? 'Plan' : VIEWS[v]}</button>`).join(''));
  $$('#tabs button').forEach(b => { b.onclick = () => setView(b.dataset.v); });
  markTab();
}
function start() {
  paintTabs();
  $('#themer').innerHTML = icon('theme');
  const recolour = name => { theme(name); SPACE.stale = true; paintLegend(); redraw(); };
  $('#themer').onclick = () => recolour(T.dark ? 'light' : 'dark');
  $$('[data-m]', overMode).forEach(b => { b.onclick = () => { SPACE.mode = b.dataset.m; paintLegend(); redraw(); }; });
  $('[data-prog]', overMode).onclick = () => { SPACE.showProgram = !SPACE.showProgram; paintLegend(); redraw(); };
  $$('button', overView).forEach(b => { b.onclick = () => SPACE.view(b.dataset.c); });
  SPACE.onhover = p => { if (S.view === 'tune') hover(p); };
  SPACE.onclick = p => { if (p !== null && PLAN && S.view === 'tune') { const t = timeOf(p); if (t !== null) lookAt(t); showWhy(p); } };
  stripHands(hover); ribbonHands(hover);
  let kept = null;
  try { kept = localStorage.getItem('glidepath-theme'); } catch { /* none */ }
  recolour(hash.get('theme') || kept || (matchMedia('(prefers-color-scheme: dark)').matches ? 'dark' : 'light'));
  if (S.file) startFile(); else startLive();
  addEventListener('resize', () => { fitView(); SPACE.stale = true; paintTune(); redraw(); });
  const begin = () => { redraw(); nextFrame(); };
  document.fonts.ready.then(begin, begin);
}
const bytesOf = text => { const all = atob(text), bytes = new Uint8Array(all.length); for (let i = 0; i < all.length; i++) bytes[i] = all.charCodeAt(i); return bytes; };
function startFile() {
  const f = window.GLIDEPATH_FILE, text = b => new TextDecoder().decode(bytesOf(b));
  $('#app').dataset.file = 1; S.state = 'file';
  PLAN = new Plan(bytesOf(f.columns).buffer); MOTION = new Track(bytesOf(f.path).buffer); PROGRAM = new Track(bytesOf(f.program).buffer);
  LINES.all = f.lines ? text(f.lines).split('\n') : null;
  setInfo(JSON.parse(text(f.plan)));
  put($('#leftlab'), 'Cycle time'); showAll(); setView('tune');
}
function takeToken() {
  TOKEN = hash.get('token') || '';
  try { if (TOKEN) sessionStorage.setItem('glidepath-token', TOKEN); else TOKEN = sessionStorage.getItem('glidepath-token') || ''; } catch { /* none */ }
  // The token leaves the address, so that it is in no picture of the screen.
  if (hash.get('token')) { hash.delete('token'); history.replaceState(null, '', hash.toString() ? `#${hash}` : location.pathname); }
}
function startLive() {
  if (isDevice()) startDevice(); else takeToken();
  layBar(); layBell(); layOverrides(); layLine(); layPrograms(); layShuttle();
  S.phone = isPhone();
  setView(S.phone ? 'glance' : hash.get('view') || 'operate');
  startHands();
  fetchPlan().then(listen);
}
start();
