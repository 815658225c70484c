'use strict';
// What is wrong with the line that is being typed, before it is run: asked a moment after the last key, one line at a time. Nothing
// moves, and nothing is kept.

const JUDGED = { timer: 0, asks: false, of: null, found: null, seen: '' };
const WAIT_FOR_KEYS = 250;
const typedNow = () => $('#mdi').value;

/* A key was typed: what was said of another text is none of this one. */
function judgeSoon() {
  clearTimeout(JUDGED.timer);
  if (JUDGED.of !== typedNow()) { JUDGED.of = JUDGED.found = null; paintJudged(); }
  if (typedNow().trim() && !whyNoLine()) JUDGED.timer = setTimeout(judgeTyped, WAIT_FOR_KEYS);
}
async function judgeTyped() {
  // One is on its way already: this one is asked behind it.
  if (JUDGED.asks) return;
  const line = typedNow();
  if (!line.trim() || whyNoLine() || JUDGED.of === line) return;
  JUDGED.asks = true;
  const said = await api(`/api/judge?line=${encodeURIComponent(line.trim())}`, 'json');
  JUDGED.asks = false;
  if (line !== typedNow()) { judgeSoon(); return; }
  // What nobody could say is asked again with the next key.
  if (!said || !said.known) return;
  JUDGED.of = line; JUDGED.found = said.finding;
  paintJudged();
}
/* The same line may mean something else with another part zero, or after another line. */
function judgeAnew() {
  const [job = {}] = S.status && S.status.page_jobs || [], seen = [setUpVersion, S.state, notOperating(), job.at_ms, job.state].join();
  if (seen === JUDGED.seen) return;
  JUDGED.seen = seen; JUDGED.of = null;
  judgeSoon();
}
/* A sentence begins large; a character of the line that is told of stays as it is. */
const begun = text => /^[a-z]+[ ,]/.test(text) ? sentence(text) : text;
/* What, where, why, and how to mend it. */
function paintJudged() {
  const found = JUDGED.found;
  if (!found) { fill($('#judged'), ''); return; }
  const [before, mark, behind] = found.text, where = found.file ? `${stem(found.file)}, line ${found.line}` : `Column ${found.column}`;
  const sentences = [found.message, found.reason, found.help].filter(Boolean).map(text => `${begun(plain(text))}.`);
  fill($('#judged'), `<p><b>${safe(sentences[0])}</b> ${safe(sentences.slice(1).join(' '))}</p><pre class="lines"><span class="lab">${safe(where)}</span> ${safe(before)}<mark>${safe(mark) || ' '}</mark>${safe(behind)}</pre>`);
}
function layJudged() { $('#mdi').addEventListener('input', judgeSoon); }
