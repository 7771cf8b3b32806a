// What the simulated robot plays and hears. Model Information ERS-7, 3.1.2 and 3.2.2.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/stat.h>

#include <array>
#include <cstdint>
#include <cstring>

#include "simulator/ers7/console_commands.h"
#include "simulator/ers7/simulated_ers7.h"
#include "support/gzip.h"
#include "support/temporary_folder.h"

namespace simulated_ers7 {
namespace {

using openr_host::SpeakerFrame;
using testing::HasSubstr;

class SimulatedSoundTest : public testing::Test {
 protected:
  SimulatedSoundTest() { robot_.openPrimitive("PRM:/s1-Speaker:S1", &speaker_); }

  OStatus setVolume(OSpeakerVolume volume) {
    OPrimitiveControl_SpeakerVolume param(volume);
    return robot_.controlPrimitive(speaker_, oprmreqSPEAKER_SET_VOLUME, &param, sizeof(param), nullptr, 0);
  }
  OStatus control(OPrimitiveRequest request) {
    return robot_.controlPrimitive(speaker_, request, nullptr, 0, nullptr, 0);
  }
  std::string hear(const std::string& file) { return obeyConsole(robot_, "hear " + file).value(); }

  // What a microphone hears of a loud sample.
  int heard() {
    SpeakerFrame frame{};
    frame.fill(10000);
    return robot_.passSound(frame_++, &frame)[7].R;
  }

