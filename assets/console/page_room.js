// The room: every station at a glance, from the one console that watches them.
import { get, list, post, url } from "./api.js";
import { confirmed, request } from "./dialog.js";
import { announce, h, put, say } from "./dom.js";
import { clock, liveState, moment, plural, who } from "./format.js";
import { badge, button, choice, field, notice, radios, simulatedBadge, tag } from "./parts.js";

const kLook_ms = 1000,
  kPicture_ms = 2000,
  kEvents = 12; // of the newest, on a card
const kOwnStates = new Map([
  ["free", ["none", "free"]],
  ["starting", ["work", "starting"]],
  ["gone", ["bad", "gone"]],
  ["waiting", ["note", "waits for a start there"]],
]);

const standing = (s) => kOwnStates.get(s.present ? s.state : "gone") ?? liveState(s.state);
const needsSomebody = (s) => !s.present || Boolean(s.alarm);
const inOrder = (a, b) =>
  Number(needsSomebody(b)) - Number(needsSomebody(a)) || a.name.localeCompare(b.name);

/** The room in a sentence. */
function sentence(stations) {
  if (stations.length === 0)
    return (
      "No station has come yet. Pair one (palpa console pair NAME), " +
      "and start its console there with that file."
    );
  const on = stations.filter((s) => s.session).length,
    calling = stations.filter((s) => s.present && s.alarm).length,
    gone = stations.filter((s) => !s.present).length;
  return (
    `${plural(stations.length, "station")}: ${on} in a session` +
    (calling ? `, ${calling} ${calling === 1 ? "calls" : "call"}` : "") +
    (gone ? `, ${gone} gone` : "") +
    "."
  );
}

function details(s) {
  const of = s.trials > 1 ? `Trial ${s.trial} of ${s.trials}` : s.trial ? `Trial ${s.trial}` : "";
  return [s.task, s.session ? who(s.trainee) : "", of, s.trial ? clock(s.elapsed_s, 0) : ""]
    .filter(Boolean)
    .join(" · ");
}

/** What shall be prepared there; nothing: never mind. */
async function askWhatToPrepare(name, choices) {
  const task = choice(choices.tasks.map((t) => [t.id, t.title]));
  const trainee = choice([
    ["", "nobody (T000)"],
    ...choices.trainees.map((t) => [t.id, t.group ? `${t.id}, ${t.group}` : t.id]),
  ]);
  const kind = radios(
    "Kind",
    [
      ["practice", "practice"],
      ["assess", "assessed"],
    ],
    "practice",
  );
  const trials = h("input", { type: "number", value: "1", min: 1, max: 50, step: 1 });
  return request({
    title: `Prepare a session at ${name}`,
    about:
      "The station gets ready and waits. Force begins only after a key or a button at the station.",
    body: [
      field("Task", task),
      field("Trainee", trainee),
      kind.node,
      field("Trials", trials, "From 1 to 50."),
    ],
    yes: "Prepare",
    danger: false,
    answer: () => {
      const count = Number(trials.value);
      if (!Number.isInteger(count) || count < 1 || count > 50)
        return { wrong: "Trials: a whole number from 1 to 50." };
      return {
        task: task.value,
        trainee: trainee.value,
        assess: kind.value() === "assess",
        trials: count,
      };
    },
  });
}

/** One station: made once, then only what changes is written. */
class StationCard {
  constructor(name, choices) {
    this.name = name;
    this.title = h("h2", {}, name);
    this.state = h("div", { class: "row tight" });
    this.words = h("p", { class: "muted" });
    this.alarm = h("div", { role: "alert", class: "alarm" });
    this.picture = h("img", { class: "room-view", alt: `What is seen at ${name}`, hidden: true });
    const said = h("div", { class: "said" });
    const ask = (what, wish) =>
      post(url("/api/room", name, "ask"), { ask: what, wish, session: wish ? "" : this.session });
    const make = (label, work, more = {}) =>
      button(label, work, { trouble: said, "aria-label": `${label}: ${name}`, ...more });
    this.prepare = make("Prepare a session", async () => {
      const wish = await askWhatToPrepare(name, await choices());
      if (!wish) return;
      await ask("prepare", wish);
      announce(`A session is being prepared at ${name}.`);
    });
    this.pause = make("Pause", () => ask("pause"));
    this.stop = make("Stop forces", () => ask("stop"), { class: "danger" });
    this.leave = make("End the session", async () => {
      const sure = await confirmed(
        `End the session at ${name}?`,
        "A trial that runs is broken off; everything until then is kept.",
        "End the session",
      );
      if (sure) await ask("leave");
    });
    this.open = h("a", { target: "_blank", rel: "noreferrer" }, "Open its own console");
    this.events = h("ol", { class: "room-events" });
    this.more = h(
      "details",
      { ontoggle: () => this.more.open && this.readEvents().catch(() => {}) },
      h("summary", {}, "What happened there"),
      this.events,
    );
    this.node = h(
      "section",
      { class: "card room-card" },
      h("div", { class: "row between" }, this.title, this.state),
      this.alarm,
      this.picture,
      this.words,
      said,
      h("div", { class: "row" }, this.prepare, this.pause, this.stop, this.leave),
      this.more,
      h("p", { class: "small" }, this.open),
    );
  }

