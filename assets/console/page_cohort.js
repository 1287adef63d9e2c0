// Everyone, or one group: which errors are common, who learns how.
import { list } from "./api.js";
import { h } from "./dom.js";
import { choice, field } from "./parts.js";
import { awaitReport } from "./report_frame.js";

export async function show({ root, life, query, open }) {
  const group = query.get("group") || "";
  open("Cohort");
  const groups = [
    ...new Set((await list("/api/trainees")).map((t) => t.group).filter(Boolean)),
  ].sort();
  if (group && !groups.includes(group)) groups.push(group);
  const select = choice([["", "everyone"], ...groups.map((g) => [g, g])], group);
  const report = h("div", {});
  const go = (e) => {
    e.preventDefault();
    location.hash = select.value
      ? `#/cohort?group=${encodeURIComponent(select.value)}`
      : "#/cohort";
  };
  root.append(
    h(
      "form",
      { class: "row card no-print", onsubmit: go },
      field("Group", select),
      h("button", { type: "submit" }, "Show"),
      h("p", { class: "hint" }, "Pseudonyms only; void trials do not count."),
    ),
    report,
  );
  awaitReport(
    life,
    `/api/cohort${group ? `?group=${encodeURIComponent(group)}` : ""}`,
    report,
    `Report on the cohort: ${group || "everyone"}`,
  );
}
