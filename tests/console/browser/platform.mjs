// A small learning management system: launches by cmi5, with a learning record store that looks at
// every line of what an assignable unit must do, and by LTI 1.3 with scores. In plain Node.
import { createPublicKey, generateKeyPairSync, randomUUID, sign, verify } from "node:crypto";
import http from "node:http";
import { isDeepStrictEqual as same } from "node:util";

const kCmi5 = "https://w3id.org/xapi/cmi5/context/";
const kVerbs = "http://adlnet.gov/expapi/verbs/";
const kLti = "https://purl.imsglobal.org/spec/lti/claim/";
const kScores = "https://purl.imsglobal.org/spec/lti-ags/scope/score";
const kClient = "tool-1";

const based = (bytes) => Buffer.from(bytes).toString("base64url");
const nowS = () => Math.floor(Date.now() / 1000);

export class Platform {
  constructor(tool) {
    this.tool = tool; // address of the console
    this.launches = new Map(); // cmi5, by the key of the fetch address
    this.tokens = new Map(); // cmi5, by what it was given
    this.told = new Map(); // what was told, by registration
    this.met = new Map(); // lines of cmi5, by their number: whether each was met
    this.scores = [];
    this.hints = new Map(); // LTI: how a login's token is to be spoilt
    this.keys = generateKeyPairSync("rsa", { modulusLength: 2048 });
    this.foreign = generateKeyPairSync("rsa", { modulusLength: 2048 });
    this.toolKeys = null;
    this.access = randomUUID();
  }

  async open() {
    this.server = http.createServer((q, r) => this.#answer(q, r));
    await new Promise((done) => this.server.listen(0, "127.0.0.1", done));
    this.address = `http://127.0.0.1:${this.server.address().port}`;
    return this;
  }
  close() {
    this.server.closeAllConnections();
    this.server.close();
  }

  /** Met by what only the test sees. */
  line(number) {
    this.#line(number, true);
  }

  /** A line of cmi5 that was put to the test. */
  #line(number, met) {
    this.met.set(number, (this.met.get(number) ?? true) && Boolean(met));
    return met;
  }

  /** The address that starts a unit. `change` may alter what the launch says. */
  cmi5Address(task, { mode = "Normal", registration = randomUUID(), change = {} } = {}) {
    const key = randomUUID();
    const launch = {
      registration,
      mode,
      session: randomUUID(),
      activity: `${this.address}/activities/${task}`,
      actor: { objectType: "Agent", account: { homePage: this.address, name: "student-17" } },
      mastery: 0.8,
      statements: [],
      used: false,
      ...change.kept,
    };
    this.launches.set(key, launch);
    const said = {
      endpoint: `${this.address}/xapi`,
      fetch: `${this.address}/fetch/${key}`,
      actor: JSON.stringify(launch.actor),
      registration,
      activityId: launch.activity,
      ...change.said,
    };
    for (const [name, value] of Object.entries(said)) if (value === null) delete said[name];
    return { launch, url: `${this.tool}learning/cmi5/${task}?${new URLSearchParams(said)}` };
  }

  /** The address that begins a login; `spoil` alters the claims or how they are signed. */
  ltiAddress(task, spoil = {}) {
    const hint = randomUUID();
    this.hints.set(hint, { task, spoil });
    return `${this.tool}learning/lti/login?${new URLSearchParams({
      iss: this.address,
      client_id: kClient,
      login_hint: hint,
      target_link_uri: `${this.tool}learning/lti/${task}`,
      lti_message_hint: "resource-1",
      ...spoil.login,
    })}`;
  }

