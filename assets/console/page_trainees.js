// Who trains here, under pseudonyms; and how somebody new is added.
import { list, post, url } from "./api.js";
import { announce, h, put } from "./dom.js";
import { day } from "./format.js";
import { badge, button, choice, during, field, radios, table, tick } from "./parts.js";

/** The next free T-number, so that nothing need be invented. */
function freePseudonym(trainees) {
  const taken = trainees
    .map((t) => /^T(\d+)$/.exec(t.id))
    .filter(Boolean)
    .map((m) => Number(m[1]));
  return `T${String(Math.max(0, ...taken) + 1).padStart(3, "0")}`;
}

/** Whether somebody agrees to use in research: given and withdrawn here, at any time. */
function research(trainee, done) {
  const agrees = Boolean(trainee.research_utc);
  const change = async () => {
    await post(url("/api/trainees", trainee.id, "research"), { agrees: !agrees });
    await done(
      trainee.id,
      agrees
        ? `${trainee.id} takes part in no study from now on.`
        : `${trainee.id} agrees to the use of the records in research: noted.`,
    );
  };
  return h(
    "span",
    { class: "row tight" },
    agrees ? badge("good", `agreed ${day(trainee.research_utc)}`) : badge("none", "not agreed"),
    button(
      [agrees ? "Withdraw" : "Agrees now", h("span", { class: "unseen" }, `: ${trainee.id}`)],
      change,
      { class: "quiet" },
    ),
  );
}

function rows(trainees, done) {
  return trainees.map((t) => [
    h("a", { href: `#/trainees/${encodeURIComponent(t.id)}` }, t.id),
    t.group || "–",
    t.experience || "–",
    String(Number(t.sessions) || 0),
    String(Number(t.trials) || 0),
    t.consent_utc ? badge("good", "noted") : badge("note", "missing"),
    research(t, done),
    t.retain_until ? day(t.retain_until) : "–",
  ]);
}

function form(trainees, groups, done) {
  const id = h("input", {
    type: "text",
    value: freePseudonym(trainees),
    pattern: "[A-Za-z0-9_-]{1,64}",
    maxlength: "64",
    autocomplete: "off",
    spellcheck: "false",
    required: true,
  });
  const group = choice(groups.map((g) => [g, g])),
    experience = h("input", { type: "text", maxlength: "200", autocomplete: "off" });
  const hand = radios(
    "Writes with the",
    [
      ["right", "right hand"],
      ["left", "left hand"],
    ],
    "right",
  );
  const consent = tick(
    "The trainee agrees that training records are kept here",
    false,
    "Ask first. Without this nothing can be kept.",
    { required: true },
  );
  const research = tick(
    "The trainee also agrees that they are used in research",
    false,
    "Separate and voluntary: training does not depend on it.",
  );
  const said = h("div", { class: "said" }),
    go = h("button", { type: "submit", class: "primary" }, "Add the trainee");
  const add = async () => {
    const pseudonym = id.value.trim();
    if (!/^[A-Za-z0-9_-]{1,64}$/.test(pseudonym)) {
      id.focus();
      throw new Error("A pseudonym has at most 64 letters, digits, - and _.");
    }
    if (!consent.box.checked) {
      consent.box.focus();
      throw new Error(
        "Tick the agreement to keeping records; without it the trainee cannot be added. " +
          "A session without a trainee is still possible.",
      );
    }
    await post("/api/trainees", {
      id: pseudonym,
      group: group.value,
      experience: experience.value.trim(),
      handedness: hand.value(),
      consent: true,
      research: research.box.checked,
    });
    await done(pseudonym);
  };
  return h(
    "form",
    {
      class: "card form",
      novalidate: true,
      "aria-labelledby": "add-heading",
      onsubmit: (e) => {
        e.preventDefault();
        during(go, said, add);
      },
    },
    h("h2", { id: "add-heading" }, "Add a trainee"),
    h(
      "div",
      { class: "grid two" },
      field(
        "Pseudonym",
        id,
        "Never a name, initials or a student number. " +
          "Keep the list of who is who on paper, elsewhere.",
      ),
      field("Group", group, "Groups are compared with each other in the cohort report."),
      field(
        "Experience",
        experience,
        'In a few words, such as "two simple injections". Nothing that shows who it is.',
      ),
      hand.node,
    ),
    consent.node,
    research.node,
    said,
    h("div", { class: "row" }, go),
  );
}

export async function show({ root, open }) {
  open("Trainees");
  const place = h("div", {}),
    adding = h("div", {});
  root.append(place, adding);
  const studies = await list("/api/studies").catch(() => []);
  const groups = [...new Set(["novice", "experienced", ...studies.flatMap((s) => s.groups || [])])];
  const draw = async () => {
    const trainees = await list("/api/trainees");
    put(
      place,
      trainees.length
        ? h(
            "div",
            { class: "card flush" },
            table(
              "Trainees of this station",
              [
                "Pseudonym",
                "Group",
                "Experience",
                "Sessions",
                "Trials",
                "Records",
                "Research",
                "Keep until",
              ],
              rows(trainees, async (id, words) => {
                await draw();
                announce(words);
                place.querySelector(`a[href="#/trainees/${id}"]`)?.focus();
              }),
              true,
            ),
          )
        : h(
            "p",
            { class: "lead" },
            "Nobody has been added yet. " +
              "You can try the station without one: start a session without a trainee.",
          ),
    );
    put(
      adding,
      form(trainees, groups, async (id) => {
        await draw();
        announce(`${id} was added.`);
        place.querySelector(`a[href="#/trainees/${id}"]`)?.focus();
      }),
    );
  };
  await draw();
}
