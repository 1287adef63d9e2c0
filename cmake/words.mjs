// What people may read of the program, as a gettext template: `node cmake/words.mjs` writes
// assets/languages/palpa.pot, and the guide's first chapter as each catalogue says it; with
// `--check` it says whether they are up to date.
//
// Words stand in the sources as they are: "cannot reach " + name + ": look ...". What is joined by
// + (or stands within a `template`, or about a % of printf) is one message with {1}, {2} ... for
// what is put in; so is a key, "[P]" (scene/key_places.h). A single word counts where it begins
// with a capital, or stands in assets/languages/words.txt: most others are names of fields.
import { existsSync, readFileSync, readdirSync, writeFileSync } from "node:fs";
import { messagesOfData, messagesOfPage } from "./words_data.mjs";
import { chapters, kChapter, messagesOfChapter } from "./words_guide.mjs";

const top = new URL("..", import.meta.url).pathname;
const kRead = ["anatomy", "apps", "ar", "assets", "calibration", "haptics", "scene"];
const kNobodyReads = new RegExp(
  [
    /^(tests|docs|cmake)\/|^apps\/bench\/|^haptics\/devices\/template\/|pinned_/,
    /_glsl\.h$|page\/style\.cpp$|^apps\/report\/page\/html\.|\.in$/,
  ]
    .map((part) => part.source)
    .join("|"),
);
const kEnds = new Set([
  ",",
  ";",
  "?",
  ":",
  "=",
  "<<",
  "==",
  "!=",
  "===",
  "!==",
  "{",
  "}",
  "&&",
  "||",
  "+=",
  "return",
  "=>",
  "case",
]);

