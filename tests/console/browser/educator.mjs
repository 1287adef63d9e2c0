// The educator's browser: Debian's Chromium, what it complains of, what
// axe finds, pictures of pages.
import assert from "node:assert/strict";
import fs from "node:fs";
import { createRequire } from "node:module";
import path from "node:path";
import { chromium } from "playwright-core";
import { Phrasebook } from "./language.js";
import { whatIsWrong } from "./words.mjs";

const kArguments = [
  "--no-sandbox",
  "--headless",
  "--disable-gpu",
  "--disable-quic",
  "--no-first-run",
  "--disable-background-networking",
  "--disable-component-update",
  "--disable-sync",
];
const kAxe = fs.readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");
const kHighest = 6000; // px
/** What no page for educators shows. */
const kNoWords = [
  ["a brace", /[{}]/],
  ["a name for programs", /\w_\w/],
  ["an option of a command", /(^|\s)--\w/],
  ["a path", /(^|\s)\.?\/\w[\w.-]*\//],
  ["a session's number", /\d{8}-\d{6}-[0-9a-f]{8}/],
];
export const kDesktop = { width: 1366, height: 900 },
  kTablet = { width: 820, height: 1180 };

/** Letters of a pattern, as the page says them: /^Agrees now.*A-7/ in Greek. */
function patternIn(said, pattern) {
  const source = pattern.source.replace(/[A-Za-z][A-Za-z0-9 ']*[A-Za-z0-9]/g, (words) =>
    said(words).replace(/[.*+?^${}()|[\]\\]/g, "\\$&"),
  );
  return new RegExp(source, pattern.flags);
}
const kFinders = /^(getBy|locator$|filter$|first$|last$|nth$|or$|frameLocator$)/;

/**
 * A page, or a part of it, in which one looks for English words: what is found are those that stand
 * there in the page's language.
 */
function inWords(found, said) {
  const spoken = (word) =>
    word instanceof RegExp ? patternIn(said, word) : typeof word === "string" ? said(word) : word;
  return new Proxy(found, {
    get(target, name) {
      const method = target[name];
      if (name === "untold") return target;
      if (typeof method !== "function" || !kFinders.test(name)) {
        return typeof method === "function" ? method.bind(target) : method;
      }
      return (first, options = {}, ...rest) => {
        const looks = { ...options };
        for (const key of ["name", "hasText"]) if (key in looks) looks[key] = spoken(looks[key]);
        if (looks.has) looks.has = looks.has.untold ?? looks.has;
        const what = /^getBy(Text|Label|Placeholder|Title)/.test(name) ? spoken(first) : first;
        const whole = name === "filter" ? { ...what, hasText: spoken(what.hasText) } : what;
        const part = method.call(target, whole?.untold ?? whole, looks, ...rest);
        return inWords(part, said);
      };
    },
  });
}

export class Educator {
  /** In the language PALPA_WEEK_LANGUAGE; English without. */
  static async come(base, shots, token) {
    const e = new Educator();
    Object.assign(e, {
      base: base.replace(/#.*$/, "").replace(/\/?$/, "/"),
      shots,
      complaints: [],
      faults: [],
      away: false,
    });
    if (shots) fs.mkdirSync(shots, { recursive: true });
    e.browser = await chromium.launch({
      executablePath: process.env.PALPA_CHROMIUM || "/usr/bin/chromium",
      args: kArguments,
    });
    e.context = await e.newContext({ viewport: kDesktop, locale: "en-GB" });
    await e.context.addInitScript(() => {
      const Native = window.EventSource;
      window.streams = [];
      window.EventSource = class extends Native {
        constructor(...given) {
          super(...given);
          window.streams.push(this);
        }
      };
    });
    e.page = await e.newPage();
    await e.speak(process.env.PALPA_WEEK_LANGUAGE || "en");
    if (token) await e.enter(token);
    return e;
  }

  /** What is looked for by its English words is found as that language says them. */
  async speak(code) {
    this.said = (english) => english;
    this.language = code;
    if (code === "en") return;
    await this.context.addCookies([{ name: "palpa-language", value: code, url: this.base }]);
    const answer = await this.context.request.get(`${this.base}static/language-${code}.json`);
    const book = new Phrasebook(await answer.json());
    this.said = (english) => book.said(english);
    this.page = inWords(this.page, this.said);
  }

  /** The console vouches for itself: a tablet would warn once. */
  newContext(looks) {
    return this.browser.newContext({ ignoreHTTPSErrors: true, ...looks });
  }

  /** With the token, where the console asks for one. */
  async enter(token) {
    await this.go("#/enter");
    await this.page.getByLabel("Token").fill(token);
    await this.page.getByRole("button", { name: "Enter the console" }).click();
    await this.page.waitForURL(/#\/station/);
  }

  async newPage(context = this.context) {
    const page = await context.newPage();
    page.setDefaultTimeout(60_000);
    page.on("console", (m) => {
      if (["error", "warning"].includes(m.type()) && !this.away)
        this.complaints.push(`${page.url()}: ${m.text()}`);
    });
    page.on("pageerror", (x) => this.complaints.push(`${page.url()}: ${x.stack}`));
    page.on("dialog", (d) => {
      this.complaints.push(`a dialog: ${d.message()}`);
      d.dismiss();
    });
    return page;
  }

  /**
   * No network, streams included: those that are open survive the browser's being offline, so they
   * are ended as a lost one ends.
   */
  async cut() {
    this.away = true;
    await this.context.setOffline(true);
    await this.page.evaluate(() => {
      for (const stream of window.streams) {
        stream.close();
        stream.dispatchEvent(new Event("error"));
      }
    });
  }

  leave() {
    return this.browser.close();
  }

  /** The page asked for stands, not the one before it, whose heading would do as well. */
  async go(hash, page = this.page) {
    if (!page.url().startsWith(this.base)) await page.goto(this.base + hash);
    // In one step: the page may be on its way there by itself.
    await page.evaluate((wanted) => {
      if (location.hash === wanted) return;
      for (const old of document.querySelectorAll("main .page")) old.dataset.left = "yes";
      location.hash = wanted;
    }, hash);
    await page.locator("main .page:not([data-left]) h1").waitFor();
  }

  /**
   * The whole page on a screen as high as it: a browser does not draw a frame that is out of
   * sight.
   */
  async picture(name, page = this.page) {
    if (!this.shots) return;
    const before = page.viewportSize();
    await page.setViewportSize({
      width: before.width,
      height: Math.max(
        before.height,
        Math.min(kHighest, await page.evaluate(() => document.documentElement.scrollHeight)),
      ),
    });
    await page.waitForTimeout(200);
    await page.screenshot({ path: path.join(this.shots, `${name}.png`) });
    await page.setViewportSize(before);
  }

  /**
   * Pictures and axe at both widths; serious and critical findings are kept for the end. Nothing
   * may be wider than the screen, no type smaller than 14 px.
   */
  async examine(name, page = this.page) {
    for (const [width, size] of [
      ["desktop", kDesktop],
      ["tablet", kTablet],
    ]) {
      await page.setViewportSize(size);
      await page.waitForTimeout(300);
      for (const frame of page.frames()) await frame.waitForLoadState("load");
      await this.picture(`${name}-${width}`, page);
      await page.evaluate(kAxe);
      const found = await page.evaluate(async () =>
        (await window.axe.run(document, { iframes: false })).violations.map((v) => ({
          id: v.id,
          impact: v.impact,
          where: v.nodes.slice(0, 3).map((n) => `${n.target}: ${n.any[0]?.message || ""}`),
        })),
      );
      for (const v of found.filter((one) => ["serious", "critical"].includes(one.impact)))
        this.faults.push(`${name}, ${width}: ${v.impact} ${v.id} ${v.where.join(" | ")}`);
      const wide = await page.evaluate(
        () => document.documentElement.scrollWidth - window.innerWidth,
      );
      if (wide > 0) this.faults.push(`${name}, ${width}: ${wide} px wider than the screen`);
      const small = await page.evaluate(() =>
        [...document.querySelectorAll("body *")]
          .filter(
            (x) =>
              [...x.childNodes].some((n) => n.nodeType === 3 && n.textContent.trim()) &&
              x.getClientRects().length > 0 &&
              // In a drawing the size is in its units.
              parseFloat(getComputedStyle(x).fontSize) * (x.getScreenCTM?.()?.a ?? 1) < 13.9,
          )
          .map((x) => x.textContent.slice(0, 30)),
      );
      if (small.length > 0)
        this.faults.push(`${name}, ${width}: smaller than 14 px: ${small.slice(0, 3).join(", ")}`);
    }
    await page.setViewportSize(kDesktop);
  }

  /**
   * One page at the size at which it is used: a picture, axe, its words, and whether it leads
   * anywhere. What is found is kept for the end.
   */
  async look(name, page = this.page) {
    await page.waitForTimeout(200);
    await this.picture(name.replace(/[^\w]+/g, "-"), page);
    if (page === this.page) await page.setViewportSize(this.size);
    await page.evaluate(kAxe);
    const found = await page.evaluate(async () => {
      const main = document.querySelector("dialog[open]") || document.querySelector("main");
      const ways = [...main.querySelectorAll("a[href], button, iframe, input")].filter(
        (x) => x.getClientRects().length > 0 && !/^Back/.test(x.textContent),
      );
      return {
        axe: (await window.axe.run(document, { iframes: false })).violations.map(
          (v) => `${v.id} at ${v.nodes.slice(0, 3).map((n) => n.target)}`,
        ),
        words: document.body.innerText.split("\n"),
        ways: ways.length,
        wide: document.documentElement.scrollWidth - window.innerWidth,
      };
    });
    const tell = (what) => this.faults.push(`${name}: ${what}`);
    if (this.language.startsWith("qps") && page === this.page) {
      const { unmarked, cut } = await page.evaluate(whatIsWrong);
      for (const text of unmarked) tell(`without a mark: ${text}`);
      for (const text of cut) tell(`cut: ${text}`);
    }
    for (const one of found.axe)
      // A language that nobody speaks is none that axe knows.
      if (!(this.language.startsWith("qps") && one.startsWith("html-lang-valid"))) tell(one);
    if (found.ways === 0) tell("leads nowhere but back");
    if (found.wide > 0) tell(`${found.wide} px wider than the screen`);
    for (const line of found.words)
      for (const [kind, pattern] of kNoWords) if (pattern.test(line)) tell(`${kind}: ${line}`);
  }

  /** Pictures a second in the stream that the live page shows, counted for `seconds`. */
  picturesPerSecond(id, seconds, page = this.page) {
    return page.evaluate(
      async ([session, span]) => {
        const stop = new AbortController();
        const answer = await fetch(`/api/sessions/${session}/view`, { signal: stop.signal });
        const reader = answer.body.getReader();
        let count = 0,
          begun = 0,
          before = 0;
        const end = () => performance.now() - begun > span * 1000;
        while (!begun || !end()) {
          const { value, done } = await reader.read();
          if (done) break;
          for (const byte of value) {
            if (before === 0xff && byte === 0xd8) {
              if (!begun) begun = performance.now();
              else ++count;
            } // a JPEG begins; 0xff in its data is followed by 0
            before = byte;
          }
        }
        const took = (performance.now() - begun) / 1000;
        stop.abort();
        return count / took;
      },
      [id, seconds],
    );
  }
}
