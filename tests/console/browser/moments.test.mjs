// Events as a person tells them: force taken away and given back.
import assert from "node:assert/strict";
import { test } from "node:test";

const { momentsIn } = await import(
  process.env.PALPA_CONSOLE_PAGES
    ? `file://${process.env.PALPA_CONSOLE_PAGES}/moments.js`
    : new URL("../../../assets/console/moments.js", import.meta.url)
);
const away = (t_s, cause = "the device was silent") => ({
  t_s,
  event: "safety",
  text: `Force taken away: ${cause}`,
  tone: "bad",
});
const back = (t_s) => ({ t_s, event: "safety", text: "Force is back", tone: "neutral" });
const texts = (events) => momentsIn(events).map((m) => m.text);

test("away and back is one", () => {
  assert.deepEqual(texts([away(1), back(1.25)]), [
    "Force was off for 0.3 s: the device was silent",
  ]);
  assert.deepEqual(texts([away(1), back(1.01)]), [
    "Force was off for less than 0.1 s: the device was silent",
  ]);
  assert.deepEqual(texts([away(1)]), ["Force taken away: the device was silent"]);
});

test("several of one cause in a row are one; the moment stays the first", () => {
  const all = momentsIn([away(1), back(1.2), away(2), back(2.3), away(3)]);
  assert.equal(all.length, 1);
  assert.equal(all[0].t, 1);
  assert.equal(all[0].tone, "bad");
  assert.equal(all[0].text, "Force taken away, 3 times in a row: the device was silent");
  assert.deepEqual(texts([away(1), back(1.2), away(2), back(2.3)]), [
    "Force was off 2 times, 0.5 s in all: the device was silent",
  ]);
});

test("a void trial is told as one", () => {
  assert.deepEqual(texts([{ t_s: 1, event: "void", text: "technical fault" }]), [
    "Trial is void: technical fault",
  ]);
});

test("another cause, or something between, is another", () => {
  assert.equal(texts([away(1), back(1.2), away(2, "emergency stop")]).length, 2);
  assert.deepEqual(
    texts([away(1), { t_s: 1.5, event: "puncture", text: "The skin is punctured" }, back(2)]),
    ["Force taken away: the device was silent", "The skin is punctured", "Force is back"],
  );
  assert.deepEqual(texts([back(1)]), ["Force is back"]);
  assert.deepEqual(texts([{ t_s: 1, event: "note", text: "Force taken away: a note says so" }]), [
    "Force taken away: a note says so",
  ]);
});
