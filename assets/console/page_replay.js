// A trial again: picture, force, depth, phases and events on one time; another trial beside it.
import { h, mark, put, say, svg } from "./dom.js";
import { clock, figure, plural } from "./format.js";
import { said } from "./language.js";
import { asTable, choice, field, notice, progress, table } from "./parts.js";
import { needleTrack } from "./needle_track.js";
import { loadReplay, momentsOf, trialsBeside } from "./replay_data.js";
import { Pictures, Player } from "./replay_player.js";
import { valueAt } from "./scale.js";
import { roomFilm } from "./room_film.js";
import { Timeline } from "./timeline.js";

const kLanes = [
  { id: "phases", kind: "bands", label: "Phase", height: 26 },
  { id: "moments", kind: "moments", label: "Events", height: 24 },
  { id: "force", kind: "curve", label: "Force", unit: "N", height: 110, least: [0, 2] },
  {
    id: "depth",
    kind: "curve",
    label: "Depth",
    unit: "mm",
    height: 110,
    least: [0, 20],
    inverted: true,
  },
];
const kWords = { good: "good", bad: "error", near: "near miss", note: "note" };

function view(alt, caption) {
  const img = h("img", { alt, width: 1280, height: 720, class: "absent" }),
    word = h("div", { class: "view-word" }),
    note = h("figcaption", {}, caption);
  img.addEventListener("load", () => img.classList.remove("absent"));
  return {
    img,
    node: h("figure", {}, h("div", { class: "view-box" }, word, img), note),
    show(replay) {
      const some = !replay.ready && replay.drawn > 0;
      say(note, some ? `${caption}. Drawn so far: ${plural(replay.drawn, "picture")}` : caption);
      if (some) return void put(word);
      put(
        word,
        replay.failed
          ? h("p", {}, replay.failed)
          : replay.ready
            ? replay.frames > 0
              ? ""
              : h("p", {}, `There are no pictures of this trial. ${replay.trouble || ""}`)
            : h(
                "div",
                {},
                h("p", {}, "Pictures are being drawn…"),
                progress("Pictures drawn", replay.done),
              ),
      );
    },
  };
}

/** Slider, play, step; the same keys on the whole page. */
function playerBar(life, player, step) {
  const play = h(
    "button",
    { type: "button", class: "primary", id: "play", onclick: () => player.toggle() },
    "Play",
  );
  const slider = h("input", {
    type: "range",
    min: 0,
    max: player.length,
    step: 0.01,
    value: "0",
    "aria-label": "Time of the trial",
    class: "slider",
    oninput: () => player.seek(Number(slider.value)),
  });
  const time = h("span", { class: "player-time" });
  const speed = choice(
    [0.25, 0.5, 1, 2, 4].map((x) => [String(x), `${x} ×`]),
    "1",
  );
  speed.setAttribute("aria-label", said("Speed"));
  speed.addEventListener("change", () => {
    player.rate = Number(speed.value);
  });
  player.onChange((t, playing) => {
    say(play, playing ? "Pause" : "Play");
    say(time, `${clock(t)} of ${clock(player.length)}`);
    slider.value = String(t);
    slider.setAttribute("aria-valuetext", said(`${clock(t)} of ${clock(player.length)}`));
  });
  life.listen(window, "keydown", (e) => {
    if (!["ArrowLeft", "ArrowRight"].includes(e.key) || e.ctrlKey || e.altKey || e.metaKey) return;
    if (
      e.target instanceof Element &&
      e.target !== slider &&
      e.target.closest("input, select, textarea, dialog")
    )
      return;
    e.preventDefault();
    player.seek(player.t + (e.key === "ArrowRight" ? 1 : -1) * step * (e.shiftKey ? 5 : 1));
  });
  return [
    h(
      "div",
      { class: "player" },
      play,
      speed,
      time,
      h(
        "span",
        { class: "hint" },
        "Arrow keys step one picture, with Shift five; click a curve to go there.",
      ),
    ),
    h("div", { class: "slider-row" }, slider),
  ];
}

/** To the beginning of each phase; nothing where a trial has none. */
function chapters(player, phases) {
  const named = phases.filter((p) => p.name);
  if (!named.length) return null;
  return h(
    "nav",
    { class: "chapters", "aria-label": "Phases" },
    named.map((p) =>
      h(
        "button",
        { type: "button", class: "quiet", onclick: () => player.seek(p.from_s) },
        `${clock(p.from_s, 0)} ${p.name}`,
      ),
    ),
  );
}

function eventList(player, moments) {
  const rows = moments.map((m) => ({
    m,
    node: h(
      "li",
      { class: `event ${m.tone}` },
      mark(m.tone),
      h(
        "button",
        {
          type: "button",
          class: "quiet",
          "aria-label": `Go to ${clock(m.t)}`,
          onclick: () => player.seek(m.t),
        },
        clock(m.t),
      ),
      h("span", {}, kWords[m.tone] ? h("strong", {}, `${kWords[m.tone]}: `) : null, m.text),
    ),
  }));
  player.onChange((t) => {
    let now = null;
    for (const row of rows) if (row.m.t <= t + 0.01) now = row;
    for (const row of rows) row.node.classList.toggle("now", row === now);
  });
  return rows.length
    ? h(
        "ol",
        { class: "events" },
        rows.map((r) => r.node),
      )
    : h("p", { class: "muted" }, "Nothing was noted.");
}

