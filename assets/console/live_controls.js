// What the educator may do to a running session, with the emergency stop always in reach.
import { post, url } from "./api.js";
import { announce, h, put, say } from "./dom.js";
import { askVoidReason, confirmed } from "./dialog.js";
import { during, notice } from "./parts.js";

const kTries = 6,
  kStopPatience_ms = 2000;

export class LiveControls {
  constructor(life, id) {
    this.path = url("/api/sessions", id, "command");
    this.stopPath = url("/api/sessions", id, "stop");
    this.status = { state: "checking", trial: 1, trials: 1 };
    this.said = h("div", { class: "said", role: "status" });
    this.go = this.#button("Start the trial", "primary", () =>
      this.#command(this.status.state === "running" ? "pause" : "start"),
    );
    this.go.id = "live-go";
    this.abort = this.#button("Abort the trial…", "", async () => {
      const { trial } = this.status; // the one that is meant, though the next may begin meanwhile
      if (
        await confirmed(
          `Abort trial ${trial}?`,
          "The trial ends here and counts as aborted. " +
            "If something other than the trainee was the cause, void it instead.",
          "Abort the trial",
        )
      )
        await this.#command("abort", { trial });
    });
    this.void = this.#button("Void the trial…", "", async () => {
      const { trial } = this.status;
      const reason = await askVoidReason(trial);
      if (reason) await this.#command("void", { reason, trial });
    });
    this.leave = this.#button("End the session…", "", async () => {
      if (
        await confirmed(
          "End the session?",
          "What has been recorded so far is kept. A trial that is running ends, too: " +
            "in practice it becomes void, an assessed one counts as aborted.",
          "End the session",
        )
      )
        await this.#command("leave");
    });
    this.rearm = this.#button("Re-arm", "primary", () => this.#command("rearm"));
    this.rearm.hidden = true;
    this.stop = h(
      "button",
      {
        type: "button",
        class: "stop",
        id: "emergency-stop",
        "aria-keyshortcuts": "Control+.",
        onclick: () => this.#emergency(),
      },
      "EMERGENCY STOP",
      h("kbd", {}, "Ctrl ."),
    );
    this.node = h(
      "div",
      { class: "controls", role: "group", "aria-label": "Controls of the session" },
      this.go,
      this.rearm,
      this.abort,
      this.void,
      this.leave,
      this.stop,
    );
    life.listen(window, "keydown", (e) => {
      if ((e.ctrlKey || e.metaKey) && (e.key === "." || /^Period$/.test(e.code))) {
        e.preventDefault();
        this.#emergency();
      }
    });
    this.show(this.status);
  }

  #button(label, kind, work) {
    const made = h(
      "button",
      {
        type: "button",
        class: kind,
        onclick: () => during(made, this.said, work).then(() => this.show(this.status)),
      },
      label,
    );
    return made;
  }

  #command(command, more = {}) {
    return post(this.path, { command, ...more });
  }

  /** By its own way, before which no limit stands; every third time with the other requests. */
  #askToStop(n) {
    if (n % 3 === 2) return this.#command("stop");
    return post(this.stopPath, {}, kStopPatience_ms);
  }

  /** Asks nothing, and asks the station again until it has heard. */
  async #emergency() {
    if (this.over) return;
    put(this.said, notice("work", "Emergency stop: sent to the station…"));
    for (let n = 0; n < kTries; ++n) {
      try {
        await this.#askToStop(n);
        put(this.said, notice("note", "The station has received the emergency stop."));
        announce("The station has received the emergency stop.");
        return;
      } catch (error) {
        if (error.status === 409) {
          put(this.said, notice("note", error.message));
          return;
        }
        await new Promise((done) => {
          setTimeout(done, 300);
        });
      }
    }
    put(
      this.said,
      notice(
        "bad",
        "The emergency stop did NOT reach the station. Use the stop at the station itself.",
      ),
    );
  }

  show(status) {
    if (this.status.emergency_stop && !status.emergency_stop) put(this.said);
    this.status = status;
    const { state } = status,
      on = state === "running" || state === "paused",
      stopped = !!status.emergency_stop;
    const upcoming = Number(status.trial) + 1; // `trial` is the last one that began
    const next =
      Number(status.trials) > 1
        ? `Start trial ${Math.min(upcoming, status.trials)} of ${status.trials}`
        : "Start the trial";
    // The last trial's result stands at the station until somebody closes it.
    const last = state === "ended" && Number(status.trial) >= Number(status.trials);
    const words = { running: "Pause", paused: "Continue", ended: last ? "Close" : next };
    say(this.go, words[state] || next);
    this.#may(this.go, !stopped && (last || ["waiting", "running", "paused"].includes(state)));
    this.#may(this.abort, on);
    this.#may(this.void, on);
    this.#may(this.leave, state !== "finished");
    this.rearm.hidden = !stopped; // in the place of "Continue": nothing moves under the hand
    this.go.hidden = stopped;
  }

  #may(made, allowed) {
    if (allowed && !this.over) made.removeAttribute("aria-disabled");
    else made.setAttribute("aria-disabled", "true");
  }

  end() {
    this.over = true;
    this.node.hidden = true;
    put(this.said);
  }
}
