// All sessions, newest first; the ways to trainees' reports and the cohort.
import { list } from "./api.js";
import { h, put } from "./dom.js";
import { isOn, moment, sessionState, taskName, who } from "./format.js";
import { badge, choice, field, simulatedBadge, table } from "./parts.js";

function row(s) {
  const path = `#/${isOn(s) ? "session" : "results"}/${encodeURIComponent(s.id)}`;
  return [
    h("a", { href: path }, moment(s.started_utc)),
    taskName(s.task),
    s.trainee
      ? h("a", { href: `#/trainees/${encodeURIComponent(s.trainee)}` }, s.trainee)
      : "nobody",
    s.assessed ? "assessed" : "practice",
    String(Number(s.trials) || 0),
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

export async function show({ root, life, open }) {
  open("Results", h("a", { class: "button", href: "#/cohort" }, "Report on the cohort"));
  const place = h("div", {}),
    filter = h("div", {});
  root.append(filter, place);
  let shown = "",
    chosen = "";
  const draw = async () => {
    const sessions = await list("/api/sessions");
    const key = JSON.stringify([sessions, chosen]);
    if (key === shown) return;
    shown = key;
    const people = [...new Set(sessions.map((s) => s.trainee).filter(Boolean))].sort();
    if (!filter.firstChild && people.length > 1) {
      const select = choice([["", "everyone"], ...people.map((p) => [p, p])], chosen);
      select.addEventListener("change", () => {
        chosen = select.value;
        draw();
      });
      put(filter, h("div", { class: "row filter" }, field("Sessions of", select)));
    }
    const some = sessions.filter((s) => !chosen || s.trainee === chosen);
    put(
      place,
      some.length
        ? h(
            "div",
            { class: "card flush" },
            table(
              `Sessions, newest first${chosen ? `, of ${who(chosen)}` : ""}`,
              ["When", "Task", "Trainee", "Kind", "Trials", "State"],
              some.map(row),
              true,
            ),
          )
        : h(
            "p",
            { class: "lead" },
            "No session has been started from this console yet. ",
            h("a", { href: "#/session" }, "Start one."),
          ),
    );
  };
  await draw();
  life.every(4000, draw);
}