function secondsTable(replay) {
  const rows = [];
  for (let t = 0; t <= replay.length; ++t)
    rows.push([
      clock(t, 0),
      figure(valueAt(replay.t, replay.force, t), 2),
      figure(valueAt(replay.t, replay.depth, t), 1),
      momentsOf(replay)
        .filter((m) => m.t >= t && m.t < t + 1)
        .map((m) => m.text)
        .join("; "),
    ]);
  return table(
    "Force, depth and events, each second",
    ["Time", "Force, N", "Depth, mm", "Events"],
    rows,
  );
}

const line = (second) =>
  svg(
    "svg",
    { class: "line", viewBox: "0 0 34 10", width: 34, height: 10, "aria-hidden": "true" },
    svg("path", { class: `curve ${second ? "second" : ""}`, d: "M1 5H33" }),
  );
const key = (beside) =>
  h(
    "p",
    { class: "key" },
    h("span", {}, line(false), "this trial"),
    beside ? h("span", {}, line(true), "the other trial (dashed)") : null,
    ["good", "bad", "near", "note"].map((tone) => h("span", {}, mark(tone), kWords[tone])),
  );

/** The page once the curves are there. */
function build({ root, life, id, n, replay, options }) {
  const player = new Player(replay.length),
    mine = view("Picture of this trial at the chosen time", `This trial: ${n}`),
    views = h("div", { class: "replay-views" }, mine.node),
    legend = h("div", {}),
    way = h("div", {}),
    room = h("div", {}),
    problems = h("div", {});
  const timeline = new Timeline({
    title: "Phases, events, force and depth of the trial over time",
    lanes: kLanes,
    tickWord: (t) => clock(t, 0),
    onSeek: (t) => player.seek(t),
  });
  life.atEnd(() => {
    timeline.end();
    player.stop();
  });
  const pictures = new Pictures(mine.img, id, n, replay);
  let track = null,
    film = null,
    other = null,
    otherPictures = null,
    turn = 0;
  const draw = () => {
    player.length = Math.max(replay.length, other?.length || 0);
    root.querySelector(".slider").max = player.length;
    const both = (name) =>
      [{ t: replay.t, v: replay[name] }].concat(
        other ? [{ t: other.t, v: other[name], second: true }] : [],
      );
    Object.assign(timeline, {
      from: 0,
      to: player.length,
      curves: { force: both("force"), depth: both("depth") },
      bands: replay.phases.map((p) => ({ from: p.from_s, to: p.to_s, name: String(p.name || "") })),
      moments: momentsOf(replay),
    });
    timeline.draw();
    put(legend, key(!!other));
    player.seek(player.t);
  };
  const select = choice([["", "no other trial"], ...options], "");
  const beside = () => {
    const mineTurn = ++turn,
      at = select.value.lastIndexOf("/");
    other = otherPictures = null;
    views.classList.toggle("two", !!select.value);
    put(views, mine.node);
    put(problems);
    if (!select.value) {
      draw();
      return;
    }
    const second = view(
        "Picture of the other trial at the same time after its start",
        select.selectedOptions[0].textContent,
      ),
      [oid, on] = [select.value.slice(0, at), Number(select.value.slice(at + 1))];
    views.append(second.node);
    loadReplay(life, oid, on, (loaded) => {
      if (mineTurn !== turn) return;
      second.show(loaded);
      if (loaded.failed) {
        put(problems, notice("bad", loaded.failed));
        return;
      }
      other = loaded;
      otherPictures = new Pictures(second.img, oid, on, loaded);
      draw();
    });
  };
  select.addEventListener("change", beside);
  player.onChange((t) => {
    timeline.moveCursor(t);
    track?.at(t);
    film?.at(t);
    pictures.at(t);
    otherPictures?.at(Math.min(t, other.length));
  });
  root.append(
    views,
    ...playerBar(life, player, 1 / (replay.fps || 5)),
    ...[chapters(player, replay.phases)].filter((x) => x),
    way,
    room,
    timeline.node,
    legend,
    h(
      "div",
      { class: "replay-lists" },
      h(
        "section",
        { class: "card", "aria-label": "Events" },
        h("h2", {}, "Events"),
        eventList(player, momentsOf(replay)),
      ),
      h(
        "section",
        { class: "card", "aria-label": "Beside" },
        h("h2", {}, "Side by side"),
        field(
          "Another trial",
          select,
          "Both are shown from their start. An expert's is a good choice.",
        ),
        problems,
      ),
    ),
    asTable("Data as a table", () => secondsTable(replay)),
  );
  draw();
  roomFilm(id, n)
    .then((found) => {
      film = found;
      put(room, film?.node);
      film?.at(player.t);
    })
    .catch(() => null);
  let asked = false;
  const showWay = async () => {
    if (asked) return;
    asked = true;
    track = await needleTrack(id, n).catch(() => null);
    if (!track) return;
    put(way, track.node);
    track.at(player.t);
  };
  return (changed) => {
    Object.assign(replay, changed);
    mine.show(replay);
    pictures.at(player.t);
    if (replay.track) showWay();
  };
}

export async function show({ root, life, params: [id, number], open }) {
  const n = Number(number);
  open(
    `Replay of trial ${number}`,
    h("a", { class: "button", href: `#/results/${encodeURIComponent(id)}` }, "Back to the result"),
  );
  const waiting = notice("work", "The trial is being read…");
  root.append(waiting);
  const options = await trialsBeside(id, n);
  let update = null;
  await loadReplay(life, id, n, (replay) => {
    waiting.remove();
    if (replay.failed) {
      root.append(notice("bad", replay.failed));
      return;
    }
    update ||= build({ root, life, id, n, replay, options });
    update(replay);
  });
}
