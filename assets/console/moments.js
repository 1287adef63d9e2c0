// Moments as a person tells them: force taken away and given back is one thing that happened, and
// several of one cause in a row are one, too.
const kAway = /^Force taken away: (.*)$/,
  kBack = "Force is back";

function words(off) {
  const seconds = off.total < 0.05 ? "less than 0.1 s" : `${off.total.toFixed(1)} s`;
  if (off.since !== null)
    return off.times === 1
      ? `Force taken away: ${off.cause}`
      : `Force taken away, ${off.times} times in a row: ${off.cause}`;
  return off.times === 1
    ? `Force was off for ${seconds}: ${off.cause}`
    : `Force was off ${off.times} times, ${seconds} in all: ${off.cause}`;
}

const withWords = (moment, off) => ({ ...moment, off, text: words(off) });

const kNamed = { void: "Trial is void" }; // its text is the reason alone

/** The moment that an event begins: {t, tone, event, text}. */
export function momentOf(event) {
  const moment = {
    t: event.t_s,
    tone: event.tone || "neutral",
    event: event.event || "",
    text: String(event.text || event.event || ""),
  };
  if (kNamed[event.event])
    moment.text =
      moment.text && moment.text !== event.event
        ? `${kNamed[event.event]}: ${moment.text}`
        : kNamed[event.event];
  const away = event.event === "safety" ? kAway.exec(moment.text) : null;
  return away
    ? withWords(moment, { cause: away[1], since: event.t_s, times: 1, total: 0 })
    : moment;
}

/** The last moment with an event that belongs to it; null: the event is one of its own. */
export function joined(last, event) {
  if (!last?.off || event.event !== "safety") return null;
  const { off } = last,
    text = String(event.text || "");
  if (text === kBack && off.since !== null)
    return withWords(last, {
      ...off,
      total: off.total + Math.max(0, event.t_s - off.since),
      since: null,
    });
  if (kAway.exec(text)?.[1] === off.cause && off.since === null)
    return withWords(last, { ...off, times: off.times + 1, since: event.t_s });
  return null;
}

/** All events of a trial as moments, in their order. */
export function momentsIn(events) {
  const all = [];
  for (const event of events) {
    const more = joined(all.at(-1), event);
    if (more) all[all.length - 1] = more;
    else all.push(momentOf(event));
  }
  return all;
}
