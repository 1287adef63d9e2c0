// All sessions: what came of each, by trainee, task and outcome, in any order; the ways to reports.
import { list } from "./api.js";
import { h, put } from "./dom.js";
import { figure, isOn, moment, plural, sessionOutcome, sessionState, taskName } from "./format.js";
import { badge, choice, field, simulatedBadge, table } from "./parts.js";

const share = (s) =>
  s.outcome && s.outcome.counting > 0
    ? (s.outcome.succeeded + s.outcome.done) / s.outcome.counting
    : -1;
const penalty = (s) => (Number.isFinite(s.outcome?.total) ? s.outcome.total : Infinity);
const byText = (of) => (a, b) => of(a).localeCompare(of(b));

const kOrders = {
  when: ["newest first", (a, b) => (a.started_utc < b.started_utc ? 1 : -1)],
  trainee: ["by trainee", byText((s) => s.trainee || "~")],
  task: ["by task", byText((s) => taskName(s))],
  best: ["best outcome first", (a, b) => share(b) - share(a) || penalty(a) - penalty(b)],
  worst: ["worst outcome first", (a, b) => share(a) - share(b) || penalty(b) - penalty(a)],
};

const kOutcomes = {
  "": ["any", () => true],
  all: ["every trial succeeded", (s) => share(s) === 1],
  some: ["not every trial succeeded", (s) => share(s) >= 0 && share(s) < 1],
  open: ["still on, or without a result", (s) => share(s) < 0],
};

function row(s) {
  const path = `#/${isOn(s) ? "session" : "results"}/${encodeURIComponent(s.id)}`;
  return [
    h("a", { href: path }, moment(s.started_utc)),
    taskName(s),
    s.trainee
      ? h("a", { href: `#/trainees/${encodeURIComponent(s.trainee)}` }, s.trainee)
      : "nobody",
    s.assessed ? "assessed" : "practice",
    badge(...sessionOutcome(s)),
    Number.isFinite(s.outcome?.total) ? figure(s.outcome.total) : "–",
    [
      h(
        "span",
        { class: "row tight" },
        badge(...sessionState(s.state)),
        s.simulated ? simulatedBadge() : null,
      ),
      s.message ? h("p", { class: "hint" }, s.message) : null,
    ],
  ];
}

const namesOf = (map) => Object.entries(map).map(([key, [word]]) => [key, word]);
const kinds = (sessions, of) =>
  [...new Set(sessions.map(of).filter(Boolean))].sort().map((x) => [x, x]);

export async function show({ root, life, open }) {
  open("Results", h("a", { class: "button", href: "#/cohort" }, "Report on the cohort"));
  const place = h("div", {}),
    filter = h("div", { class: "row filter" });
  root.append(filter, place);
  const wish = { trainee: "", task: "", outcome: "", order: "when" };
  let shown = "",
    offered = "";
  const choose = (label, key, options) => {
    const select = choice(options, wish[key]);
    select.addEventListener("change", () => {
      wish[key] = select.value;
      draw();
    });
    return field(label, select);
  };
  const offer = (sessions) => {
    const people = kinds(sessions, (s) => s.trainee),
      tasks = kinds(sessions, taskName);
    const now = JSON.stringify([people, tasks]);
    if (now === offered || sessions.length < 2) return;
    offered = now;
    put(
      filter,
      people.length > 1 ? choose("Sessions of", "trainee", [["", "everyone"], ...people]) : null,
      tasks.length > 1 ? choose("Task", "task", [["", "every task"], ...tasks]) : null,
      choose("Outcome", "outcome", namesOf(kOutcomes)),
      choose("Order", "order", namesOf(kOrders)),
    );
  };
  const draw = async () => {
    const sessions = await list("/api/sessions");
    const key = JSON.stringify([sessions, wish]);
    if (key === shown) return;
    shown = key;
    offer(sessions);
    const some = sessions
      .filter((s) => !wish.trainee || s.trainee === wish.trainee)
      .filter((s) => !wish.task || taskName(s) === wish.task)
      .filter(kOutcomes[wish.outcome][1])
      .sort(kOrders[wish.order][1]);
    if (sessions.length === 0)
      return void put(
        place,
        h(
          "p",
          { class: "lead" },
          "No session has been started from this console yet. ",
          h("a", { href: "#/session" }, "Start one."),
        ),
      );
    put(
      place,
      h("p", { class: "muted", role: "status" }, plural(some.length, "session")),
      h(
        "div",
        { class: "card flush" },
        table(
          `Sessions, ${kOrders[wish.order][0]}`,
          ["When", "Task", "Trainee", "Kind", "Outcome", "Mean penalty", "State"],
          some.map(row),
          true,
        ),
      ),
    );
  };
  await draw();
  life.every(4000, draw);
}
