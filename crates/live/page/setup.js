'use strict';
// Set up: power, home, part zero and tool in their order; positions that are set by touching them; offsets and
// tools, edited in place; spindle and coolant; a line to type.

let SETUP = {};
let setUpVersion = null;
S.sheet = null; S.table = 'offsets'; S.editing = null;
async function fetchSetUp(version) {
  if (setUpVersion === version) return;
  setUpVersion = version;
  const info = await api('/api/set-up', 'json');
  // An answer to an older question may be older, too.
  if (setUpVersion !== version) return;
  if (!info) { setUpVersion = null; return; }
  const first = !SETUP.jog;
  SETUP = info;
  judgeUndo(); judgeTouch();
  if (first) layPad();
  paintPad(); paintTables(); paintSetUp();
}
const active = () => SETUP.systems && SETUP.systems.find(system => system.name === SETUP.active);
const whyNoLine = () => notOperating() || (S.state === 'idle' ? '' : S.state === 'off' ? 'power first' : S.state === 'not-homed' ? 'home first' : 'not now');

/* ---- the rail: what is next is marked */
function paintSetUp() {
  const s = S.status;
  if (!s || !SETUP.jog || S.view !== 'setup') return;
  const not = notOperating(), simulated = s.power === 'simulated', on = simulated || s.power === 'on', homed = !!s.not_homed && !s.not_homed.length;
  const zero = active(), hasZero = !!zero && Object.values(zero.origin).some(x => x !== 0), rests = ['idle', 'off', 'not-homed', 'faulted'].includes(S.state);
  const step = (deed, title, done, now, why, next, press = SHORT) => `<button class="key rail ${done ? 'done' : next ? 'next' : ''}" data-do="${deed}" data-press="${press}" ${why ? 'aria-disabled="true"' : ''}><i class="fill"></i><span>${icon(done ? 'ok' : 'dot')}${title}</span><small>${safe(why && !done ? why : now)}</small></button>`;
  const fault = S.state === 'faulted' ? 'reset first' : '';
  fill($('#rail'),
    (fault ? step('reset', 'Reset', false, 'press 1 s', not, true, LONG) : on ? step('power-off', 'Power', true, simulated ? 'simulated' : 'on', not || (simulated ? 'simulated' : rests ? '' : 'it moves'), false) : step('power', 'Power', false, s.power === 'enabling' ? 'coming on' : 'press ½ s', not || fault || unknown(), true))
    + step('home', 'Home', homed, homed ? 'all axes' : `${[...new Set((s.not_homed || []).map(jointWords))].join(' ')}: press ½ s`, not || fault || (on ? S.state === 'homing' ? 'under way' : rests ? '' : 'not now' : 'power first'), on && !homed)
    + step('show-zero', 'Part zero', hasZero, SETUP.keeps ? zero ? `${zero.name}${hasZero ? '' : ' is at 0'}` : 'none is kept yet' : 'not kept', '', on && homed && !hasZero)
    + step('show-tools', 'Tool', !!s.tool, s.tool ? `T${s.tool}` : 'none told', '', false));
  const why = whyNoLine();
  $$('#table .key').forEach(b => setWhy(b, b.dataset.do === 'touch-go' ? whyNoTouch() : b.closest('.devices') ? notOperating() : why));
  paintTouch();
  paintSheet(); paintPad(); paintLines(); paintUndo();
}
DEEDS.power = () => order('enable');
DEEDS['power-off'] = () => order('disable');
DEEDS.home = b => order('home', b.dataset.joint ? { joints: [+b.dataset.joint] } : {});
DEEDS['show-zero'] = () => showTable('offsets');
DEEDS['show-tools'] = () => showTable('tools');

