// The door: the token that the station said when the console was started.
import { me, post } from "./api.js";
import { h } from "./dom.js";
import { doorForm } from "./parts.js";

export async function show({ root, open }) {
  open("Enter the console");
  const token = h("input", {
    type: "password",
    autocomplete: "off",
    required: true,
    spellcheck: "false",
  });
  const work = async () => {
    if (!token.value.trim()) throw new Error("Type the token first.");
    await post("/api/enter", { token: token.value.trim() });
    await me(true);
    location.hash = "#/station";
  };
  root.append(
    doorForm({
      about: "This station keeps training records of people, so it asks for a token (password).",
      label: "Token",
      control: token,
      hint:
        "It is in the file that was named when the console was started. " +
        "Whoever runs the station can tell you.",
      go: "Enter the console",
      work,
    }),
  );
}
