// What happened, newest first, and the educator's own notes with the moment they are about.
import { post, url } from "./api.js";
import { announce, h, mark, put, say } from "./dom.js";
import { clock } from "./format.js";
import { joined, momentOf } from "./moments.js";
import { during, tick } from "./parts.js";

const kWords = { good: "good", bad: "error", near: "near miss", note: "note", neutral: "" };
let keyMarks = true;

/** By what it types; where that is no Latin letter, by where it lies. */
const isKey = (e, letter) =>
  e.key.toLowerCase() === letter ||
  (e.code === `Key${letter.toUpperCase()}` && !/^[a-z]$/i.test(e.key));

const typing = (target) =>
  target instanceof Element &&
  target.closest(
    "input:not([type=checkbox]):not([type=radio]), textarea, select, dialog, [contenteditable]",
  );

export class LiveEvents {
  /** now(): the session's second at this moment. */
  constructor(life, id, now) {
    this.path = url("/api/sessions", id, "command");
    this.now = now;
    this.notes = new Set();
    this.at_s = NaN;
    this.began = NaN; // the newest trial, in the session's time
    this.list = h(
      "ol",
      { class: "events" },
      h("li", { class: "muted none-yet" }, "Nothing has happened yet."),
    );
    this.mark = h(
      "button",
      {
        type: "button",
        class: "wide",
        id: "mark-moment",
        "aria-keyshortcuts": "M",
        onclick: () => this.#stamp(),
      },
      "Mark this moment",
      h("kbd", {}, "M"),
    );
    this.label = h("label", { for: "note-text" }, "Note");
    this.text = h("input", {
      type: "text",
      id: "note-text",
      maxlength: "300",
      autocomplete: "off",
      "aria-describedby": "note-hint",
    });
    this.save = h("button", { type: "submit", class: "primary" }, "Save the note");
    this.said = h("div", { class: "said" });
    this.form = h(
      "form",
      {
        class: "note-form",
        hidden: true,
        novalidate: true,
        onsubmit: (e) => {
          e.preventDefault();
          during(this.save, this.said, () => this.#keep());
        },
        onkeydown: (e) => {
          if (e.key === "Escape") this.#close();
        },
      },
      this.label,
      this.text,
      h("p", { class: "hint", id: "note-hint" }, "It will stand in the session's report."),
      this.said,
      h(
        "div",
        { class: "row" },
        this.save,
        h("button", { type: "button", onclick: () => this.#close() }, "Leave it"),
      ),
    );
    const key = tick("The key M marks", keyMarks);
    key.box.addEventListener("change", () => {
      keyMarks = key.box.checked;
    });
    this.writing = h(
      "section",
      { class: "card notes", "aria-label": "Notes" },
      this.mark,
      this.form,
      key.node,
    );
    this.node = h(
      "div",
      { class: "stack" },
      this.writing,
      h(
        "section",
        { class: "card events-card", "aria-label": "Events" },
        h("h2", {}, "Events"),
        h(
          "div",
          {
            class: "events-scroll",
            role: "log",
            "aria-label": "Events, newest first",
            tabindex: "0",
          },
          this.list,
        ),
      ),
    );
    life.listen(window, "keydown", (e) => {
      if (
        keyMarks &&
        !this.over &&
        isKey(e, "m") &&
        !e.ctrlKey &&
        !e.metaKey &&
        !e.altKey &&
        !e.repeat &&
        !typing(e.target)
      ) {
        e.preventDefault();
        this.#stamp();
      }
    });
  }

  #stamp() {
    this.at_s = this.now();
    this.form.hidden = false;
    const when = this.at_s >= this.began ? `at ${this.#time(this.at_s)}` : "before the first trial";
    say(this.label, `What was seen ${when} (no names)`);
    this.text.focus();
  }

  /** As the curves count: since the trial began; before the first one there is no time. */
  #time(t_s) {
    return t_s >= this.began ? clock(t_s - this.began) : "before";
  }

  #close() {
    this.form.hidden = true;
    this.text.value = "";
    put(this.said);
    this.mark.focus();
  }

  async #keep() {
    const text = this.text.value.trim(),
      at_s = Number(this.at_s.toFixed(2));
    if (!text) {
      this.text.focus();
      throw new Error("Write a word or two, or choose Leave it.");
    }
    await post(this.path, { command: "note", reason: text, at_s });
    announce("The note is saved.");
    this.add({ t_s: at_s, event: "note", text, tone: "note" }, "note");
    this.#close();
  }

  /** What happened before is not told any more: said once, below all that is. */
  earlier() {
    if (this.list.querySelector(".earlier")) return;
    this.list.querySelector(".none-yet")?.remove();
    this.list.append(
      h(
        "li",
        { class: "muted earlier" },
        "Earlier events are not shown here: they are in the session's recording and report.",
      ),
    );
  }

  /**
   * A note comes twice, from here and from the station: it is shown once. False: it belongs to what
   * stands there already.
   */
  add(message, tone) {
    if (message.event === "start") this.began = message.t_s;
    if (message.event === "note" || tone === "note") {
      const key = String(message.text || "").replace(/^note:\s*/i, "");
      if (this.notes.has(key)) {
        this.notes.delete(key);
        return false;
      }
      if (message.event === "note") this.notes.add(key);
    }
    this.list.querySelector(".none-yet")?.remove();
    // A note stands where it was heard of, in each browser elsewhere: it parts nothing.
    const note = message.event === "note" || tone === "note",
      more = note ? null : joined(this.last, message),
      moment = more || momentOf({ ...message, tone });
    if (!note) this.last = moment;
    if (more) {
      say(this.lastText, more.text);
      return false;
    }
    const word = kWords[tone] ?? "",
      text = h("span", note ? { translate: "no" } : {}, moment.text);
    if (!note) this.lastText = text;
    this.list.prepend(
      h(
        "li",
        { class: `event ${tone}` },
        mark(tone),
        h("span", { class: "event-time" }, this.#time(message.t_s)),
        h("span", {}, word ? h("strong", {}, `${word}: `) : null, text),
      ),
    );
    return true;
  }

  end() {
    this.over = true;
    this.writing.hidden = true;
  }
}
