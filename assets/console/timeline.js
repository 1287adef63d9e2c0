// Lanes over one time axis: curves, phases and moments of a trial, with a cursor.
// Used live and in the replay.
import { h, put, svg } from "./dom.js";
import { said } from "./language.js";
import { pathOf, ticks } from "./scale.js";

const kLeft = 64,
  kRight = 14,
  kTop = 6,
  kAxis = 30,
  kGap = 12;

/**
 * lanes: {id, kind: 'curve', label, unit, height, inverted, least: [low, high]} |
 *        {id, kind: 'bands' | 'moments', label, height}
 * curves[id] = [{t, v, second}], bands = [{from, to, name}], moments = [{t, tone, text}];
 * all times in seconds of the same axis.
 */
export class Timeline {
  constructor({ title, lanes, tickWord = (t) => `${t} s`, onSeek = null, relative = false }) {
    this.relative = relative;
    this.lanes = lanes;
    this.tickWord = tickWord;
    this.curves = {};
    this.bands = [];
    this.moments = [];
    this.from = 0;
    this.to = 30;
    this.width = 0;
    this.cursorAt = NaN;
    this.height = kTop + kAxis + lanes.reduce((sum, lane) => sum + lane.height + kGap, 0);
    this.title = svg("title", {}, title);
    this.frame = svg("g", {});
    this.content = svg("g", {});
    this.cursor = svg("line", {
      class: "cursor",
      y1: kTop,
      y2: this.height - kAxis,
      visibility: "hidden",
    });
    this.svg = svg(
      "svg",
      {
        class: "timeline",
        role: "img",
        "aria-label": title,
        height: this.height,
        preserveAspectRatio: "none",
      },
      this.title,
      this.frame,
      this.content,
      this.cursor,
    );
    this.node = h("div", { class: onSeek ? "timeline-box seeks" : "timeline-box" }, this.svg);
    if (onSeek) this.#seekBy(onSeek);
    this.sizes = new ResizeObserver(() => this.#resize());
    this.sizes.observe(this.node);
  }

  end() {
    this.sizes.disconnect();
  }
  x(t) {
    return kLeft + ((t - this.from) / (this.to - this.from)) * (this.width - kLeft - kRight);
  }
  timeAt(px) {
    return (
      this.from + ((px - kLeft) / Math.max(1, this.width - kLeft - kRight)) * (this.to - this.from)
    );
  }

  #seekBy(onSeek) {
    const seek = (e) => {
      const box = this.svg.getBoundingClientRect();
      onSeek(Math.min(this.to, Math.max(this.from, this.timeAt(e.clientX - box.left))));
    };
    this.svg.addEventListener("pointerdown", (e) => {
      this.svg.setPointerCapture(e.pointerId);
      seek(e);
    });
    this.svg.addEventListener("pointermove", (e) => {
      if (e.buttons & 1) seek(e);
    });
  }