  SimulatedErs7 robot_{[] {
    SimulatedErs7::Options options;
    options.hears_itself = 0.5;
    return options;
  }()};
  OPrimitiveID speaker_ = oprimitiveID_UNDEF;
  longword frame_ = 0;
};

TEST_F(SimulatedSoundTest, ItHearsItselfAsLoudAsTheVolumeSays) {
  EXPECT_EQ(heard(), 5000) << "the loudest at first";
  const std::pair<OSpeakerVolume, int> rows[] = {
      {ospkvol18dB, 1991},  // 8 dB less
      {ospkvol25dB, 889},   // 15 dB less
      {ospkvolinfdB, 0},
      {ospkvol10dB, 5000},
  };
  for (const auto& [volume, level] : rows) {
    EXPECT_EQ(setVolume(volume), oSUCCESS);
    EXPECT_EQ(heard(), level) << volume;
  }
  EXPECT_EQ(setVolume(0x1234), oINVALID_ARG);
  EXPECT_EQ(control(oprmreqSPEAKER_MUTE_ON), oSUCCESS);
  EXPECT_EQ(heard(), 0);
  EXPECT_EQ(control(oprmreqSPEAKER_MUTE_OFF), oSUCCESS);
  EXPECT_EQ(heard(), 5000);
}

TEST_F(SimulatedSoundTest, WhatTheSpeakerPlaysCanBeHeardFromAFile) {
  const test_support::TemporaryFolder folder;
  const std::string path = folder.path("played.wav").string();
  SpeakerFrame frame{};
  frame[0] = 1;
  frame[127] = -30000;
  {
    SimulatedErs7::Options options;
    options.speaker_file = path;
    SimulatedErs7 robot(options);
    robot.passSound(0, &frame);
    robot.passSound(1, nullptr);
    robot.passSound(2, &frame);
  }
  EXPECT_EQ(readWav(path).size(), 256U) << "without the pause";
  EXPECT_EQ(hear(path), "ok: hear " + path + "\n");
  const openr_host::MicrophoneFrame heard = robot_.passSound(100, nullptr);
  EXPECT_EQ(heard[0].L, 1);
  EXPECT_EQ(heard[127].R, -30000) << "one channel is for both microphones";
  EXPECT_EQ(robot_.passSound(101, nullptr)[127].L, -30000);
  EXPECT_EQ(robot_.passSound(102, nullptr)[0].L, 0) << "once";
  hear(path);
  EXPECT_EQ(hear("silence"), "ok: hear silence\n");
  EXPECT_EQ(robot_.passSound(103, nullptr)[0].L, 0);
  hear(path);
  EXPECT_THAT(hear("nothing.wav"), HasSubstr("cannot be read"));
  robot_.switchOff();
  EXPECT_EQ(robot_.passSound(200, nullptr)[127].L, -30000) << "from its beginning, in spite of the error and a reboot";
}

// A chunk of odd size is followed by a byte that does not count.
TEST_F(SimulatedSoundTest, AFileOfAnotherProgramIsHeardWithoutItsOtherChunks) {
  const test_support::TemporaryFolder folder;
  const std::string path = folder.path("other.wav").string();
  SpeakerFrame frame{};
  frame[0] = 1000;
  WavWriter(path).write(frame);
  std::string bytes = test_support::contentOf(path);
  for (const std::size_t place : {36, 12}) {  // before the samples, and before the format
    bytes.insert(place, "LIST\3\0\0\0abc\0", 12);
  }
  bytes.replace(bytes.find("fmt ") + 8, 2, "\xfe\xff");  // the format is extensible
  unsigned time = 0;
  for (const std::string& content : {bytes, test_support::gzipped(bytes)}) {
    std::ofstream(path, std::ios::binary) << content;
    EXPECT_EQ(hear(path), "ok: hear " + path + "\n");
    EXPECT_EQ(robot_.passSound(time++, nullptr)[0].L, 1000);
  }
}

// So a program can play it on this computer.
TEST_F(SimulatedSoundTest, APipeGetsTheSoundAtOnce) {
  const test_support::TemporaryFolder folder;
  SimulatedErs7::Options options;
  options.speaker_file = folder.path("pipe").string();
  ASSERT_EQ(::mkfifo(options.speaker_file.c_str(), 0600), 0);
  const int reader = ::open(options.speaker_file.c_str(), O_RDONLY | O_NONBLOCK);
  SimulatedErs7 robot(options);
  SpeakerFrame frame{};
  frame.fill(77);
  robot.passSound(0, &frame);
  std::array<char, 1000> bytes{};
  ASSERT_EQ(::read(reader, bytes.data(), bytes.size()), 44 + 256);
  robot.passSound(1, &frame);
  EXPECT_EQ(::read(reader, &bytes[300], 300), 256);
  ::close(reader);
  std::uint32_t size = 0;
  std::memcpy(&size, &bytes[40], sizeof(size));
  EXPECT_GT(size, 1U << 30) << "players stop at the end that a header tells";
  EXPECT_EQ(bytes[44], 77);
}

TEST_F(SimulatedSoundTest, AFileThatCannotBeHeardIsNamedWithTheRemedy) {
  const test_support::TemporaryFolder folder;
  const std::string path = folder.path("other.wav").string();
  EXPECT_THAT(hear(path), HasSubstr("other.wav: cannot be read"));
  const std::string pipe = folder.path("pipe.wav").string();
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  for (const std::string& other : {pipe, folder.path().string(), std::string("/dev/zero")}) {
    EXPECT_THAT(hear(other), HasSubstr("it is not a regular file"));
  }
  std::ofstream(path).close();
  std::filesystem::resize_file(path, 100'000'001);
  EXPECT_THAT(hear(path), HasSubstr("cannot be read")) << "it is longer than 100 MB";
  for (const char* text : {"no sound", "RIFF1234WAVEdata1234"}) {
    std::ofstream(path) << text;
    EXPECT_THAT(hear(path), HasSubstr("is not a WAV file"));
  }
  // Bytes of the encoding, the number of channels, the rate, and the bits.
  for (const auto& [place, byte] : {std::pair(20, 2), {22, 0}, {22, 3}, {24, 0}, {34, 8}}) {
    { const WavWriter writer(path); }
    std::fstream(path, std::ios::in | std::ios::out | std::ios::binary).seekp(place).put(static_cast<char>(byte));
    EXPECT_THAT(hear(path), HasSubstr("-r 16000")) << place;
  }
  SimulatedErs7::Options options;
  options.speaker_file = folder.path("missing/played.wav").string();
  EXPECT_THROW(SimulatedErs7{options}, SoundError);
}

}  // namespace
}  // namespace simulated_ers7
