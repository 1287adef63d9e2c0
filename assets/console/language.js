// Says the program's English in the language that a page is read in. The same rule as the program's
// own (apps/language/phrasebook.h): of all ways to read a text as messages, the one that leaves the
// fewest letters without one, then the one with the fewest messages.
const kALetter = 10;
const kAPhrase = 3;
const kAPlace = 1;
const kOtherCase = 1;
const kMostEffort = 100000; // comparisons at one place of the text
const kLongestPutIn = 240;
const kMostEnds = 4;
const kLongest = 800;
const kBeginning = 3;

const isLetterOrDigit = (c) => c !== undefined && /[A-Za-z0-9]/.test(c);
const isLetter = (c) => c !== undefined && /[A-Za-z]/.test(c);

/** "{1} mm of {2}" and its translation, as what stands fast and what is said. */
function phraseOf([id, translation]) {
  const places = [...id.matchAll(/\{(\d+)\}/g)].map((m) => m[1]);
  const fixed = id.split(/\{\d+\}/);
  const said = translation
    .split(/\{(\d+)\}/)
    .map((piece, i) => (i % 2 ? places.indexOf(piece) : piece));
  const letters = fixed.join("").replace(/[^A-Za-z]/g, "").length;
  const behind = fixed[0] === "";
  const head = fixed[behind ? 1 : 0];
  return { fixed, said, letters, behind, head, several: fixed.length > 1 || head.includes(" ") };
}

