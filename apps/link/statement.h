#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

#include "apps/record/store/record_store.h"

/// Trials as statements of the Experience API (xAPI 1.0.3, IEEE 9274.1.1 before its renaming).
namespace palpa::link {

/// Root of the names that Palpa coins: activities, extensions. ".invalid" belongs to nobody and
/// never will (RFC 2606); the verbs and the type of activity are ADL's.
inline constexpr char kNames[] = "https://palpa.invalid/xapi";

/// What a trial was, told of its trainee's pseudonym: an account at `home_page` (an IRI; the
/// centre's own, or kNames/trainees). verb: passed or failed where it was scored, terminated where
/// it was broken off, completed where it does not count. result: success, completion, duration,
/// score (needle: total penalty, lower is better; palpation: lumps found in per cent) and every
/// figure that applies as an extension. context: registration is the session, the study is its
/// grouping, simulated or not is an extension. What was simulated is another activity, so that no
/// summary mixes the two. The same trial gives the same statement. Throws Error for a session whose
/// UUID is none.
nlohmann::json statementOf(const record::StoredSession& session, const record::StoredTrial& trial,
                           const std::string& home_page);

/// Takes a statement back. Says who takes it back (this program), not whose it was; the same on
/// every station.
nlohmann::json voidingOf(const std::string& statement);

/// Whether a store that has `stored` under the same id has what was `told`: by actor, verb, object,
/// result, context and the instant; stores may add fields and rewrite names.
bool saysTheSame(const nlohmann::json& told, const nlohmann::json& stored);

/// A UUID of a trial's statement, from the trial's number in the namespace of its session: what is
/// reported twice is stored once. Throws Error where the session's UUID is invalid.
std::string statementId(const std::string& session, std::int64_t trial);
/// Of the statement that voids another.
std::string voidingId(const std::string& statement);

}  // namespace palpa::link
