// What people read of the files in assets: texts of JSON, texts and attributes of a page.
const kNobodyReads = /(^|_)source$|^(format|made_by|schema|\$schema|license|url|file|pattern)$/;

/** Every text of a JSON file but for sources and names of formats. */
export function messagesOfData(text) {
  const found = [];
  const look = (value, name) => {
    if (typeof value === "string") {
      if (!kNobodyReads.test(name)) found.push(value);
    } else if (value && typeof value === "object") {
      for (const [inner, one] of Object.entries(value))
        look(one, Array.isArray(value) ? name : inner);
    }
  };
  look(JSON.parse(text), "");
  return found;
}

const unescaped = (text) =>
  text.replace(
    /&(lt|gt|quot|amp|nbsp|#\d+);/g,
    (_, name) =>
      ({ lt: "<", gt: ">", quot: '"', amp: "&", nbsp: " " })[name] ??
      String.fromCodePoint(Number(name.slice(1))),
  );

/** Text nodes, and attributes that are read. */
export function messagesOfPage(text) {
  const page = text.replace(/<(script|style)\b[^]*?<\/\1>|<!--[^]*?-->/g, "");
  const attributes = [...page.matchAll(/\s(?:title|alt|placeholder|aria-label)="([^"]*)"/g)].map(
    (m) => m[1],
  );
  const nodes = page.split(/<[^>]*>/).map((one) => one.replace(/\s+/g, " ").trim());
  return [...nodes, ...attributes].filter(Boolean).map(unescaped);
}
