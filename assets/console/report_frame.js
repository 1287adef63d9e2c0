// A report made by the station: asked for, waited for, shown in a frame that may run nothing,
// opened apart, printed.
import { get } from "./api.js";
import { announce, h, put } from "./dom.js";
import { notice } from "./parts.js";

/** Only addresses of this station's own pages go into a frame. */
const ownPage = (path) =>
  typeof path === "string" && /^\/api\/[\w\-./%]+$/.test(path) && !path.includes("..") ? path : "";

export function reportFrame(path, title) {
  const page = ownPage(path);
  if (!page) return notice("note", "There is no report to show.");
  const frame = h("iframe", {
    class: "report",
    src: page,
    title,
    sandbox: "allow-same-origin allow-modals",
    loading: "eager",
  });
  const said = h("div", { class: "said", role: "status" });
  const print = () => {
    try {
      frame.contentWindow.print();
    } catch {
      window.open(page, "_blank", "noopener");
      put(
        said,
        h(
          "p",
          { class: "hint" },
          "The report is open in a tab of its own. Print it there (Ctrl+P).",
        ),
      );
    }
  };
  frame.addEventListener("load", () => {
    try {
      const whole = frame.contentDocument.documentElement.scrollHeight + 8;
      frame.style.height = `${Math.min(20000, whole)}px`;
    } catch {
      /* of another origin: it scrolls by itself */
    }
  });
  return h(
    "div",
    { class: "report-box" },
    h(
      "div",
      { class: "row no-print" },
      h("button", { type: "button", onclick: print }, "Print the report"),
      h(
        "a",
        { class: "button", href: page, target: "_blank", rel: "noopener" },
        "Open in a tab of its own",
      ),
    ),
    said,
    frame,
    h(
      "p",
      { class: "only-print" },
      `The report is printed separately: "Print the report" on its page of the console.`,
    ),
  );
}

/** Polls `path` ({state, page, message}) and shows what comes of it in `place`. */
export async function awaitReport(life, path, place, title) {
  put(
    place,
    notice("work", "The report is being made…"),
    h("progress", { "aria-label": "The report is being made" }),
  );
  await life.every(1000, async () => {
    const answer = await get(path).catch((error) => {
      if (error.offline) throw error;
      return { state: "failed", message: error.message };
    });
    if (answer.state === "done") {
      put(place, reportFrame(answer.page, title));
      announce("The report is ready.");
      return false;
    }
    if (answer.state === "failed") {
      put(place, notice("bad", answer.message || "The report could not be made."));
      return false;
    }
    return true;
  });
}
