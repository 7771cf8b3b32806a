// The gates to microphones and speaker: OPEN-R SDK Level2 Reference Guide, pages 44 and 62 to 69.
#include "simulator/openr_host/objects/virtual_robot_audio_comm.h"

#include <OPENR/OPENRAPI.h>
#include <gmock/gmock.h>

#include <numeric>

#include "test_system.h"

namespace openr_host {
namespace {

using testing::HasSubstr;

constexpr OPrimitiveID kSpeaker = 30;

std::vector<sword> numbers(sword first, std::size_t count) {
  std::vector<sword> samples(count);
  std::iota(samples.begin(), samples.end(), first);
  return samples;
}

class VirtualRobotAudioCommTest : public GateTest<VirtualRobotAudioComm> {
 protected:
  void SetUp() override {
    talker_.on_ready = [this](const OReadyEvent& event) { readies_ += event.IsAssert() ? 1 : 0; };
    listener_.on_notify = [this](const ONotifyEvent& event) {
      for (int i = 0; i < event.NumOfData(); ++i) {
        take(*event.RCData(i));
      }
      listener_.observer().AssertReady();
    };
    test_.system.initialize();
    test_.system.connect("Talker.Out.Data.S", "OVirtualRobotAudioComm.Speaker.OSoundVectorData.O");
    test_.system.connect("OVirtualRobotAudioComm.Mic.OSoundVectorData.S", "Listener.In.Data.O");
    test_.system.start();
    test_.as(listener_, [&] { listener_.observer().DeassertReady(); });
    test_.run();
  }

  void take(const RCRegion& region) {
    OSoundVectorData vector{};
    std::memcpy(&vector, region.Base(), sizeof(vector));
    EXPECT_EQ(vector.vectorInfo.type, odataSOUND_VECTOR);
    EXPECT_EQ(vector.vectorInfo.totalSize, region.Size());
    EXPECT_EQ(vector.vectorInfo.numData, 1U);
    const OSoundInfo& info = vector.info[0];
    EXPECT_EQ(info.channel, osoundchannelSTEREO);
    EXPECT_EQ(info.samplingRate, 16000);
    EXPECT_EQ(info.bitsPerSample, 16);
    EXPECT_EQ(info.frameSize, 512u) << "8 ms";
    EXPECT_EQ(info.format, osoundformatPCM);
    std::vector<OSoundSampleStereo16>& samples = heard_[info.frameNumber];
    samples.resize(info.dataSize / 4);
    std::memcpy(samples.data(), region.Base() + info.dataOffset, info.dataSize);
  }

  RegionReference makeVector(const std::vector<sword>& samples) {
    const std::size_t size = 2 * samples.size();
    RegionReference made;
    test_.as(talker_, [&] {
      MemoryRegionID id = 0;
      OSoundVectorData* vector = nullptr;
      ASSERT_EQ(OPENR::NewSoundVectorData(1, size, &id, &vector), oSUCCESS);
      made = regionOf(id, vector);
      vector->SetNumData(1);
      OSoundInfo& info = *vector->GetInfo(0);
      EXPECT_EQ(info.maxDataSize, size);
      info.Set(odataSOUND_VECTOR, kSpeaker, size);
      info.format = osoundformatPCM;
      info.channel = osoundchannelMONO;
      info.samplingRate = 16000;
      info.bitsPerSample = 16;
      std::memcpy(vector->GetData(0), samples.data(), size);
    });
    return made;
  }

  void send(const std::vector<RegionReference>& vectors) { test_.send(talker_, vectors); }

  TestObject& talker_ = test_.add("Talker");
  TestObject& listener_ = test_.add("Listener");
  int readies_ = 0;
  std::map<longword, std::vector<OSoundSampleStereo16>> heard_;  ///< by the first frame
};

TEST_F(VirtualRobotAudioCommTest, ReadyFollowsTheOutputOfEachVectorAndTwoAtFirstLeaveNoGap) {
  EXPECT_EQ(readies_, 1);
  const RegionReference first = makeVector(numbers(1, 256));
  send({first, makeVector(numbers(257, 256))});
  pass(1);
  EXPECT_EQ(readies_, 1);
  EXPECT_EQ(test_.robot.played[100], numbers(1, 128));
  pass(1);
  EXPECT_EQ(readies_, 2);
  EXPECT_EQ(first->NumberOfReference(), 1) << "it can be filled again";
  send({makeVector(numbers(513, 128))});
  pass(2);
  EXPECT_EQ(readies_, 3);
  pass(5);
  EXPECT_EQ(readies_, 4);
  EXPECT_EQ(test_.robot.played[104], numbers(513, 128));
  EXPECT_THAT(test_.robot.played, testing::SizeIs(5));
  EXPECT_FALSE(gate_.isActive());
}

TEST_F(VirtualRobotAudioCommTest, WhatTheSpeakerDoesNotPlayIsRefusedInTheNextFrame) {
  const std::string other_kind = "it is not PCM, mono, of the rate and bits for which the speaker is set";
  const std::string outside = "its data is empty, or outside of its region";
  const std::vector<std::pair<std::string, std::function<void(OSoundVectorData&)>>> rows = {
      {"its type is not odataSOUND_VECTOR", [](auto& vector) { vector.vectorInfo.type = odataCOMMAND_VECTOR; }},
      {"it has not one sound, but 0", [](auto& vector) { vector.vectorInfo.numData = 0; }},
      {"primitive 31 is not an open speaker", [](auto& vector) { vector.info[0].primitiveID = 31; }},
      {other_kind, [](auto& vector) { vector.info[0].samplingRate = 8000; }},
      {outside, [](auto& vector) { vector.info[0].dataSize += 1; }},
      {outside, [](auto& vector) { vector.info[0].dataOffset = 0xffffffffU; }},
  };
  for (const auto& [message, spoil] : rows) {
    const RegionReference vector = makeVector(numbers(1, 128));
    void* const base = vector->Base();
    spoil(*static_cast<OSoundVectorData*>(base));
    const int readies = readies_;
    test_.output.str("");
    send({vector});
    EXPECT_THAT(test_.output.str(), testing::AllOf(HasSubstr("ERROR"), HasSubstr("OVirtualRobotAudioComm"),
                                                   HasSubstr("sound vector refused: " + message)));
    EXPECT_EQ(readies_, readies) << message;
    pass(1);
    EXPECT_EQ(readies_, readies + 1) << message;
  }
  EXPECT_THAT(test_.robot.played, testing::IsEmpty());
}

// So a file that the microphones hear begins when a client listens, not at boot.
TEST_F(VirtualRobotAudioCommTest, TheMicrophoneIsHeardEvery16MillisecondsWhileSomebodyListens) {
  pass(10);
  EXPECT_FALSE(gate_.isActive());
  EXPECT_EQ(test_.robot.sound_frames, 0);
  test_.as(listener_, [&] { listener_.observer().AssertReady(); });
  test_.run();
  EXPECT_TRUE(gate_.isActive());
  pass(5);  // 110 to 114
  EXPECT_EQ(test_.robot.sound_frames, 5);
  ASSERT_THAT(heard_, testing::SizeIs(2));
  for (const auto& [frame, samples] : heard_) {
    EXPECT_TRUE(frame == 110 || frame == 112) << frame;
    ASSERT_EQ(samples.size(), 256U);
    for (std::size_t i = 0; i < samples.size(); ++i) {
      EXPECT_EQ(samples[i].L, static_cast<sword>(frame * 128 + i));
      EXPECT_EQ(samples[i].R, -samples[i].L);
    }
  }
}

}  // namespace
}  // namespace openr_host
