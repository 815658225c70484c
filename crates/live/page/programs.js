'use strict';
// Programs: the folder of the service, programs that are dropped there, a look at one before it runs, Run and From
// line, and the jobs that the machine has had.

const FOLDER = { list: [], folder: '', trouble: '', chosen: null, search: '', sending: '', wanted: [] };
const LOOK = { info: null, lost: '', timer: 0, plan: null, motion: null, program: null, lines: [], key: '', at: {}, ratio: 1, times: {} };
S.agree = null;
async function fetchPrograms() {
  try {
    const answer = await fetch('/api/programs', { headers: headers('application/json') }), said = await answer.json();
    FOLDER.trouble = answer.ok ? '' : said.reason;
    if (answer.ok) { FOLDER.list = said.programs; FOLDER.folder = said.folder; }
  } catch { FOLDER.trouble = 'the page’s server does not answer'; }
  paintPrograms();
}
const size = bytes => bytes < 1000 ? `${bytes} bytes` : bytes < 1e6 ? `${(bytes / 1e3).toFixed(1)} kB` : `${(bytes / 1e6).toFixed(1)} MB`;
/* As short as it can be, and the same everywhere. */
const dayAndTime = ms => { const d = new Date(ms); return `${d.getFullYear()}-${two(d.getMonth() + 1)}-${two(d.getDate())} ${clock(ms).slice(0, 5)}`; };
function paintPrograms() {
  if (S.view !== 'programs') return;
  const words = FOLDER.search.toLowerCase(), list = FOLDER.list.filter(p => p.name.toLowerCase().includes(words));
  put($('#folder'), FOLDER.folder);
  fill($('#list'), FOLDER.trouble ? `<p class="lab-text">${safe(plain(FOLDER.trouble))}</p>` : list.map(p => `<button class="program" data-do="choose" data-name="${safe(p.name)}" aria-current="${p.name === FOLDER.chosen}"><b>${safe(p.name)}</b><span class="lab">${size(p.bytes)}, ${dayAndTime(p.changed_ms)}</span></button>`).join('') || '<p class="lab-text">There are no programs in the folder. Drop some here.</p>');
  put($('#dropof'), FOLDER.sending || (notOperating() ? 'Programs are put here by the page that operates.' : 'Drop programs here, or choose some.'));
  paintChosen(); paintDay();
}
/* Nothing of the program before is shown with the name of this one. */
function choose(name) {
  FOLDER.chosen = name; S.agree = null; $('#programs').dataset.jobs = 0;
  Object.assign(LOOK, { info: null, lost: '', plan: null, motion: null, program: null, lines: [], key: '', at: {}, ratio: 1, times: {} });
  usePlan(); lookAtChosen('first'); paintPrograms();
}
/* On small screens the jobs have no place beside a program. */
DEEDS.jobs = () => { const d = $('#programs').dataset; d.jobs = d.jobs === '1' ? 0 : 1; };
DEEDS.choose = b => choose(b.dataset.name);
/* What is known of a program by now. `look` says whether it is looked at for the first time, again, or anew because it is
   another text: only a few are remembered, and one that was given up for others is planned again only if somebody chooses it. */
