// One session that is over: verdict, trials, pictures, report; ways to replay and print.
import { get, post, url } from "./api.js";
import { h, put } from "./dom.js";
import {
  capital,
  clock,
  figure,
  hasReached,
  isOn,
  moment,
  performer,
  pictureName,
  plural,
  sessionState,
  taskName,
  trialOutcome,
  who,
} from "./format.js";
import { badge, button, facts, notice, progress, simulatedBadge, table } from "./parts.js";
import { isRated, ratingForm } from "./rating_form.js";
import { reportFrame } from "./report_frame.js";
import { filmDeletion } from "./room_film.js";

/** The one sentence that comes first. */
function verdict(session) {
  const results = session.results || [];
  if (session.state === "failed") return ["bad", session.message || "The session failed."];
  if (session.state === "interrupted")
    return ["note", `The session ended without a report. ${session.message || ""}`];
  if (session.blind)
    return ["none", `${plural(results.length, "trial")} recorded; the study is blind.`];
  const counting = results.filter(
      (r) => !["void", "interrupted"].includes(r.outcome) && r.counts !== false,
    ),
    good = counting.filter(hasReached);
  if (counting.length === 0)
    return [
      "none",
      results.length ? "No trial counts: all are void or not scored." : "No trial was held.",
    ];
  if (counting.length === 1)
    return [
      trialOutcome(counting[0])[0],
      counting[0].summary || capital(trialOutcome(counting[0])[1]),
    ];
  return [
    good.length === counting.length ? "good" : "note",
    `Of ${counting.length} trials that count, ${good.length} ` +
      `${counting.find((r) => r.goal)?.goal.called || "succeeded"}.`,
  ];
}

function trialRow(session, r) {
  const [tone, word] = trialOutcome(r);
  return [
    `Trial ${r.number}`,
    r.role || "–",
    [
      h(
        "span",
        { class: "row tight" },
        badge(tone, word),
        r.reason ? h("span", { class: "muted" }, r.reason) : null,
      ),
      r.summary && r.summary !== r.reason ? h("p", { class: "hint" }, r.summary) : null,
    ],
    r.outcome === "void" ? "–" : figure(r.total),
    Number.isFinite(r.length_s) ? clock(r.length_s) : "–",
    session.blind
      ? "–"
      : h(
          "a",
          {
            class: "no-print",
            href: `#/replay/${encodeURIComponent(session.id)}/${r.number}`,
            "aria-label": `Replay of trial ${r.number}`,
          },
          "Replay",
        ),
  ];
}

function pictures(session, files) {
  const shown = files.filter((f) => /^view-[\w-]+\.png$/.test(f)).sort();
  if (shown.length === 0) return null;
  return [
    h("h2", {}, "Moments"),
    h(
      "ul",
      { class: "gallery" },
      shown.map((f) =>
        h(
          "li",
          {},
          h(
            "figure",
            {},
            h("img", {
              src: url("/api/sessions", session.id, "file", f),
              alt: "",
              loading: "lazy",
              width: 1280,
              height: 720,
            }),
            h("figcaption", {}, pictureName(f)),
          ),
        ),
      ),
    ),
  ];
}

/** What a rater marks of each trial that counts, and the verdict; filled in when it is there. */
function examined(life, id, results) {
  const counting = results.filter((r) => r.outcome !== "void");
  const formInto = (place, number) =>
    ratingForm(life, id, number, true)
      .then((form) => put(place, form))
      .catch((error) => put(place, notice("bad", error.message)));
  const cards = counting.map((r) => {
    const place = h("div", {});
    if (counting.length === 1) {
      formInto(place, r.number);
      return place;
    }
    const ontoggle = (e) => {
      if (e.target.open && !place.firstChild) formInto(place, r.number);
    };
    return h("details", { ontoggle }, h("summary", {}, `Trial ${r.number}`), place);
  });
  return cards.length ? [h("h2", {}, "Examination"), ...cards] : [];
}

/** Makes the report of a session whose program died, and shows the page anew when it is there. */
function finish(life, id) {
  const place = h("div", { class: "row no-print" });
  const make = button("Make the report", async () => {
    const { job } = await post(url("/api/sessions", id, "finish"), {});
    put(place, progress("The report is being made"));
    await life.every(700, async () => {
      const now = await get(url("/api/jobs", job));
      if (now.state === "working") return true;
      if (now.state === "done") location.reload();
      else put(place, notice("bad", now.message || "The report could not be made."), make);
      return false;
    });
  });
  put(place, make);
  return place;
}

export async function show({ root, life, params: [id], open }) {
  const session = await get(url("/api/sessions", id));
  if (isOn(session)) {
    location.replace(`#/session/${encodeURIComponent(id)}`);
    return;
  }
  open(
    `${taskName(session)}, ${moment(session.started_utc)}`,
    h(
      "button",
      { type: "button", class: "no-print", id: "print-page", onclick: () => window.print() },
      "Print this page",
    ),
  );
  const [tone, text] = verdict(session),
    files = Array.isArray(session.files) ? session.files : [],
    results = Array.isArray(session.results) ? session.results : [];
  root.append(h("div", { class: "verdict" }, notice(tone === "bad" ? "bad" : tone, text)));
  if (session.state === "interrupted") root.append(finish(life, id));
  root.append(
    h(
      "div",
      { class: "card" },
      facts([
        [
          "Trainee",
          session.trainee
            ? h("a", { href: `#/trainees/${encodeURIComponent(session.trainee)}` }, session.trainee)
            : who(""),
        ],
        ["Performed by", performer(session)],
        ["Kind", session.assessed ? "assessed" : "practice"],
        ["State", badge(...sessionState(session.state))],
        ["Data", session.simulated ? simulatedBadge() : "of a person"],
      ]),
    ),
  );
  root.append(
    h("h2", {}, "Trials"),
    results.length
      ? h(
          "div",
          { class: "card flush" },
          table(
            "Trials of this session",
            [
              "Trial",
              "Kind",
              "Outcome",
              session.task === "paracentesis" ? "Penalty (lower is better)" : "Total",
              "Length",
              h("span", { class: "no-print" }, "Look"),
            ],
            results.map((r) => trialRow(session, r)),
            true,
          ),
        )
      : h("p", { class: "muted" }, "None."),
  );
  if (session.blind) {
    root.append(
      notice(
        "note",
        "This session belongs to a study whose educators are blinded: " +
          "report, figures and replay are not shown here. " +
          "They can be read with the study's results when it is over.",
      ),
    );
    return;
  }
  if (session.film) {
    const film = h(
      "div",
      { class: "card no-print" },
      h("p", {}, "The room was filmed, with the trainee's agreement: it is seen in the replay."),
    );
    film.append(...filmDeletion(id, film));
    root.append(h("h2", {}, "Film of the room"), film);
  }
  if (isRated(session) && results.length) root.append(...examined(life, id, results));
  const more = pictures(session, files);
  if (more) root.append(...more);
  root.append(
    h("h2", {}, "Report"),
    files.includes("report.html")
      ? reportFrame(
          url("/api/sessions", id, "file", "report.html"),
          `Report on the session of ${moment(session.started_utc)}`,
        )
      : h("p", { class: "muted" }, "This session left no report."),
  );
  if (files.includes("trials.csv"))
    root.append(
      h(
        "p",
        { class: "no-print" },
        h(
          "a",
          { href: url("/api/sessions", id, "file", "trials.csv"), download: `${id}-trials.csv` },
          "Figures of all trials as a table (CSV)",
        ),
      ),
    );
}
