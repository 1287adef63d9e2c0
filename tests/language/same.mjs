// node same.mjs CATALOGUE EXPECTED: do the pages say texts.json as the program does?
import { readFileSync } from "node:fs";
import { Phrasebook } from "../../assets/console/language.js";

const read = (file) => JSON.parse(readFileSync(file, "utf8"));
const book = new Phrasebook(read(process.argv[2]));
const expected = read(process.argv[3]);
read(new URL("texts.json", import.meta.url)).forEach((text, i) => {
  const said = book.said(text);
  if (said === expected[i]) return;
  console.error(`"${text}"\n  page:    ${said}\n  program: ${expected[i]}`);
  process.exitCode = 1;
});
