#include "protocol/motion_requests.h"

#include <gmock/gmock.h>

#include <string>

#include "layouts.h"

namespace protocol {
namespace version2 {
namespace {

using ::testing::HasSubstr;
using ::testing::IsNull;

TEST(MotionUpload, MayBeAsLargeAsAFrameAllows) {
  const Bytes content(MAX_MOTION_FILE_SIZE, 0x5a);
  const Bytes bytes = encoded(MotionUpload{"WALK_FWD.MTN", content.data(), content.size()});
  EXPECT_EQ(bytes.size(), MAX_PAYLOAD_TOWARDS_ROBOT);
  EXPECT_EQ(decoded<MotionUpload>(bytes).content_size, MAX_MOTION_FILE_SIZE);
}

FileList listOf(size_t count) {
  FileList list{};
  list.count = count;
  for (size_t i = 0; i < count; ++i) {
    const std::string name = "MOVE" + std::to_string(1000 + i) + ".MTN";
    name.copy(list.names[i], MAX_MOTION_NAME_SIZE);
  }
  return list;
}

Bytes encodedList(const FileList& list) {
  Bytes bytes(MAX_FILE_LIST_SIZE);
  return firstOf(bytes, encodeFileList(list, bytes.data()));
}

const char* problemOfList(const Bytes& bytes, FileList* list) {
  return decodeFileList(readMotionName, bytes.data(), bytes.size(), list);
}

TEST(MotionList, IsNamesWithANewlineBetween) {
  EXPECT_EQ(encodedList(listOf(0)), Bytes());
  EXPECT_EQ(encodedList(listOf(1)), bytesOf("MOVE1000.MTN"));
  EXPECT_EQ(encodedList(listOf(2)), bytesOf("MOVE1000.MTN\nMOVE1001.MTN"));
  FileList list = listOf(3);
  ASSERT_THAT(problemOfList(bytesOf("NOD.MTN\nWAG.MTN"), &list), IsNull());
  ASSERT_EQ(list.count, 2U);
  EXPECT_STREQ(list.names[0], "NOD.MTN");
  EXPECT_STREQ(list.names[1], "WAG.MTN");
  ASSERT_THAT(problemOfList({}, &list), IsNull());
  EXPECT_EQ(list.count, 0U);
}

TEST(MotionList, HoldsAtMost256Names) {
  const Bytes most = encodedList(listOf(MAX_LISTED_FILES));
  EXPECT_EQ(most.size(), MAX_FILE_LIST_SIZE);
  FileList list{};
  ASSERT_THAT(problemOfList(most, &list), IsNull());
  EXPECT_EQ(list.count, MAX_LISTED_FILES);
  EXPECT_THAT(problemOfList(most + bytesOf("\nA.MTN"), &list), HasSubstr("more than 256"));
}

TEST(MotionList, RefusesInvalidNames) {
  FileList list{};
  for (const char* text :
       {"\n", "NOD.MTN\n", "\nNOD.MTN", "NOD.MTN\n\nWAG.MTN", "NOD.MTN\r\nWAG.MTN", "../A.MTN", "NOD"}) {
    EXPECT_THAT(problemOfList(bytesOf(text), &list), HasSubstr(".MTN")) << text;
  }
}

}  // namespace
}  // namespace version2
}  // namespace protocol
