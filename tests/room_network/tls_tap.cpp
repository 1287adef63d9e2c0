// tls_tap INTERFACE [PORT]: listens in until SIGTERM, then says what went by, in a line. Exit code
// 0: beside ARP and ICMP nothing but TCP over IPv4, and in it TLS records only (RFC 8446, 5.1) from
// the first byte of each connection on; at PORT behind what asks PostgreSQL for TLS.
#include <linux/if_ether.h>
#include <linux/if_packet.h>
#include <net/if.h>
#include <netinet/in.h>
#include <netinet/ip.h>
#include <netinet/tcp.h>
#include <sys/socket.h>

#include <algorithm>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <string>
#include <tuple>
#include <vector>

namespace {

volatile std::sig_atomic_t ending = 0;

/// One direction of a connection: its bytes in order, each once, and whether they are TLS records.
class Flow {
 public:
  /// Before the first record these bytes may come, which say nothing: with them PostgreSQL asks for
  /// TLS, and agrees.
  void mayBeginWith(const std::string& opening) { opening_ = opening; }
  void take(std::uint32_t sequence, const std::uint8_t* bytes, std::size_t count, bool begins) {
    if (begins) {
      next_ = sequence + 1;
      begun_ = true;
      return;
    }
    if (count == 0) return;
    if (!begun_) {
      plain = "a connection whose beginning was not heard";
      return;
    }
    waiting_[sequence] = {bytes, bytes + count};
    for (auto at = waiting_.begin(); at != waiting_.end();) {
      const auto ahead = static_cast<std::int32_t>(next_ - at->first);
      if (ahead < 0) {
        ++at;
        continue;
      }
      const std::vector<std::uint8_t>& part = at->second;
      if (static_cast<std::size_t>(ahead) < part.size()) {
        pending_.insert(pending_.end(), part.begin() + ahead, part.end());
        next_ += static_cast<std::uint32_t>(part.size()) - static_cast<std::uint32_t>(ahead);
      }
      waiting_.erase(at);
      at = waiting_.begin();
    }
    read();
  }
  std::size_t records = 0, carried = 0;
  std::string plain;  ///< the beginning of what is no record; empty: all are

 private:
  void read() {
    constexpr std::size_t kHead = 5, kLongest = (1u << 14) + 256;
    if (!opening_.empty()) {
      if (pending_.size() < opening_.size()) return;
      if (std::equal(opening_.begin(), opening_.end(), pending_.begin(), isSame))
        pending_.erase(pending_.begin(),
                       pending_.begin() + static_cast<std::ptrdiff_t>(opening_.size()));
      opening_.clear();
    }
    while (pending_.size() >= kHead && plain.empty()) {
      const bool known = pending_[0] >= 20 && pending_[0] <= 23 && pending_[1] == 3;
      const std::size_t length = pending_[3] * 256u + pending_[4];
      if (!known || length > kLongest) {
        plain.assign(pending_.begin(),
                     pending_.begin() + std::min<std::size_t>(40, pending_.size()));
        return;
      }
      if (pending_.size() < kHead + length) return;
      pending_.erase(pending_.begin(),
                     pending_.begin() + static_cast<std::ptrdiff_t>(kHead + length));
      ++records;
      carried += kHead + length;
    }
  }
  static bool isSame(char a, std::uint8_t b) { return static_cast<std::uint8_t>(a) == b; }
  std::string opening_;
  bool begun_ = false;
  std::uint32_t next_ = 0;
  std::map<std::uint32_t, std::vector<std::uint8_t>> waiting_;
  std::vector<std::uint8_t> pending_;
};

using Ends = std::tuple<std::uint32_t, std::uint16_t, std::uint32_t, std::uint16_t>;

struct Wire {
  int records_port = 0;  ///< of PostgreSQL; 0: there is none
  std::map<Ends, Flow> flows;
  std::size_t others = 0;  ///< packets with content that are no TCP over IPv4

  /// Neighbours greet each other (ICMPv6, also behind options); nothing else is expected.
  void take6(const std::uint8_t* bytes) {
    constexpr int kNextHeader = 6, kOptions = 0;
    if (bytes[kNextHeader] != IPPROTO_ICMPV6 && bytes[kNextHeader] != kOptions) ++others;
  }

