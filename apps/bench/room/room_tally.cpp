#include "apps/bench/room/room_tally.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <set>

#include "anatomy/base/error.h"
#include "anatomy/base/json_text.h"
#include "apps/evidence/told_events.h"
#include "apps/live/live_sink.h"
#include "apps/record/session_file.h"

namespace palpa::bench {
namespace {

namespace fs = std::filesystem;

/// Times are told to the millisecond.
bool isSame(const ToldEvent& a, const ToldEvent& b) {
  return a.event == b.event && std::abs(a.t_s - b.t_s) < 1e-6;
}

void addLines(const fs::path& page, const std::string& station, ByRecord* all) {
  std::ifstream in(page);
  for (std::string line; std::getline(in, line);) {
    const nlohmann::json entry = parsedOrDiscarded(line);
    if (!entry.is_object() || !entry.contains("event") || entry.value("station", "") != station)
      continue;
    const nlohmann::json& event = entry["event"];
    (*all)[event.value("record", "")].push_back({event.value("number", std::int64_t{-1}),
                                                 event.value("t_s", 0.0),
                                                 event.value("event", "")});
  }
}

void addEvents(const record::SessionReader& reader, ByRecord* all) {
  std::vector<ToldEvent>& events = (*all)[reader.info().uuid];
  for (const runtime::Event& event : reader.events())
    if (!live::eventEntry(event, evidence::toneOfEvent).empty())
      events.push_back(
          {static_cast<std::int64_t>(events.size()), live::secondsOf(event.t_ns), event.kind});
}

void addRecord(const std::vector<ToldEvent>& recorded, const std::vector<ToldEvent>& arrived,
               RoomTally* tally) {
  std::set<std::int64_t> seen;
  std::int64_t last = -1;
  for (const ToldEvent& one : arrived) {
    tally->disordered += one.number < last;
    last = std::max(last, one.number);
    if (!seen.insert(one.number).second) {
      ++tally->doubled;
    } else if (one.number < 0 || one.number >= static_cast<std::int64_t>(recorded.size())) {
      ++tally->beyond;
    } else if (isSame(one, recorded[static_cast<std::size_t>(one.number)])) {
      ++tally->arrived;
    } else {
      ++tally->changed;
    }
  }
  for (const ToldEvent& one : recorded) tally->missing += !seen.contains(one.number);
  tally->recorded += static_cast<std::int64_t>(recorded.size());
  ++tally->records;
}

}  // namespace

ByRecord recordedIn(const fs::path& home, std::int64_t* cut_off) {
  ByRecord all;
  std::error_code none;
  for (const auto& session : fs::directory_iterator(home / "sessions", none)) {
    if (!fs::exists(session.path() / "session.palpa", none)) continue;  // ended before it began
    try {
      addEvents(record::SessionReader(session.path() / "session.palpa"), &all);
    } catch (const Error&) {
      if (cut_off) ++*cut_off;
    }
  }
  return all;
}

ByRecord arrivedFrom(const std::string& station, const fs::path& watch) {
  ByRecord all;
  for (const char* page : {"events-before.jsonl", "events.jsonl"})
    addLines(watch / page, station, &all);
  return all;
}

void add(const ByRecord& recorded, const ByRecord& arrived, RoomTally* tally) {
  ByRecord both = arrived;
  for (const auto& [record, events] : recorded) {
    addRecord(events, both[record], tally);
    both.erase(record);
  }
  for (const auto& [record, events] : both)
    tally->beyond += static_cast<std::int64_t>(events.size());
}

}  // namespace palpa::bench