/** Phrases by how what stands fast in them begins. */
class Index {
  #all = new Map();
  add(phrase) {
    const key = phrase.head.slice(0, kBeginning).toLowerCase();
    if (!this.#all.has(key)) this.#all.set(key, []);
    this.#all.get(key).push(phrase);
  }
  /** When all are there: of those that begin alike the longest first. */
  sort() {
    for (const all of this.#all.values()) all.sort((a, b) => b.letters - a.letters);
  }
  at(text, from, end, look) {
    for (let length = Math.min(end - from, kBeginning); length > 0; length -= 1)
      this.#all.get(text.slice(from, from + length).toLowerCase())?.forEach(look);
  }
}

/** One English text, read as phrases, from its end to its beginning. */
class Reading {
  #known = new Map();
  #effort = 0;
  constructor(text, book) {
    this.text = text;
    this.book = book;
  }

  said(begin = 0, end = this.text.length) {
    const all = this.#choices(begin, end);
    let out = "";
    let asItIs = "";
    for (let at = begin; at < end;) {
      const choice = all[at - begin];
      if (choice.phrase) {
        out += this.book.numbers(asItIs) + this.#phrase(choice);
        asItIs = "";
      } else {
        asItIs += this.text.slice(at, choice.next);
      }
      at = choice.next;
    }
    return out + this.book.numbers(asItIs);
  }

  #phrase({ phrase, putIn, otherCase }) {
    const out = phrase.said
      .map((piece) => (typeof piece === "string" ? piece : this.said(...putIn[piece])))
      .join("");
    if (!otherCase || !out) return out;
    const first = [...out][0];
    const other = /[a-z]/.test(phrase.head[0]) ? first.toUpperCase() : first.toLowerCase();
    return other + out.slice(first.length);
  }

  #choices(begin, end) {
    const key = begin * 4096 + end;
    if (this.#known.has(key)) return this.#known.get(key);
    const all = Array.from({ length: end - begin + 1 }, () => ({ worth: 0 }));
    for (let at = end - 1; at >= begin; at -= 1)
      all[at - begin] = this.#choiceAt(at, begin, end, all);
    this.#known.set(key, all);
    return all;
  }

  #choiceAt(at, begin, end, later) {
    const next = this.#tokenEnd(at, end);
    const trial = { begin, end, later, putIn: [], worth: 0 };
    trial.best = { worth: later[next - begin].worth, next };
    trial.most = kALetter * this.text.slice(at, end).replace(/[^A-Za-z]/g, "").length - kAPhrase;
    if (this.#isWithinAName(at, begin) || this.#isTyped(at)) return trial.best;
    if (begin === 0 && end === this.text.length) this.#effort = 0;
    this.book.whole.at(this.text, at, end, (phrase) => this.#try(phrase, at, at, trial));
    if (!this.#isBreak(at, begin, end)) return trial.best;
    const last = Math.min(end, at + kLongestPutIn);
    for (let head = at + 1; head < last; head += 1) {
      this.book.behind.at(this.text, head, end, (phrase) => this.#try(phrase, at, head, trial));
      if (this.text[head] === " " && ";.".includes(this.text[head - 1])) break;
    }
    return trial.best;
  }

  #try(phrase, at, head, trial) {
    this.#effort += 1;
    if (this.#effort > kMostEffort || trial.best.worth >= trial.most) return;
    const { text } = this;
    const first = phrase.head[0];
    const exact = this.#standsAt(phrase.head, head, trial.end);
    // A single word may be a command or a name: "Palpa" is not palpa.
    const begins = this.#isBreak(head, trial.begin, trial.end) && /[A-Z]/.test(text[head]);
    const mayDiffer = phrase.several || begins;
    const other =
      !exact &&
      !phrase.behind &&
      mayDiffer &&
      isLetter(first) &&
      first.toLowerCase() === text[head].toLowerCase() &&
      this.#standsAt(phrase.head.slice(1), head + 1, trial.end);
    if (!exact && !other) return;
    trial.phrase = phrase;
    trial.otherCase = other;
    trial.worth =
      kALetter * phrase.letters -
      kAPhrase -
      (other ? kOtherCase : 0) -
      kAPlace * (phrase.fixed.length - 1);
    trial.putIn = [];
    if (phrase.behind) this.#putIn(1, at, head, head + phrase.head.length, trial);
    else this.#follow(0, head + phrase.head.length, trial);
  }

  #follow(part, from, trial) {
    this.#effort += 1;
    if (this.#effort > kMostEffort) return;
    const { fixed } = trial.phrase;
    const now = fixed[part];
    if (part + 1 === fixed.length) {
      const cut = now !== "" && isLetterOrDigit(now.at(-1)) && this.#goesOn(from, trial.end);
      const worth = trial.worth + trial.later[from - trial.begin].worth;
      if (!cut && worth > trial.best.worth)
        trial.best = {
          worth,
          phrase: trial.phrase,
          next: from,
          putIn: [...trial.putIn],
          otherCase: trial.otherCase,
        };
      return;
    }
    const first = now !== "" && now.at(-1) !== " " ? from : from + 1;
    const last = Math.min(trial.end, from + kLongestPutIn);
    const next = fixed[part + 1];
    let ends = 0;
    for (let end = first; end <= last && ends < kMostEnds; end += 1) {
      const fits =
        next === ""
          ? this.#isBreak(end, trial.begin, trial.end)
          : this.#standsAt(next, end, trial.end);
      if (!fits) continue;
      ends += 1;
      this.#putIn(part + 1, from, end, end + next.length, trial);
    }
    if (next === "" && last === trial.end && ends === kMostEnds)
      this.#putIn(part + 1, from, last, last, trial);
  }

  #putIn(part, begin, end, from, trial) {
    if (this.#effort > kMostEffort) return;
    // To the end of all it is what stands there in any case.
    const { worth } =
      end === trial.end ? trial.later[begin - trial.begin] : this.#choices(begin, end)[0];
    trial.worth += worth;
    trial.putIn.push([begin, end]);
    this.#follow(part, from, trial);
    trial.putIn.pop();
    trial.worth -= worth;
  }

  #standsAt(fixed, at, end) {
    return at + fixed.length <= end && this.text.startsWith(fixed, at);
  }

  #isBreak(at, begin, end) {
    if (at === begin || at === end) return true;
    const { text } = this;
    const isMark = (i) => ".,;:".includes(text[i]) && (i + 1 >= end || text[i + 1] === " ");
    if (isMark(at) || text[at] === ")" || text[at] === "(" || text[at - 1] === "(") return true;
    return text[at - 1] === " " && at >= 2 && at - 2 >= begin && isMark(at - 2);
  }

  #isWithinAName(at, begin) {
    if (at === begin) return false;
    const before = this.text[at - 1];
    if (before === "-") return at - 1 === begin || !isLetterOrDigit(this.text[at - 2]);
    return isLetterOrDigit(before) || "/\\_=.@".includes(before);
  }

  /** Within an option, or one of a command's first two words: "palpa report trainee". */
  #isTyped(at) {
    const before = this.text.slice(0, at);
    return /--[A-Za-z0-9-]*$|(?:^|[ (:"])palpa (?:[a-z]+ )?$/.test(before.slice(-80));
  }

  #goesOn(at, end) {
    if (at === end) return false;
    const c = this.text[at];
    if (isLetterOrDigit(c)) return true;
    if (c === ".") return at + 1 < end && isLetterOrDigit(this.text[at + 1]);
    return "/\\_=@".includes(c);
  }

  #tokenEnd(at, end) {
    if (!isLetterOrDigit(this.text[at])) return at + 1;
    let next = at;
    while (next < end && isLetterOrDigit(this.text[next])) next += 1;
    return next;
  }
}

/** A text's numbers as a language writes them; only those that stand alone. */
export function numbersIn(text, { point, group }) {
  if (point === "." && group === ",") return text;
  const ofAName = /[A-Za-z_/\\]/;
  return text.replace(/\d[\d.,]*/g, (run, at) => {
    const figure = run.replace(/[.,]+$/, "");
    const tail = run.slice(figure.length);
    const before = text[at - 1];
    const after = text[at + figure.length];
    if ((before && (ofAName.test(before) || before === ".")) || (after && ofAName.test(after)))
      return run;
    const parts = /^(\d+|\d{1,3}(?:,\d{3})+)(?:\.(\d+))?$/.exec(figure);
    if (!parts) return run;
    const tenths = parts[2] === undefined ? "" : point + parts[2];
    return parts[1].replaceAll(",", group) + tenths + tail;
  });
}

let spoken = null;

/** An English text in the language of this page. */
export const said = (english) => (spoken ? spoken.said(english) : english);

/** As the console has written this page: its `lang`. */
export async function speakAsThePage() {
  const code = document.documentElement.lang;
  if (code === "en") return;
  const answer = await fetch(`/static/language-${code}.json`);
  if (answer.ok) spoken = new Phrasebook(await answer.json());
}

/** From now on, for this browser; the console reads it, too. */
function choose(code) {
  document.cookie = `palpa-language=${code}; path=/; SameSite=Strict; max-age=31536000`;
  location.reload();
}

/** A choice for the foot of every page; what nobody has reviewed says so. */
export async function languageChoice() {
  const answer = await fetch("/static/languages.json");
  const all = answer.ok ? await answer.json() : [];
  const select = document.createElement("select");
  select.setAttribute("aria-label", said("Language"));
  const here = document.documentElement.lang;
  for (const { code, name } of all)
    select.append(Object.assign(new Option(name, code, false, code === here), { lang: code }));
  select.addEventListener("change", () => choose(select.value));
  const note = document.createElement("span");
  if (all.find((one) => one.code === here)?.reviewed === false)
    note.textContent = said("machine translation, not reviewed");
  return [select, note];
}

/** A language: its catalogue as the console gives it. */
export class Phrasebook {
  whole = new Index();
  behind = new Index();
  #alone = new Map();
  #said = new Map();
  constructor(catalogue) {
    this.form = { point: catalogue.point, group: catalogue.group };
    for (const message of catalogue.messages) {
      const phrase = phraseOf(message);
      if (phrase.letters === 0) continue;
      if (phrase.fixed.length === 1) this.#alone.set(message[0], message[1]);
      (phrase.behind ? this.behind : this.whole).add(phrase);
    }
    this.whole.sort();
    this.behind.sort();
  }
  numbers(text) {
    return numbersIn(text, this.form);
  }
  said(english) {
    const known = this.#said.get(english);
    if (known !== undefined) return known;
    if (this.#said.size > 5000) this.#said.clear();
    let out = "";
    let ahead = 0; // columns that what is said takes more than the English, in this line
    for (let at = 0; at < english.length;) {
      if (/[\n\r\t]/.test(english[at])) {
        out += english[at];
        at += 1;
        ahead = 0;
        continue;
      }
      if (english[at] === " ") {
        const gap = /^ +/.exec(english.slice(at))[0].length;
        const kept = gap < 2 ? gap : Math.max(2, gap - ahead);
        out += " ".repeat(kept);
        ahead += kept - gap;
        at += gap;
        continue;
      }
      const end = endOfPart(english, at);
      const part = english.slice(at, end);
      const bare = part.replace(/[.,;: ]+$/, "");
      const whole = this.#alone.get(bare);
      const now =
        whole === undefined ? new Reading(part, this).said() : whole + part.slice(bare.length);
      ahead += columnsOf(now) - columnsOf(part);
      out += now;
      at = end;
    }
    this.#said.set(english, out);
    return out;
  }
}

const kWide = /[\u1100-\u117f\u2e80-\ua4ff\uac00-\ud7bf\uff00-\uff7f]/g;
/** Of a terminal: two for a Korean or Chinese letter. */
const columnsOf = (text) => [...text].length + (text.match(kWide)?.length ?? 0);

function endOfPart(text, from) {
  for (let at = from; at < text.length; at += 1) {
    if (/[\n\r\t]/.test(text[at])) return at;
    if (text[at] === " " && text[at + 1] === " ") return at;
    if (at - from > kLongest && text[at] === " ") return at;
  }
  return text.length;
}
