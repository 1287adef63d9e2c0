// What a rater marks while somebody is examined, on a tablet beside the trainee: the items of the
// checklist that only a person can see, and a grade for each aspect. Kept as it is marked.
import { get, post, url } from "./api.js";
import { announce, h, put } from "./dom.js";
import { plural } from "./format.js";
import { badge, button, field, newId, notice, progress } from "./parts.js";
import { reportFrame } from "./report_frame.js";

/** Who rated last on this tablet; a browser that keeps nothing asks again. */
const kRater = "palpa-rater";
const lastRater = () => {
  try {
    return localStorage.getItem(kRater) || "";
  } catch {
    return "";
  }
};
const keepRater = (name) => {
  try {
    localStorage.setItem(kRater, name);
  } catch {
    /* asked again next time */
  }
};

/** Whether a person has something to mark: the forms are of subclavian access. */
export const isRated = (session) =>
  Boolean(session.assessed) && /^paracentesis/.test(session.task || "");

const kGrades = [1, 2, 3, 4, 5];

/** Buttons of which one is pressed; `chosen` hears each choice. */
function oneOf(legend, options, value, chosen) {
  const name = newId("mark");
  return h(
    "fieldset",
    { class: "marks" },
    h("legend", {}, legend),
    h(
      "div",
      { class: "mark-row" },
      options.map(([given, word]) => {
        const id = newId("mark-choice");
        return h(
          "span",
          { class: "mark-choice" },
          h("input", {
            type: "radio",
            id,
            name,
            value: String(given),
            checked: given === value,
            onchange: () => chosen(given),
          }),
          h("label", { for: id }, word),
        );
      }),
    ),
  );
}

const anchors = (item) => `1: ${item[1]}. 3: ${item[3]}. 5: ${item[5]}.`;

/** The verdict or the certificate of a trial: made by the station, then shown. */
async function shown(life, path, place, show) {
  put(place, progress("It is being made"));
  await life.every(700, async () => {
    const now = await get(path).catch((error) => {
      if (error.offline) throw error;
      return { state: "failed", message: error.message };
    });
    if (now.state === "done") show(now.page);
    else if (now.state === "failed") put(place, notice("note", now.message));
    return now.state !== "done" && now.state !== "failed";
  });
}

/** A card for one trial: marks, then the verdict that simulator and rater come to. */
export async function ratingForm(life, session, number, over) {
  const path = url("/api/sessions", session, "ratings", String(number));
  const [forms, kept] = await Promise.all([get("/api/forms"), get(path)]);
  const values = { ...kept.values },
    all = forms.checklist.items.length + forms.global.items.length;
  const rater = h("input", {
    type: "text",
    value: kept.rater || lastRater(),
    autocomplete: "off",
    spellcheck: false,
  });
  const said = h("p", { class: "hint", role: "status" }),
    made = h("div", {}),
    trouble = h("div", {});
  const count = () => put(said, `${Object.keys(values).length} of ${plural(all, "mark")}`);
  let saving = Promise.resolve();
  const save = () => {
    if (!rater.value.trim()) {
      put(trouble, notice("note", "Say who rates: a pseudonym, such as R1."));
      return saving;
    }
    keepRater(rater.value.trim());
    saving = saving.then(() =>
      post(path, { rater: rater.value.trim(), values })
        .then(() => put(trouble))
        .catch((error) => put(trouble, notice("bad", error.message))),
    );
    return saving;
  };
  const mark = (id) => (value) => {
    values[id] = value;
    count();
    save();
  };
  rater.addEventListener("change", save);
  count();
  const judged = over
    ? h(
        "div",
        { class: "row no-print" },
        button("Verdict", async () => {
          await save();
          await shown(life, `${path}/verdict`, made, (page) => {
            put(made, reportFrame(page, `Verdict on trial ${number}`));
            announce("The verdict is there.");
          });
        }),
        button("Certificate", async () => {
          await save();
          await shown(life, `${path}/certificate`, made, (page) =>
            put(
              made,
              notice(
                "good",
                "The certificate is made.",
                h(
                  "p",
                  {},
                  h("a", { href: page, target: "_blank", rel: "noopener" }, "Open it (PDF)"),
                ),
              ),
            ),
          );
        }),
      )
    : null;
  return h(
    "section",
    { class: "card rating" },
    h("h2", {}, `Rate trial ${number}`, " ", badge("none", "yours alone")),
    field("Rater", rater, "Your pseudonym: it stands on the verdict."),
    h("h3", {}, "Checklist"),
    forms.checklist.items.map((item) =>
      oneOf(
        item.text,
        [
          ["done", "done"],
          ["not done", "not done"],
        ],
        values[item.id],
        mark(item.id),
      ),
    ),
    h("h3", {}, "Global rating"),
    forms.global.items.map((item) => [
      oneOf(
        item.text,
        kGrades.map((grade) => [grade, String(grade)]),
        values[item.id],
        mark(item.id),
      ),
      h("p", { class: "hint" }, anchors(item)),
    ]),
    said,
    trouble,
    judged,
    made,
  );
}
