#include "client/sequence_window.h"

#include <gmock/gmock.h>

using aibo_client::SequenceWindow;
using Verdict = aibo_client::SequenceWindow::Verdict;

namespace {

TEST(SequenceWindowTest, LostOnesAreCountedWhenTheyCanNoLongerCome) {
  SequenceWindow window;
  window.add(0);
  for (unsigned i = 3; i < 65; ++i) {  // 1 and 2 are missing
    window.add(i);
    EXPECT_EQ(0u, window.lost());
  }
  window.add(65);
  EXPECT_EQ(1u, window.lost());
  window.add(66);
  EXPECT_EQ(2u, window.lost());
}

TEST(SequenceWindowTest, LateOnesAreReorderedAndNotLost) {
  SequenceWindow window;
  window.add(0);
  window.add(2);
  EXPECT_EQ(Verdict::kReordered, window.add(1));
  EXPECT_EQ(Verdict::kDuplicate, window.add(1));
  EXPECT_EQ(Verdict::kDuplicate, window.add(2));
  for (unsigned i = 3; i < 200; ++i) {
    window.add(i);
  }
  EXPECT_EQ(0u, window.lost());
  EXPECT_EQ(Verdict::kReordered, window.add(1)) << "too long ago to know";
}

TEST(SequenceWindowTest, ANumberFarAheadIsImpossibleAndChangesNothing) {
  SequenceWindow window;
  window.add(0);
  EXPECT_EQ(Verdict::kImpossible, window.add(65537));
  EXPECT_EQ(Verdict::kImpossible, window.add(0xffffffff));
  EXPECT_EQ(Verdict::kNext, window.add(1));
  EXPECT_EQ(0u, window.lost());
}

}  // namespace
