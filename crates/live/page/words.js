'use strict';
// What the machine does, in words: the word, the cause in a sentence, and what clears it.

/* state of the machine → icon, how much it concerns a person, colour; the word is the state's own name, as the status,
   the log and the manual have it */
const SIGNS = {
  idle: ['idle', 0, 'idle'], running: ['running', 0, 'running'], holding: ['hold', 1, 'held'], held: ['hold', 1, 'held'],
  starving: ['warn', 1, 'held'], starved: ['warn', 1, 'held'], 'program-stop': ['await', 2, 'await'], stopping: ['abort', 1, 'held'],
  faulted: ['fault', 3, 'fault'], waiting: ['stale', 0, 'idle'], awaiting: ['await', 2, 'await'], jogging: ['running', 1, 'held'],
  homing: ['home', 1, 'held'], off: ['power', 0, 'idle'], 'not-homed': ['home', 0, 'idle'], preparing: ['running', 0, 'idle'],
};
/* The same where there is no machine to name its state. */
const WORDS = { stale: ['stale', 'No contact', 3, 'stale'], none: ['stale', 'No machine', 0, 'stale'], file: ['plot', 'Plan', 0, 'running'] };
function wordsNow() {
  const s = S.status, own = WORDS[S.state];
  if (own) return own;
  const word = sentence(S.state.replaceAll('-', ' ')), [sign, level, colour] = SIGNS[S.state] || ['stale', 3, 'stale'];
  // The same state, where it concerns a person otherwise.
  if (S.state === 'running' && s.mode === 'backwards') return ['back', `${word}, backwards`, 1, 'held'];
  if (S.state === 'awaiting' && !s.asked) return ['stale', word, 0, 'idle'];
  if (isBlockEnd(s)) return ['step', word, 1, 'held'];
  return [sign, word, level, colour];
}
/* It rests because of single block, and not for a person. */
const isBlockEnd = s => S.state === 'program-stop' && s.single_block && !(s.asked && s.asked.says);
const isAway = s => Object.values(s.away || {}).some(x => Math.abs(x) > 1e-9);
const line = status => status.line ? `line ${status.line}${status.program_is_shown && S.shows && INFO.program && INFO.program.lines ? ` of ${grouped(INFO.program.lines)}` : ''}` : 'before its first line';
/* What the machine executes, or has executed last, whoever began it. */
function programName() {
  const s = S.status;
  if (!s) return '';
  return s.active_program ? s.active_program.name : s.job ? s.job.text.split(': ')[0] : '';
}

