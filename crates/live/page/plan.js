'use strict';
// The plan: columns against time, the path of the motion, and the programmed path.

/* Numbers as the server writes them: little-endian, every column at a multiple of eight bytes. */
class Reader {
  constructor(buffer, mark) {
    this.buffer = buffer; this.at = 4; this.view = new DataView(buffer);
    const found = String.fromCharCode(...new Uint8Array(buffer, 0, 4));
    if (found !== mark) throw new Error(`these numbers are ${found}, not ${mark}`);
  }
  word() { this.at += 4; return this.view.getUint32(this.at - 4, true); }
  double() { this.at += 8; return this.view.getFloat64(this.at - 8, true); }
  column(Type, count) {
    const column = new Type(this.buffer, this.at, count);
    this.at += Math.ceil(column.byteLength / 8) * 8;
    return column;
  }
}

/* A motion: `bins` of `per` samples each, with the least and the largest of every quantity. */
class Plan {
  constructor(buffer) {
    const r = new Reader(buffer, 'GPC1');
    const axes = r.word();
    this.bins = r.word(); this.per = r.word(); this.dt = r.double(); this.samples = r.double();
    const n = this.bins;
    this.axes = Array.from({ length: axes }, () => {
      const axis = { position: r.column(Float32Array, n), ranges: [] };
      for (let k = 0; k < 3; k++) axis.ranges.push({ lo: r.column(Int16Array, n), hi: r.column(Int16Array, n) });
      return axis;
    });
    this.feed = { lo: r.column(Float32Array, n), hi: r.column(Float32Array, n) };
    this.programmed = r.column(Float32Array, n);
    this.deviation = r.column(Float32Array, n);
    this.tolerance = r.column(Float32Array, n);
    this.way = r.column(Float32Array, n);
    this.line = r.column(Uint32Array, n);
    this.code = r.column(Uint8Array, n);
    this.seconds = Math.max(1, this.samples - 1) * this.dt;
    this.mostFeed = 1;
    for (let i = 0; i < n; i++) if (this.feed.hi[i] > this.mostFeed) this.mostFeed = this.feed.hi[i];
  }
  /* The bin of a place, in samples. */
  bin(p) { return Math.max(0, Math.min(this.bins - 1, Math.floor(p / this.per))); }
  /* How many samples from one place to a later one obey the feed override, that of rapids, and none, where the machine rests. */
  obeying(from, to) {
    const kind = i => this.code[i] & 128 ? 1 : this.code[i] & 7 ? 0 : 2;
    if (!this.kinds) {
      this.kinds = [0, 1, 2].map(() => new Float64Array(this.bins + 1));
      for (let i = 0; i < this.bins; i++) this.kinds.forEach((sum, k) => { sum[i + 1] = sum[i] + (kind(i) === k ? this.per : 0); });
    }
    const before = (sum, k, p) => { const i = this.bin(p); return sum[i] + (kind(i) === k ? Math.min(this.per, Math.max(0, p - i * this.per)) : 0); };
    return this.kinds.map((sum, k) => before(sum, k, to) - before(sum, k, from));
  }
  position(axis, p) { return this.axes[axis] ? this.axes[axis].position[this.bin(p)] : 0; }
  /* The first sample of a line, or the next one that has any. */
  ofLine(line) { for (let i = 0; i < this.bins; i++) if (this.line[i] >= line) return i * this.per; return this.samples - 1; }
}

/* A path in space, with levels of detail. */
class Track {
  constructor(buffer) {
    const r = new Reader(buffer, 'GPP1');
    const n = this.count = r.word();
    this.most = Math.max(1, r.word()); r.word();
    this.xyz = r.column(Float32Array, 3 * n);
    this.sequence = r.column(Uint32Array, n);
    this.feed = r.column(Float32Array, n);
    this.code = r.column(Uint8Array, n);
    const level = r.column(Uint8Array, n), order = [[], [], [], []];
    for (let i = 0; i < n; i++) for (let l = level[i]; l < 4; l++) order[l].push(i);
    // A level that is hardly smaller than the next one is none.
    this.levels = order.filter((of, l) => l === 3 || of.length < 0.8 * order[l + 1].length).map(of => Uint32Array.from(of));
    this.fit();
  }
  /* What the view fits: feed moves with their starts, and rapids no further from them than half of
     their largest extent. A rapid from where the machine stands is drawn, and sets no scale. */
  fit() {
    const n = this.count, rapid = i => this.code[i] & 128, cut = i => (i > 0 && !rapid(i)) || (i + 1 < n && !rapid(i + 1));
    const extent = shown => {
      const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
      for (let i = 0; i < n; i++) if (shown(i)) for (let k = 0; k < 3; k++) { const x = this.xyz[3 * i + k]; if (x < low[k]) low[k] = x; if (x > high[k]) high[k] = x; }
      return [low, high];
    };
    let [low, high] = extent(cut);
    if (low[0] > high[0]) [low, high] = n ? extent(() => true) : [[0, 0, 0], [0, 0, 0]];
    else {
      const [from, to] = [low, high], around = 0.5 * Math.max(...to.map((h, k) => h - from[k]));
      [low, high] = extent(i => [0, 1, 2].every(k => this.xyz[3 * i + k] >= from[k] - around && this.xyz[3 * i + k] <= to[k] + around));
    }
    this.low = low; this.high = high;
  }
  /* The last point at or before a place, in samples. */
  before(p) {
    let a = 0, b = this.count;
    while (a < b) { const m = (a + b) >> 1; if (this.sequence[m] <= p) a = m + 1; else b = m; }
    return Math.max(0, a - 1);
  }
}

let PLAN = null, MOTION = null, PROGRAM = null;

/* ---- the text of the program */
const LINES = {
  all: null, some: new Map(), asked: new Set(),
  get(line) {
    if (this.all) return this.all[line - 1];
    if (this.some.has(line)) return this.some.get(line);
    if (!S.file && line > 0 && INFO.program) this.ask(line);
    return undefined;
  },
  forget() { this.some.clear(); this.asked.clear(); },
  async ask(line) {
    const from = Math.max(1, line - line % 64), of = INFO.generation;
    if (this.asked.has(from)) return;
    this.asked.add(from);
    const lines = await api(`/api/lines?of=${of}&from=${from}&count=80`, 'json');
    if (of !== INFO.generation) return;
    if (!lines) { this.asked.delete(from); return; }
    if (this.some.size > 20000) this.forget();
    lines.forEach((text, k) => this.some.set(from + k, text));
    dirty.path = true;
  },
};
