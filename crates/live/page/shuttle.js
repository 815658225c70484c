'use strict';
// The shuttle: in a hold, the ribbon is pressed for half a second and dragged, and the tool follows along the path, back and onward to where
// it was held. Every 50 ms the server is told that the finger is still down; whatever dies in between, the machine holds.

const SHUTTLE = { gesture: null, press: 0, timer: 0, pointer: null, epoch: 0, farthest: 0, troubles: null };
/* How much of the way is left, s, at which the tool goes at full speed. */
const FULL_SPEED_S = 0.8;
/* Nearer than this it is there, s. */
const THERE_S = 0.03;

/* Whether the ribbon is a shuttle now. */
function canShuttle() {
  const s = S.status;
  return S.view === 'operate' && PLAN && s && s.place !== null && s.program_is_shown && !notOperating() && !isAway(s) && (S.state === 'held' || !!SHUTTLE.gesture);
}
/* How far onward it goes: to where the path was held first. */
function farthest() {
  const s = S.status;
  if (SHUTTLE.epoch !== s.epoch || (S.state === 'running' && !SHUTTLE.gesture && s.mode !== 'backwards')) { SHUTTLE.epoch = s.epoch; SHUTTLE.farthest = 0; }
  if (S.state === 'held') SHUTTLE.farthest = Math.max(SHUTTLE.farthest, S.p);
  return SHUTTLE.farthest;
}
function pressShuttle(e) {
  if (!canShuttle() || SHUTTLE.pointer !== null || e.button) return;
  farthest();
  SHUTTLE.pointer = e.pointerId; SHUTTLE.from = e.clientX;
  try { $('#ribbon').setPointerCapture(e.pointerId); } catch { /* a pointer that is gone */ }
  SHUTTLE.pressed = performance.now();
  SHUTTLE.press = setTimeout(beginShuttle, SHORT);
  dirty.ribbon = true;
}
function beginShuttle() {
  if (!canShuttle()) { endShuttle(); return; }
  SHUTTLE.gesture = { id: Math.floor(Math.random() * 2 ** 48), number: 0, at: S.p, target: S.p, told: performance.now(), under_way: 0, is_heard: false };
  S.drags = true;
  SHUTTLE.from = SHUTTLE.now === undefined ? SHUTTLE.from : SHUTTLE.now;
  SHUTTLE.timer = setInterval(tellShuttle, SIGN);
  dirty.ribbon = true;
}
function dragShuttle(e) {
  if (e.pointerId !== SHUTTLE.pointer) return;
  SHUTTLE.now = e.clientX;
  const gesture = SHUTTLE.gesture;
  if (!gesture) return;
  gesture.target = Math.max(0, Math.min(SHUTTLE.farthest, gesture.at + (e.clientX - SHUTTLE.from) / RIBBON.width * (PLAN.samples - 1)));
  dirty.ribbon = true;
}
/* Which way, and what part of the speed of the plan: the slower the nearer, so that it comes to rest there. */
function shuttleSpeed(target, now) {
  const way_s = (target - now) * DT();
  return Math.abs(way_s) < THERE_S ? 0 : Math.max(-1, Math.min(1, Math.sign(way_s) * Math.max(0.05, Math.abs(way_s) / FULL_SPEED_S)));
}
async function tellShuttle() {
  const gesture = SHUTTLE.gesture;
  if (!gesture) return;
  const now = performance.now();
  // A page that did not run for a while does not know whether the finger is still down.
  if (now - gesture.told > STALL || unknown() || notOperating() || !['held', 'holding', 'running'].includes(S.state)) { endShuttle(); return; }
  gesture.told = now;
  // A browser has six connections to a server: hold needs one.
  if (gesture.under_way > 1) return;
  gesture.under_way++;
  const said = await order('shuttle', { gesture: gesture.id, number: ++gesture.number, at_ms: now, speed: shuttleSpeed(gesture.target, S.p) }, true);
  gesture.under_way--;
  if (!said.accepted && SHUTTLE.gesture === gesture) { endShuttle(); refuse(buttonWords(said.reason)); }
}
function endShuttle() {
  clearTimeout(SHUTTLE.press); clearInterval(SHUTTLE.timer);
  const gesture = SHUTTLE.gesture;
  SHUTTLE.gesture = SHUTTLE.pointer = null; SHUTTLE.now = undefined;
  S.drags = false;
  dirty.ribbon = dirty.path = true;
  if (gesture) order('shuttle-end', { gesture: gesture.id }, true);
}
/* What the server could not do is told once. */
function judgeShuttle() {
  const told = S.status && S.status.shuttle;
  if (!told) return;
  if (SHUTTLE.troubles !== null && told.troubles > SHUTTLE.troubles) { endShuttle(); refuse(buttonWords(told.trouble)); }
  SHUTTLE.troubles = told.troubles;
  // The server took it up, and did not hear of it for too long: only a finger that comes down again moves anything.
  const gesture = SHUTTLE.gesture;
  if (!gesture) return;
  if (told.gesture === gesture.id) gesture.is_heard = true; else if (gesture.is_heard) endShuttle();
}
function layShuttle() {
  const element = $('#ribbon');
  element.addEventListener('pointerdown', pressShuttle);
  element.addEventListener('pointermove', dragShuttle);
  for (const end of ['pointerup', 'pointercancel', 'lostpointercapture']) element.addEventListener(end, e => { if (e.pointerId === SHUTTLE.pointer) endShuttle(); });
  for (const end of ['blur', 'pagehide']) addEventListener(end, endShuttle);
  document.addEventListener('visibilitychange', endShuttle);
}
/* The handle, the way that it may go, and where the tool is to go. */
function drawShuttle(c, X, { top, bottom, p }) {
  if (!canShuttle()) return '';
  const end = farthest(), x = X(p), gesture = SHUTTLE.gesture;
  c.fillStyle = T.css.hold; c.globalAlpha = 0.16; c.fillRect(X(0), top - 6, X(end) - X(0), bottom - top + 6); c.globalAlpha = 1;
  c.fillRect(X(end) - 1, top - 6, 2, bottom - top + 6);
  c.fillRect(x - 11, bottom - 5, 22, 15); c.fillStyle = T.css.panel;
  for (const d of [-4, 0, 4]) c.fillRect(x + d - 0.75, bottom - 2, 1.5, 9);
  if (gesture) { c.strokeStyle = T.css.hold; c.lineWidth = 3; c.strokeRect(X(gesture.target) - 12, top - 6, 24, bottom - top + 14); }
  return gesture ? 'the tool follows along the path; let go, and it holds' : SHUTTLE.pointer !== null ? 'keep pressed …' : 'press for ½ s, then drag: the tool follows, back and onward';
}