/* ---- a number that was touched */
function laySetUp() {
  const axes = AXES();
  fill($('#setdro'), `<div class="top"><b id="s-system"></b><span>press to set it${unitKey()}</span><span>machine</span></div>${axes.map((a, k) => `<div class="ax"><b>${axisName(a)}<svg class="i" viewBox="0 0 24 24" id="h${a.name}" aria-hidden="true"></svg></b><button class="w n" id="s${a.name}" data-do="touch" data-axis="${k}" aria-label="set ${a.name}"></button><div class="m"><div class="n" id="sm${a.name}"></div><div class="travel"><i id="st${a.name}"></i></div></div></div>`).join('')}`);
  layPad();
}
DEEDS.touch = b => { $('#number').value = ''; S.sheet = S.sheet === +b.dataset.axis ? null : +b.dataset.axis; paintSheet(); if (S.sheet !== null) $('#number').focus(); };
DEEDS['close-sheet'] = () => { S.sheet = null; paintSheet(); };
/* A joint by the axis that it moves, where it moves one. */
const jointWords = joint => (SETUP.joints || [])[+joint.slice(1)] || joint;
function paintSheet() {
  const axis = S.sheet === null ? null : AXES()[S.sheet];
  $('#sheet').hidden = !axis; $('#sheet').classList.toggle('on', !!axis); $('#setup').classList.toggle('sheet', !!axis);
  if (!axis) return;
  const why = whyNoLine(), s = S.status, joint = (SETUP.joints || []).indexOf(axis.name), notHomed = (s.not_homed || []).includes(`J${joint}`);
  const system = SETUP.active || 'the work offset';
  fill($('#sheetkeys'), `<div class="row">${key('zero', `Zero ${axis.name}`, { why, kind: 'main' })}${key('half', 'Half', { why })}${key('value', 'Set to value', { why })}</div><div class="row">${key('go-to', `Go to value`, { press: SHORT, why, sub: 'rapid: press ½ s' })}${joint >= 0 && SETUP.homing !== 'none' ? key('home', `Home ${axis.name}`, { press: SHORT, why: notOperating() || unknown() || (S.state === 'faulted' ? 'reset first' : ''), sub: notHomed ? 'not homed' : 'again: press ½ s', data: `data-joint="${joint}"` }) : ''}${key('close-sheet', 'Close')}</div>`);
  put($('#sheethead'), `${nameOf(axis.name)} in ${system}, ${unitOf(axis)}`);
}
const touched = () => AXES()[S.sheet];
const entered = () => typedOn(touched(), $('#number').value);
async function setWork(value) {
  const { sheet } = S, undo = zeroToUndo(touched().name), said = await inMm(`set ${touched().name}`, [`G10 L20 P0 ${word(touched().name, value)}`]);
  if (said.accepted) { offerUndo(undo); closeSheet(sheet); }
}
/* Closes the sheet of an axis, unless it is that of another one by now. */
function closeSheet(sheet) { if (S.sheet === sheet) { S.sheet = null; paintSheet(); } }
DEEDS.zero = () => setWork(0);
DEEDS.half = () => setWork(work(machineNow())[S.sheet] / 2);
DEEDS.value = () => { const v = entered(); if (v !== null) setWork(v); else $('#number').focus(); };
DEEDS['go-to'] = async () => { const v = entered(); if (v === null) { $('#number').focus(); return; } const { sheet } = S, said = await inMm(`go to ${nameOf(touched().name)} ${place(touched(), v)}`, [`G90 G0 ${word(touched().name, v)}`]); if (said.accepted) closeSheet(sheet); };
const machineNow = () => AXES().map((a, k) => RINGED && RINGED.count ? RINGED.last_position(k) : S.status.position[a.name]);
function setUpDigits() {
  const s = S.status;
  if (!s || !s.position || !$(`#s${AXES()[0] ? AXES()[0].name : ''}`)) return;
  const machine = machineNow(), shown = work(machine);
  put($('#s-system'), systemOf(s));
  AXES().forEach((axis, k) => {
    put($(`#s${axis.name}`), place(axis, shown[k])); put($(`#sm${axis.name}`), place(axis, machine[k]));
    const homed = !(s.axes_not_homed || []).includes(axis.name);
    $(`#s${axis.name}`).parentElement.classList.toggle('lost', !homed);
    fill($(`#h${axis.name}`), `<path d="${ICONS.home}"/>`); $(`#h${axis.name}`).classList.toggle('ok', homed); $(`#h${axis.name}`).classList.toggle('warn', !homed);
    const rail = $(`#st${axis.name}`);
    rail.parentElement.hidden = !axis.travel;
    if (axis.travel) rail.style.left = `${Math.max(0, Math.min(100, (machine[k] - axis.travel[0]) / (axis.travel[1] - axis.travel[0]) * 100)).toFixed(2)}%`;
  });
}

