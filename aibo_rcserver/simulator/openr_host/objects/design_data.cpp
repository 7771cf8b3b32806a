#include "simulator/openr_host/objects/design_data.h"

#include <fstream>
#include <iterator>

#include "simulator/openr_host/configuration/memory_stick.h"

namespace openr_host {

OStatus DesignData::find(const std::string& keyword, ODesignDataID* id, byte** data, size_t* size) {
  const std::string database = findOnMemoryStick(memory_stick_, "OPEN-R/MW/CONF/DESIGNDB.CFG");
  std::ifstream text(database);
  const auto files = readDesignDatabase(text, database, design_);
  const auto found = files.find(keyword);
  if (found == files.end() || !isOnMemoryStick(memory_stick_, found->second)) {
    return oNOT_FOUND;
  }
  std::ifstream file(findOnMemoryStick(memory_stick_, found->second), std::ios::binary);
  std::vector<byte> content(std::istreambuf_iterator<char>(file), {});
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
