#include "apps/link/outbox.h"

#include <map>
#include <set>

#include <nlohmann/json.hpp>

#include "anatomy/base/error.h"
#include "anatomy/base/json_text.h"
#include "anatomy/base/sha256.h"
#include "anatomy/base/text_forms.h"
#include "anatomy/base/uuid.h"
#include "apps/link/statement.h"
#include "apps/runtime/clock.h"
#include "apps/training/trial_words.h"

namespace palpa::link {
namespace {

using nlohmann::json;

enum class Fate { stored, present, nothing_to_void, refused, later };

struct ReplyJudgement {
  Fate fate;
  std::string words;
};

json parsedBody(const LrsAnswer& answer) {
  json value = parsedOrDiscarded(answer.body);
  return value.is_discarded() ? json() : value;
}

std::string firstWords(const std::string& body) {
  constexpr std::size_t kEnough = 160;
  const std::string words = plainText(body.substr(0, body.find_first_of("\r\n")), kEnough);
  return words.empty() ? "no reason given" : words;
}

[[noreturn]] void fail(const LrsAnswer& answer, const Endpoint& endpoint) {
  if (answer.status == 401 || answer.status == 403)
    throw Error("refuses user or password", endpoint.text(),
                "Check --user, and the password in PALPA_XAPI_PASSWORD or ~/.netrc; statements are "
                "kept and sent later");
  throw Error("is not a learning record store (it answers " + std::to_string(answer.status) + ")",
              endpoint.text(),
              "Check the address: it ends before /statements; statements are kept and sent later");
}

/// What no store would say of one statement alone, but of all.
bool concernsAll(const LrsAnswer& a) {
  return a.status == 401 || a.status == 403 || a.status == 405 ||
         (a.status >= 300 && a.status < 400) || (a.status == 404 && !a.is_lrs);
}

bool isForLater(const LrsAnswer& a) {
  return a.status == 0 || a.status == 408 || a.status == 429 || a.status >= 500;
}

std::string troubleOf(const LrsAnswer& a) {
  return a.status == 0 ? a.trouble
         : !a.is_lrs   ? "the answer does not come from a learning record store"
                       : "it answers " + std::to_string(a.status) + " (" + firstWords(a.body) + ")";
}

/// It has a statement with this id: ours?
ReplyJudgement compared(LrsClient& client, const Letter& letter) {
  for (const bool voided : {false, true}) {
    const LrsAnswer there = client.get(letter.id, voided);
    if (isForLater(there)) return {Fate::later, troubleOf(there)};
    if (there.status != 200) continue;
    if (saysTheSame(parsedOrDiscarded(letter.body), parsedBody(there))) return {Fate::present, ""};
    return {Fate::refused, "another statement has this id already"};
  }
  return {Fate::refused, "the store reports that it has the statement but does not return it"};
}

/// A statement that never arrived need not be taken back, and a store may refuse to.
bool hasNothingToVoid(LrsClient& client, const Letter& letter) {
  const LrsAnswer there = client.get(letter.voids);
  return there.status == 404 && there.is_lrs && client.get(letter.voids, true).status == 404;
}

ReplyJudgement send(LrsClient& client, const Endpoint& endpoint, const Letter& letter) {
  if (!letter.voids.empty() && hasNothingToVoid(client, letter)) return {Fate::nothing_to_void, ""};
  const LrsAnswer answer = client.put(letter.id, letter.body);
  if (concernsAll(answer)) fail(answer, endpoint);
  if (isForLater(answer)) return {Fate::later, troubleOf(answer)};
  if (!answer.is_lrs) return {Fate::later, troubleOf(answer)};  // a page that asks for a login, say
  if (answer.status == 204) return {Fate::stored, ""};
  if (answer.status == 409) return compared(client, letter);
  return {Fate::refused, troubleOf(answer)};
}

ReplyJudgement sendPatiently(LrsClient& client, const Endpoint& endpoint, const Letter& letter,
                             const Pace& pace) {
  std::int64_t pause_ns = pace.pause_ns;
  for (int tries = pace.tries;; pause_ns *= 2) {
    ReplyJudgement verdict = send(client, endpoint, letter);
    if (verdict.fate != Fate::later || --tries <= 0) return verdict;
    runtime::SteadyClock().sleepUntil(pause_ns);
  }
}

}  // namespace

Sent sendWaiting(Outbox& outbox, const Endpoint& endpoint, LrsClient& client, const Pace& pace) {
  Sent sent;
  for (const Letter& letter : outbox.waiting(endpoint.text())) {
    const ReplyJudgement verdict = sendPatiently(client, endpoint, letter, pace);
    if (verdict.fate == Fate::later) {
      sent.trouble = verdict.words;
      break;
    }
    if (verdict.fate == Fate::refused) {
      sent.refused.push_back("session " + letter.session + ", trial " +
                             std::to_string(letter.trial) + ": " + verdict.words);
      continue;
    }
    outbox.delivered(endpoint.text(), letter.id);
    sent.delivered += verdict.fate == Fate::stored;
    sent.present += verdict.fate == Fate::present;
  }
  sent.left = outbox.waiting(endpoint.text()).size();
  return sent;
}

namespace {

std::string textOf(const nlohmann::json& statement) {
  return statement.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

void queueTrial(const record::TrialWithSession& t, const Route& route,
                const StatementFilter& filter, Outbox& outbox, Queued& queued) {
  if (t.session.simulated && !filter.simulated)
    ++queued.simulated;
  else if (training::isVoid(t.trial.outcome))
    ++queued.void_trials;
  else if (!isUuid(t.session.uuid))
    ++queued.no_uuid;
  else {
    const nlohmann::json statement = statementOf(t.session, t.trial, filter.home_page);
    const Letter letter{
        statement.at("id"), "", t.session.uuid, t.trial.number, sha256(t.session.trainee),
        textOf(statement)};
    ++(outbox.put(route, letter) ? queued.added : queued.known);
  }
}

}  // namespace

Queued queueTrials(record::RecordStore& store, const Route& route, const StatementFilter& filter,
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
  // A pseudonym may have been given anew: what was told of sessions that are there stays.
  const auto isGone = [&](const Letter& letter) {
    return wasDeleted(letter.person) && !store.session(letter.session);
  };
  const std::vector<Letter> told = outbox.sent(route);
  std::set<std::pair<std::string, std::int64_t>> void_now;
  if (!told.empty())
    store.eachTrial({}, [&](const record::TrialWithSession& t) {
      if (training::isVoid(t.trial.outcome)) void_now.insert({t.session.uuid, t.trial.number});
    });
  int taken = 0;
  for (const Letter& letter : told) {
    if (!isGone(letter) && !void_now.contains({letter.session, letter.trial})) continue;
    const nlohmann::json voiding = voidingOf(letter.id);
    outbox.takeBack(
        route, letter.id,
        {voiding.at("id"), letter.id, letter.session, letter.trial, "", textOf(voiding)});
    ++taken;
  }
  if (taken > 0) outbox.leaveNoTrace();
  return taken;
}

}  // namespace palpa::link
