'use strict';
// Touching off: a probe, or a tool over a plate, goes to the part until it touches; then the part zero, or the
// length of the tool, is set from where it touched. Lines for the planner's service, one after the other.

const TOUCH = { way: 'Z−', reach: 10, feed: 100, plate: 0, tip: 0, place: 0, back: 2, of: 'zero', step: 0, says: '', stopped: false };
const TOUCH_FIELDS = { reach: 'Farthest way, mm', feed: 'Feed, mm/min', plate: 'Plate under the tool, mm', tip: 'Ø of the probe, mm', place: 'The place is at, mm', back: 'Then back, mm' };
const touchWays = () => { const names = AXES().map(a => a.name), sides = names.includes('X') && names.includes('Y') ? ['X+', 'X−', 'Y+', 'Y−'] : []; return names.includes('Z') ? ['Z−', ...sides] : sides; };
const isLength = () => TOUCH.way === 'Z−' && TOUCH.of === 'length';
function touchTable() {
  if (!SETUP.probe) return '<p class="lab-text">There is no probe. Name its input: input of [probe] of the configuration, and inputs_outputs = "feedback" of [program].</p>';
  const radio = (kind, value, on, text) => `<button role="radio" class="choice" aria-checked="${on}" data-do="touch-set" data-kind="${kind}" data-value="${safe(value)}">${text}</button>`;
  const fields = ['reach', 'feed', TOUCH.way === 'Z−' ? 'plate' : 'tip', 'place', 'back'], tool = S.status ? S.status.tool : 0;
  return `<div class="touch"><div class="choices" role="radiogroup" aria-label="which way">${touchWays().map(way => radio('way', way, TOUCH.way === way, way)).join('')}</div>`
    + (TOUCH.way === 'Z−' ? `<div class="choices" role="radiogroup" aria-label="what is set">${radio('of', 'zero', !isLength(), 'Part zero')}${radio('of', 'length', isLength(), tool ? `Length of T${tool}` : 'Length of the tool')}</div>` : '')
    + `<div class="fields">${fields.map(name => `<label class="field"><span class="lab">${TOUCH_FIELDS[name]}</span><input data-touch="${name}" inputmode="decimal" autocomplete="off" value="${mm(TOUCH[name])}"></label>`).join('')}</div>`
    + `<p class="lab-text">Jog until the ${TOUCH.way === 'Z−' ? 'tool is over the plate or the part' : 'probe is beside the part'}. ${TOUCH.way} goes on for at most the farthest way, and stops where it touches.</p><div id="touchsteps"></div><div class="row">${key('touch-go', `Touch ${TOUCH.way}`, { press: SHORT, sub: 'press ½ s', kind: 'main' })}</div></div>`;
}
DEEDS['touch-set'] = b => { TOUCH[b.dataset.kind] = b.dataset.value; paintTables(); };
function paintTouch() {
  const place = $('#touchsteps');
  // Another table may be looked at meanwhile.
  if (!place) return;
  const steps = ['until it touches', isLength() ? 'set the length' : 'set the zero', 'back'];
  fill(place, TOUCH.step ? `<ol>${steps.map((text, k) => `<li class="${TOUCH.step > k + 1 ? 'done' : TOUCH.step === k + 1 ? 'now' : ''}">${TOUCH.step > k + 1 ? icon('ok', 'ok') : TOUCH.says && TOUCH.step === k + 1 ? icon('warn', 'warn') : icon('dot')} ${text}</li>`).join('')}</ol>${TOUCH.says ? `<p class="warn-text" role="alert">${safe(sentence(TOUCH.says))}.</p>` : ''}` : '');
}
/* Why it is not begun; nothing if it can be. */
function whyNoTouch() {
  const { reach, feed, plate, tip, back } = TOUCH, most = SETUP.probe.most_mm_min;
  if (TOUCH.step && TOUCH.step < 4 && !TOUCH.says) return 'under way';
  if (Object.values(TOUCH).some(x => typeof x === 'number' && !isFinite(x))) return 'a number is missing';
  if (!(reach > 0)) return 'the way is more than 0';
  if (!(feed > 0) || feed > most) return `the feed is at most ${grouped(most)}`;
  if (!(plate >= 0) || !(tip >= 0) || !(back >= 0)) return 'not less than 0';
  if (isLength() && !(S.status && S.status.tool)) return 'no tool is told: T1 M6 first';
  return whyNoLine();
}
/* The lines: `#5061` and on are where it touched, `#5420` and on where it came to rest behind that. */
function touchLines() {
  const axis = TOUCH.way[0], sign = TOUCH.way[1] === '+' ? 1 : -1, n = 'XYZ'.indexOf(axis), now = `#${5420 + n}`, contact = `#${5061 + n}`;
  const value = axis === 'Z' ? TOUCH.place + TOUCH.plate : TOUCH.place - sign * TOUCH.tip / 2;
  const set = isLength() ? `L10 P${S.status.tool}` : 'L20 P0';
  // Numbers of a line are those before it: a length is in force only in the line behind the one that takes it.
  return [
    [1, `G21 G90 G94 G38.2 ${axis}[${now}${sign < 0 ? '-' : '+'}${mm(TOUCH.reach)}] F${mm(TOUCH.feed)}`],
    [2, `G21 G10 ${set} ${axis}[${now}-${contact}+${mm(value)}]`.replace('+-', '-')],
    ...(isLength() ? [[2, `G43 H${S.status.tool}`]] : []),
    [3, `G21 G90 G1 ${axis}[${now}${sign < 0 ? '+' : '-'}${mm(TOUCH.back)}] F${mm(TOUCH.feed)}`],
  ];
}
DEEDS['touch-go'] = async () => {
  if (whyNoTouch()) return;
  TOUCH.says = ''; TOUCH.stopped = false;
  const undo = isLength() ? null : zeroToUndo(TOUCH.way[0]);
  for (const [step, line] of touchLines()) {
    TOUCH.step = step; paintTouch();
    // Whoever held or aborted, be it between two lines, wants nothing more to move.
    const why = TOUCH.stopped ? 'Hold or Abort was pressed: nothing more was done' : await lineToItsEnd(line);
    if (why) { TOUCH.says = why; paintTouch(); return; }
    if (step === 2 && undo) offerUndo(undo);
  }
  TOUCH.step = 4; paintTouch();
};
/* Hands a line in, and waits for its end. Gives back why it was not executed; nothing if it was. */
async function lineToItsEnd(line) {
  const begun = S.clock_ms, said = await mdi(line);
  if (!said.accepted) return buttonWords(said.reason);
  if (!said.runs) return '';
  for (;;) {
    await new Promise(done => setTimeout(done, 100));
    if (unknown()) return 'contact was lost; look at the machine, and begin anew';
    const job = (S.status.page_jobs || [])[0];
    // What is heard may be older than the order.
    if (!job || S.clock_ms === begun || job.name !== line) { if (job && job.name !== line && S.clock_ms - begun > 2000) return 'another line was handed in meanwhile'; continue; }
    if (job.state === 'done') return '';
    if (job.state !== 'running') return buttonWords(job.text);
  }
}
addEventListener('input', e => {
  const name = e.target.dataset && e.target.dataset.touch;
  if (!name) return;
  const number = numberOf(e.target.value);
  TOUCH[name] = number === null ? NaN : number;
});
