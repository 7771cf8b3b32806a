/// @file any_fault.h
#ifndef TEST_FAULT_CAMPAIGN_ANY_FAULT_H
#define TEST_FAULT_CAMPAIGN_ANY_FAULT_H

#include "campaign/experiment.h"
#include "support/proxy/fault.h"

namespace fault_bench {

/// Something that goes wrong: each kind in turn, all else about it at random. Where it does is up to the caller.
Fault anyFault(unsigned turn, Random& random);

/// True if the connection may stand although what comes over it is not what was sent.
bool isDamage(const Fault& fault);

}  // namespace fault_bench

#endif  // TEST_FAULT_CAMPAIGN_ANY_FAULT_H
