// What hostile clients do.

#include <algorithm>
#include <memory>
#include <system_error>
#include <thread>

#include "hostile/attacks.h"
#include "support/raw_client.h"
#include "support/udp_socket.h"

namespace hostile {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;
using test_support::RawClient;
using test_support::UdpSocket;

const std::string kVersion2 = {'X', 2};

std::string bigEndian(unsigned value) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) {
    bytes += static_cast<char>(value >> shift & 0xFF);
  }
  return bytes;
}

// A frame's header for version 2.
std::string header(char kind, unsigned size) {
  return std::string({kind, 0, 0, 1}) + bigEndian(size);
}

std::string anyBytes(Random& random, int most) {
  std::string bytes(static_cast<std::size_t>(std::uniform_int_distribution<int>(1, most)(random)), '\0');
  std::generate(bytes.begin(), bytes.end(), [&] { return static_cast<char>(random()); });
  return bytes;
}

/// The server may have turned the client away: then nobody is there.
std::unique_ptr<RawClient> connectTo(int port) {
  try {
    return std::make_unique<RawClient>(port);
  } catch (const std::system_error&) {
    return nullptr;
  }
}

/// Sends what `more` makes until the server ends the connection, and then again over a new one.
/// @param first what each connection begins with
/// @param reads whether the answers are read
template <typename More>
void sendAgainAndAgain(int port, const std::string& first, bool reads, TimePoint end, const More& more) {
  while (steady_clock::now() < end) {
    const auto client = connectTo(port);
    bool open = client && client->send(first);
    while (open && steady_clock::now() < end) {
      open = client->send(more());
      if (reads) {
        const auto answer = client->receive(milliseconds(0));
        open = open && !(answer && answer->empty());
      } else {
        std::this_thread::sleep_for(milliseconds(1));  // nothing more can be sent soon
      }
    }
    std::this_thread::sleep_for(milliseconds(1));
  }
}

/// Each connection sends what `some` makes once, and stays open until the server ends it, or for 20 ms.
template <typename Some>
void sendOnceEach(int port, TimePoint end, const Some& some) {
  do {
    const auto client = connectTo(port);
    if (client && client->send(some())) {
      client->receive(milliseconds(20));
    }
  } while (steady_clock::now() < end);
}

/// One byte of this every 20 ms, again and again.
void drip(int port, const std::string& bytes, TimePoint end) {
  while (steady_clock::now() < end) {
    const auto client = connectTo(port);
    for (std::size_t i = 0; client && i < bytes.size() && steady_clock::now() < end && client->send({bytes[i]}); ++i) {
      std::this_thread::sleep_for(milliseconds(20));
    }
    std::this_thread::sleep_for(milliseconds(1));
  }
}

/// Many connections at once, all of which only wait.
void hold(int port, int count, const std::string& bytes, TimePoint end) {
  std::vector<std::unique_ptr<RawClient>> clients;
  for (int i = 0; i < count; ++i) {
    clients.push_back(connectTo(port));
    if (clients.back()) {
      clients.back()->send(bytes);
    }
  }
  std::this_thread::sleep_until(end);
}

// Asks for version 2 and moves the tail.
std::string moveTail() {
  return kVersion2 + header('J', 12) + std::string({0, 0, 1, 0, 52, 0, 0, 0, 0, 0x0D, char(0xBB), char(0xA0)});
}

// A browser's request whose body does so.
std::string http(const std::string& method) {
  const std::string body = moveTail();
  return method + " / HTTP/1.1\r\nHost: 127.0.0.1\r\nContent-Type: text/plain\r\nContent-Length: " +
         std::to_string(body.size()) + "\r\n\r\n" + body;
}

// Methods that a page makes up, of letters that requests begin with.
std::string anyMethod(Random& random) {
  static const std::string letters = "FWJSVALYKQRUDPCX";
  std::string method(1 + random() % 2000, 'A');
  std::generate(method.begin(), method.end(), [&] { return letters[random() % letters.size()]; });
  return random() % 2 == 0 ? method : method.substr(0, 1 + random() % 8);
}

// STUN over TCP (RFC 5389, RFC 4571), which a page makes a browser send by WebRTC; the user name is the page's choice.
std::string stun(Random& random) {
  const std::string name = anyMethod(random).substr(0, 200);
  const auto size = static_cast<char>(name.size());
  return std::string({0, static_cast<char>(24 + size), 0, 1, 0, static_cast<char>(4 + size)}) + "\x21\x12\xa4\x42" +
         std::string(12, 'J') + std::string({0, 6, 0, size}) + name + moveTail();
}

