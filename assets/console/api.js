// The server in sentences: reads, writes (page key, a nonce for each), and
// whether it answers at all.
const kPatience_ms = 15000,
  kDoubt_ms = 1500;
let pageKey = "";
let known = null;
let lostAt = 0,
  heardAt = 0;
const watchers = new Set();

export class Trouble extends Error {
  constructor(message, status = 0) {
    super(message);
    this.status = status;
  }
  get offline() {
    return this.status === 0;
  }
}

/** Calls back with the time (ms) since when nobody answers, 0 when somebody does again. */
export function watchConnection(callback) {
  watchers.add(callback);
  return () => watchers.delete(callback);
}
export function lostSince() {
  return lostAt;
}

/** A failure right after an answer or a live message is not yet a lost connection. */
export function reportConnection(answers) {
  if (answers) heardAt = Date.now();
  else if (Date.now() - heardAt < kDoubt_ms) return;
  const next = answers ? 0 : lostAt || Date.now();
  if (next === lostAt) return;
  lostAt = next;
  for (const callback of watchers) callback(lostAt);
}

function nonce() {
  return Array.from(crypto.getRandomValues(new Uint8Array(16)), (byte) =>
    byte.toString(16).padStart(2, "0"),
  ).join("");
}

async function sentence(response) {
  try {
    const answer = await response.json();
    if (answer && typeof answer.error === "string" && answer.error) return answer.error;
  } catch {
    /* no JSON: the status must do */
  }
  if (response.status === 404)
    return "The console does not have this. It may have been removed; go back and choose again.";
  return (
    `The console could not do this (answer ${response.status}). ` +
    "Try again; if that does not help, look at the Station page."
  );
}

async function send(method, path, body, patience_ms = kPatience_ms) {
  const headers =
    method === "POST"
      ? { "Content-Type": "application/json", "X-Palpa-Page": pageKey, "X-Palpa-Write": nonce() }
      : {};
  let response;
  try {
    response = await fetch(path, {
      method,
      headers,
      cache: "no-store",
      body: method === "POST" ? JSON.stringify(body ?? {}) : undefined,
      signal: AbortSignal.timeout(patience_ms),
    });
  } catch {
    reportConnection(false);
    throw new Trouble(
      "No connection to the console. What you asked for has not been confirmed; " +
        "it is not sent again until you ask again.",
    );
  }
  reportConnection(true);
  return response;
}

async function answerOf(response) {
  if (!response.ok) throw new Trouble(await sentence(response), response.status);
  const text = await response.text();
  if (!text) return {};
  try {
    return JSON.parse(text);
  } catch {
    throw new Trouble("The console's answer cannot be read. Reload this page.", response.status);
  }
}

/**
 * After a refusal: who one is may have changed (a restart, a new token); who is outside is sent to
 * the door. True when the page key is another one.
 */
async function renewed(path) {
  if (path === "/api/me" || path === "/api/enter") return false;
  const before = pageKey;
  const now = await me(true);
  if (path.startsWith("/api/mine")) return pageKey !== before; // a trainee's need no token
  if (!now.entered) location.hash = "#/enter";
  return now.entered && pageKey !== before;
}
const refused = (response) => response.status === 401 || response.status === 403;

export async function get(path) {
  const response = await send("GET", path);
  if (refused(response)) await renewed(path);
  return answerOf(response);
}

/**
 * A write. A page key from before the server's last start is renewed once: what was
 * refused has not been done.
 */
export async function post(path, body, patience_ms) {
  let response = await send("POST", path, body, patience_ms);
  if (refused(response) && (await renewed(path)))
    response = await send("POST", path, body, patience_ms);
  return answerOf(response);
}

/** Who and where: asked once, and again after entering or a restart. */
export async function me(again = false) {
  if (!known || again) {
    known = await get("/api/me");
    pageKey = known.page_key || "";
  }
  return known;
}

/** A list, whatever the server sent: what is not a list is an empty one. */
export async function list(path) {
  const answer = await get(path);
  return Array.isArray(answer) ? answer : [];
}

export const url = (...parts) =>
  parts.map((part, at) => (at === 0 ? part : encodeURIComponent(part))).join("/");
