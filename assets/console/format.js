// Figures and states in words.
const kDay = { day: "numeric", month: "short", year: "numeric" };
const kMoment = { ...kDay, hour: "2-digit", minute: "2-digit" };

/** As the page's language writes dates; a language that nobody speaks writes them in English. */
function dated(utc, form) {
  const at = utc ? new Date(utc) : null;
  const { lang } = document.documentElement;
  const language = lang === "en" || lang.startsWith("qps") ? "en-GB" : lang;
  return at && !Number.isNaN(at.getTime()) ? at.toLocaleString(language, form) : "";
}
export const day = (utc) => dated(utc, kDay) || "–";
export const moment = (utc) => dated(utc, kMoment) || "–";

/** 83.4 -> "1:23.4" */
export function clock(seconds, digits = 1) {
  const t = Math.max(0, Number(seconds) || 0);
  const minutes = Math.floor(t / 60);
  const rest = (t - minutes * 60).toFixed(digits);
  return `${minutes}:${rest.padStart(digits ? 3 + digits : 2, "0")}`;
}

export const plural = (n, one, many = `${one}s`) => `${n} ${n === 1 ? one : many}`;
export const figure = (x, digits = 1) => (Number.isFinite(x) ? x.toFixed(digits) : "–");
export const capital = (text) => (text ? text[0].toUpperCase() + text.slice(1) : "");
export const who = (trainee) => trainee || "nobody (T000)";

/** What a session was of: by its title; one of an older console has the task's id alone. */
export const taskName = (session) =>
  session.title || capital(String(session.task || "task").replaceAll("_", " "));

/** Of a path only its last name: the rest is for whoever looks after the station. */
export const withoutPaths = (text) =>
  text.replace(/(^|[\s("'])[.~]*\/(?:[^\s/,;:)"']+\/)*([^\s/,;:)"']+)/g, "$1$2");

const kSessionStates = {
  starting: ["work", "starting"],
  running: ["work", "on now"],
  finished: ["good", "finished"],
  failed: ["bad", "failed"],
  interrupted: ["note", "ended without a report"],
};
export const sessionState = (state) =>
  kSessionStates[state] || ["none", String(state || "unknown")];
export const isOn = (session) => session.state === "starting" || session.state === "running";

const kOutcomes = {
  success: ["good", "success"],
  aborted: ["note", "aborted"],
  time: ["bad", "time was up"],
  passes: ["bad", "too many passes"],
  void: ["none", "void, does not count"],
  "not scored": ["none", "not scored"],
};
const outcome = (name) => kOutcomes[name] || ["neutral", String(name || "no outcome")];

/** What came of a trial; of one that was held to its end, whether it reached what it is about. */
export const trialOutcome = (r) =>
  r.outcome === "done" && r.goal
    ? [r.goal.reached ? "good" : "note", r.goal.word]
    : outcome(r.outcome);
export const hasReached = (r) => (r.goal ? r.goal.reached : r.outcome === "success");

const kLiveStates = {
  checking: ["work", "Checking the station"],
  waiting: ["note", "Waiting for you to start"],
  running: ["good", "Trial is running"],
  paused: ["note", "Paused"],
  ended: ["none", "Trial has ended"],
  finished: ["none", "Session is over"],
};
export const liveState = (state) =>
  kLiveStates[state] || ["neutral", capital(String(state || "unknown"))];

/** view-01-02-puncture.png -> "Trial 1: puncture" */
export function pictureName(file) {
  const parts = /^view-0*(\d+)-\d+-(.+)\.png$/.exec(file);
  return parts ? `Trial ${parts[1]}: ${parts[2].replace(/-/g, " ")}` : file;
}

/** Of the trials that count, in words and with a shape. */
export function sessionOutcome(s) {
  const o = s.outcome;
  if (s.blind) return ["none", "blind study"];
  if (!o) return ["none", "–"];
  if (o.counting === 0) return ["none", "no trial counts"];
  if (o.done > 0) return ["none", `${o.done} of ${o.counting} done`];
  return [
    o.succeeded === o.counting ? "good" : "note",
    `${o.succeeded} of ${o.counting} ${o.word || "succeeded"}`,
  ];
}

/** Who held the tool: a person, or who was simulated. */
export const performer = (s) =>
  ({ expert: "simulated expert", novice: "simulated novice" })[s.performer] ||
  (s.simulated && !s.trainee ? "simulated" : "a person");
