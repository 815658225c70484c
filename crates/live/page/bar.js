'use strict';
// The bar: abort, single block, what goes on, and hold, which is always there and never covered.

const BAR = {};
function layBar() {
  fill($('#cmd'), ['abort', 'single', 'go', 'hold'].map(name => `<button class="key" data-c="${name}" data-do="${name}" data-press="0"><i class="fill"></i><span></span><small></small></button>`).join(''));
  for (const name of ['abort', 'single', 'go', 'hold']) BAR[name] = $(`#cmd [data-c=${name}]`);
  layDeeds();
}
function layDeeds() {
  // Nothing that another finger is about to begin begins behind a stop.
  DEEDS.hold = () => { if (PRESSED.button !== BAR.abort) letGo(); endJog(); endShuttle(); order('hold'); };
  DEEDS.abort = () => { endJog(); endShuttle(); order('abort'); };
  DEEDS.unit = () => { const before = touchDefaults(); changeUnit(); paintUnits(); for (const [name, x] of Object.entries(before)) if (TOUCH[name] === x) TOUCH[name] = touchDefaults()[name]; SPACE.stale = true; if (JOG.step) JOG.step = steps()[steps().length - 1]; S.editing = null; redraw(); paintLegend(); paintTables(); paintPad(); paintSetUp(); paintPrograms(); };
  DEEDS.single = () => order('single-block', { on: !(S.status && S.status.single_block) });
  DEEDS.go = async () => {
    // Held on the way back, it turns round first.
    const turns = S.status && S.status.mode === 'backwards', rests = S.state === 'held', heard_ms = S.clock_ms;
    const said = turns ? await order('forward', { heard_ms }) : null;
    // It was asked for when the key was: a hold that came meanwhile counts.
    if (!said || (said.accepted && rests)) order('resume', { heard_ms });
  };
  DEEDS.back = async () => {
    const heard_ms = S.clock_ms, said = S.status && S.status.mode === 'backwards' ? null : await order('reverse', { heard_ms });
    if (!said || said.accepted) order('resume', { heard_ms });
  };
  DEEDS.reset = () => order('reset');
  DEEDS.return = () => order('return');
  DEEDS.done = b => order('acknowledge', JSON.parse(b.dataset.event));
  DEEDS.cannot = b => { const reason = $('#attn [name=why]:checked'); order('acknowledge', { ...JSON.parse(b.dataset.event), fail: reason ? reason.value : 'it cannot be done' }); };
  DEEDS['show-reasons'] = b => { S.reasons = S.reasons === b.dataset.event ? '' : b.dataset.event; paintState(); };
}
/* Which override of 0 % it rests at, as the machine says; nothing if at none. */
const noOverride = s => { const at = / an? (feed|rapid) override of 0 %/.exec(s.state_text || ''); return at ? `${at[1]} is at 0 %` : / overrides of 0 %/.test(s.state_text || '') ? 'all is at 0 %' : ''; };
/* Why nothing goes on; nothing if it can. */
function whyNoGo(s) {
  if (S.state === 'awaiting') return s.asked ? 'answer first' : 'the machine is busy';
  if (S.state === 'faulted') return 'reset first';
  if (isAway(s) && ['held', 'program-stop'].includes(S.state)) return 'return first';
  if (S.state === 'held' && noOverride(s)) return noOverride(s);
  if (['held', 'program-stop'].includes(S.state)) return '';
  if (S.state === 'preparing' && s.job && s.job.begins_held) return '';
  if (S.state === 'stale') return 'state not known';
  return S.state === 'running' ? 'it runs' : 'nothing is held';
}
function paintBar() {
  const s = S.status || {}, not = notOperating(), moves = !['idle', 'stale', 'none', 'off', 'not-homed', 'faulted'].includes(S.state);
  // What is not known is not said: a page that hears nothing holds and aborts all the same.
  const isUnknown = S.state === 'stale', resting = isUnknown ? 'state not known' : S.state === 'none' ? 'no machine' : 'nothing moves';
  setKey(BAR.hold, `${icon('hold')}Hold`, { why: may('hold') ? '' : `this page may only ${S.may}`, sub: moves ? 'at once' : resting, kind: 'hold' });
  setKey(BAR.abort, `${icon('abort')}Abort`, { press: LONG, why: may('hold') ? moves || isUnknown ? '' : 'nothing runs' : `this page may only ${S.may}`, sub: 'press 1 s' });
  // Beside these keys stands who operates, which needs the room.
  const barred = not && 'not here', why = barred || whyNoGo(s), single = s.single_block;
  setKey(BAR.go, `${icon('running')}${isBlockEnd(s) ? 'Next block' : s.mode === 'backwards' ? 'Forward' : 'Resume'}`, { press: SHORT, why, sub: 'press ½ s', kind: why ? '' : 'main' });
  setKey(BAR.single, `${icon('step')}Single`, { why: barred, sub: single ? 'block: on' : 'block: off', kind: single ? 'on' : '' });
  paintWho();
}
function paintWho() {
  const old = S.refusal && performance.now() - S.refused_at > 12000;
  if (old) S.refusal = '';
  let html;
  if (S.refusal) html = `${icon('warn', 'warn')}<button class="refusal" data-do="leave-refusal" title="press to close">${safe(S.refusal.replaceAll('\n', ' · '))}</button>`;
  else if (S.asked_for) html = `<span><b>Another page wants to operate.</b></span>${key('give-seat', 'Give', { press: SHORT })}${key('keep-seat', 'Keep')}`;
  else if (S.may === 'operate' && !S.operates) html = `<span><b>Another page operates.</b>${S.asks ? '<br>It is asked.' : ''}</span>${S.asks ? '' : key('ask-seat', 'Ask for it')}`;
  else if (S.may === 'operate') html = '<span><b>You operate.</b><br>Not for emergencies.</span>';
  else if (S.may === 'hold') html = '<span><b>Hold and abort.</b><br>Not for emergencies.</span>';
  else html = `<span class="big">${icon('lock')}</span><span>This page<br>only looks.</span>`;
  // What takes more room gets that of the tabs.
  $('#app').dataset.says = S.refusal.length > 60 ? 2 : S.refusal || S.asked_for ? 1 : 0;
  fill($('#mode'), html);
}
DEEDS['leave-refusal'] = () => { S.refusal = ''; paintWho(); };
/* The panel in place of the text: what a person has to do, with the buttons for it. */
const REASONS = ['the tool is not there', 'the tool does not fit', 'the program asks for the wrong one', 'it cannot be done now'];
function attentionKeys() {
  const s = S.status, not = notOperating();
  if (S.state === 'faulted') return key('reset', 'Reset', { press: LONG, why: not, kind: 'main', sub: 'press 1 s' });
  if (S.state === 'awaiting' && s.asked && s.awaited) {
    const which = JSON.stringify({ boot: s.boot, epoch: s.awaited.epoch, sequence: s.awaited.sequence }), event = `data-event="${safe(which)}"`, asksWhy = S.reasons === which, tool = s.asked.tools && s.asked.tools.wanted;
    const done = tool ? tool.number ? `Done: T${tool.number} is in` : 'Done: it is out' : 'Done';
    const reasons = asksWhy ? `<div class="reasons">${REASONS.map((text, k) => `<label><input type="radio" name="why" value="${text}" ${k ? '' : 'checked'}>${text}</label>`).join('')}</div>${key('cannot', 'It cannot be done', { press: LONG, why: not, sub: 'press 1 s: the machine stops with a fault', data: event })}` : '';
    return `${reasons}${key('done', done, { press: SHORT, why: not, kind: 'main', sub: 'press ½ s', data: event })}${key('show-reasons', asksWhy ? 'Back' : 'Cannot…', { why: not, data: event })}`;
  }
  if (['held', 'program-stop'].includes(S.state) && isAway(s)) return key('return', 'Return to the path', { press: SHORT, why: not, kind: 'main', sub: 'press ½ s' });
  return '';
}
/* What a program that runs says, until somebody has read it. Where it waits for a person, the panel says it, and whoever answers has
   read it. */
