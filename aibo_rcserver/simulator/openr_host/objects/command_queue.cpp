#include "simulator/openr_host/objects/command_queue.h"

#include <OPENR/OSyslog.h>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <stdexcept>
#include <string>
#include <utility>

namespace openr_host {
namespace {

constexpr std::size_t kInfoOffset = offsetof(OCommandVectorData, info);

void require(bool condition, const std::string& otherwise) {
  if (!condition) {
    throw std::invalid_argument(otherwise);
  }
}

std::string text(std::size_t number) {
  return std::to_string(number);
}

ODataVectorInfo readHeader(const RCRegion& region) {
  ODataVectorInfo header{};
  require(region.Size() >= sizeof(header), "its region of " + text(region.Size()) + " bytes has no room for a header");
  std::memcpy(&header, region.Base(), sizeof(header));
  require(header.type == odataCOMMAND_VECTOR, "its type is " + text(header.type) + " instead of odataCOMMAND_VECTOR");
  require(header.numData > 0, "its numData is 0");
  require(header.numData <= header.maxNumData,
          "its numData is " + text(header.numData) + ", its maxNumData only " + text(header.maxNumData));
  require(header.numData <= (region.Size() - kInfoOffset) / sizeof(OCommandInfo),
          "its region of " + text(region.Size()) + " bytes has no room for numData " + text(header.numData));
  return header;
}

OCommandInfo readInfo(const RCRegion& region, std::size_t entry) {
  OCommandInfo info{};
  std::memcpy(&info, region.Base() + kInfoOffset + entry * sizeof(info), sizeof(info));
  return info;
}

void check(const OCommandInfo& info, const RCRegion& region, std::size_t entry, std::size_t entries) {
  const std::string name = "its entry " + text(entry) + " for primitive " + text(info.primitiveID);
  require(info.numFrames <= ocommandMAX_FRAMES,
          name + ": numFrames is " + text(info.numFrames) + ", the most is " + text(ocommandMAX_FRAMES));
  require(info.frameSize == sizeof(OCommandValue),
          name + ": frameSize is " + text(info.frameSize) + " instead of " + text(sizeof(OCommandValue)));
  const std::size_t begin = info.dataOffset;
  require(
      begin >= kInfoOffset + entries * sizeof(info) && begin <= region.Size() &&
          info.numFrames * sizeof(OCommandValue) <= region.Size() - begin,
      name + ": dataOffset " + text(begin) + " is outside the data of its region of " + text(region.Size()) + " bytes");
}

/// How many frames a value lasts. LEDs and an ERS-7's ears have this in their values (page 50), at the same offset.
longword framesOf(const EffectorCommand& command) {
  static_assert(offsetof(OLEDCommandValue2, period) == 4 && offsetof(OLEDCommandValue3, period) == 4 &&
                    offsetof(OJointCommandValue4, period) == 4,
                "the three types share the offset");
  const bool has_period =
      command.type == odataLED_COMMAND2 || command.type == odataLED_COMMAND3 || command.type == odataJOINT_COMMAND4;
  OLEDCommandValue2 value;
  std::memcpy(&value, &command.value, sizeof(value));
  return has_period ? std::max<longword>(value.period, 1) : 1;
}

}  // namespace

// Only numFrames frames are processed (page 48), so an entry without frames is ignored.
std::vector<OCommandInfo> CommandQueue::readEntries(const RCRegion& region, const VirtualRobot& robot) {
  const std::size_t count = readHeader(region).numData;
  std::vector<OCommandInfo> entries;
  entries.reserve(count);
  for (std::size_t entry = 0; entry < count; ++entry) {
    const OCommandInfo info = readInfo(region, entry);
    if (info.numFrames > 0 && isTaken(info, robot)) {
      check(info, region, entry, count);
      entries.push_back(info);
    }
  }
  return entries;
}

bool CommandQueue::isTaken(const OCommandInfo& info, const VirtualRobot& robot) {
  const bool is_taken = robot.takesCommand(info.primitiveID, info.type);
  if (!is_taken && ignored_.insert({info.primitiveID, info.type}).second) {
    OSYSLOG1((osyslogWARNING, "commands ignored: primitive %u is not open, or takes no commands of type %u",
              info.primitiveID, info.type));
  }
  return is_taken;
}

void CommandQueue::add(RCRegion& region, const VirtualRobot& robot) {
  Vector vector{reference(&region), {}, readHeader(region).wait};
  for (const OCommandInfo& info : readEntries(region, robot)) {
    vector.entries.push_back({info, 0, 0});
  }
  vectors_.push_back(std::move(vector));
}

bool CommandQueue::next(EffectorCommands* commands) {
  if (vectors_.empty()) {
    return false;
  }
  Vector& vector = vectors_.front();
  if (vector.frames_to_wait > 0) {
    --vector.frames_to_wait;
    return false;
  }
  bool is_last = true;
  for (Entry& entry : vector.entries) {
    const bool has_more = output(*vector.region, &entry, commands);
    is_last = is_last && !has_more;
  }
  if (is_last) {
    vectors_.pop_front();
  }
  return is_last;
}

bool CommandQueue::output(const RCRegion& region, Entry* entry, EffectorCommands* commands) {
  if (entry->frames_left == 0 && entry->next_value < entry->info.numFrames) {
    EffectorCommand command{entry->info.primitiveID, entry->info.type, {}};
    std::memcpy(&command.value, region.Base() + entry->info.dataOffset + entry->next_value * sizeof(command.value),
                sizeof(command.value));
    commands->push_back(command);
    ++entry->next_value;
    entry->frames_left = framesOf(command);
  }
  entry->frames_left -= std::min<longword>(entry->frames_left, 1);
  return entry->frames_left > 0 || entry->next_value < entry->info.numFrames;
}

}  // namespace openr_host
