#include "openr_host/objects/command_queue.h"

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

OCommandInfo readInfo(const RCRegion& region, std::size_t entry, std::size_t entries, const VirtualRobot& robot) {
  OCommandInfo info{};
  std::memcpy(&info, region.Base() + kInfoOffset + entry * sizeof(info), sizeof(info));
  const std::string name = "its entry " + text(entry) + " for primitive " + text(info.primitiveID);
  require(robot.takesCommand(info.primitiveID, info.type),
          name + ": that is not open, or takes no commands of type " + text(info.type));
  require(info.numFrames > 0 && info.numFrames <= ocommandMAX_FRAMES,
          name + ": numFrames is " + text(info.numFrames) + " instead of 1 to " + text(ocommandMAX_FRAMES));
  require(info.frameSize == sizeof(OCommandValue),
          name + ": frameSize is " + text(info.frameSize) + " instead of " + text(sizeof(OCommandValue)));
  const std::size_t begin = info.dataOffset;
  require(begin >= kInfoOffset + entries * sizeof(info) && begin <= region.Size() &&
              info.numFrames * sizeof(OCommandValue) <= region.Size() - begin,
          name + ": dataOffset " + text(begin) + " leads out of the data of its region of " + text(region.Size()) +
              " bytes");
  return info;
}

std::vector<OCommandInfo> readEntries(const RCRegion& region, const VirtualRobot& robot) {
  const std::size_t count = readHeader(region).numData;
  std::vector<OCommandInfo> entries;
  entries.reserve(count);
  for (std::size_t entry = 0; entry < count; ++entry) {
    entries.push_back(readInfo(region, entry, count, robot));
  }
  return entries;
}

}  // namespace

void CommandQueue::add(RCRegion& region, const VirtualRobot& robot) {
  vectors_.push_back({reference(&region), readEntries(region, robot)});
}

bool CommandQueue::next(EffectorCommands* commands) {
  if (vectors_.empty()) {
    return false;
  }
  Vector& vector = vectors_.front();
  bool is_last = true;
  for (const OCommandInfo& entry : vector.entries) {
    if (vector.frame < entry.numFrames) {
      EffectorCommand command{entry.primitiveID, entry.type, {}};
      std::memcpy(&command.value, vector.region->Base() + entry.dataOffset + vector.frame * sizeof(command.value),
                  sizeof(command.value));
      commands->push_back(command);
    }
    is_last = is_last && vector.frame + 1 >= entry.numFrames;
  }
  ++vector.frame;
  if (is_last) {
    vectors_.pop_front();
  }
  return is_last;
}

}  // namespace openr_host