S.read = ''; S.told = '';
DEEDS.read = b => { S.read = b.dataset.message; paintSays(); };
function paintSays() {
  paintWay();
  const s = S.status, isOpen = s && s.message && s.end_of_epoch === 'open', message = isOpen ? messageOf(s) : '';
  if (isOpen && s.asked && s.asked.says) S.told = message;
  else if (S.told) { S.read = S.told; S.told = ''; }
  const said = unread(s);
  fill($('#says'), said ? `<p><span class="lab">The program says</span><br>${safe(said)}</p>${key('read', 'Read', { data: `data-message="${safe(message)}"` })}` : '');
}
/* The way back along the path, where the program is held. */
function paintWay() {
  const s = S.status, isBack = s && s.mode === 'backwards', held = S.state === 'held' && !isAway(s);
  const next = S.may === 'operate' && S.view === 'operate' ? nextPanel() : '';
  if (next) { fill($('#way'), next); return; }
  if (S.may !== 'operate' || !s || !(held || (S.state === 'running' && isBack))) { fill($('#way'), ''); return; }
  const not = notOperating();
  fill($('#way'), held ? `${key('back', `${icon('back')}Back`, { press: SHORT, why: not, sub: 'press ½ s' })}<p>Goes back along the path, for at most a minute of it, until you press Hold. ${isBack ? 'Forward goes on to the end.' : ''}</p>` : '<p>It goes back along the path. Press Hold where it is to rest.</p>');
}
/* ---- overrides, in steps of 5 % */
function layOverrides() {
  $$('.ov').forEach(tile => {
    const kind = tile.dataset.ov, [less, full, more] = $$('button', tile);
    const range = () => kind === 'rapid-override' ? [0, 1] : kind === 'spindle-override' ? INFO.machine.spindle_override || [0, 2] : [0, 2];
    // What was asked for and is not told yet is counted on, so that of two quick presses none is lost; orders go one behind the other.
    let wanted = 0, until = 0, last = Promise.resolve();
    const now = () => performance.now() < until ? wanted : S.status ? S.status[kind.replaceAll('-', '_')] : 1;
    const ask = value => {
      const given = { value, heard_ms: S.clock_ms };
      wanted = value; until = performance.now() + 500;
      last = last.then(async () => { if (!(await order(kind, given)).accepted) until = 0; });
    };
    // Whichever way the motion goes, more is faster.
    const way = () => now() < 0 || Object.is(now(), -0) ? -1 : 1;
    const step = d => { const [least, most] = range(); ask(way() * Math.max(least, Math.min(most, Math.round((Math.abs(now()) + d) * 20) / 20))); };
    less.innerHTML = '−5'; more.innerHTML = '+5';
    less.dataset.do = `${kind}-less`; more.dataset.do = `${kind}-more`; full.dataset.do = `${kind}-full`;
    DEEDS[`${kind}-less`] = () => step(-0.05); DEEDS[`${kind}-more`] = () => step(0.05); DEEDS[`${kind}-full`] = () => ask(way());
  });
}
/* Overrides that a program keeps to itself cannot be pressed. */
function paintOverrides() {
  $$('.ov [data-do]').forEach(b => { if (notOperating() || (isLocked() && b.dataset.do.startsWith('spindle'))) b.setAttribute('aria-disabled', 'true'); else b.removeAttribute('aria-disabled'); });
}
/* All that depends on who may what. */
function paintHands() {
  const app = $('#app');
  app.dataset.may = S.may; app.dataset.operates = S.operates ? 1 : 0;
  paintOverrides();
  fill($('#g-foot'), S.may === 'look' ? `${icon('lock')}<span>This page only looks; it sends no commands.</span>${unitKey()}` : `<span>Not for emergencies.</span>${unitKey()}`);
  paintUnits();
  paintBar(); paintSetUp(); paintPrograms();
}
