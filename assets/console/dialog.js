// Questions that stop the reader: a modal <dialog>, Escape cancels, the
// focus goes back where it was.
import { h, put } from "./dom.js";
import { newId, notice, radios } from "./parts.js";

const kReasons = [
  [
    "interrupted",
    "Interrupted",
    "Somebody came in, the telephone rang, the trainee was called away.",
  ],
  [
    "technical fault",
    "Technical fault",
    "The camera, the device or the program did not work as it should.",
  ],
  ["trainee stopped", "The trainee stopped", "The trainee did not want to continue."],
  ["other", "Something else", ""],
];

/**
 * Resolves to what `answer` gives (a string: it is wrong, and why, is { wrong }),
 * or null when cancelled.
 */
export function request({ title, about, body, yes, danger, answer }) {
  return new Promise((resolve) => {
    const id = newId("dialog"),
      said = h("div", {});
    let result = null;
    const go = (e) => {
      e.preventDefault();
      const given = answer();
      if (given && given.wrong) {
        put(said, notice("bad", given.wrong));
        return;
      }
      result = given;
      dialog.close();
    };
    const dialog = h(
      "dialog",
      { "aria-labelledby": id },
      h(
        "form",
        { onsubmit: go, novalidate: true },
        h("h2", { id }, title),
        h("p", {}, about),
        body,
        said,
        h(
          "div",
          { class: "row end" },
          h("button", { type: "button", onclick: () => dialog.close() }, "Go back"),
          h("button", { type: "submit", class: danger ? "danger" : "primary" }, yes),
        ),
      ),
    );
    dialog.addEventListener("close", () => {
      dialog.remove();
      resolve(result);
    });
    document.body.append(dialog);
    dialog.showModal();
  });
}

export const confirmed = (title, about, yes, danger = true) =>
  request({ title, about, body: null, yes, danger, answer: () => true });

/** Why a trial does not count: one of four reasons, the last in the educator's own words. */
export function askVoidReason(trial) {
  const words = h("input", {
    type: "text",
    maxlength: "200",
    id: newId("why"),
    autocomplete: "off",
  });
  const own = h(
    "div",
    { class: "field", hidden: true },
    h("label", { for: words.id }, "In your words (no names)"),
    words,
  );
  const why = radios("Reason", kReasons, "interrupted", (e) => {
    own.hidden = e.target.value !== "other";
    if (!own.hidden) words.focus();
  });
  return request({
    title: `Void trial ${trial}?`,
    about:
      "A void trial is kept with its reason but counts for nothing. " +
      "It cannot be made to count again.",
    body: [why.node, own],
    yes: "Void the trial",
    danger: true,
    answer: () => {
      if (why.value() !== "other") return why.value();
      const text = words.value.trim();
      return text ? `other: ${text}` : { wrong: "Say in a few words why." };
    },
  });
}