  #resize() {
    const width = Math.round(this.node.clientWidth);
    if (width === this.width || width === 0) return;
    this.width = width;
    this.svg.setAttribute("width", width);
    this.svg.setAttribute("viewBox", `0 0 ${width} ${this.height}`);
    this.framed = "";
    this.draw();
  }

  /** The range of a curve's axis: what is there, at least `least`, in round figures. */
  #range(lane) {
    let [low, high] = lane.least;
    for (const curve of this.curves[lane.id] || [])
      for (const v of curve.v) {
        if (v < low) low = v;
        if (v > high) high = v;
      }
    const marks = ticks(low, high, 3);
    const step = marks.length > 1 ? marks[1] - marks[0] : high - low;
    return [Math.floor(low / step + 1e-6) * step, Math.ceil(high / step - 1e-6) * step];
  }

  draw() {
    if (this.width === 0) return;
    const made = [],
      ranges = [];
    let top = kTop;
    for (const lane of this.lanes) {
      const box = { lane, top, bottom: top + lane.height };
      if (lane.kind === "curve") {
        box.range = this.#range(lane);
        ranges.push(...box.range);
        made.push(...this.#curve(box));
      } else made.push(...(lane.kind === "bands" ? this.#bandsIn(box) : this.#momentsIn(box)));
      lane.box = box;
      top = box.bottom + kGap;
    }
    const axis = this.relative ? this.to - this.from : `${this.from} ${this.to}`;
    const framed = `${this.width} ${axis} ${ranges.join(" ")}`;
    if (framed !== this.framed) {
      this.framed = framed;
      put(this.frame, this.#frames());
    }
    put(this.content, made);
    this.moveCursor(this.cursorAt);
  }

  moveCursor(t) {
    this.cursorAt = t;
    const shown = t >= this.from && t <= this.to && this.width > 0;
    this.cursor.setAttribute("visibility", shown ? "visible" : "hidden");
    if (!shown) return;
    this.cursor.setAttribute("x1", this.x(t));
    this.cursor.setAttribute("x2", this.x(t));
  }

  #y(box) {
    const [low, high] = box.range,
      height = box.bottom - box.top;
    return box.lane.inverted
      ? (v) => box.top + ((v - low) / (high - low)) * height
      : (v) => box.bottom - ((v - low) / (high - low)) * height;
  }

  #curve(box) {
    const y = this.#y(box),
      x = (t) => this.x(t);
    return (this.curves[box.lane.id] || []).map((c) =>
      svg("path", {
        class: `curve ${c.second ? "second" : ""}`,
        d: pathOf(c.t, c.v, this.from, this.to, x, y),
      }),
    );
  }

  #bandsIn({ top, bottom }) {
    return this.bands
      .filter((b) => b.to > this.from && b.from < this.to)
      .map((b, at) => {
        const left = this.x(Math.max(b.from, this.from)),
          width = Math.max(1, this.x(Math.min(b.to, this.to)) - left - 2);
        const room = Math.floor((width - 12) / 7.6);
        const name = said(b.name);
        const word = room >= name.length ? name : room > 3 ? `${name.slice(0, room - 1)}…` : "";
        return svg(
          "g",
          {},
          svg("title", {}, b.name),
          svg("rect", {
            class: at % 2 ? "band odd" : "band",
            x: left,
            y: top,
            width,
            height: bottom - top,
            rx: 3,
          }),
          svg("text", { class: "band-name", x: left + 7, y: (top + bottom) / 2 + 5 }, word),
        );
      });
  }

  #momentsIn({ top, bottom }) {
    const shapes = {
      good: (r) => svg("circle", { r: r * 0.95 }),
      bad: (r) => svg("path", { d: `M0 ${-1.25 * r}L${1.25 * r} 0 0 ${1.25 * r} ${-1.25 * r} 0z` }),
      note: (r) => svg("path", { d: `M0 ${-r}L${r * 1.1} ${r} ${-r * 1.1} ${r}z` }),
      near: (r) => svg("path", { d: `M0 ${r * 1.2}L${r * 1.3} ${-r} ${-r * 1.3} ${-r}z` }),
      neutral: (r) => svg("rect", { x: -2, y: -r, width: 4, height: 2 * r, rx: 1 }),
    };
    return this.moments
      .filter((m) => m.t >= this.from && m.t <= this.to)
      .map((m) => {
        const tone = shapes[m.tone] ? m.tone : "neutral";
        const x = this.x(m.t);
        return svg(
          "g",
          { class: `moment ${tone}` },
          svg("title", {}, m.text),
          svg("line", { class: "reach", x1: x, x2: x, y1: kTop, y2: this.height - kAxis }),
          svg("g", { transform: `translate(${x} ${(top + bottom) / 2})` }, shapes[tone](7)),
        );
      });
  }

  /**
   * Figures at a lane's edge: round steps where there is room, else its ends, and
   * 0 when it is clear of both.
   */
  #values({
    height,
    box: {
      range: [low, high],
    },
  }) {
    if (height > 90) return ticks(low, high, 4);
    const room = (Math.min(-low, high) / (high - low)) * height;
    return room >= 25 ? [low, 0, high] : [low, high];
  }

  #frames() {
    const right = this.width - kRight,
      foot = this.height - kAxis,
      made = [];
    // Relative: times are counted back from the right edge.
    const origin = this.relative ? this.to : 0;
    for (const tick of ticks(
      this.from - origin,
      this.to - origin,
      Math.max(2, Math.floor((right - kLeft) / 110)),
    )) {
      const t = tick + origin;
      made.push(svg("line", { class: "grid", x1: this.x(t), x2: this.x(t), y1: kTop, y2: foot }));
      const anchor = this.x(t) > right - 24 ? "end" : this.x(t) < kLeft + 8 ? "start" : "middle";
      made.push(
        svg(
          "text",
          { class: "tick", x: this.x(t), y: foot + 20, "text-anchor": anchor },
          this.tickWord(tick),
        ),
      );
    }
    for (const lane of this.lanes) {
      const { top, bottom, range } = lane.box;
      if (lane.kind !== "curve") {
        made.push(svg("text", { class: "lane-name", x: 2, y: (top + bottom) / 2 + 5 }, lane.label));
        continue;
      }
      made.push(
        svg("rect", {
          class: "lane",
          x: kLeft,
          y: top,
          width: right - kLeft,
          height: bottom - top,
        }),
      );
      if (range[0] < 0 && range[1] > 0) {
        const y = this.#y(lane.box)(0);
        made.push(svg("line", { class: "zero", x1: kLeft, x2: right, y1: y, y2: y }));
      }
      for (const v of this.#values(lane)) {
        const y = this.#y(lane.box)(v);
        made.push(
          svg("line", { class: "grid", x1: kLeft, x2: right, y1: y, y2: y }),
          svg(
            "text",
            {
              class: "tick",
              x: kLeft - 8,
              y: Math.min(bottom, Math.max(top + 10, y + 5)),
              "text-anchor": "end",
            },
            String(Number(v.toFixed(3))),
          ),
        );
      }
      made.push(
        svg(
          "text",
          { class: "curve-name", x: kLeft + 8, y: lane.inverted ? bottom - 8 : top + 16 },
          `${lane.label}, ${lane.unit}`,
        ),
      );
    }
    return made;
  }
}