/* ---- what was in force before the last change of a part zero or of a table */
S.undo = null;
/* The part zero, or the tool, that a line of the page sets, as it is now. */
function concerned(line) {
  const [, kind, number] = /G10 L([12]) P(\d+)/.exec(line);
  return JSON.stringify(((kind === '1' ? SETUP.tools : SETUP.systems) || []).find(of => of.number === +number) || null);
}
function zeroToUndo(axis) {
  const zero = active();
  if (!zero) return null;
  // Where it is turned, one axis moves the zero of others.
  const line = `G10 L2 P${zero.number} ${AXES().map(a => word(a.name, zero.origin[a.name])).join(' ')}`;
  return { what: `${zero.name}, ${nameOf(axis)}`, was: () => place(axisOf(axis), zero.origin[axis]), line, before: concerned(line) };
}
function offerUndo(undo) { S.undo = undo; judgeUndo(); paintUndo(); }
/* What somebody has changed since is not set back. */
function judgeUndo() {
  const { undo } = S, now = undo && concerned(undo.line);
  if (!undo || (!undo.after && now === undo.before)) return;
  if (!undo.after) undo.after = now; else if (undo.after !== now) S.undo = null;
}
function paintUndo() {
  const undo = S.undo;
  fill($('#undo'), undo ? `<span>${safe(undo.what)} was ${undo.was()}.</span>${key('undo', 'Undo', { why: whyNoLine() })}` : '');
}
DEEDS.undo = async () => { const { undo } = S, said = undo && await inMm(`undo ${undo.what}`, [undo.line]); if (said && said.accepted && S.undo === undo) { S.undo = null; paintUndo(); } };

/* ---- tables that are edited in place */
function showTable(name) { S.table = name; S.editing = null; paintTables(); if (name === 'devices') fetchDevices(); }
for (const name of ['move', 'offsets', 'tools', 'touch', 'spindle', 'devices']) DEEDS[`table-${name}`] = () => showTable(name);
function paintTables() {
  const tabs = [['move', 'Move'], ['offsets', 'Offsets'], ['tools', 'Tools'], ['touch', 'Probe'], ['spindle', 'Spindle'], ...DEVICES.known ? [['devices', 'Devices']] : []];
  fill($('#tables-tabs'), tabs.map(([name, title]) => `<button role="tab" class="t-${name}" aria-selected="${S.table === name}" data-do="table-${name}">${title}</button>`).join(''));
  $('#setup').dataset.table = S.table;
  if (S.editing) return;
  fill($('#table'), S.table === 'tools' ? toolTable() : S.table === 'touch' ? touchTable() : S.table === 'spindle' ? spindleKeys() : S.table === 'devices' ? deviceTable() : offsetTable());
}
/* `of` is the axis that a cell is of, or what else has a scale and places. */
const cell = (what, edit, value, of) => `<td><button class="cell n" data-do="edit" data-edit="${safe(edit)}" data-value="${value}" data-of="${of}" aria-label="${safe(what)}">${cellText(of, value)}</button></td>`;
const cellText = (of, value) => of === 'turned' ? num(value, 2) : of === 'diameter' ? lengthText(value, 3) : place(axisOf(of), value);
const cellScale = of => of === 'turned' ? 1 : of === 'diameter' ? perUnit() : scaleOf(axisOf(of));
const cellTyped = (of, text) => of === 'turned' ? numberOf(text) : of === 'diameter' ? typed(text, perUnit()) : typedOn(axisOf(of), text);
function offsetTable() {
  if (!SETUP.keeps) return '<p class="lab-text">Nothing is kept over a restart, so there is no table. Name a folder: directory of [state] of the configuration.</p>';
  if (SETUP.trouble) return `<p class="lab-text">${safe(plain(SETUP.trouble))}</p>`;
  if (!SETUP.systems) return '<p class="lab-text">Nothing is kept yet. Press a position and set it: that is the first entry.</p>';
  const axes = AXES().map(a => a.name);
  return `<table class="edit"><tr><th>system</th>${axes.map(a => `<th>${nameOf(a)}</th>`).join('')}<th>turned</th><th></th></tr>${SETUP.systems.map(system => `<tr class="${system.name === SETUP.active ? 'on' : ''}"><td><b>${system.name}</b></td>${axes.map(a => cell(`${system.name}, ${a}`, `G10 L2 P${system.number} ${a}`, system.origin[a], a)).join('')}${cell(`${system.name}, turned`, `G10 L2 P${system.number} R`, system.rotation_deg, 'turned')}<td>${system.name === SETUP.active ? '<span class="chip">in use</span>' : key('use', 'Use', { press: SHORT, why: whyNoLine(), data: `data-line="${system.name}"` })}</td></tr>`).join('')}</table>`;
}
function toolTable() {
  if (!(SETUP.tools || []).length) return '<p class="lab-text">There are no tools. Name a table in the format of LinuxCNC: tool_table of [program] of the configuration, with a line a tool, such as T1 P1 Z50 D6 ;end mill.</p>';
  const axes = AXES().map(a => a.name).filter(a => a === 'Z' || SETUP.tools.some(tool => [tool, ...(tool.edges || [])].some(edge => edge.offset[a])));
  return `<table class="edit"><tr><th>tool</th><th class="l">name</th>${axes.map(a => `<th>${a === 'Z' ? 'length Z' : nameOf(a)}</th>`).join('')}<th>Ø</th></tr>${SETUP.tools.map(tool => `<tr class="${S.status && tool.number === S.status.tool ? 'on' : ''}"><td><b>T${tool.number}</b></td><td class="l">${safe(tool.name || '')}</td>${axes.map(a => cell(`T${tool.number}, ${a === 'Z' ? 'length' : a}`, `G10 L1 P${tool.number} ${a}`, tool.offset[a], a)).join('')}${cell(`T${tool.number}, Ø`, `G10 L1 P${tool.number} R`, tool.diameter_mm, 'diameter')}</tr>${(tool.edges || []).map(edge => `<tr><td>D${edge.edge}</td><td></td>${axes.map(a => `<td class="n">${cellText(a, edge.offset[a])}</td>`).join('')}<td class="n">${cellText('diameter', edge.diameter_mm)}</td></tr>`).join('')}`).join('')}</table>${SETUP.keeps ? '' : '<p class="lab-text">Changes last as long as the planner’s service: name a folder, directory of [state].</p>'}`;
}
DEEDS.line = b => own(b.dataset.line, [b.dataset.line]);
DEEDS.use = DEEDS.line;
DEEDS.edit = b => {
  if (notOperating() || S.editing) return;
  const input = document.createElement('input'), { edit, of } = b.dataset, before = concerned(edit);
  input.className = 'cell n'; input.inputMode = 'decimal'; input.value = typedText(+b.dataset.value, cellScale(of)); input.setAttribute('aria-label', 'new value; Enter sets it, Esc leaves it');
  S.editing = input; b.replaceWith(input); input.focus(); input.select();
  const leave = () => { if (S.editing === input) { S.editing = null; $('#table').kept = ''; paintTables(); } };
  input.onblur = leave;
  input.onkeydown = async e => {
    if (e.key === 'Escape') leave();
    if (e.key !== 'Enter' || e.repeat) return;
    const value = cellTyped(of, input.value);
    if (value === null) return;
    if (concerned(edit) !== before) { refuse('it was changed meanwhile; look at it, and change it anew'); leave(); return; }
    // R of a tool is a radius.
    const isTool = edit.includes(' L1 '), name = edit.slice(-1);
    const line = x => edit.slice(0, -1) + word(name, isTool && name === 'R' ? x / 2 : x), was = +b.dataset.value;
    const what = b.getAttribute('aria-label'), said = await inMm(what, [line(value)]);
    if (!said.accepted) return;
    offerUndo({ what, was: () => cellText(of, was), line: line(was), before });
    leave();
  };
};

