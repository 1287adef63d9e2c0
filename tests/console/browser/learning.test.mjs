// A console that learning management systems launch tasks at: a small one of our own (platform.mjs)
// sends a browser there by cmi5 and by LTI, and looks at what comes back.
// PALPA_CONSOLE_URL, PALPA_CONSOLE_BEGIN, PALPA_PROGRAM, PALPA_CONSOLE_HOME.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { createHmac, randomUUID, sign } from "node:crypto";
import { after, before, test } from "node:test";
import { Educator } from "./educator.mjs";
import { Platform } from "./platform.mjs";

const base = process.env.PALPA_CONSOLE_URL;
const skip = base ? false : "PALPA_CONSOLE_URL is not set: start a console and give its address";
const kTask = "paracentesis";
const kLine = {
  normal: ["initialized", "completed", "passed|failed", "terminated"],
};
let e, page, platform;

const palpa = (...words) =>
  execFileSync(process.env.PALPA_PROGRAM, [
    ...words,
    "--home",
    process.env.PALPA_CONSOLE_HOME,
  ]).toString();
const now = () => Math.floor(Date.now() / 1000);

before(async () => {
  if (skip) return;
  platform = await new Platform(base).open();
  e = await Educator.come(base, process.env.PALPA_CONSOLE_SHOTS);
  page = e.page;
});
after(async () => {
  await e?.leave();
  platform?.close();
});

const sessions = async () => (await (await fetch(`${base}api/sessions`)).json()).length;
const heading = () => page.getByRole("heading", { level: 1 }).innerText();

test("without a configured platform nothing is launched", { skip }, async () => {
  const answer = await fetch(platform.cmi5Address(kTask).url);
  assert.equal(answer.status, 404);
  assert.match(await answer.text(), /not connected to a learning management system/);
  assert.match(palpa("console", "learning"), /No learning management system/);
});

test("an educator lets two platforms in, and is told what they must know", { skip }, () => {
  palpa(
    ...["console", "learning", "cmi5", "campus", "--from", platform.address],
    ...["--address", base, "--operator", "expert"],
  );
  palpa(
    ...["console", "learning", "lti", "uni", "--issuer", platform.address, "--client", "tool-1"],
    ...["--deployment", "1", "--login", `${platform.address}/auth`],
    ...["--token", `${platform.address}/token`, "--keys", `${platform.address}/keys`],
  );
  const told = palpa("console", "learning");
  assert.match(told, /campus \(cmi5\)/);
  assert.ok(told.includes(`${base}learning/lti/launch`));
});

const shot = (name) =>
  page.screenshot({ path: `${process.env.PALPA_CONSOLE_SHOTS}/${name.replaceAll(" ", "-")}.png` });

/** Until what came of it is told; gives those words. */
async function watched(name) {
  await page.getByText("Your session is prepared.").waitFor();
  await shot(`${name} prepared`);
  await page.getByText("Your course has it.").waitFor({ timeout: 240_000 });
  await shot(`${name} told`);
  return page.locator("main p").first().innerText();
}

test(
  "cmi5: launched in a browser, held, told in order, and back to the course",
  { skip },
  async () => {
    const { launch, url } = platform.cmi5Address(kTask);
    await page.goto(url);
    assert.match(await heading(), /\S/);
    const words = await watched("cmi5");
    const verbs = launch.statements.map((s) => s.verb.id.split("/").at(-1));
    assert.equal(verbs.length, 4, verbs.join());
    assert.equal(verbs.join(" ").replace(/passed|failed/, "passed|failed"), kLine.normal.join(" "));
    assert.match(words, verbs.includes("passed") ? /^Passed\./ : /^Not passed yet\./);
    assert.ok(launch.asked, "the learner's preferences were read");
    await page.getByRole("link", { name: "Back to the course" }).waitFor();
    await page.waitForURL(`${platform.address}/course`);
    platform.line("10.2.6.0-1");
    const again = await fetch(url);
    assert.equal(again.status, 403);
    assert.match(await again.text(), /This was fetched before/);
    assert.equal(launch.statements.length, 4, "nothing came twice");
  },
);

