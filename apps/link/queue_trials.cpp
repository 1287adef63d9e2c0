#include <map>
#include <set>

#include "apps/link/statement.h"
#include "apps/link/statement_id.h"
#include "apps/link/tell.h"
#include "apps/station/sha256.h"

namespace palpa::link {
namespace {

bool isVoid(const record::StoredTrial& trial) { return trial.outcome == "void"; }

std::string textOf(const nlohmann::json& statement) {
  return statement.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

void queueTrial(const record::TrialWithSession& t, const Route& route, const TellFilter& filter,
                Outbox& outbox, Queued& queued) {
  if (t.session.simulated && !filter.simulated)
    ++queued.simulated;
  else if (isVoid(t.trial))
    ++queued.void_trials;
  else if (!isUuid(t.session.uuid))
    ++queued.no_uuid;
  else {
    const nlohmann::json statement = statementOf(t.session, t.trial, filter.home_page);
    const Letter letter{
        statement.at("id"), "", t.session.uuid, t.trial.number, station::sha256(t.session.trainee),
        textOf(statement)};
    ++(outbox.put(route, letter) ? queued.added : queued.known);
  }
}

}  // namespace

Queued queueTrials(record::RecordStore& store, const Route& route, const TellFilter& filter,
                   Outbox& outbox) {
  Queued queued;
  for (const record::Trainee& person : filter.who)
    for (const record::TrialWithSession& t : store.trials({.trainee = person.id}))
      queueTrial(t, route, filter, outbox, queued);
  return queued;
}

int takeBackDeleted(record::RecordStore& store, const Route& route, Outbox& outbox) {
  std::map<std::string, bool> deleted;
  const auto wasDeleted = [&](const std::string& person) {
    const auto known = deleted.find(person);
    return known != deleted.end() ? known->second
                                  : deleted.emplace(person, store.wasDeleted(person)).first->second;
  };
  const std::vector<Letter> told = outbox.told(route);
  std::set<std::pair<std::string, std::int64_t>> void_now;
  if (!told.empty())
    for (const record::TrialWithSession& t : store.trials())
      if (isVoid(t.trial)) void_now.insert({t.session.uuid, t.trial.number});
  int taken = 0;
  for (const Letter& letter : told) {
    if (!wasDeleted(letter.person) && !void_now.contains({letter.session, letter.trial})) continue;
    const nlohmann::json voiding = voidingOf(letter.id);
    outbox.takeBack(
        route, letter.id,
        {voiding.at("id"), letter.id, letter.session, letter.trial, "", textOf(voiding)});
    ++taken;
  }
  return taken;
}

}  // namespace palpa::link
