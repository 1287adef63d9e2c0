// An educator's day at a console that runs: PALPA_CONSOLE_URL (and PALPA_CONSOLE_TOKEN,
// PALPA_CONSOLE_SHOTS, PALPA_CHROMIUM).
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import fs from "node:fs";
import path from "node:path";
import { after, before, test } from "node:test";
import { Educator, kDesktop, kTablet } from "./educator.mjs";
import { Keyboard } from "./hands.mjs";

const url = process.env.PALPA_CONSOLE_URL;
const skip = url ? false : "PALPA_CONSOLE_URL is not set: start a console and give its address";
const begin = process.env.PALPA_CONSOLE_BEGIN;
const stem = `B${Date.now().toString(36).toUpperCase()}`;
const trainees = [`${stem}-1`, `${stem}-2`];
const kMark = "<img src=x onerror=alert(1)>";
const sessions = [];
let e, page;

before(async () => {
  if (!skip) {
    e = await Educator.come(url, process.env.PALPA_CONSOLE_SHOTS, process.env.PALPA_CONSOLE_TOKEN);
    page = e.page;
  }
});
after(async () => {
  await e?.leave();
});

const points = () => page.locator(".curves").getAttribute("data-points").then(Number);
const state = (word) => page.locator(".live-state", { hasText: word });
const over = () => page.getByRole("link", { name: "Read the result" });
/** A seed with which the simulated expert is done soon, in 13 s; with the next one as well. */
const kShortTrials = "40";
/** ms: a trial on a computer that hardly draws, where hands move only while they see. */
const kWhole = 240_000;

