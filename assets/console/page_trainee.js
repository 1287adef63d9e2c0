// One trainee: agreements, sessions, report.
import { list, url } from "./api.js";
import { h } from "./dom.js";
import { day, isOn, moment, sessionState, taskName } from "./format.js";
import { badge, facts, notice, table } from "./parts.js";
import { awaitReport } from "./report_frame.js";

export async function show({ root, life, params: [id], open }) {
  open(
    `Trainee ${id}`,
    h(
      "a",
      { class: "button primary no-print", href: `#/session?trainee=${encodeURIComponent(id)}` },
      `Start a session with ${id}`,
    ),
  );
  const [trainees, sessions] = await Promise.all([list("/api/trainees"), list("/api/sessions")]);
  const trainee = trainees.find((t) => t.id === id);
  if (!trainee) {
    root.append(
      notice("bad", `There is no trainee ${id} on this station. Choose one on the page Trainees.`),
    );
    return;
  }
  root.append(
    h(
      "div",
      { class: "card" },
      facts([
        ["Group", trainee.group || "–"],
        ["Experience", trainee.experience || "–"],
        ["Writes with the", `${trainee.handedness || "?"} hand`],
        ["Added", day(trainee.added_utc)],
        ["Agreed to records", trainee.consent_utc ? day(trainee.consent_utc) : "no"],
        ["Agreed to research", trainee.research_utc ? day(trainee.research_utc) : "no"],
        ["Keep until", trainee.retain_until ? day(trainee.retain_until) : "no date set"],
      ]),
    ),
  );
  const own = sessions.filter((s) => s.trainee === id);
  root.append(
    h("h2", {}, "Sessions"),
    own.length
      ? h(
          "div",
          { class: "card flush" },
          table(
            `Sessions of ${id}`,
            ["When", "Task", "Kind", "State"],
            own.map((s) => [
              h(
                "a",
                { href: `#/${isOn(s) ? "session" : "results"}/${encodeURIComponent(s.id)}` },
                moment(s.started_utc),
              ),
              taskName(s),
              s.assessed ? "assessed" : "practice",
              badge(...sessionState(s.state)),
            ]),
            true,
          ),
        )
      : h(
          "p",
          { class: "muted" },
          Number(trainee.sessions) > 0
            ? "None was started from this console; the report below counts all sessions."
            : "No session yet.",
        ),
  );
  const report = h("div", {});
  root.append(h("h2", {}, "Report"), report);
  awaitReport(life, url("/api/trainees", id, "report"), report, `Report on trainee ${id}`);
}