async function preview(name, look) {
  try {
    const answer = await fetch(`/api/preview?name=${encodeURIComponent(name)}${look === 'first' ? '' : `&look=${look}`}`, { headers: headers('application/json') }), said = await answer.json();
    return answer.ok ? { info: said } : { lost: said.reason, isOver: true };
  } catch { return { lost: 'It cannot be looked at now' }; }
}
async function lookAtChosen(look = LOOK.info ? 'again' : 'first') {
  clearTimeout(LOOK.timer);
  const name = FOLDER.chosen;
  if (!name || S.view !== 'programs') return;
  const { info = null, lost = '', isOver } = await preview(name, look);
  if (name !== FOLDER.chosen) return;
  // What was asked of another text is forgotten here, not behind the fetches below: somebody may ask while they are on the way.
  if (!info || !LOOK.info || info.generation !== LOOK.info.generation) Object.assign(LOOK, { at: {}, ratio: 1, times: {} });
  LOOK.info = info; LOOK.lost = lost;
  if (lost && !isOver) LOOK.timer = setTimeout(lookAtChosen, 1000);
  if (info) {
    const wants = `${info.generation} ${!!info.program_path} ${!!info.report} ${!!info.failed}`;
    if (wants !== LOOK.key) {
      LOOK.key = wants;
      const of = `?of=${info.generation}`, get = async (is, path) => is ? api(path + of) : null;
      // One behind the other: hold needs a connection.
      const lines = await api(`/api/preview/lines${of}&from=1&count=40`, 'json'), program = await get(info.program_path, '/api/preview/program.bin');
      const columns = await get(info.report, '/api/preview/columns.bin'), path = await get(info.report, '/api/preview/path.bin'), whole = columns && path;
      // Another program may have been chosen meanwhile, or this one be another text.
      if (name !== FOLDER.chosen || LOOK.key !== wants) return;
      // It may have been given up meanwhile.
      if (!lines || !whole !== !info.report) LOOK.key = '';
      LOOK.plan = whole ? new Plan(columns) : null; LOOK.motion = whole ? new Track(path) : null; LOOK.program = program ? new Track(program) : null;
      LOOK.lines = lines || [];
      usePlan();
      if (info.failed) fetchFindings(info);
    }
    if (!LOOK.key || (!info.report && !info.failed)) LOOK.timer = setTimeout(lookAtChosen, 400);
  }
  paintChosen();
}
const whyNotReady = () => S.state === 'idle' ? '' : S.state === 'off' ? 'power first' : S.state === 'not-homed' ? 'home first' : S.state === 'faulted' ? 'reset first' : 'not now';
const whyNoRun = () => notOperating() || (LOOK.info && LOOK.info.fingerprint ? '' : LOOK.lost ? 'look at it first' : 'it is read') || whyNotReady();
function paintChosen() {
  const name = FOLDER.chosen, info = LOOK.info, why = whyNoRun();
  $('#programs').dataset.chosen = name ? 1 : 0;
  $('#programs').dataset.sheet = name && S.agree ? 1 : 0;
  if (!name) { fill($('#title'), '<span class="lab-text">Choose a program.</span>'); fill($('#runkeys'), ''); fill($('#found'), ''); return; }
  // What changes while it is planned stands by itself, so that a finger on a key is not lost.
  fill($('#title'), `<b>${safe(name)}</b><span class="lab">${info && info.program ? `${grouped(info.program.lines)} lines` : ''}${info && info.seconds ? `, ${span(info.seconds)} of motion at 100 %` : info && !info.failed ? `, is planned: ${span(info.planned_so_far_s || 0)} so far` : ''}</span>`);
  fill($('#runkeys'), `${key('queue-add', 'Queue', { why: notOperating(), sub: ofRatio(LOOK.ratio).slice(2), data: `data-name="${safe(name)}"` })}${key('from-line', 'From line…', { why: notOperating() })}${key('run', 'Run', { press: SHORT, why, sub: `press ½ s${ofRatio(LOOK.ratio)}`, data: `data-of="${safe(name)}"`, kind: why || (info && info.failed) ? '' : 'main' })}`);
  const failed = info && info.failed, warned = info && info.warnings ? warnings(info.warnings) : '';
  fill($('#found'), S.agree ? agreement() : failed ? `<div class="h"><b>${icon('warn', 'warn')} What was found</b></div>${findings(failed)}${warned}` : `<div class="h"><b>${warned ? `${icon('warn', 'warn')} To be made sure of` : info && info.report ? `${icon('ok', 'ok')} No mistakes found` : LOOK.lost ? safe(sentence(plain(LOOK.lost))) : 'It is read'}</b>${LOOK.lost ? key('choose', 'Look at it', { data: `data-name="${safe(name)}"` }) : ''}</div>${warned}${tolerances()}${info && info.report ? momentList(info) + sectionList(info) : ''}<pre class="lines">${safe((LOOK.lines || []).slice(0, 6).join('\n'))}</pre>`);
}
/* How long it takes with another tolerance, before it runs: it runs with the one that is chosen. */
const TOLERANCES = [[0.5, '× ½'], [1, 'as it is'], [2, '× 2'], [5, '× 5']];
const ofRatio = ratio => ratio === 1 ? '' : `, tolerance × ${num(ratio, 1)}`;
const chosenTolerance = () => LOOK.info.report.tolerance_mm * LOOK.ratio;
function tolerances() {
  const info = LOOK.info, report = info && info.report;
  if (!report || !info.seconds) return '';
  const mm = report.tolerance_mm, answer = LOOK.times[LOOK.ratio], less = answer && answer.seconds ? info.seconds - answer.seconds : 0;
  const keys = TOLERANCES.map(([ratio, name]) => `<button role="radio" class="choice" aria-checked="${ratio === LOOK.ratio}" data-do="try-tolerance" data-ratio="${ratio}">${name}<span class="lab">${num(mm * ratio, 3)} mm</span></button>`).join('');
  const said = LOOK.ratio === 1 ? `${span(info.seconds)}` : !answer ? 'is planned' : answer.failed ? safe(answer.failed) : answer.seconds === null ? `is planned: ${span(answer.so_far_s)} so far` : `${span(answer.seconds)}, ${Math.abs(less) < 0.05 ? 'the same' : `${num(Math.abs(less), 1)} s ${less > 0 ? 'less' : 'more'}`}`;
  return `<div class="tolerances"><div class="choices" role="radiogroup" aria-label="tolerance">${keys}</div><p>Cycle time: <b>${said}</b>.<br><span class="lab">Run is planned with ${num(chosenTolerance(), 3)} mm${LOOK.ratio === 1 ? '' : ', this run alone'}.</span></p></div>`;
}
DEEDS['try-tolerance'] = async b => {
  const ratio = LOOK.ratio = +b.dataset.ratio, info = LOOK.info;
  paintChosen();
  if (ratio === 1 || (LOOK.times[ratio] && LOOK.times[ratio].seconds)) return;
  const isWanted = () => LOOK.ratio === ratio && LOOK.info && LOOK.info.generation === info.generation && S.view === 'programs', times = LOOK.times;
  await whatIf('/api/preview/what-if', info.generation, 'tolerance', ratio, answer => { times[ratio] = answer; paintChosen(); }, isWanted);
};
/* What is wrong with a program, each with its line of the text. */
const MOST_FINDINGS = 100;
function findings(failed) {
  const all = failed.split('\n'), more = all.length - MOST_FINDINGS;
  return all.slice(0, MOST_FINDINGS).map(said => {
    const of = /^line (\d+)(?:, column (\d+))?/.exec(said), text = of && LOOK.at[of[1]];
    const marked = column => `${safe(text.slice(0, column - 1))}<mark>${safe(text.slice(column - 1, column) || ' ')}</mark>${safe(text.slice(column))}`;
    return `<div class="finding"><p class="lines">${safe(said)}</p>${text === null || text === undefined ? '' : `<pre class="lines"><span class="k">${of[1]}</span>${of[2] ? marked(+of[2]) : safe(text)}</pre>`}</div>`;
  }).join('') + (more > 0 ? `<p class="lab-text">And ${grouped(more)} more.</p>` : '');
}
/* What a program should say and does not: it runs all the same. */
const warnings = all => all.map(said => `<div class="finding"><p class="lines">${safe(sentence(plain(said)))}</p></div>`).join('');
async function fetchFindings(info) {
  const wanted = new Set(info.failed.split('\n').slice(0, MOST_FINDINGS).map(said => (/^line (\d+)/.exec(said) || [])[1]).filter(Boolean));
  for (const n of wanted) {
    const lines = await api(`/api/preview/lines?of=${info.generation}&from=${n}&count=1`, 'json');
    if (LOOK.info !== info) return;
    if (lines && lines.length) LOOK.at[n] = lines[0];
  }
  paintChosen();
}
DEEDS.run = b => runLooked(b.dataset.of, { tolerance_ratio: LOOK.ratio }, LOOK.info);
/* Runs what was looked at, and agreed to, and no other text: `info` is of that. Whoever reads the file sees to it that it still
   is. What it was planned with, its part zero and tools, is looked at here. */