test("cmi5: what must not be launched is not, and why is said", { skip }, async () => {
  const held = await sessions();
  const said = (change) => platform.cmi5Address(kTask, { change: { said: change } }).url;
  const kept = (change) => platform.cmi5Address(kTask, { change: { kept: change } }).url;
  const data = (change) =>
    kept({
      data: {
        contextTemplate: {
          extensions: {
            "https://w3id.org/xapi/cmi5/context/extensions/sessionid": randomUUID(),
          },
        },
        launchMode: "Normal",
        ...change,
      },
    });
  const nobody = JSON.stringify({ objectType: "Agent", mbox: "mailto:x@lms.example" });
  const cases = [
    ["no endpoint", said({ endpoint: null }), /endpoint.*missing/],
    ["no fetch address", said({ fetch: null }), /fetch.*missing/],
    [
      "a foreign store",
      said({ endpoint: "https://other.example/xapi" }),
      /not one that may launch/,
    ],
    ["a foreign fetch", said({ fetch: "https://other.example/f" }), /not one that may launch/],
    [
      "a password in it",
      said({ endpoint: "http://u:p@127.0.0.1/xapi" }),
      /may be asked|no address/,
    ],
    ["a registration that is none", said({ registration: "7" }), /no UUID/],
    ["an activity that is no IRI", said({ activityId: "task" }), /no IRI/],
    ["an actor without an account", said({ actor: nobody }), /no agent with an account/],
    ["an actor that is no JSON", said({ actor: "{" }), /no agent with an account/],
    ["a parameter twice", `${said({})}&registration=${randomUUID()}`, /comes twice/],
    ["an expired key", kept({ refused: true }), /launch data.*cannot be had.*401/],
    ["no launch data", kept({ noData: true }), /launch data.*cannot be had.*404/],
    ["launch data of no session", data({ contextTemplate: {} }), /name no session/],
    ["an unknown mode", data({ launchMode: "Examine" }), /no launch mode/],
    ["a mastery score of two", data({ masteryScore: 2 }), /not from 0 to 1/],
    ["no such task", platform.cmi5Address("surfing").url, /surfing/],
  ];
  for (const [name, url, why] of cases) {
    const answer = await fetch(url);
    const text = (await answer.text()).replaceAll("&quot;", '"');
    assert.equal(answer.status, 403, name);
    assert.match(text, why, name);
  }
  assert.equal(await sessions(), held, "none was begun");
});

test(
  "LTI: launched by a form, held though the console is killed, one score",
  { skip },
  async () => {
    await page.goto(platform.ltiAddress(kTask));
    await page.getByText("Your session is prepared.").waitFor();
    execFileSync("bash", [process.env.PALPA_CONSOLE_BEGIN, "--port", new URL(base).port]);
    await page.goto(page.url());
    await watched("lti");
    assert.equal(platform.scores.length, 1);
    const [score] = platform.scores;
    assert.equal(score.userId, "student-18");
    assert.equal(score.of, "course");
    assert.equal(score.scoreMaximum, 100);
    assert.ok([0, 100].includes(score.scoreGiven));
    assert.equal(score.activityProgress, "Completed");
    assert.equal(score.gradingProgress, "FullyGraded");
    assert.match(score.comment, /Simulated/);
  },
);

/** As a browser goes: to the platform, and with its form back. */
async function ltiLaunch(spoil, cookies = true) {
  const login = await fetch(platform.ltiAddress(kTask, spoil), { redirect: "manual" });
  if (login.status !== 303) return login;
  const form = platform.form(new URL(login.headers.get("location")).searchParams);
  const cookie = login.headers.get("set-cookie").split(";")[0];
  assert.match(login.headers.get("set-cookie"), /HttpOnly/);
  return fetch(`${base}learning/lti/launch`, {
    method: "POST",
    redirect: "manual",
    headers: cookies ? { cookie } : {},
    body: new URLSearchParams(form),
  });
}

