'use strict';
// The course of a program over its time: its sections by name and tool, and the moments at which it needs a person. Its places are
// frames of the plan.

const NO_COURSE = { sections: [], moments: [], more_sections: 0, more_moments: 0 };
const courseOf = info => info && info.report && info.report.course || NO_COURSE;
/* That of the plan that is shown. */
const courseNow = () => !PLAN ? NO_COURSE : courseOf(S.view === 'programs' ? LOOK.info : INFO);

/* A section as people know it: its name, the tool that it begins with. */
const sectionTool = section => section.tool === null ? '' : `T${section.tool}${section.tool_name ? ` ${section.tool_name}` : ''}`;
const sectionName = section => section.name || sectionTool(section);
const sectionWords = section => [section.name, sectionTool(section)].filter(Boolean).join(', ');
/* The section of a place; nothing in front of the first. */
function sectionAt(p) {
  const all = courseNow().sections;
  let at = -1;
  while (at + 1 < all.length && all[at + 1].place <= p) at++;
  return all[at];
}

/* ---- when a person is needed */
/* Where the plan waits for one, behind a place; its end is the last. `null` where more were found than are told. */
function nextMoment(p) {
  const { moments, more_moments } = courseNow(), s = S.status, second = 1 / DT();
  // The one that is being answered is not to come.
  const isNow = m => !!s && ['awaiting', 'program-stop'].includes(S.state) && Math.abs(m.place - p) < second && (!s.asked || m.line === s.asked.line);
  const next = moments.find(m => m.place > p && !isNow(m));
  return next || (more_moments ? null : { place: PLAN.samples - 1, what: 'end' });
}
/* A time as people say it. */
function inWords(seconds) {
  const s = Math.max(0, Math.round(seconds));
  if (s < 60) return `${s} s`;
  return s < 3600 ? `${Math.floor(s / 60)} min ${s % 60} s` : `${Math.floor(s / 3600)} h ${Math.floor(s / 60) % 60} min`;
}
/* How long a part of the plan takes by the overrides in force, in samples, as the server counts the time left: feeds and rapids
   obey their own, a rest none. */
function lasting(from, to) {
  const s = S.status, [feeds, rapids, rests] = PLAN.obeying(from, to), part = (samples, ratio) => samples > 0 ? samples / ratio : 0;
  return (part(feeds, Math.abs(s.feed_override)) + part(rapids, s.rapid_override) + rests) / Math.abs(s.adaptive_feed);
}
/* Seconds to a place of the plan, its end unless one is given, by the overrides in force; `null` where nobody knows. The server
   tells how many there are to the end. */
function secondsTo(place) {
  const s = S.status, end = PLAN && S.shows && s.place !== null ? PLAN.samples - 1 : 0;
  if (s.left_s === null || s.left_s === undefined || s.end_of_epoch !== 'open') return null;
  if (place === undefined || place >= end && end > 0) return s.left_s;
  const seconds = S.p < end ? s.left_s * lasting(S.p, Math.max(S.p, place)) / lasting(S.p, end) : NaN;
  return Number.isFinite(seconds) ? seconds : null;
}
/* What is needed next, and when. */
function needsWords() {
  const s = S.status;
  if (!PLAN || !s || S.state === 'stale' || !S.shows || s.end_of_epoch !== 'open' || s.place === null) return '';
  const next = nextMoment(S.p), seconds = next && secondsTo(next.place);
  return !next ? '' : seconds === null ? next.what : `${next.what} in ${inWords(seconds)}`;
}
function paintNeeds() {
  const words = needsWords();
  put($('#needs'), words); put($('#g-needs'), words);
}