async function runLooked(name, more, info) {
  const heard_ms = S.clock_ms, now = info && (await preview(name, 'again')).info, isSame = now && now.generation === info.generation;
  const said = isSame ? await order('run', { name, program: info.fingerprint, heard_ms, ...more }) : {};
  if (!isSame || said.status === 412) {
    refuse(`${name} is looked at anew: it, or what it is planned with, may have changed; look at it, and press again`);
    if (name === FOLDER.chosen) { S.agree = null; lookAtChosen(isSame ? 'anew' : 'first'); }
    return 'anew';
  }
  if (said.accepted && more.queued) { setView('operate'); return ''; }
  if (name !== FOLDER.chosen) return '';
  if (said.to_confirm) { S.agree = { ...more, name, info, text: said.to_confirm }; paintChosen(); fetchAround(); return ''; }
  if (said.accepted) { S.agree = null; LOOK.ratio = 1; if (S.view === 'programs') setView('operate'); }
  return '';
}
/* ---- from a line: what is different there, and what happens, before anything does */
DEEDS['from-line'] = () => { S.agree = S.agree ? null : { asks: true }; paintChosen(); const input = $('#fromline'); if (input) input.focus(); };
/* The line that the program was left at, if it was the last one. */
const leftAt = () => { const job = S.status && brokenOff(S.status); return job && job.name === FOLDER.chosen ? job.line : ''; };
DEEDS['take-line'] = b => { $('#fromline').value = b.dataset.line; $('#pass').value = b.dataset.pass; };
function agreement() {
  const a = S.agree, why = whyNoRun();
  if (a.asks) return `<div class="h"><b>From which line?</b></div><div class="row"><label class="field"><span class="lab">Line</span><input id="fromline" inputmode="numeric" value="${leftAt()}"></label><label class="field"><span class="lab">Pass</span><input id="pass" inputmode="numeric" value="1"></label>${key('compare', 'Compare', { why })}${key('from-line', 'Leave it')}</div><p class="lab-text">The program is read up to there. What is different from now is shown before anything moves.</p>${sectionKeys(LOOK.info)}`;
  const { rows, notes } = differences(a.text);
  const row = ([what, now, then]) => `<tr class="${now === then ? '' : 'differs'}"><th scope="row">${safe(what)}</th><td class="n">${safe(now)}</td><td>${now === then ? '' : '≠'}</td><td class="n">${safe(then)}</td></tr>`;
  const around = (a.around || []).map(([n, text]) => `<div class="${n === a.from_line ? 'cur' : ''}"><span class="k">${n}</span><span>${safe(text) || ' '}</span></div>`).join('');
  return `<div class="agree"><div class="h"><b>Begin at line ${a.from_line}</b><span>${a.pass > 1 ? `pass ${a.pass}` : ''}</span></div><div class="what"><table><tr><th class="l">from machine zero</th><th>machine now</th><th></th><th>program there</th></tr>${rows.map(row).join('') || '<tr><td colspan="4">Nothing is different.</td></tr>'}</table>${notes.map(text => `<p>${safe(sentence(plain(text)))}.</p>`).join('')}<div class="around">${around}</div></div><div class="row">${key('begin-there', `Begin at line ${a.from_line}`, { press: LONG, why, sub: `press 1 s${ofRatio(a.tolerance_ratio)}`, kind: 'main' })}${key('from-line', 'Leave it')}</div></div>`;
}
/* What the service says is different, a row each; positions by axis. The rest are notes. */
function differences(text) {
  const rows = [], notes = [];
  for (const said of text.split('\n').slice(1)) {
    const of = /^([^:]+): (.*) -> (.*)$/.exec(said);
    if (!of) { notes.push(said); continue; }
    const [, what, now, then] = of, there = then.split(' ');
    if (what === 'position') now.split(' ').forEach((at, k) => { const axis = axisOf(at.charAt(0)), shown = text => text ? place(axis, +text.slice(1)) : ''; rows.push([`${nameOf(axis.name)}, ${unitOf(axis)}`, shown(at), shown(there[k])]); });
    else rows.push([sentence(what), now, then]);
  }
  return { rows, notes };
}
/* The text around the line where it begins. */
async function fetchAround() {
  const a = S.agree, info = LOOK.info, from = Math.max(1, a.from_line - 2);
  const lines = info && await api(`/api/preview/lines?of=${info.generation}&from=${from}&count=5`, 'json');
  if (lines && S.agree === a) { a.around = lines.map((text, k) => [from + k, text]); paintChosen(); }
}
const count = id => { const n = numberOf($(id).value); if (Number.isInteger(n) && n > 0) return n; $(id).focus(); return null; };
DEEDS.compare = () => { const pass = count('#pass'), from_line = count('#fromline'); if (pass && from_line) runLooked(FOLDER.chosen, { from_line, pass, tolerance_ratio: LOOK.ratio }, LOOK.info); };
DEEDS['begin-there'] = () => { const { name, info, from_line, pass, tolerance_ratio } = S.agree; runLooked(name, { from_line, pass, tolerance_ratio, agreed: true }, info); };

