// The console: routes, who and where, and what stands on every page.
import { get, list, lostSince, me, watchConnection } from "./api.js";
import { announce, h, mark, put, say } from "./dom.js";
import { isOn } from "./format.js";
import { languageChoice, speakAsThePage } from "./language.js";
import { simulatedBadge } from "./parts.js";
import { startRouter } from "./router.js";

const routes = [
  ["station", () => import("./page_station.js")],
  ["calibrate", () => import("./page_calibrate.js")],
  ["trainees", () => import("./page_trainees.js")],
  ["trainees/:id", () => import("./page_trainee.js")],
  ["session", () => import("./page_session.js")],
  ["session/:id", () => import("./page_live.js")],
  ["results", () => import("./page_results.js")],
  ["results/:id", () => import("./page_result.js")],
  ["cohort", () => import("./page_cohort.js")],
  ["replay/:id/:n", () => import("./page_replay.js")],
  ["studies", () => import("./page_studies.js")],
  ["enter", () => import("./page_enter.js")],
  ["room", () => import("./page_room.js")],
  ["mine", () => import("./page_mine.js")],
];

/** Nobody goes further than the door without the token; who is in need not stand at it. */
async function guard(first) {
  const here = await me(!lastKnown());
  document.body.dataset.guest = first === "mine" && !here.entered ? "yes" : "no";
  if (first === "mine") return here;
  if (!here.entered && first !== "enter") {
    location.replace("#/enter");
    return null;
  }
  if (here.entered && first === "enter") {
    location.replace("#/station");
    return null;
  }
  remember(here);
  return here;
}

/** The stations as they stand; all virtual benches are one place. */
function placesOf(here) {
  const all = here.stations ?? [];
  return all.every((s) => s.bench) ? all.slice(0, 1) : all.filter((s) => !s.bench);
}

let entered = false;
const lastKnown = () => entered;
function remember(here) {
  entered = !!here.entered;
  put(
    document.getElementById("where"),
    placesOf(here).map((s) => [
      h("span", { title: s.title }, s.title.replace(/ \(.*\)$/, "")),
      s.simulated ? simulatedBadge() : null,
    ]),
  );
  document.getElementById("nav-room").hidden = !here.room?.watches;
  say(
    document.getElementById("foot"),
    `Palpa ${here.version || ""} · Pseudonyms only · ` +
      (here.room?.station
        ? `The room's console is told how ${here.room.station} stands and what happens here`
        : "Records stay on this station, nothing leaves this computer."),
  );
}

/** The banner counts; only its coming and going is announced. */
function showConnection() {
  const banner = document.getElementById("lost");
  const since = lostSince();
  const was = banner.hidden;
  banner.hidden = !since;
  if (since) {
    const seconds = Math.round((Date.now() - since) / 1000);
    const continues = document.body.dataset.sessionOn === "yes" ? "; the session continues" : "";
    put(
      banner,
      mark("note"),
      h("span", {}, `No connection to the console for ${seconds} s${continues}. Trying again…`),
    );
  }
  if (was && since) announce("No connection to the console. Trying again.");
  if (!was && !since) announce("The connection is back.");
}

async function lookForSession() {
  if (!entered) return;
  const on = (await list("/api/sessions")).find(isOn);
  document.body.dataset.sessionOn = on ? "yes" : "no";
  const link = document.getElementById("nav-session");
  put(link, "Session", on ? h("span", { class: "on" }, mark("work"), "on") : null);
}

watchConnection(showConnection);
watchConnection((since) => {
  if (!since && document.querySelector("main [data-waits]")) location.reload();
});
setInterval(showConnection, 1000);
setInterval(() => {
  if (lostSince()) get("/api/me").catch(() => {});
}, 2000);
setInterval(() => {
  if (!lostSince() && !document.hidden) lookForSession().catch(() => {});
}, 4000);
if (!location.hash) history.replaceState(null, "", "#/station");
await speakAsThePage();
languageChoice()
  .then((choice) => document.getElementById("tongue").replaceChildren(...choice))
  .catch(() => {});
startRouter(routes, guard).then(() => lookForSession().catch(() => {}));
