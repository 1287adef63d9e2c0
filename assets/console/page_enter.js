// The door: the token that the station said when the console was started.
import { me, post } from "./api.js";
import { h } from "./dom.js";
import { during, field } from "./parts.js";

export async function show({ root, open }) {
  open("Enter the console");
  const token = h("input", {
    type: "password",
    autocomplete: "off",
    required: true,
    spellcheck: "false",
  });
  const said = h("div", { class: "said" });
  const go = h("button", { type: "submit", class: "primary" }, "Enter");
  const enter = async () => {
    if (!token.value.trim()) throw new Error("Type the token first.");
    await post("/api/enter", { token: token.value.trim() });
    await me(true);
    location.hash = "#/station";
  };
  root.append(
    h(
      "form",
      {
        class: "card narrow",
        novalidate: true,
        onsubmit: (e) => {
          e.preventDefault();
          during(go, said, enter);
        },
      },
      h("p", {}, "This station keeps training records of people, so it asks for a token."),
      field(
        "Token",
        token,
        "It is in the file that was named when the console was started. " +
          "Whoever runs the station can tell you.",
      ),
      said,
      h("div", { class: "row" }, go),
    ),
  );
}
