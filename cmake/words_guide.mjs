// The guide's first chapter in the languages of the catalogues. A message is a heading, a
// paragraph, an item of a list, a cell of a table or what a picture shows, with its marks; what is
// to be typed stays as it is. In the catalogues they have the context "guide": the program never
// says them.
import { readFileSync, readdirSync } from "node:fs";

export const kChapter = "docs/1-first-hour.md";
const kFolder = "docs/languages";
const kWidth = 96;

/** Only what is typed, a key's name or signs. */
const isTyped = (text) =>
  /^(?:[A-Z?]|F\d+)(?:,? (?:[A-Z]|F\d+))*$/.test(text) ||
  !/\p{L}/u.test(text.replace(/`[^`]*`/g, ""));

/** Blocks of a page: {text, mark, rest} of words, {cells} of a table's row, {lines} as they are. */
function blocksOf(page) {
  const blocks = [];
  let open = null; // the block that a further line may belong to
  let fence = false;
  for (const line of page.replace(/\n$/, "").split("\n")) {
    const begins = /^(#+ |\* |\d+\. )(.*)/.exec(line);
    const picture = /^!\[(.*)\]\((.*)\)$/.exec(line);
    if (/^```/.test(line) || fence) {
      if (/^```/.test(line)) fence = !fence;
      blocks.push({ line });
      open = null;
    } else if (/^\|/.test(line)) {
      const cells = line.slice(1, -1).split("|");
      blocks.push(/^[\s|:-]+$/.test(line) ? { line } : { cells: cells.map((c) => c.trim()) });
      open = null;
    } else if (picture) {
      blocks.push({ mark: "![", text: picture[1], rest: `](${picture[2]})` });
      open = null;
    } else if (!line.trim()) {
      blocks.push({ line });
      open = null;
    } else if (begins || !open) {
      open = { mark: begins?.[1] ?? "", text: begins?.[2] ?? line, rest: "" };
      blocks.push(open);
      if (/^#/.test(line)) open = null;
    } else {
      open.text += ` ${line.trim()}`;
    }
  }
  return blocks;
}

/** Every message of the chapter. */
export function* messagesOfChapter(page) {
  for (const block of blocksOf(page))
    for (const text of block.cells ?? (block.text === undefined ? [] : [block.text]))
      if (!isTyped(text)) yield text;
}

function wrapped(mark, text) {
  const lines = [];
  let line = mark;
  for (const word of text.match(/(?:`[^`]*`|\S)+/g)) {
    if ([...line].length + [...word].length > kWidth && line.trim()) {
      lines.push(line.trimEnd());
      line = " ".repeat(/^#/.test(mark) ? 0 : mark.length);
    }
    line += `${word} `;
  }
  return [...lines, line.trimEnd()].join("\n");
}

const oneFolderDown = (text) =>
  text.replace(/\]\((?!https?:|#)(?:docs\/)?/g, (before) => `${before}../`);

/** The chapter said by `say`: a folder further down, so its links go one up. */
function chapterSaid(page, say) {
  const said = (text) => (isTyped(text) ? text : oneFolderDown(say(text)));
  return blocksOf(page)
    .map(({ line, cells, mark, text, rest }) => {
      if (line !== undefined) return line;
      if (cells) return `| ${cells.map(said).join(" | ")} |`;
      if (rest) return `${mark}${said(text)}${oneFolderDown(rest)}`;
      return /^#/.test(mark) ? mark + said(text) : wrapped(mark, said(text));
    })
    .join("\n")
    .concat("\n");
}

/** What a catalogue says of each message. */
function translationsOf(catalogue) {
  const plain = (text) => text.replace(/\\(["\\])/g, "$1");
  const form = /^msgctxt "guide"\nmsgid "(.*)"\nmsgstr "(.*)"$/gm;
  return new Map([...catalogue.matchAll(form)].map(([, id, said]) => [plain(id), plain(said)]));
}

/** File and text of the chapter in each language of `top`'s catalogues. */
export function chapters(top) {
  const page = readFileSync(top + kChapter, "utf8");
  const catalogues = `${top}assets/languages/`;
  return readdirSync(catalogues)
    .filter((name) => name.endsWith(".po"))
    .sort()
    .map((name) => {
      const said = translationsOf(readFileSync(catalogues + name, "utf8"));
      const file = kChapter.split("/")[1].replace(".md", `.${name.slice(0, -3)}.md`);
      return [`${kFolder}/${file}`, chapterSaid(page, (text) => said.get(text) || text)];
    });
}
