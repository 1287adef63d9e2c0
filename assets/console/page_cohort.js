// Everyone, or one group: which errors are common, who learns how.
import { list } from "./api.js";
import { h } from "./dom.js";
import { choice, field, notice } from "./parts.js";
import { awaitReport } from "./report_frame.js";

export async function show({ root, life, query, open }) {
  const group = query.get("group") || "";
  open("Cohort");
  const trainees = await list("/api/trainees"),
    groups = [...new Set(trainees.map((t) => t.group).filter(Boolean))].sort();
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
  const asked = trainees.filter((t) => !group || t.group === group);
  if (!asked.some((t) => Number(t.trials) > 0)) {
    report.append(
      notice(
        "none",
        group
          ? `Nobody in the group ${group} has a recorded trial yet.`
          : "There is no recorded trial yet. A session with a trainee adds to this report.",
      ),
      h("p", {}, h("a", { class: "button", href: "#/session" }, "Start a session")),
    );
    return;
  }
  awaitReport(
    life,
    `/api/cohort${group ? `?group=${encodeURIComponent(group)}` : ""}`,
    report,
    `Report on the cohort: ${group || "everyone"}`,
  );
}
