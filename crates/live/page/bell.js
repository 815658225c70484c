'use strict';
// The call for a person: by sound, by a notification where nobody looks at the page, and by the icon of its tab.

const AGAIN = 30000;
/* How somebody is called, one after the other as the key is pressed. */
const CALLS = { sound: 'by sound', all: 'by sound and notification', off: 'not at all' };
const BELL = { how: 'sound', sound: null, cause: '', rang: 0, count: 0, icon: '', button: null };
ICONS.bell = 'M12 1.5c-4 0-7 3-7 7.5v5l-3 4v1h20v-1l-3-4V9c0-4.5-3-7.5-7-7.5zM9 20.5a3 3 0 0 0 6 0z';
ICONS['bell-off'] = `${ICONS.bell}M1.5 3.5l2-2 19 19-2 2z`;
ICONS['bell-all'] = `${ICONS.bell}M19 .5h4.5V5H19z`;

/* What a person is needed for; nothing if nobody is. One cause is one text. */
function neededFor() {
  const s = S.status, level = wordsNow()[2];
  if (level < 2 || !s) return '';
  return S.state === 'stale' ? 'stale' : `${S.state} ${s.epoch} ${s.awaited ? s.awaited.sequence : s.line}`;
}
/* Looks whether somebody is needed. This goes on where the page is not in sight, and nothing is drawn. */
function callPerson() {
  growOld();
  if (document.hidden) paintState();
  paintIcon();
  const cause = neededFor(), isNew = cause !== BELL.cause;
  BELL.cause = cause;
  if (!cause || BELL.how === 'off') return;
  // Contact may be lost for good.
  if (isNew || (cause !== 'stale' && performance.now() - BELL.rang > AGAIN)) ring();
}
function ring() {
  BELL.count++; BELL.rang = performance.now();
  const { sound } = BELL;
  if (sound && sound.state === 'running') {
    [880, 660, 880].forEach((pitch, k) => {
      const tone = sound.createOscillator(), loud = sound.createGain(), at = sound.currentTime + k * 0.25;
      tone.frequency.value = pitch;
      loud.gain.setValueAtTime(0, at); loud.gain.linearRampToValueAtTime(0.3, at + 0.02); loud.gain.linearRampToValueAtTime(0, at + 0.22);
      tone.connect(loud).connect(sound.destination);
      tone.start(at); tone.stop(at + 0.24);
    });
  }
  if (BELL.how === 'all' && document.hidden && window.Notification && Notification.permission === 'granted') new Notification(`${INFO.machine.instance}: ${wordsNow()[1]}`, { body: cause(), tag: 'glidepath' });
}
/* The icon of the tab is the sign of the state, in its colour. */
function paintIcon() {
  const [sign, , , colour] = wordsNow(), of = { running: 'run', held: 'hold', await: 'wait', fault: 'fault' }[colour], now = `${sign} ${colour} ${T.dark}`;
  if (now === BELL.icon) return;
  BELL.icon = now;
  const canvas = document.createElement('canvas'), c = canvas.getContext('2d');
  canvas.width = canvas.height = 32;
  c.fillStyle = of ? T.css[of] : T.css.quiet; c.fillRect(0, 0, 32, 32);
  c.fillStyle = of === 'wait' ? '#0f1a1c' : T.css.panel; c.translate(4, 4); c.fill(new Path2D(ICONS[sign]), 'evenodd');
  $('link[rel=icon]').href = canvas.toDataURL();
}
function paintBell() {
  // A browser lets a page sound once somebody has touched it.
  const heard = BELL.sound && BELL.sound.state === 'running', how = BELL.how;
  const words = `a person is called ${CALLS[how]}${how !== 'off' && !heard ? ', once this page was touched' : ''}`;
  fill(BELL.button, icon(how === 'off' ? 'bell-off' : how === 'all' ? 'bell-all' : 'bell', how !== 'off' && !heard ? 'faint' : ''));
  BELL.button.title = words; BELL.button.setAttribute('aria-label', words);
}
DEEDS.bell = async () => {
  const all = Object.keys(CALLS);
  BELL.how = all[(all.indexOf(BELL.how) + 1) % all.length];
  if (BELL.how === 'all' && window.Notification && Notification.permission === 'default') await Notification.requestPermission();
  if (BELL.how === 'all' && !(window.Notification && Notification.permission === 'granted')) BELL.how = 'off';
  try { localStorage.setItem('glidepath-bell', BELL.how); } catch { /* for this time */ }
  paintBell();
};
function layBell() {
  try { BELL.how = localStorage.getItem('glidepath-bell') || 'sound'; } catch { /* as it is without */ }
  if (!CALLS[BELL.how]) BELL.how = 'sound';
  BELL.button = document.createElement('button');
  Object.assign(BELL.button, { className: 'tool bell', id: 'bell' });
  BELL.button.dataset.do = 'bell';
  $('#themer').before(BELL.button);
  const wake = () => {
    if (!BELL.sound && window.AudioContext) { BELL.sound = new AudioContext(); BELL.sound.onstatechange = paintBell; }
    if (BELL.sound && BELL.sound.state === 'suspended') BELL.sound.resume();
  };
  for (const kind of ['pointerdown', 'keydown']) addEventListener(kind, wake);
  paintBell();
  setInterval(callPerson, 500);
}