/** Tokens: {text} of a literal, {joins} of a template, or {code}. */
function tokens(source, isScript) {
  const all = [];
  const forms = [
    [/\/\/[^\n]*|\/\*[^]*?\*\//y, () => null],
    [/^[ \t]*#[^\n]*(?:\\\n[^\n]*)*/my, () => null],
    [/R"(\w*)\(([^]*?)\)\1"/y, (m) => ({ text: m[2] })],
    [/"((?:[^"\\\n]|\\.)*)"/y, (m) => ({ text: plain(m[1]) })],
    isScript
      ? [/'((?:[^'\\\n]|\\.)*)'/y, (m) => ({ text: plain(m[1]) })]
      : [/'((?:[^'\\\n]|\\.)+)'/y, (m) => ({ text: plain(m[1]), letter: true })],
    [/[A-Za-z_$][\w$]*(?:::[\w$]+)*|\d[\w.']*/y, (m) => ({ code: m[0] })],
    [/===|!==|==|!=|<<|>>|&&|\|\||\+=|=>|->|\+\+|\?\.|\?\?|[^\s]/y, (m) => ({ code: m[0] })],
  ];
  let at = 0;
  while (at < source.length) {
    if (/\s/.test(source[at])) {
      at += 1;
      continue;
    }
    if (isScript && source[at] === "`") {
      const [parts, end] = templateAt(source, at + 1);
      all.push({ joins: parts });
      at = end;
      continue;
    }
    if (isScript && source[at] === "/" && startsPattern(all.at(-1))) {
      const pattern = /\/(?:[^\/\\\n[]|\\.|\[(?:[^\]\\]|\\.)*\])+\/\w*/y;
      pattern.lastIndex = at;
      const found = !/^\/[/*]/.test(source.slice(at, at + 2)) && pattern.exec(source);
      if (found) {
        all.push({ code: "pattern" });
        at = pattern.lastIndex;
        continue;
      }
    }
    for (const [form, made] of forms) {
      form.lastIndex = at;
      const found = form.exec(source);
      if (!found) continue;
      const token = made(found);
      if (token) all.push(token);
      at = form.lastIndex;
      break;
    }
  }
  return all;
}

const startsPattern = (before) =>
  !before || (before.code && /^(?:[(,=:;!&|?{}+]|=>|&&|\|\||return|===)$/.test(before.code));

/** The parts of a template from after its first mark: texts, and tokens of what is put in. */
function templateAt(source, from) {
  const parts = [];
  let text = "";
  let at = from;
  while (source[at] !== "`") {
    if (source[at] === "\\") {
      text += plain(source.slice(at, at + 2));
      at += 2;
    } else if (source.startsWith("${", at)) {
      parts.push({ text });
      text = "";
      const end = closing(source, at + 2);
      parts.push({ inner: tokens(source.slice(at + 2, end), true) });
      at = end + 1;
    } else {
      text += source[at];
      at += 1;
    }
  }
  parts.push({ text });
  return [parts, at + 1];
}

function closing(source, from) {
  let depth = 0;
  for (let at = from; ; at += 1) {
    if (source[at] === "`") at = templateAt(source, at + 1)[1] - 1;
    else if (source[at] === '"') at = source.indexOf('"', at + 1);
    else if (source[at] === "{") depth += 1;
    else if (source[at] === "}" && depth-- === 0) return at;
  }
}

const kEscapes = { n: "\n", t: "\t", "\\": "\\", '"': '"', "'": "'", 0: "\0", r: "\r" };
const plain = (text) =>
  text
    .replace(/\\u\{?([0-9a-fA-F]+)\}?|\\x([0-9a-fA-F]{2})/g, (_, u, x) =>
      String.fromCodePoint(parseInt(u ?? x, 16)),
    )
    .replace(/\\([^])/g, (_, c) => kEscapes[c] ?? c);

/** Every message of a list of tokens, to `found`. */
function gather(list, found, from = 0) {
  let parts = [];
  const flush = () => {
    if (parts.some((p) => p.text !== undefined)) found(parts);
    parts = [];
  };
  const hole = () => {
    if (parts.at(-1)?.text !== undefined || !parts.length) parts.push({});
  };
  let joined = true;
  let at = from;
  for (; at < list.length; at += 1) {
    const token = list[at];
    if (token.text !== undefined) {
      if (token.letter && !parts.length && list[at + 1]?.code !== "+") continue;
      parts.push({ text: token.text });
    } else if (token.joins) {
      for (const part of token.joins) {
        if (part.text !== undefined) parts.push(part);
        else {
          hole();
          gather(part.inner, found);
        }
      }
    } else if (token.code === "(" || token.code === "[") {
      const sole =
        list[at + 1]?.text !== undefined &&
        list[at + 2]?.code === ")" &&
        /(^|::)string$/.test(list[at - 1]?.code ?? "");
      if (sole) {
        if (parts.at(-1) && parts.at(-1).text === undefined) parts.pop();
        parts.push({ text: list[at + 1].text });
        at += 2;
      } else {
        hole();
        at = gather(list, found, at + 1);
      }
    } else if (token.code === ")" || token.code === "]") {
      flush();
      return at;
    } else if (kEnds.has(token.code)) {
      flush();
    } else if (token.code !== "+") {
      hole();
    }
  }
  flush();
  return at;
}

/** One message: literals as they are, what is put in as {1}, {2} ... */
function messageOf(parts) {
  let text = "";
  for (const part of parts) {
    if (part.text === undefined) text += "\u0001";
    else
      text += part.text.replace(
        /%%|%[-+0#]*(?:\*|\d+)?(?:\.(?:\*|\d+))?(?:hh|h|ll|l|z|t)?[dsfguixceX]|\[[A-Z,.]\]/g,
        (m) => (m === "%%" ? "%" : "\u0001"),
      );
  }
  return text;
}

const words = new Set(
  readFileSync(`${top}assets/languages/words.txt`, "utf8").split("\n").filter(Boolean),
);
/** Queries, markup and colours, statements, addresses and paths, rules of style. */
const kNoWords = [
  /\b(SELECT|INSERT|CREATE|UPDATE|DELETE|PRAGMA|FROM|WHERE|NULL|VALUES)\b/,
  /^[\s\u0001]*(<|@|#[0-9a-f]{3,})/,
  /;$|^[a-z-]+: ?\S+;|^\$/,
  /:\/\/\S+$|\*\.[a-z]+$|^\S*\/\S*$/,
];

/** As matched: pieces between line ends and wide gaps, without outer blanks and marks. */
function piecesOf(message) {
  return message
    .split(/\n|\t| {2,}|\r|\x1b\[\d*[A-Za-z]/)
    .map(bare)
    .filter(isForPeople)
    .map((piece) => {
      let n = 0;
      return piece.replace(/\u0001+/g, () => `{${(n += 1)}}`);
    });
}

/** Without the blanks and marks around it; what is put in counts as a letter. */
function bare(piece) {
  const inner = piece.replace(/^[\s.,;:]+|[\s.,;:]+$/g, "");
  if (!inner.includes("(")) return inner.replace(/\)+$/, "").replace(/[\s.,;:]+$/, "");
  return inner.includes(")") ? inner : inner.replace(/^\(+|\(+$/g, "").replace(/[\s.,;:]+$/, "");
}

function isForPeople(piece) {
  const letters = piece.replace(/\u0001/g, " ");
  if (/^palpa [a-z]+ .*--|^--[a-z-]+\s|^[a-z]+-[a-z]+ \u0001$/.test(piece)) return false;
  if (!/[A-Za-z]{2,}/.test(letters) || /[\0-\x1f\x7f]/.test(letters.replaceAll("\u0001", "")))
    return false;
  if (kNoWords.some((kind) => kind.test(piece))) return false;
  if (/[{}<>=]|::|[A-Za-z]\(|\\/.test(letters.replace(/<[A-Z]+>/g, ""))) return false;
  if (/\s/.test(letters.trim()) || /[a-z]{2,} \u0001|\u0001 [a-z]{2,}/.test(piece))
    return /[a-z]{2,}/.test(letters) || words.has(letters);
  return words.has(letters) || /^[A-Z][a-z]{2,}$/.test(letters);
}

function* allMessages() {
  const files = kRead.flatMap((folder) =>
    readdirSync(top + folder, { recursive: true }).map((name) => `${folder}/${name}`),
  );
  for (const file of files.sort().filter((f) => !kNobodyReads.test(f))) {
    const text = () => readFileSync(top + file, "utf8");
    if (/\.(cpp|h|js)$/.test(file)) {
      const found = [];
      gather(tokens(text(), file.endsWith(".js")), (parts) => found.push(messageOf(parts)));
      for (const one of found) for (const piece of piecesOf(one)) yield [piece, file];
    } else if (/\.json$/.test(file) && !file.startsWith("assets/schemas/")) {
      for (const one of messagesOfData(text()))
        for (const piece of piecesOf(one)) yield [piece, file];
    } else if (/\.html$/.test(file)) {
      for (const one of messagesOfPage(text()))
        for (const piece of piecesOf(one)) yield [piece, file];
    }
  }
  for (const word of words) yield [word, "assets/languages/words.txt"];
}

const quoted = (text) => `"${text.replace(/\\/g, "\\\\").replace(/"/g, '\\"')}"`;
function written() {
  const where = new Map();
  for (const [message, file] of allMessages()) {
    if (!where.has(message)) where.set(message, new Set());
    where.get(message).add(file);
  }
  const head =
    'msgid ""\nmsgstr ""\n' +
    '"Content-Type: text/plain; charset=UTF-8\\n"\n"Content-Transfer-Encoding: 8bit\\n"\n';
  const entries = [...where].sort(([a], [b]) => (a < b ? -1 : 1));
  const guide = new Set(messagesOfChapter(readFileSync(top + kChapter, "utf8")));
  return [
    head,
    ...entries.map(([message, files]) => entry([...files].sort().slice(0, 3), "", message)),
    ...[...guide].map((message) => entry([kChapter], 'msgctxt "guide"\n', message)),
  ].join("\n");
}

const entry = (files, context, message) =>
  `#: ${files.join(" ")}\n${context}msgid ${quoted(message)}\nmsgstr ""\n`;

const made = [["assets/languages/palpa.pot", written()], ...chapters(top)];
if (process.argv.includes("--check")) {
  const old = made.filter(
    ([file, text]) => !existsSync(top + file) || readFileSync(top + file, "utf8") !== text,
  );
  for (const [file] of old) console.error(`${file} is not up to date: node cmake/words.mjs`);
  process.exit(old.length ? 1 : 0);
}
for (const [file, text] of made) writeFileSync(top + file, text);
console.log(`${made[0][1].split("\nmsgid ").length - 1} messages`);
