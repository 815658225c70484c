'use strict';
// What the machine did, tick by tick: the last minutes of setpoints as they came.

const RING = 1 << 17;

class Ring {
  constructor(axes, dt) {
    this.dt = dt; this.count = 0; this.last = -1; this.moved = -Infinity; this.gaps = 0; this.lost = 0; this.mostFeed = 0;
    const numbers = Type => new Type(RING);
    this.tick = numbers(Float64Array); this.p = numbers(Float64Array);
    this.axes = Array.from({ length: axes }, () => ({ position: numbers(Float64Array), ranges: [numbers(Float32Array), numbers(Float32Array), numbers(Float32Array)], differences: [0, 0, 0] }));
    this.feed = numbers(Float32Array); this.rate = numbers(Float32Array); this.late = numbers(Float32Array);
    this.error = numbers(Float32Array); this.ahead = numbers(Float32Array);
    this.line = numbers(Uint32Array); this.state = numbers(Uint8Array);
  }
  get length() { return Math.min(this.count, RING); }
  get now() { return this.count ? this.tick[(this.count - 1) & (RING - 1)] * this.dt : 0; }
  get then() { return this.count ? this.tick[(this.count - this.length) & (RING - 1)] * this.dt : 0; }
  /* A batch as the server writes it; `p` is where the plan is at its end. */
  take(buffer, p, error, ahead) {
    const view = new DataView(buffer), count = view.getUint32(0, true), axes = view.getUint32(4, true);
    const from = this.count ? this.p[(this.count - 1) & (RING - 1)] : p;
    let at = 8;
    for (let k = 0; k < count; k++) {
      const number = view.getFloat64(at, true), tick = view.getFloat64(at + 8, true);
      if (number <= this.last || (this.count && tick < this.tick[(this.count - 1) & (RING - 1)])) this.reset();
      const i = this.count & (RING - 1), follows = this.count > 0 && number === this.last + 1;
      if (!follows && this.count) { this.gaps++; this.lost += number - this.last - 1; }
      this.last = number;
      this.tick[i] = tick;
      this.line[i] = view.getUint32(at + 16, true);
      this.state[i] = view.getUint32(at + 20, true);
      this.feed[i] = view.getFloat32(at + 24, true);
      this.mostFeed = Math.max(this.mostFeed, this.feed[i]);
      this.rate[i] = view.getFloat32(at + 28, true);
      this.late[i] = view.getFloat32(at + 32, true);
      at += 40;
      for (let a = 0; a < axes; a++, at += 8) this.step(this.axes[a], i, view.getFloat64(at, true), follows);
      const near = Math.abs(p - from) < 2 / this.dt && p >= from;
      this.p[i] = near ? from + (p - from) * (k + 1) / count : p;
      this.error[i] = error; this.ahead[i] = ahead;
      this.count++;
    }
  }
  /* Finite differences: what a drive makes of the positions. */
  step(axis, i, position, follows) {
    if (!axis) return;
    axis.position[i] = position;
    const before = axis.differences, dt = this.dt;
    if (position !== axis.before) this.moved = this.tick[i] * dt;
    // Behind a gap a difference needs as many samples as its order, and one more.
    axis.run = follows ? axis.run + 1 : 0;
    const first = axis.run > 0 ? position - axis.before : 0, second = axis.run > 1 ? first - before[0] : 0, third = axis.run > 2 ? second - before[1] : 0;
    axis.before = position; axis.differences = [first, second, third];
    axis.ranges[0][i] = first / dt; axis.ranges[1][i] = second / dt ** 2; axis.ranges[2][i] = third / dt ** 3;
  }
  reset() { this.count = 0; this.last = -1; this.moved = -Infinity; }
  /* Whether every axis has stood for so long, s. */
  rests(t) { return this.now - this.moved > t; }
  /* The index, counted from the first sample there was, of the first one not before a time. */
  at(t) {
    const tick = t / this.dt - 1e-6;
    let a = this.count - this.length, b = this.count;
    while (a < b) { const m = (a + b) >> 1; if (this.tick[m & (RING - 1)] < tick) a = m + 1; else b = m; }
    return a;
  }
  /* When the plan was at a place; null if that is not known any more. */
  when(p) {
    let a = this.count - this.length, b = this.count;
    if (a === b || p < this.p[a & (RING - 1)] || p > this.p[(b - 1) & (RING - 1)]) return null;
    while (a < b) { const m = (a + b) >> 1; if (this.p[m & (RING - 1)] < p) a = m + 1; else b = m; }
    return this.tick[a & (RING - 1)] * this.dt;
  }
  last_range(axis, n) { return this.axes[axis].ranges[n][(this.count - 1) & (RING - 1)]; }
  last_position(axis) { return this.count ? this.axes[axis].position[(this.count - 1) & (RING - 1)] : 0; }
}
let RINGED = null;
