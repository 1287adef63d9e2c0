// The session that is on: picture, controls, curves, events, notes.
import { get, lostSince, url, watchConnection } from "./api.js";
import { announce, h, put, say } from "./dom.js";
import { clock, figure as figureOf, isOn, liveState, taskName, who } from "./format.js";
import { LiveControls } from "./live_controls.js";
import { LiveCurves } from "./live_curves.js";
import { LiveEvents } from "./live_events.js";
import { followPicture, followSession } from "./live_stream.js";
import { badge, notice, simulatedBadge, tag } from "./parts.js";
import { isRated, ratingForm } from "./rating_form.js";

/** The session's second, carried on between messages while a trial runs. */
class SessionTime {
  constructor() {
    this.t = 0;
    this.at = performance.now();
    this.running = false;
  }
  hear(t_s) {
    if (Number.isFinite(t_s) && t_s >= this.t) {
      this.t = t_s;
      this.at = performance.now();
    }
  }
  now() {
    return this.t + (this.running ? Math.min(3, (performance.now() - this.at) / 1000) : 0);
  }
}

const kBlind =
  "This session belongs to a study whose educators are blinded: you see how it stands, which " +
  "trial it is, its time, stops and your notes. Pictures, forces and results could tell the " +
  "condition that was drawn; they are read when the study is.";

function figures(blind) {
  const made = {};
  const one = (key, name) => {
    made[key] = h("dd", {}, "–");
    return blind && key !== "time"
      ? null
      : h("div", { class: `figure-${key}` }, h("dt", {}, name), made[key]);
  };
  const node = h(
    "dl",
    { class: "card live-figures" },
    one("time", "Time of the trial"),
    one("force", "Force"),
    one("depth", "Depth"),
    one("phase", "Phase"),
    one("touched", "Structure touched"),
  );
  // What the trainee's screen says; in an assessed trial it says little, and curves and events tell
  // the educator the rest.
  let said = {},
    last = {};
  const draw = () => {
    const phase = (said.phase || "").replace(/^Trial \d+ of \d+\s*/, "");
    say(made.time, clock(said.elapsed_s));
    say(
      made.force,
      said.force || (Number.isFinite(last.force) ? `${figureOf(last.force, 1)} N` : "–"),
    );
    say(
      made.depth,
      said.depth || (Number.isFinite(last.depth) ? `${figureOf(last.depth, 0)} mm` : "–"),
    );
    say(made.phase, phase || last.phase || "–");
    say(made.touched, said.touched || "none");
  };
  return {
    node,
    show(s) {
      said = s;
      draw();
    },
    curve(m) {
      last.force = m.force_N?.at(-1);
      last.depth = m.depth_mm?.at(-1);
      draw();
    },
    event(m) {
      if (m.event === "phase") last.phase = m.text;
      if (m.event === "start") last = {};
      draw();
    },
  };
}

function picture() {
  const img = h("img", {
      class: "view absent",
      alt: "Live picture: what the trainee sees",
      width: 1280,
      height: 720,
    }),
    still = h("canvas", { role: "img", "aria-label": "The last picture" }),
    word = h("p", { class: "view-word" }, "Waiting for the picture…");
  return {
    node: h("div", { class: "view-box" }, word, still, img),
    img,
    still,
    seen(is) {
      word.hidden = is;
    },
    moves(is) {
      img.classList.toggle("absent", !is);
    },
    over() {
      say(word, "The session is over.");
    },
  };
}

/** The pictures of a trial are begun before anybody asks: a debrief follows at once. */
function drawAhead(id, trial) {
  get(`${url("/api/sessions", id, "trials", String(trial), "replay")}?only=pictures`).catch(() => {
    /* the replay's page says what is wrong */
  });
}