  void take(const std::uint8_t* bytes, std::size_t count) {
    iphdr ip{};
    if (count < sizeof ip) return;
    std::memcpy(&ip, bytes, sizeof ip);
    const std::size_t ip_size = ip.ihl * 4u, size = std::min<std::size_t>(ntohs(ip.tot_len), count);
    if (ip.version != 4) return;
    if (ip.protocol == IPPROTO_ICMP) return;
    tcphdr tcp{};
    if (ip.protocol != IPPROTO_TCP || size < ip_size + sizeof tcp) {
      ++others;
      return;
    }
    std::memcpy(&tcp, bytes + ip_size, sizeof tcp);
    const std::size_t data = ip_size + tcp.doff * 4u;
    if (size < data) return;
    const auto [at, is_new] = flows.try_emplace({ip.saddr, tcp.source, ip.daddr, tcp.dest});
    if (is_new && ntohs(tcp.dest) == records_port)
      at->second.mayBeginWith(std::string("\0\0\0\x08\x04\xd2\x16\x2f", 8));
    if (is_new && ntohs(tcp.source) == records_port) at->second.mayBeginWith("S");
    at->second.take(ntohl(tcp.seq), bytes + data, size - data, tcp.syn);
  }
};

int listenAt(const char* interface) {
  const int tap = socket(AF_PACKET, SOCK_DGRAM, htons(ETH_P_ALL));
  sockaddr_ll at{};
  at.sll_family = AF_PACKET;
  at.sll_protocol = htons(ETH_P_ALL);  // or what leaves here is not heard
  at.sll_ifindex = static_cast<int>(if_nametoindex(interface));
  if (tap < 0 || at.sll_ifindex == 0 ||
      bind(tap, reinterpret_cast<const sockaddr*>(&at), sizeof at) != 0)
    return -1;
  const int room = 64 << 20;
  setsockopt(tap, SOL_SOCKET, SO_RCVBUFFORCE, &room, sizeof room);
  const timeval look{0, 200'000};
  setsockopt(tap, SOL_SOCKET, SO_RCVTIMEO, &look, sizeof look);
  return tap;
}

std::size_t missed(int tap) {
  tpacket_stats stats{};
  socklen_t size = sizeof stats;
  getsockopt(tap, SOL_PACKET, PACKET_STATISTICS, &stats, &size);
  return stats.tp_drops;
}

}  // namespace

int main(int count, char** arguments) {
  const int tap = count >= 2 ? listenAt(arguments[1]) : -1;
  if (tap < 0) {
    std::perror("cannot listen there");
    return 2;
  }
  std::signal(SIGTERM, [](int) { ending = 1; });
  std::puts("listening");
  std::fflush(stdout);
  Wire wire;
  if (count >= 3) wire.records_port = std::atoi(arguments[2]);
  std::vector<std::uint8_t> packet(1 << 18);
  while (!ending) {
    sockaddr_ll from{};
    socklen_t length = sizeof from;
    const ssize_t size =
        recvfrom(tap, packet.data(), packet.size(), 0, reinterpret_cast<sockaddr*>(&from), &length);
    if (size > 0 && from.sll_protocol == htons(ETH_P_IPV6)) wire.take6(packet.data());
    if (size > 0 && from.sll_protocol == htons(ETH_P_IP))
      wire.take(packet.data(), static_cast<std::size_t>(size));
  }
  std::size_t records = 0, bytes = 0, plain = 0;
  for (const auto& [ends, flow] : wire.flows) {
    records += flow.records;
    bytes += flow.carried;
    if (flow.plain.empty()) continue;
    ++plain;
    std::printf("plain: %.40s\n", flow.plain.c_str());
  }
  std::printf(
      "%zu flows, %zu TLS records, %zu bytes; %zu flows not TLS, %zu packets not TCP, "
      "%zu missed\n",
      wire.flows.size(), records, bytes, plain, wire.others, missed(tap));
  return plain == 0 && wire.others == 0 && records > 0 && missed(tap) == 0 ? 0 : 1;
}
