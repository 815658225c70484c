'use strict';
// Paired devices. The panel lists them, and shows the code by which one is paired; a device sends the code, and keeps a token of
// its own in its browser.

const DEVICES = { known: null, said: '', names: null, asks: false };

/* ---- the panel */
const offersCode = () => !!(DEVICES.known && DEVICES.known.offer);
async function fetchDevices() {
  if (S.may !== 'operate' || DEVICES.asks) return;
  DEVICES.asks = true;
  const known = await api('/api/devices', 'json');
  DEVICES.asks = false;
  if (known) takeDevices(known);
}
/* What the server knows of devices, and what came of the code that was shown. */
function takeDevices(known) {
  const offered = offersCode(), first = !DEVICES.known;
  DEVICES.known = known;
  if (known.offer) DEVICES.names = DEVICES.names || known.devices.map(device => device.name);
  else if (offered && DEVICES.names) {
    const paired = known.devices.find(device => !DEVICES.names.includes(device.name));
    DEVICES.said = paired ? `${paired.name} is paired: it may ${paired.may === 'hold' ? 'hold and abort' : 'look'}.` : 'The code holds no more; nothing was paired.';
    DEVICES.names = null;
  }
  if (first || S.table === 'devices') paintTables();
}
/* The server takes a code for shown as long as it is asked for it. */
setInterval(() => { if (S.view === 'setup' && S.table === 'devices') fetchDevices(); }, 1000);
async function orderDevices(kind, more) {
  DEVICES.said = '';
  const said = await order(kind, more);
  if (said.accepted) takeDevices(said);
}
DEEDS['pair-device'] = b => { DEVICES.names = null; orderDevices('pair-device', { may: b.dataset.may }); };
DEEDS['end-pairing'] = () => { DEVICES.names = null; orderDevices('end-pairing'); };
DEEDS['revoke-device'] = b => orderDevices('revoke-device', { name: b.dataset.name });
/* A picture of a code: its dark modules, row by row, with a quiet zone of four around them. */
function qrPicture(rows) {
  const dark = rows.map((row, y) => [...row.matchAll(/1+/g)].map(run => `M${run.index + 4} ${y + 4}h${run[0].length}v1h-${run[0].length}z`).join('')).join(''), size = rows.length + 8;
  return `<svg class="qr" viewBox="0 0 ${size} ${size}" role="img" aria-label="the address with the code, to be read by the camera of the device" shape-rendering="crispEdges"><rect width="${size}" height="${size}" fill="#fff"/><path d="${dark}" fill="#000"/></svg>`;
}
const fingerprintLines = text => text.match(/.{1,48}/g).map(part => part.replace(/:$/, '')).join('<br>');
function deviceTable() {
  const known = DEVICES.known;
  if (!known) return '';
  if (known.trouble) return `<p class="warn-text" role="alert">${safe(sentence(plain(known.trouble)))}.</p>`;
  return `<div class="devices">${known.offer ? offerBox(known) : deviceList(known)}</div>`;
}
function offerBox({ offer, url, fingerprint }) {
  const typed = offer.code ? `<p><span class="lab">or open</span><br><b>${safe(url)}</b><br><span class="lab">and type</span><br><b class="code">${offer.code}</b></p>` : '<p class="warn-text">Wrong codes were sent: only the picture pairs now.</p>';
  return `<div class="offer">${qrPicture(offer.qr)}<div><p>Point the camera of the device at the picture,</p>${typed}<p class="lab">It may ${offer.may === 'hold' ? 'look, hold and abort' : 'only look'}. ${span(offer.left_s).slice(0, -2)} left.</p>${key('end-pairing', 'Done')}</div></div>`
    + `<p class="lab-text">The browser warns: nobody has vouched for this machine. Go on only if the certificate that it shows has this SHA-256:</p><p class="print">${fingerprintLines(fingerprint)}</p>`;
}
function deviceList({ devices }) {
  const rows = devices.map(({ name, may, paired_ms, seen_ms, here }) => `<tr><td><b>${safe(name)}</b></td><td class="l">${may === 'hold' ? 'holds, aborts' : 'looks'}</td><td class="n">${dayAndTime(paired_ms)}</td><td class="n">${here ? `${icon('ok', 'ok')} now` : dayAndTime(seen_ms)}</td><td>${key('revoke-device', 'Revoke', { press: LONG, why: notOperating(), sub: 'press 1 s', data: `data-name="${safe(name)}"` })}</td></tr>`).join('');
  const table = devices.length ? `<table class="edit"><tr><th>device</th><th class="l">may</th><th>paired</th><th>seen</th><th></th></tr>${rows}</table>` : '<p class="lab-text">No tablet or phone is paired. One that is shows the machine, and may hold and abort; it never operates.</p>';
  const why = notOperating();
  return `${DEVICES.said ? `<p role="status"><b>${safe(DEVICES.said)}</b></p>` : ''}${table}<div class="row">${key('pair-device', 'Pair a device', { why, sub: 'to hold and abort', kind: 'main', data: 'data-may="hold"' })}${key('pair-device', 'Pair a display', { why, sub: 'that only looks', data: 'data-may="look"' })}</div>`;
}