/* ---- a line to type */
const TYPED = { at: -1 };
function paintLines() {
  const s = S.status, lines = (s && s.page_jobs || []).filter(job => job.kind !== 'file');
  const newest = lines.length ? `${lines[0].number} ${lines[0].state}` : '', list = $('#typed');
  fill(list, lines.slice(0, 6).reverse().map(job => `<div class="${job.state}"><span class="n lab">${clock(job.at_ms)}</span><code>${safe(job.name)}</code><span>${job.state === 'running' ? 'runs' : job.state === 'done' ? 'done' : safe(buttonWords(job.text))}</span></div>`).join(''));
  // The last one is at the bottom.
  if (TYPED.newest !== newest) { TYPED.newest = newest; list.scrollTop = list.scrollHeight; }
  const why = whyNoLine(), button = $('#runline');
  setKey(button, 'Run line', { press: SHORT, why, sub: 'press ½ s', kind: why ? '' : 'main' });
  judgeAnew();
}
DEEDS['run-line'] = async () => {
  const input = $('#mdi'), line = input.value.trim();
  if (!line) { input.focus(); return; }
  const said = await order('mdi', { line });
  if (said.accepted && input.value.trim() === line) { input.value = ''; TYPED.at = -1; judgeSoon(); }
};
function layLine() {
  const input = $('#mdi'), button = $('#runline');
  input.addEventListener('keydown', e => {
    if (e.key === 'Enter') { e.preventDefault(); if (!e.repeat && press(button)) PRESSED.key = 'Enter'; return; }
    if (e.key !== 'ArrowUp' && e.key !== 'ArrowDown') return;
    e.preventDefault();
    const lines = (S.status && S.status.page_jobs || []).filter(job => job.kind === 'line');
    TYPED.at = Math.max(-1, Math.min(lines.length - 1, TYPED.at + (e.key === 'ArrowUp' ? 1 : -1)));
    input.value = TYPED.at < 0 ? '' : lines[TYPED.at].name;
    judgeSoon();
  });
  layJudged();
}
