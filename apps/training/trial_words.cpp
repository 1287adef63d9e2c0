#include "apps/training/trial_words.h"

#include "anatomy/base/enum_names.h"

namespace palpa::training {
namespace {

const EnumNames<Role> kRoles{"",       "scored",    "assessed", "familiarisation", "demonstration",
                             "guided", "not scored"};

const EnumNames<Outcome> kOutcomes{"",         "success", "done", "time",      "passes",
                                   "mistaken", "aborted", "void", "not scored"};

}  // namespace

const std::string& nameOf(Role role) { return kRoles.of(role); }

const std::string& nameOf(Outcome outcome) { return kOutcomes.of(outcome); }

Role roleNamed(std::string_view name) { return kRoles.named(name).value_or(Role::not_scored); }

Outcome outcomeNamed(std::string_view name) {
  return kOutcomes.named(name).value_or(Outcome::none);
}

bool isVoid(std::string_view outcome) { return outcomeNamed(outcome) == Outcome::voided; }

bool countsAsScored(Role role) { return role == Role::scored || role == Role::assessed; }
bool countsAsScored(Role role, Outcome outcome) {
  return countsAsScored(role) && outcome != Outcome::voided;
}

bool inAssessment(Role role) { return role == Role::assessed; }

}  // namespace palpa::training
