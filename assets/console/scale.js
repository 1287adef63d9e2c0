// From figures to places: round ticks, and paths with no more points than there are pixels.

/** Round steps (1, 2, 5 x 10^n) of about `count` parts. */
export function roundStep(span, count) {
  const rough = Math.max(span, 1e-9) / Math.max(1, count);
  const power = 10 ** Math.floor(Math.log10(rough));
  return [1, 2, 5, 10].map((m) => m * power).find((step) => step >= rough * 0.999);
}

export function ticks(low, high, count) {
  const step = roundStep(high - low, count);
  const all = [];
  for (let k = Math.ceil(low / step - 1e-6); k * step <= high + step * 1e-6; ++k)
    all.push(Number((k * step).toPrecision(12)));
  return all;
}

/** The first index of the ascending `t` that is not before `at`. */
export function firstFrom(t, at) {
  let low = 0,
    high = t.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (t[middle] < at) low = middle + 1;
    else high = middle;
  }
  return low;
}

export function valueAt(t, v, at) {
  if (t.length === 0 || at < t[0] || at > t[t.length - 1]) return NaN;
  const k = firstFrom(t, at);
  if (k === 0) return v[0];
  const share = (at - t[k - 1]) / Math.max(1e-9, t[k] - t[k - 1]);
  return v[k - 1] + share * (v[k] - v[k - 1]);
}

export function span(v, from = 0, to = v.length) {
  let low = Infinity,
    high = -Infinity;
  for (let k = from; k < to; ++k) {
    if (v[k] < low) low = v[k];
    if (v[k] > high) high = v[k];
  }
  return [low, high];
}

/**
 * A path through (t, v) between two times. Where several points fall in one pixel, its lowest and
 * highest are drawn. A gap longer than `gap_s` is left open.
 */
export function pathOf(t, v, from, to, x, y, gap_s = 1.5) {
  const begin = Math.max(0, firstFrom(t, from) - 1),
    end = Math.min(t.length, firstFrom(t, to) + 1);
  const parts = [];
  let pen = "M",
    column = NaN,
    low = 0,
    high = 0,
    last = NaN;
  const flush = () => {
    if (Number.isNaN(column)) return;
    parts.push(`${pen}${column} ${y(low).toFixed(1)}`);
    if (high !== low) parts.push(`L${column} ${y(high).toFixed(1)}`);
    pen = "L";
  };
  for (let k = begin; k < end; ++k) {
    if (!Number.isFinite(v[k])) continue;
    const place = Math.round(x(t[k]) * 2) / 2;
    if (t[k] - last > gap_s) {
      flush();
      pen = "M";
      column = NaN;
    }
    last = t[k];
    if (place === column) {
      if (v[k] < low) low = v[k];
      if (v[k] > high) high = v[k];
      continue;
    }
    flush();
    column = place;
    low = high = v[k];
  }
  flush();
  return parts.join("");
}
