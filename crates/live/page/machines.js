'use strict';
// The other machines of this host that are listed: what each does, and the way to its page.

const HOST = { asks: false };
/* Icon, how much it concerns a person, colour and word. */
function signOf(state) {
  const own = WORDS[state], [sign, level, colour] = own ? [own[0], own[2], own[3]] : SIGNS[state] || ['stale', 3, 'stale'];
  return { sign, level, colour, word: own ? own[1] : sentence(state.replaceAll('-', ' ')) };
}
function machineKey({ instance, state, program, left_s, url }) {
  const { sign, colour, word } = signOf(state), left = left_s === null ? '' : `, ${span(left_s)} left`;
  const way = url ? `href="${safe(url)}"` : '', title = program ? `title="${safe(program)}"` : '';
  return `<a data-state="${colour}" aria-label="${safe(`${instance}: ${word}`)}" ${way} ${title}>${icon(sign)}<b>${safe(instance)}</b><span>${safe(word)}${left}</span></a>`;
}
async function fetchMachines() {
  if (isDevice() || document.hidden || HOST.asks) return;
  HOST.asks = true;
  const known = await api('/api/machines', 'json');
  HOST.asks = false;
  const element = $('#machines'), before = element.offsetHeight, urgent = (a, b) => signOf(b.state).level - signOf(a.state).level;
  fill(element, known ? known.machines.sort(urgent).map(machineKey).join('') : '');
  if (element.offsetHeight !== before) { SPACE.stale = true; redraw(); }
}
/* In a row above everything else; where the screen is not high enough for that, in the bar. */
function placeMachines() {
  const element = $('#machines'), isLow = innerHeight < 641;
  if (isLow !== (element.parentElement === $('#bar'))) { if (isLow) $('#mode').before(element); else document.body.prepend(element); }
}
placeMachines();
addEventListener('resize', placeMachines);
setInterval(fetchMachines, 2000);
