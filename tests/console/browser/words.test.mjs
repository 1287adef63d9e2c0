// The pages in a language that nobody speaks, a third longer, with a mark on every letter, written
// from the left and from the right: what bears no mark has no message, what is cut has no room.
// PALPA_CONSOLE_URL: a console that has just begun, on an empty bench.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { Educator } from "./educator.mjs";
import { whatIsWrong } from "./words.mjs";

const url = process.env.PALPA_CONSOLE_URL;
const skip = url ? false : "PALPA_CONSOLE_URL is not set: start a console and give its address";
const kLooks = [
  ["qps", 390],
  ["qps-rtl", 1280],
];
if (process.env.PALPA_FULL === "1") kLooks.push(["qps", 1280], ["qps-rtl", 390]);
const kWho = "learner-7";
let e, page, session;

const api = async (path) => (await fetch(url + path)).json();

before(async () => {
  if (skip) return;
  e = await Educator.come(url, process.env.PALPA_CONSOLE_SHOTS);
  page = e.page;
  await e.go("#/trainees");
  session = await page.evaluate(async (who) => {
    const { post } = await import("/static/api.js");
    await post("/api/trainees", { id: who, group: "year-3", hand: "right" });
    const wish = { task: "paracentesis", operator: "expert", trainee: who };
    return (await post("/api/sessions", wish)).id;
  }, kWho);
});
after(async () => {
  await e?.leave();
});

/** All that stands on a page, opened. */
async function lookThrough(where) {
  await page.waitForTimeout(400);
  for (const more of await page.locator("summary").all())
    await more.click({ timeout: 500 }).catch(() => {});
  const found = await page.evaluate(whatIsWrong);
  await page.screenshot({
    path: `${process.env.PALPA_CONSOLE_SHOTS}/${where.replace(/\W+/g, "-")}.png`,
    fullPage: true,
  });
  return [
    ...found.unmarked.map((text) => `${where}: without a mark: ${text}`),
    ...found.cut.map((text) => `${where}: cut: ${text}`),
    ...(found.wide > 0 ? [`${where}: ${found.wide} px wider than the screen`] : []),
  ];
}

const look = ([language, width]) =>
  Promise.all([
    e.context.addCookies([{ name: "palpa-language", value: language, url }]),
    page.setViewportSize({ width, height: 844 }),
  ]);
async function open(address) {
  await page.goto(`${url}#/${address}`);
  await page.reload();
  await page.locator("main .page h1").waitFor();
}

test("while a session runs", { skip }, async () => {
  const wrong = [];
  for (const one of kLooks) {
    await look(one);
    await open(`session/${session}`);
    wrong.push(...(await lookThrough(`${one.join(" ")} live`)));
  }
  assert.deepEqual(wrong, []);
});

test("every page has room for every word, and each word has a message", { skip }, async () => {
  for (let i = 0; i < 600; ++i) {
    if ((await api(`api/sessions/${session}`)).state === "finished") break;
    await page.waitForTimeout(200);
  }
  const pages = [
    ...["station", "calibrate", "trainees", `trainees/${kWho}`, "session", "results"],
    ...[`results/${session}`, "cohort", `replay/${session}/1`, "studies", "mine", "room"],
  ];
  const wrong = new Set();
  for (const one of kLooks) {
    await look(one);
    for (const address of pages) {
      await open(address);
      const where = `${one.join(" ")} ${address.replace(session, "ID")}`;
      for (const text of await lookThrough(where)) wrong.add(text);
    }
    await page.goto(`${url}api/sessions/${session}/file/report.html`);
    for (const text of await lookThrough(`${one.join(" ")} report`)) wrong.add(text);
  }
  assert.deepEqual([...wrong], []);
});
