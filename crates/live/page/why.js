'use strict';
// Why a place is slow, and what would make it faster: the server plans the program again with one thing changed, and says how long it
// would take. Nothing of that runs.

const WHY = { place: null, asked: 0, answers: {} };
/* What is changed, how many times as large, and how that is called. */
const CHANGES = [['tolerance', 2, 'tolerance × 2'], ['jerk', 2, 'jerk × 2'], ['feed', 1.2, 'feed + 20 %']];

/* What is known of a place in the plan, as `plan` tells it: the slow place that it belongs to, or what the plan has there. */
function whyAt(p) {
  const t = p * DT(), slow = INFO.report.slowest.find(place => t >= place.start_s && t <= place.start_s + place.duration_s);
  if (slow) return { p, line: slow.line, speed: slow.speed_mm_s, feed: slow.feed_mm_s, limit: slow.limit, lost_s: slow.lost_s };
  const bin = PLAN.bin(p), code = PLAN.code[bin], isRapid = !!(code & 128);
  return { p, line: PLAN.line[bin], speed: PLAN.feed.hi[bin], feed: isRapid ? Infinity : PLAN.programmed[bin], limit: isRapid ? 'rapid' : limitText(code), lost_s: 0 };
}
/* A limit with its value: that of the axis that it names. */
function limitWords(limit) {
  const [kind, name] = limit.split(' '), axis = AXES().find(axis => axis.name === name), k = ['velocity', 'acceleration', 'jerk'].indexOf(kind);
  if (axis && k >= 0) return `the ${kind} of ${name}, ${grouped(axis.limits[k])} ${axis.unit}/s${['', '²', '³'][k]}`;
  if (k >= 0 && /^J\d$/.test(name)) return `the ${kind} of joint ${name}`;
  if (limit === 'tolerance') return `the tolerance, ${num(INFO.report.tolerance_mm, 3)} mm`;
  if (limit === 'feed' || limit === LIMIT_WORDS.feed) return 'the programmed feed';
  return { none: 'no single limit', rest: 'a rest', rapid: 'the rapids of the axes', 'chord error': 'the chord error: the period is long for this curve' }[limit] || limit;
}
function showWhy(p) {
  if (!PLAN || !INFO.report) return;
  WHY.place = whyAt(p);
  S.box = $('#tune').dataset.box = 'slow';
  paintTune();
}
function whyBox() {
  const { line, speed, feed, limit, lost_s } = WHY.place, text = (LINES.get(line) || '').trim();
  const of = feed > 1e9 || !feed ? 'mm/s in a rapid' : `of ${num(feed, 1)} mm/s programmed`;
  const rows = CHANGES.map(([what, times, name]) => `<tr><td class="l">${name}</td>${answerCells(WHY.answers[`${what} ${times}`], PLAN.samples * DT())}</tr>`).join('');
  const asks = S.file ? '' : `<p class="lab-text"><button data-box="plan-again">Plan again</button> Only a look: what runs stays.</p><table class="what"><tr><th class="l">what if</th><th>whole program</th><th></th></tr><tr><td class="l">as it is</td><td class="n">${span(PLAN.samples * DT())}</td><td></td></tr>${rows}</table>`;
  return `<div class="h"><b>Line ${line}: ${num(speed, 1)} ${of}</b><button data-box="slow">list</button></div><pre class="lines">${safe(text) || ' '}</pre><p class="lab-text">Bound by <b>${safe(limitWords(limit))}</b>.${lost_s ? ` ${num(lost_s, 3)} s are lost there.` : ''}</p>${asks}`;
}
/* How long it would take, and how much less that is. */
function answerCells(answer, now_s) {
  if (!answer) return '<td class="n"></td><td></td>';
  if (answer.failed) return `<td colspan="2">${safe(answer.failed)}</td>`;
  if (answer.seconds === null) return `<td class="n">${span(answer.so_far_s)}</td><td>planned so far</td>`;
  const less = now_s - answer.seconds, none = Math.abs(less) < 0.05;
  return `<td class="n">${span(answer.seconds)}</td><td>${none ? 'the same' : `${num(Math.abs(less), 1)} s ${less > 0 ? 'less' : 'more'}`}</td>`;
}
/* Asks until it is known, or nobody wants to know it any more. */
async function whatIf(path, of, what, times, tell, isWanted) {
  while (isWanted()) {
    const answer = await api(`${path}?of=${of}&${what}=${times}`, 'json');
    if (!isWanted()) return;
    tell(answer || { failed: 'it cannot be planned now' });
    if (!answer || answer.failed || answer.seconds !== null) return;
    await new Promise(done => setTimeout(done, 250));
  }
}
/* One after the other: each takes a processor. */
async function planAgain() {
  const asked = ++WHY.asked, of = INFO.generation, isWanted = () => asked === WHY.asked && of === INFO.generation && S.view === 'tune' && !!WHY.place;
  for (const [what, times] of CHANGES) await whatIf('/api/what-if', of, what, times, answer => { WHY.answers[`${what} ${times}`] = answer; paintTune(); }, isWanted);
}
/* Another program, or another text of it. */
function forgetWhy() { WHY.place = null; WHY.answers = {}; WHY.asked++; }
