// clang-tidy over what changed, or over everything; results are kept by content.
//
//   node cmake/tidy.mjs            what differs from the commit before; on a branch: from main
//   node cmake/tidy.mjs --all      every source
//   node cmake/tidy.mjs FILE...    these
//   --minutes N                    starts no further batch after N minutes, and says what is left
//
// clang-tidy 14 looks through every header of a source, the system's too: seconds before the
// first line of ours. So the sources of a folder are joined by eight, as in the build.
import { spawn, execFileSync } from "node:child_process";
import { createHash } from "node:crypto";
import { cpus } from "node:os";
import { dirname, join, relative, resolve } from "node:path";
import { existsSync, mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { fileURLToPath } from "node:url";

const top = resolve(dirname(fileURLToPath(import.meta.url)), "..");
const build = join(top, "build", "tidy");
const batchSize = 8;
const wanted = 14;
// Headers of X11 and OpenGL, and the resolver's (httplib's), define everyday words as macros.
const aloneIn = /<(X11|EGL|GL|resolv|httplib)|openxr_platform|glew|GLEW/;

function git(...words) {
  return execFileSync("git", ["-C", top, ...words], { encoding: "utf8" })
    .split("\n")
    .filter(Boolean);
}

function known(revision) {
  try {
    return git("rev-parse", "--verify", "--quiet", `${revision}^{commit}`)[0];
  } catch {
    return undefined;
  }
}

// On a branch of its own, what differs from the main branch; on the main branch, from the commit
// before.
function base() {
  const [branch] = git("branch", "--show-current");
  const main = known("main");
  if (branch && branch !== "main" && main) return git("merge-base", main, "HEAD")[0];
  return known("HEAD~1");
}

function changed() {
  const from = base();
  if (!from) return [];
  const names = [
    ...git("diff", "--name-only", "--diff-filter=d", from),
    ...git("ls-files", "--others", "--exclude-standard"),
  ];
  const sources = names.map((name) => name.replace(/\.h$/, ".cpp"));
  return [...new Set(sources)].filter((name) => existsSync(join(top, name)));
}

// The compiler's words for each source, without what names the source and its result.
function commands() {
  execFileSync("cmake", ["--preset", "tidy"], { cwd: top, stdio: ["ignore", "ignore", "inherit"] });
  const list = JSON.parse(readFileSync(join(build, "compile_commands.json"), "utf8"));
  const flags = new Map();
  for (const { file, command } of list) {
    const words = command.slice(command.indexOf(" -")).replace(/ -o .*$/, "");
    const name = relative(top, file);
    if (!name.startsWith("build/")) flags.set(name, words.trim());
  }
  return flags;
}

function batches(names, flags) {
  const groups = new Map();
  for (const name of names.filter((each) => flags.has(each)).sort()) {
    const alone = aloneIn.test(readFileSync(join(top, name), "utf8"));
    const key = `${dirname(name)} ${flags.get(name)}${alone ? name : ""}`;
    if (!groups.has(key)) groups.set(key, []);
    groups.get(key).push(name);
  }
  const result = [];
  for (const sources of groups.values()) {
    for (let at = 0; at < sources.length; at += batchSize) {
      const part = sources.slice(at, at + batchSize);
      result.push({ sources: part, flags: flags.get(part[0]) });
    }
  }
  return result;
}

// The batch as one source; the hash of all of ours that it reads, of the checks and of the tool.
function prepare(batch, tool) {
  const text = batch.sources.map((name) => `#include "${name}"\n`).join("");
  const name = createHash("sha256").update(text).digest("hex").slice(0, 16);
  batch.file = join(build, "batches", `${name}.cpp`);
  if (!existsSync(batch.file)) writeFileSync(batch.file, text);
  const words = batch.flags.replaceAll('\\"', '"').split(/\s+/);
  const options = words.filter((word) => !/^-O/.test(word)).concat(`-I${top}`);
  const rule = execFileSync("g++", [...options, "-MM", batch.file], {
    cwd: build,
    encoding: "utf8",
    maxBuffer: 1 << 24,
  });
  const hash = createHash("sha256").update(tool).update(options.join(" "));
  for (const read of rule.replace(/\\\n/g, " ").split(/\s+/).slice(1).filter(Boolean)) {
    hash.update(readFileSync(resolve(build, read)));
  }
  batch.options = options.filter((word) => !/^--param|^ggc-|^-fvect-cost-model/.test(word));
  batch.result = join(build, "results", hash.digest("hex"));
}

function run(batch) {
  // Joined sources include sources.
  const checks = "--checks=-bugprone-suspicious-include";
  const words = ["--quiet", checks, batch.file, "--", "-x", "c++", ...batch.options];
  return new Promise((done) => {
    let out = "";
    const tidy = spawn("clang-tidy", words, { cwd: top });
    tidy.stdout.on("data", (data) => (out += data));
    tidy.stderr.on("data", (data) => (/error/.test(data) ? (out += data) : undefined));
    tidy.on("error", (error) => done(`${error}\n`));
    tidy.on("close", (code, signal) =>
      done(out || (code || signal ? `clang-tidy ended with ${code ?? signal}\n` : "")),
    );
  });
}

async function look(batch, count) {
  const begin = Date.now();
  const title = `${dirname(batch.sources[0])} (${batch.sources.length})`;
  if (!existsSync(batch.result)) {
    const text = await run(batch);
    writeFileSync(batch.result, text.replaceAll(`${top}/`, ""));
    const seconds = ((Date.now() - begin) / 1000).toFixed(0);
    count.done += 1;
    process.stderr.write(`[${count.done}/${count.all}] ${title}: ${seconds} s\n`);
  } else {
    count.done += 1;
    count.kept += 1;
  }
  for (const finding of readFileSync(batch.result, "utf8").split(
    /^(?=\S+:\d+:\d+: (?:warning|error): )/m,
  )) {
    if (finding.trim()) count.findings.add(finding);
  }
}

function chosen(names, all, flags) {
  if (all) return [...flags.keys()];
  if (names.length) return names.map((name) => relative(top, resolve(name)));
  return changed();
}

// Versions find different things; the tree is held clean for one.
function wantedVersion() {
  try {
    const text = execFileSync("clang-tidy", ["--version"], { encoding: "utf8" });
    return text.includes(`version ${wanted}.`) ? text : undefined;
  } catch {
    return undefined;
  }
}

async function main(words) {
  const at = words.indexOf("--minutes");
  const minutes = at < 0 ? Infinity : Number(words.splice(at, 2)[1]);
  const all = words.includes("--all");
  const begin = Date.now();
  const version = wantedVersion();
  if (!version) {
    console.log(`clang-tidy ${wanted} is not here: its checks are left out`);
    return;
  }
  mkdirSync(join(build, "batches"), { recursive: true });
  mkdirSync(join(build, "results"), { recursive: true });
  const tool = version + readFileSync(join(top, ".clang-tidy"), "utf8");
  const flags = commands();
  const names = words.filter((word) => word !== "--all");
  const waiting = batches(chosen(names, all, flags), flags);
  const count = { all: waiting.length, done: 0, kept: 0, findings: new Set() };
  const worker = async () => {
    while (waiting.length && Date.now() - begin < minutes * 60000) {
      const batch = waiting.shift();
      prepare(batch, tool);
      await look(batch, count);
    }
  };
  await Promise.all(cpus().map(worker));
  process.stdout.write([...count.findings].join(""));
  const left = waiting.flatMap((batch) => batch.sources);
  const seconds = ((Date.now() - begin) / 1000).toFixed(0);
  console.log(
    `clang-tidy: ${count.done} batches, ${count.kept} of them known, ` +
      `${count.findings.size} findings, ${seconds} s`,
  );
  if (left.length) {
    console.log(`Not looked at, for want of time: ${left.length} sources; --all looks at all.`);
  }
  process.exitCode = count.findings.size ? 1 : 0;
}

await main(process.argv.slice(2));
