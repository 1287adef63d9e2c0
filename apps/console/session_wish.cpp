#include "anatomy/geometry/error.h"
#include "apps/console/sessions.h"
#include "apps/record/store/record_store.h"

namespace palpa::console {
namespace {

std::string textIn(const nlohmann::json& asked, const char* field, const std::string& otherwise) {
  if (!asked.contains(field)) return otherwise;
  if (!asked[field].is_string()) throw UsageError("is no text", field, "Load the page again");
  return asked[field];
}

bool flagIn(const nlohmann::json& asked, const char* field, bool otherwise) {
  if (!asked.contains(field)) return otherwise;
  if (!asked[field].is_boolean())
    throw UsageError("is neither true nor false", field, "Load the page again");
  return asked[field];
}

std::uint64_t numberIn(const nlohmann::json& asked, const char* field, std::uint64_t otherwise,
                       std::uint64_t least, std::uint64_t most) {
  if (!asked.contains(field)) return otherwise;
  const auto& value = asked[field];
  if (!value.is_number_unsigned() || value.get<std::uint64_t>() < least ||
      value.get<std::uint64_t>() > most)
    throw UsageError(
        "is no whole number from " + std::to_string(least) + " to " + std::to_string(most), field,
        "Change it");
  return value;
}

void requireOneOf(const std::string& value, const char* field,
                  std::initializer_list<const char*> known) {
  std::string names;
  for (const char* name : known) {
    if (value == name) return;
    names += names.empty() ? name : std::string(", ") + name;
  }
  throw UsageError("is none of " + names, field, "Choose one of them");
}

}  // namespace

SessionWish readWish(const nlohmann::json& asked) {
  constexpr std::uint64_t kMostSeed = 1'000'000'000;
  SessionWish wish;
  wish.task = textIn(asked, "task", "");
  if (!isId(wish.task)) throw UsageError("was not chosen", "task", "Choose one");
  wish.trainee = textIn(asked, "trainee", "");
  if (!wish.trainee.empty())
    if (const std::string why = record::whyNoPseudonym(wish.trainee); !why.empty())
      throw UsageError(why, "trainee", "Choose one of the list");
  wish.performer = textIn(asked, "operator", "person");
  requireOneOf(wish.performer, "operator", {"person", "expert", "novice"});
  wish.side = textIn(asked, "side", "right");
  requireOneOf(wish.side, "side", {"right", "left"});
  wish.assess = flagIn(asked, "assess", false);
  wish.force_feedback = flagIn(asked, "force_feedback", true);
  wish.trials = static_cast<int>(numberIn(asked, "trials", 1, 1, 50));
  wish.seed = numberIn(asked, "seed", 1, 0, kMostSeed);
  wish.patient_seed = numberIn(asked, "patient_seed", 0, 0, kMostSeed);
  return wish;
}

}  // namespace palpa::console
