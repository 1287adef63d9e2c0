#include "apps/learning/delivery.h"

#include "apps/link/lrs_client.h"

namespace palpa::learning {
namespace {

using nlohmann::json;

Delivered sendStatement(const json& statement, const Launch& launch) {
  link::LrsClient client(link::endpointOf(launch.endpoint, false), {.token = launch.token},
                         kPlatformTimes);
  const link::LrsAnswer answer = client.put(statement.at("id"), statement.dump());
  return deliveredBy(answer.status, answer.trouble);
}

}  // namespace

Delivered deliver(Launch& launch, Launches& launches, const Settings& settings,
                  const SigningKey& key, std::chrono::sys_seconds now) {
  const Platform* const platform = settings.named(launch.platform);
  Delivered last;
  if (!platform) last = {Delivery::refused, "the platform was removed from this console"};
  while (platform && !launch.due.empty() && last.how == Delivery::done) {
    const json& next = launch.due.front();
    last = launch.kind == PlatformKind::cmi5
               ? sendStatement(next, launch)
               : sendScore(next, launch.line_item, *platform, key, now);
    if (last.how != Delivery::done) break;
    launch.due.erase(launch.due.begin());
    launches.keep(launch);
  }
  if (last.how == Delivery::refused) {
    launch.trouble = last.words;
    launches.keep(launch);
  }
  return last;
}

}  // namespace palpa::learning
