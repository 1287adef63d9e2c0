#include "tests/browser/page_faults.h"

namespace palpa::test {
namespace {

// Within the page; answers with a list of sentences. Contrast after WCAG 2.1 (relative luminance),
// 3:1 at least: large type's bound, since axis labels are gray on purpose.
constexpr char kLook[] = R"js(
const faults = [];
for (const folded of document.querySelectorAll('details')) folded.open = true;
const wide = document.documentElement.scrollWidth, room = document.documentElement.clientWidth;
if (wide > room + 1) {
  let worst = null;
  for (const e of document.body.querySelectorAll('*')) {
    const r = e.getBoundingClientRect();
    if (r.width > 0 && r.right > room + 1 && !e.closest('[data-scrolls]') && (!worst || e.contains(worst) === false)) worst = worst || e;
  }
  faults.push('wider than the screen: ' + wide + ' px of ' + room + (worst ? ', ' + worst.tagName + ' ' + (worst.className.baseVal ?? worst.className) : ''));
}
const shown = e => { const r = e.getBoundingClientRect(); return r.width > 0.5 && r.height > 0.5 && getComputedStyle(e).visibility !== 'hidden' && (!e.checkVisibility || e.checkVisibility()); };
const words = e => e.textContent.trim().replace(/\s+/g, ' ').slice(0, 40);
const luminance = c => { const [r, g, b] = c.map(v => { v /= 255; return v <= 0.03928 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4; }); return 0.2126 * r + 0.7152 * g + 0.0722 * b; };
const colour = s => { const m = (s.match(/[\d.]+/g) || [0, 0, 0, 0]).map(Number); return s.startsWith('color(') ? m.map((v, i) => i < 3 ? 255 * v : v) : m; };
const behind = e => { for (let p = e; p; p = p.parentElement) { const c = colour(getComputedStyle(p).backgroundColor); if (c.length < 4 || c[3] > 0.5) return c.slice(0, 3); } return [255, 255, 255]; };
const contrast = (a, b) => { const x = luminance(a), y = luminance(b); return (Math.max(x, y) + 0.05) / (Math.min(x, y) + 0.05); };
const texts = [...document.body.querySelectorAll('*')].filter(e => [...e.childNodes].some(n => n.nodeType === 3 && n.textContent.trim()) && !['STYLE', 'SCRIPT', 'TITLE'].includes(e.tagName.toUpperCase()) && shown(e));
for (const e of texts) {
  const svg = e.closest('svg'), style = getComputedStyle(e);
  const scale = svg && svg.viewBox.baseVal && svg.viewBox.baseVal.width ? svg.getBoundingClientRect().width / svg.viewBox.baseVal.width : 1;
  if (parseFloat(style.fontSize) * scale < 8.95) faults.push('type of ' + (parseFloat(style.fontSize) * scale).toFixed(1) + ' px: ' + words(e));
  if (!svg && contrast(colour(style.color).slice(0, 3), behind(e)) < 3) faults.push('hardly legible: ' + words(e));
}
for (const svg of document.querySelectorAll('svg')) {
  if (!shown(svg)) continue;
  const box = svg.getBoundingClientRect(), marks = [...svg.querySelectorAll('text')].filter(shown).map(e => [e, e.getBoundingClientRect()]);
  marks.forEach(([e, r], i) => {
    if (r.left < box.left - 1 || r.right > box.right + 1 || r.top < box.top - 1 || r.bottom > box.bottom + 1) faults.push('runs out of its drawing: ' + words(e));
    for (const [f, s] of marks.slice(i + 1)) {
      const across = Math.min(r.right, s.right) - Math.max(r.left, s.left), down = Math.min(r.bottom, s.bottom) - Math.max(r.top, s.top);
      if (across > 2 && down > 3) faults.push('run into each other: "' + words(e) + '" and "' + words(f) + '"');
    }
  });
}
return faults.slice(0, 20);
)js";

struct Look {
  int width;
  const char *scheme, *media;
};
constexpr Look kLooks[] = {{1100, "light", "screen"},
                           {800, "light", "screen"},
                           {400, "light", "screen"},
                           {1100, "dark", "screen"},
                           {794, "light", "print"}};

}  // namespace

std::vector<std::string> faultsOf(Browser& browser, const std::filesystem::path& page) {
  std::vector<std::string> all;
  for (const Look& look : kLooks) {
    const std::string name =
        std::to_string(look.width) + (look.media == std::string("print")   ? "-print"
                                      : look.scheme == std::string("dark") ? "-dark"
                                                                           : "");
    browser.show(look.width, look.scheme, look.media);
    browser.open(page);
    for (const auto& fault : browser.run(kLook))
      all.push_back(page.filename().string() + " at " + name + ": " + fault.get<std::string>());
    browser.screenshot(page.parent_path() / (page.stem().string() + "-" + name + ".png"));
  }
  if (const std::string said = browser.complaints(); !said.empty())
    all.push_back(page.filename().string() + ": " + said);
  return all;
}

}  // namespace palpa::test
