#include "campaign/experiment.h"
namespace fault_bench {
std::vector<Row> serverRows() {
  return {};
}
}  // namespace fault_bench