export async function show({ root, life, params: [id], open }) {
  const session = await get(url("/api/sessions", id));
  if (life.over) return;
  if (!isOn(session)) {
    location.replace(`#/results/${encodeURIComponent(id)}`);
    return;
  }
  document.body.dataset.sessionOn = "yes";
  const state = h("p", { class: "live-state", role: "status" }),
    tags = h("div", { class: "row tight" });
  open(taskName(session), tags, state);
  const alarm = h("div", { role: "alert", class: "alarm" }),
    over = h("div", {});
  const time = new SessionTime(),
    controls = new LiveControls(life, id),
    curves = new LiveCurves(life),
    events = new LiveEvents(life, id, () => time.now()),
    figure = figures(session.blind),
    view = picture();
  const keys = h(
    "p",
    { class: "muted small keys" },
    "Keys: Ctrl . (Control and full stop) is the emergency stop, from anywhere on this page; " +
      "M marks a moment, unless you are typing. " +
      "The emergency stop goes over the network: at the station, use the stop there first.",
  );
  root.append(
    controls.node,
    controls.said,
    alarm,
    over,
    h(
      "div",
      { class: "live" },
      session.blind
        ? h("div", { class: "stack" }, notice("note", kBlind))
        : h("div", { class: "stack" }, view.node, curves.node),
      h("div", { class: "stack side" }, figure.node, events.node),
    ),
    keys,
  );
  const marks = h("div", {});
  root.append(marks);
  const rated = new Set(); // trials whose form is there; that of the one before stays
  const rate = (trial) => {
    if (!isRated(session) || !(trial > 0) || rated.has(trial)) return;
    rated.add(trial);
    ratingForm(life, id, trial, false)
      .then((form) => marks.append(form))
      .catch(() => rated.delete(trial)); // with the next word of the session
  };
  const moving = session.blind ? { again() {}, stop() {} } : followPicture(life, id, view);
  life.atEnd(
    watchConnection((since) => {
      if (!since) moving.again();
    }),
  );
  const title = (hello) =>
    put(
      tags,
      tag(who(hello.trainee)),
      session.blind ? tag("blind study") : tag(hello.assessed ? "assessed" : "practice"),
      session.filmed ? tag("the room is filmed") : null,
      hello.simulated ? simulatedBadge() : null,
    );
  title(session);

  let stateShown = "",
    alarmShown = "";
  const showStatus = (s) => {
    time.running = s.state === "running";
    const [tone, word] = liveState(s.state),
      between = ["checking", "waiting"].includes(s.state), // the next one is meant
      at = Math.min(Number(s.trial) + (between ? 1 : 0), Number(s.trials)),
      of = Number(s.trials) > 1 ? `, trial ${at} of ${s.trials}` : "";
    const line = `${word}${of}${s.notice && !s.alarm ? `. ${s.notice}` : ""}`;
    if (line !== stateShown) {
      stateShown = line;
      put(state, badge(tone, word + of), s.notice && !s.alarm ? h("span", {}, s.notice) : null);
    }
    const cry = s.emergency_stop
      ? "EMERGENCY STOP: forces are off. Re-arm when hands are clear of the device, then continue."
      : s.alarm
        ? s.notice || "Alarm."
        : "";
    if (cry !== alarmShown) {
      alarmShown = cry;
      put(alarm, cry ? notice("stop", cry) : null);
    }
    rate(Number(s.trial));
    if (Number(s.trial) > curves.trial) curves.clear(Number(s.trial));
    controls.show(s);
    figure.show(s);
  };
  const showEnd = (end) => {
    document.body.dataset.sessionOn = "no";
    time.running = false;
    const good = end.state === "finished",
      last = session.blind || end.state === "failed" ? 0 : curves.trial;
    if (last > 0) drawAhead(id, last);
    put(
      over,
      h(
        "div",
        { class: "over" },
        notice(
          good ? "good" : end.state === "failed" ? "bad" : "note",
          end.message ||
            (good
              ? "The session is over; everything was kept."
              : `The session ended: ${end.state || "unknown"}.`),
        ),
        h(
          "div",
          { class: "row" },
          h(
            "a",
            { class: "button primary big", href: `#/results/${encodeURIComponent(id)}` },
            "Read the result",
          ),
          last > 0
            ? h(
                "a",
                { class: "button", href: `#/replay/${encodeURIComponent(id)}/${last}` },
                "Debrief: the last trial again",
              )
            : null,
          h("a", { class: "button", href: "#/session" }, "Another session"),
        ),
      ),
    );
    put(state, badge("none", "Session is over"));
    put(alarm);
    controls.end();
    events.end();
    moving.stop();
    view.over();
    keys.hidden = true;
    announce("The session is over.");
  };
  const kinds = {
    hello: title,
    status: showStatus,
    curve: (m) => {
      curves.add(m);
      figure.curve(m);
    },
    end: showEnd,
    earlier: () => events.earlier(),
    event: (heard) => {
      const m = { ...heard, t_s: heard.about_s ?? heard.t_s };
      figure.event(m);
      if (events.add(m, m.tone || "neutral")) curves.moment(m, m.tone || "neutral");
    },
    near: (m) => {
      curves.moment(m, "near");
      events.add(m, "near");
    },
  };
  put(state, badge("work", lostSince() ? "Waiting for the console" : "The station is starting…"));
  followSession(life, id, (m) => {
    time.hear(m.kind === "curve" ? m.t_s?.at(-1) : m.t_s);
    if (Object.hasOwn(kinds, m.kind)) kinds[m.kind](m);
  });
}
