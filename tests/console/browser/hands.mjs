// The educator's hands: by mouse (or finger), or by keyboard alone. Both do the same things.
import assert from "node:assert/strict";

const kMostTabs = 150;

export class Mouse {
  constructor(page) {
    this.page = page;
  }
  press(what) {
    return what.click();
  }
  /** A radio button or a box. */
  check(what) {
    return what.check();
  }
  choose(select, value) {
    return select.selectOption(value);
  }
  write(into, text) {
    return into.fill(text);
  }
}

export class Keyboard {
  constructor(page) {
    this.page = page;
  }

  /** Tab by Tab, as somebody without a mouse; what has the focus must be seen to have it. */
  async reach(what) {
    await what.first().waitFor();
    const mark = `k${Math.random().toString(36).slice(2)}`;
    await what.first().evaluate((x, m) => x.setAttribute("data-wanted", m), mark);
    for (let n = 0; n < kMostTabs; ++n) {
      const at = await this.page.evaluate((m) => {
        const e = document.activeElement,
          style = getComputedStyle(e),
          group = e.type === "radio" && document.querySelector(`[data-wanted="${m}"]`)?.name;
        return {
          there: e.dataset.wanted === m,
          beside: !!group && group === e.name,
          seen: style.outlineStyle !== "none" && parseFloat(style.outlineWidth) > 0,
          what: `${e.tagName} ${e.textContent.slice(0, 40)}`,
        };
      }, mark);
      if (at.there || at.beside) {
        assert.ok(at.seen, `the focus can be seen on ${at.what}`);
        return at.there;
      }
      await this.page.keyboard.press("Tab");
    }
    return assert.fail(`cannot be reached by Tab: ${what}`);
  }

  async press(what) {
    await this.reach(what);
    await this.page.keyboard.press("Enter");
  }

  /** Arrows lead through radio buttons; the space bar ticks a box. */
  async check(what) {
    await this.reach(what);
    if (await what.isChecked()) return;
    if ((await what.getAttribute("type")) === "checkbox") {
      await this.page.keyboard.press("Space");
      return;
    }
    for (let n = 0; n < 20 && !(await what.isChecked()); ++n)
      await this.page.keyboard.press("ArrowDown");
    assert.ok(await what.isChecked(), "the arrows lead to every choice");
  }

  async choose(select, value) {
    await this.reach(select);
    await this.page.keyboard.press("Home");
    for (let n = 0; n < 60 && (await select.inputValue()) !== value; ++n)
      await this.page.keyboard.press("ArrowDown");
    assert.equal(await select.inputValue(), value);
  }

  async write(into, text) {
    await this.reach(into);
    await this.page.keyboard.press("Control+a");
    await this.page.keyboard.type(text);
  }
}
