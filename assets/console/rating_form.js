// What a rater marks while somebody is examined, on a tablet beside the trainee: the items of the
// checklist that only a person can see, and a grade for each aspect. Kept at every mark, one sheet
// for each rater.
import { get, post, url } from "./api.js";
import { announce, h, put } from "./dom.js";
import { plural } from "./format.js";
import { button, field, newId, notice, progress } from "./parts.js";
import { reportFrame } from "./report_frame.js";

const kGrades = [1, 2, 3, 4, 5];
const kMarks = ["done", "not done", "did not arise"];
const kOpen = ""; // not judged
const kPseudonym = /^[A-Za-z0-9_-]{1,64}$/;

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

let asked; // the forms, the same for all trials
const forms = () => {
  asked ||= get("/api/forms").catch((error) => {
    asked = undefined;
    throw error;
  });
  return asked;
};

/** Large buttons of which one is pressed; `chosen` hears each choice. */
function oneOf(legend, options, value, chosen) {
  const name = newId("mark");
  return h(
    "fieldset",
    { class: "marks" },
    h("legend", {}, legend),
    h(
      "div",
      { class: "mark-row" },
      options.map((given) => {
        const id = newId("mark-choice");
        return h(
          "span",
          { class: given === kOpen ? "mark-choice open" : "mark-choice" },
          h("input", {
            type: "radio",
            id,
            name,
            value: String(given),
            checked: given === (value ?? kOpen),
            onchange: () => chosen(given),
          }),
          h("label", { for: id }, given === kOpen ? "not judged" : String(given)),
        );
      }),
    ),
  );
}

const anchors = (item) => `1: ${item[1]}. 3: ${item[3]}. 5: ${item[5]}.`;

/** The marks of one rater on one trial. */
class Sheet {
  constructor(session, number) {
    this.base = url("/api/sessions", session, "ratings", String(number));
    this.values = {};
    this.rater = "";
    this.saving = Promise.resolve();
  }
  get path() {
    return `${this.base}/${encodeURIComponent(this.rater)}`;
  }
  async open(rater) {
    this.rater = rater;
    this.values = (await get(this.path)).values || {};
  }
  /** Resolves when it is kept; one write after the other. */
  mark(id, value) {
    if (value === kOpen) delete this.values[id];
    else this.values[id] = value;
    const values = { ...this.values };
    this.saving = this.saving.catch(() => {}).then(() => post(this.path, { values }));
    return this.saving;
  }
}

function questions({ checklist, global }, sheet, marked) {
  return [
    h("h3", {}, "Checklist"),
    checklist.items.map((item) =>
      oneOf(item.text, [...kMarks, kOpen], sheet.values[item.id], marked(item.id)),
    ),
    h("h3", {}, "Global rating"),
    global.items.map((item) => [
      oneOf(item.text, [...kGrades, kOpen], sheet.values[item.id], marked(item.id)),
      h("p", { class: "hint" }, anchors(item)),
    ]),
  ];
}

/** What the station makes of the marks, once all of them are kept. */
async function made(life, sheet, what, place, show) {
  await sheet.saving;
  put(place, progress("It is being made"));
  await life.every(700, async () => {
    const now = await get(`${sheet.path}/${what}`).catch((error) => {
      if (error.offline) throw error;
      return { state: "failed", message: error.message };
    });
    if (now.state === "done") put(place, show(now.page));
    else if (now.state === "failed") put(place, notice("note", now.message));
    return now.state !== "done" && now.state !== "failed";
  });
}

function judgements(life, sheet, number) {
  const place = h("div", {});
  const verdict = button("Verdict", () =>
    made(life, sheet, "trial", place, (page) => {
      announce("The verdict is ready.");
      return reportFrame(page, `Verdict on trial ${number}`);
    }),
  );
  const certificate = button("Certificate", () =>
    made(life, sheet, "certificate", place, (page) =>
      notice(
        "good",
        "The certificate is made.",
        h("p", {}, h("a", { href: page, target: "_blank", rel: "noopener" }, "Open it (PDF)")),
      ),
    ),
  );
  return [h("div", { class: "row no-print" }, verdict, certificate), place];
}

/** A card for one trial; `over`: the verdict may be asked for. */
export async function ratingForm(life, session, number, over) {
  const asks = await forms(),
    all = asks.checklist.items.length + asks.global.items.length;
  const sheet = new Sheet(session, number);
  const rater = h("input", { type: "text", autocomplete: "off", spellcheck: false }),
    said = h("p", { class: "hint", role: "status" }),
    trouble = h("div", {}),
    below = h("div", {});
  const count = () =>
    put(said, `${Object.keys(sheet.values).length} of ${plural(all, "mark")}, kept`);
  const marked = (id) => (value) => {
    put(said, "Keeping…");
    sheet.mark(id, value).then(
      () => {
        put(trouble);
        count();
      },
      (error) => {
        put(said);
        put(trouble, notice("bad", `This mark is not kept: ${error.message}`));
      },
    );
  };
  const open = async () => {
    const name = rater.value.trim();
    put(below);
    put(said);
    if (!name) return;
    if (!kPseudonym.test(name))
      return void put(trouble, notice("note", "Use letters, digits, - and _, such as R1."));
    await sheet.open(name);
    keepRater(name);
    put(trouble);
    put(below, questions(asks, sheet, marked), over ? judgements(life, sheet, number) : null);
    count();
  };
  rater.addEventListener("change", () =>
    open().catch((error) => put(trouble, notice("bad", error.message))),
  );
  rater.value = lastRater();
  await open();
  return h(
    "section",
    { class: "card rating" },
    h("h2", {}, `Rate trial ${number}`),
    field(
      "Rater",
      rater,
      "Your pseudonym: it stands on the verdict. Each rater has a sheet of their own.",
    ),
    below,
    said,
    trouble,
  );
}
