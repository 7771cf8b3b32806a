#include "protocol/motion_requests.h"

#include <gmock/gmock.h>

#include <climits>
#include <cstring>
#include <string>

#include "layouts.h"

namespace protocol {
namespace version2 {
namespace {

using ::testing::HasSubstr;
using ::testing::IsNull;

Bytes encodedOrder(unsigned short repetitions, const std::string& name) {
  MotionOrder order{};
  order.repetitions = repetitions;
  name.copy(order.name, MAX_MOTION_NAME_SIZE);
  return encoded(encodeMotionOrder, order, MAX_MOTION_ORDER_SIZE);
}

TEST(MotionUpload, IsANameAndAFile) {
  const Bytes content = bytesOf("OMTN");
  const MotionUpload upload{"NOD.MTN", content.data(), content.size()};
  EXPECT_EQ(encoded(encodeMotionUpload, upload, MAX_PAYLOAD_TOWARDS_ROBOT), hex(kUpload));

  const Bytes bytes = hex(kUpload);
  MotionUpload again{};
  ASSERT_THAT(decodeMotionUpload(bytes.data(), bytes.size(), &again), IsNull());
  EXPECT_STREQ(again.name, "NOD.MTN");
  EXPECT_EQ(Bytes(again.content, again.content + again.content_size), content);
}

TEST(MotionUpload, MayBeAsLargeAsAFrameAllows) {
  const Bytes content(MAX_MOTION_FILE_SIZE, 0x5a);
  const MotionUpload upload{"WALK_FWD.MTN", content.data(), content.size()};
  const Bytes bytes = encoded(encodeMotionUpload, upload, MAX_PAYLOAD_TOWARDS_ROBOT);
  EXPECT_EQ(bytes.size(), MAX_PAYLOAD_TOWARDS_ROBOT);

  MotionUpload again{};
  ASSERT_THAT(decodeMotionUpload(bytes.data(), bytes.size(), &again), IsNull());
  EXPECT_EQ(again.content_size, MAX_MOTION_FILE_SIZE);
}

TEST(MotionUpload, IsRefusedWithoutAFile) {
  EXPECT_THAT(verdict(decodeMotionUpload)(bytesOf("\x07NOD.MTN")), HasSubstr("no motion after its name"));
}

TEST(MotionUpload, IsRefusedWithAWrongSizeOfTheName) {
  for (const int size : {12, 127, 255}) {
    Bytes bytes = hex(kUpload);
    bytes[0] = static_cast<unsigned char>(size);
    EXPECT_THAT(verdict(decodeMotionUpload)(bytes), HasSubstr("does not fit")) << size;
  }
  for (const int size : {0, 6, 8}) {
    Bytes bytes = hex(kUpload);
    bytes[0] = static_cast<unsigned char>(size);
    EXPECT_THAT(verdict(decodeMotionUpload)(bytes), HasSubstr(".MTN")) << size;
  }
  EXPECT_THAT(verdict(decodeMotionUpload)(hex("ff") + Bytes(MAX_PAYLOAD_TOWARDS_ROBOT - 1, 'A')), HasSubstr(".MTN"));
}

TEST(MotionUpload, IsRefusedWithAnInvalidName) {
  EXPECT_THAT(verdict(decodeMotionUpload)(bytesOf("\x08../A.MTNxyz")), HasSubstr("other characters"));
}

TEST(MotionToDelete, IsAName) {
  MotionName name = "";
  ASSERT_THAT(decodeMotionName(bytesOf("wag.mtn").data(), 7, name), IsNull());
  EXPECT_STREQ(name, "WAG.MTN");

  unsigned char bytes[MAX_MOTION_NAME_SIZE];
  ASSERT_EQ(encodeMotionName(name, bytes), 7U);
  EXPECT_EQ(Bytes(bytes, bytes + 7), bytesOf("WAG.MTN"));
  EXPECT_THAT(decodeMotionName(nullptr, 0, name), HasSubstr(".MTN"));
}

TEST(MotionOrder, HasTheRepetitionsAndTheName) {
  EXPECT_EQ(encodedOrder(3, "NOD.MTN"), hex(kOrder));

  const Bytes bytes = hex(kOrder);
  MotionOrder order{};
  ASSERT_THAT(decodeMotionOrder(bytes.data(), bytes.size(), &order), IsNull());
  EXPECT_EQ(order.repetitions, 3);
  EXPECT_STREQ(order.name, "NOD.MTN");
}

TEST(MotionOrder, GoesUpToTheLongestNameAndTheMostRepetitions) {
  const Bytes bytes = encodedOrder(USHRT_MAX, "WALK_FWD.MTN");
  EXPECT_EQ(bytes, hex("ff ff") + bytesOf("WALK_FWD.MTN"));
  MotionOrder order{};
  ASSERT_THAT(decodeMotionOrder(bytes.data(), bytes.size(), &order), IsNull());
  EXPECT_EQ(order.repetitions, USHRT_MAX);
  EXPECT_STREQ(order.name, "WALK_FWD.MTN");
}

TEST(MotionOrder, StopsOneMotionOrAll) {
  const Bytes one = encodedOrder(0, "NOD.MTN");
  MotionOrder order{};
  order.repetitions = 7;
  ASSERT_THAT(decodeMotionOrder(one.data(), one.size(), &order), IsNull());
  EXPECT_EQ(order.repetitions, 0);
  EXPECT_STREQ(order.name, "NOD.MTN");

  const Bytes all = encodedOrder(0, "");
  EXPECT_EQ(all, hex("00 00"));
  order.repetitions = 7;
  ASSERT_THAT(decodeMotionOrder(all.data(), all.size(), &order), IsNull());
  EXPECT_EQ(order.repetitions, 0);
  EXPECT_STREQ(order.name, "");
}

TEST(MotionOrder, ThatPlaysNeedsAName) {
  EXPECT_THAT(verdict(decodeMotionOrder)(hex("00 01")), HasSubstr(".MTN"));
}

TEST(MotionOrder, IsUnchangedWhenItIsRefused) {
  MotionOrder order{9, "WAG.MTN"};
  const Bytes bytes = hex("00 01") + bytesOf("A/B.MTN");
  ASSERT_THAT(decodeMotionOrder(bytes.data(), bytes.size(), &order), HasSubstr("other characters"));
  EXPECT_EQ(order.repetitions, 9);
  EXPECT_STREQ(order.name, "WAG.MTN");
}

TEST(MotionChanges, AreAPlainText) {
  const std::string text = "2 positions are clipped";
  const Bytes bytes = encoded(encodeMotionChanges, MotionChanges{text.data(), text.size()}, MAX_MOTION_CHANGES_SIZE);
  EXPECT_EQ(bytes, bytesOf(text));
  MotionChanges changes{};
  ASSERT_THAT(decodeMotionChanges(bytes.data(), bytes.size(), &changes), IsNull());
  EXPECT_EQ(std::string(changes.text, changes.text_size), text);
  ASSERT_THAT(decodeMotionChanges(bytes.data(), 0, &changes), IsNull()) << "nothing is different";
  EXPECT_EQ(changes.text_size, 0U);
}

TEST(MotionChanges, AreRefusedIfTheyAreNotPlainOrTooLong) {
  EXPECT_THAT(verdict(decodeMotionChanges)(bytesOf("a\nb")), HasSubstr("plain"));
  EXPECT_THAT(verdict(decodeMotionChanges)(hex("ff")), HasSubstr("plain"));
  EXPECT_THAT(verdict(decodeMotionChanges)(Bytes(MAX_MOTION_CHANGES_SIZE + 1, 'a')), HasSubstr("too long"));
  MotionChanges changes{};
  EXPECT_THAT(decodeMotionChanges(Bytes(MAX_MOTION_CHANGES_SIZE, 'a').data(), MAX_MOTION_CHANGES_SIZE, &changes),
              IsNull());
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

TEST(MotionList, IsNamesWithANewlineBetween) {
  EXPECT_EQ(encoded(encodeMotionList, listOf(0), MAX_FILE_LIST_SIZE), Bytes());
  EXPECT_EQ(encoded(encodeMotionList, listOf(1), MAX_FILE_LIST_SIZE), bytesOf("MOVE1000.MTN"));
  EXPECT_EQ(encoded(encodeMotionList, listOf(2), MAX_FILE_LIST_SIZE), bytesOf("MOVE1000.MTN\nMOVE1001.MTN"));

  const Bytes bytes = bytesOf("NOD.MTN\nWAG.MTN");
  FileList list{};
  ASSERT_THAT(decodeMotionList(bytes.data(), bytes.size(), &list), IsNull());
  ASSERT_EQ(list.count, 2U);
  EXPECT_STREQ(list.names[0], "NOD.MTN");
  EXPECT_STREQ(list.names[1], "WAG.MTN");
}

TEST(MotionList, MayBeEmpty) {
  FileList list = listOf(3);
  ASSERT_THAT(decodeMotionList(nullptr, 0, &list), IsNull());
  EXPECT_EQ(list.count, 0U);
}

TEST(MotionList, HoldsAtMost256Names) {
  const Bytes most = encoded(encodeMotionList, listOf(MAX_LISTED_FILES), MAX_FILE_LIST_SIZE);
  EXPECT_EQ(most.size(), MAX_FILE_LIST_SIZE);
  FileList list{};
  ASSERT_THAT(decodeMotionList(most.data(), most.size(), &list), IsNull());
  EXPECT_EQ(list.count, MAX_LISTED_FILES);
  EXPECT_THAT(verdict(decodeMotionList)(most + bytesOf("\nA.MTN")), HasSubstr("more than 256"));
}

TEST(MotionList, RefusesInvalidNames) {
  for (const char* text :
       {"\n", "NOD.MTN\n", "\nNOD.MTN", "NOD.MTN\n\nWAG.MTN", "NOD.MTN\r\nWAG.MTN", "../A.MTN", "NOD"}) {
    EXPECT_THAT(verdict(decodeMotionList)(bytesOf(text)), HasSubstr(".MTN")) << text;
  }
}

}  // namespace
}  // namespace version2
}  // namespace protocol
