#include <algorithm>
#include <map>
#include <set>

#include "anatomy/base/counted.h"
#include "anatomy/base/error.h"
#include "apps/console/routes.h"
#include "apps/record/store/record_store.h"
#include "apps/record/store/study_store.h"
#include "apps/station/assets.h"
#include "apps/study/progress.h"

namespace palpa::console {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
constexpr std::size_t kLongestWords = 80;

std::string wordsIn(const json& body, const char* field) {
  if (!body.contains(field)) return "";
  if (!body[field].is_string()) throw UsageError("is not text", field, "Load the page again");
  std::string text = body[field];
  if (text.size() > kLongestWords)
    throw UsageError("is longer than 80 characters", field, "Shorten it");
  if (std::any_of(text.begin(), text.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; }))
    throw UsageError("holds control characters", field, "Write it in one line");
  return text;
}

record::Trainee traineeIn(const json& body) {
  record::Trainee one;
  one.id = wordsIn(body, "id");
  if (const std::string why = record::whyNoPseudonym(one.id); !why.empty())
    throw UsageError(why, "pseudonym", "Use letters, digits, - and _");
  one.group = wordsIn(body, "group");
  one.experience = wordsIn(body, "experience");
  if (const std::string hand = wordsIn(body, "handedness"); !hand.empty()) one.handedness = hand;
  if (one.handedness != "right" && one.handedness != "left")
    throw UsageError("is neither right nor left", "handedness", "Choose one");
  one.added_utc = utcNow();
  const auto agreed = [&](const char* field) {
    return body.value(field, json()).is_boolean() && body[field].get<bool>() ? one.added_utc : "";
  };
  one.consent_utc = agreed("consent");
  one.research_utc = agreed("research");
  return one;
}

json trainees(record::RecordStore& store) {
  std::map<std::string, record::Tally> counts;
  for (const record::Tally& tally : store.tallies()) counts[tally.trainee] = tally;
  json all = json::array();
  for (const record::Trainee& t : store.trainees())
    all.push_back({{"id", t.id},
                   {"group", t.group},
                   {"experience", t.experience},
                   {"handedness", t.handedness},
                   {"added_utc", t.added_utc},
                   {"consent_utc", t.consent_utc},
                   {"research_utc", t.research_utc},
                   {"retain_until", t.retain_until},
                   {"sessions", counts[t.id].sessions},
                   {"trials", counts[t.id].trials}});
  return all;
}

std::vector<fs::path> protocolFiles() {
  std::vector<fs::path> all;
  for (const auto& entry : fs::directory_iterator(station::assetFile("protocols")))
    if (entry.path().extension() == ".json") all.push_back(entry.path());
  std::sort(all.begin(), all.end());
  return all;
}

/// A page made by a command of this program, as somebody asks for it; made anew when the records
/// have changed since.
json report(Console& c, const std::string& key, const std::string& title,
            std::vector<std::string> arguments, const std::string& page) {
  JobRequest request{key, title, std::move(arguments), "report/" + page, {}};
  for (const fs::path& file : protocolFiles())
    if (const study::Protocol protocol = study::readProtocol(file); protocol.blind_educator)
      request.arguments.push_back("--leave-out-study=" + protocol.id);
  request.arguments.insert(request.arguments.end(),
                           {"--records", c.place.records, "--out", "{}/report"});
  return pageOf(c.jobs.ask(std::move(request)));
}

/// Changes with every trial that comes into the records.
std::string stateOfRecords(record::RecordStore& store, const std::string& trainee) {
  std::int64_t trials = 0;
  for (const record::Tally& tally : store.tallies(trainee)) trials += tally.trials;
  return std::to_string(trials);
}

/// What an educator can start now; empty: nothing.
std::string startable(const study::Next& next) {
  if (next.kind != study::NextKind::trials) return "";
  if (!next.not_before.empty() && next.not_before > utcNow()) return "";
  return counted(next.trials, "trial");
}

/// What has to be done elsewhere before a block can be.
std::string elsewhere(const study::Protocol& protocol, const study::Next& next,
                      const std::string& trainee) {
  if (next.kind != study::NextKind::questionnaire) return "";
  return "The questionnaire is answered at the station's terminal: palpa study run --protocol " +
         protocol.id + ".json --trainee " + trainee;
}

json enrolled(const study::Protocol& protocol, record::RecordStore& store,
              const record::Enrolment& e) {
  std::vector<study::DoneTrial> trials;
  bool simulated = e.simulated;
  for (const record::TrialWithSession& t :
       store.trials({.trainee = e.trainee, .study = protocol.id})) {
    trials.push_back(study::doneTrial(t.session, t.trial));
    simulated = simulated || t.session.simulated;
  }
  std::vector<std::pair<int, std::string>> answered;
  for (const record::ItemAnswer& a : record::StudyStore(store).answers(protocol.id, e.trainee))
    answered.emplace_back(static_cast<int>(a.session), a.item);
  const study::Next next = study::nextOf(protocol, e.condition, trials, answered, utcNow());
  json remarks = next.remarks;
  if (const std::string first = elsewhere(protocol, next, e.trainee); !first.empty())
    remarks.push_back(first);
  return {{"trainee", e.trainee},
          {"group", e.group},
          {"where", study::whereIs(protocol, next)},
          {"next", startable(next)},
          {"finished", next.kind == study::NextKind::finished},
          {"simulated", simulated},
          {"remarks", remarks}};
}

fs::path protocolFile(const std::string& id) {
  for (const fs::path& file : protocolFiles())
    if (study::readProtocol(file).id == id) return file;
  throw UsageError("is not here", "study " + id.substr(0, 64), "Choose one from the list");
}

