#include "aibo_client/names.h"

#include <gmock/gmock.h>

#include "aibo_client/exceptions.h"
#include "support/refusal.h"

using namespace aibo_client;

TEST(Names, BelongToTheIdentifiersOfTheProtocol) {
  EXPECT_EQ(idOfJoint("head_pan"), 2);
  EXPECT_EQ(nameOfJoint(2), "head_pan");
  for (const auto& [name, id] : {std::pair("neck_tilt", 1), {"tail_tilt", 52}}) {  // the first and the last one
    EXPECT_EQ(idOfJoint(name, "ERS-7"), id);
    EXPECT_EQ(nameOfJoint(id, "ERS-7"), name);
  }
  EXPECT_EQ(nameOfSensor(idOfSensor("battery")), "battery");
  EXPECT_EQ(nameOfLed(idOfLed("face_1")), "face_1");
}

TEST(Names, AreThoseOfTheDesign) {
  EXPECT_EQ(idOfJoint("head_roll", "ERS-210"), idOfJoint("head_roll"));
  EXPECT_THROW(idOfJoint("head_roll", "ERS-7"), InvalidArgumentException);
  EXPECT_THROW(idOfJoint("head_nod", "ERS-210"), InvalidArgumentException);
  EXPECT_NE(idOfSensor("chin", "ERS-210"), idOfSensor("chin", "ERS-7"));
  EXPECT_EQ(idOfSensor("chin"), idOfSensor("chin", "ERS-7"));
  EXPECT_NO_THROW(idOfLed("eye_left_top", "ERS-210"));
  EXPECT_THROW(idOfLed("eye_left_top", "ERS-7"), InvalidArgumentException);
}

TEST(Names, AreListedIfOneIsNotKnown) {
  EXPECT_EQ(nameOfJoint(99) + nameOfSensor(99) + nameOfLed(99), "joint 99sensor 99LED 99");
  const std::pair<int (*)(const std::string&, const std::string&), const char*> rows[] = {
      {idOfJoint, "neck_tilt, head_pan, "}, {idOfSensor, ", battery, "}, {idOfLed, "face_1, face_2, "}};
  for (const auto& [id_of, names] : rows) {
    EXPECT_THAT(test_support::refusalOf<InvalidArgumentException>([id_of = id_of] { id_of("elbow", "ERS-7"); }),
                ::testing::AllOf(::testing::HasSubstr("'elbow'"), ::testing::HasSubstr(names)));
  }
}

TEST(Names, OfPostures) {
  EXPECT_EQ(nameOfPosture(Posture::kStand), "stand");
  EXPECT_EQ(nameOfPosture(Posture::kSit), "sit");
  EXPECT_EQ(nameOfPosture(Posture::kRest), "rest");
}
