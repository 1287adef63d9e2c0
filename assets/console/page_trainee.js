// One trainee: agreements, sessions, report.
import { list, post, url } from "./api.js";
import { h, put } from "./dom.js";
import { day, isOn, moment, sessionState, taskName } from "./format.js";
import { badge, button, facts, notice, table } from "./parts.js";
import { awaitReport } from "./report_frame.js";

/** Where a device in the room opens it: at the station itself the page's address would mislead. */
const forOthers = () =>
  /^(127\.|localhost$|\[::1\]$)/.test(location.hostname)
    ? "the address by which tablets reach this console, with /#/mine at its end,"
    : `${location.origin}/#/mine`;

/** A PIN by which the trainee reads these results on a device of his or her own. */
function ownDevice(id) {
  const shown = h("div", { role: "status" });
  const show = async () => {
    const { pin, minutes } = await post(url("/api/trainees", id, "pin"), {});
    put(
      shown,
      h("p", { class: "pin" }, `${pin.slice(0, 3)} ${pin.slice(3)}`),
      h(
        "p",
        { class: "hint" },
        `On the trainee's own device, open ${forOthers()} and type this PIN. ` +
          `It works once, within ${minutes} minutes, and shows the results of ${id} only.`,
      ),
    );
  };
  return h(
    "div",
    { class: "card no-print" },
    h("div", { class: "row" }, button("Show a PIN for the trainee's own device", show)),
    shown,
  );
}

export async function show({ root, life, params: [id], open, me }) {
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
  if (me.open_to_others) root.append(ownDevice(id));
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
