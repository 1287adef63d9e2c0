// Studies: how far each one is, and the next block for a trainee. What a trainee was allocated is
// not known to these pages.
import { list, me as whoAmI, post, url } from "./api.js";
import { h } from "./dom.js";
import { plural } from "./format.js";
import { badge, choice, during, field, notice, simulatedBadge, table } from "./parts.js";

const kSimulated = "simulated"; // the experience of a simulated trainee, who need not be asked
const kOperators = [
  ["person", "the trainee (a person)"],
  ["expert", "simulated expert"],
  ["novice", "simulated novice"],
];

function enrolled(study) {
  const rows = (study.enrolled || []).map((e) => [
    e.trainee,
    e.group || "–",
    h("span", { class: "row tight" }, e.where || "–", e.simulated ? simulatedBadge() : null),
    e.next || (e.finished ? badge("good", "nothing more") : "nothing now"),
    (e.remarks || []).map((r) => h("div", {}, badge("note", String(r)))),
  ]);
  return rows.length
    ? table(
        `Trainees enrolled: ${study.title || study.id}`,
        ["Trainee", "Group", "Where", "Next", "Remarks"],
        rows,
        true,
      )
    : h("p", { class: "muted" }, "Nobody is enrolled yet.");
}

function nextBlock(study, trainees, me) {
  const agrees = (t) => t.research_utc || t.experience === kSimulated,
    may = new Set(trainees.filter(agrees).map((t) => t.id));
  const waiting = (study.enrolled || []).filter((e) => e.next && may.has(e.trainee)),
    known = new Set((study.enrolled || []).map((e) => e.trainee));
  const fits = trainees.filter((t) => !known.has(t.id) && (study.groups || []).includes(t.group)),
    fresh = fits.filter(agrees),
    silent = fits.filter((t) => !agrees(t)).map((t) => t.id);
  const asked = silent.length
    ? h(
        "p",
        { class: "hint" },
        `Not offered, since they have not agreed to research: ${silent.join(", ")}. `,
        h("a", { href: "#/trainees" }, "Note it on the page Trainees"),
        " once they do.",
      )
    : null;
  const options = [
    ...waiting.map((e) => [e.trainee, `${e.trainee}: ${e.next}`]),
    ...fresh.map((t) => [t.id, `${t.id}, ${t.group}: not enrolled yet, will be enrolled by this`]),
  ];
  if (options.length === 0)
    return [
      h(
        "p",
        { class: "muted" },
        "Nobody's next block is due. The first block enrols a new trainee: " +
          `add one to the group ${(study.groups || []).join(" or ")} on the page Trainees.`,
      ),
      asked,
    ];
  const trainee = choice(options),
    operator = choice(kOperators, me.display ? "person" : "expert");
  const said = h("div", { class: "said" }),
    go = h("button", { type: "submit", class: "primary" }, "Start the next block");
  const start = async () => {
    const begun = await post(url("/api/studies", study.id, "run"), {
      trainee: trainee.value,
      operator: operator.value,
    });
    location.hash = `#/session/${encodeURIComponent(begun.session)}`;
  };
  return h(
    "form",
    {
      class: "form",
      novalidate: true,
      onsubmit: (e) => {
        e.preventDefault();
        during(go, said, start);
      },
    },
    h("h3", {}, "Next block"),
    h(
      "div",
      { class: "grid two" },
      field("Trainee", trainee),
      field(
        "Who performs",
        operator,
        me.display ? null : "This station has no display: a person cannot train here now.",
      ),
    ),
    asked,
    said,
    h("div", { class: "row" }, go),
  );
}

export async function show({ root, open }) {
  open("Studies");
  const [studies, trainees, me] = await Promise.all([
    list("/api/studies"),
    list("/api/trainees"),
    whoAmI(),
  ]);
  root.append(
    h(
      "p",
      { class: "lead" },
      "The condition that a trainee drew is not shown here, so that nobody who teaches knows it.",
    ),
  );
  if (studies.length === 0)
    root.append(
      notice(
        "none",
        'There is no study on this station. A study is planned with the command "palpa study".',
      ),
    );
  for (const study of studies) {
    const places = (study.places || [])
      .map((p) => `${p.group}: ${plural(Number(p.given) || 0, "place")} assigned`)
      .join(" · ");
    root.append(
      h(
        "section",
        { class: "card", "aria-label": study.title || study.id },
        h("h2", {}, study.title || study.id),
        h("p", { class: "muted" }, places),
        enrolled(study),
        nextBlock(study, trainees, me),
      ),
    );
  }
}
