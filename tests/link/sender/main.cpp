#include <cstdio>
#include <exception>
#include <string>

#include "apps/link/outbox.h"

/// palpa_test_sender OUTBOX URL: sends what waits, patiently.
int main(int argc, char** argv) {
  if (argc != 3) return 2;
  try {
    using namespace palpa::link;
    const Endpoint endpoint = endpointOf(argv[2], false);
    Outbox outbox(argv[1]);
    LrsClient client(endpoint, {"teacher", "secret"}, {2, 2});
    const Sent sent = sendWaiting(outbox, endpoint, client, {12, 5'000'000});
    if (!sent.trouble.empty()) std::fprintf(stderr, "%s\n", sent.trouble.c_str());
    return sent.left == 0 ? 0 : 1;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
  }
}
