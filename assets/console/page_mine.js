// One's own results, on a device of one's own: a PIN from the educator opens them.
import { get, post, url } from "./api.js";
import { h, put } from "./dom.js";
import { moment, sessionOutcome, taskName } from "./format.js";
import { badge, button, doorForm, notice, simulatedBadge, table } from "./parts.js";
import { reportFrame } from "./report_frame.js";

function door(draw) {
  const pin = h("input", {
    type: "text",
    inputmode: "numeric",
    autocomplete: "one-time-code",
    maxlength: "7", // with a space in the middle
    required: true,
  });
  const work = async () => {
    const given = pin.value.replace(/\s/g, "");
    if (!/^\d{6}$/.test(given)) {
      pin.focus();
      throw new Error("A PIN has six digits.");
    }
    await post("/api/mine/enter", { pin: given });
    await draw();
  };
  return doorForm({
    about: "Here you read your own results, and nobody else's.",
    label: "PIN",
    control: pin,
    hint: "Your educator shows it to you. It works once, within ten minutes.",
    go: "Show my results",
    work,
  });
}

function sessions(mine, read) {
  if (mine.sessions.length === 0)
    return notice("none", "There is no result of yours on this station yet.");
  return h(
    "div",
    { class: "card flush" },
    table(
      "Your sessions",
      ["When", "Task", "Kind", "Outcome", "Report"],
      mine.sessions.map((s) => [
        moment(s.started_utc),
        taskName(s),
        h(
          "span",
          { class: "row tight" },
          s.assessed ? "assessed" : "practice",
          s.simulated ? simulatedBadge() : null,
        ),
        badge(...sessionOutcome(s)),
        h(
          "button",
          { type: "button", class: "quiet", onclick: () => read(s) },
          "Read",
          h("span", { class: "unseen" }, ` the report of ${moment(s.started_utc)}`),
        ),
      ]),
      true,
    ),
  );
}

export async function show({ root, life, open }) {
  open("My results");
  const place = h("div", {}),
    report = h("div", {});
  let follows = false;
  root.append(place, report);
  const read = (s) => {
    put(
      report,
      h("h2", { tabindex: "-1" }, `${taskName(s)}, ${moment(s.started_utc)}`),
      reportFrame(url("/api/mine", s.id, "file", "report.html"), "Your report"),
    );
    report.querySelector("h2").focus();
    report.scrollIntoView();
  };
  const draw = async () => {
    const mine = await get("/api/mine");
    put(
      place,
      mine.trainee
        ? [
            h(
              "div",
              { class: "row between" },
              h("p", { class: "lead" }, `Results of ${mine.trainee}`),
              button("Leave", leave),
            ),
            sessions(mine, read),
          ]
        : door(draw),
    );
    if (!follows && mine.sessions.some((one) => !one.outcome)) follow();
  };
  const leave = async () => {
    await post("/api/mine/leave", {});
    put(report);
    await draw();
  };
  // What came of a session is read one after the other.
  const follow = () => {
    follows = true;
    let tries = 0;
    life.every(2000, async () => {
      if (report.firstChild || ++tries > 30) return false;
      const { sessions: own } = await get("/api/mine");
      if (own.some((one) => !one.outcome)) return true;
      await draw();
      return false;
    });
  };
  await draw();
}
