// A new session: a few choices, all with a default. When one is on already, it is shown instead.
import { list, me as whoAmI, post } from "./api.js";
import { h, put } from "./dom.js";
import { isOn } from "./format.js";
import { choice, during, field, notice, offer, radios, tick } from "./parts.js";

const kMostTrials = 50; // as the server takes them

function whole(input, low, high, what) {
  const value = Number(input.value);
  if (!Number.isInteger(value) || value < low || value > high) {
    input.focus();
    throw new Error(`${what}: a whole number from ${low} to ${high}.`);
  }
  return value;
}
const number = (value, low, high) =>
  h("input", {
    type: "number",
    value: String(value),
    min: low,
    max: high,
    step: 1,
    inputmode: "numeric",
  });

/** Where the task is held, and whether what is done there is scored. */
function stationWords(place) {
  if (!place) return "";
  const calibrate = (words) =>
    h("a", { href: `#/calibrate?station=${encodeURIComponent(place.kind)}` }, words);
  return place.trouble
    ? [
        "Held at: ",
        place.title,
        ". Trials are not scored: ",
        place.trouble,
        ". ",
        calibrate("Calibrate it"),
      ]
    : [
        "Held at: ",
        place.title,
        ". ",
        calibrate(place.measured ? "Calibrated" : "Not measured yet"),
      ];
}

