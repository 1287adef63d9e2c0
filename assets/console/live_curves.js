// Force and depth of the trial that is on: the last half minute large, the whole trial small.
import { h } from "./dom.js";
import { clock, figure } from "./format.js";
import { asTable, table } from "./parts.js";
import { valueAt } from "./scale.js";
import { Timeline } from "./timeline.js";

const kWindow_s = 30,
  kDraw_ms = 90,
  kWhole_ms = 500;

const known = (x) => (Number.isFinite(x) ? x : NaN);
const lanes = (tall) => [
  { id: "moments", kind: "moments", label: "Events", height: 20 },
  { id: "force", kind: "curve", label: "Force", unit: "N", height: tall, least: [0, 2] },
  {
    id: "depth",
    kind: "curve",
    label: "Depth",
    unit: "mm",
    height: tall,
    least: [0, 20],
    inverted: true,
  },
];

export class LiveCurves {
  constructor(life) {
    this.recent = new Timeline({
      title: "Force and depth, the last 30 seconds",
      lanes: lanes(56),
      tickWord: (t) => (t === 0 ? "now" : `${t} s`),
      relative: true,
    });
    this.whole = new Timeline({
      title: "Force and depth, the whole trial",
      lanes: lanes(40),
      tickWord: (t) => clock(t, 0),
    });
    this.node = h(
      "section",
      { class: "card curves", "aria-label": "Force and depth", "data-points": "0" },
      h("h2", {}, "The last 30 seconds"),
      this.recent.node,
      h("h2", {}, "The whole trial"),
      this.whole.node,
      asTable("Data as a table", () => this.#table()),
    );
    this.clear(1);
    this.drawn = this.drawnWhole = 0;
    life.atEnd(() => {
      this.recent.end();
      this.whole.end();
    });
    const frame = (now) => {
      if (life.over) return;
      if (this.dirty && now - this.drawn >= kDraw_ms && !document.hidden) this.#draw(now);
      requestAnimationFrame(frame);
    };
    requestAnimationFrame(frame);
  }

  clear(trial) {
    this.trial = trial;
    this.start = NaN;
    this.t = [];
    this.force = [];
    this.depth = [];
    this.moments = [];
    this.dirty = true;
  }

  add(message) {
    const trial = Number(message.trial) || this.trial;
    if (trial < this.trial) return;
    if (trial > this.trial) this.clear(trial);
    const times = message.t_s || [];
    for (let k = 0; k < times.length; ++k) {
      if (!Number.isFinite(times[k])) continue;
      if (Number.isNaN(this.start)) this.start = times[k];
      const t = times[k] - this.start;
      if (this.t.length && t <= this.t[this.t.length - 1]) continue;
      this.t.push(t);
      this.force.push(known(message.force_N?.[k]));
      this.depth.push(known(message.depth_mm?.[k]));
    }
    this.dirty = true;
  }

  moment(message, tone) {
    const trial = Number(message.trial) || this.trial;
    if (trial > this.trial) this.clear(trial);
    if (trial === this.trial)
      this.moments.push({ at: message.t_s, tone, text: message.text || "" });
    this.dirty = true;
  }

  #draw(now) {
    this.drawn = now;
    this.dirty = false;
    const end = this.t.length ? this.t[this.t.length - 1] : 0;
    const all = { force: [{ t: this.t, v: this.force }], depth: [{ t: this.t, v: this.depth }] };
    const moments = this.moments
      .map((m) => ({ t: m.at - this.start, tone: m.tone, text: m.text }))
      .filter((m) => Number.isFinite(m.t));
    Object.assign(this.recent, { from: end - kWindow_s, to: end, curves: all, moments });
    this.recent.draw();
    this.node.dataset.points = String(this.t.length);
    if (now - this.drawnWhole < kWhole_ms) {
      this.dirty = true;
      return;
    }
    this.drawnWhole = now;
    Object.assign(this.whole, {
      from: 0,
      to: Math.max(kWindow_s, Math.ceil(end / kWindow_s) * kWindow_s),
      curves: all,
      moments,
    });
    this.whole.draw();
  }

  #table() {
    const rows = [];
    for (let t = 0; this.t.length && t <= this.t[this.t.length - 1]; ++t)
      rows.push([
        clock(t, 0),
        figure(valueAt(this.t, this.force, t), 2),
        figure(valueAt(this.t, this.depth, t), 1),
      ]);
    return rows.length
      ? table(`Trial ${this.trial}, each second until now`, ["Time", "Force, N", "Depth, mm"], rows)
      : h("p", { class: "muted" }, "No figures yet.");
  }
}
