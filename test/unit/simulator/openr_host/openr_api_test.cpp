// The calls of OPENRAPI.h that need no robot.
#include <MCOOP.h>
#include <OPENR/OPENRAPI.h>
#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/stat.h>

#include "support/temporary_folder.h"
#include "test_system.h"

// NOLINTBEGIN(bugprone-reserved-identifier): the linker's option --wrap chooses these names
extern "C" {
FILE* __wrap_fopen(const char* path, const char* mode);
int __wrap_open(const char* path, int flags, ...);
int __wrap_stat(const char* path, struct stat* status);
int __wrap___xstat(int version, const char* path, struct stat* status);
int __wrap_unlink(const char* path);
int __wrap_remove(const char* path);
}
// NOLINTEND(bugprone-reserved-identifier)

namespace openr_host {
namespace {

class OpenrApiTest : public testing::Test {
 protected:
  OpenrApiTest() { test_.boot(); }

  template <typename Function>
  void asObject(const Function& function) {
    test_.as(object_, function);
  }

  test_support::TemporaryFolder stick_;
  TestSystem test_{stick_.path().string()};
  TestObject& object_ = test_.add("Object");
};

// Level2 Reference Guide, pages 80 and 81.
TEST_F(OpenrApiTest, DesignDataIsTheFileOfItsKeyword) {
  stick_.write("OPEN-R/MW/CONF/DESIGNDB.CFG", "TEXT /MS/OPEN-R/MW/DATA/P/A.TXT\nGONE /MS/G.TXT\n");
  stick_.write("OPEN-R/MW/DATA/P/A.TXT", "first");
  asObject([&] {
    ODesignDataID id = 0;
    byte* data = nullptr;
    size_t size = 0;
    ASSERT_EQ(OPENR::FindDesignData("TEXT", &id, &data, &size), oSUCCESS);
    EXPECT_EQ(std::string(data, data + size), "first");
    EXPECT_EQ(OPENR::DeleteDesignData(id), oSUCCESS);
    EXPECT_EQ(OPENR::DeleteDesignData(id), oINVALID_ARG);
    EXPECT_EQ(OPENR::FindDesignData("GONE", &id, &data, &size), oNOT_FOUND);
    EXPECT_EQ(OPENR::FindDesignData("text", &id, &data, &size), oNOT_FOUND);
  });
}

// Programmer's Guide, appendix A.1.
TEST_F(OpenrApiTest, TheTimeSinceBootIsInSecondsAndMicroseconds) {
  test_.system.modelTime(nullptr, [] { return std::chrono::seconds(3) + std::chrono::microseconds(250007); });
  SystemTime time{};
  asObject([&] { GetSystemTime(&time); });
  EXPECT_EQ(time.seconds, 3U);
  EXPECT_EQ(time.useconds, 250007U);
}

TEST_F(OpenrApiTest, FilesOfObjectsAreOnTheMemoryStick) {
  stick_.write("Data/Old.txt", "old");
  asObject([&] {
    struct stat status {};
    const int file = __wrap_open("/MS/DATA/a.txt", O_WRONLY | O_CREAT, 0600);
    ASSERT_GE(file, 0);
    EXPECT_EQ(write(file, "1234", 4), 4);
    EXPECT_EQ(close(file), 0);
    EXPECT_EQ(std::filesystem::file_size(stick_.path("Data/A.TXT")), 4u) << "names of new files are in capitals";
    EXPECT_EQ(__wrap_stat("/MS/data/a.txt", &status), 0);
    EXPECT_EQ(status.st_size, 4);
    EXPECT_EQ(__wrap___xstat(1, "/MS/DATA/OLD.TXT", &status), 0);
    EXPECT_EQ(status.st_size, 3);
    EXPECT_EQ(__wrap_unlink("/MS/DATA/a.txt"), 0);
    EXPECT_EQ(__wrap_remove("/MS/DATA/old.txt"), 0);
    EXPECT_TRUE(std::filesystem::is_empty(stick_.path("Data")));
  });
}

TEST_F(OpenrApiTest, ObjectsReachNoFileOutsideOfTheMemoryStick) {
  asObject([&] {
    struct stat status {};
    for (const char* path : {"/etc/passwd", "/MS/../etc/passwd", "/MSX/A.TXT", "A.TXT", "", "/MS/NO/SUCH.TXT"}) {
      errno = 0;
      EXPECT_EQ(__wrap_stat(path, &status), -1) << path;
      EXPECT_EQ(errno, ENOENT) << path;
      EXPECT_EQ(__wrap_fopen(path, "w"), nullptr) << path;
    }
  });
}

}  // namespace
}  // namespace openr_host
