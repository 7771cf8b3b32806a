/// @file whole_campaign.h
#ifndef TEST_SUPPORT_WHOLE_CAMPAIGN_H
#define TEST_SUPPORT_WHOLE_CAMPAIGN_H

#include <cstdlib>

namespace test_support {

/// True if scripts/faults asks for the whole campaign: it tries more often than the tests, and needs a computer that is
/// otherwise idle.
inline bool wantsWholeCampaign() {
  return std::getenv("AIBO_WHOLE_CAMPAIGN") != nullptr;
}

}  // namespace test_support

#endif  // TEST_SUPPORT_WHOLE_CAMPAIGN_H
