'use strict';
// The path in space. What does not move is drawn once, on a canvas of its own, and drawn on as the
// motion advances; tool, tail and marks are on a second canvas above it.

const TAIL_S = 1;
/* How wide a path is, px. */
const TO_COME = 1.3, DONE = { width: 3.6, rapid: 2 };
/* X, Y and Z of something that is known by axis of the machine; 0 for an axis that it has not. */
const inSpace = of => ['X', 'Y', 'Z'].map(name => { const k = AXES().findIndex(axis => axis.name === name); return k < 0 ? 0 : of(k); });
/* A lathe is looked at as in its drawings: Z to the right, X up, and the spindle's axis in sight. */
const isLathe = () => { const names = AXES().map(axis => axis.name); return names.includes('X') && names.includes('Z') && !names.includes('Y'); };

class Path3D {
  constructor() {
    this.yaw = -0.62; this.pitch = 0.62; this.zoom = 1; this.pan = [0, 0];
    this.mode = 'limit'; this.showProgram = true;
    this.turning = 9; this.quick = 0; this.drew = 0;
    this.box = document.createElement('div'); this.box.className = 'space';
    this.base = document.createElement('canvas'); this.over = document.createElement('canvas');
    this.box.append(this.base, this.over);
    this.stale = true; this.moved = 0; this.drawn = { p: -1, at: 0 };
    this.onhover = () => {}; this.onclick = () => {};
    this.hands();
  }
  basis() {
    if (isLathe()) return [[0, 0, 1], [-1, 0, 0]];
    const cy = Math.cos(this.yaw), sy = Math.sin(this.yaw), cp = Math.cos(this.pitch), sp = Math.sin(this.pitch);
    return [[cy, -sy, 0], [-sy * sp, -cy * sp, -cp]]; // to the right and down on the screen
  }
  track() { return MOTION && MOTION.count > 1 ? MOTION : PROGRAM && PROGRAM.count > 1 ? PROGRAM : null; }
  /* The projection: screen = R·point + offset. */
  project(w, h) {
    const track = this.track(), [right, down] = this.basis();
    const low = [...(track ? track.low : [-50, -50, 0])], high = [...(track ? track.high : [50, 50, 0])];
    if (isLathe()) { low[0] = Math.min(0, low[0]); high[0] = Math.max(0, high[0]); }
    this.mid = low.map((l, k) => (l + high[k]) / 2);
    const reach = axis => axis.reduce((sum, a, k) => sum + Math.abs(a) * (high[k] - low[k]), 0) || 1;
    const small = h < 230, top = small ? 30 : 62, bottom = small ? 12 : 56;
    this.whole = Math.min((w - 48) / reach(right), (h - top - bottom) / reach(down));
    this.scale = this.whole * this.zoom;
    this.R = [right.map(x => x * this.scale), down.map(x => x * this.scale)];
    this.O = [w / 2 + this.pan[0], (h + top - bottom) / 2 + this.pan[1]];
    for (let k = 0; k < 2; k++) this.O[k] -= this.R[k][0] * this.mid[0] + this.R[k][1] * this.mid[1] + this.R[k][2] * this.mid[2];
  }
  at(x, y, z) {
    const [a, b] = this.R;
    return [a[0] * x + a[1] * y + a[2] * z + this.O[0], b[0] * x + b[1] * y + b[2] * z + this.O[1]];
  }
  /* The finest level that is drawn in time while the view moves, by how far apart the last frames
     were; at rest all of it. */
  level(track) {
    const last = track.levels.length - 1, now = performance.now(), took = now - this.drew;
    this.drew = now;
    if (now - this.moved > 180) return last;
    this.turning = Math.min(this.turning, last);
    if (took < 300) {
      if (took > 30) { this.turning = Math.max(0, this.turning - 1); this.quick = 0; } else if (++this.quick > 40 && took < 20) { this.turning = Math.min(last, this.turning + 1); this.quick = 0; }
    }
    return this.turning;
  }
  /* The colour of every point's segment, as a number, and the styles by number. */
  paint(track) {
    const key = `${this.mode} ${T.dark}`;
    if (track.painted && track.painted.key === key) return track.painted;
    const classes = new Uint8Array(track.count), rapid = 0;
    const styles = [T.limit.rapid];
    if (track === PROGRAM) {
      styles.push(T.css.quiet);
      for (let i = 0; i < track.count; i++) classes[i] = track.code[i] & 128 ? rapid : 1;
    } else if (this.mode === 'feed') {
      for (let k = 0; k < 24; k++) styles.push(shade((k + 0.5) / 24));
      for (let i = 0; i < track.count; i++) classes[i] = track.code[i] & 128 ? rapid : 1 + Math.min(23, Math.floor(track.feed[i] / track.most * 24));
    } else {
      for (const kind of LIMITS) styles.push(T.limit[kind]);
      for (let i = 0; i < track.count; i++) classes[i] = track.code[i] & 128 ? rapid : 1 + (track.code[i] & 7);
    }
    track.painted = { key, classes, styles };
    return track.painted;
  }
  /* Draws the segments of a level that end behind `from` and not behind `to`, in samples. */
  segments(c, track, level, from, to, style, w, h) {
    const order = track.levels[level], { xyz, sequence } = track, n = order.length, [a, b] = this.R, [ox, oy] = this.O;
    const { classes, styles } = this.paint(track);
    const X = new Float32Array(n), Y = new Float32Array(n);
    for (let k = 0; k < n; k++) {
      const i = 3 * order[k], x = xyz[i], y = xyz[i + 1], z = xyz[i + 2];
      X[k] = a[0] * x + a[1] * y + a[2] * z + ox; Y[k] = b[0] * x + b[1] * y + b[2] * z + oy;
    }
    let first = 1;
    if (from >= 0) { let l = 1, r = n; while (l < r) { const m = (l + r) >> 1; if (sequence[order[m]] <= from) l = m + 1; else r = m; } first = l; }
    c.lineJoin = 'round'; c.lineCap = 'butt';
    const runs = styles.map(() => []);
    for (let k = first; k < n; k++) {
      if (sequence[order[k]] > to) break;
      if ((X[k] < 0 && X[k - 1] < 0) || (X[k] > w && X[k - 1] > w) || (Y[k] < 0 && Y[k - 1] < 0) || (Y[k] > h && Y[k - 1] > h)) continue;
      runs[classes[order[k]]].push(k);
    }
    runs.forEach((run, kind) => {
      if (!run.length) return;
      const rapid = kind === 0;
      c.strokeStyle = styles[kind]; c.lineWidth = rapid ? style.rapid : style.width;
      c.setLineDash(rapid && run.length < 10000 ? [5, 4] : []);
      let open = 0, before = -2;
      c.beginPath();
      for (const k of run) {
        if (k !== before + 1) c.moveTo(X[k - 1], Y[k - 1]);
        c.lineTo(X[k], Y[k]);
        before = k;
        if (++open >= 400) { c.stroke(); c.beginPath(); c.moveTo(X[k], Y[k]); open = 0; }
      }
      c.stroke();
    });
    c.setLineDash([]);
  }
  draw(p) {
    const w = this.box.clientWidth, h = this.box.clientHeight;
    if (!w || !h) return;
    const track = this.track(), done = track && track === MOTION ? p : -1, start = performance.now();
    const key = [w, h, this.yaw, this.pitch, this.zoom, ...this.pan, this.mode, T.dark, this.showProgram, devicePixelRatio].join();
    // What was done is taken back now and then, since all of the path is drawn for that, and never while a finger has to be heard.
    const isBack = done < this.drawn.p && !S.drags && start - this.drawn.at > 500;
    if (isBack) this.moved = start;
    const level = track ? this.level(track) : 0;
    const anew = this.stale || key !== this.drawn.key || track !== this.drawn.track || isBack || (level !== this.drawn.level && performance.now() - this.moved > 180);
    this.project(w, h);
    if (anew) {
      const [c] = fit(this.base);
      c.clearRect(0, 0, w, h);
      this.grid(c);
      if (track) {
        if (this.showProgram && this.scale * INFO.machine.tolerance_mm > 0.5 && track === MOTION && PROGRAM && PROGRAM.count > 1) this.segments(c, PROGRAM, Math.min(level, PROGRAM.levels.length - 1), -1, Infinity, { width: 1, rapid: 0.01 }, w, h);
        // To come is thin and done is thick, both in full colour; rapids are dashed.
        this.segments(c, track, level, -1, Infinity, { width: S.file ? 2 : TO_COME, rapid: 1 }, w, h);
        if (!S.file && done > 0) this.segments(c, track, level, -1, done, DONE, w, h);
      }
      this.drawn = { key, track, level, p: done, at: performance.now() };
      this.stale = false;
      // Finer, once the view rests.
      if (track && level < track.levels.length - 1) setTimeout(() => { dirty.path = true; }, 200);
    } else if (track && track === MOTION && !S.file && done > this.drawn.p) {
      const c = this.base.getContext('2d');
      this.segments(c, track, this.drawn.level, this.drawn.p, done, DONE, w, h);
      const first = track.before(done);
      this.drawn.p = track.sequence[first];
    }
    this.overlay(p, w, h);
    this.took = performance.now() - start;
  }
  /* The floor below the path, in steps that one can count. */
  grid(c) {
    const track = this.track();
    if (!track) return;
    if (isLathe()) { this.centre(c, track); return; }
    const [lx, ly, lz] = track.low, [hx, hy] = track.high, step = niceLength(Math.max(hx - lx, hy - ly, 1) / 9);
    const x0 = Math.floor(lx / step) * step, x1 = Math.ceil(hx / step) * step, y0 = Math.floor(ly / step) * step, y1 = Math.ceil(hy / step) * step;
    c.strokeStyle = T.css.faint; c.lineWidth = 1; c.beginPath();
    for (let x = x0; x <= x1 + step / 2; x += step) { c.moveTo(...this.at(x, y0, lz)); c.lineTo(...this.at(x, y1, lz)); }
    for (let y = y0; y <= y1 + step / 2; y += step) { c.moveTo(...this.at(x0, y, lz)); c.lineTo(...this.at(x1, y, lz)); }
    c.stroke();
  }
  /* The axis that the part turns about. */
  centre(c, track) {
    const beyond = (track.high[2] - track.low[2]) * 0.05;
    c.strokeStyle = T.css.quiet; c.lineWidth = 1; c.setLineDash([14, 4, 3, 4]); c.beginPath();
    c.moveTo(...this.at(0, 0, track.low[2] - beyond)); c.lineTo(...this.at(0, 0, track.high[2] + beyond)); c.stroke(); c.setLineDash([]);
  }
  overlay(p, w, h) {
    const [c] = fit(this.over);
    c.clearRect(0, 0, w, h);
    this.frame(c, w, h);
    if (!S.file) { this.tail(c); this.tool(c); }
    if (S.hover !== null && PLAN) this.mark(c, w, h);
  }
  /* Where the axes point, and how long a length is. */
  frame(c, w, h) {
    const small = h < 230;
    if (small) return;
    const [right, down] = this.basis(), foot = this.foot(), ox = w - 40, oy = h - foot - 20;
    c.font = '12px B612'; c.textAlign = 'center'; c.textBaseline = 'middle'; c.lineWidth = 1.5;
    ['X', 'Y', 'Z'].forEach((name, k) => {
      const x = right[k] * 24, y = down[k] * 24;
      if (Math.hypot(x, y) < 5) return;
      c.strokeStyle = T.css.quiet; c.beginPath(); c.moveTo(ox, oy); c.lineTo(ox + x, oy + y); c.stroke();
      c.fillStyle = T.css.quiet; c.fillText(name, ox + x * 1.42, oy + y * 1.42);
    });
    const length = niceLength(60 / this.scale), px = length * this.scale, y = h - foot - 10;
    c.fillStyle = T.css.quiet; c.fillRect(14, y, px, 1.5); c.fillRect(14, y - 3, 1.5, 7.5); c.fillRect(14 + px - 1.5, y - 3, 1.5, 7.5);
    // Not struck through by what is drawn below it.
    const text = lengthWords(length);
    c.textAlign = 'left'; c.fillStyle = T.css.panel; c.fillRect(12, y - 19, c.measureText(text).width + 4, 15); c.fillStyle = T.css.quiet; c.fillText(text, 14, y - 11);
  }
  /* How high the legend is. */
  foot() { const legend = this.box.parentElement && $('.legend', this.box.parentElement); return (legend ? legend.offsetHeight : 0) + 16; }
  tail(c) {
    const ring = RINGED;
    if (!ring || !ring.count) return;
    const first = ring.at(ring.now - TAIL_S), last = ring.count - 1, m = RING - 1;
    c.strokeStyle = T.css.ink; c.lineCap = 'round';
    for (let part = 0; part < 4; part++) {
      c.lineWidth = 1.6 + part * 1.2; c.globalAlpha = 0.25 + part * 0.25; c.beginPath();
      const from = first + Math.floor((last - first) * part / 4), to = first + Math.ceil((last - first) * (part + 1) / 4);
      for (let k = from; k <= to; k++) { const q = this.at(...inSpace(axis => ring.axes[axis].position[k & m])); k === from ? c.moveTo(...q) : c.lineTo(...q); }
      c.stroke();
    }
    c.globalAlpha = 1; c.lineCap = 'butt';
  }
  tool(c) {
    const ring = RINGED;
    if (!ring || !ring.count) return;
    const place = inSpace(k => ring.last_position(k));
    const tip = this.at(...place), up = this.basis()[1][2] * -1, r = 8, length = 46 * up, flat = Math.max(2, r * Math.abs(Math.sin(this.pitch)));
    c.strokeStyle = T.css.ink; c.fillStyle = T.css.panel; c.lineWidth = 1.6;
    if (length > 8) {
      const [x, y] = tip, neck = y - 10 * up;
      c.globalAlpha = 0.72; c.beginPath(); c.moveTo(x - r, y - length); c.lineTo(x - r, neck); c.lineTo(x, y); c.lineTo(x + r, neck); c.lineTo(x + r, y - length); c.closePath(); c.fill();
      c.globalAlpha = 1; c.stroke(); c.beginPath(); c.ellipse(x, y - length, r, flat, 0, 0, 7); c.fill(); c.stroke();
    } else { c.beginPath(); c.arc(...tip, r, 0, 7); c.stroke(); }
    c.fillStyle = T.css.ink; c.beginPath(); c.arc(...tip, 4, 0, 7); c.fill();
  }
  mark(c, w, h) {
    const q = this.at(...inSpace(k => PLAN.position(k, S.hover))), bin = PLAN.bin(S.hover), line = PLAN.line[bin];
    c.lineWidth = 2; c.strokeStyle = T.css.ink; c.beginPath(); c.arc(...q, 8, 0, 7); c.stroke();
    c.beginPath(); for (const [x, y] of [[1, 0], [-1, 0], [0, 1], [0, -1]]) { c.moveTo(q[0] + x * 8, q[1] + y * 8); c.lineTo(q[0] + x * 15, q[1] + y * 15); } c.stroke();
    const words = [`line ${line}  ${(LINES.get(line) || '').slice(0, 30)}`, `${num(S.hover * PLAN.dt, 3)} s   ${num(PLAN.feed.hi[bin], 1)} mm/s`, limitText(PLAN.code[bin])];
    c.font = '13px B612'; c.textAlign = 'left'; c.textBaseline = 'middle';
    const width = Math.max(...words.map(t => c.measureText(t).width)) + 20, height = words.length * 18 + 12;
    let x = q[0] + 20, y = q[1] - height - 14;
    if (x + width > w - 4) x = q[0] - width - 20;
    x = Math.max(4, x); if (y < 44) y = q[1] + 18;
    c.fillStyle = T.css.ink; c.fillRect(x, y, width, height); c.fillStyle = T.css.panel;
    words.forEach((t, i) => c.fillText(t, x + 10, y + 15 + i * 18));
  }
  /* The sample of the plan whose point is nearest to a place on the screen. */
  pick(x, y) {
    const track = MOTION;
    if (!track || !this.R) return null;
    const [a, b] = this.R, { xyz } = track;
    let best = 16 * 16, found = null;
    for (let i = 0; i < track.count; i++) {
      const dx = a[0] * xyz[3 * i] + a[1] * xyz[3 * i + 1] + a[2] * xyz[3 * i + 2] + this.O[0] - x;
      if (dx * dx > best) continue;
      const dy = b[0] * xyz[3 * i] + b[1] * xyz[3 * i + 1] + b[2] * xyz[3 * i + 2] + this.O[1] - y, d = dx * dx + dy * dy;
      if (d < best) { best = d; found = track.sequence[i]; }
    }
    return found;
  }
  change() { this.moved = performance.now(); dirty.path = true; }
  zoomAt(x, y, factor) {
    const zoom = Math.max(0.5, Math.min(4000, this.zoom * factor)), f = zoom / this.zoom, w = this.box.clientWidth, h = this.box.clientHeight, small = h < 230;
    const cx = w / 2, cy = (h + (small ? 18 : 6)) / 2;
    this.pan = [(x - cx) - (x - cx - this.pan[0]) * f, (y - cy) - (y - cy - this.pan[1]) * f];
    this.zoom = zoom; this.change();
  }
  /* Looks at a place of the plan closely enough to see the tolerance. */
  lookAt(p) {
    if (!PLAN) return;
    this.zoom = Math.max(this.zoom, 60 / Math.max(1e-9, this.whole * 1)); this.pan = [0, 0];
    const w = this.box.clientWidth, h = this.box.clientHeight;
    this.project(w, h);
    const q = this.at(...inSpace(k => PLAN.position(k, p)));
    this.pan = [w / 2 - q[0], h / 2 - q[1]]; this.change();
  }
  hands() {
    const box = this.box, fingers = new Map();
    let drag = null, travelled = 0;
    box.addEventListener('pointerdown', e => {
      fingers.set(e.pointerId, [e.offsetX, e.offsetY]); box.setPointerCapture(e.pointerId); travelled = 0;
      drag = { x: e.clientX, y: e.clientY, yaw: this.yaw, pitch: this.pitch, pan: [...this.pan], pans: e.shiftKey || e.button === 1 || e.button === 2 };
    });
    box.addEventListener('pointermove', e => {
      if (!fingers.has(e.pointerId)) { this.onhover(this.pick(e.offsetX, e.offsetY)); return; }
      const before = [...fingers.values()].map(f => [...f]);
      fingers.set(e.pointerId, [e.offsetX, e.offsetY]);
      if (fingers.size === 2) {
        const now = [...fingers.values()], mid = f => [(f[0][0] + f[1][0]) / 2, (f[0][1] + f[1][1]) / 2], wide = f => Math.hypot(f[0][0] - f[1][0], f[0][1] - f[1][1]) || 1;
        const [mx, my] = mid(now), [bx, by] = mid(before);
        this.pan[0] += mx - bx; this.pan[1] += my - by;
        this.zoomAt(mx, my, wide(now) / wide(before)); drag = null;
        return;
      }
      if (!drag) return;
      const dx = e.clientX - drag.x, dy = e.clientY - drag.y;
      travelled = Math.max(travelled, Math.hypot(dx, dy));
      if (drag.pans) this.pan = [drag.pan[0] + dx, drag.pan[1] + dy];
      else { this.yaw = drag.yaw + dx * 0.008; this.pitch = Math.max(0, Math.min(Math.PI / 2, drag.pitch + dy * 0.008)); }
      this.change();
    });
    const up = e => { fingers.delete(e.pointerId); if (drag && travelled < 4 && e.type === 'pointerup') this.onclick(this.pick(e.offsetX, e.offsetY)); drag = null; };
    box.addEventListener('pointerup', up); box.addEventListener('pointercancel', up);
    box.addEventListener('pointerleave', () => this.onhover(null));
    box.addEventListener('contextmenu', e => e.preventDefault());
    box.addEventListener('wheel', e => { e.preventDefault(); this.zoomAt(e.offsetX, e.offsetY, Math.exp(-e.deltaY * 0.0015)); }, { passive: false });
    box.addEventListener('dblclick', () => this.view('iso'));
  }
  view(name) {
    [this.yaw, this.pitch] = { iso: [-0.62, 0.62], top: [0, Math.PI / 2], front: [0, 0] }[name];
    this.zoom = 1; this.pan = [0, 0]; this.change();
  }
}