std::string anyRequest(Random& random) {
  static const std::string kinds = "HFWJVTOIKLPUDNQRXZGMYB";
  const std::string payload = anyBytes(random, 300);
  const char kind = kinds[random() % kinds.size()];
  return header(kind == 'O' ? 'T' : kind, static_cast<unsigned>(payload.size())) + payload;  // the motors stay on
}

std::string upload() {
  const std::string name = "../../../A";
  std::string payload(1, static_cast<char>(name.size()));
  payload += name + std::string(60000, 'O');
  return header('U', static_cast<unsigned>(payload.size())) + payload;
}

std::string stickPictures() {
  const std::string outside = "../../CONF/RCSERVER.CFG";
  std::string list = header('Y', 0);
  std::string fetch = header('Y', static_cast<unsigned>(outside.size()));
  list[1] = 1;
  fetch[1] = 2;
  return header('M', 0) + list + fetch + outside;
}

// An acknowledgement or a report of a loss, of any picture, or random bytes.
std::vector<std::uint8_t> anyDatagram(Random& random) {
  std::string bytes = anyBytes(random, 1400);
  if (random() % 3 != 0) {
    bytes = std::string(random() % 2 == 0 ? "a" : "l") + std::string(6, '\0') + static_cast<char>(random());
  }
  return {bytes.begin(), bytes.end()};
}

// Streams by UDP, and answers each datagram with twenty others.
void floodByDatagrams(int port, Random& random, TimePoint end) {
  while (steady_clock::now() < end) {
    UdpSocket socket;
    const std::string to = {static_cast<char>(socket.port() >> 8U), static_cast<char>(socket.port() & 0xFFU)};
    const auto client = connectTo(port);
    bool open = client && client->send(kVersion2 + header('B', 2) + to + header('W', 4) + std::string({1, 0, 0, 1}));
    while (open && steady_clock::now() < end) {
      for (int i = 0; i < 20 && (i > 0 || socket.next()); ++i) {
        socket.reply(anyDatagram(random));
      }
      const auto answer = client->receive(milliseconds(1));
      open = !(answer && answer->empty());
    }
    std::this_thread::sleep_for(milliseconds(1));
  }
}

// A table of random ranges, many of them the wrong way round, for any channel; then the plane of each image.
std::string tableOfNonsense(Random& random) {
  std::string payload(132, '\0');
  std::generate(payload.begin() + 4, payload.end(), [&] { return static_cast<char>(random()); });
  payload[0] = static_cast<char>(random() % 10);
  for (std::size_t i = 4; random() % 4 != 0 && i < payload.size(); i += 2) {
    payload[i] = static_cast<char>(random() % 128);
    payload[i + 1] = static_cast<char>(0xFF);
  }
  std::string table = header('Z', 132);
  table[1] = 2;
  std::string on = header('Z', 4);
  on[1] = 1;
  return table + payload + on + std::string({0, 1, 1, 0});
}

std::string soundRequest(char part, const std::string& payload) {
  std::string frame = header('A', static_cast<unsigned>(payload.size())) + payload;
  frame[1] = part;
  return frame;
}

// Sounds that begin again and again, never began, or go on in a day; any volume; the microphone on and off.
std::string soundOfNonsense(Random& random) {
  static const std::vector<unsigned> positions = {0, 0, 1, 1000, 16000, 0x7FFFFFFF, 0x80003C00, 0xFFFFFFFF};
  const std::string samples(random() % 2 * 2 * (1 + random() % 16384), 'x');
  const std::string part =
      bigEndian(positions[random() % positions.size()]) + std::string({char(random() % 2), 0, 0, 0});
  return soundRequest(2, part + samples) + soundRequest(3, {static_cast<char>(random())}) +
         soundRequest(1, {char(random() % 2), char(1 + random() % 3), 0x3E, char(0x80)});
}

}  // namespace

