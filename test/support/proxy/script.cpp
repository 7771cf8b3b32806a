#include "support/proxy/script.h"

#include <chrono>
#include <functional>
#include <map>
#include <sstream>
#include <thread>

namespace test_support {

using std::chrono::microseconds;

const char* const kScriptHelp =
    "  delay MS, jitter MS         delays all bytes by this time, plus a random time up to the jitter\n"
    "  rate BYTES                  limits the bytes per second; 0 = no limit\n"
    "  pieces BYTES [GAP_MS]       cuts the stream into pieces of this size, with a gap between them; 0 = as sent\n"
    "  random-pieces BYTES         cuts the stream into pieces of up to this size\n"
    "  join MS                     joins bytes that are sent within this time\n"
    "  pause, resume               stops reading from the server; goes on\n"
    "  welcome serve|close|reset|silence|refuse|unreachable     what happens to new clients from now on\n"
    "  end close|reset|halfclose|silence                        ends all connections now, in this way\n"
    "  fault ACTION[:VALUE][@PLACE][>server]                    makes one fault; ACTION is\n"
    "      close, reset, halfclose, silence, drop:BYTES, insert:HEX, overwrite:HEX, flip:HEX, pause:MS, split:MS\n"
    "      PLACE is now, byte+N (of the connection) or picture+N (of the next picture, from its header);\n"
    "      the fault is on the way to the client unless >server is given\n"
    "  target HOST:PORT            connects later clients to this server (IPv4)\n"
    "  move ADDRESS                moves the proxy to this address of this computer\n"
    "  heal                        ends all faults\n"
    "  sleep SECONDS               waits before the next line\n";

namespace {

double toNumber(const std::string& word) {
  std::istringstream text(word);
  double number = 0;
  if (!(text >> number) || !text.eof() || number < 0) {
    throw ScriptError("'" + word + "' is not a number from 0 on");
  }
  return number;
}

std::size_t toSize(const std::string& word) {
  return static_cast<std::size_t>(toNumber(word));
}

microseconds toTime(const std::string& milliseconds) {
  return microseconds(static_cast<microseconds::rep>(1000 * toNumber(milliseconds)));
}

Bytes toBytes(const std::string& hex) {
  Bytes bytes;
  for (std::size_t i = 0; i < hex.size(); i += 2) {
    const std::string pair = hex.substr(i, 2);
    if (pair.size() < 2 || pair.find_first_not_of("0123456789abcdefABCDEF") != std::string::npos) {
      throw ScriptError("'" + hex + "' is not a row of bytes such as 00ff");
    }
    bytes.push_back(static_cast<std::uint8_t>(std::stoi(pair, nullptr, 16)));
  }
  return bytes;
}

template <typename Value>
Value choose(const std::map<std::string, Value>& choices, const std::string& word) {
  const auto found = choices.find(word);
  if (found == choices.end()) {
    std::string all;
    for (const auto& choice : choices) {
      all += " " + choice.first;
    }
    throw ScriptError("'" + word + "' is not one of:" + all);
  }
  return found->second;
}

const std::map<std::string, Action> kActions = {{"close", Action::kClose},         {"reset", Action::kReset},
                                                {"halfclose", Action::kHalfClose}, {"drop", Action::kDrop},
                                                {"insert", Action::kInsert},       {"overwrite", Action::kOverwrite},
                                                {"flip", Action::kFlip},           {"pause", Action::kPause},
                                                {"silence", Action::kSilence},     {"split", Action::kSplit}};

const std::map<std::string, Action> kEnds = {{"close", Action::kClose},
                                             {"reset", Action::kReset},
                                             {"halfclose", Action::kHalfClose},
                                             {"silence", Action::kSilence}};

const std::map<std::string, Welcome> kWelcomes = {{"serve", Welcome::kServe},   {"close", Welcome::kClose},
                                                  {"reset", Welcome::kReset},   {"silence", Welcome::kSilence},
                                                  {"refuse", Welcome::kRefuse}, {"unreachable", Welcome::kUnreachable}};

const std::map<std::string, Place> kPlaces = {
    {"now", Place::kHere}, {"byte", Place::kByte}, {"picture", Place::kPicture}};

/// Cuts off and returns what follows the mark; empty without the mark.
std::string takeBehind(char mark, std::string* words) {
  const std::size_t at = words->find(mark);
  if (at == std::string::npos) {
    return "";
  }
  const std::string behind = words->substr(at + 1);
  words->erase(at);
  return behind;
}

void setValue(const std::string& value, Fault* fault) {
  switch (fault->action) {
    case Action::kDrop:
      fault->count = toSize(value);
      break;
    case Action::kInsert:
    case Action::kOverwrite:
    case Action::kFlip:
      fault->bytes = toBytes(value);
      break;
    case Action::kPause:
    case Action::kSplit:
      fault->time = toTime(value);
      break;
    default:
      if (!value.empty()) {
        throw ScriptError("this fault takes no value");
      }
  }
}

}  // namespace

Fault parseFault(const std::string& words) {
  std::string rest = words;
  Fault fault;
  const std::string receiver = takeBehind('>', &rest);
  fault.direction =
      receiver.empty()
          ? Direction::kToClient
          : choose<Direction>({{"client", Direction::kToClient}, {"server", Direction::kToServer}}, receiver);
  std::string place = takeBehind('@', &rest);
  const std::string offset = takeBehind('+', &place);
  const std::string value = takeBehind(':', &rest);
  fault.action = choose(kActions, rest);
  fault.place = choose(kPlaces, place.empty() ? "now" : place);
  fault.offset = offset.empty() ? 0 : static_cast<std::uint64_t>(toNumber(offset));
  if (fault.place == Place::kPicture && fault.direction == Direction::kToServer) {
    throw ScriptError("there are no pictures on the way to the server");
  }
  setValue(value, &fault);
  return fault;
}

void Script::carryOut(const std::string& line) {
  std::istringstream words(line.substr(0, line.find('#')));
  std::string command;
  std::string first;
  std::string second;
  if (!(words >> command)) {
    return;
  }
  words >> first >> second;
  if (!changeConditions(command, first, second) && !act(command, first)) {
    throw ScriptError("'" + command + "' is not a command");
  }
}

bool Script::changeConditions(const std::string& command, const std::string& first, const std::string& second) {
  const std::map<std::string, std::function<void()>> changes = {
      {"delay", [&] { conditions_.delay = toTime(first); }},
      {"jitter", [&] { conditions_.jitter = toTime(first); }},
      {"rate", [&] { conditions_.bytes_per_second = toSize(first); }},
      {"pieces",
       [&] {
         conditions_.largest_piece = toSize(first);
         conditions_.random_pieces = false;
         conditions_.piece_gap = second.empty() ? microseconds(0) : toTime(second);
       }},
      {"random-pieces",
       [&] {
         conditions_.largest_piece = toSize(first);
         conditions_.random_pieces = true;
       }},
      {"join", [&] { conditions_.join = toTime(first); }},
      {"pause", [&] { conditions_.paused = true; }},
      {"resume", [&] { conditions_.paused = false; }},
      {"heal",
       [&] {
         conditions_ = Conditions();
         proxy_->heal();
       }},
  };
  const auto change = changes.find(command);
  if (change == changes.end()) {
    return false;
  }
  change->second();
  proxy_->setConditions(conditions_);
  return true;
}

bool Script::act(const std::string& command, const std::string& argument) {
  const std::map<std::string, std::function<void()>> actions = {
      {"welcome", [&] { proxy_->setWelcome(choose(kWelcomes, argument)); }},
      {"end", [&] { proxy_->endConnections(choose(kEnds, argument)); }},
      {"fault", [&] { proxy_->add(parseFault(argument)); }},
      {"target",
       [&] {
         std::string host = argument;
         const std::string port = takeBehind(':', &host);
         proxy_->setTarget(host, static_cast<int>(toNumber(port)));
       }},
      {"move", [&] { proxy_->moveTo(argument); }},
      {"sleep", [&] { std::this_thread::sleep_for(1000 * toTime(argument)); }},
  };
  const auto action = actions.find(command);
  if (action == actions.end()) {
    return false;
  }
  action->second();
  return true;
}

}  // namespace test_support