/* ---- on the ribbon */
/* A text with as much of it as there is room for. */
function cutText(c, text, width) {
  if (c.measureText(text).width <= width) return text;
  let few = 0, many = text.length;
  while (few < many) { const half = (few + many + 1) >> 1; if (c.measureText(`${text.slice(0, half)}…`).width <= width) few = half; else many = half - 1; }
  return few ? `${text.slice(0, few)}…` : '';
}
/* How high the strip of their names is: a low ribbon has no room for one. */
const LOW = 80;
const stripHigh = (em, h) => h >= LOW && courseNow().sections.length ? em + 4 : 0;
function drawSections(c, X, { em, end, p, strip, bottom }) {
  const all = courseNow().sections, high = strip ? em + 2 : bottom - 5;
  c.font = `${em - 1}px B612`; c.textAlign = 'left';
  all.forEach((section, k) => {
    const from = X(section.place), to = k + 1 < all.length ? X(all[k + 1].place) : end, wide = to - from, next = k + 1 < all.length ? all[k + 1].place : Infinity;
    c.fillStyle = T.css.faint;
    if (strip && p >= section.place && p < next) c.fillRect(from, 1, wide, high);
    c.fillStyle = T.css.line; c.fillRect(from, strip ? 1 : 5, 1, high);
    if (!strip || wide < 2 * em) return;
    c.fillStyle = T.css.ink; c.fillText(cutText(c, sectionName(section), wide - 8), from + 4, 2 + high / 2);
  });
}
/* Where a person is needed: a pole each, and a flag where there is room for its words. */
function drawMoments(c, X, { em, top, bottom }) {
  let free = -Infinity;
  c.font = `bold ${em - 2}px B612`; c.textAlign = 'left';
  for (const moment of courseNow().moments) {
    const x = X(moment.place), text = moment.what.replace('M6 ', ''), wide = c.measureText(text).width + 8;
    c.fillStyle = T.css.ink; c.fillRect(x - 0.75, top - 2, 1.5, bottom - top + 2);
    if (x < free) continue;
    // At the end of the ribbon a flag flies back.
    const left = x + wide > RIBBON.left + RIBBON.width + 14 ? x - wide : x;
    free = left + wide + 2;
    c.fillStyle = T.css.wait; c.fillRect(left, top - 2, wide, em);
    c.strokeStyle = T.css.ink; c.lineWidth = 1; c.strokeRect(left, top - 2, wide, em);
    c.fillStyle = T.css['on-wait']; c.fillText(text, left + 4, top - 2 + em / 2);
  }
}
/* The whole of what is cut, under the pointer. */
function titleOf(p) {
  const section = p === null ? null : sectionAt(p), near = PLAN ? 6 / RIBBON.width * PLAN.samples : 0;
  const moment = p === null ? null : courseNow().moments.find(m => Math.abs(m.place - p) < near);
  return [section && sectionWords(section), moment && `${moment.what}, line ${moment.line}: it waits for a person`].filter(Boolean).join('; ');
}

/* ---- in the list of a program */
const MOST_LISTED = 100;
/* The sections of a program that is looked at, each with when it begins and how long it takes. */
function sectionList(info) {
  const { sections: all, more_sections } = courseOf(info), end = info.seconds / DT(), listed = all.slice(0, MOST_LISTED), more = all.length - listed.length + more_sections;
  if (!all.length || !info.seconds) return '';
  const row = (section, k) => `<tr><td class="n">${span(section.place * DT())}</td><td class="l name" title="${safe(sectionWords(section))}">${safe(sectionName(section))}</td><td class="l name" title="${safe(sectionTool(section))}">${section.name ? safe(sectionTool(section)) : ''}</td><td class="n">${section.line}</td><td class="n">${span(((k + 1 < all.length ? all[k + 1].place : end) - section.place) * DT())}</td></tr>`;
  return `<table class="sections"><tr><th>at</th><th class="l">section</th><th class="l">tool</th><th>line</th><th>takes</th></tr>${listed.map(row).join('')}</table>${more > 0 ? `<p class="lab-text">And ${grouped(more)} more.</p>` : ''}`;
}
/* The sections as keys: where each begins is the line to begin at, and of one that comes again, which time. */
function sectionKeys(info) {
  const times = new Map(), again = line => { times.set(line, (times.get(line) || 0) + 1); return times.get(line); };
  const keys = (info ? courseOf(info).sections : []).slice(0, MOST_LISTED).map(section => [section, again(section.line)]);
  const keyOf = ([section, pass]) => `<button class="choice" data-do="take-line" data-line="${section.line}" data-pass="${pass}" title="${safe(sectionWords(section))}"><b>${safe(sectionName(section))}</b><span class="lab">line ${section.line}${pass > 1 ? `, pass ${pass}` : ''}</span></button>`;
  return keys.length ? `<div class="section-keys" role="group" aria-label="sections">${keys.map(keyOf).join('')}</div>` : '';
}
/* When it needs a person, while it is looked at. */
function momentList(info) {
  const { moments, more_moments } = courseOf(info), told = moments.slice(0, 12), more = moments.length - told.length + more_moments;
  return told.length ? `<p class="needs-list"><span class="lab">Needs you at</span> ${told.map(m => `<b>${span(m.place * DT())}</b> ${safe(m.what)}`).join(', ')}${more > 0 ? `, and ${grouped(more)} more times` : ''}.</p>` : '';
}
