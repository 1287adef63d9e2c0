// Time of a replay: plays, stops, seeks; tells its listeners. And the
// pictures that belong to a time.
import { url } from "./api.js";

export class Player {
  constructor(length_s) {
    this.length = length_s;
    this.t = 0;
    this.playing = false;
    this.rate = 1;
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
      this.t += (this.rate * (now - before)) / 1000;
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
 * Shows one of many pictures in `img`: one at a time is fetched, the newest wish wins, so scrubbing
 * does not queue.
 */
class PictureReel {
  constructor(img) {
    this.img = img;
    this.shown = -1;
    this.wanted = -1;
    this.busy = false;
    this.kept = new Map();
  }

  /** Overridden: how many there are now, and where one is. */
  there() {
    return 0;
  }
  addressOf(k) {
    return String(k);
  }

  want(k) {
    if (!(this.there() > 0)) return;
    this.wanted = Math.min(this.there() - 1, Math.max(0, k));
    if (!this.busy) this.#load();
  }

  async #load() {
    this.busy = true;
    while (this.wanted !== this.shown) {
      const k = this.wanted,
        next = this.#fetched(k);
      this.#fetched(Math.min(k + 1, this.there() - 1)); // the one after it, for playing
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
      picture.src = this.addressOf(k);
      this.kept.set(k, picture);
      if (this.kept.size > 60) this.kept.delete(this.kept.keys().next().value);
    }
    return this.kept.get(k);
  }
}

/** Pictures drawn of a trial, so many a second. */
export class Pictures extends PictureReel {
  constructor(img, session, trial, replay) {
    super(img);
    this.replay = replay;
    this.base = url("/api/sessions", session, "trials", String(trial), "frame");
  }
  at(t) {
    this.want(Math.round(t * (this.replay.fps || 5)));
  }
  /** So many are drawn: the first ones, while the rest is under way. */
  there() {
    return this.replay.ready ? this.replay.frames : this.replay.drawn || 0;
  }
  addressOf(k) {
    return `${this.base}/${k}`;
  }
}

/** Pictures of the room, each with its own time: [trial's time in s, place in the film, bytes]. */
export class RoomPictures extends PictureReel {
  constructor(img, session, pictures) {
    super(img);
    this.base = url("/api/sessions", session, "room");
    this.pictures = pictures;
  }
  at(t) {
    let low = 0,
      high = this.pictures.length; // the last at or before t is in [low, high)
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (this.pictures[middle][0] <= t + 1e-6) low = middle;
      else high = middle;
    }
    this.want(low);
  }
  there() {
    return this.pictures.length;
  }
  addressOf(k) {
    return `${this.base}/${this.pictures[k][1]}/${this.pictures[k][2]}`;
  }
}
