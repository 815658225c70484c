'use strict';
// What the page orders, and how fingers give orders: what stops acts when the finger comes down, what begins
// motion is pressed for half a second, what loses work for one.

const SHORT = 500, LONG = 1000;
/* A number of this page, which outlasts its being loaded again, so that its seat does. */
const PAGE = (() => {
  const fresh = () => [...crypto.getRandomValues(new Uint8Array(8))].map(b => b.toString(16).padStart(2, '0')).join('');
  try {
    const kept = sessionStorage.getItem('glidepath-page') || fresh();
    sessionStorage.setItem('glidepath-page', kept);
    return kept;
  } catch { return fresh(); }
})();
const headers = kind => ({ 'X-Glidepath-Token': TOKEN, 'X-Glidepath-Page': PAGE, 'Content-Type': kind });

/* Gives an order, with the time that was heard last of the page's server: what comes late does not count. Gives back what was answered. What is refused is told beside the buttons. */
async function order(kind, more = {}, quietly = false) {
  let said;
  try {
    const answer = await fetch('/api/command', { method: 'POST', priority: 'high', signal: AbortSignal.timeout(10000), headers: headers('application/json'), body: JSON.stringify({ kind, heard_ms: S.clock_ms, ...more }), keepalive: true });
    const text = await answer.text();
    said = { status: answer.status, ...(text.startsWith('{') ? JSON.parse(text) : { accepted: false, reason: text }) };
  } catch { said = { accepted: false, reason: `${kind}: the page's server did not answer; look whether it was done` }; }
  if (!quietly) { S.refusal = said.accepted ? '' : buttonWords(said.reason); S.refused_at = performance.now(); paintPart('state', paintState); }
  return said;
}
/* Lines of the page, with a name for people, executed as one job. */
const own = (name, lines) => order('sequence', { name, lines });
/* The same in mm and radii, as the page has lengths, whatever is in force. That is in force again behind them. */
const inMm = (name, lines, behind = []) => own(name, ['M70', isLathe() ? 'G21 G8' : 'G21', ...lines, 'M72', ...behind]);
const mm = x => String(+x.toFixed(6));
const word = (name, x) => name + mm(x);

/* ---- buttons. `data-press` is how long they are pressed, ms; `data-do` what they do. */
const DEEDS = {};
const PRESSED = { button: null, timer: 0, key: null, pointer: null };
/* What a button means to whoever presses it: one that stays in its place may come to mean something else. */
const meaning = button => `${$('span', button).textContent} ${button === BAR.go ? S.state : ''}`;
/* Gives back whether it has to be pressed for longer. */
function press(button) {
  const wait = +(button.dataset.press || 0), deed = DEEDS[button.dataset.do];
  if (!deed || button.getAttribute('aria-disabled') === 'true') return false;
  // What stops waits for no other finger.
  if (button === BAR.hold) { deed(button); return false; }
  if (button === BAR.abort) letGo();
  if (PRESSED.button) return false;
  if (!wait) { deed(button); return false; }
  const seen = meaning(button);
  PRESSED.button = button;
  button.style.setProperty('--press', `${wait}ms`);
  button.classList.add('down');
  PRESSED.timer = setTimeout(() => {
    letGo();
    if (button.getAttribute('aria-disabled') === 'true') return;
    if (button.isConnected && meaning(button) === seen) deed(button); else refuse('this key changed under the finger; look at it, and press anew');
  }, wait);
  return true;
}
/* What is seen of a button, and what it would do. */
const looks = button => [button.className.replace(' down', ''), button.textContent, button.getAttribute('aria-disabled'), JSON.stringify(button.dataset)].join('\n');
/* Fills an element around the key in it that a finger is on, where that key stays the same: a time beside it that goes on, say, takes
   nothing from the finger. False where there is no such key, or it becomes another one. */
function fillAroundPressed(element, html) {
  const pressed = PRESSED.button;
  if (!pressed || !element.contains(pressed)) return false;
  const fresh = document.createElement(element.tagName);
  fresh.innerHTML = html;
  let twin = $$('[data-do]', fresh).find(button => looks(button) === looks(pressed)), kept = pressed;
  while (twin && kept !== element && twin !== fresh) {
    while (kept.previousSibling) kept.previousSibling.remove();
    while (kept.nextSibling) kept.nextSibling.remove();
    while (twin.previousSibling) kept.parentNode.prepend(twin.previousSibling);
    while (twin.nextSibling) kept.parentNode.append(twin.nextSibling);
    kept = kept.parentNode; twin = twin.parentNode;
  }
  return kept === element && twin === fresh;
}
/* Says beside the buttons why something was not done. */
function refuse(text) { S.refusal = text; S.refused_at = performance.now(); paintBar(); }
function letGo() {
  clearTimeout(PRESSED.timer);
  if (PRESSED.button) PRESSED.button.classList.remove('down');
  PRESSED.button = PRESSED.key = PRESSED.pointer = null;
}
addEventListener('pointerdown', e => {
  const button = e.target.closest('[data-do]');
  isPut = false;
  if (!button || e.button) return;
  const had = document.activeElement;
  if (press(button)) PRESSED.pointer = e.pointerId;
  isPut = ![had, document.body].includes(document.activeElement);
});
// A field that a press has put the focus in keeps it: a mouse would take it to where it was pressed, and an edit would end there.
let isPut = false;
addEventListener('mousedown', e => { if (isPut) e.preventDefault(); isPut = false; });
// Who reads the screen by ear may press without a finger: a stop is taken from them, too.
addEventListener('click', e => { if (!e.detail && BAR.hold && BAR.hold.contains(e.target)) press(BAR.hold); });
for (const end of ['pointerup', 'pointercancel', 'blur']) addEventListener(end, letGo);
document.addEventListener('visibilitychange', letGo);
addEventListener('pointermove', e => {
  if (PRESSED.pointer === e.pointerId && !PRESSED.button.contains(document.elementFromPoint(e.clientX, e.clientY))) letGo();
});
/* Space and Pause hold, wherever the focus is but in a field. Shift and Escape, pressed for a second, abort. */
addEventListener('keydown', e => {
  const types = e.target.closest && e.target.closest('input:not([type=range],[type=radio])');
  if (e.key === 'Pause' || (e.key === ' ' && !types)) { e.preventDefault(); if (!e.repeat && may('hold')) DEEDS.hold(); return; }
  if (e.key === 'Escape' && e.shiftKey) { e.preventDefault(); if (!e.repeat && press(BAR.abort)) PRESSED.key = 'Escape'; return; }
  if (e.key === 'Escape' && S.sheet !== null) { DEEDS['close-sheet'](); return; }
  if (e.key !== 'Enter') return;
  const button = e.target.closest && e.target.closest('[data-do]');
  if (!button) return;
  e.preventDefault();
  if (!e.repeat && press(button)) PRESSED.key = e.key;
});
addEventListener('keyup', e => { if (e.key === PRESSED.key) letGo(); });
addEventListener('contextmenu', e => { if (e.target.closest('[data-do],.jog')) e.preventDefault(); });