function cause() {
  const s = S.status;
  if (S.file) return fileWords();
  if (S.state === 'none') return `Nothing runs as “${INFO.machine.instance}”: glidepath interpolator starts it.`;
  if (S.state === 'stale' && S.refused && isDevice()) return 'This device is not paired, or not any more, and is told nothing. The machine may be moving.';
  if (S.state === 'stale' && S.refused) return 'The server of this page was begun anew, or does not know the page: open the address that it told. All below is old; the machine may be moving.';
  if (S.state === 'stale') return S.heard ? `Last heard ${Math.round((performance.now() - S.heard) / 1000)} s ago. All below is old; the machine may be moving.` : 'The page has not heard anything yet.';
  const name = programName(), program = name ? `${name}, ` : '';
  if (S.state === 'faulted') return `${sentence(s.fault || 'a fault')}.`;
  if (S.state === 'preparing' && s.job) return `${s.job.text}${s.job.begins_held ? '; it begins held' : ''}.`;
  if (S.state === 'awaiting' && s.asked) return `${program}line ${s.asked.line}: ${askedWords(s)}`;
  if (S.state === 'awaiting' && s.awaited) return `${program}${line(s)}: ${s.awaited.event} of line ${s.awaited.line} is awaited, for ${span(s.awaited.waited_s)}.`;
  // Where its panel is, the words of the program stand there.
  if (S.state === 'program-stop' && saysNow()) return `${program}${line(s)}: ${S.view === 'operate' ? S.may === 'operate' ? 'Resume goes on' : 'it waits to be resumed' : `“${saysNow()}”`}.`;
  if (isBlockEnd(s)) return `${program}${line(s)}: at rest at the end of a block, for single block${S.may === 'operate' ? '; Next block goes on' : ''}.`;
  if (S.state === 'held' && s.mode === 'backwards' && S.may === 'operate' && !isAway(s)) return `${program}${line(s)}: held at rest on the way back. Forward goes on to the end.`;
  // In these nothing of a program is under way.
  const alone = ['idle', 'preparing', 'off', 'not-homed', 'homing', 'jogging'].includes(S.state);
  const text = told(s.state_text || S.state);
  if (S.state === 'idle') return `${sentence(text)}.${leftWords(s)}`;
  if (alone) return `${sentence(text)}.`;
  // A telephone has no other place for it.
  if (S.view === 'glance' && unread(s)) return `${program}${line(s)}: “${unread(s)}”`;
  return program ? `${program}${line(s)}: ${text}.` : `${sentence(`${line(s)}: ${text}`)}.`;
}
/* What a machine at rest leaves open: a program that was not ended, and a spindle that turns. */
const turnsNow = s => !!s.spindle && ['clockwise', 'counterclockwise'].includes(s.spindle.turns);
/* The last program, if it did not come to its end. */
const brokenOff = s => { const job = (s.day || []).find(job => !job.name.startsWith('mdi ')); return job && (job.end === 'aborted' || job.end === 'fault') && job.line ? job : null; };
function leftWords(s) {
  const job = brokenOff(s);
  return `${turnsNow(s) ? ' The spindle turns.' : ''}${job ? ` ${job.name} ${job.end === 'fault' ? 'ended by a fault' : 'was aborted'} at line ${job.line}${S.may === 'operate' ? '; From line, in Programs, goes on' : ''}.` : ''}`;
}
/* Texts come from the machine: commands in backticks, no capital, no full stop. */
const plain = text => text.replaceAll('`', '');
/* A page that operates names its buttons. */
const told = text => S.file ? plain(text) : buttonWords(text);
const sentence = text => text.charAt(0).toUpperCase() + text.slice(1);
const marked = text => safe(text).replace(/`([^`]*)`/g, '<code>$1</code>');
function fileWords() {
  const r = INFO.report;
  if (!r) return '';
  const verdict = r.violations ? `${grouped(r.violations)} broken rules: see the report` : 'inside every limit';
  return `${INFO.program ? stem(INFO.program.name) : ''}: ${(r.path_mm / 1000).toFixed(2)} m, ${num(r.max_deviation_mm * 1000, 1)} of ${num(r.tolerance_mm * 1000, 0)} µm deviation, ${verdict}.${shapeWords(r.shape)}`;
}
/* How true the shape is: what is worth a word. */
function shapeWords(shape) {
  if (!shape) return '';
  const said = [[shape.below_depth, 'below the depth'], [shape.outside_corners, 'outside of corners'], [shape.beside_straight, 'beside straight cuts']]
    .filter(([met]) => met && met.mm >= 5e-5).map(([met, where]) => `${num(met.mm * 1000, 1)} µm ${where} (line ${met.line})`);
  return said.length ? ` At most ${said.join(', ')}.` : '';
}

/* What a program that waits for a person says: where it stops, and with a tool unless somebody has read it. */
function saysNow() {
  const s = S.status, asked = s && s.asked;
  return asked && asked.says && (asked.what === 'stop' || S.read !== messageOf(s)) ? asked.says : '';
}
/* What a program that runs has said, and nobody has read yet. */
const unread = s => s && s.message && s.end_of_epoch === 'open' && !(s.asked && s.asked.says) && S.read !== messageOf(s) ? s.message : '';
/* A message, and which program it is of. */
const messageOf = s => `${s.epoch} ${s.message}`;

/* A tool as people know it: its number, what the table calls it, diameter and length. */
const toolWords = tool => `T${tool.number}${tool.name ? ` ${tool.name}` : ''}`;
const toolSizes = tool => [tool.diameter_mm ? `Ø ${lengthText(tool.diameter_mm, 2)}` : '', tool.length_mm ? `length ${lengthText(tool.length_mm, 3)}` : ''].filter(Boolean).map((text, k, all) => k === all.length - 1 ? `${text} ${lengthUnit()}` : text).join(', ');
function askedWords(s) {
  const asked = s.asked, tool = asked.tools && asked.tools.wanted;
  if (!tool) return `${asked.code} waits for you.`;
  return tool.number ? `put ${toolWords(tool)} in the spindle.` : 'take the tool out of the spindle.';
}

/* What stands in place of the text of the program when a person is needed. */
function attention() {
  const s = S.status, hands = S.may === 'operate', steps = list => hands ? '' : `<ol>${list.map(text => `<li><span>${marked(text)}</span></li>`).join('')}</ol>`;
  if (S.state === 'faulted') return `<h2>${safe(sentence(s.fault || 'a fault'))}.</h2><p>${hands ? safe(sentence(told(s.fault_remedy || ''))) : marked(sentence(s.state_text || ''))}.</p>${steps(['Look at the tool and the part.', `At the machine: ${s.fault_remedy || '`glidepath reset`'}.`])}`;
  if (S.state === 'awaiting' && s.awaited) {
    const says = saysNow() ? `<p class="says">${safe(saysNow())}</p>` : '';
    const title = s.asked ? sentence(askedWords(s)) : `${sentence(s.awaited.event)} of line ${s.awaited.line} is awaited.`;
    return `<h2>${safe(title)}</h2>${exchange(s.asked)}${says}${s.asked ? steps([`When that is done: ${s.awaited.done_by}`, `If it cannot be done: ${s.awaited.failed_by}`]) : ''}`;
  }
  if (S.state === 'program-stop' && !isBlockEnd(s)) {
    const says = saysNow();
    return `<h2>The program stopped at ${line(s)}.</h2>${says ? `<p class="says">${safe(says)}</p>` : ''}${steps(['Do what the program stopped for.', 'Press Resume, here or at the machine.'])}`;
  }
  if (S.state === 'held' && isAway(s)) {
    const way = Object.entries(s.away).filter(([, x]) => Math.abs(x) > 1e-9).map(([name, x]) => `${nameOf(name)} ${place(axisOf(name), x)} ${unitOf(axisOf(name))}`).join(', ');
    return `<h2>The axes are off the path: ${way}.</h2><p>They go back to where the program was held before it goes on.</p>`;
  }
  return '';
}
/* The tool that comes out, and the one that goes in. */
function exchange(asked) {
  if (!asked || !asked.tools) return '';
  const box = (title, tool) => `<div><span class="lab">${title}</span><b>${tool && tool.number ? `T${tool.number}` : 'none'}</b><span>${tool ? safe(tool.name || '') : ''}</span><span>${tool ? toolSizes(tool) : ''}</span></div>`;
  const { before, wanted } = asked.tools;
  return `<div class="exchange">${before ? box('comes out', before) : ''}${wanted ? box('put in', wanted) : ''}</div>`;
}

/* What the page cannot paint, and what to do; nothing if it can. */
const unpainted = () => {
  const parts = Object.keys(S.unpainted).filter(part => S.unpainted[part]);
  return parts.length ? ` This page cannot paint everything (${parts.join(', ')}): load it again.` : '';
};
const paintWhy = () => put($('#why'), cause() + unpainted());

/* The band on top, and which commands there are. */
function paintState() {
  const [sign, word, level, colour] = wordsNow(), app = $('#app'), panel = S.file ? '' : attention();
  app.dataset.state = colour; app.dataset.level = level; app.dataset.machine = S.state; app.dataset.attn = panel ? 1 : 0;
  fill($('#sym'), icon(sign).replace('class="i "', ''));
  fill($('#word'), `${word}<span id="mach">${safe(INFO.machine.instance)}</span>`);
  paintWhy();
  if (S.file) return;
  const keys = panel ? attentionKeys() : '';
  fill($('#attn'), panel + (keys ? `<div class="row keysrow">${keys}</div>` : ''));
  document.title = `${level > 1 ? `${word} · ` : ''}${INFO.machine.instance} · Glidepath`;
  paintBar(); paintSays();
}