async function startAssessed(trainee, trials) {
  await e.go("#/session");
  await page.getByLabel("Trainee").selectOption(trainee);
  await page.getByLabel("assessed", { exact: true }).check();
  await page.getByLabel("simulated expert").check();
  await page.getByText("More: number of trials").click();
  await page.getByLabel("Seed", { exact: true }).fill(kShortTrials);
  if (trials > 1) await page.getByLabel("Trials", { exact: true }).fill(String(trials));
  await page.locator("#begin").click();
  await page.waitForURL(/#\/session\/.+/);
  const id = decodeURIComponent(page.url().split("/").pop());
  sessions.push(id);
  await state("Trial is running").waitFor({ timeout: 120_000 });
  return id;
}

/** The page says that it hears nothing and that the session continues; then it catches up. */
async function withoutNetwork() {
  await e.cut();
  try {
    await page.locator("#lost", { hasText: "No connection to the console for" }).waitFor();
    assert.match(await page.locator("#lost").textContent(), /the session continues\. Trying again/);
    await e.picture("no-connection");
  } finally {
    await e.context.setOffline(false);
  }
  await page.locator("#lost").waitFor({ state: "hidden" });
  e.away = false;
  const now = await points();
  await page.waitForFunction(
    (n) => Number(document.querySelector(".curves")?.dataset.points) > n,
    now,
  );
}

test("the first page says whether the station is well", { skip }, async () => {
  await e.go("");
  await page
    .locator(".hero-sentence", { hasText: "The station is well." })
    .waitFor({ timeout: 120_000 });
  assert.match(page.url(), /#\/station$/);
  assert.ok((await page.locator(".finding").count()) > 0, "findings are listed");
  await e.examine("station");
});

test("the camera is calibrated", { skip, timeout: 400_000 }, async () => {
  await e.go("#/calibrate");
  await e.examine("calibrate");
  await page.locator(".step", { hasText: "amera" }).first().getByRole("button").click();
  await page.locator("#calibration-work progress").waitFor();
  await page.waitForFunction(() => document.querySelector(".job-picture")?.naturalWidth > 0);
  await page.waitForTimeout(1500);
  await e.picture("calibrating");
  await page.locator("#calibration-work .notice").waitFor({ timeout: 300_000 });
  assert.equal(
    await page.locator("#calibration-work .notice.bad").count(),
    0,
    await page.locator("#calibration-work").textContent(),
  );
  await e.examine("calibrated");
});

test(
  "each station is calibrated by itself, and a task says where it is held",
  { skip, timeout: 400_000 },
  async () => {
    await e.go("#/calibrate?station=touch");
    await page.locator(".step", { hasText: "amera" }).first().getByRole("button").click();
    await page.locator("#calibration-work .notice.good").waitFor({ timeout: 300_000 });
    await page.getByRole("radio", { name: "Search", exact: true }).check();
    await page.waitForFunction(() => document.querySelectorAll(".step").length === 1);
    assert.equal(await page.getByRole("button", { name: "Run all steps" }).count(), 0);
    await e.go("#/session");
    for (const [task, said] of [
      ["Palpation of the breast", /palpation bench.*Calibrated/],
      ["Find the rough one: a haptic search", /search bench.*Not measured yet/],
    ]) {
      await page.getByRole("radio", { name: task, exact: true }).check();
      assert.match(await page.locator("#held-at").textContent(), said);
    }
  },
);

test(
  "two trainees are added; one without agreement is not; what they wrote is text",
  { skip },
  async () => {
    await e.go("#/trainees");
    for (const [at, id] of trainees.entries()) {
      await page.getByLabel("Pseudonym").fill(id);
      await page.getByLabel("Experience").fill(at === 0 ? kMark : "two simple injections");
      await page.getByRole("button", { name: "Add the trainee" }).click();
      await page.getByRole("alert").filter({ hasText: "agreement" }).waitFor();
      await page.getByLabel(/agrees that training records/).check();
      await page.getByRole("button", { name: "Add the trainee" }).click();
      await page.getByRole("link", { name: id, exact: true }).waitFor();
    }
    await page.getByRole("cell", { name: kMark }).first().waitFor();
    assert.equal(await page.locator("main img").count(), 0, "a trainee's words make no element");
    await e.examine("trainees");
  },
);

test(
  "an assessed trial is watched live, and a note taken",
  { skip, timeout: 2 * kWhole },
  async (t) => {
    await e.go("#/session");
    await e.examine("session");
    const id = await startAssessed(trainees[0], 1);
    await page.waitForFunction(() => Number(document.querySelector(".curves")?.dataset.points) > 5);
    const first = await points();
    await page.waitForFunction(() => document.querySelector("img.view")?.naturalWidth > 0);
    const rate = await e.picturesPerSecond(id, 3);
    t.diagnostic(`pictures a second on the live page's stream: ${rate.toFixed(1)}`);
    assert.ok(rate > 0, `${rate.toFixed(1)} pictures a second`);
    const later = await points();
    t.diagnostic(`points of the curve in between: ${later - first}`);
    assert.ok(later > first, "the curve grows");
    await page.locator("main h1").focus();
    await page.keyboard.press("m");
    await page.keyboard.type("left hand not in the field");
    await page.keyboard.press("Enter");
    await page.locator(".event.note", { hasText: "left hand not in the field" }).waitFor();
    await withoutNetwork();
    await e.go("#/station");
    await e.go("#/session");
    await page.waitForFunction(
      (n) => Number(document.querySelector(".curves")?.dataset.points) >= n,
      later,
    ); // who comes back misses nothing
    await page.waitForFunction(() => document.querySelector("img.view")?.naturalWidth > 0);
    await page.waitForTimeout(1200);
    await e.picture("live");
    await over().waitFor({ timeout: kWhole });
    assert.equal(
      await page.locator(".event.note", { hasText: "left hand not in the field" }).count(),
      1,
      "a note is shown once",
    );
    await e.picture("over");
  },
);

test("the result says how it went, and is printed", { skip, timeout: 300_000 }, async (t) => {
  for (const [at, id] of sessions.entries()) {
    await e.go(`#/results/${id}`);
    await page.locator(".verdict .notice").waitFor();
    assert.ok((await page.getByRole("row").count()) > 1, "trials are listed");
    if (at === 0) {
      await page.frameLocator("iframe.report").locator("h1").first().waitFor();
      await e.examine("result");
    }
  }
  await e.go(`#/results/${sessions[0]}`);
  const frame = page.frameLocator("iframe.report");
  await frame.locator("h1").first().waitFor();
  const report = await e.newPage();
  await report.goto(new URL(await page.locator("iframe.report").getAttribute("src"), e.base).href);
  for (const [name, one] of [
    ["result", page],
    ["report", report],
  ]) {
    const printed = await one.pdf({ format: "A4" });
    assert.equal(printed.subarray(0, 5).toString(), "%PDF-");
    assert.ok(printed.length > 10_000, `${name}: ${printed.length} bytes`);
    t.diagnostic(`${name} as PDF: ${(printed.length / 1024).toFixed(0)} kB`);
    if (e.shots) fs.writeFileSync(path.join(e.shots, `${name}.pdf`), printed);
  }
  await report.close();
});

test(
  "the trial is rated on the tablet, and the verdict is read",
  { skip, timeout: 300_000 },
  async (t) => {
    await page.setViewportSize(kTablet);
    await e.go(`#/results/${sessions[0]}`);
    const card = page.locator(".rating");
    await card.waitFor();
    await card.getByLabel("Rater").fill("R1");
    await page.keyboard.press("Tab");
    await card.locator("fieldset.marks").first().waitFor();
    let clicks = 0;
    const press = async (label) => {
      await label.click();
      ++clicks;
    };
    for (const group of await card.locator("fieldset.marks").all()) {
      const done = group.locator("label", { hasText: /^done$/ });
      await press((await done.count()) ? done : group.locator("label", { hasText: /^5$/ }));
    }
    await card.getByText("13 of 13 marks, kept").waitFor();
    await press(card.getByRole("button", { name: "Verdict" }));
    const verdict = page.frameLocator(".rating iframe.report");
    await verdict.getByText(/^(Pass|Fail) \(simulated\)$/).waitFor({ timeout: 120_000 });
    assert.equal(await verdict.getByText("No global rating was given").count(), 0);
    await e.picture("verdict");
    const passed = await verdict.getByText("Pass (simulated)").count();
    await press(card.getByRole("button", { name: "Certificate" }));
    const told = card.locator(".notice").last();
    await told.filter({ hasText: passed ? "The certificate is made" : "was not passed" }).waitFor({
      timeout: 60_000,
    });
    t.diagnostic(`clicks from the result to the certificate: ${clicks}`);
    assert.ok(clicks <= 18, `${clicks} clicks`);
    await e.go("#/station");
    await e.go(`#/results/${sessions[0]}`);
    await page.locator(".rating").getByText("13 of 13 marks, kept").waitFor();
    await page.locator(".rating").getByLabel("Rater").fill("R2"); // has a sheet of his own
    await page.keyboard.press("Tab");
    await page.locator(".rating").getByText("0 of 13 marks").waitFor();
    await e.examine("rated");
    await page.setViewportSize(kDesktop);
  },
);

test(
  "by keyboard alone: from the first page to a running session, stopped and ended",
  { skip, timeout: 300_000 },
  async (t) => {
    const own = await e.newPage(),
      hand = new Keyboard(own),
      focused = () =>
        own.evaluate(() => document.activeElement.id || document.activeElement.tagName);
    const came = performance.now();
    await own.goto(e.base);
    await own.locator("#start-session").waitFor();
    await own.keyboard.press("Tab");
    assert.equal(await focused(), "skip", "the first stop skips the navigation");
    await own.keyboard.press("Enter");
    assert.equal(await focused(), "H1");
    await hand.press(own.locator("#start-session"));
    await own.locator("#begin").waitFor();
    assert.equal(await focused(), "H1", "the focus is on the new page's heading");
    await hand.press(own.locator("#begin"));
    await own.waitForURL(/#\/session\/.+/);
    let presses = 2;
    // A simulated hand begins by itself; a person's trial waits, and the station says so.
    const line = own.locator(".live-state", {
      hasText: /Trial is running|Enter (to start|starts)/,
    });
    await line.waitFor({ timeout: 90_000 });
    if (/Enter/.test(await line.textContent())) {
      await hand.press(own.locator("#live-go"));
      ++presses;
    }
    await own.locator(".live-state", { hasText: "Trial is running" }).waitFor();
    const took_s = ((performance.now() - came) / 1000).toFixed(1);
    t.diagnostic(`choices from the first page to the first trial: ${presses}, ${took_s} s`);
    assert.ok(presses <= 4);
    const alarm = own.locator(".alarm .notice", { hasText: "Re-arm when hands are clear" });
    await own.keyboard.press("Control+.");
    await alarm.waitFor();
    await e.picture("stopped", own);
    await hand.press(own.getByRole("button", { name: "Re-arm" }));
    await alarm.waitFor({ state: "detached" });
    await own.locator("main h1").focus();
    await hand.press(own.getByRole("button", { name: "End the session…" }));
    const dialog = own.getByRole("dialog");
    await hand.press(dialog.getByRole("button", { name: "End the session" }));
    await own.getByRole("link", { name: "Read the result" }).waitFor();
    await own.close();
  },
);

/** A note stands where it was heard of: the order may differ. */
const told = async (where) => (await where.locator(".events .event").allTextContents()).sort();

/**
 * Somebody closes the browser, loads the page again, has no network for a while, looks on from a
 * second browser; and the console is killed and started again.
 */
test(
  "whatever happens to browser and console, the trials go on and the page catches up",
  {
    skip:
      skip || (begin ? false : "PALPA_CONSOLE_BEGIN is not set: this console may not be killed"),
    timeout: 3 * kWhole,
  },
  async (t) => {
    const full = !!process.env.PALPA_FULL;
    const id = await startAssessed(trainees[0], full ? 8 : 3);
    const other = await Educator.come(url);
    try {
      await other.go(`#/session/${id}`);
      await other.page.waitForFunction(
        () => Number(document.querySelector(".curves")?.dataset.points) > 5,
      );
      await page.reload();
      await page.waitForFunction(() => document.querySelectorAll(".events .event").length > 2);
      await e.cut();
      await page.waitForTimeout(full ? 60_000 : 5000);
      await e.context.setOffline(false);
      await page.locator("#lost").waitFor({ state: "hidden", timeout: 60_000 });
      other.away = true;
      execFileSync("bash", [begin, "--port", new URL(url).port]);
      await page.locator("main h1").focus();
      await page.waitForFunction(() => document.querySelector("#lost").hidden, null, {
        timeout: 60_000,
      });
      await page.keyboard.press("m");
      await page.keyboard.type("the console was away");
      // Refused at first: the page's key is of the console before.
      await page.keyboard.press("Enter");
      await page.locator(".event.note", { hasText: "the console was away" }).waitFor();
      e.away = other.away = false;
      await other.page.locator(".event.note", { hasText: "the console was away" }).waitFor();
      await over().waitFor({ timeout: 2 * kWhole });
      await other.page.getByRole("link", { name: "Read the result" }).waitFor();
      const mine = await told(page),
        theirs = await told(other.page);
      t.diagnostic(`events told to both browsers: ${mine.length}`);
      assert.deepEqual(mine, theirs);
      assert.equal(
        mine.filter((text) => /^\S* ?.*Trial \d+ starts$/.test(text)).length,
        full ? 8 : 3,
        mine.join(" | "),
      );
      e.complaints.push(...other.complaints);
    } finally {
      await other.leave();
    }
    await e.go(`#/results/${id}`);
    await page.locator(".verdict .notice").waitFor();
    assert.equal(
      await page.getByRole("row", { name: /^Trial \d+ assessed/ }).count(),
      full ? 8 : 3,
      "every trial is kept",
    );
  },
);

test("the replay is scrubbed, an expert beside", { skip, timeout: 500_000 }, async () => {
  await e.go(`#/replay/${sessions[0]}/1`);
  const time = page.locator(".player-time"),
    img = page.locator(".view-box img").first();
  await page.waitForFunction(
    () => document.querySelector(".view-box img")?.naturalWidth > 0,
    null,
    { timeout: 400_000 },
  );
  // The first pictures come while the rest is drawn: now all of them are wanted.
  await page.waitForFunction(
    () => !document.querySelector("figcaption").textContent.includes("Drawn so far"),
    null,
    { timeout: 400_000 },
  );
  // Where the needle is, from three sides; it follows the time.
  const way = page.locator(".track .tip-path").nth(1);
  await page.locator(".track svg").nth(2).waitFor();
  const wayBefore = await way.getAttribute("d");
  const before = await img.getAttribute("src");
  await page.getByRole("slider").fill("6");
  assert.match(await time.textContent(), /^0:06\.0/);
  await page.waitForFunction(
    (s) => document.querySelector(".view-box img").getAttribute("src") !== s,
    before,
  );
  assert.notEqual(await way.getAttribute("d"), wayBefore);
  await page.getByRole("slider").focus();
  await page.keyboard.press("ArrowRight");
  assert.doesNotMatch(await time.textContent(), /^0:06\.0/);
  const box = await page.locator(".timeline-box .timeline").boundingBox();
  await page.locator(".timeline-box .timeline").click({ position: { x: 64, y: box.height / 2 } });
  assert.match(await time.textContent(), /^0:00\.0/);
  await page.locator("#play").click();
  await page.waitForFunction(
    () => !document.querySelector(".player-time").textContent.startsWith("0:00"),
  );
  await page.locator("#play").click();
  await page.getByLabel("Another trial").selectOption({ index: 1 });
  await page.locator(".curve.second[d^=M]").first().waitFor({ state: "attached" });
  await page.waitForFunction(
    () => document.querySelectorAll(".view-box img")[1]?.naturalWidth > 0,
    null,
    { timeout: 200_000 },
  );
  await page.getByText("Data as a table").click();
  await page.getByRole("row").nth(3).waitFor();
  await e.examine("replay");
});

test("the other pages, too", { skip, timeout: 200_000 }, async () => {
  for (const [name, hash, wanted] of [
    ["results", "#/results", "table"],
    ["trainee", `#/trainees/${trainees[0]}`, "iframe"],
    ["cohort", "#/cohort", "iframe"],
    ["studies", "#/studies", "main .card, main .notice"],
  ]) {
    await e.go(hash);
    await page.locator(wanted).first().waitFor({ timeout: 120_000 });
    await e.examine(name);
  }
});

test(
  "nothing serious was found on any page, and the browser had nothing to complain of",
  { skip },
  () => {
    assert.deepEqual(e.faults, []);
    assert.deepEqual(e.complaints, []);
  },
);