function form(tasks, trainees, me, chosenTrainee) {
  const first = tasks.find((t) => t.id === "paracentesis") || tasks[0];
  const task = radios(
    "Task",
    tasks.map((t) => [t.id, t.title, t.about || ""]),
    first?.id,
    () => follow(),
  );
  const trainee = choice(
    [
      ["", "nobody (T000)"],
      ...trainees.map((t) => [t.id, `${t.id}${t.group ? `, ${t.group}` : ""}`]),
    ],
    trainees.some((t) => t.id === chosenTrainee) ? chosenTrainee : "",
  );
  const side = radios(
    "Side of the patient",
    [
      ["right", "right"],
      ["left", "left"],
    ],
    "right",
  );
  const kind = radios(
    "Kind",
    [
      ["practice", "practice", "Aids as the task sets them."],
      ["assess", "assessed", "Every aid is off, as in an examination."],
    ],
    "practice",
  );
  const operator = radios(
    "Who performs",
    [
      [
        "person",
        "a person",
        " ", // its hint follows the task
      ],
      ["expert", "simulated expert", "Shows how it is done; marked as simulated."],
      ["novice", "simulated novice", "Makes the common errors; marked as simulated."],
    ],
    me.display ? "person" : "expert",
    () => follow(),
  );
  const force = tick("Force feedback", true, "Off: it is seen, not felt.");
  const order = tick("Put several in order", false, "Off: two surfaces are compared.");
  const fingers = tick("Two fingers", false, "On: side by side, each on a device of its own.");
  const film = tick(
    "Film the room, for the debrief",
    false,
    "Only if the trainee agrees, to this session: ask first. It stays on this computer, is in no " +
      "export, and is deleted with the trainee's records, or before.",
  );
  const surface = choice([["", "as the task has it"]], "");
  const surfaceField = field("What lies there", surface, "On the virtual bench: softer or firmer.");
  const trials = number(1, 1, kMostTrials),
    patient = number(0, 0, 1000000),
    seed = number(1, 0, 1000000);
  const patientField = field(
    "Patient",
    patient,
    "0 is the average patient; each other number is another patient, always the same one.",
  );
  let gaveWay = false; // the person, to a task whose tool no mouse can hold
  const heldAt = h("p", { class: "muted", id: "held-at" });
  const follow = () => {
    const now = tasks.find((t) => t.id === task.value()),
      options = now?.options || [];
    force.node.hidden = !options.includes("force_feedback");
    side.node.hidden = !options.includes("side");
    order.node.hidden = !options.includes("sort");
    patientField.hidden = !options.includes("patient_seed");
    const place = (me.stations ?? []).find((s) => s.kind === now?.station);
    put(heldAt, stationWords(place));
    // A mouse on the virtual bench holds some tools only; a device at a station holds its own.
    const person = operator.node.querySelector("input[value=person]"),
      held = me.display && (now?.by_mouse !== false || !place?.bench);
    person.disabled = !held;
    put(
      operator.node.querySelector(`#${person.id}-hint`),
      held
        ? "Holds the device, or the mouse on the virtual bench."
        : me.display
          ? "A mouse cannot hold this task's tool: it needs a station with a haptic device."
          : "This station has no display: a person cannot train here now.",
    );
    const expert = operator.node.querySelector("input[value=expert]");
    if (!held && person.checked) {
      expert.checked = gaveWay = true;
    } else if (held && gaveWay) {
      person.checked = expert.checked;
      gaveWay = false;
    }
    // Only the virtual bench has a second device, and can have another thing on it.
    fingers.node.hidden =
      !place?.simulated || !options.includes("fingers") || operator.value() === "person";
    const surfaces = place?.simulated ? (now?.surfaces ?? []) : [];
    surfaceField.hidden = surfaces.length === 0;
    offer(surface, [["", "as the task has it"], ...surfaces.map((s) => [s, s])]);
    // A film is somebody's: it goes with that person's records.
    film.node.hidden = !me.room_camera || (operator.value() === "person" && !trainee.value);
    const assess = kind.node.querySelector("input[value=assess]");
    assess.disabled = now?.assessable === false;
    if (assess.disabled && assess.checked)
      kind.node.querySelector("input[value=practice]").checked = true;
  };
  follow();
  trainee.addEventListener("change", follow);
  const said = h("div", { class: "said" }),
    go = h("button", { type: "submit", class: "primary big", id: "begin" }, "Begin the session");
  const begin = async () => {
    const begun = await post("/api/sessions", {
      task: task.value(),
      trainee: trainee.value,
      assess: kind.value() === "assess",
      force_feedback: force.box.checked,
      sort: order.box.checked,
      film: film.box.checked && !film.node.hidden,
      fingers: fingers.box.checked && !fingers.node.hidden ? 2 : 1,
      surface: surface.value,
      operator: operator.value(),
      trials: whole(trials, 1, kMostTrials, "Trials"),
      seed: whole(seed, 0, 1000000, "Seed"),
      side: side.value(),
      patient_seed: whole(patient, 0, 1000000, "Patient"),
    });
    location.hash = `#/session/${encodeURIComponent(begun.id)}`;
  };
  return h(
    "form",
    {
      class: "card form session-form",
      novalidate: true,
      onsubmit: (e) => {
        e.preventDefault();
        during(go, said, begin);
      },
    },
    h(
      "div",
      { class: "grid two" },
      h("div", {}, task.node),
      h(
        "div",
        { class: "beside" },
        field("Trainee", trainee, "Without a trainee nothing is added to anybody's record."),
        operator.node,
        kind.node,
        side.node,
        force.node,
        order.node,
        fingers.node,
        surfaceField,
        film.node,
        h(
          "details",
          {},
          h("summary", {}, "More: number of trials, another patient"),
          h(
            "div",
            { class: "grid three" },
            field("Trials", trials, "A person has one try first, which is not scored."),
            patientField,
            field("Seed", seed, "The same number gives the same simulated hand again."),
          ),
        ),
        heldAt,
      ),
    ),
    said,
    h(
      "div",
      { class: "row go" },
      go,
      h(
        "span",
        { class: "muted" },
        "A window opens at the station for the person who trains; " +
          "you watch and control the session on the next page.",
      ),
    ),
  );
}

export async function show({ root, open, query }) {
  open("Start a session");
  const [tasks, trainees, sessions, me] = await Promise.all([
    list("/api/tasks"),
    list("/api/trainees"),
    list("/api/sessions"),
    whoAmI(true), // a station may have been calibrated since
  ]);
  const on = sessions.find(isOn);
  if (on) {
    location.replace(`#/session/${encodeURIComponent(on.id)}`);
    return;
  }
  root.append(
    tasks.length
      ? form(tasks, trainees, me, query.get("trainee") || "")
      : notice("bad", "The station has no task. Look at the Station page."),
  );
}
