// The film of the room beside a replay, where one was made, and its deletion.
import { get, post, url } from "./api.js";
import { confirmed } from "./dialog.js";
import { h, put } from "./dom.js";
import { during, notice } from "./parts.js";
import { RoomPictures } from "./replay_player.js";

/** Deletes the film of a whole session, when it is confirmed; `place` then says so. */
export function filmDeletion(session, place) {
  const said = h("div", { class: "said" });
  const forget = async () => {
    const yes = await confirmed(
      "Delete the film of the room?",
      "The film of this whole session is deleted. The report, the replay and the figures stay.",
      "Delete the film",
    );
    if (!yes) return;
    await post(url("/api/sessions", session, "room", "delete"), {});
    put(place, notice("good", "The film of the room is deleted."));
  };
  const button = h(
    "button",
    { type: "button", class: "quiet", onclick: () => during(button, said, forget) },
    "Delete the film",
  );
  return [said, button];
}

/** Null where the trial has none; else { node, at(t) }. */
export async function roomFilm(session, trial) {
  const pictures = await get(url("/api/sessions", session, "trials", String(trial), "room"));
  if (!Array.isArray(pictures) || pictures.length === 0) return null;
  const img = h("img", { alt: "The room at the chosen time", width: 640, height: 480 }),
    reel = new RoomPictures(img, session, pictures);
  const node = h(
    "section",
    { class: "card room-film", "aria-label": "The room" },
    h("figure", {}, img),
    h("h2", {}, "The room"),
    h("p", { class: "muted" }, "Filmed with the trainee's agreement. It is in no export."),
  );
  node.append(...filmDeletion(session, node));
  return { node, at: (t) => reel.at(t) };
}
