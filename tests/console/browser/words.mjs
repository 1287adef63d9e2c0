// What a page in a language that nobody speaks shows of words without a message, or without room.
/** In the page: texts without marks, and texts that are cut or stand beyond the screen. */
export function whatIsWrong() {
  const shown = (x) => x.checkVisibility({ visibilityProperty: true });
  // What people, computers and standards are called, and days as the browser writes them.
  const names = new RegExp(
    [
      "learner-7|year-3|W[0-9A-Z]{5,}-\\d|T\\d{3}|WEEK-7|virtual-bench|Palpa|palpa",
      "SCHED_FIFO|BMI|UTC|UTF-8",
      "\\(?LLVM[^)]*\\)|llvmpipe|OpenGL|EGL|SHA-256|xAPI|CSV|PIN|GB|MB",
      "\\d+ [A-Z][a-z]{2} \\d{4}|\\S*[/._\\\\]\\S*[A-Za-z]\\S*",
    ].join("|"),
    "g",
  );
  const plain = (text) => /[A-Za-z]{2,}/.test(text.replace(names, ""));
  const unmarked = new Set(),
    cut = new Set();
  const walk = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  for (let node = walk.nextNode(); node; node = walk.nextNode()) {
    const x = node.parentElement;
    const text = node.textContent.trim();
    if (!text || !shown(x) || x.closest("script, style, noscript, option")) continue;
    if (plain(text) && !x.closest("[translate=no]")) unmarked.add(text.slice(0, 160));
    if (x.closest(".unseen, thead")) continue; // heard, not seen; or not on a narrow screen
    const range = document.createRange();
    range.selectNodeContents(node);
    const box = range.getBoundingClientRect();
    if (box.width === 0) continue;
    const svg = x.closest("svg");
    for (let up = x; up && up !== document.body; up = up.parentElement) {
      const style = getComputedStyle(up);
      const frame = up.getBoundingClientRect();
      if (/auto|scroll/.test(style.overflowX)) break;
      const clips = style.overflowX !== "visible" || up === svg;
      if (
        clips &&
        frame.width > 1 &&
        (box.right > frame.right + 1.5 || box.left < frame.left - 1.5)
      )
        cut.add(`${text.slice(0, 50)} (${up.tagName.toLowerCase()})`);
      if (up.parentElement === document.body || up === document.body) break;
    }
  }
  for (const name of ["title", "aria-label", "placeholder", "alt"])
    for (const x of document.querySelectorAll(`[${name}]`))
      if (plain(x.getAttribute(name)) && !x.closest("[translate=no]"))
        unmarked.add(`${name}: ${x.getAttribute(name).slice(0, 70)}`);
  const wide = document.documentElement.scrollWidth - window.innerWidth;
  return { unmarked: [...unmarked], cut: [...cut], wide };
}
