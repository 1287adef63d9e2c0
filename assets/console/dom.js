// Elements from text: every string becomes a text node or an attribute, never markup; in the
// language of whoever reads. What somebody typed stays as it is: translate: "no".
import { said } from "./language.js";

const kSvg = "http://www.w3.org/2000/svg";
const kRead = new Set(["title", "alt", "placeholder", "aria-label", "data-head"]);

function fill(node, attributes, children) {
  const asTyped = attributes?.translate === "no";
  for (const [name, value] of Object.entries(attributes || {})) {
    if (value === null || value === undefined || value === false) continue;
    if (typeof value === "function") node.addEventListener(name.replace(/^on/, ""), value);
    else if (name === "value" || name === "checked") node[name] = value;
    else if (value === true) node.setAttribute(name, "");
    else node.setAttribute(name, kRead.has(name) && !asTyped ? said(String(value)) : String(value));
  }
  node.append(...flat(children, asTyped));
  return node;
}

/** Texts that follow one another are one text. */
function flat(children, asTyped) {
  const all = [];
  for (const c of children.flat(Infinity)) {
    if (c === null || c === undefined || c === false || c === "") continue;
    if (c instanceof Node) all.push(c);
    else if (typeof all.at(-1) === "string") all.push(all.pop() + String(c));
    else all.push(String(c));
  }
  return asTyped ? all : all.map((c) => (typeof c === "string" ? said(c) : c));
}

/**
 * h('p', {class: 'muted'}, 'text', node, [more]): an HTML element. A function among the attributes
 * listens (`onclick`).
 */
export function h(tag, attributes, ...children) {
  return fill(document.createElement(tag), attributes, children);
}

/** The same for SVG. */
export function svg(tag, attributes, ...children) {
  return fill(document.createElementNS(kSvg, tag), attributes, children);
}

export function put(node, ...children) {
  node.replaceChildren(...flat(children, node.translate === false));
  return node;
}

/** Changes a text only when it differs, so that nothing is announced or laid out twice. */
export function say(node, text) {
  const words = node.translate === false ? text : said(text);
  if (node.textContent !== words) node.textContent = words;
}

/** To screen readers, politely. */
export function announce(text) {
  say(document.getElementById("said"), text);
}

const kShapes = {
  good: () => [
    svg("circle", { cx: 8, cy: 8, r: 7 }),
    svg("path", { class: "in", d: "M4.8 8.3l2.2 2.2 4.2-4.6" }),
  ],
  bad: () => [
    svg("path", { d: "M8 .6 15.4 8 8 15.4.6 8z" }),
    svg("path", { class: "in", d: "M8 4.6v4M8 10.9v.3" }),
  ],
  note: () => [
    svg("path", { d: "M8 1 15.4 14.6H.6z" }),
    svg("path", { class: "in", d: "M8 6v4M8 12.2v.2" }),
  ],
  near: () => [
    svg("path", { d: "M8 15 15.4 1.4H.6z" }),
    svg("path", { class: "in", d: "M8 3.8v4M8 10v.2" }),
  ],
  none: () => [svg("circle", { class: "open", cx: 8, cy: 8, r: 6 })],
  neutral: () => [svg("rect", { x: 6, y: 1, width: 4, height: 14, rx: 1 })],
  stop: () => [
    svg("path", { d: "M5 .8h6L15.2 5v6L11 15.2H5L.8 11V5z" }),
    svg("path", { class: "in", d: "M4.8 8h6.4" }),
  ],
  work: () => [svg("path", { class: "open", d: "M8 2a6 6 0 1 1-6 6" })],
};

/** A shape for a tone; it never stands without its word. */
export function mark(tone) {
  const known = kShapes[tone] ? tone : "neutral";
  return svg(
    "svg",
    {
      class: `mark ${known}`,
      viewBox: "0 0 16 16",
      width: 16,
      height: 16,
      "aria-hidden": "true",
      focusable: "false",
    },
    kShapes[known](),
  );
}
