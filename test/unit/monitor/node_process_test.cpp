#include "tools/node_process.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

namespace aibo_driver::tools {
namespace {

TEST(ProcessorTime, GrowsWhileTheProcessWorks) {
  const auto before = processorTime(::getpid());
  ASSERT_TRUE(before);
  while (processorTime(::getpid()) == before) {
  }
  EXPECT_GT(*processorTime(::getpid()), *before);
}

TEST(ProcessorTime, IsUnknownForAProcessThatHasEnded) {
  const pid_t child = ::fork();
  if (child == 0) {
    ::_exit(0);
  }
  ASSERT_EQ(child, ::waitpid(child, nullptr, 0));
  EXPECT_FALSE(processorTime(child));
}

}  // namespace
}  // namespace aibo_driver::tools
