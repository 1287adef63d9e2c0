// Calibration step by step: what each one is, how old it is, run it,
// watch it, read what came of it.
import { get, list as listed, post, url } from "./api.js";
import { announce, h, put } from "./dom.js";
import { day, isOn, plural } from "./format.js";
import { badge, button, notice, progress, radios, simulatedBadge } from "./parts.js";
import { reportFrame } from "./report_frame.js";

function toneOf(verdict) {
  if (/^(pass|good|well|in order|ok)/i.test(verdict)) return "good";
  if (/^(fail|ill|bad|refus)/i.test(verdict)) return "bad";
  return "note";
}

function age(made) {
  if (!made) return [badge("none", "not done yet")];
  const days = Math.floor((Date.now() - Date.parse(made.made_utc)) / 86_400_000);
  const ago = days < 1 ? ", today" : `, ${plural(days, "day")} ago`;
  return [
    badge(toneOf(String(made.verdict || "")), String(made.verdict || "made")),
    made.simulated ? simulatedBadge() : null,
    h("span", { class: "muted" }, `made ${day(made.made_utc)}${Number.isFinite(days) ? ago : ""}`),
  ];
}

/** How the station stands, in words. */
function standing(all) {
  if (!(all.calibrations || []).length)
    return all.verdict === "pass"
      ? "sessions are scored with the figures in the station's file; " +
          "nothing has been measured here yet"
      : all.verdict || "not judged yet";
  return all.verdict === "pass"
    ? "calibrated, sessions are scored"
    : all.verdict || "not judged yet";
}

function step(one, at, made, run, why_not) {
  return h(
    "li",
    { class: "step" },
    h("span", { class: "step-number", "aria-hidden": "true" }, String(at + 1)),
    h(
      "div",
      {},
      h("h3", {}, one.title || one.id),
      h("p", {}, one.what || ""),
      h("p", { class: "row tight" }, age(made)),
    ),
    button(
      ["Run this step", h("span", { class: "unseen" }, `: ${one.title || one.id}`)],
      () => run(one.id),
      { disabled: Boolean(why_not) },
    ),
  );
}

/** Follows a job to its end, drawing it into `place`. */
async function follow(life, job, place, done) {
  const lines = h("ol", { class: "lines", "aria-live": "polite" }),
    picture = h("img", {
      class: "job-picture",
      alt: "What the camera sees at this moment",
      hidden: true,
    });
  const title = h("h2", {}, "Calibration is running"),
    bar = h("div", {});
  const stop = button("Stop", () => post(url("/api/jobs", job, "stop"), {}));
  put(
    place,
    h("div", { class: "card" }, title, bar, lines, picture, h("div", { class: "row" }, stop)),
  );
  let count = 0,
    shown = "";
  await life.every(700, async () => {
    const now = await get(url("/api/jobs", job));
    put(title, now.title || "Calibration");
    if (now.state !== "working") {
      const good = now.state === "done";
      put(
        place,
        h(
          "div",
          { class: "card" },
          notice(
            good ? "good" : "bad",
            now.message || (good ? "Done." : "It failed; nothing was changed."),
          ),
          now.page ? reportFrame(now.page, "Result of the calibration") : null,
        ),
      );
      announce(now.message || (good ? "Calibration done." : "Calibration failed."));
      done();
      return false;
    }
    put(
      bar,
      progress("Progress of the calibration", now.done),
      h("span", { class: "muted" }, ` ${counted(now.lines) || "under way"}`),
    );
    const text = (now.lines || []).slice(-4);
    if (text.join("\n") !== shown) {
      shown = text.join("\n");
      put(
        lines,
        text.map((line) => h("li", {}, String(line))),
      );
    }
    picture.hidden = !now.picture;
    if (now.picture) picture.src = `${url("/api/jobs", job, "picture")}?n=${++count}`;
    return true;
  });
}

/** What is counted just now, "Views of the board: 3 of 20": each step counts anew. */
function counted(lines) {
  const last = (lines || []).findLast((line) => /\d+ of \d+/.test(line));
  return last?.match(/^.*?\d+ of \d+/)[0].replace(/^\[[#.]*\]\s*/, "");
}

function stateOf(station) {
  const good = station.measured
    ? "calibrated"
    : "nothing measured here yet; the station's file gives the figures";
  return `${station.title}: ${station.trouble || good}`;
}

/** Which station: each is calibrated by itself. Made once, so that the keyboard's place stays. */
function chooser(stations, kind, choose) {
  const choice = radios(
    "Station",
    stations.map((s) => [s.kind, s.for, stateOf(s)]),
    kind,
    () => choose(choice.value()),
  );
  return {
    node: choice.node,
    tell(now) {
      for (const [at, hint] of [...choice.node.querySelectorAll(".hint")].entries())
        put(hint, stateOf(now[at]));
    },
  };
}

export async function show({ root, life, open, query }) {
  open("Calibrate");
  const choice = h("div", {}),
    head = h("div", {}),
    work = h("div", { id: "calibration-work", tabindex: "-1" }),
    list = h("div", {});
  root.append(choice, head, work, list);
  let kind = query.get("station") || "needle",
    stationChoice = null,
    running = false,
    blocked = false; // a session is on
  const watch = (job) => {
    running = true;
    follow(life, job, work, () => {
      running = false;
      draw();
    });
  };
  const run = async (id) => {
    put(work); // what another one has left there says nothing of this one
    const started = await post("/api/calibration", { kind, step: id });
    window.scrollTo(0, 0);
    announce("The calibration has started.");
    watch(started.job);
    await draw();
    work.focus({ preventScroll: true });
  };
  const draw = async () => {
    const all = await get(`/api/calibration?kind=${encodeURIComponent(kind)}`);
    const stations = all.stations || [];
    if (stationChoice) {
      stationChoice.tell(stations);
    } else {
      stationChoice = chooser(stations, kind, (other) => {
        kind = other;
        if (!running) put(work);
        draw();
      });
      put(choice, stationChoice.node);
    }
    const made = new Map((all.calibrations || []).map((c) => [c.name, c]));
    put(
      head,
      h("p", { class: "lead" }, `${all.station || "This station"}: ${standing(all)}.`),
      h(
        "p",
        { class: "muted" },
        "Each step takes a minute or less. " +
          "A new result replaces the old one only when it is good enough." +
          (all.all ? "" : " The other steps need points to touch, which this station lacks."),
      ),
    );
    blocked = Boolean(all.blocked);
    const why_not = running
      ? "A calibration is running. The next one can begin when it is over."
      : all.blocked;
    const others = (all.calibrations || []).filter(
      (c) => !(all.steps || []).some((s) => s.id === c.name),
    );
    put(
      list,
      h(
        "div",
        { class: "row between" },
        h("h2", {}, "Steps"),
        all.all
          ? button("Run all steps", () => run("all"), {
              class: "primary",
              disabled: Boolean(why_not),
            })
          : null,
      ),
      why_not ? h("p", { class: "hint" }, why_not) : null,
      h(
        "ol",
        { class: "steps" },
        (all.steps || []).map((one, at) => step(one, at, made.get(one.id), run, why_not)),
      ),
      others.length
        ? [
            h("h2", {}, "Also in use"),
            h(
              "ul",
              { class: "plain" },
              others.map((c) => h("li", { class: "row tight" }, h("strong", {}, c.name), age(c))),
            ),
          ]
        : null,
    );
    return all;
  };
  const all = await draw();
  if (all.job) {
    watch(all.job);
    await draw();
  }
  life.every(4000, async () => {
    if ((await listed("/api/sessions")).some(isOn) !== blocked) await draw();
  });
}
