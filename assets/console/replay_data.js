// A trial to look at again: fetched, and waited for while its pictures are drawn.
import { get, list, url } from "./api.js";
import { isOn, moment, performer, taskName, who } from "./format.js";
import { momentsIn } from "./moments.js";

const known = (x) => (Number.isFinite(x) ? x : NaN);
const numbers = (x) => (Array.isArray(x) ? x : []);

function curvesOf(answer) {
  const t = numbers(answer.t_s);
  return {
    ...answer,
    t,
    force: numbers(answer.force_N).map(known),
    depth: numbers(answer.depth_mm).map(known),
    events: numbers(answer.events),
    phases: numbers(answer.phases),
    length: Number(answer.length_s) || t.at(-1) || 1,
  };
}

/** Asked for again and again: how far the pictures are, and what they found. */
const pictureState = ({ ready, drawn, done, track, trouble, frames, near }) => ({
  ready,
  drawn,
  done,
  track,
  trouble,
  near: numbers(near),
  ...(frames === undefined ? {} : { frames }),
});

/**
 * Curves are there at once; `changed(replay)` is called then, as the pictures
 * grow, and when they are ready.
 */
export async function loadReplay(life, session, trial, changed) {
  const path = url("/api/sessions", session, "trials", String(trial), "replay");
  let replay = null;
  await life.every(250, async () => {
    let answer;
    try {
      answer = await get(replay ? `${path}?only=pictures` : path);
    } catch (error) {
      if (error.offline) throw error;
      changed({ failed: error.message });
      return false;
    }
    replay = { ...(replay || curvesOf(answer)), ...pictureState(answer) };
    changed(replay);
    return !replay.ready;
  });
}

/** Moments of a replay in the order of time; near misses among them. */
export function momentsOf(replay) {
  const all = momentsIn(replay.events).concat(
    replay.near.map((n) => ({ t: n.t_s, tone: "near", text: n.text || "near miss" })),
  );
  return all.filter((m) => Number.isFinite(m.t)).sort((a, b) => a.t - b.t);
}

/** Of this trainee's other sessions that succeeded the one with the least penalty; or none. */
function bestOf(trainee, sessions) {
  const own = sessions.filter(
    (s) => trainee && s.trainee === trainee && s.outcome?.succeeded && isFinite(s.outcome.total),
  );
  return own.sort((a, b) => a.outcome.total - b.outcome.total)[0];
}

/** Trials that can stand beside: [value "ID/N", words]; the trainee's own best ones first. */
export async function trialsBeside(session, trial) {
  const sessions = (await list("/api/sessions")).filter((s) => !isOn(s) && s.state !== "failed");
  const shown = sessions.find((s) => s.id === session),
    same = sessions.filter((s) => !shown || s.task === shown.task),
    best = bestOf(
      shown?.trainee,
      same.filter((s) => s.id !== session),
    );
  const options = [];
  for (const s of best ? [best, ...same.filter((one) => one !== best)] : same) {
    for (let n = 1; n <= (Number(s.trials) || 1); ++n) {
      if (s.id === session && n === trial) continue;
      options.push([
        `${s.id}/${n}`,
        `${taskName(s)}, ${moment(s.started_utc)}, ` +
          `${s.trainee ? who(s.trainee) : performer(s)}, trial ${n}` +
          (s === best ? ": own best so far" : ""),
      ]);
    }
  }
  return options;
}
