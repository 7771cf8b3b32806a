// NAME_OF_PROGRAM NAME [OPTION...]: runs the tests of NAME_rostest.cpp, or without a name all of its tests.

#include <gtest/gtest.h>
#include <ros/ros.h>

#include <cstdio>
#include <string>

namespace {

// The filter of GoogleTest that chooses the tests of a source.
std::string testsOf(const std::string& source) {
  std::string filter;
  const testing::UnitTest& program = *testing::UnitTest::GetInstance();
  for (int i = 0; i < program.total_test_suite_count(); ++i) {
    const testing::TestSuite& suite = *program.GetTestSuite(i);
    for (int j = 0; j < suite.total_test_count(); ++j) {
      const testing::TestInfo& test = *suite.GetTestInfo(j);
      const std::string file = test.file();
      if (file.substr(file.rfind('/') + 1) == source) {
        filter += std::string(suite.name()) + "." + test.name() + ":";
      }
    }
  }
  return filter;
}

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "node_tests", ros::init_options::AnonymousName);
  testing::InitGoogleTest(&argc, argv);
  if (argc > 1) {
    const std::string source = std::string(argv[1]) + "_rostest.cpp";
    const std::string filter = testsOf(source);
    if (filter.empty()) {
      std::fprintf(stderr, "%s: this program has no tests of %s\n", argv[0], source.c_str());
      return 2;
    }
    testing::GTEST_FLAG(filter) = filter;
  }
  const ros::NodeHandle handle;
  ros::AsyncSpinner spinner(2);
  spinner.start();
  return RUN_ALL_TESTS();
}