test("LTI: replayed, expired, forged and foreign tokens are refused", { skip }, async () => {
  const held = await sessions();
  const kOf = "https://purl.imsglobal.org/spec/lti/claim/";
  const byForeign = (text, p) =>
    sign("sha256", Buffer.from(text), p.foreign.privateKey).toString("base64url");
  const bySecret = (text, p) =>
    createHmac("sha256", p.keys.publicKey.export({ type: "spki", format: "pem" }))
      .update(text)
      .digest("base64url");
  const cases = [
    ["expired", { claims: { exp: now() - 120 } }, /has expired/],
    ["of tomorrow", { claims: { iat: now() + 86_400, exp: now() + 90_000 } }, /in the future/],
    ["not yet valid", { claims: { nbf: now() + 3_600 } }, /not valid yet/],
    ["signed by another key", { by: byForeign }, /signature that is not/],
    ["unsigned", { head: { alg: "none" }, by: () => "" }, /no signed token|not signed by RS256/],
    ["signed with the public key", { head: { alg: "HS256" }, by: bySecret }, /not signed by RS256/],
    ["by an unknown key", { head: { kid: "other" } }, /does not publish/],
    ["of another platform", { claims: { iss: "https://other.example" } }, /of another platform/],
    ["for another tool", { claims: { aud: "tool-2" } }, /for another tool/],
    ["for two tools", { claims: { aud: ["tool-1", "tool-2"] } }, /made for another tool/],
    ["of another deployment", { claims: { [`${kOf}deployment_id`]: "9" } }, /not configured here/],
    ["of another login", { claims: { nonce: randomUUID() } }, /for another login/],
    ["of nobody", { claims: { sub: "" } }, /names nobody/],
    ["no launch", { claims: { [`${kOf}message_type`]: "LtiDeepLinkingRequest" } }, /no launch/],
    ["a state that is none", { form: { state: randomUUID() } }, /used before, or came too late/],
    ["a foreign login", { login: { iss: "https://other.example" } }, /not one that may launch/],
    ["a foreign target", { login: { target_link_uri: "https://x.example/" } }, /not an address of/],
    ["no such task", { claims: { [`${kOf}custom`]: { task: "surfing" } } }, /surfing/],
  ];
  for (const [name, spoil, why] of cases) {
    const answer = await ltiLaunch(spoil);
    assert.equal(answer.status, 403, name);
    assert.match(await answer.text(), why, name);
  }
  const elsewhere = await ltiLaunch({}, false);
  assert.match(await elsewhere.text(), /began in another browser/);
  await replayed();
  assert.equal(await sessions(), held, "none was begun");
  assert.equal(platform.scores.length, 1);
});

/** A token whose login is over: it was looked at once, and refused. */
async function replayed() {
  const login = await fetch(platform.ltiAddress(kTask, { claims: { exp: 1 } }), {
    redirect: "manual",
  });
  const form = platform.form(new URL(login.headers.get("location")).searchParams);
  const cookie = login.headers.get("set-cookie").split(";")[0];
  const post = () =>
    fetch(`${base}learning/lti/launch`, {
      method: "POST",
      redirect: "manual",
      headers: { cookie },
      body: new URLSearchParams(form),
    });
  assert.match(await (await post()).text(), /has expired/);
  assert.match(await (await post()).text(), /used before, or came too late/);
}

test("every line of cmi5 that was put to the test is met", { skip }, () => {
  const failed = [...platform.met].filter(([, met]) => !met).map(([number]) => number);
  assert.deepEqual(failed, []);
  const missing = kLines.filter((number) => !platform.met.has(number));
  assert.deepEqual(missing, [], "not put to the test");
});

/**
 * What an assignable unit must do, by the numbers of "@cmi5/requirements". Left out: what only a
 * platform does; 9.3.4.0-1 and 9.3.5.0-1, of which a trial meets one; a second session of a
 * registration and the modes Browse and Review, which test_learning puts to the test.
 */
const kLines = [
  ..."7.0.0.0-2 7.0.0.0-3 7.0.0.0-4 7.0.0.0-5 7.1.1.0-1 7.1.2.0-1 7.1.3.0-1".split(" "),
  ..."8.1.1.0-2 8.1.1.0-3 8.1.2.0-3 8.1.2.0-4 8.1.2.0-5 8.1.3.0-2 8.1.3.0-3 8.1.4.0-2".split(" "),
  ..."8.1.4.0-3 8.1.5.0-5 8.1.5.0-6 8.2.1.0-2 8.2.1.0-5 8.2.2.0-4 8.2.2.0-5 9.1.0.0-1".split(" "),
  ..."9.3.0.0-1 9.3.2.0-2 9.3.2.0-3 9.3.3.0-2 9.3.4.0-3 9.3.8.0-2 9.4.0.0-2 9.5.1.0-1".split(" "),
  ..."9.5.1.0-3 9.5.2.0-1 9.5.3.0-1 9.5.4.1-1 9.5.4.1-2 9.6.2.1-1 9.6.2.2-1 9.6.3.1-4".split(" "),
  ..."9.6.3.2-2 9.7.0.0-1 9.7.0.0-2 10.2.1.0-4 10.2.1.0-5 10.2.1.0-6 10.2.1.0-7".split(" "),
  ..."10.2.2.0-2 10.2.4.0-2 10.2.6.0-1 11.0.0.0-1 11.0.0.0-3".split(" "),
];

test("the browser complained of nothing", { skip }, () => assert.deepEqual(e.complaints, []));
