// What hostile clients do.

#include <algorithm>
#include <memory>
#include <system_error>
#include <thread>

#include "hostile/attacks.h"
#include "support/raw_client.h"

namespace hostile {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;
using test_support::RawClient;

const std::string kVersion2 = {'X', 2};

// A frame's header for version 2.
std::string header(char kind, unsigned size) {
  return {kind,
          0,
          0,
          1,
          static_cast<char>(size >> 24U),
          static_cast<char>(size >> 16U),
          static_cast<char>(size >> 8U),
          static_cast<char>(size)};
}

std::string anyBytes(Random& random, int most) {
  std::string bytes(static_cast<std::size_t>(std::uniform_int_distribution<int>(1, most)(random)), '\0');
  std::generate(bytes.begin(), bytes.end(), [&] { return static_cast<char>(random()); });
  return bytes;
}

std::string anyRequest(Random& random) {
  static const std::string kinds = "HFWJVTIKLPUDNQRXZGMYBA";  // the motors stay on
  const std::string payload = anyBytes(random, 300);
  return header(kinds[random() % kinds.size()], static_cast<unsigned>(payload.size())) + payload;
}

std::string anySize(Random& random) {
  return header('U', static_cast<unsigned>(random()) | 0x10000U);
}

/// The server may have turned the client away. Then there is no connection.
std::unique_ptr<RawClient> connectTo(int port, const std::string& first) {
  try {
    auto client = std::make_unique<RawClient>(port);
    return client->send(first) ? std::move(client) : nullptr;
  } catch (const std::system_error&) {
    return nullptr;
  }
}

}  // namespace

const std::vector<ClientAttack>& clientAttacks() {
  static const std::vector<ClientAttack> attacks = {
      {"nonsense", false, 1, true, "", [](Random& random) { return anyBytes(random, 5000); }},
      {"payloads", false, 1, true, kVersion2, anyRequest},
      {"sizes", false, 1, true, kVersion2, anySize},
      {"unread", false, 1, false, kVersion2, [](Random&) { return header('H', 0) + header('N', 0); }},
      {"half", false, 1, false, kVersion2 + header('U', 60000), nullptr},
      {"connections", false, 100, false, "", nullptr},
      {"console-commands", true, 1, true, "", [](Random& random) { return anyBytes(random, 60) + "\n"; }},
      {"console-listeners", true, 20, false, "", nullptr},
  };
  return attacks;
}

void carryOut(const ClientAttack& attack, int port, Random& random, TimePoint end) {
  std::vector<std::unique_ptr<RawClient>> clients(static_cast<std::size_t>(attack.clients));
  do {
    for (auto& client : clients) {
      if (!client) {
        client = connectTo(port, attack.first);
      }
      const bool is_open = client && (!attack.more || client->send(attack.more(random)));
      const auto answer = is_open && attack.reads ? client->receive(milliseconds(0)) : std::nullopt;
      if (!is_open || (answer && answer->empty())) {
        client.reset();  // the server has ended the connection
      }
    }
    if (!attack.reads) {
      std::this_thread::sleep_for(milliseconds(1));  // nothing more can be sent soon
    }
  } while (steady_clock::now() < end);
}

}  // namespace hostile
