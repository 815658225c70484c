'use strict';
// The unit of the operator's choice, in which lengths and feeds are shown and typed. The machine has mm, and so has this page
// inside; G20 and G21 have nothing to do with it. X of a lathe is a diameter, as in its drawings.

const UNIT = { inch: false };
try { UNIT.inch = !S.file && localStorage.getItem('glidepath-unit') === 'inch'; } catch { /* mm then */ }
const MM_PER_INCH = 25.4;
const perUnit = () => UNIT.inch ? MM_PER_INCH : 1;
const lengthUnit = () => UNIT.inch ? 'in' : 'mm';
const feedUnit = () => `${lengthUnit()}/min`;
const isDiameter = name => name === 'X' && isLathe();
/* What one unit of an axis is, as it is shown: mm or degrees. */
const scaleOf = axis => axis.unit !== 'mm' ? 1 : perUnit() * (isDiameter(axis.name) ? 0.5 : 1);
const unitOf = axis => axis.unit === 'mm' ? lengthUnit() : axis.unit;
const placesOf = axis => axis.unit === 'mm' && UNIT.inch ? 4 : 3;
/* A place on an axis, or a way along it. */
const place = (axis, x, fewer = 0) => num(x / scaleOf(axis), Math.max(0, placesOf(axis) - fewer));
const axisOf = name => AXES().find(axis => axis.name === name) || { name, unit: 'mm' };
const nameOf = name => isDiameter(name) ? `${name} Ø` : name;
/* A length, mm, with so many places in mm. */
const lengthText = (x, places) => num(x / perUnit(), UNIT.inch ? places + 1 : places);
/* A feed, mm/min. */
const feedText = v => UNIT.inch ? num(v / MM_PER_INCH, 1) : grouped(v);
/* A round length of a scale, and in words: in the unit in which it is a number of people. */
const niceLength = least => nice(least / perUnit()) * perUnit();
function lengthWords(x) {
  if (UNIT.inch) return `${+(x / MM_PER_INCH).toPrecision(3)} in`;
  return x >= 1 ? `${grouped(x)} mm` : x >= 1e-3 ? `${+(x * 1e3).toPrecision(2)} µm` : `${+(x * 1e6).toPrecision(2)} nm`;
}
/* How long a path is, mm. */
const wayText = (way, of = way) => UNIT.inch ? `${num(way / MM_PER_INCH, 0)}${of === way ? '' : ` of ${num(of / MM_PER_INCH, 0)}`} in` : `${(way / 1000).toFixed(2)}${of === way ? '' : ` of ${(of / 1000).toFixed(2)}`} m`;
/* What somebody has typed, in mm or degrees, as it is in `scale`; null if it is no number. A length may name its unit, whichever is shown. */
function typed(text, scale) {
  const named = /^(.*\d[.,]?)\s*(mm|in|")$/i.exec(text.trim()), value = numberOf(named ? named[1] : text);
  if (value === null || !named) return value === null ? null : value * scale;
  return value * scale / perUnit() * (named[2].toLowerCase() === 'mm' ? 1 : MM_PER_INCH);
}
const typedOn = (axis, text) => axis.unit === 'mm' ? typed(text, scaleOf(axis)) : numberOf(text);
/* A number to be typed over, without zeros that say nothing. */
const typedText = (x, scale) => String(+(x / scale).toFixed(6));
/* The steps of the jog pad: those of the configuration, and in inches the next smaller ones of one, a tenth and so on. */
function stepsOf(increments) {
  const steps = UNIT.inch ? increments.map(mm => 10 ** Math.floor(Math.log10(mm / MM_PER_INCH) + 1e-9)) : increments;
  return [...new Set(steps.map(step => +step.toPrecision(6)))].sort((a, b) => b - a);
}
/* Changes to the other unit. */
function changeUnit() {
  UNIT.inch = !UNIT.inch;
  try { localStorage.setItem('glidepath-unit', UNIT.inch ? 'inch' : 'mm'); } catch { /* for this time */ }
}
