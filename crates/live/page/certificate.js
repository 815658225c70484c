'use strict';
// The certificate of a job that is over, as a page of its own to keep: how long it took, how near it came to its limits, how
// true the path is, what the overrides were, how its ticks came, and which program it was.

/* Its rows: what, and how much. */
function certificateRows(c) {
  const seen = c.seen, axes = ['velocity', 'acceleration', 'jerk'].map(kind => [kind, seen.limits[kind]]).map(([kind, of]) => [`Largest ${kind}`, of.axis ? `${num(of.part * 100, 1)} % of the limit of ${of.axis}` : of.has_limit ? 'nothing moved' : 'axes have no limit of their own: joints limit them']);
  const range = ([least, most]) => least === most ? `${Math.round(most * 100)} %` : `${Math.round(least * 100)} to ${Math.round(most * 100)} %`;
  const micrometres = x => `${num(x * 1000, 1)} µm`;
  return [
    ['Machine', INFO.machine.instance], ['Job', c.name],
    ['Program', c.program ? `fingerprint ${c.program}` : 'lines, or a stream: it has no fingerprint'],
    ['Begun', `${dayAndTime(c.begun_ms)}:${two(new Date(c.begun_ms).getSeconds())}`], ['Ended', `${dayAndTime(c.ended_ms)}:${two(new Date(c.ended_ms).getSeconds())}, ${c.end}${c.end === 'done' ? '' : ` at line ${c.line}`}`],
    ['Time', `${span((c.ended_ms - c.begun_ms) / 1000)}${c.plan && c.plan.planned_s ? `, planned ${span(c.plan.planned_s)} at 100 %` : ''}`],
    ['Deviation from the program', c.plan ? `at most ${micrometres(c.plan.max_deviation_mm)} of ${micrometres(c.plan.tolerance_mm)} that are allowed, by the plan` : 'not known: the program was not planned beside the machine'],
    ['Following error', c.following_mm === null ? 'nobody says: no feedback is configured' : `at most ${micrometres(c.following_mm)}`],
    ...axes,
    ['Feed override', range(c.feed_override)], ['Rapid override', range(c.rapid_override)],
    ['Setpoints', `${grouped(seen.setpoints)} seen, ${grouped(seen.lost)} not${seen.is_whole ? '' : '; the job had begun before'}`],
    ['Ticks', `${grouped(seen.missed_ticks)} missed; the latest began after ${micro(seen.late_us)}`],
  ];
}
const hexadecimal = bytes => [...new Uint8Array(bytes)].map(b => b.toString(16).padStart(2, '0')).join('');
/* The page: its figures as a table, as data, and the hash of these. */
async function certificatePage(c) {
  const figures = JSON.stringify(c), hash = hexadecimal(await crypto.subtle.digest('SHA-256', new TextEncoder().encode(figures)));
  const rows = certificateRows(c).map(([what, much]) => `<tr><th scope="row">${safe(what)}</th><td>${safe(much)}</td></tr>`).join('\n');
  return `<!doctype html><html lang="en"><meta charset="utf-8"><title>${safe(c.name)}, ${dayAndTime(c.begun_ms)}</title>
<style>body{font:16px/1.5 sans-serif;margin:2em;max-width:52em;color:#111;background:#fff}table{border-collapse:collapse;width:100%}th,td{text-align:left;vertical-align:top;padding:.35em 1em .35em 0;border-top:1px solid #bbb}th{font-weight:400;color:#444;width:15em}pre{white-space:pre-wrap;overflow-wrap:anywhere;font-size:12px;color:#444}</style>
<h1>Certificate of a job</h1>
<table>
${rows}
</table>
<p>Limits are those of the axes. Setpoints are what the drives were told; the following error is how far they were from them.</p>
<pre id="figures">${safe(figures)}</pre>
<p>SHA-256 of the figures: <code>${hash}</code></p>
</html>
`;
}
DEEDS.certificate = async b => {
  const c = await api(`/api/certificate?job=${b.dataset.job}`, 'json');
  if (!c) { refuse('there is no certificate of this job any more'); return; }
  const link = document.createElement('a'), d = new Date(c.begun_ms);
  link.href = URL.createObjectURL(new Blob([await certificatePage(c)], { type: 'text/html' }));
  link.download = `${c.name.replace(/[^\w.-]+/g, '-')}-${dayAndTime(+d).replace(/[ :]/g, '-')}.html`;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
};