json studies(Console& c) {
  record::RecordStore store(c.place.records);
  record::StudyStore kept(store);
  json all = json::array();
  for (const fs::path& file : protocolFiles()) {
    const study::Protocol protocol = study::readProtocol(file);
    json one{{"id", protocol.id},
             {"title", protocol.title},
             {"groups", json::array()},
             {"places", json::array()},
             {"enrolled", json::array()}};
    for (const study::Group& group : protocol.groups) {
      one["groups"].push_back(group.name);
      one["places"].push_back(
          {{"group", group.name}, {"given", kept.placesGiven(protocol.id, group.name)}});
    }
    for (const record::Enrolment& e : kept.enrolments(protocol.id))
      one["enrolled"].push_back(enrolled(protocol, store, e));
    all.push_back(std::move(one));
  }
  return all;
}

/// Where its blocks are held. One command leads through them, with one station; where they need
/// several, each is held on the virtual bench of its kind.
std::set<StationKind> stationKindsOf(const study::Protocol& protocol) {
  std::set<StationKind> kinds;
  for (const study::Session& session : protocol.sessions)
    for (const study::Block& block : session.blocks) kinds.insert(stationKindOf(block.engine));
  return kinds;
}

/// The next block of somebody: the command enrols, draws and leads; its condition is nobody's to
/// see.
std::string runStudy(Console& c, const std::string& id, const json& body) {
  SessionWish wish;
  wish.protocol = protocolFile(id).string();
  const study::Protocol protocol = study::readProtocol(wish.protocol);
  wish.blind = protocol.blind_educator;
  wish.task = id;
  wish.title = protocol.title;
  wish.trainee = wordsIn(body, "trainee");
  if (const std::string why = record::whyNoPseudonym(wish.trainee); !why.empty())
    throw UsageError(why, "trainee", "Choose one from the list");
  wish.performer = wordsIn(body, "operator");
  if (wish.performer != "person" && wish.performer != "expert" && wish.performer != "novice")
    throw UsageError("is not person, expert or novice", "who performs", "Choose one of them");
  const std::set<StationKind> kinds = stationKindsOf(protocol);
  wish.simulated = std::any_of(kinds.begin(), kinds.end(), [&](StationKind kind) {
    return isSimulated(c.place, kind, wish.performer);
  });
  std::vector<std::string> arguments{"study",     "run",          "--protocol", wish.protocol,
                                     "--trainee", wish.trainee,   "--operator", wish.performer,
                                     "--records", c.place.records};
  if (kinds.size() == 1) addStation(c.place, *kinds.begin(), &arguments);
  if (wish.performer != "person" || !c.place.display)
    arguments.insert(arguments.end(), {"--display", "offscreen"});
  return c.sessions.begin(wish, std::move(arguments));
}

}  // namespace

void addPeopleRoutes(WebServer& server, Console& c) {
  server.Get("/api/trainees", [&c](const httplib::Request&, httplib::Response& r) {
    record::RecordStore store(c.place.records);
    answer(r, trainees(store));
  });
  server.Post("/api/trainees", [&c](const httplib::Request& q, httplib::Response& r) {
    record::RecordStore store(c.place.records);
    const record::Trainee one = traineeIn(bodyOf(q));
    if (store.trainee(one.id))
      return refuse(r, 409, "the pseudonym " + one.id + " is taken: choose another");
    store.addTrainee(one);
    answer(r, {{"id", one.id}}, 201);
  });
  server.Post(R"(/api/trainees/([A-Za-z0-9_-]{1,32})/research)",
              [&c](const httplib::Request& q, httplib::Response& r) {
                const json body = bodyOf(q);
                if (!body.value("agrees", json()).is_boolean())
                  throw UsageError("is neither true nor false", "agrees", "Load the page again");
                record::RecordStore store(c.place.records);
                std::optional<record::Trainee> one = store.trainee(q.matches[1]);
                if (!one) return refuse(r, 404, "is not in the records");
                one->research_utc = body["agrees"].get<bool>() ? utcNow() : "";
                store.changeTrainee(*one);
                answer(r, {{"research_utc", one->research_utc}});
              });
  server.Get(R"(/api/trainees/([A-Za-z0-9_-]{1,32})/report)", [&c](const httplib::Request& q,
                                                                   httplib::Response& r) {
    const std::string id = q.matches[1];
    record::RecordStore store(c.place.records);
    if (!store.trainee(id)) return refuse(r, 404, "trainee " + id + " is not in the records");
    answer(r, report(c, "trainee " + id + " " + stateOfRecords(store, id), "Report of " + id,
                     {"report", "trainee", "--id", id}, "trainee.html"));
  });
  server.Get("/api/cohort", [&c](const httplib::Request& q, httplib::Response& r) {
    const std::string group = q.get_param_value("group");
    record::RecordStore store(c.place.records);
    const auto all = store.trainees();
    if (!group.empty() && std::none_of(all.begin(), all.end(),
                                       [&](const record::Trainee& t) { return t.group == group; }))
      return refuse(r, 404, "nobody in this group is in the records");
    std::vector<std::string> arguments{"report", "cohort"};
    if (!group.empty()) arguments.push_back("--group=" + group);
    answer(r, report(c, "cohort " + group + " " + stateOfRecords(store, ""), "Report of the cohort",
                     std::move(arguments), "cohort.html"));
  });
  server.Get("/api/studies",
             [&c](const httplib::Request&, httplib::Response& r) { answer(r, studies(c)); });
  server.Post(R"(/api/studies/([A-Za-z0-9_-]{1,64})/run)",
              [&c](const httplib::Request& q, httplib::Response& r) {
                answer(r, {{"session", runStudy(c, q.matches[1], bodyOf(q))}}, 201);
              });
}

}  // namespace palpa::console
