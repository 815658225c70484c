'use strict';
// Probing: a probe, or a tool over a plate, goes to the part until it touches; then the part zero, or the
// length of the tool, is set from where it touched. Lines for the planner's service, in one job.

const TOUCH_FIELDS = { reach: 'Farthest way', feed: 'Feed', plate: 'Plate under the tool', tip: 'Ø of the probe', place: 'The place is at', back: 'Then back' };
/* What the fields have at first, mm and mm/min: round numbers in either unit. */
const touchDefaults = () => UNIT.inch ? { reach: 0.4 * MM_PER_INCH, feed: 4 * MM_PER_INCH, back: 0.1 * MM_PER_INCH } : { reach: 10, feed: 100, back: 2 };
const TOUCH = { way: 'Z−', ...touchDefaults(), plate: 0, tip: 0, place: 0, of: 'zero', step: 0, says: '', undo: null };
const touchWays = () => { const names = AXES().map(a => a.name), sides = names.includes('X') && names.includes('Y') ? ['X+', 'X−', 'Y+', 'Y−'] : []; return names.includes('Z') ? ['Z−', ...sides] : sides; };
const isLength = () => TOUCH.way === 'Z−' && TOUCH.of === 'length';
function touchTable() {
  if (!SETUP.probe) return '<p class="lab-text">There is no probe. Name its input: input of [probe] of the configuration, and inputs_outputs = "feedback" of [program]. By hand: jog until the tool touches the part, press that axis\'s position, and set it to zero there.</p>';
  const radio = (kind, value, on, text) => `<button role="radio" class="choice" aria-checked="${on}" data-do="touch-set" data-kind="${kind}" data-value="${safe(value)}">${text}</button>`;
  const fields = ['reach', 'feed', TOUCH.way === 'Z−' ? 'plate' : 'tip', 'place', 'back'], tool = S.status ? S.status.tool : 0;
  return `<div class="touch"><div class="choices" role="radiogroup" aria-label="which way">${touchWays().map(way => radio('way', way, TOUCH.way === way, way)).join('')}</div>`
    + (TOUCH.way === 'Z−' ? `<div class="choices" role="radiogroup" aria-label="what is set">${radio('of', 'zero', !isLength(), 'Part zero')}${radio('of', 'length', isLength(), tool ? `Length of T${tool}` : 'Length of the tool')}</div>` : '')
    + `<div class="fields">${fields.map(name => `<label class="field"><span class="lab">${TOUCH_FIELDS[name]}, ${name === 'feed' ? feedUnit() : lengthUnit()}</span><input data-touch="${name}" inputmode="decimal" autocomplete="off" value="${isFinite(TOUCH[name]) ? typedText(TOUCH[name], perUnit()) : ''}"></label>`).join('')}</div>`
    + `<p class="lab-text">Jog until the ${TOUCH.way === 'Z−' ? 'tool is over the plate or the part' : 'probe is beside the part'}.</p><div class="row">${key('touch-go', `Touch ${TOUCH.way}`, { press: SHORT, sub: 'press ½ s', kind: 'main' })}<div id="touchsteps"></div></div></div>`;
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
  if (!(feed > 0) || feed > most) return `the feed is at most ${feedText(most)}`;
  if (!(plate >= 0) || !(tip >= 0) || !(back >= 0)) return 'not less than 0';
  if (isLength() && !(S.status && S.status.tool)) return 'no tool is told: T1 M6 first';
  if (isLength() && !(SETUP.tools || []).length) return 'there is no tool table';
  if (S.status && turnsNow(S.status)) return 'the spindle turns: stop it first';
  return whyNoLine();
}
/* The lines: `#5061` and on are where it touched, `#5420` and on where it came to rest behind that. */
function touchLines() {
  const axis = TOUCH.way[0], sign = TOUCH.way[1] === '+' ? 1 : -1, n = 'XYZ'.indexOf(axis), now = `#${5420 + n}`, contact = `#${5061 + n}`;
  const value = axis === 'Z' ? TOUCH.place + TOUCH.plate : TOUCH.place - sign * TOUCH.tip / 2;
  const set = isLength() ? `L10 P${S.status.tool}` : 'L20 P0';
  // A length is in force only in the line behind the one that takes it, and behind what was in force before.
  return [
    `G90 G94 G38.2 ${axis}[${now}${sign < 0 ? '-' : '+'}${mm(TOUCH.reach)}] F${mm(TOUCH.feed)}`,
    `G10 ${set} ${axis}[${now}-${contact}+${mm(value)}]`.replace('+-', '-'),
    `G1 ${axis}[${now}${sign < 0 ? '+' : '-'}${mm(TOUCH.back)}] F${mm(TOUCH.feed)}`,
  ];
}
DEEDS['touch-go'] = async () => {
  if (whyNoTouch()) return;
  const lines = touchLines(), undo = isLength() ? null : zeroToUndo(TOUCH.way[0]);
  Object.assign(TOUCH, { says: '', step: 1, undo });
  paintTouch();
  // One job: nobody else gets in between, and one abort ends all of it.
  const name = `touch ${TOUCH.way}`, behind = isLength() ? [`G43 H${S.status.tool}`] : [];
  const why = await toItsEnd(await inMm(name, lines, behind));
  setTimeout(() => { if (TOUCH.undo === undo) TOUCH.undo = null; }, 3000);
  if (why) TOUCH.says = touchWords(why); else TOUCH.step = 4;
  paintTouch();
};
/* Why it ended, in words of whoever wrote no lines. */
const touchWords = why => /did not find a contact/.test(why) ? `no contact within ${lengthText(TOUCH.reach, 3)} ${lengthUnit()}: the tool stands at the end of its way, and nothing is set` : why;
/* Waits for the end of a job that was handed in. Gives back why it was not executed; nothing if it was. */
async function toItsEnd(said) {
  if (!said.accepted) return buttonWords(said.reason);
  if (!said.runs) return '';
  for (;;) {
    await new Promise(done => setTimeout(done, 100));
    if (unknown()) return 'contact was lost; look at the machine, and begin anew';
    // What is heard may be older than the order.
    const job = (S.status.page_jobs || []).find(job => job.number === said.number);
    if (!job) continue;
    if (job.state === 'done') return '';
    if (job.state !== 'running') return buttonWords(job.text);
    // Before them stand what is saved, and the unit.
    if (S.status.end_of_epoch === 'open') TOUCH.step = Math.max(TOUCH.step, Math.min(3, S.status.line - 2));
    paintTouch();
  }
}
/* What probing has set can be set back, also where it ended early behind that. */
function judgeTouch() {
  const { undo } = TOUCH;
  if (undo && concerned(undo.line) !== undo.before) { TOUCH.undo = null; offerUndo(undo); }
}
addEventListener('input', e => {
  const name = e.target.dataset && e.target.dataset.touch;
  if (!name) return;
  const value = name === 'feed' ? numberOf(e.target.value) : typed(e.target.value, perUnit());
  TOUCH[name] = value === null ? NaN : name === 'feed' ? value * perUnit() : value;
});
