// The calls of OPENRAPI.h that need no robot.
#include <MCOOP.h>
#include <OPENR/OCalendarTime.h>
#include <OPENR/OList.h>
#include <OPENR/OPENRAPI.h>
#include <OPENR/OUnits.h>
#include <dirent.h>
#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <memory>
#include <string>

#include "support/temporary_folder.h"
#include "test_system.h"

// NOLINTBEGIN(bugprone-reserved-identifier): the linker's option --wrap chooses these names
extern "C" {
FILE* __wrap_fopen(const char* path, const char* mode);
int __wrap_open(const char* path, int flags, ...);
DIR* __wrap_opendir(const char* path);
int __wrap_stat(const char* path, struct stat* status);
int __wrap___xstat(int version, const char* path, struct stat* status);
int __wrap_unlink(const char* path);
int __wrap_remove(const char* path);
int __wrap_mkdir(const char* path, mode_t mode);
int __wrap_rmdir(const char* path);
int __wrap_rename(const char* path, const char* new_path);
}
// NOLINTEND(bugprone-reserved-identifier)

namespace openr_host {
namespace {

using testing::HasSubstr;

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
TEST_F(OpenrApiTest, DesignDataStaysInMemoryUntilItIsDeleted) {
  stick_.write("OPEN-R/MW/CONF/DESIGNDB.CFG", "TEXT /MS/OPEN-R/MW/DATA/P/A.TXT\nEMPTY /MS/E.TXT\nGONE /MS/G.TXT\n");
  stick_.write("OPEN-R/MW/DATA/P/A.TXT", "first");
  stick_.write("E.TXT", "");
  asObject([&] {
    ODesignDataID id = 0;
    ODesignDataID other_id = 0;
    byte* data = nullptr;
    byte* other = nullptr;
    size_t size = 0;
    ASSERT_EQ(OPENR::FindDesignData("TEXT", &id, &data, &size), oSUCCESS);
    stick_.write("OPEN-R/MW/DATA/P/A.TXT", "second");
    ASSERT_EQ(OPENR::FindDesignData("TEXT", &other_id, &other, &size), oSUCCESS);
    EXPECT_NE(id, other_id);
    EXPECT_EQ(std::string(other, other + size), "second");
    EXPECT_EQ(std::string(data, data + 5), "first");
    EXPECT_EQ(OPENR::DeleteDesignData(id), oSUCCESS);
    EXPECT_EQ(OPENR::DeleteDesignData(id), oINVALID_ARG);
    ASSERT_EQ(OPENR::FindDesignData("TEXT", &id, &data, &size), oSUCCESS);
    EXPECT_NE(id, other_id);
    EXPECT_EQ(OPENR::FindDesignData("EMPTY", &id, &data, &size), oDESIGNDATA_SIZE_ZERO);
    EXPECT_EQ(OPENR::FindDesignData("GONE", &id, &data, &size), oNOT_FOUND);
    EXPECT_EQ(OPENR::FindDesignData("text", &id, &data, &size), oNOT_FOUND);
  });
}

// Level2 Reference Guide, pages 82 and 83. Seconds count from 2000 (NTP, a sample in the SDK).
TEST_F(OpenrApiTest, TheClockCanBeSet) {
  asObject([] {
    OTime time;
    ASSERT_EQ(OPENR::GetTime(&time), oSUCCESS);
    EXPECT_LE(std::abs(time.GetClock() + 946684800 - std::time(nullptr)), 2);
    ASSERT_EQ(OPENR::SetTime(OTime(1000, 9)), oSUCCESS);
    ASSERT_EQ(OPENR::SetTimeDifference(-5), oSUCCESS);
    EXPECT_EQ(OPENR::SetTimeDifference(13), oFAIL);
    ASSERT_EQ(OPENR::GetTime(&time), oSUCCESS);
    EXPECT_GE(time.GetClock(), 1000);
    EXPECT_LE(time.GetClock(), 1100);
    sbyte difference = 0;
    ASSERT_EQ(OPENR::GetTimeDifference(&difference), oSUCCESS);
    EXPECT_EQ(difference, -5);
    ASSERT_EQ(OPENR::SetTimeDifference(0), oSUCCESS);
    ASSERT_EQ(OPENR::GetTimeDifference(&difference), oSUCCESS);
    EXPECT_EQ(difference, 0);
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
    EXPECT_EQ(__wrap_mkdir("/MS/data/new", 0700), 0);
    EXPECT_TRUE(std::filesystem::is_directory(stick_.path("Data/NEW")));
    const int file = __wrap_open("/MS/DATA/new/a.txt", O_WRONLY | O_CREAT, 0600);
    ASSERT_GE(file, 0);
    EXPECT_EQ(write(file, "1234", 4), 4);
    EXPECT_EQ(close(file), 0);
    EXPECT_EQ(__wrap_stat("/MS/DATA/NEW/A.TXT", &status), 0);
    EXPECT_EQ(std::filesystem::file_size(stick_.path("Data/NEW/A.TXT")), 4u);
    EXPECT_EQ(status.st_size, 4);
    EXPECT_EQ(__wrap___xstat(1, "/MS/DATA/OLD.TXT", &status), 0);
    EXPECT_EQ(status.st_size, 3);
    EXPECT_EQ(__wrap_rename("/MS/data/old.txt", "/MS/data/new/b.txt"), 0);
    EXPECT_EQ(__wrap_stat("/MS/DATA/OLD.TXT", &status), -1);
    EXPECT_TRUE(std::filesystem::exists(stick_.path("Data/NEW/B.TXT")));
    EXPECT_EQ(__wrap_rmdir("/MS/DATA/NEW"), -1) << "it is not empty";
    EXPECT_EQ(__wrap_unlink("/MS/DATA/NEW/a.txt"), 0);
    EXPECT_EQ(__wrap_remove("/MS/DATA/NEW/b.txt"), 0);
    EXPECT_EQ(__wrap_rmdir("/MS/data/new"), 0);
    EXPECT_FALSE(std::filesystem::exists(stick_.path("Data/NEW")));
    DIR* const root = __wrap_opendir("/MS");
    ASSERT_NE(root, nullptr);
    EXPECT_EQ(closedir(root), 0);
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
      EXPECT_EQ(__wrap_opendir(path), nullptr) << path;
      EXPECT_EQ(__wrap_rename(path, "/MS/A.TXT"), -1) << path;
    }
  });
}

TEST(OpenrApi, AnObjectIsTheRunningOneWhileItIsMade) {
  TestSystem test;
  ObjectDescription description = TestObject::describe("Made");
  std::string running;
  description.create = [&running] {
    running = System::current().runningObject();
    return std::make_unique<TestObject>();
  };
  test.system.create(description);
  EXPECT_EQ(running, "Made");
}

// Declared in the SDK's MCOOP.h.
TEST_F(OpenrApiTest, ARegionIsDeletedOnce) {
  asObject([] {
    void* region = nullptr;
    ASSERT_EQ(NewRegion(5000, &region), sSUCCESS);
    static_cast<byte*>(region)[4999] = 1;
    EXPECT_EQ(DeleteRegion(region), sSUCCESS);
    EXPECT_EQ(DeleteRegion(region), sFAIL);
    EXPECT_EQ(NewRegion(0, &region), sFAIL);
  });
}

TEST_F(OpenrApiTest, WithoutADesignDatabaseTheConsoleSaysSo) {
  asObject([] {
    ODesignDataID id = 0;
    byte* data = nullptr;
    size_t size = 0;
    EXPECT_EQ(OPENR::FindDesignData("TEXT", &id, &data, &size), oFAIL);
  });
  EXPECT_THAT(test_.output.str(), HasSubstr("OPEN-R/MW/CONF/DESIGNDB.CFG"));
}

// Level2 Reference Guide, page 48: frames of 8 bytes, 128 bytes of data for each entry.
TEST_F(OpenrApiTest, ANewCommandVectorAlreadyHasItsSizes) {
  asObject([] {
    MemoryRegionID id = 0;
    OCommandVectorData* vector = nullptr;
    ASSERT_EQ(OPENR::NewCommandVectorData(2, &id, &vector), oSUCCESS);
    EXPECT_EQ(vector->vectorInfo.numData, 0U);
    EXPECT_EQ(vector->vectorInfo.infoOffset, 192U);
    EXPECT_EQ(vector->vectorInfo.wait, 0U);
    OCommandInfo* info = vector->GetInfo(1);
    info->Set(odataJOINT_COMMAND2, 5, 16);
    EXPECT_EQ(info->frameSize, 8U);
    EXPECT_EQ(info->dataSize, 128U);
    EXPECT_EQ(info->dataOffset, 192U + 2 * 32 + 128);
    EXPECT_EQ(OPENR::DeleteCdtVectorData(id), oFAIL) << "it is a command vector";
    EXPECT_EQ(OPENR::DeleteCommandVectorData(id), oSUCCESS);
  });
}

// Level2 Reference Guide, pages 64, 69 and 70.
TEST_F(OpenrApiTest, ColourTablesGoToTheCamera) {
  asObject([] {
    MemoryRegionID id = 0;
    OCdtVectorData* tables = nullptr;
    ASSERT_EQ(OPENR::NewCdtVectorData(&id, &tables), oSUCCESS);
    tables->SetNumData(1);
    tables->GetInfo(0)->Init(7, ocdtCHANNEL3);
    tables->GetInfo(0)->Set(31, 0x44, 0x11, 0x99, 0x66);
    EXPECT_EQ(tables->GetInfo(0)->table[0], 0x80808080U);
    EXPECT_EQ(tables->GetInfo(0)->table[31], 0x99664411U);
    EXPECT_EQ(OPENR::SetCdtVectorData(id), oSUCCESS);
    tables->vectorInfo.type = odataCOMMAND_VECTOR;
    EXPECT_EQ(OPENR::SetCdtVectorData(id), oINVALID_DATA_TYPE);
    tables->vectorInfo.type = odataCDT_VECTOR;
    tables->SetNumData(8);
    EXPECT_EQ(OPENR::SetCdtVectorData(id), oSUCCESS);
    tables->SetNumData(9);
    EXPECT_EQ(OPENR::SetCdtVectorData(id), oFAIL) << "more tables than there is room for";
    EXPECT_EQ(OPENR::DeleteCdtVectorData(id), oSUCCESS);
    EXPECT_EQ(OPENR::SetCdtVectorData(id), oFAIL);
    OCommandVectorData* commands = nullptr;
    ASSERT_EQ(OPENR::NewCommandVectorData(1, &id, &commands), oSUCCESS);
    EXPECT_EQ(OPENR::SetCdtVectorData(id), oFAIL) << "not of tables";
    EXPECT_EQ(OPENR::DeleteCommandVectorData(id), oSUCCESS);
  });
  EXPECT_EQ(test_.robot.calls, (std::vector<std::string>{"setCdtVectorData 1 8", "setCdtVectorData 8 8"}));
}

TEST_F(OpenrApiTest, ThereAreNoSyncKeys) {
  asObject([] {
    OVRSyncKey key = 0;
    EXPECT_EQ(OPENR::NewSyncKey(&key), oNO_SYNC_KEY);
    EXPECT_EQ(key, ovrsynckeyUNDEF);
  });
}

TEST(UnitsTest, AnglesAreTruncatedToMillionthsOfARadian) {
  EXPECT_EQ(oradians(180), 3141592);
  EXPECT_EQ(oradians(-90), -1570796);
  EXPECT_EQ(micro(1.5), 1500000);
  EXPECT_DOUBLE_EQ(degrees(radians(30)), 30);
}

TEST(OIDTest, IsInvalidByDefault) {
  EXPECT_FALSE(OID().IsValid());
  EXPECT_EQ(OID(), OID());
  int object = 0;
  OID oid(&object);
  EXPECT_TRUE(oid.IsValid());
  EXPECT_TRUE(OServiceEntry(oid, 0).IsValid());
  EXPECT_FALSE(OServiceEntry().IsValid());
  oid.MakeInvalid();
  EXPECT_EQ(oid, OID());
}

TEST(OListTest, HasRoomForItsItems) {
  OList<int, 3> list;
  EXPECT_EQ(list.PopBack(), otlUNDERFLOW);
  EXPECT_EQ(list.PushBack(1), otlSUCCESS);
  EXPECT_EQ(list.PushBack(2), otlSUCCESS);
  EXPECT_EQ(list.PushBack(3), otlSUCCESS);
  EXPECT_EQ(list.PushBack(4), otlOVERFLOW);
  std::vector<int> items;
  for (OList<int, 3>::Iterator item = list.Begin(); item != list.End(); ++item) {
    items.push_back(*item);
  }
  EXPECT_THAT(items, testing::ElementsAre(1, 2, 3));
  EXPECT_EQ(list.PopBack(), otlSUCCESS);
  EXPECT_EQ(list.Front(), 1);
  EXPECT_EQ(list.Back(), 2);
  EXPECT_EQ(list.GetSize(), 2);
}

TEST(OTimeTest, CalendarTimeIsLocal) {
  const OCalendarTime time(OTime(131328000, 9));  // 29 February 2004, 00:00 in Greenwich
  EXPECT_EQ(time.year_, 4);
  EXPECT_EQ(time.month_, 2);
  EXPECT_EQ(time.day_, 29);
  EXPECT_EQ(time.hour_, 9);
  EXPECT_EQ(time.dow_, 0);
  char text[32];
  time.RFC2822(text);
  EXPECT_STREQ(text, "Sun, 29 Feb 2004 09:00:00 +0900");
  OTime other;
  EXPECT_EQ(other.SetTimeDif(13), oINVALID_ARG);
  EXPECT_EQ(other.GetTimeDif(), 0);
}

}  // namespace
}  // namespace openr_host
