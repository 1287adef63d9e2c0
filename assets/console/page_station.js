// Is the station well? One sentence first, then what was found, then the way to a session.
import { get, post } from "./api.js";
import { announce, h, mark, put } from "./dom.js";
import { capital, moment, plural, withoutPaths } from "./format.js";
import { badge, button, notice } from "./parts.js";

const kRoom_ms = 2000;

const kStates = {
  well: ["good", "well"],
  none: ["none", "not there"],
  note: ["note", "note"],
  ill: ["bad", "needs you"],
};
const kOrder = ["ill", "note", "well", "none"];

function sentence(health) {
  const findings = health.findings || [];
  const ill = findings.filter((f) => f.state === "ill"),
    notes = findings.filter((f) => f.state === "note");
  if (health.state === "checking")
    return [
      "work",
      "The station is being checked…",
      "This takes a few seconds. You need not wait: the checks go on.",
    ];
  if (ill.length > 0 || health.can_start === false)
    return [
      "bad",
      "The station needs you first.",
      ill.length > 0
        ? ill.map((f) => f.fix || f.verdict).join(" ")
        : "No session can start; what was found is listed below.",
    ];
  if (notes.length > 0)
    return [
      "good",
      "The station is well.",
      `${notes.length === 1 ? "One thing" : plural(notes.length, "thing")} to know, below; ` +
        "a session can start.",
    ];
  return ["good", "The station is well.", "Everything that a session needs was found and works."];
}

/** What was found; whole paths when one points at it. */
const foundWords = (words) =>
  h("p", { title: words === withoutPaths(words) ? null : words }, capital(withoutPaths(words)));

function finding(f) {
  const [tone, word] = kStates[f.state] || ["neutral", String(f.state)];
  return h(
    "li",
    { class: `finding ${tone}` },
    h("div", { class: "finding-state" }, badge(tone, word)),
    h(
      "div",
      {},
      h("h3", {}, String(f.subject || "")),
      foundWords(String(f.verdict || "")),
      f.fix ? h("p", { class: "fix" }, h("strong", {}, "What to do: "), f.fix) : null,
    ),
  );
}

/** This station's place in its room; what goes wrong there changes nothing here. */
async function lookForRoom(node) {
  const { joined } = await get("/api/room");
  if (!joined || node.dataset.shown === JSON.stringify(joined)) return;
  node.dataset.shown = JSON.stringify(joined);
  put(
    node,
    joined.stands && !joined.trouble
      ? notice("good", `In the room as ${joined.station}.`)
      : notice(
          "note",
          joined.trouble || "The room's broker is being reached…",
          joined.stands
            ? null
            : h("p", {}, "This station goes on alone: what its sessions record is told later."),
        ),
  );
}

export async function show({ root, life, open, me }) {
  open("Station");
  const hero = h("section", { class: "hero", "aria-labelledby": "health-sentence" }),
    room = h("div", {}),
    list = h("div", {});
  root.append(hero, room, list);
  if (me.room?.station || me.room?.trouble) life.every(kRoom_ms, () => lookForRoom(room));
  let shown = "";
  const look = async () => {
    const health = await get("/api/health");
    const key = JSON.stringify(health);
    if (key === shown) return health.state === "checking";
    shown = key;
    const [tone, first, then] = sentence(health);
    const again = button(
      "Check again",
      async () => {
        await post("/api/health", {});
        life.every(700, look);
      },
      { class: "quiet" },
    );
    put(
      hero,
      h("div", { class: `hero-mark ${tone}` }, mark(tone)),
      h(
        "div",
        { class: "hero-words" },
        h("p", { class: "hero-sentence", id: "health-sentence" }, first),
        h("p", {}, then),
      ),
      h(
        "div",
        { class: "hero-go" },
        h(
          "a",
          {
            class: `button big ${tone === "bad" ? "" : "primary"}`,
            href: "#/session",
            id: "start-session",
          },
          "Start a session",
        ),
        again,
      ),
    );
    announce(first);
    const findings = [...(health.findings || [])].sort(
      (a, b) => kOrder.indexOf(a.state) - kOrder.indexOf(b.state),
    );
    put(
      list,
      h("h2", {}, "What was found"),
      findings.length > 0
        ? h("ul", { class: "findings" }, findings.map(finding))
        : h("p", { class: "muted" }, "Nothing yet."),
      health.checked_utc
        ? h("p", { class: "muted under" }, `Checked ${moment(health.checked_utc)}`)
        : null,
    );
    return health.state === "checking";
  };
  await look();
  life.every(700, look);
}
