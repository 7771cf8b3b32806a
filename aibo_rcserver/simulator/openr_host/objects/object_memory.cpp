#include "simulator/openr_host/objects/object_memory.h"

#include <new>
#include <utility>

#include "host_files/regular_file.h"
#include "simulator/openr_host/memory_stick.h"

namespace openr_host {

template <typename Vector>
Vector* VectorMemory::create(ODataType type, std::size_t entries, std::size_t info_size, std::size_t total_size) {
  auto memory = std::make_unique<byte[]>(total_size);
  auto* vector = new (memory.get()) Vector{};
  vector->vectorInfo.type = type;
  vector->vectorInfo.memRegionID = ++last_id_;
  vector->vectorInfo.totalSize = static_cast<longword>(total_size);
  vector->vectorInfo.infoOffset = static_cast<longword>(offsetof(Vector, info));
  vector->vectorInfo.infoSize = static_cast<longword>(info_size);
  vector->vectorInfo.maxNumData = static_cast<longword>(entries);
  vector->vectorInfo.syncKey = ovrsynckeyUNDEF;
  blocks_[last_id_] = {type, std::move(memory)};
  return vector;
}

OCommandVectorData* VectorMemory::createCommands(std::size_t entries) {
  if (entries == 0 || entries > kMostEntries) {
    return nullptr;
  }
  const std::size_t data_offset = offsetof(OCommandVectorData, info) + entries * sizeof(OCommandInfo);
  auto* vector = create<OCommandVectorData>(odataCOMMAND_VECTOR, entries, sizeof(OCommandInfo),
                                            data_offset + entries * sizeof(OCommandData));
  for (std::size_t entry = 0; entry < entries; ++entry) {
    OCommandInfo* info = vector->GetInfo(static_cast<int>(entry));
    info->frameSize = sizeof(OCommandValue);
    info->dataOffset = static_cast<longword>(data_offset + entry * sizeof(OCommandData));
    info->dataSize = sizeof(OCommandData);
  }
  return vector;
}

OSoundVectorData* VectorMemory::createSounds(std::size_t sounds, std::size_t bytes) {
  if (sounds == 0 || bytes == 0 || sounds > kMostEntries || bytes > kMostSoundBytes / sounds) {
    return nullptr;
  }
  const std::size_t data_offset = offsetof(OSoundVectorData, info) + sounds * sizeof(OSoundInfo);
  auto* vector = create<OSoundVectorData>(odataSOUND_VECTOR, sounds, sizeof(OSoundInfo), data_offset + sounds * bytes);
  for (std::size_t sound = 0; sound < sounds; ++sound) {
    OSoundInfo* info = vector->GetInfo(static_cast<int>(sound));
    info->dataOffset = static_cast<longword>(data_offset + sound * bytes);
    info->maxDataSize = static_cast<longword>(bytes);
  }
  return vector;
}

OCdtVectorData* VectorMemory::createCdt() {
  return create<OCdtVectorData>(odataCDT_VECTOR, ocdtNUM_CHANNELS, sizeof(OCdtInfo), sizeof(OCdtVectorData));
}

OCdtVectorData* VectorMemory::findCdt(MemoryRegionID id) const {
  const auto found = blocks_.find(id);
  if (found == blocks_.end() || found->second.type != odataCDT_VECTOR) {
    return nullptr;
  }
  void* base = found->second.memory.get();
  return std::launder(static_cast<OCdtVectorData*>(base));
}

bool VectorMemory::destroy(MemoryRegionID id, ODataType type) {
  const auto found = blocks_.find(id);
  if (found == blocks_.end() || found->second.type != type) {
    return false;
  }
  blocks_.erase(found);
  return true;
}

OStatus DesignData::find(const std::string& keyword, ODesignDataID* id, byte** data, size_t* size) {
  const std::string database = findOnMemoryStick(memory_stick_, "OPEN-R/MW/CONF/DESIGNDB.CFG");
  std::istringstream text = openConfiguration(database);
  const auto files = readDesignDatabase(text, database, design_);
  const auto found = files.find(keyword);
  if (found == files.end() || !isOnMemoryStick(memory_stick_, found->second)) {
    return oNOT_FOUND;
  }
  constexpr std::size_t kSizeOfStick = 16U << 20U;  // bytes
  std::vector<byte> content =
      host_files::readRegularFile(findOnMemoryStick(memory_stick_, found->second), kSizeOfStick);
  if (content.empty()) {
    return oDESIGNDATA_SIZE_ZERO;
  }
  std::vector<byte>& kept = files_[++last_id_] = std::move(content);
  *id = last_id_;
  *data = kept.data();
  *size = kept.size();
  return oSUCCESS;
}

}  // namespace openr_host
