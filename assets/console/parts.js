// What several pages are made of: notices, buttons, fields, tables.
import { h, mark, put } from "./dom.js";

/** A sentence with its shape. tone: good, bad, note, none, work, stop. */
export function notice(tone, text, ...more) {
  return h(
    "div",
    { class: `notice ${tone}`, role: tone === "bad" ? "alert" : null },
    mark(tone),
    h("div", {}, h("p", {}, text), more),
  );
}

export const badge = (tone, word) => h("span", { class: `badge ${tone}` }, mark(tone), word);
export const tag = (word) => h("span", { class: "badge tag" }, word);
export const simulatedBadge = () =>
  h("span", { class: "badge simulated" }, mark("note"), "simulated");

/**
 * A button that is off while its work is under way; what goes wrong is said in `trouble` (an
 * element) or beside it.
 */
export function button(label, work, attributes = {}) {
  const { trouble, ...rest } = attributes;
  const said = trouble || h("span", { class: "said" });
  const made = h(
    "button",
    { type: "button", ...rest, onclick: () => during(made, said, work) },
    label,
  );
  return trouble ? made : h("span", { class: "with-said" }, made, said);
}

/** Runs `work` with the button off; true when nothing went wrong. */
export async function during(pressed, said, work) {
  if (pressed.getAttribute("aria-disabled") === "true") return false;
  pressed.setAttribute("aria-disabled", "true");
  put(said);
  try {
    await work();
    return true;
  } catch (error) {
    put(said, notice("bad", error.message));
    return false;
  } finally {
    pressed.removeAttribute("aria-disabled");
  }
}

let serial = 0;
export const newId = (stem) => `${stem}-${++serial}`;

/** One thing to type, and a button that opens something. */
export function doorForm({ about, label, control, hint, go, work }) {
  const said = h("div", { class: "said" }),
    button = h("button", { type: "submit", class: "primary" }, go);
  return h(
    "form",
    {
      class: "card narrow",
      novalidate: true,
      onsubmit: (e) => {
        e.preventDefault();
        during(button, said, work);
      },
    },
    h("p", {}, about),
    field(label, control, hint),
    said,
    h("div", { class: "row" }, button),
  );
}

/** Label, control, explanation, tied together. */
export function field(label, control, hint) {
  const id = control.id || newId("field");
  control.id = id;
  if (hint) control.setAttribute("aria-describedby", `${id}-hint`);
  return h(
    "div",
    { class: "field" },
    h("label", { for: id }, label),
    control,
    hint ? h("p", { class: "hint", id: `${id}-hint` }, hint) : null,
  );
}

/** Other options in the same choice; what was chosen stays where it is among them. */
export function offer(select, options, chosen = select.value) {
  select.replaceChildren(...options.map(([value, word]) => h("option", { value }, word)));
  const there = options.some(([value]) => value === chosen);
  select.value = there ? chosen : (options[0]?.[0] ?? "");
}

export function choice(options, chosen) {
  const select = h("select");
  offer(select, options, chosen);
  return select;
}

export function tick(label, checked, hint, attributes = {}) {
  const box = h("input", { type: "checkbox", checked, ...attributes });
  box.id = newId("tick");
  if (hint) box.setAttribute("aria-describedby", `${box.id}-hint`);
  return {
    box,
    node: h(
      "div",
      { class: "field tick" },
      box,
      h("label", { for: box.id }, label),
      hint ? h("p", { class: "hint", id: `${box.id}-hint` }, hint) : null,
    ),
  };
}

/** Radio buttons in a fieldset; `value()` tells the chosen one. */
export function radios(legend, options, chosen, onchange) {
  const name = newId("radio");
  const node = h(
    "fieldset",
    { class: "radios" },
    h("legend", {}, legend),
    options.map(([value, word, hint]) => {
      const id = newId("choice");
      return h(
        "div",
        { class: "radio" },
        h("input", {
          type: "radio",
          name,
          id,
          value,
          checked: value === chosen,
          onchange,
          "aria-describedby": hint ? `${id}-hint` : null,
        }),
        h("label", { for: id }, word),
        hint ? h("p", { class: "hint", id: `${id}-hint` }, hint) : null,
      );
    }),
  );
  return { node, value: () => node.querySelector("input:checked")?.value ?? "" };
}

const kMostOnAPhone = 4; // columns

/**
 * Rows are arrays of text or nodes; the first of a row is its heading. Wider than a phone's screen,
 * each row stands there as a card, with the column's name before each figure (style.css); the roles
 * keep it a table for who hears it.
 */
export function table(caption, heads, rows, hideCaption = false) {
  return h(
    "div",
    { class: "scroll", role: "region", "aria-label": caption, tabindex: "0" },
    h(
      "table",
      { role: "table", class: heads.length > kMostOnAPhone ? "stacks" : null },
      h("caption", { class: hideCaption ? "unseen" : null }, caption),
      h(
        "thead",
        { role: "rowgroup" },
        h(
          "tr",
          { role: "row" },
          heads.map((x) => h("th", { scope: "col", role: "columnheader" }, x)),
        ),
      ),
      h(
        "tbody",
        { role: "rowgroup" },
        rows.map((row) =>
          h(
            "tr",
            { role: "row" },
            row.map((cell, at) =>
              at === 0
                ? h("th", { scope: "row", role: "rowheader" }, cell)
                : h(
                    "td",
                    { role: "cell", "data-head": heads[at]?.textContent ?? heads[at] },
                    h("div", {}, cell),
                  ),
            ),
          ),
        ),
      ),
    ),
  );
}

/** Figures behind a drawing, made when they are asked for. */
export function asTable(summary, make) {
  const inside = h("div", {});
  return h(
    "details",
    { class: "figures", ontoggle: (e) => put(inside, e.target.open ? make() : []) },
    h("summary", {}, summary),
    inside,
  );
}

export const facts = (pairs) =>
  h(
    "dl",
    { class: "facts" },
    pairs
      .filter(Boolean)
      .map(([name, value]) => h("div", {}, h("dt", {}, name), h("dd", {}, value))),
  );
export const progress = (label, done) =>
  h("progress", { "aria-label": label, max: 1, ...(Number.isFinite(done) ? { value: done } : {}) });
