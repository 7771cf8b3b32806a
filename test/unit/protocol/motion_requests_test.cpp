#include "protocol/motion_requests.h"

#include <gmock/gmock.h>

#include <string>

#include "layouts.h"

namespace protocol {
namespace version2 {
namespace {

using ::testing::HasSubstr;
using ::testing::IsNull;

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
