// Addresses after the "#": one page each, with a life that ends when another is chosen.
import { h, put } from "./dom.js";
import { said } from "./language.js";
import { notice } from "./parts.js";

const kName = "Palpa console";
let life = null;
let serial = 0;

/** What a page may leave running, and what ends with it. */
class Life {
  constructor() {
    this.control = new AbortController();
    this.timers = new Set();
  }
  get over() {
    return this.control.signal.aborted;
  }
  listen(target, type, callback, options = {}) {
    target.addEventListener(type, callback, { ...options, signal: this.control.signal });
  }
  atEnd(callback) {
    this.control.signal.addEventListener("abort", callback);
  }
  after(ms, callback) {
    const t = setTimeout(() => {
      this.timers.delete(t);
      if (!this.over) callback();
    }, ms);
    this.timers.add(t);
  }
  /**
   * One call after the other, `ms` apart, until the page ends or the callback says
   * false. A failure is tried again.
   */
  async every(ms, callback) {
    while (!this.over) {
      try {
        if ((await callback()) === false) return;
      } catch {
        /* the connection's banner says it */
      }
      await new Promise((done) => {
        this.after(ms, done);
      });
    }
  }
  end() {
    for (const t of this.timers) clearTimeout(t);
    this.control.abort();
  }
}

/** What is no proper address stays as it was typed, and matches no page. */
function decoded(part) {
  try {
    return decodeURIComponent(part);
  } catch {
    return part;
  }
}

function matching(routes, path) {
  const parts = path.split("/").filter(Boolean).map(decoded);
  for (const [pattern, load] of routes) {
    const wanted = pattern.split("/").filter(Boolean);
    if (wanted.length !== parts.length) continue;
    if (wanted.every((w, at) => w.startsWith(":") || w === parts[at]))
      return { load, params: parts.filter((_, at) => wanted[at].startsWith(":")), first: parts[0] };
  }
  return null;
}

function showPlace(first) {
  const here = { cohort: "results", replay: "results" }[first] || first;
  for (const link of document.querySelectorAll("header nav a")) {
    if (link.getAttribute("href") === `#/${here}`) link.setAttribute("aria-current", "page");
    else link.removeAttribute("aria-current");
  }
}

/** Sets heading and title; the heading takes the focus unless this is the first page. */
function opener(root, first) {
  return (title, ...beside) => {
    document.title = `${said(title)} · ${kName}`;
    const heading = h("h1", { tabindex: "-1" }, title);
    put(root, h("div", { class: "page-head" }, heading, beside));
    if (!first) heading.focus({ preventScroll: true });
    window.scrollTo(0, 0);
    return root;
  };
}

async function show(routes, guard) {
  life?.end();
  life = new Life();
  const mine = ++serial;
  const [path, query] = location.hash.replace(/^#/, "").split("?");
  const found = matching(routes, path);
  if (!found) {
    location.replace("#/station");
    return;
  }
  const root = h("div", { class: `page ${found.first}` });
  const here = {
    root,
    life,
    params: found.params,
    query: new URLSearchParams(query || ""),
    open: opener(root, mine === 1),
  };
  try {
    const page = await found.load();
    const me = await guard(found.first);
    if (mine !== serial || !me) return;
    put(document.getElementById("main"), root);
    showPlace(found.first);
    await page.show({ ...here, me });
  } catch (error) {
    if (mine !== serial) return;
    if (!root.isConnected) put(document.getElementById("main"), root);
    if (!root.querySelector("h1")) here.open("This page could not be shown");
    if (error.offline) root.dataset.waits = "yes"; // shown again when somebody answers
    root.append(notice("bad", error.message || "This page could not be shown. Reload it."));
  }
}

/**
 * routes: [pattern, () => import(...)]. guard(first part): what every page is told, or nothing when
 * it sent the reader elsewhere.
 */
export function startRouter(routes, guard) {
  const skip = document.getElementById("skip");
  skip.addEventListener("click", (e) => {
    e.preventDefault();
    (document.querySelector("main h1") || document.getElementById("main")).focus();
  });
  window.addEventListener("hashchange", () => show(routes, guard));
  return show(routes, guard);
}
