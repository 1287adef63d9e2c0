// The page of a room at a console that watches one: PALPA_CONSOLE_URL, with the stations bench1,
// which is on the virtual bench and free, and bench2, which is gone.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { Educator } from "./educator.mjs";

const url = process.env.PALPA_CONSOLE_URL;
const skip = url ? false : "PALPA_CONSOLE_URL is not set: start a console and give its address";
const kSizes = [
  { width: 1280, height: 800 },
  { width: 1024, height: 768 },
  { width: 390, height: 844 },
];
let e, page;

before(async () => {
  if (skip) return;
  e = await Educator.come(url, process.env.PALPA_CONSOLE_SHOTS);
  page = e.page;
  await e.go("#/room");
});
after(async () => {
  await e?.leave();
});

const card = (name) => page.locator(".room-card", { has: page.getByRole("heading", { name }) });
const state = (name, word) => card(name).locator(".badge", { hasText: word });
const button = (words) => page.getByRole("button", { name: words, exact: true });

async function lookAtAllSizes(name) {
  for (const size of kSizes) {
    e.size = size;
    await page.setViewportSize(size);
    await e.look(`${name}, ${size.width} px`);
  }
}

test("one station is free, the other one gone, and comes first", { skip }, async () => {
  await state("bench1", "free").waitFor();
  await state("bench2", "gone").waitFor();
  await page.getByText("2 stations: 0 in a session, 1 gone.").waitFor();
  await page.waitForFunction(() => {
    const [one, two] = ["bench1", "bench2"].map((name) =>
      [...document.querySelectorAll(".room-card")].find((c) => c.innerText.startsWith(name)),
    );
    return Number(two.style.order) < Number(one.style.order);
  });
  await lookAtAllSizes("a room at rest");
});

test("a session is prepared from here: it says that force begins there", { skip }, async () => {
  await button("Prepare a session: bench1").click();
  const dialog = page.getByRole("dialog");
  await dialog.getByText("Force begins only after a key or a button at the station.").waitFor();
  await lookAtAllSizes("prepare a session");
  await page.keyboard.press("Escape");
  await dialog.waitFor({ state: "hidden" });
});

test("a session that runs is seen, paused, stopped and ended", { skip }, async () => {
  // Nobody stands at this station: the simulated expert does, whom the page does not offer.
  await page.evaluate(async () => {
    const { post } = await import("/static/api.js");
    const wish = { task: "paracentesis", operator: "expert" };
    await post("/api/room/bench1/ask", { ask: "prepare", wish, session: "" });
  });
  await state("bench1", "running").waitFor();
  await card("bench1").locator("img.room-view:not([hidden])").waitFor();
  await card("bench1").getByText("What happened there").click();
  await card("bench1").locator(".room-events").getByText("Trial 1").first().waitFor();
  await lookAtAllSizes("a room at work");
  await button("Pause: bench1").click();
  await state("bench1", "paused").waitFor();
  await button("Stop forces: bench1").click();
  await card("bench1").getByRole("alert").getByText("Emergency stop").waitFor();
  await lookAtAllSizes("a station that calls");
  await button("End the session: bench1").click();
  await page.getByRole("dialog").getByRole("button", { name: "End the session" }).click();
  await state("bench1", "free").waitFor();
});

test("nothing of it was hard to see, and the browser complained of nothing", { skip }, () => {
  assert.deepEqual(e.faults, []);
  assert.deepEqual(e.complaints, []);
});
