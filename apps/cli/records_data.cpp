#include <algorithm>
#include <cstdio>

#include "anatomy/geometry/error.h"
#include "apps/cli/deliver_evidence.h"
#include "apps/cli/output_folder.h"
#include "apps/cli/records_actions.h"
#include "apps/cli/records_place.h"
#include "apps/link/data_files.h"
#include "apps/link/statement.h"
#include "apps/link/tell.h"

namespace palpa::cli {
namespace {

using People = std::vector<record::Trainee>;

People chosen(record::RecordStore& store, const RecordsOptions& o) {
  if (o.trainee.id.empty() != o.all)
    throw UsageError("says whose records are meant", "--id or --all", "Give one of them");
  return o.all ? store.trainees() : People{traineeIn(store, o.trainee.id)};
}

/// Keeps who has agreed; says how many are left out.
void keepAgreed(People& people, std::string record::Trainee::*consent, const char* to_what) {
  const std::size_t before = people.size();
  std::erase_if(people, [consent](const record::Trainee& t) { return (t.*consent).empty(); });
  if (const std::size_t out = before - people.size(); out > 0)
    std::printf("Left out: %s who %s not agreed to %s\n", counted(out, "trainee").c_str(),
                out == 1 ? "has" : "have", to_what);
}

link::DataFormat formatOf(const std::string& name) {
  return name == "csv"    ? link::DataFormat::csv
         : name == "json" ? link::DataFormat::json
                          : link::DataFormat::both;
}

void sayQueued(const link::Queued& q) {
  std::printf("%s queued, %d known already\n",
              counted(static_cast<std::size_t>(q.added), "statement").c_str(), q.known);
  if (q.simulated > 0)
    std::printf("Left out: %s of simulated sessions (--simulated tells of them, too)\n",
                counted(static_cast<std::size_t>(q.simulated), "trial").c_str());
  if (q.void_trials > 0)
    std::printf("Left out: %s that do not count (void)\n",
                counted(static_cast<std::size_t>(q.void_trials), "trial").c_str());
  if (q.no_uuid > 0)
    std::printf("Left out: %s of sessions without a UUID\n",
                counted(static_cast<std::size_t>(q.no_uuid), "trial").c_str());
}

void queue(const RecordsOptions& o, const link::Route& route, link::Outbox& outbox) {
  record::RecordStore store(o.url);
  if (const int back = link::takeBackDeleted(store, route, outbox); back > 0)
    std::printf("%s taken back: deleted people, void trials\n",
                counted(static_cast<std::size_t>(back), "statement").c_str());
  if (!o.all && o.trainee.id.empty()) return;  // what waits is sent
  link::TellFilter filter{
      chosen(store, o), o.simulated,
      o.home_page.empty() ? std::string(link::kNames) + "/trainees" : o.home_page};
  keepAgreed(filter.who, &record::Trainee::consent_utc, "keeping training records");
  sayQueued(link::queueTrials(store, route, filter, outbox));
}

}  // namespace

void exportRecords(const RecordsOptions& o) {
  requireRecords(o.url);
  record::RecordStore store(o.url);
  People people = chosen(store, o);
  if (o.research) keepAgreed(people, &record::Trainee::research_utc, "use in studies");
  const link::Dataset data = link::datasetOf(store, people);
  const std::filesystem::path folder = makeOutputFolder(o.out, "records");
  const auto written = link::writeTables(link::tablesOf(data, o.paths), formatOf(o.format), folder);
  const auto simulated = std::count_if(data.sessions.begin(), data.sessions.end(),
                                       [](const record::StoredSession& s) { return s.simulated; });
  std::printf("%s, %s (%lld simulated), %s\n", counted(people.size(), "trainee").c_str(),
              counted(data.sessions.size(), "session").c_str(), static_cast<long long>(simulated),
              counted(data.trials.size(), "trial").c_str());
  std::printf("Written to %s:\n", folder.string().c_str());
  for (const std::string& name : written) std::printf("  %s\n", name.c_str());
}

void tellRecords(const RecordsOptions& o) {
  const link::Endpoint endpoint = link::endpointOf(o.to, o.insecure);
  const link::Login login = link::loginFor(endpoint.host, o.user);
  link::Outbox outbox(link::Outbox::usualFile());
  queue(o, {endpoint.text(), absoluteRecords(o.url)}, outbox);
  link::LrsClient client(endpoint, login);
  const link::Sent sent = link::sendWaiting(outbox, endpoint, client);
  std::printf("%s: %s delivered, %d there already, %zu waiting\n", endpoint.text().c_str(),
              counted(static_cast<std::size_t>(sent.delivered), "statement").c_str(), sent.present,
              sent.left);
  if (!sent.trouble.empty())
    throw Error("cannot be told now (" + sent.trouble + ")", endpoint.text(),
                "What waits is kept on this station; the same command sends it later");
  if (!sent.refused.empty())
    throw Error("does not take " + counted(sent.refused.size(), "statement") + " (" +
                    sent.refused.front() + ")",
                endpoint.text(), "Everything else was delivered; ask whoever runs it");
}

}  // namespace palpa::cli