  show(s) {
    const key = JSON.stringify({ ...s, utc: 0, elapsed_s: 0, events: 0 });
    say(
      this.words,
      s.present
        ? details(s) || "Nobody trains here now."
        : "Its console does not run, or cannot reach the broker: look there.",
    );
    if (this.more.open && s.events !== this.events_) this.readEvents().catch(() => {});
    this.events_ = s.events;
    if (key === this.shown) return;
    this.shown = key;
    this.session = s.session;
    const [tone, word] = standing(s);
    put(
      this.state,
      badge(tone, word),
      s.blind ? tag("blind study") : null,
      s.simulated ? simulatedBadge() : null,
    );
    put(this.alarm, s.present && s.alarm ? notice("stop", s.alarm) : null);
    const on = s.present && Boolean(s.session);
    this.prepare.hidden = on || !s.present;
    for (const b of [this.pause, this.stop, this.leave]) b.hidden = !on;
    this.hasPicture = on && !s.blind;
    if (!this.hasPicture) this.picture.hidden = true;
    this.open.hidden = !s.url || !s.present;
    if (s.url) this.open.href = s.url;
  }

  async readEvents() {
    const all = await get(url("/api/room", this.name, "events"));
    put(
      this.events,
      all.length === 0 ? h("li", {}, "Nothing yet.") : null,
      all
        .slice(-kEvents)
        .reverse()
        .map((e) => h("li", {}, h("span", { class: "muted" }, moment(e.utc)), ` ${e.text}`)),
    );
  }

  /** The next picture takes the place of the last when it is there whole. */
  async look() {
    if (!this.hasPicture) return;
    const next = new Image();
    next.src = `${url("/api/room", this.name, "picture")}?${Date.now()}`;
    try {
      await next.decode();
      this.picture.src = next.src;
      this.picture.hidden = !this.hasPicture;
    } catch {
      this.picture.hidden = true;
    }
  }
}

/** Who is on the network and not in this room. */
function strangersList(watch) {
  if (watch.strangers.length === 0)
    return watch.nearby_trouble ? h("p", { class: "muted" }, watch.nearby_trouble) : null;
  return h(
    "section",
    { class: "card" },
    h("h2", {}, "Found here, not in this room"),
    h(
      "ul",
      {},
      watch.strangers.map((s) =>
        h(
          "li",
          {},
          `${s.name} (${s.host}, port ${s.port}): `,
          s.station
            ? `paired as ${s.station} to another room.`
            : "not paired yet: run palpa console pair NAME here, and bring it that file.",
        ),
      ),
    ),
  );
}

function troubles(watch) {
  return [
    watch.broker.stands
      ? null
      : notice(
          "bad",
          watch.broker.trouble || "The room's broker is being reached…",
          h("p", {}, "The stations go on without it. What stands below is as it was said last."),
        ),
    watch.trouble ? notice("bad", watch.trouble) : null,
  ];
}

export async function show({ root, life, open }) {
  open("Room");
  const first = h("p", { class: "lead", role: "status" }),
    wrong = h("div", {}),
    grid = h("div", { class: "room-grid" }),
    others = h("div", {});
  root.append(first, wrong, grid, others);
  const cards = new Map();
  let made = null;
  const choices = () => {
    made ??= Promise.all([list("/api/tasks"), list("/api/trainees")]).then(
      ([tasks, trainees]) => ({ tasks, trainees }),
      (error) => {
        made = null; // asked again the next time
        throw error;
      },
    );
    return made;
  };
  const add = (name) => {
    const card = new StationCard(name, choices);
    cards.set(name, card);
    grid.append(card.node);
    life.every(kPicture_ms, () => card.look());
  };
  let wrongShown = "",
    othersShown = "";
  const look = async () => {
    const { watch } = await get("/api/room");
    if (!watch) {
      say(first, "This console watches no room. Start it with --room and the room's folder.");
      return false;
    }
    const stations = [...watch.stations].sort(inOrder);
    say(first, sentence(stations));
    const key = JSON.stringify([watch.broker, watch.trouble]);
    if (key !== wrongShown) put(wrong, troubles(watch));
    wrongShown = key;
    const there = JSON.stringify([watch.strangers, watch.nearby_trouble]);
    if (there !== othersShown) put(others, strangersList(watch));
    othersShown = there;
    for (const s of stations) {
      if (!cards.has(s.name)) add(s.name);
      cards.get(s.name).show(s);
    }
    for (const [name, card] of cards) card.node.hidden = !stations.some((s) => s.name === name);
    // Nothing moves under a hand that is about to press.
    if (!grid.matches(":hover, :focus-within"))
      stations.forEach((s, at) => {
        cards.get(s.name).node.style.order = String(at);
      });
    return true;
  };
  life.every(kLook_ms, look);
}