/* ---- programs that are dropped */
const PIECE = 1 << 19;
async function send(file, replaces = false) {
  let at = 0;
  do {
    const piece = file.slice(at, at + PIECE), where = `/api/upload?name=${encodeURIComponent(file.name)}&at=${at}&size=${file.size}${replaces ? '&replaces=1' : ''}`;
    let answer, said;
    try {
      answer = await fetch(where, { method: 'POST', headers: headers('application/octet-stream'), body: piece });
      said = await answer.json();
    } catch { said = { accepted: false, reason: 'it was not sent: the page’s server does not answer' }; }
    if (!said.accepted) {
      FOLDER.sending = '';
      if (answer && answer.status === 412 && !replaces) { FOLDER.wanted.push({ file, reason: said.reason }); paintReplace(); } else refuse(`${file.name}: ${plain(said.reason)}`);
      paintPrograms();
      return;
    }
    at += piece.size;
    FOLDER.sending = at < file.size ? `${file.name}: ${Math.round(at / file.size * 100)} %` : '';
    paintPrograms();
  } while (at < file.size);
  await fetchPrograms();
  choose(file.name);
}
/* Programs whose names others have already: each is asked for. */
function paintReplace() {
  const [next] = FOLDER.wanted;
  fill($('#replace'), next ? `<span>${safe(next.reason)}.</span>${key('replace', 'Replace it', { press: LONG, sub: 'press 1 s' })}${key('keep-old', 'Keep it')}` : '');
}
DEEDS.replace = async () => { const next = FOLDER.wanted[0]; DEEDS['keep-old'](); if (next) await send(next.file, true); };
DEEDS['keep-old'] = () => { FOLDER.wanted.shift(); paintReplace(); };
async function sendAll(files) { for (const file of files) await send(file); }
function layPrograms() {
  $('#search').oninput = e => { FOLDER.search = e.target.value; paintPrograms(); };
  $('#files').onchange = e => { if (!notOperating()) sendAll([...e.target.files]); e.target.value = ''; };
  const drop = $('#programs');
  drop.addEventListener('dragover', e => { e.preventDefault(); drop.classList.add('over'); });
  drop.addEventListener('dragleave', () => drop.classList.remove('over'));
  drop.addEventListener('drop', e => { e.preventDefault(); drop.classList.remove('over'); if (!notOperating()) sendAll([...e.dataTransfer.files]); });
  // A file that is dropped beside it would take the place of the page.
  for (const kind of ['dragover', 'drop']) addEventListener(kind, e => e.preventDefault());
}

/* ---- the jobs that the machine has had */
const ENDS = { done: ['ok', 'ok'], aborted: ['abort', ''], fault: ['fault', 'bad'], over: ['dot', ''] };
function paintDay() {
  const jobs = S.status && S.status.day || [];
  fill($('#queue'), queueList());
  fill($('#dayjobs'), `<div class="h"><b>Jobs</b><span>since this page is served</span></div>${jobs.slice(0, 30).map(job => { const [sign, kind] = ENDS[job.end] || ['running', '']; return `<div class="job"><span class="n lab">${clock(job.begun_ms)}</span>${icon(sign, kind)}<span class="of"><span>${safe(job.name)}</span><span class="lab">${job.end === 'done' ? `done in ${span((job.ended_ms - job.begun_ms) / 1000)}` : job.end ? `${job.end}${job.line ? ` at line ${job.line}` : ''}` : 'runs'}</span></span>${job.end ? key('certificate', 'Certificate', { data: `data-job="${job.number}"` }) : ''}</div>`; }).join('') || '<p class="lab-text">None yet.</p>'}`);
}
