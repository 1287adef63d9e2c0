// What the session tells, as it happens: reconnects by itself, and nothing is told twice or missed.
import { get, reportConnection, url } from "./api.js";

const kQuiet_ms = 4000,
  kAgain_ms = 1500;

/**
 * Calls `told(message)` for each message in order, once; `told({kind: 'end', ...})` also when the
 * session ended without a word.
 */
export function followSession(life, id, told) {
  let source = null,
    last = 0,
    heard = Date.now(),
    ended = false;
  const end = () => {
    ended = true;
    source?.close();
  };
  const receive = (e) => {
    heard = Date.now();
    reportConnection(true);
    const count = Number(e.lastEventId);
    if (Number.isFinite(count) && count > 0) {
      if (count <= last) return;
      last = count;
    }
    let message;
    try {
      message = JSON.parse(e.data);
    } catch {
      return;
    }
    if (!message || typeof message !== "object" || ended) return;
    if (message.kind === "end") end();
    told(message);
  };
  const connect = () => {
    if (life.over || ended) return;
    source = new EventSource(url("/api/sessions", id, "live"));
    source.onopen = () => {
      heard = Date.now();
      reportConnection(true);
    };
    source.onmessage = receive;
    // The browser tries again with Last-Event-ID; when it has given up (the server refused), a new
    // stream begins, and what was told already is skipped by its number.
    source.onerror = () => {
      if (source.readyState === EventSource.CLOSED) {
        source.close();
        life.after(kAgain_ms, connect);
      }
    };
  };
  life.atEnd(() => source?.close());
  connect();
  life.every(2000, async () => {
    if (ended) return false;
    if (Date.now() - heard < kQuiet_ms) return true;
    const session = await get(url("/api/sessions", id)); // says by itself whether anybody answers
    heard = Date.now();
    if (!["starting", "running"].includes(session.state) && !ended) {
      end();
      told({ kind: "end", state: session.state, message: session.message || "" });
      return false;
    }
    if (source.readyState === EventSource.CONNECTING) {
      source.close();
      connect();
    }
    return true;
  });
}

/**
 * Keeps the moving picture in `view` (img, still): begins again when it has ended, lets go of it
 * while nobody looks and at the end. Its last picture is kept in `still`, for a stream that ends
 * leaves nothing, and says nothing.
 */
export function followPicture(life, id, view) {
  const { img, still } = view;
  let count = 0,
    begun = 0,
    over = false;
  const begin = () => {
    if (over || document.hidden) return;
    begun = Date.now();
    img.src = `${url("/api/sessions", id, "view")}?n=${++count}`;
  };
  const keep = () => {
    if (!img.naturalWidth) return;
    if (still.width !== img.naturalWidth)
      [still.width, still.height] = [img.naturalWidth, img.naturalHeight];
    still.getContext("2d").drawImage(img, 0, 0);
    view.seen(true);
  };
  const letGo = () => {
    keep();
    img.removeAttribute("src");
    view.moves(false);
  };
  life.listen(img, "load", keep);
  life.listen(document, "visibilitychange", () => {
    if (document.hidden) letGo();
    else begin();
  });
  life.atEnd(letGo);
  life.every(500, () => {
    if (over) return false;
    view.moves(img.naturalWidth > 0);
    if (img.naturalWidth) keep();
    else if (Date.now() - begun > 2 * kAgain_ms) begin();
    return true;
  });
  begin();
  return {
    again: begin,
    stop() {
      over = true;
      letGo();
    },
  };
}
