#include "openr_host/objects/command_vector_memory.h"

#include <cstddef>
#include <new>
#include <utility>

namespace openr_host {

OCommandVectorData* CommandVectorMemory::create(std::size_t entries) {
  if (entries == 0 || entries > kMostEntries) {
    return nullptr;
  }
  const std::size_t info_offset = offsetof(OCommandVectorData, info);
  const std::size_t data_offset = info_offset + entries * sizeof(OCommandInfo);
  const std::size_t total_size = data_offset + entries * sizeof(OCommandData);
  auto memory = std::make_unique<byte[]>(total_size);

  auto* vector = new (memory.get()) OCommandVectorData{};
  vector->vectorInfo.type = odataCOMMAND_VECTOR;
  vector->vectorInfo.memRegionID = ++last_id_;
  vector->vectorInfo.totalSize = static_cast<longword>(total_size);
  vector->vectorInfo.infoOffset = static_cast<longword>(info_offset);
  vector->vectorInfo.infoSize = sizeof(OCommandInfo);
  vector->vectorInfo.maxNumData = static_cast<longword>(entries);
  for (std::size_t entry = 0; entry < entries; ++entry) {
    OCommandInfo* info = vector->GetInfo(static_cast<int>(entry));
    info->frameSize = sizeof(OCommandValue);
    info->dataOffset = static_cast<longword>(data_offset + entry * sizeof(OCommandData));
    info->dataSize = sizeof(OCommandData);
  }
  vectors_[last_id_] = std::move(memory);
  return vector;
}

}  // namespace openr_host