const std::vector<ClientAttack>& clientAttacks() {
  static const std::vector<ClientAttack> attacks = {
      {"nonsense", "random bytes",
       [](const Target& target, Random& random, TimePoint end) {
         sendAgainAndAgain(target.port, "", true, end, [&] { return anyBytes(random, 5000); });
       }},
      {"payloads", "every request with a random payload",
       [](const Target& target, Random& random, TimePoint end) {
         sendAgainAndAgain(target.port, kVersion2, true, end, [&] { return anyRequest(random); });
       }},
      {"unread", "requests whose answers it does not read",
       [](const Target& target, Random&, TimePoint end) {
         sendAgainAndAgain(target.port, kVersion2, false, end, [] { return header('H', 0) + header('N', 0); });
       }},
      {"pictures", "requests for pictures that it does not read",
       [](const Target& target, Random&, TimePoint end) {
         sendAgainAndAgain(target.port, "", false, end, [] { return std::string("F\x55"); });
       }},
      {"slow", "a request, one byte every 20 ms",
       [](const Target& target, Random&, TimePoint end) {
         drip(target.port, kVersion2 + header('U', 60000) + std::string(1000, 'x'), end);
       }},
      {"half", "half a frame, then nothing",
       [](const Target& target, Random&, TimePoint end) { hold(target.port, 1, kVersion2 + header('U', 60000), end); }},
      {"sizes", "frames that announce any size",
       [](const Target& target, Random& random, TimePoint end) {
         sendAgainAndAgain(target.port, kVersion2, true, end,
                           [&] { return header('U', static_cast<unsigned>(random()) | 0x10000U); });
       }},
      {"uploads", "uploads with the name of another folder",
       [](const Target& target, Random&, TimePoint end) {
         sendAgainAndAgain(target.port, kVersion2, true, end, [] { return upload(); });
       }},
      {"stick", "pictures onto the memory stick and from other folders",
       [](const Target& target, Random&, TimePoint end) {
         sendAgainAndAgain(target.port, kVersion2, true, end, [] { return stickPictures(); });
       }},
      {"tables", "colour tables of nonsense, and what they detect",
       [](const Target& target, Random& random, TimePoint end) {
         sendAgainAndAgain(target.port, kVersion2, random() % 2 == 0, end, [&] { return tableOfNonsense(random); });
       }},
      {"sound", "sounds of nonsense, any volume, the microphone on and off",
       [](const Target& target, Random& random, TimePoint end) {
         sendAgainAndAgain(target.port, kVersion2, random() % 2 == 0, end, [&] { return soundOfNonsense(random); });
       }},
      {"datagrams", "a stream by UDP, and wrong answers to its datagrams",
       [](const Target& target, Random& random, TimePoint end) { floodByDatagrams(target.port, random, end); }},
      {"browser", "a web page's POST that moves the tail",
       [](const Target& target, Random&, TimePoint end) {
         sendOnceEach(target.port, end, [] { return http("POST"); });
       }},
      {"methods", "the same with methods that the page makes up",
       [](const Target& target, Random& random, TimePoint end) {
         sendOnceEach(target.port, end, [&] { return http(anyMethod(random)); });
       }},
      {"webrtc", "a web page's STUN by WebRTC, with requests behind it",
       [](const Target& target, Random& random, TimePoint end) {
         sendOnceEach(target.port, end, [&] { return stun(random); });
       }},
      {"tls", "a browser's hello for TLS",
       [](const Target& target, Random&, TimePoint end) {
         sendOnceEach(target.port, end, [] { return std::string({0x16, 3, 1, 2, 0, 1, 0, 1, char(0xFC), 3, 3}); });
       }},
      {"connections", "a hundred connections that only wait",
       [](const Target& target, Random&, TimePoint end) { hold(target.port, 100, "", end); }},
      {"storm", "connections that end at once",
       [](const Target& target, Random&, TimePoint end) {
         while (steady_clock::now() < end) {
           if (const auto client = connectTo(target.port)) {
             client->reset();
           }
         }
       }},
      {"console-line", "an endless line at the console",
       [](const Target& target, Random&, TimePoint end) {
         sendAgainAndAgain(target.console_port, "", true, end, [] { return std::string(5000, 'a'); });
       }},
      {"console-commands", "wrong commands at the console",
       [](const Target& target, Random& random, TimePoint end) {
         sendAgainAndAgain(target.console_port, "", true, end, [&] { return anyBytes(random, 60) + "\n"; });
       }},
      {"console-browser", "a web page's POST that presses a button",
       [](const Target& target, Random&, TimePoint end) {
         sendOnceEach(target.console_port, end,
                      [] { return std::string("POST / HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\npress pause\r\n"); });
       }},
      {"console-listeners", "twenty listeners at the console",
       [](const Target& target, Random&, TimePoint end) { hold(target.console_port, 20, "", end); }},
  };
  return attacks;
}

}  // namespace hostile
