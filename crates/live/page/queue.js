'use strict';
// The queue: programs that a person starts one after the other, with another part on the machine each time. Nothing begins by itself: when
// one has ended well, the next is looked at, and can be started.

const QUEUE = { head: 0, info: null, lost: '', timer: 0 };
const queued = () => S.status && S.status.queue || [];
/* The one that is the next to be started; nothing while one of them runs. */
const nextQueued = () => { const head = queued()[0]; return head && head.state !== 'runs' ? head : null; };

/* Looks at the next one, once it is another. */
function loadNext() {
  const next = nextQueued(), id = next ? next.id : 0;
  if (id === QUEUE.head) return;
  Object.assign(QUEUE, { head: id, info: null, lost: '' });
  if (next) lookAtNext(next, 'first');
}
async function lookAtNext(next, look) {
  clearTimeout(QUEUE.timer);
  const { info = null, lost = '' } = await preview(next.name, look);
  if (QUEUE.head !== next.id) return;
  QUEUE.info = info; QUEUE.lost = lost;
  // What would be started has to stay what is looked at, and may be given up for others.
  const isKnown = info && (info.report || info.failed);
  QUEUE.timer = setTimeout(() => lookAtNext(next, lost ? 'first' : 'again'), isKnown ? 3000 : 500);
}
const whyNoStart = () => notOperating() || (QUEUE.info && QUEUE.info.fingerprint ? '' : QUEUE.lost ? 'it cannot be looked at' : 'it is read') || whyNotReady();
const nextTime = () => { const info = QUEUE.info, next = nextQueued(), own = next && next.tolerance_ratio !== 1 ? ' with its own tolerance' : ''; return !info ? '' : info.failed ? 'something was found in it: look at it' : info.seconds ? `${span(info.seconds)} of motion at 100 %${own}` : `is planned: ${span(info.planned_so_far_s || 0)} so far`; };
const startKey = next => key('queue-start', `Start ${safe(next.name)}`, { press: SHORT, why: whyNoStart(), sub: `press ½ s${ofRatio(next.tolerance_ratio)}`, data: `data-entry="${next.id}"`, kind: whyNoStart() || (QUEUE.info && QUEUE.info.failed) ? '' : 'main' });
DEEDS['queue-start'] = async b => {
  const next = nextQueued();
  if (!next || next.id !== +b.dataset.entry || whyNoStart()) return;
  if (await runLooked(next.name, { queued: next.id, tolerance_ratio: next.tolerance_ratio }, QUEUE.info) === 'anew') lookAtNext(next, 'anew');
};
/* Where the machine is at rest, the next one stands in the place of the text of the program. */
function nextPanel() {
  const next = nextQueued();
  if (!next || S.state !== 'idle') return '';
  return `${startKey(next)}<p>${next.state === 'ended' ? `It has ended: ${safe(buttonWords(next.text))}.` : 'Next in the queue. Change the part first.'} <span class="lab">${safe(nextTime())}</span></p>`;
}
/* ---- the list */
DEEDS['queue-add'] = b => order('queue-add', { name: b.dataset.name, tolerance_ratio: LOOK.ratio });
DEEDS['queue-up'] = b => order('queue-move', { entry: +b.dataset.entry, to: +b.dataset.to });
DEEDS['queue-down'] = DEEDS['queue-up'];
DEEDS['queue-remove'] = b => order('queue-remove', { entry: +b.dataset.entry });
const QUEUE_WORDS = { waits: 'waits', runs: 'runs', ended: 'ended' };
function queueList() {
  const all = queued(), not = notOperating();
  if (!all.length) return '<div class="h"><b>Queue</b></div><p class="lab-text">None waits. Queue puts a program here; each is started by hand.</p>';
  const row = (entry, k) => {
    const why = not || (entry.state === 'runs' ? 'it runs' : ''), small = (deed, text, to, name, none) => `<button class="key small" data-do="${deed}" data-press="0" data-entry="${entry.id}" data-to="${to}" aria-label="${name} ${safe(entry.name)}" ${why || none ? 'aria-disabled="true"' : ''}><i class="fill"></i><span>${text}</span></button>`;
    return `<div class="queued" data-state="${entry.state}"><span class="n">${k + 1}</span><span><b>${safe(entry.name)}</b> <span class="lab">${QUEUE_WORDS[entry.state]}${ofRatio(entry.tolerance_ratio)}${entry.text ? `: ${safe(buttonWords(entry.text))}` : ''}</span></span>${small('queue-up', '▲', k - 1, 'earlier:', k === 0)}${small('queue-down', '▼', k + 1, 'later:', k === all.length - 1)}${small('queue-remove', '✕', 0, 'remove', false)}</div>`;
  };
  const next = nextQueued();
  return `<div class="h"><b>Queue</b><span>each is started by hand</span></div>${next ? `<div class="row">${startKey(next)}<span class="lab">${safe(nextTime())}</span></div>` : ''}${all.map(row).join('')}`;
}
