// Where the needle is, in three pictures beside the film: from in front, in section, and what it
// is aimed at. They follow the time of the replay.
import { get, url } from "./api.js";
import { h, svg } from "./dom.js";
import { said } from "./language.js";
import { firstFrom } from "./scale.js";

const kTail_s = 4; // of the tip's way, drawn behind it

const d = (points, closed) =>
  points.length ? `M${points.map(([x, y]) => `${x} ${-y}`).join("L")}${closed ? "Z" : ""}` : "";

/** In letters as large in the wide picture as in the square ones; whole, in any language. */
function namesIn(view, width) {
  const font = width / (view.kind === "way" ? 25 : 17);
  const [left] = view.low,
    [right] = view.high;
  return view.names.map(({ organ, at: [x, y] }) => {
    const name = said(organ);
    const half = 0.3 * font * name.length;
    const held = Math.min(Math.max(x, left + half), right - half);
    return svg("text", { class: "organ-name", x: held, y: 1 - y, "font-size": font }, name);
  });
}

const cross = ([x, y]) =>
  svg("path", { class: "taught", d: `M${x - 1.5} ${-y}h3M${x} ${-y - 1.5}v3` });

function taughtIn(view) {
  if (view.kind === "way")
    return svg("path", { class: "taught dashed", d: d([view.entry, view.target]) });
  if (view.kind === "vein") return cross(view.target);
  const [cx, cy] = view.entry;
  return [
    view.experts_mm > 0
      ? svg("circle", { class: "experts", cx, cy: -cy, r: view.experts_mm })
      : null,
    cross(view.entry),
    view.passes.map(([x, y]) => svg("circle", { class: "pass", cx: x, cy: -y, r: 0.9 })),
  ];
}

function picture(view) {
  const [left, bottom] = view.low,
    [right, top] = view.high,
    width = right - left,
    height = top - bottom;
  const tail = svg("path", { class: "tip-path" }),
    needle = svg("path", { class: "needle" }),
    tip = svg("circle", { class: "tip", r: 1.1 });
  const node = h(
    "figure",
    {},
    svg(
      "svg",
      {
        viewBox: `${left} ${-top} ${width} ${height}`,
        role: "img",
        "aria-label": view.title,
      },
      view.lines.map((line) =>
        svg("path", { class: `organ ${line.organ}`, d: d(line.points, line.closed) }),
      ),
      taughtIn(view),
      tail,
      needle,
      tip,
      namesIn(view, width),
      svg("path", { class: "measure", d: `M${left + 2} ${-bottom - 2}h10` }),
    ),
    h("figcaption", {}, `${view.title}. Right: ${view.across}; up: ${view.up}. Bar: 1 cm`),
  );
  return {
    node,
    show(i, first) {
      const at = view.needle[i];
      tip.setAttribute("visibility", at ? "visible" : "hidden");
      needle.setAttribute("d", at && at[1] ? d(at) : "");
      tail.setAttribute(
        "d",
        d(
          view.needle
            .slice(first, i + 1)
            .filter(Boolean)
            .map((ends) => ends[0]),
        ),
      );
      if (!at) return;
      tip.setAttribute("cx", at[0][0]);
      tip.setAttribute("cy", -at[0][1]);
    },
  };
}

/** Fetched once it is there; `at(t)` moves the needle in every picture. */
export async function needleTrack(session, trial) {
  const track = await get(url("/api/sessions", session, "trials", String(trial), "track"));
  const pictures = track.views.map(picture);
  return {
    node: h(
      "section",
      { class: "track", "aria-label": "Where the needle is" },
      pictures.map((p) => p.node),
    ),
    at(t) {
      const i = Math.min(track.t_s.length - 1, firstFrom(track.t_s, t)),
        first = firstFrom(track.t_s, t - kTail_s);
      for (const one of pictures) one.show(i, first);
    },
  };
}
