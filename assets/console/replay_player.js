// Time of a replay: plays, stops, seeks; tells its listeners. And the
// pictures that belong to a time.
import { url } from "./api.js";

export class Player {
  constructor(length_s) {
    this.length = length_s;
    this.t = 0;
    this.playing = false;
    this.listeners = new Set();
  }
  onChange(listener) {
    this.listeners.add(listener);
  }
  #tell() {
    for (const listener of this.listeners) listener(this.t, this.playing);
  }

  seek(t) {
    this.t = Math.min(this.length, Math.max(0, t));
    this.#tell();
  }

  toggle() {
    if (this.playing) {
      this.stop();
      return;
    }
    if (this.t >= this.length) this.t = 0;
    this.playing = true;
    let before = performance.now();
    const go = (now) => {
      if (!this.playing) return;
      this.t += (now - before) / 1000;
      before = now;
      if (this.t >= this.length) {
        this.t = this.length;
        this.playing = false;
      }
      this.#tell();
      if (this.playing) requestAnimationFrame(go);
    };
    this.#tell();
    requestAnimationFrame(go);
  }

  stop() {
    this.playing = false;
    this.#tell();
  }
}

/**
 * Shows the picture of a time in `img`: one at a time is fetched, the newest wish wins, so
 * scrubbing does not queue.
 */
export class Pictures {
  constructor(img, session, trial, replay) {
    this.img = img;
    this.replay = replay;
    this.base = url("/api/sessions", session, "trials", String(trial), "frame");
    this.shown = -1;
    this.wanted = -1;
    this.busy = false;
    this.kept = new Map();
  }

  at(t) {
    if (!(this.#there() > 0)) return;
    this.wanted = Math.min(this.#there() - 1, Math.max(0, Math.round(t * (this.replay.fps || 5))));
    if (!this.busy) this.#load();
  }

  /** So many are drawn: the first ones, while the rest is under way. */
  #there() {
    return this.replay.ready ? this.replay.frames : this.replay.drawn || 0;
  }

  async #load() {
    this.busy = true;
    while (this.wanted !== this.shown) {
      const k = this.wanted,
        next = this.#fetched(k);
      this.#fetched(Math.min(k + 1, this.#there() - 1)); // the one after it, for playing
      try {
        await next.decode();
        this.img.src = next.src;
      } catch {
        this.kept.delete(k);
      }
      this.shown = k;
    }
    this.busy = false;
  }

  #fetched(k) {
    if (!this.kept.has(k)) {
      const picture = new Image();
      picture.src = `${this.base}/${k}`;
      this.kept.set(k, picture);
      if (this.kept.size > 60) this.kept.delete(this.kept.keys().next().value);
    }
    return this.kept.get(k);
  }
}
