'use strict';
// What the machine does, in words: the word, the cause in a sentence, and what clears it.

/* state of the machine → icon, word, how much it concerns a person, colour */
const WORDS = {
  idle: ['idle', 'Ready', 0, 'idle'], running: ['running', 'Running', 0, 'running'], holding: ['hold', 'Holding', 1, 'held'], held: ['hold', 'Held', 1, 'held'],
  starving: ['warn', 'Slowing', 1, 'held'], starved: ['warn', 'Waiting', 1, 'held'], 'program-stop': ['hold', 'Program stop', 2, 'await'], stopping: ['hold', 'Stopping', 1, 'held'],
  faulted: ['fault', 'Fault', 3, 'fault'], waiting: ['hold', 'Waiting', 0, 'idle'], awaiting: ['await', 'Waiting', 2, 'await'], jogging: ['running', 'By hand', 1, 'held'],
  homing: ['running', 'Homing', 1, 'held'], off: ['idle', 'Off', 0, 'idle'], 'not-homed': ['idle', 'Not homed', 0, 'idle'], preparing: ['running', 'Preparing', 0, 'idle'],
  stale: ['stale', 'No data', 3, 'stale'], none: ['stale', 'No machine', 0, 'stale'], file: ['plot', 'Plan', 0, 'running'],
};
const line = status => status.line ? `line ${status.line}${INFO.program && INFO.program.lines ? ` of ${grouped(INFO.program.lines)}` : ''}` : 'before its first line';

function cause() {
  const s = S.status;
  if (S.file) return fileWords();
  if (S.state === 'none') return `Nothing runs as “${INFO.machine.instance}”: glidepath interpolator starts it.`;
  if (S.state === 'stale') return S.heard ? `Last heard ${Math.round((performance.now() - S.heard) / 1000)} s ago. All below is old; the machine may be moving.` : 'The page has not heard anything yet.';
  const program = s.program ? `${stem(s.program)}, ` : '';
  if (S.state === 'faulted') return `${sentence(s.fault || 'a fault')}.`;
  if (S.state === 'awaiting' && s.awaited) return `${program}${line(s)}: ${s.awaited.event} of line ${s.awaited.line} is awaited, for ${span(s.awaited.waited_s)}.`;
  // In these nothing of a program is under way.
  const alone = ['idle', 'preparing', 'off', 'not-homed', 'homing', 'jogging'].includes(S.state);
  return `${sentence(`${alone ? '' : `${program}${line(s)}: `}${plain(s.state_text || S.state)}`)}.`;
}
/* Texts come from the machine: commands in backticks, no capital, no full stop. */
const plain = text => text.replaceAll('`', '');
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

/* What stands in place of the text of the program when a person is needed. */
function attention() {
  const s = S.status;
  if (S.state === 'faulted') return `<h2>${safe(sentence(s.fault || 'a fault'))}</h2><p>${marked(sentence(s.state_text || ''))}.</p><ol><li><span>Look at the tool and the part.</span></li><li><span>At the machine: ${marked(s.fault_remedy || '`glidepath reset`')}.</span></li></ol>`;
  if (S.state === 'awaiting' && s.awaited) return `<h2>${safe(sentence(s.awaited.event))} of line ${s.awaited.line}</h2><p>The program waits until what it asked for is done${s.tool ? `; tool T${s.tool} is selected` : ''}. When it is:</p><ol><li><span>${marked(s.awaited.done_by)}</span></li><li><span>or, if it cannot be done: ${marked(s.awaited.failed_by)}</span></li></ol>`;
  if (S.state === 'program-stop') return `<h2>The program stopped at ${line(s)}</h2><p>${safe(s.last_event || '')}</p><ol><li><span>Do what the program stopped for.</span></li><li><span>Press Resume, here or at the machine.</span></li></ol>`;
  return '';
}

/* The band on top, and which commands there are. */
function paintState() {
  const [sign, word, level, colour] = WORDS[S.state] || WORDS.stale, app = $('#app');
  app.dataset.state = colour; app.dataset.level = level; app.dataset.cmd = S.commands ? 1 : 0; app.dataset.machine = S.state;
  fill($('#sym'), icon(sign).replace('class="i "', ''));
  fill($('#word'), `${word}<span id="mach">${safe(INFO.machine.instance)}</span>`);
  put($('#why'), cause());
  fill($('#attn'), attention());
  if (S.file) return;
  const can = {
    hold: ['running', 'starving', 'starved', 'preparing'].includes(S.state), resume: ['held', 'program-stop'].includes(S.state),
    step: ['held', 'program-stop'].includes(S.state), abort: !['idle', 'stale', 'none', 'off', 'not-homed', 'faulted', 'stopping'].includes(S.state),
  };
  const names = { hold: 'Hold', resume: 'Resume', step: 'Step', abort: 'Abort' }, icons = { hold: 'hold', resume: 'running', step: 'step', abort: 'abort' };
  fill($('#cmd'), Object.keys(names).map(name => `<button data-c="${name}" ${S.commands && can[name] ? '' : 'disabled'} class="${can[name] && (name === 'hold' || name === 'resume') ? 'main' : ''}">${icon(icons[name])}${names[name]}</button>`).join(''));
  fill($('#mode'), S.refusal ? `${icon('warn', 'warn')}<span>${safe(S.refusal)}</span>`
    : S.commands ? '<span>Commands are on.<br>Not for emergencies.</span>' : `<span class="big">${icon('lock')}</span><span>Read only.<br>Commands are off.</span>`);
}