  async #answer(q, r) {
    const url = new URL(q.url, this.address);
    let body = "";
    for await (const part of q) body += part;
    const routes = [
      [/^\/fetch\/(.+)$/, (key) => this.#fetched(q, key)],
      [/^\/xapi\/(.+)$/, (what) => this.#store(q, what, url.searchParams, body)],
      [/^\/auth$/, () => this.#login(url.searchParams)],
      [/^\/token$/, () => this.#grant(new URLSearchParams(body))],
      [/^\/keys$/, () => ({ json: { keys: [this.#publicKey()] } })],
      [/^\/items\/7\/scores$/, () => this.#score(q, url, body)],
      [
        /^\/course$/,
        () => ({
          html: "<!doctype html><title>Course</title><link rel=icon href=data:><h1>The course</h1>",
        }),
      ],
    ];
    let answer = { status: 404 };
    for (const [path, made] of routes) {
      const found = path.exec(url.pathname);
      if (found) answer = await made(found[1]);
    }
    r.statusCode = answer.status ?? 200;
    if (url.pathname.startsWith("/xapi/")) r.setHeader("X-Experience-API-Version", "1.0.3");
    r.setHeader("Content-Type", answer.html ? "text/html" : "application/json");
    r.end(answer.html ?? (answer.json === undefined ? "" : JSON.stringify(answer.json)));
  }

  // cmi5

  #fetched(q, key) {
    const launch = this.launches.get(key);
    this.#line("8.1.2.0-4", q.method === "POST");
    this.#line("8.2.1.0-2", q.method === "POST");
    this.#line("8.2.2.0-4", q.method === "POST");
    this.#line("8.1.2.0-3", launch);
    if (!launch || launch.used)
      return { json: { "error-code": "1", "error-text": "This was fetched before" } };
    launch.used = true;
    const token = Buffer.from(`${key}:secret`).toString("base64");
    if (!launch.refused) this.tokens.set(token, launch);
    return { json: { "auth-token": token } };
  }

  #store(q, what, query, body) {
    const token = /^Basic (.+)$/.exec(q.headers.authorization ?? "")?.[1];
    const launch = this.tokens.get(token);
    for (const number of ["8.1.2.0-5", "8.2.1.0-5", "8.2.2.0-5"])
      this.#line(number, token !== undefined);
    if (!launch) return { status: 401 };
    this.#line("8.1.1.0-2", true);
    this.#line("8.1.1.0-3", true);
    this.#line("7.0.0.0-2", q.headers["x-experience-api-version"]?.startsWith("1.0"));
    if (what === "activities/state") return this.#state(q, query, launch);
    if (what === "agents/profile") return this.#profile(q, query, launch);
    if (what !== "statements" || q.method !== "PUT") return { status: 404 };
    const statement = JSON.parse(body);
    if (launch.statements.some((one) => one.id === statement.id)) return { status: 204 };
    this.#look(statement, query, launch);
    launch.statements.push(statement);
    return { status: 204 };
  }

  #state(q, query, launch) {
    this.#line("10.2.1.0-5", q.method === "GET");
    const right =
      this.#line("8.1.3.0-3", same(JSON.parse(query.get("agent")), launch.actor)) &
      this.#line("8.1.4.0-3", query.get("registration") === launch.registration) &
      this.#line("8.1.5.0-5", query.get("activityId") === launch.activity) &
      this.#line("7.0.0.0-3", query.get("stateId") === "LMS.LaunchData");
    if (!right || launch.noData) return { status: 404 };
    launch.began = true;
    return {
      json: launch.data ?? {
        contextTemplate: {
          contextActivities: { grouping: [{ id: `${this.address}/units/1` }] },
          extensions: { [`${kCmi5}extensions/sessionid`]: launch.session },
        },
        launchMode: launch.mode,
        moveOn: "CompletedAndPassed",
        masteryScore: launch.mastery,
        returnURL: `${this.address}/course`,
      },
    };
  }

  #profile(q, query, launch) {
    launch.asked = true;
    this.#line("11.0.0.0-3", query.get("profileId") === "cmi5LearnerPreferences");
    this.#line("11.0.0.0-1", same(JSON.parse(query.get("agent")), launch.actor));
    this.#line("7.0.0.0-4", q.method === "GET");
    return { json: { languagePreference: "en", audioPreference: "off" } };
  }

  /** Every line that a statement can meet or fail. */
  #look(s, query, launch) {
    const before = launch.statements.map((one) => one.verb.id.slice(kVerbs.length));
    const earlier = this.told.get(launch.registration) ?? [];
    const verb = s.verb.id.slice(kVerbs.length);
    const judged = verb === "passed" || verb === "failed";
    const settled = judged || verb === "completed";
    const context = s.context ?? {};
    const category = (context.contextActivities?.category ?? []).map((one) => one.id);
    this.#line("9.1.0.0-1", /^[0-9a-f]{8}(-[0-9a-f]{4}){3}-[0-9a-f]{12}$/.test(s.id));
    this.#line("7.0.0.0-5", query.get("statementId") === s.id);
    this.#line("9.3.0.0-1", s.verb.id.startsWith(kVerbs));
    this.#line("8.1.3.0-2", same(s.actor, launch.actor));
    for (const number of ["8.1.5.0-6", "9.4.0.0-2"])
      this.#line(number, s.object.id === launch.activity);
    this.#line("8.1.4.0-2", context.registration === launch.registration);
    this.#line(
      "9.6.3.1-4",
      context.extensions?.[`${kCmi5}extensions/sessionid`] === launch.session,
    );
    this.#line("10.2.1.0-4", launch.began);
    this.#line("10.2.1.0-6", context.contextActivities?.grouping);
    this.#line(
      "10.2.1.0-7",
      same(context.contextActivities?.grouping, [{ id: `${this.address}/units/1` }]),
    );
    this.#line("9.6.2.1-1", category.includes(`${kCmi5}categories/cmi5`));
    this.#line("9.6.2.2-1", category.includes(`${kCmi5}categories/moveon`) === settled);
    for (const number of ["9.7.0.0-1", "9.7.0.0-2"])
      this.#line(number, /^\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d\.\d{3}Z$/.test(s.timestamp));
    const first = before.length === 0;
    for (const number of ["7.1.1.0-1", "9.3.2.0-2", "9.3.2.0-3"])
      this.#line(number, (verb === "initialized") === first);
    for (const number of ["7.1.2.0-1", "9.3.8.0-2"])
      this.#line(number, !before.includes("terminated"));
    this.#line("7.1.3.0-1", verb === "initialized" || before.includes("initialized"));
    this.#line("9.3.3.0-2", verb !== "completed" || !earlier.includes("completed"));
    this.#line("9.3.4.0-3", verb !== "passed" || !earlier.includes("passed"));
    for (const number of ["10.2.2.0-2", "10.2.2.0-3", "10.2.2.0-9", "10.2.2.0-11"])
      this.#line(number, launch.mode === "Normal" || !settled);
    this.#result(s, verb, judged, launch);
    this.told.set(launch.registration, [...earlier, verb]);
  }

  #result(s, verb, judged, launch) {
    const numbers = {
      terminated: "9.5.4.1-1",
      completed: "9.5.4.1-2",
      passed: "9.5.4.1-3",
      failed: "9.5.4.1-4",
    };
    if (numbers[verb]) this.#line(numbers[verb], /^PT[\d.]+/.test(s.result?.duration ?? ""));
    if (verb === "completed") this.#line("9.5.3.0-1", s.result.completion === true);
    this.#line("9.5.2.0-1", judged === (s.result?.success !== undefined));
    if (!judged) return;
    const { scaled, raw, min, max } = s.result.score;
    const enough = scaled >= launch.mastery;
    for (const number of ["9.5.1.0-1", "10.2.4.0-2", verb === "passed" ? "9.3.4.0-1" : "9.3.5.0-1"])
      this.#line(number, enough === (verb === "passed"));
    this.#line("9.5.1.0-3", raw === undefined || (min <= raw && raw <= max));
    this.#line(
      "9.6.3.2-2",
      s.context.extensions[`${kCmi5}extensions/masteryscore`] === launch.mastery,
    );
  }