/* ---- the device */
const isDevice = () => !S.file && location.protocol === 'https:';
const DEVICE_TOKEN = 'glidepath-device';
/* What a device is called, until somebody knows better. */
const deviceKind = () => { const is = navigator.userAgent; return /iPad/.test(is) ? 'iPad' : /iPhone/.test(is) ? 'iPhone' : /Android/.test(is) ? /Mobile/.test(is) ? 'Android phone' : 'Android tablet' : 'Device'; };
function startDevice() {
  try { TOKEN = localStorage.getItem(DEVICE_TOKEN) || ''; } catch { TOKEN = ''; }
  const code = hash.get('code') || '';
  // As a token does, it leaves the address.
  if (code) { hash.delete('code'); history.replaceState(null, '', location.pathname); }
  if (code || !TOKEN) layPairing(code);
}
function layPairing(code, said = '') {
  if ($('#app').dataset.pairs) return;
  $('#app').dataset.pairs = 1;
  $('#pairing').innerHTML = `<form><h3>Pair this device</h3><p class="warn-text" id="pairing-says" role="alert">${safe(said)}</p>${code ? '' : '<p>At the machine, in Set up under Devices, press <b>Pair a device</b>, and type the code that it shows.</p><label class="field"><span class="lab">Code</span><input id="pairing-code" autocomplete="off" autocapitalize="characters" spellcheck="false"></label>'}<label class="field"><span class="lab">Name of this device</span><input id="pairing-name" maxlength="32" autocomplete="off" value="${safe(deviceKind())}"></label><button class="key main" type="submit"><span>Pair</span></button></form>`;
  $('#pairing form').onsubmit = e => { e.preventDefault(); sendCode(code || $('#pairing-code').value); };
}
async function sendCode(code) {
  const says = text => put($('#pairing-says'), text), button = $('#pairing button');
  button.disabled = true;
  let said;
  try {
    const answer = await fetch('/api/pair', { method: 'POST', headers: { 'Content-Type': 'application/json' }, body: JSON.stringify({ code, name: $('#pairing-name').value }), signal: AbortSignal.timeout(10000) });
    const text = await answer.text();
    said = text.startsWith('{') ? JSON.parse(text) : { reason: text };
  } catch { said = { reason: 'the machine did not answer' }; }
  button.disabled = false;
  if (!said.token) { says(`${sentence(said.reason)}.`); return; }
  try { localStorage.setItem(DEVICE_TOKEN, said.token); } catch { says('This browser keeps nothing for the page: allow it to, and pair the device anew.'); return; }
  location.reload();
}
/* The server knows this device no more. */
function judgeRefused() {
  if (!isDevice() || !S.refused) return;
  // A Hold that is not taken is not to be pressed.
  if (S.may !== 'look') { S.may = 'look'; paintTabs(); paintHands(); }
  layPairing('', TOKEN ? 'This device is paired no more.' : '');
}