/* A button in its place: what it does, how long it is pressed, and why it cannot be, if it cannot. */
const key = (deed, text, { press = 0, why = '', kind = '', sub = '', data = '' } = {}) =>
  `<button class="key ${kind}" data-do="${deed}" data-press="${press}" data-sub="${safe(sub)}" ${data} ${why ? 'aria-disabled="true"' : ''}><i class="fill"></i><span>${text}</span><small>${safe(why || sub)}</small></button>`;
/* Says of keys that stay where they are why they cannot be pressed now, or that they can. */
function setWhy(button, why) {
  put($('small', button), why || button.dataset.sub || '');
  if (why) button.setAttribute('aria-disabled', 'true'); else button.removeAttribute('aria-disabled');
}
/* Sets what changed of a button that stays where it is, so that a finger on it is not lost. */
function setKey(button, text, { press = 0, why = '', sub = '', kind = '' } = {}) {
  fill($('span', button), text); put($('small', button), why || sub);
  const now = `${press} ${kind} ${!!why}`;
  if (button.now === now) return;
  button.now = now;
  button.dataset.press = press; button.className = `key ${kind}${button.classList.contains('down') ? ' down' : ''}`;
  if (why) button.setAttribute('aria-disabled', 'true'); else button.removeAttribute('aria-disabled');
}

/* Why nothing is known of the machine; nothing if it is. */
const unknown = () => ({ stale: 'state not known', none: 'no machine' })[S.state] || '';

/* ---- who operates */
S.may = 'look'; S.operates = false; S.asks = false; S.asked_for = false;
const may = role => S.may === 'operate' || S.may === role;
/* Why this page does not operate now; nothing if it does. */
const notOperating = () => S.may !== 'operate' ? `this page may only ${S.may}` : !S.operates ? 'another page operates' : '';
async function here(kind = 'here', more = {}) {
  const said = await order(kind, more, true);
  if (said.accepted) { S.operates = said.operates; S.asks = said.asks; S.asked_for = said.operates && said.asked; paintHands(); }
}
DEEDS['ask-seat'] = () => here('ask-seat');
DEEDS['give-seat'] = () => here('answer-seat', { give: true });
DEEDS['keep-seat'] = () => here('answer-seat', { give: false });
async function startHands() {
  // Without an answer this page could not even hold: it is asked for until there is one.
  for (;;) {
    try {
      const answer = await fetch('/api/may', { headers: { 'X-Glidepath-Token': TOKEN } });
      if (answer.ok) S.may = await answer.text();
      if (answer.ok || answer.status === 403) break;
    } catch { /* told by the age of what is shown */ }
    await new Promise(done => setTimeout(done, 500));
  }
  paintTabs(); paintHands();
  if (S.may !== 'operate') return;
  here(); fetchDevices();
  // One at a time: those that wait for a server that stands still would be in the way of a hold.
  let isSaid = true;
  setInterval(() => { if (isSaid) { isSaid = false; here(S.asks ? 'ask-seat' : 'here').finally(() => { isSaid = true; }); } }, 1000);
  addEventListener('pagehide', () => { if (S.operates) order('leave-seat', {}, true); });
}
/* The commands of texts, as the buttons of this page. */
const BUTTONS = { resume: 'Resume', hold: 'Hold', abort: 'Abort', reset: 'Reset', forward: 'Forward', enable: 'Power', home: 'Home', return: 'Return', acknowledge: 'the answer below' };
/* The views that these are in: no other one has them. */
const BUTTON_VIEWS = { enable: ['setup'], home: ['setup'], reset: ['operate', 'setup'], return: ['operate'], forward: ['operate'] };
const buttonOf = name => { const views = BUTTON_VIEWS[name]; return views && S.view !== 'glance' && !views.includes(S.view) ? `${BUTTONS[name]} (in ${VIEWS[views[0]]})` : BUTTONS[name]; };
const OVERRIDES = { '100': 'Feed at 100 %', '--rapid 100': 'Rapid at 100 %', '100 --rapid 100': 'Feed and Rapid at 100 %' };
const buttonWords = text => S.may !== 'operate' ? plain(String(text)) : String(text).replace(/`glidepath ([a-z-]+) ?([^`]*)`/g, (whole, name, more) =>
  (name === 'override' ? OVERRIDES[more.replace(/ --(config|instance) .*/, '')] : buttonOf(name)) || whole.replaceAll('`', ''));