  // LTI

  #publicKey() {
    const key = this.keys.publicKey.export({ format: "jwk" });
    return { ...key, kid: "platform-1", alg: "RS256", use: "sig" };
  }

  /** The page that a browser sends on by itself: {"id_token", "state"}. */
  form(query) {
    const { task, spoil } = this.hints.get(query.get("login_hint"));
    const claims = {
      iss: this.address,
      aud: kClient,
      sub: "student-18",
      iat: nowS(),
      exp: nowS() + 300,
      nonce: query.get("nonce"),
      [`${kLti}message_type`]: "LtiResourceLinkRequest",
      [`${kLti}version`]: "1.3.0",
      [`${kLti}deployment_id`]: "1",
      [`${kLti}target_link_uri`]: `${this.tool}learning/lti/${task}`,
      [`${kLti}resource_link`]: { id: "resource-1" },
      [`${kLti}launch_presentation`]: { return_url: `${this.address}/course` },
      "https://purl.imsglobal.org/spec/lti-ags/claim/endpoint": {
        scope: [kScores],
        lineitem: `${this.address}/items/7?of=course`,
      },
      ...spoil.claims,
    };
    const head = { alg: "RS256", typ: "JWT", kid: "platform-1", ...spoil.head };
    const text = `${based(JSON.stringify(head))}.${based(JSON.stringify(claims))}`;
    const by = spoil.by ? spoil.by(text, this) : based(sign("sha256", text, this.keys.privateKey));
    return { id_token: `${text}.${by}`, state: query.get("state"), ...spoil.form };
  }

  #login(query) {
    const fields = Object.entries(this.form(query));
    const inputs = fields.map(([n, v]) => `<input type="hidden" name="${n}" value="${v}">`);
    const to = query.get("redirect_uri");
    return {
      html: `<!doctype html><title>Login</title><form method="post" action="${to}">${inputs.join(
        "",
      )}</form><script>document.forms[0].submit()</script>`,
    };
  }

  /** Access for whoever signs with the tool's key. */
  async #grant(form) {
    this.toolKeys ??= (await (await fetch(`${this.tool}learning/keys`)).json()).keys;
    const [head, claims, mark] = form.get("client_assertion").split(".");
    const { kid } = JSON.parse(Buffer.from(head, "base64url"));
    const key = this.toolKeys.find((one) => one.kid === kid);
    const said = JSON.parse(Buffer.from(claims, "base64url"));
    const right =
      key &&
      verify(
        "sha256",
        `${head}.${claims}`,
        createPublicKey({ key, format: "jwk" }),
        Buffer.from(mark, "base64url"),
      ) &&
      said.iss === kClient &&
      said.sub === kClient &&
      said.aud === `${this.address}/token` &&
      said.exp > nowS() &&
      form.get("grant_type") === "client_credentials" &&
      form.get("scope") === kScores;
    if (!right) return { status: 401 };
    return { json: { access_token: this.access, token_type: "Bearer", expires_in: 3600 } };
  }

  #score(q, url, body) {
    if (q.headers.authorization !== `Bearer ${this.access}`) return { status: 401 };
    if (q.headers["content-type"] !== "application/vnd.ims.lis.v1.score+json")
      return { status: 415 };
    this.scores.push({ ...JSON.parse(body), of: url.searchParams.get("of") });
    return { status: 200, json: {} };
  }
}
